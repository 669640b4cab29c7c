"""Adjustment of gear axes until all meshes have the same pitch (Levenberg's method), optionally with the symmetries of
a solid, or until all loops close (Newton's method).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.spherical.pitch_cones import angle_rows, azimuth_rows, azimuths, moved, operating_pitch

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from geartrain.numerics.arrays import Floats, Ints


Meshes = Sequence[tuple[int, int]]
_MOST_STEPS = 80  # maximum number of steps of either method
_EXACT = 1e-11
"""Maximum difference between the logarithms of two pitches that are considered equal; rounding causes about 1e-15."""
_TRIES = (0.0, 0.01, 0.02, 0.04, 0.08)
"""Standard deviations of the random displacements that break the symmetry of a set [rad], one per trial."""
_MOST_RETRIED = 600  # meshes; five fits of larger sets take more than a few seconds
_SOLVED = 1e-13  # residual of a log pitch; rounding of axes leaves about 1e-15
_PHASE_DAMPING = 1e-4  # keeps axes that neither loops nor pitches determine
_LONGEST = 0.1
"""Maximum displacement of an axis in one step [rad]."""


def loop_sums(axes: Floats, corners: LoopCorners, teeth: Floats) -> tuple[Floats, csr_array]:
    """Return the sum of (-1)^k z_k alpha_k / (2 pi) over the gears k of every loop [pitch], and its derivative with
    respect to displacements of the axes. Here z_k is the tooth number, and alpha_k the angle at gear k from its next to
    its previous contact, counterclockwise, from 0 to 2 pi [rad].
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
    """Return the logarithm of the operating pitch of every mesh, and its derivative with respect to displacements
    of the axes.

    The pitch lambda depends on the angle S between the axes and the tooth numbers z_i and z_j: d ln lambda / dS = cot S
    + z_i z_j sin S / (z_i^2 + z_j^2 + 2 z_i z_j cos S).
    """
    from scipy.sparse import diags_array

    S, slopes = angle_rows(axes, meshes)
    i, j = np.array(meshes).T
    a, b = teeth[i], teeth[j]
    steep = 1 / np.tan(S) + a * b * np.sin(S) / (a**2 + b**2 + 2 * a * b * np.cos(S))
    return np.log(operating_pitch(S, a, b)), (diags_array(steep) @ slopes).tocsr()


def minimum_step(J: csr_array, error: Floats, damping: float) -> Floats:
    """Return the step x that minimises |x|^2 + |error + J x|^2 / damping, where J is the Jacobian of `error`. As
    `damping` tends to 0, the step tends to the minimum-norm solution of J x = -error.
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
    """Contacts of the gears in loops, as arrays of equal length: gear, next gear, previous gear, sense of rotation, and
    index of the loop. `count` is the number of loops.
    """

    gear: Ints
    following: Ints
    before: Ints
    sign: Ints
    loop: Ints
    count: int


def corners_of(loops: Sequence[Sequence[int]], side: Ints) -> LoopCorners:
    """Return the contacts of the gears in loops; `side` is the sense of rotation of each gear, 1 or -1."""
    rows = [
        (gear, loop[(k + 1) % len(loop)], loop[k - 1], side[gear], at)
        for at, loop in enumerate(loops)
        for k, gear in enumerate(loop)
    ]
    columns = np.array(rows, dtype=np.int64).reshape(-1, 5).T
    return LoopCorners(columns[0], columns[1], columns[2], columns[3], columns[4], len(loops))


def fit_pitch(axes: Floats, meshes: Meshes, teeth: Ints) -> tuple[Floats, list[float]]:
    """Return axes near the given axes for which all meshes have the same pitch, and the residual after each step.

    Solutions are not unique; a nearby solution is returned. A symmetric set may have no solution with this symmetry, so
    a fit that fails is repeated after random displacements of the axes by a few degrees. If the residual of the
    returned axes exceeds rounding errors, no solution was found nearby.
    """
    random = np.random.default_rng(0)
    history: list[float] = []
    best = (np.inf, axes)
    for size in _TRIES:
        start = moved(axes, random.normal(size=(len(axes), 2)) * size) if size else axes
        fitted, residuals = equalise_pitch(start, meshes, np.asarray(teeth, dtype=float))
        history += residuals
        if residuals[-1] < best[0]:
            best = residuals[-1], fitted
        if best[0] < _EXACT or len(meshes) > _MOST_RETRIED:
            break
    return best[1], history


def equalise_pitch(
    axes: Floats, meshes: Meshes, teeth: Floats, movable: Collection[int] | None = None
) -> tuple[Floats, list[float]]:
    """Return axes for which the variance of the logarithm of the pitch has a local minimum, found by Levenberg's method
    with minimum-norm steps, and the residual after each step.

    Minimum-norm steps keep all symmetries of the set. The residual is the maximum of |ln(pitch / mean pitch)| [1].

    movable   gears whose axes may move; by default all gears
    """
    from scipy.sparse import csr_array, diags_array, hstack

    # a frozen axis has derivatives 0
    free = np.repeat([movable is None or gear in movable for gear in range(len(axes))], 2).astype(float)
    level = csr_array(np.full((len(meshes), 1), -1.0))
    logs, rows = pitch_rows(axes, meshes, teeth)
    error = logs - logs.mean()
    residuals = [float(np.abs(error).max())]
    # with almost no damping the first steps are those of Newton's method
    damping, stalled = 1e-12, 0
    for _ in range(_MOST_STEPS):
        J = hstack([rows @ diags_array(free), level], format="csr")
        step = minimum_step(J, error, damping)[:-1]
        step *= min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300))
        tried = moved(axes, step.reshape(-1, 2))
        logs, slopes = pitch_rows(tried, meshes, teeth)
        there = logs - logs.mean()
        stalled = stalled + 1 if np.abs(there).max() > 0.9 * residuals[-1] else 0
        better = float(there @ there) < float(error @ error)
        if better:
            axes, error, rows = tried, there, slopes
        # Levenberg: less damping after a success, more after a failure
        damping = max(damping / 10, 1e-12) if better else damping * 100
        residuals.append(float(np.abs(error).max()))
        # converged to rounding, no further progress, or no descent at any damping
        if residuals[-1] < 1e-15 or stalled > 12 or (stalled and residuals[-1] < 1e-13) or damping > 1e6:
            break
    return axes, residuals


def forecast_spread(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> float:
    """Return the predicted standard deviation of the log pitch after the first step of `fit_phases` [1]."""
    z = np.asarray(teeth, dtype=float)
    sums, J = loop_sums(axes, corners, z)
    logs, A = pitch_rows(axes, meshes, z)
    return float(np.std(logs + A @ phase_step(J, sums - np.round(sums), A, logs - logs.mean())))


def fit_phases(axes: Floats, meshes: Meshes, teeth: Ints, corners: LoopCorners) -> tuple[Floats, list[float]]:
    """Return axes near the given axes for which all loops close and the variance of the logarithm of the pitch is
    minimal. Also return the maximum closing error after each step [pitch].

    Newton's method for the loops and the Gauss-Newton method for the pitches use the same sparse system. The final sum
    of each loop is the integer that is nearest to the sum for the given axes.
    """
    z = np.asarray(teeth, dtype=float)
    sums, J = loop_sums(axes, corners, z)
    target = np.round(sums)
    residuals: list[float] = []
    previous = np.inf
    for _ in range(_MOST_STEPS):
        logs, A = pitch_rows(axes, meshes, z)
        step = phase_step(J, sums - target, A, logs - logs.mean())
        longest = float(np.abs(step).max())
        step *= min(1.0, _LONGEST / max(longest, 1e-300))
        axes = moved(axes, step.reshape(-1, 2))
        sums, J = loop_sums(axes, corners, z)
        residuals.append(float(np.abs(sums - target).max(initial=0.0)))
        # converged, or limited by rounding
        if longest < 1e-12 or (longest < 1e-7 and longest > previous / 2 and residuals[-1] < 1e-12):
            break
        previous = longest
    return axes, residuals


def phase_step(J: csr_array, error: Floats, A: csr_array, logs: Floats) -> Floats:
    """Return the step x that satisfies J x = -error and minimises |logs + A x - s|^2 + 1e-4 |x|^2 over all x and s, by
    one sparse Karush-Kuhn-Tucker system. The vector `error` contains the closing errors of the loops, and `logs` the
    logarithms of the pitches; J and A are their Jacobians.
    """
    from scipy.sparse import block_array, csc_array, eye_array
    from scipy.sparse.linalg import splu

    loops, n = J.shape
    ones = csc_array(np.ones((A.shape[0], 1)))
    system = block_array(
        [
            [A.T @ A + _PHASE_DAMPING * eye_array(n), -A.T @ ones, J.T],
            [-ones.T @ A, ones.T @ ones, None],
            # loops may depend on each other: a small entry keeps the matrix regular
            [J, None, -1e-14 * eye_array(loops)],
        ]
    ).tocsc()
    right = np.concatenate([-(A.T @ logs), [float(logs.sum())], -error])
    return np.asarray(splu(system).solve(right)[:n])


# --------------------------------------------------------------------------------------------- sets with symmetries


@dataclass(frozen=True, eq=False)
class SymmetricFreedom:
    """Symmetries of a set of axes, and the displacements of the axes that keep these symmetries."""

    matrices: Floats
    """Orthogonal matrices of the symmetries, shape (order, 3, 3)."""
    images: Ints
    """Index of the image of each gear under each symmetry, shape (order, gears)."""

    def orbits(self) -> Ints:
        """Return for each gear the index of the first gear in its orbit."""
        first: Ints = self.images.min(axis=0)
        return first

    def mesh_orbits(self, meshes: Sequence[tuple[int, int]]) -> Ints:
        """Return a number for each mesh, which is equal for meshes that the symmetries map to each other."""
        pairs = np.sort(self.images[:, np.array(meshes, dtype=np.int64).reshape(-1, 2)], axis=2)
        code: Ints = (pairs[..., 0] * self.images.shape[1] + pairs[..., 1]).min(axis=0)
        return code

    def freedom(self, gear: int, axis: Floats) -> Floats:
        """Return an orthonormal basis of the directions in which a gear's axis may move if all its images move too.

        The directions are perpendicular to the axis. The symmetries that fix the gear must also fix its direction of
        motion, so there are none on an axis of rotation, one on a mirror, and otherwise two. The shape is (0, 1 or 2,
        3).
        """
        # mean over the stabiliser: the projection onto its fixed vectors
        kept = self.matrices[self.images[:, gear] == gear].mean(axis=0) - np.outer(axis, axis)
        values, vectors = np.linalg.eigh((kept + kept.T) / 2)
        # the mean over a group of matrices is a projection: eigenvalues 0 and 1, but for rounding
        free: Floats = vectors[:, values > 0.5].T
        return free


def equal_pitch(
    movement: SymmetricFreedom,
    axes: Floats,
    meshes: Sequence[tuple[int, int]],
    teeth: Sequence[int],
    movable: Collection[int],
) -> Floats:
    """Return the axes, moved so that every mesh has the same pitch and all symmetries are kept, shape (gears, 3).

    movable   indices of the gears that may move, as complete orbits

    The logarithms of the pitches are equal within 1e-13. Raises `GearTrainError` if no solution is found near the given
    axes.
    """
    z = np.asarray(teeth, dtype=float)
    moved_axes, _ = equalise_pitch(axes, meshes, z, movable)
    # the mean over all symmetries has no rounding errors that break them
    mean = np.einsum("sgi,sij->gj", moved_axes[movement.images], movement.matrices) / len(movement.matrices)
    found = np.asarray(mean / np.linalg.norm(mean, axis=1)[:, None])
    logs, _ = pitch_rows(found, meshes, z)
    left = float(np.abs(logs - logs.mean()).max())
    if left > _SOLVED:
        kinds = len(np.unique(movement.mesh_orbits(meshes)))
        first = [int(gear) for gear in np.unique(movement.orbits()) if int(gear) in movable]
        free = sum(len(movement.freedom(gear, axes[gear])) for gear in first)
        what = "no axes with the same pitch for all meshes were found near the axes of the solid"
        why = (
            f"{kinds} kinds of mesh must have the same pitch, and the symmetries leave {free} free parameters of the "
            f"axes; the best approximation deviates by up to {100 * left:.3g} %"
        )
        fix = "change the tooth numbers, or omit exact=True to keep the axes of faces and vertices"
        raise GearTrainError(Problem(what, why, fix))
    return found
