"""Stack of a frame and its carriers: axes perpendicular to the plates, with their wheels as discs.

The stack includes the eccentrics on which wheels turn, and the pins in plates that move in round holes.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import atan2, ceil, dist, hypot, inf, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem
from geartrain.kinematics.buildability.equal_planets import ON_ECCENTRIC
from geartrain.numerics.vectors import Vector, basis, dot, plus, scaled, size
from geartrain.scene.bodies import bent_wheels
from geartrain.scene.joints import coupling_sizes, pin_and_hole
from geartrain.scene.layout.declared_geometry import upwards
from geartrain.scene.parts.arbor_columns import HEAD_ROOM
from geartrain.scene.parts.carried_axes import CarriedAxis
from geartrain.scene.parts.eccentrics import (
    ROOM,
    USUAL_ARBOR,
    WALL,
    Eccentric,
    FlexibleCup,
    PinCircle,
    Wave,
    eccentric_radius,
    on_eccentrics,
)
from geartrain.scene.parts.stack_discs import Passage, Point, StackDisc, slabs
from geartrain.teeth.couplings.pins import Parallel, PinsInHoles
from geartrain.teeth.outlines.fixed_teeth import CUP, wall
from geartrain.teeth.standard_teeth import DEDENDUM

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.layout import AxisPlace, Layout, WheelPlace
    from geartrain.scene.solids.wheel_blanks import Blank

_SAME = 1e-6  # mm: tolerance for equal heights
_UPRIGHT = 1e-9  # maximum cosine of an axis perpendicular to the normal
_PASS = 0.4  # mm of clearance round a wheel that passes through a plate
_PARALLEL = 1e-9  # of a cosine: smaller differences are rounding errors
_RIM = 2.0  # modules of rim outside the teeth of a ring without a flat shape


@dataclass(frozen=True, slots=True)
class AcrossWheel:
    """Wheel on an axis that is not upright: the heights between which it extends, and circles that contain it."""

    name: str
    low: float
    high: float
    circles: tuple[tuple[Point, float], ...]
    section: tuple[Point, Point, float, float, float] | None = None
    """Section of a wheel on an axis of the frame that is perpendicular to the normal; None for other wheels.

    The items are: centre in the plane of the stack, direction of the axis in that plane, height, radius, and half the
    thickness of the wheel [mm].
    """

    def passage(self, faces: tuple[float, float]) -> Passage | None:
        """Return the passage of the wheel through a plate; None if it does not meet the plate or has no section."""
        if self.section is None:
            return None
        (x, y), (u, v), height, reach, half = self.section
        near = max(faces[0] - height, height - faces[1], 0.0)
        if near >= reach:
            return None
        return Passage((x, y), (-v, u), sqrt((reach + _PASS) ** 2 - near**2), half + _PASS)

    def is_between(self, low: float, high: float) -> bool:
        """Return True if a part of the wheel is between two heights [mm]."""
        return self.low < high and low < self.high


def find_normal(train: GearTrain, layout: Layout) -> Vector | None:
    """Return the direction of the axes on which most wheels of the frame are mounted; None if there are none."""
    count: Counter[Vector] = Counter()
    for place in layout.wheels.values():
        axis = layout.axes[place.axis]
        if axis.carrier == train.declaration.frame:
            x, y, z = (round(each, 12) for each in upwards(axis.direction))
            count[x + 0.0, y + 0.0, z + 0.0] += 1  # both senses of a direction count as one; + 0.0 removes -0.0
    return count.most_common(1)[0][0] if count else None


@dataclass(frozen=True)
class FrameStack:
    """Train with its positions in the plan view of its plates."""

    train: GearTrain
    layout: Layout
    blanks: Mapping[str, Blank]
    normal: Vector
    """Unit vector perpendicular to the plates, along which heights increase."""
    core: float | None = None
    """Diameter of all arbors [mm]; None if it may be chosen."""

    @property
    def frame(self) -> str:
        """Fixed link of the train."""
        return self.train.declaration.frame

    @cached_property
    def turn(self) -> Floats:
        """Rotation matrix, shape (3, 3), with the rightward and upward directions and the normal as its columns."""
        return np.column_stack([*basis(self.normal), self.normal])

    def in_space(self, at: Point, height: float = 0.0) -> Vector:
        """Return the point in space [mm] that has the given plan-view coordinates and height in the stack."""
        x, y, z = (self.turn @ np.array([*at, height])).tolist()
        return x, y, z

    @cached_property
    def axes(self) -> dict[str, AxisPlace]:
        """Axes of the frame that are perpendicular to its plates, by label."""
        return {
            label: axis
            for label, axis in self.layout.axes.items()
            if axis.carrier == self.frame and self.is_upright(axis)
        }

    def is_upright(self, axis: AxisPlace) -> bool:
        """Return True if an axis is perpendicular to the plates."""
        return abs(abs(dot(axis.direction, self.normal)) - 1) < _PARALLEL

    def flat(self, point: Vector) -> Point:
        """Return the coordinates of a point in the plan view of the plates [mm]."""
        right, up = basis(self.normal)
        return dot(point, right), dot(point, up)

    @cached_property
    def carried(self) -> dict[str, CarriedAxis]:
        """Axes that are carried by a carrier which is itself on an axis of the frame, by label."""
        return {
            label: CarriedAxis(
                label,
                axis.carrier,
                self.flat(axis.point),
                tuple(disc for disc in self.discs if disc.axis == label),
                frozenset(name for each in self.eccentrics if each.axis == label for name in each.wheels),
            )
            for label, axis in self.layout.axes.items()
            if self.carrier_axis(axis)
            and label not in self.on_eccentrics
            and any(disc.axis == label for disc in self.discs)
        }

    def carrier_axis(self, axis: AxisPlace) -> str | None:
        """Return the axis of the frame about which an upright axis is carried; None if there is no such axis."""
        if axis.carrier == self.frame or not self.is_upright(axis):
            return None
        own = self.train.kinematics.tree.axis(axis.carrier)
        return own if own in self.axes else None

    @cached_property
    def discs(self) -> tuple[StackDisc, ...]:
        """Discs of the wheels on axes of the frame and of its carriers, and of the eccentrics."""
        return tuple(on_eccentrics(self.wheel_discs, self.eccentrics))

    @cached_property
    def wheel_discs(self) -> tuple[StackDisc, ...]:
        """Discs of the wheels on axes of the frame and of its carriers."""
        return tuple(self._discs())

    def _discs(self) -> Iterator[StackDisc]:
        for name, place in self.layout.wheels.items():
            axis = self.layout.axes[place.axis]
            about = None if place.axis in self.axes else self.carrier_axis(axis)
            if place.axis not in self.axes and about is None:
                continue
            blank, height = self.blanks.get(name), dot(place.centre, self.normal)
            ring = self.train.declaration.wheels[name][1].internal
            out = -1 if ring else 1
            span = [end * dot(axis.direction, self.normal) for end in place.span]
            tip = blank.tip_radius if blank else place.radius + out * place.module
            root = blank.root_radius if blank else place.radius - out * DEDENDUM * place.module
            edge = tip if blank is None or blank.kind == "external" else rim(blank)
            if ring and blank is None:
                edge = root + _RIM * place.module
            yield StackDisc(
                name,
                place.link,
                place.axis,
                self.flat(place.centre),
                height + min(span),
                height + max(span),
                max(edge, root),
                tip if ring else 0.0,
                min(root, edge),
                not ring,
                None if about is None else self.flat(self.layout.axes[about].point),
            )

    @cached_property
    def eccentrics(self) -> tuple[Eccentric, ...]:
        """All eccentrics of the stack."""
        return tuple(find_eccentrics(self))

    @cached_property
    def on_eccentrics(self) -> frozenset[str]:
        """Labels of the axes whose wheels turn on eccentrics."""
        return frozenset(each.carried for each in self.eccentrics)

    @cached_property
    def pin_circles(self) -> dict[str, PinCircle]:
        """Circles of pins that a plate carries because no wheel of their link is large enough, by coupling."""
        return {each.name: each for each in find_pin_circles(self)}

    @cached_property
    def cups(self) -> tuple[FlexibleCup, ...]:
        """Cup walls that connect flexible wheels to other links."""
        return tuple(find_cups(self))

    @property
    def ends(self) -> dict[str, tuple[bool, bool]]:
        """Flags (below, above) that are True if the shaft of a link extends out of the mechanism at that end, by link.

        In a cycloidal or strain wave drive, the eccentric shaft extends below, and the link of the pins or of the cup
        extends above. With parallel cranks, their carrier extends below, and the wheels about its axis extend above.
        """
        # eccentrics on the main axis: a cycloidal or strain wave drive; on carried axes: parallel cranks
        inner = {each.link for each in self.eccentrics if each.axis in self.axes}
        if inner:
            pins = {each.link for each in self.pin_circles.values()} | {cup.link for cup in self.cups}
            return dict.fromkeys(inner, (True, False)) | dict.fromkeys(pins - inner, (False, True))
        carriers = {self.layout.axes[each.axis].carrier for each in self.eccentrics}
        about = {self.train.kinematics.tree.axis(link) for link in carriers}
        drives = {disc.link for disc in self.wheel_discs if disc.axis in about and disc.hub}
        return dict.fromkeys(drives - {self.frame}, (False, True)) | dict.fromkeys(carriers, (True, False))

    @cached_property
    def tied(self) -> dict[str, tuple[float, float]]:
        """Heights between which no plate may be, as wheels on a crossing axis mesh there [mm], by axis."""
        heights: dict[str, list[float]] = {}
        upright = {disc.name: disc for disc in self.discs}
        for gear in self.train.declaration.gears:
            for one, other in (gear.pair, gear.pair[::-1]):
                if one in upright and other not in upright and other in self.layout.wheels:
                    found = heights.setdefault(self.layout.wheels[other].axis, [])
                    found += [upright[one].low, upright[one].high]
        return {label: (min(each), max(each)) for label, each in heights.items()}

    @cached_property
    def across(self) -> tuple[AcrossWheel, ...]:
        """Wheels on axes that are not perpendicular to the plates."""
        upright = {disc.name for disc in self.discs}
        return tuple(self._across(place) for name, place in self.layout.wheels.items() if name not in upright)

    def _across(self, place: WheelPlace) -> AcrossWheel:
        axis, outer = self.layout.axes[place.axis], place.radius + place.module
        below, above = place.span
        along, thick = dot(axis.direction, self.normal), (above - below) / 2 + place.module
        flat, (u, v) = sqrt(max(1 - along**2, 0.0)), self.flat(axis.direction)
        middle = plus(place.centre, axis.direction, (below + above) / 2)
        half, height = outer * flat + thick * abs(along), dot(middle, self.normal)
        (x, y), low, high = self.flat(middle), height - half, height + half
        about = None if axis.carrier == self.frame else self.train.kinematics.tree.axis(axis.carrier)
        if about is not None and about in self.layout.axes:
            centre = self.flat(self.layout.axes[about].point)
            return AcrossWheel(place.wheel, low, high, ((centre, dist(centre, (x, y)) + hypot(outer, thick)),))
        if not flat:
            return AcrossWheel(place.wheel, low, high, (((x, y), outer),))
        # in plan the wheel is a strip: circles with its half width as radius cover it
        count = max(1, ceil(outer / thick))
        steps = [outer * k / count / flat for k in range(-count, count + 1)]
        circles = tuple(((x - v * step, y + u * step), thick) for step in steps)
        upright = abs(along) < _UPRIGHT and self.train.declaration.wheels[place.wheel][1].kind != "worm"
        section = ((x, y), (u, v), height, outer, (above - below) / 2) if upright else None
        return AcrossWheel(place.wheel, low, high, circles, section)

    def raised(self, shift: Callable[[float], float]) -> Layout:
        """Return the layout with wheels shifted along the normal; wheels on other axes are shifted with their mates.

        shift   function of the height [mm] that returns the shift [mm]
        """
        normal, old = self.normal, self.layout
        rise = {disc.name: shift(disc.middle) for disc in self.discs}
        across = {label: shift(sum(ends) / 2) for label, ends in self.tied.items()}
        wheels = {
            name: replace(place, centre=_moved(place.centre, normal, rise.get(name, across.get(place.axis, 0.0))))
            for name, place in old.wheels.items()
        }
        axes = {
            label: replace(axis, point=_moved(axis.point, normal, across.get(label, 0.0)))
            for label, axis in old.axes.items()
        }
        return replace(old, wheels=wheels, axes=axes)

    def with_head_room(self) -> FrameStack:
        """Return the stack with space reserved for heads of studs next to the wheels of carriers, and for washers."""
        taken = slabs(self.wheel_discs, list(self.tied.values())) if self.carried or self.eccentrics else []
        if not taken:
            return self
        ends = [(face, HEAD_ROOM) for each in self.carried.values() for face in _ends(each.discs)]
        ends += [(face, HEAD_ROOM + ROOM) for each in self.eccentrics for face in _ends(each.turning(self.wheel_discs))]
        starts, shifts, rise = [taken[0][0]], [0.0], 0.0
        for below, above in pairwise(taken):
            room = max((room for face, room in ends if below[0] - _SAME < face < above[1] + _SAME), default=0.0)
            rise += max(0.0, room - (above[0] - below[1])) if room else 0.0
            starts.append(above[0])
            shifts.append(rise)
        return replace(self, layout=self.raised(lambda height: shifts[max(bisect_right(starts, height) - 1, 0)]))

    def omitted(self) -> Iterator[Problem]:
        """Yield a problem for each axis that has wheels but no bearings."""
        for label, axis in self.layout.axes.items():
            used = any(place.axis == label for place in self.layout.wheels.values())
            if used and label not in self.axes and label not in self.carried and label not in self.on_eccentrics:
                why = "it is not perpendicular to the plates"
                if self.is_upright(axis):
                    why = f"its carrier '{axis.carrier}' does not turn about a frame axis perpendicular to the plates"
                what = f"axis '{label}' has no bearings"
                yield Problem(what, why, f"make a bracket for it on '{axis.carrier}' by hand")


def rim(blank: Blank) -> float:
    """Return the outer radius of a ring, or of the discs of a lantern pinion [mm]."""
    return float(abs(blank.contours[0].points).max())


def _ends(discs: Sequence[StackDisc]) -> tuple[float, float]:
    """Return the lowest and highest face of a set of discs [mm]."""
    return min(disc.low for disc in discs), max(disc.high for disc in discs)


def _moved(point: Vector, normal: Vector, by: float) -> Vector:
    return plus(point, scaled(normal, by)) if by else point


# -------------------------------------------------------------------------------------------------- eccentrics and pins

_BESIDE = 1.0  # mm of clearance between the central hole of a wheel and an arbor in it


def find_eccentrics(stack: FrameStack) -> Iterator[Eccentric]:
    """Yield the eccentrics of a stack. If several have the same name, numbers are added from the second eccentric on.

    A wheel whose carried axis is close to the axis of its carrier turns on an eccentric of the carrier. If the carrier
    represents parallel cranks, each crank has an eccentric.
    """
    count: Counter[str] = Counter()
    waves = {each.wheel: each for each in bent_wheels(stack.train, stack.layout)}
    for label, axis in stack.layout.axes.items():
        own = stack.carrier_axis(axis)
        discs = [disc for disc in stack.wheel_discs if disc.axis == label]
        if own is None or len(slabs(discs)) != 1:  # wheels at different heights are connected by a pipe
            continue
        at = _place(stack, own)
        if dist(at, discs[0].at) >= ON_ECCENTRIC * min(disc.root for disc in discs):
            continue
        if bent := next((waves[disc.name] for disc in discs if disc.name in waves), None):
            (x, y), blank = _place(stack, label), stack.blanks[bent.wheel]
            thin, towards = wall(blank.pitch_radius), atan2(y - at[1], x - at[0])
            wave = Wave(size(bent.offset), bent.lobes, thin, towards, CUP * 2 * blank.pitch_radius)
            name, radius = f"{bent.link} wave", blank.root_radius - thin
            found = [Eccentric(name, bent.link, bent.axis, at, at, radius, (bent.wheel,), label, wave=wave)]
        elif cranks := list(_cranks(stack, axis.carrier, own)):
            found = list(_on_cranks(stack, cranks, at, label, discs))
        else:
            found = [_on_arbor(stack, axis.carrier, own, label, discs)]
        for each in found:
            count[each.name] += 1
            yield each if count[each.name] == 1 else replace(each, name=f"{each.name} {count[each.name]}")


def _place(stack: FrameStack, label: str) -> Point:
    return stack.flat(stack.layout.axes[label].point)


def _on_arbor(stack: FrameStack, link: str, own: str, label: str, discs: Sequence[StackDisc]) -> Eccentric:
    at, centre, links = _place(stack, own), discs[0].at, {disc.link for disc in discs}
    free = min((circle.free for circle in stack.pin_circles.values() if circle.slot in links), default=inf)
    free = min([free, *(disc.root for disc in discs)])
    radius = eccentric_radius(dist(at, centre), _arbor(stack, link), free)
    return Eccentric(f"{link} eccentric", link, own, at, centre, radius, tuple(d.name for d in discs), label)


def _arbor(stack: FrameStack, link: str) -> float | None:
    """Return the requested or declared diameter of a link's arbor [mm]; None if neither exists."""
    declared = stack.train.declaration.links[link].arbor
    return stack.core if stack.core is not None or declared is None else 1000 * declared.diameter.si


def _cranks(stack: FrameStack, link: str, own: str) -> Iterator[tuple[str, str, str]]:
    """Yield the link, axis and coupling of each parallel crank that the carrier `link` on the axis `own` represents."""
    tree = stack.train.kinematics.tree
    for coupling in stack.train.declaration.pin_couplings:
        pair = coupling.pin, coupling.slot
        if isinstance(coupling, Parallel) and link in pair:
            crank = pair[1 - pair.index(link)]
            label = tree.axis(crank) or ""
            place = stack.layout.axes.get(label)
            if place is not None and stack.carrier_axis(place) == own:
                yield crank, label, coupling.name


def _on_cranks(
    stack: FrameStack, cranks: Sequence[tuple[str, str, str]], at: Point, label: str, discs: Sequence[StackDisc]
) -> Iterator[Eccentric]:
    centre = discs[0].at
    offset, places = dist(at, centre), [_place(stack, own) for _, own, _ in cranks]
    middle = round(offset + (USUAL_ARBOR if stack.core is None else stack.core) / 2 + _BESIDE, 2)
    wheels, root = tuple(disc.name for disc in discs), min(disc.root for disc in discs)
    for (link, own, name), place in zip(cranks, places, strict=True):
        away = dist(place, at)
        free = min([root - away, away - middle, *(dist(place, other) / 2 for other in places if other != place)])
        moved = place[0] + centre[0] - at[0], place[1] + centre[1] - at[1]
        radius = eccentric_radius(offset, _arbor(stack, link), free)
        yield Eccentric(f"{link} eccentric", link, own, place, moved, radius, wheels, label, middle, name)


def find_cups(stack: FrameStack) -> Iterator[FlexibleCup]:
    """Yield the cup walls that connect flexible wheels to links on axes of the frame."""
    declared, tree = stack.train.declaration, stack.train.kinematics.tree
    for coupling in (each for each in declared.pin_couplings if isinstance(each, Parallel)):
        for cup, thin in ((coupling.pin, coupling.slot), (coupling.slot, coupling.pin)):
            own = [disc for disc in stack.wheel_discs if disc.link == thin and declared.wheels[disc.name][1].flexible]
            place = stack.layout.axes.get(tree.axis(cup) or "")
            if own and place is not None and place.carrier == declared.frame and stack.is_upright(place):
                blank, at = stack.blanks[own[0].name], stack.flat(place.point)
                yield FlexibleCup(
                    coupling.name, cup, thin, own[0].name, at, blank.root_radius, wall(blank.pitch_radius)
                )


def find_pin_circles(stack: FrameStack) -> Iterator[PinCircle]:
    """Yield the circles of pins in round holes for which the link of the pins has no wheel of sufficient size."""
    for declared in stack.train.declaration.pin_couplings:
        places = [
            stack.layout.axes.get(stack.train.kinematics.tree.axis(link) or "")
            for link in (declared.pin, declared.slot)
        ]
        if not isinstance(declared, PinsInHoles) or not all(each and stack.is_upright(each) for each in places):
            continue
        first, second = (stack.flat(each.point) for each in places if each)
        radius, offset = coupling_sizes(declared, dist(first, second))
        pin, hole = pin_and_hole(declared, radius, offset)
        wide = radius + pin / 2 + WALL
        if not any(disc.link == declared.pin and disc.hub and disc.root > wide for disc in stack.wheel_discs):
            yield PinCircle(declared.name, declared.pin, declared.slot, radius, pin, hole)
