"""Groups of parallel axes placed one after the other: each is planned and stacked, held by what stands already."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from geartrain.numerics.vectors import Vector, dot, plus
from geartrain.scene.layout.axial_slots import find_axial_slots
from geartrain.scene.layout.declared_geometry import Parallels, Point, upwards
from geartrain.scene.layout.plan_problem import plan_problem
from geartrain.scene.layout.plan_search import plan_axes
from geartrain.scene.layout.stack_blocks import HeightConstraint, build_wheel_stack
from geartrain.scene.layout.swept_overlap import SweptDistances, swept_distances
from geartrain.scene.layout.wheel_sizes import CrossingSide, SizedGeometry
from geartrain.scene.layout.wheel_stacks import WheelStack

_ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Arrangement:
    """Where all stands (mm).

    geometry   with the wheels as broad as they were made
    points     of axes; centres, of wheels
    stacks     of each group of parallels
    main, up   the group of parallels with most wheels, and its direction upwards
    """

    geometry: SizedGeometry
    points: Mapping[str, Vector]
    centres: Mapping[str, Vector]
    stacks: Sequence[WheelStack]
    main: int
    up: Vector


def arrange(geometry: SizedGeometry) -> Arrangement:
    """All groups of parallels, that with most wheels first, then those that mesh with what stands."""
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


@dataclass(frozen=True, slots=True)
class _HeldAxis:
    """A new axis that meshes with one that stands: the pair as the new side sees it, and a point of the axis."""

    crossing: CrossingSide
    point: Vector


class _Placing:
    """Groups placed so far; `place` adds one.

    Broadened wheels change `geometry`: later groups, and diagnostics, must see them as they are.
    """

    def __init__(self, geometry: SizedGeometry) -> None:
        self.geometry = geometry
        self.points: dict[str, Vector] = {}
        self.centres: dict[str, Vector] = {}
        self.stacks: list[WheelStack] = []

    def place(self, parallels: Parallels) -> None:
        """Plan some parallels, make wheels as broad as the plan needs, and stack them."""
        held = list(self._held(parallels))
        fixed = self._fixed(parallels, held)
        places = plan_axes(plan_problem(self.geometry, parallels, fixed, self.points))
        swept = swept_distances(parallels.lines, places)
        self._broaden(parallels, swept)
        stack = build_wheel_stack(self.geometry, parallels, places, swept, self._constraints(parallels, held))
        self.stacks.append(stack)
        feet = {label: parallels.foot(place) for label, place in places.items()}
        for line in parallels.lines:
            self.points[line.label] = line.given or feet[line.label]
        for wheel, height in stack.heights().items():
            self.centres[wheel] = plus(feet[self.geometry.declared.axis[wheel]], parallels.up, height)

    def _held(self, parallels: Parallels) -> Iterator[_HeldAxis]:
        for each in self.geometry.crossing:
            side = each.side
            if side.axis in parallels.index and side.mate_axis in self.points and side.mate in self.centres:
                direction = self.geometry.declared.lines[side.mate_axis].direction
                point = plus(self.centres[side.mate], direction, -each.mate_seat.far)
                if each.contact.kind == "screw":
                    far = sum(self.geometry.sizes[wheel].radius for wheel in each.contact.wheels)
                    point = plus(point, each.mate_seat.out, far)
                yield _HeldAxis(each, point)

    def _fixed(self, parallels: Parallels, held: Sequence[_HeldAxis]) -> dict[str, Point]:
        """Points in plan of the axes that cannot be moved; of one, if nothing fixes any."""
        fixed = {line.label: parallels.flat(line.given) for line in parallels.lines if line.given is not None}
        for new in held:
            fixed.setdefault(new.crossing.side.axis, parallels.flat(new.point))
        if fixed:
            return fixed
        labels, declared = list(parallels.index), self.geometry.declared
        for each in self.geometry.crossing:  # nothing of these stands, but an axis they meet is given
            given = declared.lines[each.side.mate_axis].given
            if each.side.axis in parallels.index and given is not None:
                return {each.side.axis: parallels.flat(given)}
        driven = [label for label in labels if label == declared.driven]
        return dict.fromkeys(self._in_line(parallels) or driven or labels[:1], (0.0, 0.0))

    def _in_line(self, parallels: Parallels) -> list[str]:
        """Parallels that are one line: two axes across, not parallel to each other, meet each of them.

        Or one wheel across does, for the cones of all its mates have one apex.
        """
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
        """Make wheels broad that have mates one above the other."""
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

    def _constraints(self, parallels: Parallels, held: Sequence[_HeldAxis]) -> list[HeightConstraint]:
        """Heights of wheels whose axes are held by what stands."""
        found = []
        for new in held:
            side = new.crossing.side
            direction = self.geometry.declared.lines[side.axis].direction
            centre = plus(new.point, direction, new.crossing.seat.far)
            found.append(HeightConstraint(side.wheel, dot(centre, parallels.up)))
        return found
