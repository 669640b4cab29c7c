"""Parallels planned and stacked, one direction after the other, each hung on what stands already."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.vectors import Vector, dot, frame, plus
from geartrain.scene.layout.axial_slots import find_axial_slots
from geartrain.scene.layout.axis_placement import Point, plan
from geartrain.scene.layout.declared_geometry import AxisLine, DeclaredGeometry, PitchContact
from geartrain.scene.layout.placement_problem import PlacementProblems, flat
from geartrain.scene.layout.plan_clearance import swept_ranges
from geartrain.scene.layout.stack_builder import build_wheel_stack
from geartrain.scene.layout.wheel_geometry import Seat, WheelSize, seats
from geartrain.scene.layout.wheel_modules import WheelModules
from geartrain.scene.layout.wheel_stacks import HeightConstraint, WheelStack, overlap

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Arrangement:
    """Points of axes and centres of wheels (mm), seats of the wheels of crossing pairs, towers by group.

    main, up   the group of parallels with most wheels, and its direction upwards
    """

    points: Mapping[str, Vector]
    centres: Mapping[str, Vector]
    seats: Mapping[str, tuple[Seat, Seat]]
    towers: Mapping[int, WheelStack]
    main: int
    up: Vector


class Arranger:
    """Arranges the axes and wheels of a train; `arrange` does it once."""

    def __init__(
        self,
        reading: DeclaredGeometry,
        scales: WheelModules,
        sizes: dict[str, WheelSize],
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
        self.towers: dict[int, WheelStack] = {}

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

    def _place(self, lines: list[AxisLine]) -> None:
        n = upwards(lines[0].way)
        x, y = frame(n)
        labels = {line.label for line in lines}
        hung = list(self._hung(labels))
        fixed = self._fixed(lines, hung, x, y)
        asking = PlacementProblems(self.reading, self.scales, self.sizes, self.crossing, self.seats, self.points)
        places = plan(asking.task(lines, fixed, x, y))
        near, far = swept_ranges(lines, places)
        self._broaden(labels, near, far)
        tower = build_wheel_stack(
            self.reading, self.sizes, self.seats, lines, places, near, far, n, (x, y), self._demands(hung, n), self.ends
        )
        self.towers[lines[0].group] = tower
        heights = tower.heights()
        feet = {label: plus(plus(_ORIGIN, x, u), y, v) for label, (u, v) in places.items()}
        for line in lines:
            self.points[line.label] = line.given or feet[line.label]
        for wheel, height in heights.items():
            self.centres[wheel] = plus(feet[self.reading.axis[wheel]], n, height)

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
        for wheel, shelf in find_axial_slots(meshes, run_into).items():
            self.sizes[wheel] = sizes[wheel].on(*shelf)

    def _hung(self, labels: set[str]) -> Iterator[tuple[PitchContact, int, Vector]]:
        """Crossing pairs with an axis that stands: the pair, the side that is new, and a point of the new axis."""
        for touch in self.crossing:
            for new in (0, 1):
                known = touch.wheels[1 - new]
                if touch.axes[new] in labels and touch.axes[1 - new] in self.points and known in self.centres:
                    seat = self.seats[touch.name][1 - new]
                    way = self.reading.lines[touch.axes[1 - new]].way
                    point = plus(self.centres[known], way, -seat.far)
                    if touch.kind == "screw":
                        far = sum(self.sizes[wheel].radius for wheel in touch.wheels)
                        point = plus(point, seat.out, far)
                    yield touch, new, point

    def _fixed(
        self, lines: list[AxisLine], hung: list[tuple[PitchContact, int, Vector]], x: Vector, y: Vector
    ) -> dict[str, Point]:
        fixed = {line.label: flat(line.given, x, y) for line in lines if line.given is not None}
        for touch, new, point in hung:
            fixed.setdefault(touch.axes[new], flat(point, x, y))
        if fixed:
            return fixed
        labels = [line.label for line in lines]
        for touch in self.crossing:  # nothing of these stands, but an axis they meet is given
            for new in (0, 1):
                other = self.reading.lines[touch.axes[1 - new]]
                if touch.axes[new] in labels and other.given is not None:
                    return {touch.axes[new]: flat(other.given, x, y)}
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
        some = [label for label in labels if len(met[label]) > 1]
        return [label for label in some if any(len(met[label] & met[other]) > 1 for other in some if other != label)]

    def _demands(self, hung: list[tuple[PitchContact, int, Vector]], n: Vector) -> list[HeightConstraint]:
        demands = []
        for touch, new, point in hung:
            wheel = touch.wheels[new]
            way = self.reading.lines[touch.axes[new]].way
            seat = self.seats[touch.name][new]
            at = plus(point, way, seat.far)
            demands.append(HeightConstraint(wheel, dot(at, n)))
        return demands


def upwards(way: Vector) -> Vector:
    """The same direction for both senses: z, or what is nearest to it, upwards."""
    last = next(part for part in way[::-1] if abs(part) > 1e-12)
    return way if last > 0 else (-way[0], -way[1], -way[2])
