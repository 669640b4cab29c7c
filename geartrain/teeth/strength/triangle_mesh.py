"""Triangles inside a polygon, fine where it matters: Delaunay's triangulation of graded points (scipy)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Integers = NDArray[np.int64]

Spacing = Callable[["Floats"], "Floats"]
"""The length of an edge wanted at each of (n, 2) points."""

_OFF = 0.65  # of the spacing: how near to the border a point inside may lie
_FLAT = 1e-3  # of an equilateral triangle's height: flatter ones are left out


def triangles(polygon: Floats, spacing: Spacing, kept: Floats) -> tuple[Floats, Integers]:
    """Points (n, 2) and triangles (m, 3) that fill a polygon (k, 2).

    No point inside lies in the circle over an edge of the border as its diameter, so that the border's edges are
    Delaunay's (Gabriel graph). `kept` are points of the border that stay as they are, such as where a load acts.
    """
    from scipy.spatial import Delaunay, cKDTree

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
    """Which points lie in a polygon: a ray to the right crosses its border an odd number of times."""
    x, y = points.T
    found = np.zeros(len(points), dtype=bool)
    for (x1, y1), (x2, y2) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y1 == y2:
            continue
        across = (y1 > y) != (y2 > y)
        found ^= across & (x < (x2 - x1) * (y - y1) / (y2 - y1) + x1)
    return found


def _border(polygon: Floats, spacing: Spacing, kept: Floats) -> Floats:
    """The border again, its edges as long as wanted; corners and kept points stay."""
    closed = np.concatenate((polygon, polygon[:1]))
    s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))))
    fixed = np.union1d(s[_corners(polygon)], [_along(closed, s, point) for point in kept])
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


def _corners(polygon: Floats) -> Integers:
    """Points at which a polygon turns by more than some 15 degrees."""
    ahead, behind = np.roll(polygon, -1, axis=0) - polygon, polygon - np.roll(polygon, 1, axis=0)
    turn = np.arctan2(_cross(behind, ahead), (behind * ahead).sum(axis=1))
    return np.flatnonzero(np.abs(turn) > 0.25)


def _along(closed: Floats, s: Floats, point: Floats) -> float:
    """Length along a closed line of its place next to a point."""
    start, edge = closed[:-1], np.diff(closed, axis=0)
    share = np.clip(((point - start) * edge).sum(axis=1) / (edge * edge).sum(axis=1), 0, 1)
    off = np.hypot(*(start + share[:, None] * edge - point).T)
    at = int(np.argmin(off))
    return float(s[at] + share[at] * (s[at + 1] - s[at]))


def _dense(border: Floats) -> Floats:
    """Eight points on each edge."""
    ahead = np.roll(border, -1, axis=0)
    return np.concatenate([border + (ahead - border) * k / 8 for k in range(8)])


def _graded(border: Floats, spacing: Spacing) -> Floats:
    """Centres of squares that are halved until each is as small as is wanted there."""
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
