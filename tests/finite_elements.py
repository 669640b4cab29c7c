"""Stress at the root of a tooth by plane finite elements on its outline (scikit-fem), a reference for Lewis's formula.

The plate is divided into triangles by the Delaunay triangulation (scipy) of points that are denser near the root.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial import Delaunay, cKDTree

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats, Integers = NDArray[np.float64], NDArray[np.int64]

Spacing = Callable[["Floats"], "Floats"]
"""Function that gives the required edge length at each of (n, 2) points."""

_DEEP = 2.5  # modules under the root circle, where the rim is held
_ROOT = 0.35  # of the height of a tooth: where its root ends
_COARSE = 0.1  # modules: longest edge
_GRADE = 0.05  # by how much an edge grows with the distance from where it is fine
FINE = 0.03
"""Edge length at the root [modules]; coarser edges change stresses by less than 1 in 200."""


def root_stress_factor(side: Any, z: float, load: Any, poisson: float, fine: float = FINE) -> float:
    """Return the maximum tension along the fillet of the loaded side, divided by torque/(width module^2).

    See docs/strength.md, section 6. Three teeth on a rim that is clamped inside and at its ends; plane stress,
    quadratic triangles; Young's modulus cancels.
    """
    polygon, root = _sector(side, z)
    spot = load.radius * np.array([cos(half := side.half(load.radius)), sin(half)])
    # the force presses the loaded side, y > 0, down and towards the root
    way = np.array([-side.outward * sin(load.angle), -cos(load.angle)])
    force = way / (load.apex * cos(load.angle))  # of a torque of 1
    held = _Held(side, z)
    return plane_stress(polygon, spot, force, root, held, poisson, fine)


class _Held:
    """The clamped part of the rim: its inner circle and both of its cuts."""

    def __init__(self, side: Any, z: float) -> None:
        self.radius = side.root - side.outward * _DEEP
        self.angle = 3 * pi / z

    def __call__(self, points: Floats) -> Floats:
        """Return True for each of the (2, n) points that is clamped."""
        radius, angle = np.hypot(*points), np.arctan2(points[1], points[0])
        found = np.abs(radius - self.radius) < 1e-2
        found |= np.abs(np.abs(angle) - self.angle) * radius < 1e-6
        return np.asarray(found)


def _sector(side: Any, z: float) -> tuple[Floats, Floats]:
    """Return three teeth on their rim, anticlockwise, and the fillet at the loaded side of the middle tooth."""
    half = side.points[side.points[:, 1] > 1e-9]
    r, angle = np.hypot(*half.T), np.arctan2(half[:, 1], half[:, 0])
    pitch = pi / z
    r, angle = np.append(r, side.root), np.append(np.minimum(angle, pitch), pitch)
    tooth = np.concatenate((np.stack([r, -angle])[:, ::-1], np.stack([r, angle])), axis=1)
    whole = np.concatenate([tooth + np.array([[0.0], [k * 2 * pitch]]) for k in (-1, 0, 1)], axis=1)
    inner = side.root - side.outward * _DEEP
    back = np.linspace(3 * pitch, -3 * pitch, 61)
    radius, azimuth = np.append(whole[0], np.full(61, inner)), np.append(whole[1], back)
    points = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth)], axis=1)
    apart = np.hypot(*(points - np.roll(points, 1, axis=0)).T) > 1e-6
    deep = np.abs(r - side.root) < _ROOT * abs(side.tip - side.root)
    round_ = np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)[deep]
    return points[apart], round_


def plane_stress(
    polygon: Floats, spot: Floats, force: Floats, stretch: Floats, held: Any, poisson: float, fine: float
) -> float:
    """Return the maximum tension along the border near `stretch` (n, 2) of a plate of unit thickness under a point
    force.

    polygon   (k, 2); `held` returns which points (2, n) do not move
    """
    import skfem
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    near = cKDTree(stretch)

    def spacing(points: Floats) -> Floats:
        far = np.minimum(near.query(points)[0], 2 * np.hypot(*(points - spot).T))
        return np.asarray(np.minimum(fine + _GRADE * far, _COARSE))

    points, cells = triangles(polygon, spacing, spot[None, :])
    mesh = skfem.MeshTri(points.T, cells.T)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP2()))
    lam, mu = lame_parameters(1.0, poisson)
    plane = 2 * lam * mu / (lam + 2 * mu)  # of plane stress
    stiffness = linear_elasticity(plane, mu).assemble(basis)
    load = np.zeros(basis.N)
    kink = int(np.argmin(np.hypot(*(mesh.p.T - spot).T)))
    load[basis.nodal_dofs[:, kink]] = force
    fixed = basis.get_dofs(lambda x: held(x))
    moved = skfem.solve(*skfem.condense(stiffness, load, D=fixed))
    return _tension(skfem, mesh, basis, moved, (plane, mu), near, 2 * fine)


def _tension(
    skfem: Any, mesh: Any, basis: Any, moved: Floats, lame: tuple[float, float], near: Any, reach: float
) -> float:
    """Return the maximum stress along the border near some points."""
    facets = mesh.boundary_facets()
    middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    facets = facets[near.query(middle.T)[0] < reach]
    border = skfem.FacetBasis(mesh, basis.elem, facets=facets)
    grad = border.interpolate(moved).grad
    strain = (grad + np.swapaxes(grad, 0, 1)) / 2
    plane, mu = lame
    trace = strain[0, 0] + strain[1, 1]
    stress = 2 * mu * strain
    stress[0, 0] += plane * trace
    stress[1, 1] += plane * trace
    tangent = np.stack([-border.normals[1], border.normals[0]])
    along = np.einsum("iqk,ijqk,jqk->qk", tangent, stress, tangent) if stress.ndim == 4 else None
    assert along is not None
    return float(along.max())


_OFF = 0.65  # of the spacing: how near to the border a point inside may lie
_FLAT = 1e-3  # of an equilateral triangle's height: flatter ones are left out


def triangles(polygon: Floats, spacing: Spacing, kept: Floats) -> tuple[Floats, Integers]:
    """Return points (n, 2) and triangles (m, 3) that fill a polygon (k, 2).

    No interior point is inside the circle that has an edge of the border as its diameter, so that the edges of the
    border are Delaunay edges (Gabriel graph). `kept` are points of the border that do not move, such as the point of a
    load.
    """
    border = _border(polygon, spacing, kept)
    inner = _graded(border, spacing)
    inner = inner[inside(border, inner)]
    near, _ = cKDTree(_dense(border)).query(inner)
    inner = inner[near > _OFF * spacing(inner)]
    points = np.concatenate((border, inner))
    found = np.asarray(Delaunay(points).simplices, dtype=np.int64)
    a, b, c = (points[found[:, k]] for k in range(3))
    area = _cross(b - a, c - a) / 2
    longest = np.max([np.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    good = (np.abs(area) > _FLAT * longest**2) & inside(border, (a + b + c) / 3)
    found = found[good]
    used, found = np.unique(found, return_inverse=True)
    return points[used], found.reshape(-1, 3)


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def inside(polygon: Floats, points: Floats) -> NDArray[np.bool_]:
    """Return which points are inside a polygon: a ray to the right crosses its border an odd number of times."""
    x, y = points.T
    found = np.zeros(len(points), dtype=bool)
    for (x1, y1), (x2, y2) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y1 == y2:
            continue
        across = (y1 > y) != (y2 > y)
        found ^= across & (x < (x2 - x1) * (y - y1) / (y2 - y1) + x1)
    return found


def _border(polygon: Floats, spacing: Spacing, kept: Floats) -> Floats:
    """Return the border divided into edges of the required length; corners and kept points remain."""
    closed = np.concatenate((polygon, polygon[:1]))
    s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))))
    fixed = np.union1d(s[_kinks(polygon)], [_along(closed, s, point) for point in kept])
    fixed = fixed[fixed < s[-1] - 1e-9]
    found = []
    for start, end in zip(fixed, [*fixed[1:], fixed[0] + s[-1]], strict=True):
        fine = np.linspace(start, end, 2001)
        where = fine % s[-1]
        places = np.stack([np.interp(where, s, closed[:, k]) for k in range(2)], axis=1)
        cost = np.concatenate(([0.0], np.cumsum(np.diff(fine) / spacing(places)[1:])))
        count = max(int(np.ceil(cost[-1])), 1)
        at = np.interp(np.arange(count) * cost[-1] / count, cost, fine) % s[-1]
        found.append(np.stack([np.interp(at, s, closed[:, k]) for k in range(2)], axis=1))
    return np.concatenate(found)


def _kinks(polygon: Floats) -> Integers:
    """Return the points at which a polygon turns by more than about 15 degrees."""
    ahead, behind = np.roll(polygon, -1, axis=0) - polygon, polygon - np.roll(polygon, 1, axis=0)
    turn = np.arctan2(_cross(behind, ahead), (behind * ahead).sum(axis=1))
    return np.flatnonzero(np.abs(turn) > 0.25)


def _along(closed: Floats, s: Floats, point: Floats) -> float:
    """Return the position along a closed line that is nearest to a point."""
    start, edge = closed[:-1], np.diff(closed, axis=0)
    share = np.clip(((point - start) * edge).sum(axis=1) / (edge * edge).sum(axis=1), 0, 1)
    off = np.hypot(*(start + share[:, None] * edge - point).T)
    at = int(np.argmin(off))
    return float(s[at] + share[at] * (s[at + 1] - s[at]))


def _dense(border: Floats) -> Floats:
    """Return eight points on each edge."""
    ahead = np.roll(border, -1, axis=0)
    return np.concatenate([border + (ahead - border) * k / 8 for k in range(8)])


def _graded(border: Floats, spacing: Spacing) -> Floats:
    """Return the centres of squares that are halved until each is as small as required at its place."""
    low, high = border.min(axis=0), border.max(axis=0)
    size = float((high - low).max()) / 4
    counts = np.ceil((high - low) / size).astype(int)
    grid = np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), axis=-1).reshape(-1, 2)
    squares = low + (grid + 0.5) * size
    found = []
    while len(squares):
        small = size <= spacing(squares)
        found.append(squares[small])
        rest, size = squares[~small], size / 2
        squares = np.concatenate([rest + size / 2 * np.array(way) for way in ((1, 1), (1, -1), (-1, 1), (-1, -1))])
    points = np.concatenate(found)
    # a little off the lattice, for four points on a circle have no one triangulation
    return points + np.random.default_rng(1).uniform(-1, 1, points.shape) * (0.05 * spacing(points))[:, None]
