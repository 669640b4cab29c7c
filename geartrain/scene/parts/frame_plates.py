"""Outlines of the frame plates and their pillars, of rotating plates, and of the posts that support ring gears."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil, cos, dist, pi, sin

import numpy as np

from geartrain.errors import Problem
from geartrain.scene.parts.arbor_columns import AxisBearing, AxisColumn, FramePlaces
from geartrain.scene.parts.eccentrics import Eccentric, StandingPins, running_hole
from geartrain.scene.parts.frame_plan import FramePlan
from geartrain.scene.parts.pillar_places import TENON, blocked_posts, clear_of, nearer_plate, pillar_places, ring_posts
from geartrain.scene.parts.sleeves import Barrel, sleeves
from geartrain.scene.parts.stack_discs import Passage, Point, StackDisc, clear_passages, swept_circle, with_passages
from geartrain.scene.parts.turned_parts import Band, TurnedPart, column_parts, crosses
from geartrain.scene.solids.bearing_plates import around
from geartrain.teeth.outlines.contour import Contour

_PILLAR_MOST, _PILLAR_MINIMUM = 4.0, 1.5  # mm: radius of a pillar
_PILLAR_PART = 0.025  # over the diagonal of all turning parts between the plates: 10 mm in diameter at 200 mm
_LAND = 3.0  # mm: width of plate round a hole
_WIDE = 6.0  # minimum radius of a wave generator with windows, divided by its bore
_BLADE = 0.05  # mm: minimum web between holes


@dataclass(frozen=True, slots=True)
class Hole:
    """Round hole: its purpose, its centre in the coordinates of the stack [mm], and its diameter [mm]."""

    name: str
    at: Point
    diameter: float


@dataclass(frozen=True, slots=True)
class FlatPlate:
    """Plate perpendicular to the axis of the stack, with its edge, its holes and its heights."""

    link: str
    name: str
    outline: Contour
    """Edge of the plate in the coordinates of the stack [mm]."""
    holes: tuple[Hole, ...]
    low: float
    """Height of the plate's lower face along the normal [mm]."""
    high: float
    """Height of the plate's upper face along the normal [mm]."""
    at: Point = (0.0, 0.0)
    """Origin of the coordinates of the plate, in the coordinates of the stack [mm]."""
    windows: tuple[Contour, ...] = ()
    """Openings for crossing wheels and for brackets [mm]."""

    @property
    def contours(self) -> tuple[Contour, ...]:
        """Edge, round holes and windows, relative to `at` [mm]."""
        circles = (Contour.circle(each.diameter / 2, each.at) for each in self.holes)
        every = (self.outline, *circles, *self.windows)
        return tuple(Contour(each.points - np.array(self.at), each.bulges) for each in every)


def _windows(eccentric: Eccentric, bore: float) -> Iterator[Hole]:
    """Yield six or more round openings of a large wave generator, between its hub and its edge; none for others."""
    wave, radius = eccentric.wave, eccentric.radius
    if wave is None or radius < _WIDE * bore:
        return
    # a multiple of the number of lobes, so that the generator remains balanced
    count = wave.lobes * ceil(6 / wave.lobes)
    out = 0.55 * radius
    diameter = round(min(0.42 * radius, 1.6 * out * sin(pi / count)), 1)
    for at in range(count):
        angle = wave.towards + (2 * at + 1) * pi / count
        x, y = eccentric.centre
        yield Hole("window", (x + out * cos(angle), y + out * sin(angle)), diameter)


@dataclass(frozen=True)
class FramePlates:
    """Plates, pillars, posts and turned parts of a plan, with their outlines and holes."""

    plan: FramePlan
    feet: tuple[TurnedPart, ...] = ()
    """Feet of dials and the cock of a pendulum. Each is fixed in one of the plates."""
    mortises: Mapping[str, Sequence[Passage]] = field(default_factory=dict)
    """Mortises for brackets within the outline of a plate, by the name of the plate (back or front)."""
    standing: tuple[StandingPins, ...] = ()
    barrel: Barrel | None = None
    """Barrel from which a weight hangs; None for a train without a weight."""

    @cached_property
    def pillar(self) -> float:
        """Radius of a pillar [mm]."""
        places = self.plan.places
        turning = [(each.at, each.radius(places.back[1], places.front[0])) for each in self.plan.columns] + self.circles
        low, high = (
            [way(at[k] + side * reach for at, reach in turning) for k in (0, 1)] for way, side in ((min, -1), (max, 1))
        )
        return round(min(_PILLAR_MOST, max(_PILLAR_MINIMUM, _PILLAR_PART * dist(low, high))), 2)

    @cached_property
    def circles(self) -> list[tuple[Point, float]]:
        """Circles (centre and radius [mm]) that the parts between the plates sweep in all positions of carriers."""
        low, high = self.plan.places.back[0], self.plan.places.front[1]
        return [swept_circle(disc) for disc in self.plan.discs if low < disc.middle < high]

    @cached_property
    def pillars(self) -> list[Point]:
        """Centres of the pillars in the coordinates of the stack [mm]."""
        places = self.plan.places
        across = self.plan.across(places.back[0], places.front[1])
        axes = [column.at for column in self.plan.columns]
        axes += [at for each in self.standing if not each.seat for at in each.spots]  # a plate contains its pins too
        beside = [circle for side in self.mortises.values() for each in side for circle in each.circles]
        circles = [*self.circles, *beside]
        found = pillar_places(axes, circles, self.pillar, even=True)
        if all(clear_of(at, across) > self.pillar for at in found):  # nearer pillars give smaller plates
            return found
        return pillar_places(axes, [*circles, *across], self.pillar, even=True)

    @cached_property
    def bridge_pillars(self) -> list[Point]:
        """Centres of the pillars of a bridge, around all axes that extend into the bridge [mm]."""
        bridge = self.plan.bridge
        if bridge is None:
            return []
        low, high = min(bridge[0], self.plan.bridged_plate[1]), max(bridge[0], self.plan.bridged_plate[1])
        circles = [swept_circle(disc) for disc in self.plan.discs if low < disc.middle < high]
        circles += self.plan.across(low, high)
        circles += [(column.at, column.radius(low, high)) for column in self.plan.columns]
        circles += [(at, self.pillar) for at in self.pillars]
        return pillar_places([column.at for column in self.plan.columns if column.passes(bridge)], circles, self.pillar)

    def plates(self) -> Iterator[FlatPlate]:
        """Yield both plates of the frame, a bridge if there is one, the turning plates and the eccentrics."""
        for side, faces in self.sides.items():
            holes = tuple(self._frame_holes(faces))
            mortises = self.mortises.get(side, ())
            points = [*self.pillars, *(hole.at for hole in holes), *(at for each in mortises for at in each.corners)]
            circles = [(hole.at, hole.diameter / 2) for hole in holes]
            crossing = filter(None, (wheel.passage(faces) for wheel in self.plan.wheels_across))
            passages = clear_passages([*crossing, *mortises], circles)
            corners = _box(points) if self.plan.stack.train.declaration.escapement else points
            edge, windows = with_passages(around(corners, self.pillar + _LAND), passages)
            name = f"{self.plan.stack.frame} {side} plate"
            yield FlatPlate(self.plan.stack.frame, name, edge, holes, *faces, windows=windows)
        if self.plan.bridge is not None:
            holes = tuple(self._frame_holes(self.plan.bridge))
            edge = around([hole.at for hole in holes], self.pillar + _LAND)
            yield FlatPlate(self.plan.stack.frame, f"{self.plan.stack.frame} bridge", edge, holes, *self.plan.bridge)
        for plate in self.plan.turning:
            low, high = self.plan.heights.plates[plate.disc.name]
            holes = (*self._hub(plate.disc.name), *self.seat_holes(plate.disc.name))
            points, most = [hole.at for hole in holes], max(hole.diameter for hole in holes)
            edge = (
                Contour.circle(plate.disc.outer, plate.disc.at) if plate.round else around(points, most / 2 + _LAND - 1)
            )
            yield FlatPlate(plate.disc.link, plate.disc.name, edge, holes, low, high, plate.disc.at)
        for each in self.plan.stack.eccentrics:
            faces = each.faces(self._disc(each.name))
            holes = *self._hub(each.name), *_windows(each, self.plan.bores[each.name])
            yield FlatPlate(each.link, each.name, each.edge, holes, *faces, each.centre)

    def _disc(self, name: str) -> StackDisc:
        return next(disc for disc in self.plan.discs if disc.name == name)

    @cached_property
    def sides(self) -> Mapping[str, tuple[float, float]]:
        """Heights of the faces of each plate [mm], by name; the front plate is nearer to the dials or the viewer."""
        places, outside = self.plan.places, self.plan.choice.outside or self.plan.stack.layout.front
        names = ("back", "front") if outside > 0 else ("front", "back")
        return dict(zip(names, (places.back, places.front), strict=True))

    def _frame_holes(self, faces: tuple[float, float]) -> list[Hole]:
        own = self._tenon_holes(faces)
        return [*own, *self._disjoint(self._bearings(faces), own)]

    def _tenon_holes(self, faces: tuple[float, float]) -> list[Hole]:
        """Return the holes in a plate for the ends of pillars, and for posts, feet and pins."""
        press = self.plan.process.press
        pillars = [] if faces == self.plan.bridge else self.pillars
        if faces in (self.plan.bridge, self.plan.bridged_plate):
            pillars = [*pillars, *self.bridge_pillars]
        fixed = [pin for pin in self.pins if pin.link == self.plan.stack.frame]
        reaching = [
            post for post in (*self.posts, *self.feet, *fixed) if post.ends[0] <= faces[0] and faces[1] <= post.ends[1]
        ]
        return [
            *(Hole("pillar", at, 2 * TENON * self.pillar + press) for at in pillars),
            *(Hole(post.kind, post.at, 2 * post.bands[0].radius + press) for post in reaching),
        ]

    def _bearings(self, faces: tuple[float, float]) -> list[Hole]:
        return [hole for column in self.plan.columns if (hole := self._bearing(column, faces))]

    def _bearing(self, column: AxisColumn, faces: tuple[float, float]) -> Hole | None:
        """Return the hole in a plate for the arbor, pipe or stud on an axis; None if none of them reaches the plate."""
        process = self.plan.process
        middle = sum(faces) / 2
        passing = [
            each
            for each in column.members
            if crosses(each, faces) or (each.fixed and each.low < middle < each.high)  # a fixed piece ends in a plate
        ]
        if passing:
            widest = max(passing, key=lambda each: each.outer)
            return Hole(column.axis, column.at, widest.outer + (process.press if widest.fixed else process.running))
        if column.bearing is AxisBearing.THROUGH:
            turns = bool(column.members) and not column.members[0].inner
            return Hole(column.axis, column.at, column.pivot + process.running) if turns else None
        if column.bearing is AxisBearing.BRIDGE or faces == self.plan.bridge:
            return None
        own = self.plan.places.back if column.bearing is AxisBearing.BACK_STUD else self.plan.places.front
        return Hole(column.axis, column.at, column.core + process.press) if own == faces else None

    def seat_holes(self, seat: str) -> list[Hole]:
        """Return the holes in a wheel or plate for studs, posts, pins and eccentrics, but not for its own arbor."""
        eccentric = [
            Hole("eccentric", each.centre, running_hole(each, self.plan.process))
            for each in self.plan.stack.eccentrics
            if each.middle and seat in each.wheels  # a wheel that turns on several eccentrics
        ]
        return [*self._disjoint(self._seat_holes(seat), self._hub(seat)), *eccentric]

    def _hub(self, seat: str) -> list[Hole]:
        member = self.plan.members.get(seat)
        at = (disc.at for disc in self.plan.discs if disc.name == seat)
        return [] if member is None else [Hole("hub", next(at), self.plan.bores[seat])]

    def _disjoint(self, holes: Iterable[Hole], taken: Sequence[Hole]) -> list[Hole]:
        """Return the holes that intersect neither an earlier hole nor one of the holes in `taken`."""
        found: list[Hole] = []
        for hole in holes:
            if not any(_meet(hole, other) for other in (*taken, *found)):
                found.append(hole)
        return found

    def _seat_holes(self, seat: str) -> Iterator[Hole]:
        process = self.plan.process
        for label, column in self.plan.carried.items():
            if not column.on and self.plan.seat_of(self.plan.stack.carried[label].carrier) == seat:
                loose = column.bearing is AxisBearing.THROUGH
                yield Hole(label, column.at, column.core + (process.running if loose else process.press))
        for post in (*self.posts, *self.pins):
            if seat in post.through:
                yield Hole(post.kind, post.at, 2 * post.bands[0].radius + process.press)

    # ---------------------------------------------------------------------------------------------- pillars and posts

    def turned(self) -> Iterator[TurnedPart]:
        """Yield all turned parts: rods, sleeves, barrels, washers, walls of cups, pillars, posts, pins and feet."""
        plan = self.plan
        for column in plan.columns:
            bridged = column.bearing is AxisBearing.BRIDGE and plan.bridge is not None
            places = FramePlaces(plan.bridge, plan.bridge) if bridged and plan.bridge else plan.places
            yield from column_parts(column, places, plan.stack.frame, plan.process, plan.cut)
        for label, column in plan.carried.items():
            carrier = plan.stack.carried[label].carrier
            seat = next(disc for disc in plan.discs if disc.name == plan.seat_of(carrier))
            faces = FramePlaces((seat.low, seat.high), (seat.low, seat.high))
            yield from column_parts(column, faces, carrier, plan.process, plan.cut)
        yield from sleeves(plan, "" if self.barrel is None else self.barrel.wheel)
        if self.barrel is not None:
            yield self.barrel.part
        for each in plan.stack.eccentrics:
            yield from each.washers(self._disc(each.name), plan.bores[each.name])
        for cup in plan.stack.cups:
            yield cup.part(plan.heights.plates[plan.seat_of(cup.link)], self._disc(cup.wheel))
        pairs = [("pillar", self.pillars, plan.places.back, plan.places.front)]
        if plan.bridge is not None:
            below, above = sorted((plan.bridged_plate, plan.bridge))
            pairs.append(("bridge pillar", self.bridge_pillars, below, above))
        for name, spots, below, above in pairs:
            for number, at in enumerate(spots, 1):
                ends = Band(*below, TENON * self.pillar), Band(*above, TENON * self.pillar)
                bands = ends[0], Band(below[1], above[0], self.pillar), ends[1]
                joint = f"in both plates, {plan.process.joint}"
                yield TurnedPart(plan.stack.frame, f"{name} {number}", "pillar", at, bands, joint)
        yield from self.posts
        yield from self.pins
        yield from self.feet

    @cached_property
    def pins(self) -> tuple[TurnedPart, ...]:
        """Pins that are fixed in plates, as turned parts."""
        found: list[TurnedPart] = []
        for pins in self.standing:
            wheel = self._disc(pins.wheel)
            faces = self.plan.heights.plates[pins.seat] if pins.seat else nearer_plate(self.plan, wheel.middle)
            found += pins.parts(faces, wheel, self.plan.process.joint)
        return tuple(found)

    @cached_property
    def posts(self) -> tuple[TurnedPart, ...]:
        """Posts that support rings."""
        return ring_posts(self.plan)

    def problems(self) -> Iterator[Problem]:
        """Yield problems with holes that would intersect, and with posts that collide with wheels."""
        for side, faces in self.sides.items():
            yield from self._missing_holes(f"the {side} plate", self._bearings(faces), self._tenon_holes(faces))
        for seat in self.plan.choice.seats:
            yield from self._missing_holes(f"'{seat.seat}'", list(self._seat_holes(seat.seat)), self._hub(seat.seat))
        yield from blocked_posts(self.plan, self.posts)

    def _missing_holes(self, where: str, holes: Sequence[Hole], taken: Sequence[Hole]) -> Iterator[Problem]:
        kept = self._disjoint(holes, taken)
        for hole in holes:
            if hole not in kept:
                other = next(each for each in (*taken, *kept) if _meet(hole, each))
                what = f"{where} has no hole for axis '{hole.name}'"
                why = f"it would overlap the hole of '{other.name}', {dist(hole.at, other.at):.3g} mm away"
                yield Problem(what, why, "use a smaller --bore, or make one stepped stud for both")


def _box(points: Sequence[Point]) -> list[Point]:
    """Return the corners of the upright bounding rectangle of points. Clocks have rectangular plates."""
    (left, right), (low, high) = ((min(values), max(values)) for values in zip(*points, strict=True))
    return [(left, low), (right, low), (right, high), (left, high)]


def _meet(one: Hole, other: Hole) -> bool:
    return dist(one.at, other.at) < (one.diameter + other.diameter) / 2 + _BLADE
