"""Axes moved a little until all meshes have one pitch (Levenberg's method), or all loops close (Newton's)."""

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
_MOST_STEPS = 80  # of either method
_EXACT = 1e-11
"""Residual (rad, or pitches) under which a fit counts as exact: rounding leaves about 1e-15."""
_TRIES = (0.0, 0.01, 0.02, 0.04, 0.08)
"""Random moves (rad) that break a symmetry at which the tangencies are not independent."""
_MOST_DENSE = 600  # meshes: a dense singular value decomposition grows with the cube of their number
_PHASE_DAMPING = 1e-4  # keeps axes where neither loops nor pitches ask for a move
_LONGEST = 0.1
"""Largest move of an axis in one step (rad)."""


def tangency(axes: Floats, meshes: Meshes, teeth: Floats, pitch: float) -> tuple[Floats, csr_array]:
    """S_ij - asin(l z_i) - asin(l z_j) of every mesh (rad), and its derivative by axes and pitch l.

    Columns: two steps of each axis along its `frames`, then the pitch (radii of the sphere). Teeth may be any
    positive numbers: with teeth = sin rho and pitch 1 this is the tangency of pitch cones.
    """
    from scipy.sparse import csr_array as sparse
    from scipy.sparse import hstack

    S, slopes = angle_rows(axes, meshes)
    i, j = np.array(meshes).T
    # short of a crown gear, where the slope of the arc sine is infinite
    sine = np.minimum(pitch * teeth, 1 - 1e-9)
    widen = -teeth / np.sqrt(1 - sine**2)
    cones = np.arcsin(sine)
    J = hstack([slopes, sparse((widen[i] + widen[j])[:, None])], format="csr")
    return S - cones[i] - cones[j], J


def loop_sums(axes: Floats, corners: LoopCorners, teeth: Floats) -> tuple[Floats, csr_array]:
    """sum (-1)^k z_k alpha_k / 2 pi of every loop (pitches), and its derivative by the steps of the axes.

    alpha_k in (0, 2 pi) is the angle at gear k from its next to its previous contact, counterclockwise.
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
    """ln of the operating pitch of every mesh, and its derivative by the steps of the axes.

    d ln lambda / dS = cot S + z_i z_j sin S / (z_i^2 + z_j^2 + 2 z_i z_j cos S).
    """
    from scipy.sparse import diags_array

    S, slopes = angle_rows(axes, meshes)
    i, j = np.array(meshes).T
    a, b = teeth[i], teeth[j]
    steep = 1 / np.tan(S) + a * b * np.sin(S) / (a**2 + b**2 + 2 * a * b * np.cos(S))
    return np.log(operating_pitch(S, a, b)), (diags_array(steep) @ slopes).tocsr()


def minimum_step(J: csr_array, error: Floats, damping: float) -> Floats:
    """The step x of least |x|^2 + |error + J x|^2 / damping: least norm among all solutions as damping goes to 0."""
    from scipy.sparse import block_array, eye_array
    from scipy.sparse.linalg import splu

    m, n = J.shape
    # bordered, not J J^T + damping: that would be squared in condition, and full
    system = block_array([[eye_array(n), J.T], [J, -damping * eye_array(m)]], format="csc")
    # the column of the pitch is full: an ordering for symmetric matrices puts it last
    factor = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True})
    return np.asarray(factor.solve(np.concatenate([np.zeros(n), -error]))[:n])


@dataclass(frozen=True)
class LoopCorners:
    """The corners of loops, as arrays: the gear, its next and previous contact, its sign, and the loop it is in."""

    gear: Ints
    following: Ints
    before: Ints
    sign: Ints
    loop: Ints
    count: int


def corners_of(loops: Sequence[Sequence[int]], side: Ints) -> LoopCorners:
    """The corners of loops of gears; `side` is +1 or -1 for each gear, meshing gears having opposite signs."""
    rows = [
        (gear, loop[(k + 1) % len(loop)], loop[k - 1], side[gear], at)
        for at, loop in enumerate(loops)
        for k, gear in enumerate(loop)
    ]
    columns = np.array(rows, dtype=np.int64).reshape(-1, 5).T
    return LoopCorners(columns[0], columns[1], columns[2], columns[3], columns[4], len(loops))


@dataclass(frozen=True)
class AxisAdjustment:
    """Axes after a fit, the pitch (radii of the sphere), what is left of the conditions, now and after each step."""

    axes: Floats
    pitch: float
    residual: float
    residuals: tuple[float, ...]

    @property
    def exact(self) -> bool:
        """True if the conditions hold to rounding."""
        return self.residual < _EXACT


def fit_pitch(axes: Floats, meshes: Meshes, teeth: Ints, pitch: float, seed: int = 0) -> AxisAdjustment:
    """Levenberg's method with steps of least norm: axes near the given ones at which all meshes have one pitch.

    Solutions are not unique: these are near ones. Where the tangencies depend on each other (symmetric solids) and
    that finds none, the axes are first moved at random, by a few degrees; a fit that is not `exact` found none near.
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
        if best.exact or not tangencies_dependent(axes, meshes):
            break
    assert best is not None
    return AxisAdjustment(best.axes, best.pitch, best.residual, tuple(residuals))


def tangencies_dependent(axes: Floats, meshes: Meshes) -> bool:
    """Whether the tangencies of cones about these axes depend on each other; False, not asked, above 600 meshes.

    The rows of the angles' derivative by axes and by one more unknown, the pitch, which widens all cones.
    """
    if len(meshes) > _MOST_DENSE:
        return False
    _, slopes = angle_rows(axes, meshes)
    values = np.linalg.svd(slopes.toarray(), compute_uv=False)
    return bool((values > 1e-9 * values[0]).sum() < len(meshes) - 1)


def _levenberg(axes: Floats, meshes: Meshes, z: Floats, pitch: float, residuals: list[float]) -> AxisAdjustment:
    error, J = tangency(axes, meshes, z, pitch)
    size, damping = float(np.abs(error).max()), 1e-12
    stalled = 0
    for _ in range(_MOST_STEPS):
        step = minimum_step(J, error, damping)
        step *= min(1.0, _LONGEST / max(float(np.abs(step[:-1]).max()), 1e-300))
        tried = moved(axes, step[:-1].reshape(-1, 2))
        # a step may halve the pitch at most, and make no gear larger than a crown gear
        width = min(max(pitch + float(step[-1]), pitch / 2), (1 - 1e-9) / float(z.max()))
        there, slopes = tangency(tried, meshes, z, width)
        new = float(np.abs(there).max())
        better = float(there @ there) < float(error @ error)
        stalled = stalled + 1 if new > 0.9 * size else 0
        if better:
            axes, pitch, error, J, size = tried, width, there, slopes, min(new, size)
        damping = max(damping / 10, 1e-12) if better else damping * 100
        residuals.append(float(np.abs(error).max()))
        if size < 1e-15 or stalled > 12 or (stalled and size < 1e-13) or damping > 1e6:
            break
    return AxisAdjustment(axes, pitch, float(np.abs(error).max()), ())


def forecast_spread(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> float:
    """Standard deviation of ln lambda that the first step of `fit_phases` promises."""
    z = np.asarray(teeth, dtype=float)
    sums, J = loop_sums(axes, corners, z)
    logs, A = pitch_rows(axes, meshes, z)
    return float(np.std(logs + A @ phase_step(J, sums - np.round(sums), A, logs - logs.mean(), _PHASE_DAMPING)))


def fit_phases(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> AxisAdjustment:
    """Axes near the given ones at which all loops close, with the least variance of the logarithm of the pitch.

    Newton on the loops, Gauss and Newton on the pitches, in one sparse system; the integers of the loops are those
    next to the axes given.
    """
    z = np.asarray(teeth, dtype=float)
    sums, _ = loop_sums(axes, corners, z)
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
        if longest < 1e-12 or (longest < 1e-7 and longest > previous / 2 and residual < 1e-12):
            return
        previous = longest


def phase_step(J: csr_array, error: Floats, A: csr_array, logs: Floats, damping: float) -> Floats:
    """Least squares under equality constraints, their multipliers in one sparse system (Karush, Kuhn and Tucker).

    The step x with J x = -error and the least |logs + A x - s|^2 + damping |x|^2, over all x and s.
    """
    from scipy.sparse import block_array, csc_array, eye_array
    from scipy.sparse.linalg import splu

    loops, n = J.shape
    ones = csc_array(np.ones((A.shape[0], 1)))
    system = block_array(
        [
            [A.T @ A + damping * eye_array(n), -A.T @ ones, J.T],
            [-ones.T @ A, ones.T @ ones, None],
            [J, None, -1e-14 * eye_array(loops)],  # loops may depend on each other: not quite 0 keeps it regular
        ]
    ).tocsc()
    right = np.concatenate([-(A.T @ logs), [float(logs.sum())], -error])
    return np.asarray(splu(system).solve(right)[:n])
