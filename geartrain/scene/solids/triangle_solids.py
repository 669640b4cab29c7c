"""Triangles that fill a polygon with holes: ears cut off one by one, holes first joined to the outside by bridges.

Closed surfaces of triangles: shapes raised along an axis, cylinders, and wheels of bevel and crown form.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from math import ceil, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.wheel_blanks import Blank

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
    """Ear clipping: the fattest ear is cut off first."""
    corners = _Corners(points[loop])
    found: list[tuple[int, int, int]] = []
    while len(corners.left) > 3:
        at = corners.find_ear()
        if abs(float(corners.turn[at])) > 0:
            found.append((loop[corners.before[at]], loop[at], loop[corners.after[at]]))
        corners.cut(at)
    a, b, c = corners.left.tolist()
    return [*found, (loop[a], loop[b], loop[c])]


class _Corners:
    """The corners that are left of a polygon. A cut changes two of them, and all others keep their place in a heap."""

    def __init__(self, corners: Floats) -> None:
        count = len(corners)
        self.corners, self.left = corners, np.arange(count)
        self.before, self.after = [count - 1, *range(count - 1)], [*range(1, count), 0]
        self.turn, self.fatness = _shape(corners[self.before], corners, corners[self.after])
        self.heap = [(-fat, at) for at, fat in enumerate(self.fatness.tolist())]
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
        return ear if ear >= 0 else int(self.left[np.argmin(np.abs(self.turn[self.left]))])

    def _empty(self, at: int) -> bool:
        """True if no point but its own lies in the triangle of a corner."""
        here, own = self.corners[self.left], self.corners[[self.before[at], at, self.after[at]]]
        a, b, c = own
        within = (_turn(a, b, here) >= 0) & (_turn(b, c, here) >= 0) & (_turn(c, a, here) >= 0)
        return bool((here[within][:, None] == own).all(-1).any(-1).all())

    def cut(self, at: int) -> None:
        """Cut a corner off."""
        a, c = self.before[at], self.after[at]
        self.left = np.delete(self.left, np.searchsorted(self.left, at))
        self.after[a], self.before[c], self.fatness[at] = c, a, np.nan
        for k in (a, c):
            ends = self.corners[self.before[k]], self.corners[k], self.corners[self.after[k]]
            self.turn[k], self.fatness[k] = _shape(*ends)
            heappush(self.heap, (-float(self.fatness[k]), k))


def _shape(before: Floats, here: Floats, after: Floats) -> tuple[Floats, Floats]:
    """Twice the signed area of each corner's triangle, and that over the square of its greatest length."""
    turn = _turn(before, here, after)
    sides = ((here - before) ** 2).sum(-1) + ((after - here) ** 2).sum(-1)
    longest = np.maximum(((after - before) ** 2).sum(-1), sides)
    return turn, turn / np.where(longest > 0, longest, 1)


FINE = 0.02  # mm, how far the chords of a solid may leave a curve
_SAME = 7  # decimals of a mm to which points are one
_STEPS = 24  # sides of an arbor


@dataclass(frozen=True, slots=True)
class Solid:
    """Vertices (n, 3) in mm, and faces (m, 3) of their indices, counter-clockwise from outside."""

    vertices: Floats
    faces: Integers

    @property
    def volume(self) -> float:
        """Volume within (mm3)."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6

    def moved(self, turn: Floats, by: Sequence[float]) -> Solid:
        """Turned by a matrix (3, 3), then moved."""
        return Solid(self.vertices @ turn.T + np.asarray(by), self.faces)


def joined(solids: Iterable[Solid]) -> Solid:
    """Several surfaces as one list of triangles."""
    parts = list(solids)
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return Solid(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts[:-1], strict=True)]),
    )


def wheel_solid(blank: Blank, tolerance: float = FINE) -> Solid:
    """A wheel from its flat shape, its middle at the origin. One pitch is filled and repeated where teeth allow."""
    contours = blank.contours
    ring = blank.kind == "ring"
    teeth = contours[1 if ring else 0]
    others = [contour for contour in contours if contour is not teeth]
    if blank.kind == "pins" or len(teeth.points) % blank.teeth:
        return plate_solid(contours, blank.thickness, tolerance)
    radius = float(abs(others[0].points).max()) if others else 0.0
    own = len(teeth.points) // blank.teeth + 1
    tooth = thinned(_open(teeth, own, tolerance), tolerance)
    pitch = _pitch(tooth, radius, blank.teeth, tolerance)
    return raised(*_repeated(*fill(pitch), blank.teeth), blank.thickness)


def _open(contour: Contour, count: int, tolerance: float) -> Floats:
    """The first vertices of a contour, its arcs between them as chords."""
    bulges = np.append(contour.bulges[: count - 1], 0.0)
    return Contour(contour.points[:count], bulges).flattened(tolerance)


def thinned(points: Floats, tolerance: float) -> Floats:
    """The fewest of a line's points that stay within a tolerance of it (Douglas and Peucker), its ends among them."""
    kept = {0, len(points) - 1}
    todo = [(0, len(points) - 1)]
    while todo:
        first, last = todo.pop()
        if last - first < 2:
            continue
        along = points[last] - points[first]
        away = points[first + 1 : last] - points[first]
        length = float(np.hypot(*along))
        off = abs(along[0] * away[:, 1] - along[1] * away[:, 0]) / length if length else np.hypot(*away.T)
        if off.max() > tolerance:
            middle = first + 1 + int(off.argmax())
            kept.add(middle)
            todo += [(first, middle), (middle, last)]
    return points[sorted(kept)]


def plate_solid(contours: Sequence[Contour], thickness: float, tolerance: float = FINE) -> Solid:
    """A flat part with holes, its middle plane at z = 0."""
    outer, *holes = (contour.flattened(tolerance) for contour in contours)
    return raised(*fill(outer, holes), thickness)


def cylinder(radius: float, start: float, end: float) -> Solid:
    """An arbor along z."""
    turn = 2 * pi * np.arange(_STEPS) / _STEPS
    circle = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    solid = raised(*fill(circle), end - start)
    return Solid(solid.vertices + np.array([0.0, 0.0, (start + end) / 2]), solid.faces)


def raised(points: Floats, triangles: Integers, thickness: float) -> Solid:
    """A flat shape (n, 2) raised half the thickness to either side; walls stand on edges that have one triangle."""
    return between(
        np.column_stack([points, np.full(len(points), -thickness / 2)]),
        np.column_stack([points, np.full(len(points), thickness / 2)]),
        triangles,
    )


def between(low: Floats, high: Floats, triangles: Integers) -> Solid:
    """The solid between two copies (n, 3) of one flat shape."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {(a, b) for a, b in edges.tolist()}
    rim = np.array([(a, b) for a, b in edges.tolist() if (b, a) not in known], dtype=np.int64)
    n = len(low)
    a, b = rim.T
    walls = np.concatenate([np.stack([a, b, b + n], axis=1), np.stack([a, b + n, a + n], axis=1)])
    return Solid(np.concatenate([low, high]), np.concatenate([triangles[:, ::-1], triangles + n, walls]))


def _pitch(tooth: Floats, radius: float, teeth: int, tolerance: float) -> Floats:
    """One tooth with its part of the web, from the first point's radius to the last one's."""
    first, last = (float(np.arctan2(y, x)) for x, y in (tooth[0], tooth[-1]))
    if not radius:
        return np.concatenate([tooth, [[0.0, 0.0]]])
    sweep = 2 * pi / teeth
    steps = max(1, ceil(sweep / (2 * np.arccos(max(1 - tolerance / radius, -1.0)))))
    turn = last - sweep * np.arange(steps + 1) / steps
    assert abs((last - first - sweep + pi) % (2 * pi) - pi) < 1e-6
    return np.concatenate([tooth, radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)])


def _repeated(points: Floats, triangles: Integers, times: int) -> tuple[Floats, Integers]:
    """The same triangles in every pitch, points that meet made one."""
    turn = 2 * pi * np.arange(times)[:, None] / times
    c, s = np.cos(turn), np.sin(turn)
    x, y = points.T
    every = np.stack([c * x - s * y, s * x + c * y], axis=-1).reshape(-1, 2)
    _, first, index = np.unique(every.round(_SAME) + 0.0, axis=0, return_index=True, return_inverse=True)
    faces = (triangles + len(points) * np.arange(times)[:, None, None]).reshape(-1, 3)
    return every[first], np.asarray(index).reshape(-1)[faces]
