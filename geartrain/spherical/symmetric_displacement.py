"""Displacements of axes that keep the symmetries of a set, and axes for which all meshes have one pitch.

Newton's method solves for equal log lambda, docs/sphere.md (1), with one axis of each orbit as unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


_SOLVED = 1e-13  # residual of a log pitch; rounding of axes leaves about 1e-15
_MOST_STEPS = 60
_LONGEST = 0.2  # largest step [rad]


@dataclass(frozen=True, eq=False)
class SymmetricFreedom:
    """Symmetries of a set of axes, and the displacements of the axes that keep these symmetries."""

    matrices: Floats
    """Orthogonal matrices of the symmetries, shape (order, 3, 3)."""
    images: Ints
    """Index of each gear's image under each symmetry, shape (order, gears)."""

    def orbits(self) -> Ints:
        """Return for each gear the index of the first gear in its orbit."""
        first: Ints = self.images.min(axis=0)
        return first

    def mesh_orbits(self, meshes: Sequence[tuple[int, int]]) -> Ints:
        """Return a number for each mesh; it is equal for meshes that the symmetries map to each other."""
        pairs = np.sort(self.images[:, np.array(meshes, dtype=np.int64).reshape(-1, 2)], axis=2)
        code: Ints = (pairs[..., 0] * self.images.shape[1] + pairs[..., 1]).min(axis=0)
        return code

    def freedom(self, gear: int, axis: Floats) -> Floats:
        """Return an orthonormal basis of the directions in which a gear's axis may move, together with all its images.

        The directions are perpendicular to the axis. Shape (0, 1 or 2, 3): none on an axis of rotation, one on a
        mirror, because the symmetries that fix the gear must fix its direction of motion too.
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
    """Return the axes moved such that every mesh has the same pitch and all symmetries are kept, shape (gears, 3).

    `movable` has the gears that may move, as complete orbits. A pair at an angle S has the operating pitch lambda = sin
    S / sqrt(z_i^2 + z_j^2 + 2 z_i z_j cos S). Newton's method on log lambda and the positions makes the pitches equal
    within 1e-13. Raises `GearTrainError` if it finds no solution near the given axes.
    """
    places = _Places(movement, axes, movable)
    # one equation for each kind of mesh suffices by symmetry
    _, kept = np.unique(movement.mesh_orbits(meshes), return_index=True)
    pairs = np.array(meshes, dtype=np.int64)[kept]
    z = np.array(teeth, dtype=np.float64)[pairs]

    def wrong(unknown: Floats) -> Floats:
        """Return the logarithm of each mesh kind's pitch minus the logarithm of the common pitch."""
        missed: Floats = _log_pitch(places.moved(unknown[:-1])[pairs], z) - unknown[-1]
        return missed

    start = np.zeros(places.free + 1)
    # initial common pitch
    start[-1] = wrong(start).mean()
    unknown, left = _newton(wrong, start)
    if left > _SOLVED:
        raise _refused(len(pairs), places.free, left)
    return places.moved(unknown[:-1])


class _Places:
    """Axes as a function of their free displacements: the first gear of each orbit moves, and the other gears of the
    orbit follow by symmetry.
    """

    def __init__(self, movement: SymmetricFreedom, axes: Floats, movable: Collection[int]) -> None:
        self.axes = axes
        self.orbits = movement.orbits()
        first = [int(gear) for gear in np.unique(self.orbits) if int(gear) in movable]
        self.ways = {gear: movement.freedom(gear, axes[gear]) for gear in first}
        self.free = sum(map(len, self.ways.values()))
        # a symmetry that maps the first gear of an orbit to each other one
        bringing = [int(np.argmax(movement.images[:, head] == gear)) for gear, head in enumerate(self.orbits)]
        self.carry = movement.matrices[bringing]

    def moved(self, positions: Floats) -> Floats:
        base, at = self.axes.copy(), 0
        for gear, ways in self.ways.items():
            base[gear] += positions[at : at + len(ways)] @ ways
            base[gear] /= np.linalg.norm(base[gear])
            at += len(ways)
        result: Floats = np.einsum("gij,gj->gi", self.carry, base[self.orbits])
        return result


def _log_pitch(n: Floats, z: Floats) -> Floats:
    """Return the logarithm of the operating pitch, docs/sphere.md (1).

    Axes `n` have the shape (pairs, 2, 3), tooth numbers `z` the shape (pairs, 2).
    """
    # sine and cosine directly from the axes: the rounding of an intermediate angle would enter the solution
    sine = np.linalg.norm(np.cross(n[:, 0], n[:, 1]), axis=1)
    cosine = (n[:, 0] * n[:, 1]).sum(axis=1)
    pitch: Floats = np.log(sine) - np.log((z**2).sum(axis=1) + 2 * z.prod(axis=1) * cosine) / 2
    return pitch


def _newton(wrong: Callable[[Floats], Floats], unknown: Floats) -> tuple[Floats, float]:
    """Return the solution of wrong(unknown) = 0 by minimum-norm Newton steps with a step limit and backtracking.

    The result has the unknowns and the maximum residual.
    """
    residual = wrong(unknown)
    for _ in range(_MOST_STEPS):
        # singular values below 1e-9 are noise of the finite differences
        step = -np.linalg.lstsq(_slopes(wrong, unknown), residual, rcond=1e-9)[0]
        step *= min(1.0, _LONGEST / max(float(np.abs(step[:-1]).max(initial=0.0)), 1e-300))
        # written with `not`, so that NaN outside the domain counts as no descent
        while np.abs(step).max() > 1e-16 and not np.linalg.norm(wrong(unknown + step)) < np.linalg.norm(residual):
            step = step / 2
        if np.abs(step).max() <= 1e-16:
            break
        unknown = unknown + step
        residual = wrong(unknown)
    return unknown, float(np.abs(residual).max(initial=0.0))


def _slopes(wrong: Callable[[Floats], Floats], unknown: Floats) -> Floats:
    # central differences: a step of 1e-5 gives slopes to 1e-10, enough because Newton's steps are self-correcting
    apart = 1e-5 * np.eye(len(unknown))
    return np.array([(wrong(unknown + d) - wrong(unknown - d)) / 2e-5 for d in apart]).T


def _refused(kinds: int, free: int, left: float) -> GearTrainError:
    why = f"{kinds} kinds of mesh must have one pitch, and the symmetries leave {free} positions free"
    return GearTrainError(
        Problem(
            "no axes with one pitch for all meshes were found near the solid's own axes",
            f"{why}; the best approximation deviates by up to {100 * left:.3g} %",
            "change the tooth numbers, or omit exact=True to keep the axes of faces and vertices",
        )
    )
