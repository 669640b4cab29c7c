"""What is asked of the plan of some parallels: distances, rows, sides, and room for their wheels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot

from geartrain.numerics.graphs import DisjointSets
from geartrain.numerics.vectors import Vector, dot
from geartrain.scene.layout.axis_placement import PlacementProblem, Point
from geartrain.scene.layout.declared_geometry import AxisLine, DeclaredGeometry, PitchContact
from geartrain.scene.layout.plan_clearance import Disc
from geartrain.scene.layout.wheel_geometry import Seat, WheelSize
from geartrain.scene.layout.wheel_modules import WheelModules


@dataclass(frozen=True, slots=True)
class PlacementProblems:
    """Makes tasks of plans.

    crossing  pairs whose axes are not parallel, and the seats of their wheels
    points    of the axes that stand already
    """

    reading: DeclaredGeometry
    scales: WheelModules
    sizes: Mapping[str, WheelSize]
    crossing: Sequence[PitchContact]
    seats: Mapping[str, tuple[Seat, Seat]]
    points: Mapping[str, Vector]

    def task(self, lines: Sequence[AxisLine], fixed: Mapping[str, Point], x: Vector, y: Vector) -> PlacementProblem:
        """The task of some parallels, in coordinates along x and y; `fixed` have their points."""
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
        return PlacementProblem(
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
        joined: DisjointSets[str] = DisjointSets()
        for pair in distances:
            joined.join(*pair)
        for tie in self.reading.ties:
            pair = (min(tie.axes), max(tie.axes))
            if tie.offset is None and set(pair) <= set(labels) and pair not in distances:
                if tie.encloses:
                    distances[pair] = 0.12 * min(radius[end] for end in pair)
                elif joined.are_apart(*pair):
                    distances[pair] = 1.6 * radius[tie.axes[0]]
                joined.join(*pair)
        for label, pivot in pivots.items():
            if pivot in radius and joined.are_apart(label, pivot):
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
            u, v = flat(self.reading.lines[across].way, x, y)
            far = hypot(u, v)
            others = list(dict.fromkeys(ends))
            for first, second in pairwise(others):
                yield (first, second), (u / far, v / far)

    def _sides(self, labels: list[str], x: Vector, y: Vector) -> Iterator[tuple[str, Point]]:
        for touch in self.crossing:
            for side in (0, 1):
                if touch.axes[side] in labels and touch.axes[1 - side] not in self.points:
                    seat = self.seats[touch.name][1 - side]
                    u, v = flat(self.reading.lines[touch.axes[1 - side]].way, x, y)
                    sense = 1.0 if seat.far > 0 else -1.0
                    yield touch.axes[side], (sense * u, sense * v)

    def _turns(self, labels: list[str]) -> Iterator[tuple[str, int]]:
        """Planets between a sun and a ring: teeth meet in as many places as both have teeth together."""
        mates: dict[tuple[str, str], list[tuple[str, PitchContact]]] = {}
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


def flat(point: Vector, x: Vector, y: Vector) -> Point:
    """The coordinates of a point along x and y."""
    return dot(point, x), dot(point, y)
