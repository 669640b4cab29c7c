"""Placement of groups of parallel axes, one after the other. The plan and the stacks of each group are subject to the
axes that are already placed.

Stacks: wheels that mesh are at one height, or at fixed relative heights. A weighted union-find of heights groups these
wheels into stacks. A wheel on a crossing axis has a fixed height relative to its mate, and occupies space in the stack
of its mate.

Broad wheels: two wheels that share a mate and would collide get separate slots along its width, by depth-first search
with backtracking. Each mesh is assigned to a slot, a wheel spans the slots of its meshes, and no two wheels that
overlap in plan share a slot. The number of slots is minimised.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import hypot, sqrt
from typing import NamedTuple

import numpy as np

from geartrain.numerics.graphs import DisjointSets, joined_groups
from geartrain.numerics.vectors import Vector, dot, plus
from geartrain.scene.layout.declared_geometry import AxisLine, CouplingTie, Parallels, Point, upwards
from geartrain.scene.layout.plan_problem import plan_problem
from geartrain.scene.layout.plan_search import plan_axes
from geartrain.scene.layout.swept_overlap import SweptDistances, WheelBlock, find_plan_overlap, swept_distances
from geartrain.scene.layout.wheel_modules import CrossingSide, SizedGeometry
from geartrain.scene.layout.wheel_reach import bare_reach
from geartrain.scene.layout.wheel_stacks import StackProblem, WheelStack

# --------------------------------------------------------------------------------------------------------- stack blocks


_GAP = 0.4  # gap between levels divided by the median thickness

Node = tuple[str, str]
"""Node of the union-find structure: ("wheel", name of a wheel) or ("axis", label of a crossing axis)."""


class _HeightSets:
    """Sets of wheels and crossing axes that keep their height differences (union-find with height differences)."""

    def __init__(self) -> None:
        self._above: dict[Node, tuple[Node, float]] = {}

    def find(self, node: Node) -> tuple[Node, float]:
        """Return the root of the tree that contains a node, and the height of the node above the root [mm]."""
        total = 0.0
        while (step := self._above.setdefault(node, (node, 0.0)))[0] != node:
            total += step[1]
            node = step[0]
        return node, total

    def join(self, node: Node, other: Node, above: float) -> None:
        """Place `node` at the height `above` the node `other` [mm], unless their relative height is already known."""
        (root, height), (base, low) = self.find(node), self.find(other)
        # an existing relation is kept: contradictory heights become collisions, which are reported
        if root != base:
            self._above[root] = (base, low + above - height)


def build_wheel_stack(
    geometry: SizedGeometry,
    parallels: Parallels,
    places: Mapping[str, Point],
    swept: SweptDistances,
    known: Mapping[str, float],
) -> WheelStack:
    """Return the stack of all wheels on a group of parallel axes, and of the crossing wheels that they mesh with.

    known   heights [mm] of wheels that are determined by parts that are already placed
    """
    builder = _BlockBuilder(geometry, parallels, places)
    blocks = builder.blocks()
    arbors = list(dict.fromkeys(block.link for block in blocks if block.link and block.link != parallels.frame))
    plates, pins = _plates(blocks, parallels), list(_pins(blocks, geometry.declared.ties))
    clash, pierce = find_plan_overlap(blocks, arbors, parallels, places, swept, plates, pins)
    problem = StackProblem(blocks, clash, pierce, arbors, geometry.declared.dial_ends, plates, pins, parallels.frame)
    thickness = [geometry.sizes[block.wheel].thickness for block in blocks]
    gap = _GAP * float(np.median(thickness)) if blocks else 1.0
    return WheelStack(parallels.up, problem, gap, swept, builder.given(known))


def _plates(blocks: Sequence[WheelBlock], parallels: Parallels) -> dict[str, str]:
    """Return, for each arbor, the widest wheel on the carrier that carries the axis of the arbor."""
    upright = [block for block in blocks if not block.across]
    widest = _widest(upright)
    bearers = {block.link: parallels.lines[block.axis].bearers[0] for block in upright}
    return {
        link: widest[bearer].wheel
        for link, bearer in bearers.items()
        if bearer in widest and parallels.frame not in (link, bearer)
    }


def _pins(blocks: Sequence[WheelBlock], ties: Sequence[CouplingTie]) -> Iterator[tuple[str, str]]:
    """Yield pairs of wheels that need different heights because a pin moves around the other axis.

    The first wheel is the widest on the link of the pin, the second the widest on the link of the slot.
    """
    widest = _widest([block for block in blocks if not block.across])
    for tie in ties:
        pin, slot = (widest.get(link) for link in tie.links)
        if tie.encloses and pin is not None and slot is not None and pin.stack != slot.stack:
            yield pin.wheel, slot.wheel


def _widest(blocks: Sequence[WheelBlock]) -> dict[str, WheelBlock]:
    """Return the block of the widest wheel of every link, by link."""
    found: dict[str, WheelBlock] = {}
    for block in blocks:
        if block.link not in found or block.outer > found[block.link].outer:
            found[block.link] = block
    return found


class _BlockBuilder:
    """Builder of the discs (`WheelBlock`) of all wheels in one group of parallel axes.

    crossing   gear pairs with one wheel on an axis of the group, with this wheel as their own wheel
    met        reference point of each crossing axis in the plan: its declared point, or the point of its first pair
    number     index of each set of parts with fixed relative heights
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
        for each in self.crossing:  # the height of a wheel is fixed relative to the crossing axis of its mate
            side = each.side
            above = each.seat.far * self._rise(self.declared.lines[side.axis])
            above += self._height_at(self.declared.lines[side.mate_axis], self.places[side.axis])
            self.heights.join(("wheel", side.wheel), ("axis", side.mate_axis), above)
        self._join_concurrent()

    def blocks(self) -> list[WheelBlock]:
        """Return the blocks of wheels on axes of the group, followed by the blocks of wheels on crossing axes."""
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

    def given(self, known: Mapping[str, float]) -> dict[int, float]:
        """Return the heights of stacks [mm] that placed parts or declared points of crossing axes fix, by index."""
        found: dict[int, float] = {}
        for wheel, height in known.items():
            stack, offset = self._stack(("wheel", wheel))
            found.setdefault(stack, height - offset)
        for each in self.crossing:
            point = self.declared.lines[each.side.mate_axis].given
            if point is not None:
                stack, offset = self._stack(("axis", each.side.mate_axis))
                found.setdefault(stack, dot(point, self.parallels.up) - offset)
        return found

    def _stack(self, node: Node) -> tuple[int, float]:
        """Return the index of the stack that contains a wheel or crossing axis, and its height in the stack [mm]."""
        root, height = self.heights.find(node)
        return self.number.setdefault(root, len(self.number)), height

    def _rise(self, line: AxisLine) -> float:
        """Return the component of an axis's direction along the direction in which heights increase."""
        return dot(line.direction, self.parallels.up)

    def _height_at(self, across: AxisLine, place: Point) -> float:
        """Return by how much a crossing axis rises from its reference point to a given point in the plan [mm]."""
        u, v = self.parallels.flat(across.direction)
        start = place if across.given is None else self.parallels.flat(across.given)
        x, y = self.met.setdefault(across.label, start)
        return ((place[0] - x) * u + (place[1] - y) * v) / (u * u + v * v) * self._rise(across)

    def _join_concurrent(self) -> None:
        """Fix the relative heights of crossing axes that intersect an axis of the group at one point."""
        met: dict[str, list[str]] = {}
        for each in self.crossing:
            met.setdefault(each.side.axis, []).append(each.side.mate_axis)
        for label, others in met.items():
            tied: DisjointSets[str] = DisjointSets()
            for each in self.all_crossing:
                if label not in (ends := (each.side.axis, each.side.mate_axis)):
                    tied.join(*ends)
            for one, other in combinations(dict.fromkeys(others), 2):
                if not tied.are_apart(one, other):
                    self.heights.join(("axis", one), ("axis", other), 0.0)

    def _across(self, each: CrossingSide) -> WheelBlock:
        """Return the disc of a mate on a crossing axis; its area in the plan is a strip, or a circle if carried."""
        side, far, size = each.side, each.mate_seat.far, self.sizes[each.side.mate]
        axis, across = self.declared.lines[side.axis], self.declared.lines[side.mate_axis]
        stack, offset = self._stack(("axis", side.mate_axis))
        offset += self._height_at(across, self.places[side.axis])
        u, v = self.parallels.flat(across.direction)
        flat, rise = hypot(u, v), self._rise(across)
        x, y = self.places[side.axis]
        offset += far * rise
        if each.contact.kind == "screw":  # skew axes: the distance is the sum of the radii
            reach = self.sizes[side.wheel].radius + size.radius
            aside = self.parallels.flat(each.seat.out)
            x, y = x + reach * aside[0], y + reach * aside[1]
            offset += reach * dot(each.seat.out, self.parallels.up)
        # half height of an inclined disc: its rim and its thickness, as perpendicular contributions
        tall = sqrt(size.outer**2 * flat**2 + (size.thickness * rise) ** 2)
        number = self.parallels.index[side.axis]
        if across.bearers[0] != axis.bearers[0]:
            swept = hypot(abs(far) * flat + size.thickness, size.outer)
            return WheelBlock(side.mate, number, "", stack, offset, tall, tall, 0.0, swept, across=True)
        x, y = x + far * u, y + far * v
        half, wide = size.outer, size.thickness + size.outer * abs(rise)
        trace = ((x + half * v / flat, y - half * u / flat), (x - half * v / flat, y + half * u / flat))
        return WheelBlock(side.mate, number, "", stack, offset, tall, tall, 0.0, wide, across=True, trace=trace)


# ---------------------------------------------------------------------------------------------------------- axial slots


_TRIES = 20_000  # maximum number of trials for one group of wheels; then they stay in one level


class AxialSlots(NamedTuple):
    """Range of axial positions (slots, from 0) of a wheel among wheels that lie next to each other on a broad mate."""

    low: int
    high: int


def find_axial_slots(meshes: Sequence[tuple[str, str]], overlap: Callable[[str, str], bool]) -> dict[str, AxialSlots]:
    """Return the slots of all wheels that must be axially separated or widened, by wheel; other wheels are omitted.

    meshes   pairs of meshing wheels on parallel axes
    overlap  function that returns True if two wheels at one height would collide
    """
    found: dict[str, AxialSlots] = {}
    for wheels in joined_groups([wheel for mesh in meshes for wheel in mesh], meshes):
        group = [mesh for mesh in meshes if mesh[0] in wheels]
        mates = {frozenset(mesh) for mesh in group}
        clashes: dict[str, list[str]] = {}
        for at, wheel in enumerate(wheels):
            for other in wheels[at + 1 :]:
                if frozenset((wheel, other)) not in mates and overlap(wheel, other):
                    clashes.setdefault(wheel, []).append(other)
                    clashes.setdefault(other, []).append(wheel)
        if clashes:
            found |= _find_spans(group, clashes)
    return found


def _find_spans(meshes: Sequence[tuple[str, str]], clashes: Mapping[str, Sequence[str]]) -> Mapping[str, AxialSlots]:
    """Return the slots of one group of wheels, by wheel (iterative deepening); empty if none are found in time."""
    tries = 0
    # one slot is not sufficient, because some wheels clash; the first success has the minimum number of slots
    for count in range(2, len(meshes) + 1):
        # an explicit stack, because a chain of meshes may exceed Python's recursion limit
        stack: list[tuple[int, Mapping[str, AxialSlots]]] = [(0, {})]
        while stack and tries < _TRIES:
            tries += 1
            at, spans = stack.pop()
            if at == len(meshes):
                return spans
            for slot in reversed(range(count)):
                wider = {**spans, **{wheel: _widened(spans.get(wheel), slot) for wheel in meshes[at]}}
                pairs = [
                    (wider[wheel], wider[other])
                    for wheel in meshes[at]
                    for other in clashes.get(wheel, ())
                    if other in wider
                ]
                if all(own.high < other.low or other.high < own.low for own, other in pairs):
                    stack.append((at + 1, wider))
    return {}


def _widened(span: AxialSlots | None, slot: int) -> AxialSlots:
    return AxialSlots(slot, slot) if span is None else AxialSlots(min(span.low, slot), max(span.high, slot))


# ------------------------------------------------------------------------------------------------------ parallel groups


_ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Arrangement:
    """Result of `arrange`: positions of all axes and wheels [mm], with the stacks of wheels."""

    geometry: SizedGeometry
    """Declared geometry, in which wheels whose mates are at different heights have been widened."""
    points: Mapping[str, Vector]
    """Points on the axes by label [mm]."""
    centres: Mapping[str, Vector]
    """Centres of the wheels by name [mm]."""
    stacks: Sequence[WheelStack]
    """Stack of the wheels of each group of parallel axes."""
    main: int
    """Index of the group of parallel axes with the most wheels; -1 for a train without axes."""
    up: Vector
    """Upward direction of the group `main`."""


def arrange(geometry: SizedGeometry) -> Arrangement:
    """Return the positions of all axes and wheels, placed in groups of parallel axes, one after the other."""
    declared = geometry.declared
    order = _order(geometry)
    placing = _Placing(geometry)
    for group in order:
        placing.place(Parallels.of([line for line in declared.lines.values() if line.group == group]))
    for wheel, axis in declared.axis.items():
        placing.centres.setdefault(wheel, placing.points.get(axis, _ORIGIN))
    main = order[0] if order else -1
    up = next((upwards(line.direction) for line in declared.lines.values() if line.group == main), (0.0, 0.0, 1.0))
    return Arrangement(placing.geometry, placing.points, placing.centres, placing.stacks, main, up)


def _order(geometry: SizedGeometry) -> list[int]:
    """Return the groups of parallel axes: the largest, then repeatedly the largest that meshes with earlier groups."""
    lines, axis = geometry.declared.lines, geometry.declared.axis
    count = dict.fromkeys((line.group for line in lines.values()), 0)
    axes = Counter(line.group for line in lines.values())
    for label in axis.values():
        if label in lines:
            count[lines[label].group] += 1
    joined = {(lines[each.side.axis].group, lines[each.side.mate_axis].group) for each in geometry.crossing}
    order: list[int] = []
    while len(order) < len(count):
        rest = [group for group in count if group not in order]
        near = [group for group in rest if any((group, other) in joined for other in order)]
        order.append(max(near or rest, key=lambda group: (count[group], -axes[group], -group)))
    return order


class _Placing:
    """Positions of the groups of parallel axes placed so far; `place` adds a group.

    If wheels are widened, `geometry` is updated, so that later groups and diagnostics use the final face widths.
    """

    def __init__(self, geometry: SizedGeometry) -> None:
        self.geometry = geometry
        self.points: dict[str, Vector] = {}
        self.centres: dict[str, Vector] = {}
        self.stacks: list[WheelStack] = []

    def place(self, parallels: Parallels) -> None:
        """Plan a group of parallel axes, widen its wheels as the plan requires, and stack its wheels."""
        determined = list(self._determined_axes(parallels))
        fixed = self._fixed(parallels, determined)
        places = plan_axes(plan_problem(self.geometry, parallels, fixed, self.points))
        swept = swept_distances(parallels.lines, places)
        self._broaden(parallels, swept)
        known: dict[str, float] = {}  # heights of the wheels whose axes are determined by placed parts
        for each, point in determined:
            direction = self.geometry.declared.lines[each.side.axis].direction
            known.setdefault(each.side.wheel, dot(plus(point, direction, each.seat.far), parallels.up))
        stack = build_wheel_stack(self.geometry, parallels, places, swept, known)
        self.stacks.append(stack)
        feet = {label: parallels.foot(place) for label, place in places.items()}
        for line in parallels.lines:
            self.points[line.label] = line.given or feet[line.label]
        for wheel, height in stack.heights().items():
            self.centres[wheel] = plus(feet[self.geometry.declared.axis[wheel]], parallels.up, height)

    def _determined_axes(self, parallels: Parallels) -> Iterator[tuple[CrossingSide, Vector]]:
        """Yield each pair that meshes with a wheel placed earlier, and a point of its axis in the group [mm]."""
        for each in self.geometry.crossing:
            side = each.side
            if side.axis in parallels.index and side.mate_axis in self.points and side.mate in self.centres:
                direction = self.geometry.declared.lines[side.mate_axis].direction
                point = plus(self.centres[side.mate], direction, -each.mate_seat.far)
                if each.contact.kind == "screw":
                    far = sum(self.geometry.sizes[wheel].radius for wheel in each.contact.wheels)
                    point = plus(point, each.mate_seat.out, far)
                yield each, point

    def _fixed(self, parallels: Parallels, determined: Sequence[tuple[CrossingSide, Vector]]) -> dict[str, Point]:
        """Return the points in the plan of all axes that cannot move, by axis [mm].

        If all axes can move, one or more are placed at a declared crossing axis or at the origin.
        """
        fixed = {line.label: parallels.flat(line.given) for line in parallels.lines if line.given is not None}
        for each, point in determined:
            fixed.setdefault(each.side.axis, parallels.flat(point))
        if fixed:
            return fixed
        labels, declared = list(parallels.index), self.geometry.declared
        for each in self.geometry.crossing:  # none of these is fixed, but an axis that they intersect is
            given = declared.lines[each.side.mate_axis].given
            if each.side.axis in parallels.index and given is not None:
                return {each.side.axis: parallels.flat(given)}
        driven = [label for label in labels if label == declared.driven]
        return dict.fromkeys(self._collinear(parallels) or driven or labels[:1], (0.0, 0.0))

    def _collinear(self, parallels: Parallels) -> list[str]:
        """Return coincident axes: those that intersect the same crossing axes or mesh with one crossing wheel."""
        met: dict[str, set[int]] = {label: set() for label in parallels.index}
        mates: dict[str, list[str]] = {}
        for each in self.geometry.crossing:
            if each.side.axis in met and each.contact.kind != "screw":
                met[each.side.axis].add(self.geometry.declared.lines[each.side.mate_axis].group)
                mates.setdefault(each.side.mate, []).append(each.side.axis)
        for axes in mates.values():
            if len(set(axes)) > 1:
                return list(dict.fromkeys(axes))
        some = [label for label in met if len(met[label]) > 1]
        return [label for label in some if any(len(met[label] & met[other]) > 1 for other in some if other != label)]

    def _broaden(self, parallels: Parallels, swept: SweptDistances) -> None:
        """Widen each wheel whose mates would collide at one height, so that they can be one above the other."""
        axis, sizes, index = self.geometry.declared.axis, self.geometry.sizes, parallels.index

        def run_into(wheel: str, other: str) -> bool:
            return swept.overlap(sizes[wheel], index[axis[wheel]], sizes[other], index[axis[other]])

        crossing = {each.side.wheel for each in self.geometry.crossing}
        meshes = [
            contact.wheels
            for contact in self.geometry.declared.contacts
            if contact.parallel and contact.axes[0] in index and not crossing & set(contact.wheels)
        ]
        broad = {
            wheel: sizes[wheel].across_slots(*slots) for wheel, slots in find_axial_slots(meshes, run_into).items()
        }
        self.geometry = replace(self.geometry, sizes={**sizes, **broad})
