"""Triangles that fill a polygon with holes: ears cut off one by one, holes first joined to the outside by bridges."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

_FLAT = 1e-12  # twice the area (mm2) of a triangle that is none


def fill(outer: Floats, holes: Sequence[Floats] = ()) -> tuple[Floats, Integers]:
    """Points (n, 2), those given in their order, and triangles (m, 3) of them, counter-clockwise.

    Polygons (k, 2) do not cross themselves or each other, whichever way they go round.
    """
    parts = [outer if area(outer) > 0 else outer[::-1], *(hole if area(hole) < 0 else hole[::-1] for hole in holes)]
    points = np.concatenate(parts)
    starts = np.cumsum([0, *map(len, parts)])
    rings = [list(range(start, end)) for start, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True)]
    loop = rings[0]
    # from the right, so that a bridge meets no hole that is not joined yet
    for ring in sorted(rings[1:], key=lambda ring: -points[ring, 0].max()):
        loop = _bridged(points, loop, ring)
    return points, np.array(_ears(points, loop), dtype=np.int64).reshape(-1, 3)


def area(polygon: Floats) -> float:
    """Signed area, positive counter-clockwise."""
    x, y = polygon.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _bridged(points: Floats, loop: list[int], hole: list[int]) -> list[int]:
    """The loop with a hole joined to it: from the hole's rightmost point to the nearest one it sees on its right."""
    at = int(np.argmax(points[hole, 0]))
    hole = hole[at:] + hole[:at]
    start = points[hole[0]]
    a, b = points[loop], points[loop[1:] + loop[:1]]
    for k in np.argsort(np.hypot(*(a - start).T), kind="stable"):
        end = a[k]
        if end[0] < start[0] or not _inside(points, loop, int(k), start):
            continue
        away = (a != end).any(axis=1) & (b != end).any(axis=1)
        cross = (_turn(start, end, a) * _turn(start, end, b) <= 0) & (_turn(a, b, start) * _turn(a, b, end) <= 0)
        if not (cross & away).any():
            return [*loop[: k + 1], *hole, hole[0], *loop[k:]]
    raise ValueError("a hole does not lie inside its polygon")


def _inside(points: Floats, loop: list[int], k: int, to: Floats) -> bool:
    """True if the way from vertex k of the loop to a point begins inside."""
    before, here, after = points[loop[k - 1]], points[loop[k]], points[loop[(k + 1) % len(loop)]]
    left, right = _turn(here, after, to) > 0, _turn(before, here, to) > 0
    return bool(left and right if _turn(before, here, after) > 0 else left or right)


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    """Twice the signed area of the triangle a b c; of any shapes that go together."""
    turn: Floats = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    return turn


def _ears(points: Floats, loop: list[int]) -> list[tuple[int, int, int]]:
    left = np.array(loop)
    found: list[tuple[int, int, int]] = []
    while len(left) > 3:
        at = _ear(points, left)
        a, b, c = (int(left[(at + step) % len(left)]) for step in (-1, 0, 1))
        if abs(float(_turn(points[a], points[b], points[c]))) > 0:
            found.append((a, b, c))
        left = np.delete(left, at)
    return [*found, (int(left[0]), int(left[1]), int(left[2]))]


def _ear(points: Floats, left: Integers) -> int:
    """A corner that can be cut off: convex, no other point in it; the fattest first."""
    here = points[left]
    before, after = np.roll(here, 1, axis=0), np.roll(here, -1, axis=0)
    turn = _turn(before, here, after)
    longest = np.maximum(((after - before) ** 2).sum(1), ((here - before) ** 2).sum(1) + ((after - here) ** 2).sum(1))
    for at in np.argsort(-turn / np.where(longest > 0, longest, 1), kind="stable"):
        if turn[at] <= _FLAT:
            break
        a, b, c = before[at], here[at], after[at]
        own = (here == a).all(1) | (here == b).all(1) | (here == c).all(1)
        within = (_turn(a, b, here) >= 0) & (_turn(b, c, here) >= 0) & (_turn(c, a, here) >= 0)
        if not (within & ~own).any():
            return int(at)
    return int(np.argmin(np.abs(turn)))  # nothing but flat corners is left
