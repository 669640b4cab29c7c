"""Circle packing on the sphere: a circle for each gear and each region of a planar map, tangent or orthogonal.

Every 3-connected planar graph has such a packing, unique up to Moebius maps (Koebe, Andreev, Thurston); the centre
by B. Springborn, Math. Z. 249 (2005) 513.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.spherical.pitch_cones import angle_rows, moved
from geartrain.spherical.planar_packing import PlanarPacking

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_MOST_STEPS = 100  # four or five on usual graphs
_MOST_POLISH = 12  # two or three on usual graphs: the layout is nearly right
_LONGEST = 2.0
"""Largest rapidity of one boost."""


def boost(v: Floats) -> Floats:
    """The Lorentz boost of rapidity |v| along v, acting on (x, t), that moves points of the sphere away from v."""
    rapidity = float(np.linalg.norm(v))
    if rapidity == 0:
        return np.eye(4)
    e = v / rapidity
    made = np.eye(4)
    made[:3, :3] += (np.cosh(rapidity) - 1) * np.outer(e, e)
    made[:3, 3] = made[3, :3] = -np.sinh(rapidity) * e
    made[3, 3] = np.cosh(rapidity)
    return made


def centring_step(points: Floats) -> Floats:
    """Newton's rapidity towards the frame where the points sum to 0: H v = sum p, H = sum (I - p p^T)."""
    H = len(points) * np.eye(3) - points.T @ points
    return np.asarray(np.linalg.solve(H, points.sum(axis=0)), dtype=float)


def pack_circles(gears: int, regions: Sequence[Sequence[int]]) -> SpherePacking:
    """The centred circle packing of a 3-connected planar map.

    regions   the gears round each region, all in the same sense; every mesh lies between two of them
    """
    plane = PlanarPacking(gears, regions)
    u, residuals = plane.radii()
    vectors = plane.layout(u)
    vectors = _centred(vectors, plane.meshes)
    packing = _polished(vectors, gears, plane, residuals)
    # rounding of the polish shifts the centre by as much: once more, from there
    both = np.concatenate([packing.axes, packing.region_axes]), np.concatenate([packing.cones, packing.region_cones])
    return _polished(_upright(_centred(_vectors(*both), plane.meshes), plane.meshes[0]), gears, plane, residuals)


def _vectors(axes: Floats, cones: Floats) -> Floats:
    return np.concatenate([axes, np.cos(cones)[:, None]], axis=1) / np.sin(cones)[:, None]


def _circles(vectors: Floats) -> tuple[Floats, Floats]:
    """Axes and half-angles of circles given as vectors."""
    length = np.linalg.norm(vectors[:, :3], axis=1)
    # the last entry is the cotangent: right for small and for large circles alike
    return vectors[:, :3] / length[:, None], np.arctan2(1.0, vectors[:, 3])


def _centred(vectors: Floats, meshes: Sequence[tuple[int, int]]) -> Floats:
    """Damped Newton's method: the same packing in the frame where the pitch points sum to 0."""
    i, j = np.array(meshes).T
    for _ in range(_MOST_STEPS):
        touch = vectors[i] + vectors[j]
        points = touch[:, :3] / np.linalg.norm(touch[:, :3], axis=1)[:, None]
        v = centring_step(points)
        length = float(np.linalg.norm(v))
        if length < 1e-15:
            break
        v *= min(1.0, _LONGEST / length, _shorter(points, v))
        vectors = vectors @ boost(v)
        if length < 1e-14:
            break
    return vectors


def _upright(vectors: Floats, mesh: tuple[int, int]) -> Floats:
    """The same packing turned so that the first gear of a mesh is at the top and the second beside it along x."""
    axes, _ = _circles(vectors)
    top, side = axes[mesh[0]], axes[mesh[1]]
    x = side - top * (top @ side)
    x /= np.linalg.norm(x)
    turn = np.stack([x, np.cross(top, x), top])
    return np.concatenate([vectors[:, :3] @ turn.T, vectors[:, 3:]], axis=1)


def _shorter(points: Floats, v: Floats) -> float:
    """A share of the step v that lowers the convex function sum log(-<x, (p, 1)>) whose minimum is the centre."""
    share = 1.0
    while share > 1e-6:
        made = boost(share * v)
        if np.log(points @ made[:3, 3] + made[3, 3]).sum() <= 1e-13 * len(points):
            break
        share /= 2
    return share


def _polished(vectors: Floats, gears: int, plane: PlanarPacking, residuals: tuple[float, ...]) -> SpherePacking:
    """Newton's method on all tangencies and right angles at once, until rounding is all that is left."""
    axes, cones = _circles(vectors)
    tangent = [*plane.meshes, *((gears + plane.left[m], gears + plane.left[m[::-1]]) for m in plane.meshes)]
    square = [(gear, region) for gear in range(gears) for region in plane.around[gear]]
    best = (inf, axes, cones)
    for _ in range(_MOST_POLISH):
        size, moves = _newton(axes, cones, tangent + square, len(tangent))
        better, enough = size < best[0], size < 1e-13 and size > best[0] / 4
        if better:
            best = (size, axes, cones)
        if enough or not (better or size > 1e-11):
            break
        axes = moved(axes, moves[: 2 * len(axes)].reshape(-1, 2))
        cones = cones + moves[2 * len(axes) :]
    size, axes, cones = best
    circles = axes[:gears], cones[:gears], axes[gears:], cones[gears:]
    return SpherePacking(*circles, plane.meshes, tuple(plane.regions), size, residuals)


def _newton(axes: Floats, cones: Floats, pairs: Sequence[tuple[int, int]], tangent: int) -> tuple[float, Floats]:
    """Largest error of the angles between circles (rad), and the least change of axes and half-angles against it.

    The first `tangent` pairs touch: S = rho_i + rho_j; the others cross at right angles: cos S = cos rho_i cos rho_j.
    """
    from scipy.sparse import coo_array, eye_array, hstack
    from scipy.sparse.linalg import splu

    i, j = np.array(pairs).T
    touching = np.arange(len(pairs)) < tangent
    S, slopes = angle_rows(axes, pairs)
    want = np.where(touching, cones[i] + cones[j], np.arccos(np.cos(cones[i]) * np.cos(cones[j])))
    error = S - want
    widen = [np.where(touching, 1.0, np.sin(cones[p]) * np.cos(cones[q]) / np.sin(want)) for p, q in ((i, j), (j, i))]
    at = np.tile(np.arange(len(pairs)), 2), np.concatenate([i, j])
    J: Any = hstack([slopes, coo_array((-np.concatenate(widen), at), shape=(len(pairs), len(axes)))], format="csc")
    # Moebius maps leave all angles alone: a little damping takes the least step
    damped = (J.T @ J + 1e-10 * eye_array(J.shape[1])).tocsc()
    return float(np.abs(error).max()), np.asarray(splu(damped).solve(-(J.T @ error)))


@dataclass(frozen=True)
class SpherePacking:
    """Circles on the sphere, centred: the pitch points of all meshes sum to 0.

    axes, cones                of the gears: unit vectors and half-angles (rad)
    region_axes, region_cones  of the regions: circles through the pitch points round each region
    meshes                     pairs of gears
    regions                    gears round each region, counterclockwise from outside
    residual                   largest error of a tangency or right angle (rad)
    residuals                  largest residual (rad) of the radii after each Newton step
    """

    axes: Floats
    cones: Floats
    region_axes: Floats
    region_cones: Floats
    meshes: tuple[tuple[int, int], ...]
    regions: tuple[tuple[int, ...], ...]
    residual: float
    residuals: tuple[float, ...]

    @property
    def pitch_points(self) -> Floats:
        """The points where the gears touch, (meshes, 3)."""
        i, j = np.array(self.meshes).T
        towards = self.axes[i] * np.sin(self.cones[j])[:, None] + self.axes[j] * np.sin(self.cones[i])[:, None]
        return np.asarray(towards / np.linalg.norm(towards, axis=1)[:, None])
