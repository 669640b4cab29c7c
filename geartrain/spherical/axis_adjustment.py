"""Adjustment of gear axes until all meshes have one pitch (Levenberg's method), or until all loops close (Newton's
method).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.spherical.pitch_cones import angle_rows, azimuth_rows, azimuths, mesh_angles, moved, operating_pitch

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from geartrain.numerics.arrays import Floats, Ints


Meshes = Sequence[tuple[int, int]]
_MOST_STEPS = 80  # maximum number of steps of either method
_EXACT = 1e-11
"""Residual below which a fit is exact [rad, or pitch]; rounding causes about 1e-15."""
_TRIES = (0.0, 0.01, 0.02, 0.04, 0.08)
"""Standard deviations [rad] of random displacements, which make tangencies independent that depend on each other by
symmetry.
"""
_MOST_DENSE = 600  # meshes; the time of a dense singular value decomposition grows with the cube of their number
_PHASE_DAMPING = 1e-4  # keeps axes that neither loops nor pitches determine
_LONGEST = 0.1
"""Maximum displacement of an axis in one step [rad]."""


def tangency(axes: Floats, meshes: Meshes, teeth: Floats, pitch: float) -> tuple[Floats, csr_array]:
    """Return the tangency residual S_ij - asin(l z_i) - asin(l z_j) of every mesh [rad], and its Jacobian.

    The columns of the Jacobian are two displacements of each axis along its `frames`, then the pitch l [radii of the
    sphere]. Tooth numbers may be any positive numbers: `teeth` = sin rho and pitch 1 give the tangency of pitch cones.
    """
    from scipy.sparse import csr_array as sparse
    from scipy.sparse import hstack

    S, slopes = angle_rows(axes, meshes)
    i, j = np.array(meshes).T
    # kept below a crown gear, where the slope of the arc sine is infinite
    sine = np.minimum(pitch * teeth, 1 - 1e-9)
    widen = -teeth / np.sqrt(1 - sine**2)
    cones = np.arcsin(sine)
    J = hstack([slopes, sparse((widen[i] + widen[j])[:, None])], format="csr")
    return S - cones[i] - cones[j], J


def loop_sums(axes: Floats, corners: LoopCorners, teeth: Floats) -> tuple[Floats, csr_array]:
    """Return the sum of (-1)^k z_k alpha_k / 2 pi over every loop [pitch], and its derivative with respect to
    displacements of the axes.

    The angle alpha_k, 0 to 2 pi, at gear k is measured counterclockwise from its next to its previous contact.
    """
    from scipy.sparse import coo_array

    at, following, before = corners.gear, corners.following, corners.before
    alpha = (azimuths(axes, at, before) - azimuths(axes, at, following)) % (2 * np.pi)
    weight = corners.sign * teeth[at] / (2 * np.pi)
    count = len(at)
    gather = coo_array((weight, (corners.loop, np.arange(count))), shape=(corners.count, count)).tocsr()
    slopes = gather @ (azimuth_rows(axes, at, before) - azimuth_rows(axes, at, following))
    return np.asarray(gather @ alpha), slopes.tocsr()


def pitch_rows(axes: Floats, meshes: Meshes, teeth: Floats) -> tuple[Floats, csr_array]:
    """Return the logarithm of the operating pitch of every mesh, and its derivative with respect to displacements of
    the axes.

    The derivative with respect to the axis angle is d ln lambda / dS = cot S + z_i z_j sin S / (z_i^2 + z_j^2 + 2 z_i
    z_j cos S).
    """
    from scipy.sparse import diags_array

    S, slopes = angle_rows(axes, meshes)
    i, j = np.array(meshes).T
    a, b = teeth[i], teeth[j]
    steep = 1 / np.tan(S) + a * b * np.sin(S) / (a**2 + b**2 + 2 * a * b * np.cos(S))
    return np.log(operating_pitch(S, a, b)), (diags_array(steep) @ slopes).tocsr()


def minimum_step(J: csr_array, error: Floats, damping: float) -> Floats:
    """Return the step x that minimises |x|^2 + |error + J x|^2 / damping.

    For `damping` towards 0 it tends to the minimum-norm solution of J x = -error.
    """
    from scipy.sparse import block_array, eye_array
    from scipy.sparse.linalg import splu

    m, n = J.shape
    # bordered system instead of J J^T + damping, which would be dense and have the square of the condition number
    system = block_array([[eye_array(n), J.T], [J, -damping * eye_array(m)]], format="csc")
    # the column of the pitch is full; an ordering for symmetric matrices eliminates it last
    factor = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
    return np.asarray(factor.solve(np.concatenate([np.zeros(n), -error]))[:n])


@dataclass(frozen=True)
class LoopCorners:
    """Contacts of the gears in loops as parallel arrays: gear, next and previous gear, sign, and index of the loop."""

    gear: Ints
    following: Ints
    before: Ints
    sign: Ints
    loop: Ints
    count: int


def corners_of(loops: Sequence[Sequence[int]], side: Ints) -> LoopCorners:
    """Return the corners of loops of gears; `side` is 1 or -1 for each gear, and opposite for meshing gears."""
    rows = [
        (gear, loop[(k + 1) % len(loop)], loop[k - 1], side[gear], at)
        for at, loop in enumerate(loops)
        for k, gear in enumerate(loop)
    ]
    columns = np.array(rows, dtype=np.int64).reshape(-1, 5).T
    return LoopCorners(columns[0], columns[1], columns[2], columns[3], columns[4], len(loops))


@dataclass(frozen=True)
class AxisAdjustment:
    """Adjusted axes, the pitch [radii of the sphere], and the residual at the end and after each step [rad for
    `fit_pitch`, pitch for `fit_phases`].
    """

    axes: Floats
    pitch: float
    residual: float
    residuals: tuple[float, ...]

    @property
    def exact(self) -> bool:
        """True if the conditions are satisfied to rounding."""
        return self.residual < _EXACT


def fit_pitch(axes: Floats, meshes: Meshes, teeth: Ints, pitch: float, seed: int = 0) -> AxisAdjustment:
    """Return axes near the given axes at which all meshes have one pitch, by Levenberg's method with minimum-norm
    steps.

    Solutions are not unique; the fit returns a nearby solution. If the tangencies depend on each other (symmetric
    solids) and the fit fails, it is repeated after random displacements of the axes by a few degrees. If the result is
    not `exact`, no solution was found nearby.
    """
    z = np.asarray(teeth, dtype=float)
    random = np.random.default_rng(seed)
    residuals: list[float] = []
    best: AxisAdjustment | None = None
    for size in _TRIES:
        start = moved(axes, random.normal(size=(len(axes), 2)) * size) if size else axes
        fit = _levenberg(start, meshes, z, pitch, residuals)
        if best is None or fit.residual < best.residual:
            best = fit
        # only a symmetric configuration benefits from a random move
        if best.exact or not tangencies_dependent(axes, meshes):
            break
    assert best is not None
    return AxisAdjustment(best.axes, best.pitch, best.residual, tuple(residuals))


def tangencies_dependent(axes: Floats, meshes: Meshes) -> bool:
    """Return True if the tangencies of cones about these axes are linearly dependent; False, without a test, above 600
    meshes.

    The test computes the rank of the derivative of the angles with respect to the axes and one more unknown, the pitch,
    which changes all cones.
    """
    if len(meshes) > _MOST_DENSE:
        return False
    _, slopes = angle_rows(axes, meshes)
    # numerical rank; one dimension is provided by the pitch
    values = np.linalg.svd(slopes.toarray(), compute_uv=False)
    return bool((values > 1e-9 * values[0]).sum() < len(meshes) - 1)


def _levenberg(axes: Floats, meshes: Meshes, z: Floats, pitch: float, residuals: list[float]) -> AxisAdjustment:
    error, J = tangency(axes, meshes, z, pitch)
    # with almost no damping the first steps are those of Newton's method
    size, damping = float(np.abs(error).max()), 1e-12
    stalled = 0
    for _ in range(_MOST_STEPS):
        step = minimum_step(J, error, damping)
        step *= min(1.0, _LONGEST / max(float(np.abs(step[:-1]).max()), 1e-300))
        tried = moved(axes, step[:-1].reshape(-1, 2))
        # a step may at most halve the pitch, and no gear may exceed a crown gear
        width = min(max(pitch + float(step[-1]), pitch / 2), (1 - 1e-9) / float(z.max()))
        there, slopes = tangency(tried, meshes, z, width)
        new = float(np.abs(there).max())
        better = float(there @ there) < float(error @ error)
        stalled = stalled + 1 if new > 0.9 * size else 0
        if better:
            axes, pitch, error, J, size = tried, width, there, slopes, min(new, size)
        # Levenberg: less damping after a success, more after a failure
        damping = max(damping / 10, 1e-12) if better else damping * 100
        residuals.append(float(np.abs(error).max()))
        # converged to rounding, no further progress, or no descent at any damping
        if size < 1e-15 or stalled > 12 or (stalled and size < 1e-13) or damping > 1e6:
            break
    return AxisAdjustment(axes, pitch, float(np.abs(error).max()), ())


def forecast_spread(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> float:
    """Return the predicted standard deviation of ln lambda after the first step of `fit_phases`."""
    z = np.asarray(teeth, dtype=float)
    sums, J = loop_sums(axes, corners, z)
    logs, A = pitch_rows(axes, meshes, z)
    return float(np.std(logs + A @ phase_step(J, sums - np.round(sums), A, logs - logs.mean(), _PHASE_DAMPING)))


def fit_phases(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> AxisAdjustment:
    """Return axes near the given axes at which all loops close, and the variance of the logarithm of the pitch is
    minimised.

    Newton's method for the loops and the Gauss-Newton method for the pitches share one sparse system. The sum of
    each loop becomes the integer that is nearest to the sum at the given axes.
    """
    z = np.asarray(teeth, dtype=float)
    sums, _ = loop_sums(axes, corners, z)
    # closing integers nearest to the given axes
    target = np.round(sums)
    residuals: list[float] = []
    best = (np.inf, axes)
    for taken in _phase_steps(axes, meshes, z, corners, target, residuals):
        best = taken
    residual, axes = best
    S = mesh_angles(axes, meshes)
    i, j = np.array(meshes).T
    pitch = float(np.exp(np.log(operating_pitch(S, z[i], z[j])).mean()))
    return AxisAdjustment(axes, pitch, residual, tuple(residuals))


def _phase_steps(
    axes: Floats, meshes: Meshes, z: Floats, corners: LoopCorners, target: Floats, residuals: list[float]
) -> Iterator[tuple[float, Floats]]:
    previous = np.inf
    sums, J = loop_sums(axes, corners, z)
    residual = float(np.abs(sums - target).max(initial=0.0))
    yield residual, axes
    for _ in range(_MOST_STEPS):
        logs, A = pitch_rows(axes, meshes, z)
        step = phase_step(J, sums - target, A, logs - logs.mean(), _PHASE_DAMPING)
        longest = float(np.abs(step).max())
        step *= min(1.0, _LONGEST / max(longest, 1e-300))
        axes = moved(axes, step.reshape(-1, 2))
        sums, J = loop_sums(axes, corners, z)
        residual = float(np.abs(sums - target).max(initial=0.0))
        residuals.append(residual)
        yield residual, axes
        # converged, or limited by rounding
        if longest < 1e-12 or (longest < 1e-7 and longest > previous / 2 and residual < 1e-12):
            return
        previous = longest


def phase_step(J: csr_array, error: Floats, A: csr_array, logs: Floats, damping: float) -> Floats:
    """Return the step of a least squares problem with equality constraints, by one sparse Karush-Kuhn-Tucker system.

    The step x satisfies J x = -error and minimises |logs + A x - s|^2 + damping |x|^2 over all x and s.
    """
    from scipy.sparse import block_array, csc_array, eye_array
    from scipy.sparse.linalg import splu

    loops, n = J.shape
    ones = csc_array(np.ones((A.shape[0], 1)))
    system = block_array(
        [
            [A.T @ A + damping * eye_array(n), -A.T @ ones, J.T],
            [-ones.T @ A, ones.T @ ones, None],
            [
                J,
                None,
                -1e-14 * eye_array(loops),
            ],  # loops may depend on each other: a small entry keeps the matrix regular
        ]
    ).tocsc()
    right = np.concatenate([-(A.T @ logs), [float(logs.sum())], -error])
    return np.asarray(splu(system).solve(right)[:n])
