"""Wheels and plates as discs in a stack of parallel axes, the gaps between their levels, and passages through plates.

A passage is a window in a plate, wheel or bracket, or a notch at its edge, for an arbor that crosses it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, dist, hypot

import numpy as np

from geartrain.numerics.arrays import Floats
from geartrain.teeth.outlines.contour import Contour

Point = tuple[float, float]

EDGE = 1.0  # mm from the stack to the middle of the gaps below and above it
_SAME = 1e-6  # mm: touching faces must not overlap due to rounding errors


@dataclass(frozen=True, slots=True)
class StackDisc:
    """Cylinder that represents a wheel, an eccentric or a turning plate in the stack; lengths are in mm."""

    name: str
    link: str
    axis: str
    at: Point
    """Position of the disc's axis in plan view of the stack [mm]."""
    low: float
    high: float
    outer: float
    """Outer radius of the teeth or of the rim [mm]."""
    inner: float = 0.0
    """Radius of the free space in a ring, or of a central hole for an eccentric [mm]; 0 for other discs."""
    root: float = 0.0
    """Root radius of the teeth [mm]; 0 for a plate, which does not limit the diameter of its arbor."""
    hub: bool = True
    """True if the disc is mounted on the arbor of its link; False if it is a ring."""
    carrier: Point | None = None
    """Position of the axis about which the disc's axis is carried [mm]; None if it is not carried."""
    apart: bool = False
    """True for an arm that is connected to its link by an eccentric bar, which bypasses the parts between them."""

    @property
    def middle(self) -> float:
        """Height of the middle plane of the disc [mm]."""
        return (self.low + self.high) / 2

    def clearance_to(self, at: Point, radius: float) -> float:
        """Return the minimum gap [mm] between the disc, at all positions of its carrier, and a fixed cylinder.

        The gap is negative for an overlap. The cylinder has the given radius, and its axis is at `at`. It may be inside
        a ring.
        """
        if self.carrier is None:
            away = dist(at, self.at)
            return max(away - self.outer, self.inner - away if self.inner else -self.outer) - radius
        away, aside = dist(at, self.carrier), dist(self.at, self.carrier)
        # the column may also be near the carrier axis, inside the circle on which the disc revolves
        inside = self.inner - away - aside if self.inner else aside - self.outer - away
        return max(away - aside - self.outer, inside) - radius


def slabs(discs: Iterable[StackDisc], tied: Sequence[tuple[float, float]] = ()) -> list[tuple[float, float]]:
    """Return the occupied intervals of height, from the lowest [mm]; intervals in `tied` count as occupied."""
    found: list[tuple[float, float]] = []
    for low, high in sorted([*((disc.low, disc.high) for disc in discs), *tied]):
        if found and low < found[-1][1] - _SAME:
            found[-1] = found[-1][0], max(high, found[-1][1])
        else:
            found.append((low, high))
    return found


def gaps(taken: Sequence[tuple[float, float]]) -> list[float]:
    """Return the mid-heights of the gaps below, between and above slabs [mm]."""
    between = [(below[1] + above[0]) / 2 for below, above in pairwise(taken)]
    return [taken[0][0] - EDGE, *between, taken[-1][1] + EDGE]


def swept_circle(disc: StackDisc) -> tuple[Point, float]:
    """Return the circle that contains a disc in all positions of its carrier, as centre and radius [mm]."""
    if disc.carrier is None:
        return disc.at, disc.outer
    return disc.carrier, dist(disc.carrier, disc.at) + disc.outer


def by_piece(discs: Iterable[StackDisc]) -> Mapping[tuple[str, bool], list[StackDisc]]:
    """Return the discs in order, grouped by link and piece. Discs with `apart` are a separate piece of their link."""
    found: dict[tuple[str, bool], list[StackDisc]] = {}
    for disc in discs:
        found.setdefault((disc.link, disc.apart), []).append(disc)
    return found


# ------------------------------------------------------------------------------------------------------------- passages


_FINE = 0.005  # mm: tolerance of chords of a notched edge
_CORNERS = (-1, -1), (1, -1), (1, 1), (-1, 1)
_WEB = 1.0  # mm: minimum web between a window and the edge, and between two windows


@dataclass(frozen=True, slots=True)
class Passage:
    """Rectangular passage in a plate for a wheel or bracket that crosses the plate."""

    middle: Point
    """Centre of the rectangle, in the coordinates of the stack [mm]."""
    way: Point
    """Unit vector along the length of the rectangle; `length` and `width` are half the lengths of its sides [mm]."""
    length: float
    width: float

    @property
    def corners(self) -> list[Point]:
        """Corners of the rectangle, counter-clockwise."""
        (x, y), (u, v) = self.middle, self.way
        ends = [(a * self.length, b * self.width) for a, b in _CORNERS]
        return [(x + u * along - v * aside, y + v * along + u * aside) for along, aside in ends]

    @property
    def circles(self) -> list[tuple[Point, float]]:
        """Circles in a row that cover nearly all of the passage, each as a centre and a radius [mm]."""
        (x, y), (u, v), count = self.middle, self.way, ceil(self.length / self.width)
        steps = [self.length * k / count for k in range(-count, count + 1)]
        return [((x + u * step, y + v * step), self.width) for step in steps]

    def is_clear_of(self, other: Passage) -> bool:
        """Return True if at least 1 mm of the plate is left between two passages (separating axis theorem)."""
        for u, v in (self.way, other.way):
            for x, y in ((u, v), (-v, u)):
                spans = [[a * x + b * y for a, b in each.corners] for each in (self, other)]
                if max(min(span) for span in spans) - min(max(span) for span in spans) >= _WEB:
                    return True
        return False

    def meets(self, at: Point, radius: float) -> bool:
        """Return True if the passage intersects a round hole."""
        x, y = at[0] - self.middle[0], at[1] - self.middle[1]
        along, aside = abs(x * self.way[0] + y * self.way[1]), abs(y * self.way[0] - x * self.way[1])
        return hypot(max(along - self.length, 0.0), max(aside - self.width, 0.0)) < radius


def with_passages(edge: Contour, passages: Iterable[Passage]) -> tuple[Contour, tuple[Contour, ...]]:
    """Return the edge of a plate with notches, and its windows, without passages that would cut the plate in two."""
    windows = []
    for each in passages:
        x, y = each.way
        turn = np.array([[x, -y], [y, x]])  # columns: unit vectors along and across
        line = (edge.flattened(_FINE) - np.array(each.middle)) @ turn
        corners = np.array([(u * each.length, v * each.width) for u, v in _CORNERS])
        inside = [_is_inside(line, corner) for corner in corners]
        if all(inside):
            windows.append(_contour(corners @ turn.T + np.array(each.middle)))
        elif inside in ([True, False, False, True], [False, True, True, False]):
            side = 1.0 if inside[0] else -1.0
            notched = side * _notched(side * line, -each.length, each.width)
            edge = _contour(notched @ turn.T + np.array(each.middle))
    return edge, tuple(windows)


def _contour(points: Floats) -> Contour:
    return Contour(points, np.zeros(len(points)))


def _is_inside(line: Floats, point: Floats) -> bool:
    """Return True if a closed line encloses a point (winding number) and the point is at least 1 mm from the line."""
    a, b = line - point, np.roll(line, -1, axis=0) - point
    turned = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(1)).sum()
    edge = b - a
    # 1e-300 avoids 0/0 where points are repeated
    foot = np.clip(-(a * edge).sum(1) / np.maximum((edge * edge).sum(1), 1e-300), 0.0, 1.0)
    apart = np.hypot(*(a + foot[:, None] * edge).T).min()
    return bool(abs(turned) > np.pi and apart >= _WEB)


def _notched(line: Floats, start: float, width: float) -> Floats:
    """Return a closed counter-clockwise line with a notch where x > `start` and y is between -`width` and `width`."""
    (last, below), (first, above) = (_exit(line, level, start) for level in (-width, width))
    order = (first + 1 + np.arange((last - first - 1) % len(line) + 1)) % len(line)
    return np.vstack([above, line[order], below, [[start, -width], [start, width]]])


def _exit(line: Floats, level: float, start: float) -> tuple[int, Floats]:
    """Return the index of the edge of a closed line that crosses y = `level` first beyond x = `start`, and where."""
    after = np.roll(line, -1, axis=0)
    crossing = np.flatnonzero((line[:, 1] < level) != (after[:, 1] < level))
    a, b = line[crossing], after[crossing]
    x = a[:, 0] + (level - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    at = int(np.argmin(np.where(x > start, x, np.inf)))
    return int(crossing[at]), np.array([x[at], level])


def clear_passages(passages: Iterable[Passage], holes: Iterable[tuple[Point, float]]) -> list[Passage]:
    """Return the passages that intersect no hole; of two that are too close together, only the earlier is kept.

    holes   centres and radii of the holes [mm]
    """
    there, found = list(holes), list[Passage]()
    for each in passages:
        apart = all(each.is_clear_of(other) for other in found)
        if apart and not any(each.meets(at, radius) for at, radius in there):
            found.append(each)
    return found
