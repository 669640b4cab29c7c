"""Parallels planned and stacked, one direction after the other, each hung on what stands already."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.layout.crossing import Seat, seats
from geartrain.layout.planning import Point, Task, plan
from geartrain.layout.reading import Line, Reading, Touch
from geartrain.layout.result import Vector
from geartrain.layout.roaming import ranges
from geartrain.layout.room import Disc
from geartrain.layout.scales import Scales
from geartrain.layout.shelves import find_shelves
from geartrain.layout.sizes import Size
from geartrain.layout.towers import Demand, Tower, build_tower, overlap
from geartrain.layout.vectors import along, dot, frame

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Arrangement:
    """Points of axes and centres of wheels (mm), seats of the wheels of crossing pairs, towers by group.

    main, up   the group of parallels with most wheels, and its direction upwards
    """

    points: Mapping[str, Vector]
    centres: Mapping[str, Vector]
    seats: Mapping[str, tuple[Seat, Seat]]
    towers: Mapping[int, Tower]
    main: int
    up: Vector


class Arranger:
    """Arranges the axes and wheels of a train; `arrange` does it once."""

    def __init__(
        self,
        reading: Reading,
        scales: Scales,
        sizes: dict[str, Size],
        ends: Mapping[str, tuple[bool, bool]],
        first: str | None = None,
    ) -> None:
        self.first = first
        self.reading, self.scales, self.sizes, self.ends = reading, scales, sizes, ends
        self.crossing = [touch for touch in reading.touches if touch.kind in ("bevel", "crown", "screw")]
        self.seats = {
            touch.name: seats(reading, touch, (sizes[touch.wheels[0]].radius, sizes[touch.wheels[1]].radius))
            for touch in self.crossing
        }
        self.points: dict[str, Vector] = {}
        self.centres: dict[str, Vector] = {}
        self.towers: dict[int, Tower] = {}

    def arrange(self) -> Arrangement:
        """All groups of parallels, that with most wheels first, then those that mesh with what stands."""
        order = self._order()
        for group in order:
            self._place([line for line in self.reading.lines.values() if line.group == group])
        for wheel, axis in self.reading.axis.items():
            self.centres.setdefault(wheel, self.points.get(axis, _ORIGIN))
        main = order[0] if order else -1
        up = next((upwards(line.way) for line in self.reading.lines.values() if line.group == main), (0.0, 0.0, 1.0))
        return Arrangement(self.points, self.centres, self.seats, self.towers, main, up)

    def _order(self) -> list[int]:
        lines = self.reading.lines
        count = dict.fromkeys((line.group for line in lines.values()), 0)
        for axis in self.reading.axis.values():
            if axis in lines:
                count[lines[axis].group] += 1
        joined = {
            (lines[a].group, lines[b].group) for touch in self.crossing for a, b in (touch.axes, touch.axes[::-1])
        }
        order: list[int] = []
        while len(order) < len(count):
            rest = [group for group in count if group not in order]
            near = [group for group in rest if any((group, other) in joined for other in order)]
            order.append(max(near or rest, key=lambda group: (count[group], -group)))
        return order

    def _place(self, lines: list[Line]) -> None:
        n = upwards(lines[0].way)
        x, y = frame(n)
        labels = {line.label for line in lines}
        hung = list(self._hung(labels))
        fixed = self._fixed(lines, hung, x, y)
        places = plan(self._task(lines, fixed, x, y))
        near, far = ranges(lines, places)
        self._broaden(labels, near, far)
        tower = build_tower(
            self.reading, self.sizes, self.seats, lines, places, near, far, n, (x, y), self._demands(hung, n), self.ends
        )
        self.towers[lines[0].group] = tower
        heights = tower.heights()
        for line in lines:
            u, v = places[line.label]
            foot = along(along(_ORIGIN, x, u), y, v)
            self.points[line.label] = line.given or foot
            for wheel in (wheel for wheel in heights if self.reading.axis[wheel] == line.label):
                self.centres[wheel] = along(foot, n, heights[wheel])

    def _broaden(self, labels: set[str], near: Floats, far: Floats) -> None:
        """Make wheels broad that have mates one above the other."""
        number = {label: at for at, label in enumerate(line for line in self.reading.lines if line in labels)}
        across = {wheel for touch in self.crossing for wheel in touch.wheels}
        axis, sizes = self.reading.axis, self.sizes

        def run_into(wheel: str, other: str) -> bool:
            ends = number[axis[wheel]], number[axis[other]]
            return overlap(sizes[wheel], sizes[other], float(near[ends]), float(far[ends]))

        meshes = [
            touch.wheels
            for touch in self.reading.touches
            if touch.kind in ("side", "ring") and touch.axes[0] in labels and not across & set(touch.wheels)
        ]
        for wheel, shelf in find_shelves(meshes, run_into).items():
            self.sizes[wheel] = sizes[wheel].on(*shelf)

    def _hung(self, labels: set[str]) -> Iterator[tuple[Touch, int, Vector]]:
        """Crossing pairs with an axis that stands: the pair, the side that is new, and a point of the new axis."""
        for touch in self.crossing:
            for new in (0, 1):
                known = touch.wheels[1 - new]
                if touch.axes[new] in labels and touch.axes[1 - new] in self.points and known in self.centres:
                    seat = self.seats[touch.name][1 - new]
                    way = self.reading.lines[touch.axes[1 - new]].way
                    point = along(self.centres[known], way, -seat.far)
                    if touch.kind == "screw":
                        far = sum(self.sizes[wheel].radius for wheel in touch.wheels)
                        point = along(point, seat.out, far)
                    yield touch, new, point

    def _fixed(
        self, lines: list[Line], hung: list[tuple[Touch, int, Vector]], x: Vector, y: Vector
    ) -> dict[str, Point]:
        fixed = {line.label: _flat(line.given, x, y) for line in lines if line.given is not None}
        for touch, new, point in hung:
            fixed.setdefault(touch.axes[new], _flat(point, x, y))
        if fixed:
            return fixed
        labels = [line.label for line in lines]
        for touch in self.crossing:  # nothing of these stands, but an axis they meet is given
            for new in (0, 1):
                other = self.reading.lines[touch.axes[1 - new]]
                if touch.axes[new] in labels and other.given is not None:
                    return {touch.axes[new]: _flat(other.given, x, y)}
        return dict.fromkeys(
            self._concurrent(labels) or [self.first if self.first in labels else labels[0]], (0.0, 0.0)
        )

    def _concurrent(self, labels: list[str]) -> list[str]:
        """Parallels that are one line, for two axes across, not parallel to each other, meet each of them."""
        met: dict[str, set[int]] = {label: set() for label in labels}
        for touch in self.crossing:
            for side in (0, 1):
                if touch.axes[side] in met and touch.kind != "screw":
                    met[touch.axes[side]].add(self.reading.lines[touch.axes[1 - side]].group)
        return [
            label for label in labels if any(len(met[label] & met[other]) > 1 for other in labels if other != label)
        ]

    def _demands(self, hung: list[tuple[Touch, int, Vector]], n: Vector) -> list[Demand]:
        demands = []
        for touch, new, point in hung:
            wheel = touch.wheels[new]
            way = self.reading.lines[touch.axes[new]].way
            seat = self.seats[touch.name][new]
            at = along(point, way, seat.far)
            demands.append(Demand(wheel, dot(at, n)))
        return demands

    def _task(self, lines: list[Line], fixed: Mapping[str, Point], x: Vector, y: Vector) -> Task:
        labels = [line.label for line in lines]
        discs: dict[str, list[Disc]] = {label: [] for label in labels}
        for wheel, axis in self.reading.axis.items():
            if axis in discs:
                size = self.sizes[wheel]
                discs[axis].append(Disc(wheel, self.scales.cluster[wheel], size.inner, size.outer))
        distances = {pair: far for pair, far in self.scales.distances.items() if set(pair) <= set(labels)}
        pivots = {line.label: line.pivots[0] for line in lines if line.pivots}
        self._loose(labels, distances, pivots, discs)
        mates = frozenset(frozenset(touch.wheels) for touch in self.reading.touches)
        return Task(
            labels,
            {line.label: line.bearers[0] for line in lines},
            pivots,
            fixed,
            distances,
            discs,
            mates,
            dict(self._rows(labels, x, y)),
            dict(self._sides(labels, x, y)),
            dict(self._turns(labels)),
        )

    def _loose(
        self,
        labels: list[str],
        distances: dict[tuple[str, str], float],
        pivots: Mapping[str, str],
        discs: Mapping[str, list[Disc]],
    ) -> None:
        """Distances of a likeness, for pins without dimensions and carried axes that mesh with nothing on the way."""
        radius = {label: max((disc.outer for disc in discs[label]), default=1.0) for label in labels}
        joined = _Joined(labels, distances)
        for tie in self.reading.ties:
            pair = (min(tie.axes), max(tie.axes))
            if tie.offset is None and set(pair) <= set(labels) and pair not in distances:
                if tie.encloses:
                    distances[pair] = 0.12 * min(radius[end] for end in pair)
                elif joined.apart(*pair):
                    distances[pair] = 1.6 * radius[tie.axes[0]]
                joined.join(*pair)
        for label, pivot in pivots.items():
            if pivot in radius and joined.apart(label, pivot):
                distances[min(label, pivot), max(label, pivot)] = 1.2 * (
                    radius[label] + min(radius[pivot], radius[label])
                )
                joined.join(label, pivot)

    def _rows(self, labels: list[str], x: Vector, y: Vector) -> Iterator[tuple[tuple[str, str], Point]]:
        met: dict[str, list[str]] = {}
        for touch in self.crossing:
            for side in (0, 1):
                if touch.axes[side] in labels and touch.kind != "screw":
                    met.setdefault(touch.axes[1 - side], []).append(touch.axes[side])
        for across, ends in met.items():
            u, v = _flat(self.reading.lines[across].way, x, y)
            far = hypot(u, v)
            others = list(dict.fromkeys(ends))
            for first, second in pairwise(others):
                yield (first, second), (u / far, v / far)

    def _sides(self, labels: list[str], x: Vector, y: Vector) -> Iterator[tuple[str, Point]]:
        for touch in self.crossing:
            for side in (0, 1):
                if touch.axes[side] in labels and touch.axes[1 - side] not in self.points:
                    seat = self.seats[touch.name][1 - side]
                    u, v = _flat(self.reading.lines[touch.axes[1 - side]].way, x, y)
                    sense = 1.0 if seat.far > 0 else -1.0
                    yield touch.axes[side], (sense * u, sense * v)

    def _turns(self, labels: list[str]) -> Iterator[tuple[str, int]]:
        """Planets between a sun and a ring: teeth meet in as many places as both have teeth together."""
        mates: dict[tuple[str, str], list[tuple[str, Touch]]] = {}
        for touch in self.reading.touches:
            for side in (0, 1):
                axis, other = touch.axes[side], touch.axes[1 - side]
                pivots = self.reading.lines[axis].pivots
                if axis in labels and pivots and pivots[0] == other and touch.kind in ("side", "ring"):
                    mates.setdefault((axis, touch.wheels[side]), []).append((touch.wheels[1 - side], touch))
        for (axis, _), found in mates.items():
            if len(found) > 1 and {touch.kind for _, touch in found} == {"side", "ring"}:
                counts = {touch.kind: self.reading.wheels[mate][1].count or 1 for mate, touch in found}
                yield axis, counts["side"] + counts["ring"]


class _Joined:
    """Which axes hang together."""

    def __init__(self, labels: list[str], distances: Mapping[tuple[str, str], float]) -> None:
        self.head = {label: label for label in labels}
        for pair in distances:
            self.join(*pair)

    def _find(self, label: str) -> str:
        while self.head[label] != label:
            self.head[label] = self.head[self.head[label]]
            label = self.head[label]
        return label

    def join(self, first: str, second: str) -> None:
        self.head[self._find(first)] = self._find(second)

    def apart(self, first: str, second: str) -> bool:
        return self._find(first) != self._find(second)


def upwards(way: Vector) -> Vector:
    """The same direction for both senses: z, or what is nearest to it, upwards."""
    last = next(part for part in way[::-1] if abs(part) > 1e-12)
    return way if last > 0 else (-way[0], -way[1], -way[2])


def _flat(point: Vector, x: Vector, y: Vector) -> Point:
    return dot(point, x), dot(point, y)
