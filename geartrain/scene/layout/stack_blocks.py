"""From placed axes to the stack of their wheels: which keep their heights to each other, and what reaches in from
across.

Wheels that mesh stand at one height, or at fixed heights to each other: a weighted union-find of heights makes stacks
of them. Wheels on axes across keep their height to the wheel they mesh with, and take room in its stack.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np

from geartrain.numerics.vectors import dot
from geartrain.scene.layout.declared_geometry import AxisLine, Parallels, PinSlotTie, Point
from geartrain.scene.layout.stack_order import StackProblem
from geartrain.scene.layout.swept_overlap import SweptDistances, WheelBlock, find_plan_overlap
from geartrain.scene.layout.wheel_reach import bare_reach
from geartrain.scene.layout.wheel_sizes import CrossingSide, SizedGeometry
from geartrain.scene.layout.wheel_stacks import WheelStack

_GAP = 0.4  # of the median thickness: left free between levels

Node = tuple[str, str]
"""("wheel", its name), or ("axis", the label of an axis across)."""


@dataclass(frozen=True, slots=True)
class HeightConstraint:
    """A wheel whose height (mm) is set by what stands already."""

    wheel: str
    height: float


class _HeightSets:
    """Wheels and crossing axes that keep their heights to each other: a weighted union-find."""

    def __init__(self) -> None:
        self._above: dict[Node, tuple[Node, float]] = {}

    def find(self, node: Node) -> tuple[Node, float]:
        """The root, and the height over it."""
        total = 0.0
        while (step := self._above.setdefault(node, (node, 0.0)))[0] != node:
            total += step[1]
            node = step[0]
        return node, total

    def join(self, node: Node, other: Node, above: float) -> None:
        """Put a node `above` another (mm); the first word counts."""
        (root, height), (base, low) = self.find(node), self.find(other)
        if root != base:
            self._above[root] = (base, low + above - height)


def build_wheel_stack(
    geometry: SizedGeometry,
    parallels: Parallels,
    places: Mapping[str, Point],
    swept: SweptDistances,
    constraints: Sequence[HeightConstraint],
) -> WheelStack:
    """Blocks of all wheels that stand upright on these axes, and of those across that mesh with them."""
    builder = _BlockBuilder(geometry, parallels, places)
    blocks = builder.blocks()
    arbors = list(dict.fromkeys(block.link for block in blocks if block.link and block.link != parallels.frame))
    plates, pins = _plates(blocks, parallels), list(_pins(blocks, geometry.declared.ties))
    overlap = find_plan_overlap(blocks, arbors, parallels, places, swept, plates, pins)
    problem = StackProblem(blocks, overlap, arbors, geometry.declared.dial_ends, plates, pins, parallels.frame)
    thickness = [geometry.sizes[block.wheel].thickness for block in blocks]
    gap = _GAP * float(np.median(thickness)) if blocks else 1.0
    return WheelStack(parallels.up, problem, gap, swept, builder.given(constraints))


def _plates(blocks: Sequence[WheelBlock], parallels: Parallels) -> dict[str, str]:
    """The widest wheel of the carrier of each arbor, on which its axis is carried round."""
    upright = [block for block in blocks if not block.across]
    widest = _widest(upright)
    bearers = {block.link: parallels.lines[block.axis].bearers[0] for block in upright}
    return {
        link: widest[bearer].wheel
        for link, bearer in bearers.items()
        if bearer in widest and parallels.frame not in (link, bearer)
    }


def _pins(blocks: Sequence[WheelBlock], ties: Sequence[PinSlotTie]) -> Iterator[tuple[str, str]]:
    """The widest wheels of the links of a pin and its slot, where the pin's circle encloses the slot's axis."""
    widest = _widest([block for block in blocks if not block.across])
    for tie in ties:
        pin, slot = (widest.get(link) for link in tie.links)
        if tie.encloses and pin is not None and slot is not None and pin.stack != slot.stack:
            yield pin.wheel, slot.wheel


def _widest(blocks: Sequence[WheelBlock]) -> dict[str, WheelBlock]:
    """Of every link."""
    found: dict[str, WheelBlock] = {}
    for block in blocks:
        if block.link not in found or block.outer > found[block.link].outer:
            found[block.link] = block
    return found


class _BlockBuilder:
    """Blocks of one group of parallels.

    crossing   pairs with one of these axes, as the wheel on it sees them
    met        axis across -> where in plan its height is counted from: its given point, or where it was met first
    number     stacks, in the order in which they were asked for
    """

    def __init__(self, geometry: SizedGeometry, parallels: Parallels, places: Mapping[str, Point]) -> None:
        self.declared, self.sizes = geometry.declared, geometry.sizes
        self.parallels, self.places = parallels, places
        self.all_crossing = geometry.crossing
        self.crossing = [each for each in geometry.crossing if each.side.axis in parallels.index]
        self.heights = _HeightSets()
        self.met: dict[str, Point] = {}
        self.number: dict[Node, int] = {}
        for contact in self.declared.contacts:
            if contact.parallel and contact.axes[0] in parallels.index:
                first, second = contact.wheels
                above = self.sizes[first].slot - self.sizes[second].slot
                self.heights.join(("wheel", first), ("wheel", second), above)
        for each in self.crossing:
            self._hold_to_axis(each)
        self._join_concurrent()

    def blocks(self) -> list[WheelBlock]:
        """Upright wheels, then traces of wheels across."""
        seat = {each.side.wheel: each.seat for each in self.crossing}
        found = []
        for wheel, axis in self.declared.axis.items():
            if axis not in self.parallels.index:
                continue
            size, (stack, offset) = self.sizes[wheel], self._stack(("wheel", wheel))
            cone, far = (seat[wheel].cone, seat[wheel].far) if wheel in seat else (0.0, 1.0)
            outward, inward = bare_reach(cone, size.radius, size.thickness, size.module)
            up = far * self._rise(self.declared.lines[axis]) > 0
            low, high = (inward, outward) if up else (outward, inward)
            number, link = self.parallels.index[axis], self.declared.link(wheel)
            found.append(WheelBlock(wheel, number, link, stack, offset, low, high, size.inner, size.outer))
        return [*found, *(self._across(each) for each in self.crossing)]

    def given(self, constraints: Sequence[HeightConstraint]) -> dict[int, float]:
        """Heights of stacks that are set by what stands, or by declared points of axes across."""
        found: dict[int, float] = {}
        for constraint in constraints:
            stack, offset = self._stack(("wheel", constraint.wheel))
            found.setdefault(stack, constraint.height - offset)
        for each in self.crossing:
            point = self.declared.lines[each.side.mate_axis].given
            if point is not None:
                stack, offset = self._stack(("axis", each.side.mate_axis))
                found.setdefault(stack, dot(point, self.parallels.up) - offset)
        return found

    def _stack(self, node: Node) -> tuple[int, float]:
        """The number of a node's stack, and its height in it."""
        root, height = self.heights.find(node)
        return self.number.setdefault(root, len(self.number)), height

    def _rise(self, line: AxisLine) -> float:
        """How much a way of 1 along an axis goes up."""
        return dot(line.direction, self.parallels.up)

    def _hold_to_axis(self, each: CrossingSide) -> None:
        """A wheel keeps its height to the axis across."""
        side = each.side
        above = each.seat.far * self._rise(self.declared.lines[side.axis])
        above += self._climb(self.declared.lines[side.mate_axis], self.places[side.axis])
        self.heights.join(("wheel", side.wheel), ("axis", side.mate_axis), above)

    def _climb(self, across: AxisLine, place: Point) -> float:
        """How much higher an axis across is over a place than where it was met first, or than its given point."""
        u, v = self.parallels.flat(across.direction)
        start = place if across.given is None else self.parallels.flat(across.given)
        x, y = self.met.setdefault(across.label, start)
        return ((place[0] - x) * u + (place[1] - y) * v) / (u * u + v * v) * self._rise(across)

    def _join_concurrent(self) -> None:
        """Axes across that also mesh with each other go through one point of the axis that both meet."""
        met: dict[str, list[str]] = {}
        for each in self.crossing:
            met.setdefault(each.side.axis, []).append(each.side.mate_axis)
        tied: dict[str, set[str]] = {}
        for each in self.all_crossing:
            tied.setdefault(each.side.axis, set()).add(each.side.mate_axis)
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

    def _across(self, each: CrossingSide) -> WheelBlock:
        """The room of the mate of an upright wheel: a strip in plan, or all that its carrier sweeps."""
        side, far, size = each.side, each.mate_seat.far, self.sizes[each.side.mate]
        axis, across = self.declared.lines[side.axis], self.declared.lines[side.mate_axis]
        stack, offset = self._stack(("axis", side.mate_axis))
        offset += self._climb(across, self.places[side.axis])
        u, v = self.parallels.flat(across.direction)
        flat, rise = hypot(u, v), self._rise(across)
        x, y = self.places[side.axis]
        offset += far * rise
        if each.contact.kind == "screw":  # the axes pass each other, a radius of each wheel apart
            reach = self.sizes[side.wheel].radius + size.radius
            aside = self.parallels.flat(each.seat.out)
            x, y = x + reach * aside[0], y + reach * aside[1]
            offset += reach * dot(each.seat.out, self.parallels.up)
        tall = sqrt(size.outer**2 * flat**2 + (size.thickness * rise) ** 2)
        number = self.parallels.index[side.axis]
        if across.bearers[0] != axis.bearers[0]:
            swept = hypot(abs(far) * flat + size.thickness, size.outer)
            return WheelBlock(side.mate, number, "", stack, offset, tall, tall, 0.0, swept, across=True)
        x, y = x + far * u, y + far * v
        half, wide = size.outer, size.thickness + size.outer * abs(rise)
        trace = ((x + half * v / flat, y - half * u / flat), (x - half * v / flat, y + half * u / flat))
        return WheelBlock(side.mate, number, "", stack, offset, tall, tall, 0.0, wide, across=True, trace=trace)
