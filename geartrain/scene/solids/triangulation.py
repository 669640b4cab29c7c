"""Triangles that fill a polygon with holes: ear clipping, holes first joined to the outside by bridges.

A corner is an ear if it is convex and no other point lies in its triangle; every polygon has one (Meisters 1975). The
fattest ear is cut off first, so that triangles are no slivers; bridges are those of Eberly, "Triangulation by ear
clipping".
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heapify, heappop, heappush
from math import isnan, nan
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Integers = NDArray[np.int64]

_FLAT = 1e-12  # twice the area (mm2) of a triangle that is none
_NEXT = [1, 2, 0]


def fill(outer: Floats, holes: Sequence[Floats] = ()) -> tuple[Floats, Integers]:
    """Points (n, 2), those given in their order, and triangles (m, 3) of them, counter-clockwise.

    Polygons (k, 2) do not cross themselves or each other, whichever way they go round.
    """
    parts = [outer if area(outer) > 0 else outer[::-1], *(hole if area(hole) < 0 else hole[::-1] for hole in holes)]
    points = np.concatenate(parts)
    starts = np.cumsum([0, *map(len, parts)])
    rings = [list(range(start, end)) for start, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True)]
    loop = rings[0]
    # from the right, and of equal ones from above, so that a bridge meets no hole that is not joined yet
    for ring in sorted(rings[1:], key=lambda ring: max(map(tuple, points[ring].tolist())), reverse=True):
        loop = _bridged(points, loop, ring)
    return points, np.array(_ears(points, loop), dtype=np.int64).reshape(-1, 3)


def area(polygon: Floats) -> float:
    """Signed area, positive counter-clockwise."""
    x, y = polygon.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _bridged(points: Floats, loop: list[int], hole: list[int]) -> list[int]:
    """The loop with a hole joined to it: from the hole's rightmost point to the nearest one it sees on its right."""
    at = int(np.lexsort(points[hole].T[::-1])[-1])
    hole = hole[at:] + hole[:at]
    start = points[hole[0]]
    a, b = points[loop], points[loop[1:] + loop[:1]]
    for k in np.argsort(np.hypot(*(a - start).T), kind="stable"):
        end = a[k]
        if tuple(end) <= tuple(start) or not _inside(points, loop, int(k), start):
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
    """Ear clipping: the fattest ear is cut off first."""
    corners = _Corners(points[loop])
    found: list[tuple[int, int, int]] = []
    while len(corners.left) > 3:
        at = corners.find_ear()
        if corners.turn[at] != 0:
            found.append((loop[corners.before[at]], loop[at], loop[corners.after[at]]))
        corners.cut(at)
    a, b, c = corners.left.tolist()
    return [*found, (loop[a], loop[b], loop[c])]


class _Corners:
    """The corners that are left of a polygon. A cut changes two of them, and all others keep their place in a heap."""

    def __init__(self, corners: Floats) -> None:
        count = len(corners)
        self.corners, self.left = corners, np.arange(count)
        self.points = [(x, y) for x, y in corners.tolist()]
        self.before, self.after = [count - 1, *range(count - 1)], [*range(1, count), 0]
        self.turn, self.fatness = [0.0] * count, [0.0] * count
        self.blocker = [-1] * count  # a corner that was found in the triangle of each; -1: none yet
        for at in range(count):
            self._measure(at)
        self.heap = [(-fat, at) for at, fat in enumerate(self.fatness)]
        heapify(self.heap)

    def find_ear(self) -> int:
        """A corner that can be cut off: convex, no other point in it; the fattest first."""
        passed, ear = [], -1
        while self.heap:
            fat, at = heappop(self.heap)
            if -fat != self.fatness[at]:  # it was cut off, or its shape has changed since
                continue
            if self.turn[at] > _FLAT and self._empty(at):
                ear = at
                break
            passed.append((fat, at))
            if self.turn[at] <= _FLAT:
                break
        for each in passed:
            heappush(self.heap, each)
        # without an ear nothing but flat corners is left
        return ear if ear >= 0 else min(self.left.tolist(), key=lambda at: abs(self.turn[at]))

    def _empty(self, at: int) -> bool:
        """True if no point but its own lies in the triangle of a convex corner."""
        blocker = self.blocker[at]
        if blocker >= 0 and not isnan(self.fatness[blocker]):  # it is left
            return False
        here, own = self.corners[self.left], self.corners[[self.before[at], at, self.after[at]]]
        (ax, ay), (x, y) = own.T[..., None], here.T
        side = (ax[_NEXT] - ax) * (y - ay) - (ay[_NEXT] - ay) * (x - ax)  # of each edge, (3, n)
        within = np.flatnonzero(side.min(axis=0) >= 0)
        if len(within) == 3:
            return True
        others = within[~(here[within][:, None] == own).all(-1).any(-1)]
        if len(others):
            self.blocker[at] = int(self.left[others[0]])
        return not len(others)

    def cut(self, at: int) -> None:
        """Cut a corner off."""
        a, c = self.before[at], self.after[at]
        self.left = np.delete(self.left, np.searchsorted(self.left, at))
        self.after[a], self.before[c], self.fatness[at] = c, a, nan
        for k in (a, c):
            self._measure(k)
            heappush(self.heap, (-self.fatness[k], k))

    def _measure(self, at: int) -> None:
        """Twice the signed area of the triangle of a corner, and that over the square of its greatest length."""
        (ax, ay), (bx, by), (cx, cy) = (self.points[k] for k in (self.before[at], at, self.after[at]))
        turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        first, second = (bx - ax) * (bx - ax) + (by - ay) * (by - ay), (cx - bx) * (cx - bx) + (cy - by) * (cy - by)
        longest = max((cx - ax) * (cx - ax) + (cy - ay) * (cy - ay), first + second)
        self.turn[at], self.fatness[at], self.blocker[at] = turn, turn / (longest or 1.0), -1
