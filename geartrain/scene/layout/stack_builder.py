"""The tower of some parallels: what keeps its height to what, and where wheels across reach into it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector, dot
from geartrain.scene.layout.axis_placement import Point
from geartrain.scene.layout.declared_geometry import AxisLine, DeclaredGeometry, PitchContact
from geartrain.scene.layout.plan_overlap import PlanOverlap, WheelBlock, find_plan_overlap, plates
from geartrain.scene.layout.wheel_geometry import Seat, WheelSize, rim
from geartrain.scene.layout.wheel_stacks import HeightConstraint, WheelStack

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


Node = tuple[str, str]


class _Heights:
    """Wheels and crossing axes that keep their heights to each other."""

    def __init__(self) -> None:
        self.head: dict[Node, tuple[Node, float]] = {}

    def find(self, node: Node) -> tuple[Node, float]:
        """The root, and the height over it."""
        total = 0.0
        while (step := self.head.setdefault(node, (node, 0.0)))[0] != node:
            total += step[1]
            node = step[0]
        return node, total

    def join(self, node: Node, other: Node, above: float) -> None:
        """Put a node `above` another (mm); the first word counts."""
        (root, height), (base, low) = self.find(node), self.find(other)
        if root != base:
            self.head[root] = (base, low + above - height)


def build_wheel_stack(
    reading: DeclaredGeometry,
    sizes: Mapping[str, WheelSize],
    seats: Mapping[str, tuple[Seat, Seat]],
    lines: Sequence[AxisLine],
    places: Mapping[str, Point],
    near: Floats,
    far: Floats,
    n: Vector,
    plane: tuple[Vector, Vector],
    demands: Sequence[HeightConstraint],
    ends: Mapping[str, tuple[bool, bool]],
) -> WheelStack:
    """Blocks of all wheels that stand upright on these axes, and of those across that mesh with them."""
    builder = _Builder(reading, sizes, seats, lines, places, n, plane)
    blocks = builder.blocks()
    frame = lines[0].bearers[-1]
    links = list(dict.fromkeys(block.link for block in blocks if block.link and block.link != frame))
    clash, pierce = find_plan_overlap(blocks, links, near, far, lines, places)
    gap = 0.4 * float(np.median([sizes[b.wheel].thickness for b in blocks if b.wheel in sizes])) if blocks else 1.0
    wanted = builder.wanted(demands)
    labels = [line.label for line in lines]
    return WheelStack(
        n, labels, PlanOverlap(blocks, clash, pierce, links, ends, plates(blocks, lines, frame)), gap, near, far, wanted
    )


class _Builder:
    def __init__(
        self,
        reading: DeclaredGeometry,
        sizes: Mapping[str, WheelSize],
        seats: Mapping[str, tuple[Seat, Seat]],
        lines: Sequence[AxisLine],
        places: Mapping[str, Point],
        n: Vector,
        plane: tuple[Vector, Vector],
    ) -> None:
        self.reading, self.sizes, self.seats, self.places = reading, sizes, seats, places
        self.n, self.plane = n, plane
        self.index = {line.label: at for at, line in enumerate(lines)}
        self.heights = _Heights()
        self.crossing = [
            (touch, side)
            for touch in reading.touches
            if touch.name in seats
            for side in (0, 1)
            if touch.axes[side] in self.index
        ]
        for touch in reading.touches:
            if touch.kind in ("side", "ring") and touch.axes[0] in self.index:
                first, second = touch.wheels
                above = sizes[first].shelf - sizes[second].shelf
                self.heights.join(("wheel", first), ("wheel", second), above)
        self.first: dict[str, Point] = {}
        for touch, side in self.crossing:
            self._cross(touch, side)
        self._concur()
        self.number: dict[Node, int] = {}

    def _cross(self, touch: PitchContact, side: int) -> None:
        """A wheel keeps its height to the axis across."""
        across = self.reading.lines[touch.axes[1 - side]]
        seat = self.seats[touch.name][side]
        above = seat.far * dot(self.reading.lines[touch.axes[side]].way, self.n)
        above += self._climb(across, self.places[touch.axes[side]])
        self.heights.join(("wheel", touch.wheels[side]), ("axis", across.label), above)

    def _climb(self, across: AxisLine, point: Point) -> float:
        """How much higher an axis across is over a point than where it was met first, or than its given point."""
        u, v = (dot(across.way, each) for each in self.plane)
        given = across.given
        start = (dot(given, self.plane[0]), dot(given, self.plane[1])) if given else None
        x, y = self.first.setdefault(across.label, start or point)
        return ((point[0] - x) * u + (point[1] - y) * v) / (u * u + v * v) * dot(across.way, self.n)

    def _concur(self) -> None:
        """Axes across that also mesh with each other go through one point of the axis that both meet."""
        met: dict[str, list[str]] = {}
        for touch, side in self.crossing:
            met.setdefault(touch.axes[side], []).append(touch.axes[1 - side])
        tied: dict[str, set[str]] = {}
        for touch in self.reading.touches:
            if touch.name in self.seats:
                for side in (0, 1):
                    tied.setdefault(touch.axes[side], set()).add(touch.axes[1 - side])
        for label, others in met.items():
            for other in dict.fromkeys(others):
                reached, waiting = {label, other}, [other]
                while waiting:
                    for next_ in sorted(tied[waiting.pop()] - reached):
                        reached.add(next_)
                        waiting.append(next_)
                for mate in others:
                    if mate in reached and mate != other:
                        self.heights.join(("axis", mate), ("axis", other), 0.0)

    def _stack(self, node: Node) -> tuple[int, float]:
        root, height = self.heights.find(node)
        return self.number.setdefault(root, len(self.number)), height

    def blocks(self) -> list[WheelBlock]:
        """Upright wheels, then traces of wheels across."""
        found = []
        coned = {touch.wheels[side]: self.seats[touch.name][side].cone for touch, side in self.crossing}
        sense = {touch.wheels[side]: self.seats[touch.name][side].far for touch, side in self.crossing}
        for wheel, axis in self.reading.axis.items():
            if axis not in self.index:
                continue
            size, (number, height) = self.sizes[wheel], self._stack(("wheel", wheel))
            cone = coned.get(wheel, 0.0)
            inward, outward = rim(cone, size.radius, size.thickness)
            up = sense.get(wheel, 1.0) * dot(self.reading.lines[axis].way, self.n) > 0
            low, high = (inward, outward) if up else (outward, inward)
            link = self.reading.wheels[wheel][0]
            found.append(WheelBlock(wheel, self.index[axis], link, number, height, low, high, size.inner, size.outer))
        for touch, side in self.crossing:
            found.append(self._across(touch, side))
        return found

    def _across(self, touch: PitchContact, side: int) -> WheelBlock:
        """The room of the mate of an upright wheel: a strip in plan, or all that its carrier sweeps."""
        axis, mate = touch.axes[side], touch.wheels[1 - side]
        across, size, seat = (
            self.reading.lines[touch.axes[1 - side]],
            self.sizes[mate],
            self.seats[touch.name][1 - side],
        )
        number, height = self._stack(("axis", across.label))
        height += self._climb(across, self.places[axis])
        u, v = (dot(across.way, each) for each in self.plane)
        flat, rise = hypot(u, v), dot(across.way, self.n)
        x, y = self.places[axis]
        offset = height + seat.far * rise
        if touch.kind == "screw":
            out = self.seats[touch.name][side].out
            reach = self.sizes[touch.wheels[side]].radius + size.radius
            x, y = x + reach * dot(out, self.plane[0]), y + reach * dot(out, self.plane[1])
            offset += reach * dot(out, self.n)
        tall = sqrt(size.outer**2 * flat**2 + (size.thickness * rise) ** 2)
        x, y = x + seat.far * u, y + seat.far * v
        if across.bearers[0] != self.reading.lines[axis].bearers[0]:
            reach = hypot(abs(seat.far) * flat + size.thickness, size.outer)
            return WheelBlock(mate, self.index[axis], "", number, offset, tall, tall, 0.0, reach, mate=True)
        half, wide = size.outer, size.thickness + size.outer * abs(rise)
        trace = ((x + half * v / flat, y - half * u / flat), (x - half * v / flat, y + half * u / flat))
        return WheelBlock(mate, self.index[axis], "", number, offset, tall, tall, 0.0, wide, trace, mate=True)

    def wanted(self, demands: Sequence[HeightConstraint]) -> dict[int, float]:
        """Heights of stacks that are set by declared points of axes across, or by what stands."""
        found: dict[int, float] = {}
        for demand in demands:
            number, height = self._stack(("wheel", demand.wheel))
            found.setdefault(number, demand.height - height)
        for touch, side in self.crossing:
            given = self.reading.lines[touch.axes[1 - side]].given
            if given is not None:
                number, height = self._stack(("axis", touch.axes[1 - side]))
                found.setdefault(number, dot(given, self.n) - height)
        return found
