"""Supports of axes that are not parallel to the frame's axes, and parts that hang on a train.

A bracket is a plate perpendicular to an arbor and to the plates of the frame, which bears an end of the arbor.

A cage holds axes of a carrier that are inclined to the carrier's axis, such as those of the pinions of a differential:
an eye bears the outer end of the pinion's arbor, and a post connects the eye to a wheel of the carrier or to an arm.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import dist, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector, cross, dot, plus, scaled
from geartrain.scene.elements import SceneHanger
from geartrain.scene.parts.frame_plates import FramePlates
from geartrain.scene.parts.pillar_places import TENON
from geartrain.scene.parts.stack_discs import Passage, swept_circle
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import around
from geartrain.scene.solids.solid_part import SolidPart, turned_about
from geartrain.teeth.outlines.contour import Contour
from geartrain.train.declaration import material_named

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneBody, SceneWheel
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.parts.sleeves import Barrel
    from geartrain.scene.train_scene import Scene
    from geartrain.train import Train


# -------------------------------------------------------------------------------------------------- pendulum and weight


_BOB, _THICK = 0.05, 0.25  # radius of a bob over the pendulum's length, and half its thickness over its radius
_ROD = 0.04  # radius of a pendulum's rod divided by that of the bob
_TALL = 4.0  # height of a weight divided by its radius
_ANCHOR = sqrt(2)  # distance of the anchor's axis over the escape wheel's radius, for pallets a quarter turn apart
_COCK = 2.0  # mm: radius of the stud of a pendulum
_AWAY = 2.0  # mm between the frame and a bob
_LINE, _START = 0.6, 150.0  # mm: radius of a line, its length in the zero pose


@dataclass(frozen=True)
class HangingParts:
    """Pendulum and weight of a train with a dial. The zero mark of the dial defines the upward direction."""

    scene: Scene
    declared: Train
    plan: FramePlan
    barrel: Barrel | None

    def found(self) -> tuple[SceneHanger, ...]:
        """Return the declared hanging parts: pendulum, line and weight; empty if the train has no dial."""
        return () if self.front is None else tuple(each for each in (self.pendulum, *self._weight()) if each)

    @property
    def frame(self) -> int:
        """Index of the body of the frame."""
        return _frame(self.scene, self.plan)

    @cached_property
    def front(self) -> tuple[Vector, Vector] | None:
        """Direction towards the reader of the first dial on a face of the train, and down; None if there is no dial."""
        normal = self.plan.stack.normal
        faces = (face for face in self.scene.dials if abs(dot(face.normal, normal)) > 0.5)
        face = next(faces, None)
        return None if face is None else (face.normal, scaled(face.zero, -1.0))

    @cached_property
    def pendulum(self) -> SceneHanger | None:
        """Pendulum behind the frame, above the escape wheel; None if none is declared, or if it cannot be placed."""
        escapement, normal = self.declared.escapement, self.plan.stack.normal
        if self.front is None or escapement is None or escapement.pendulum is None:
            return None
        index = next(at for at, body in enumerate(self.scene.bodies) if body.id == escapement.link)
        body = self.scene.bodies[index]
        if body.parent != self.frame:
            return None  # a carriage with pallets cannot carry a pendulum
        wheels = (each for each in self.scene.wheels if each.body == index and each.teeth == escapement.teeth)
        wheel = next(wheels, None)
        if wheel is None or abs(dot(body.direction, normal)) < 1 - 1e-6:
            return None
        length, down = 1000 * escapement.pendulum.length.si, self.front[1]
        bob = _BOB * length
        behind = self._side * (_AWAY + _THICK * bob) + self._last
        above = plus(body.point, down, -_ANCHOR * wheel.radius)
        point = plus(above, normal, behind - dot(above, normal))
        return SceneHanger("pendulum", index, point, body.direction, down, length, escapement.teeth, bob)

    @property
    def _side(self) -> float:
        """1 if the normal of the stack points away from the reader of the dial, -1 if it points to the reader."""
        assert self.front is not None
        return -1.0 if dot(self.front[0], self.plan.stack.normal) > 0 else 1.0

    @property
    def _last(self) -> float:
        """Position along the normal of the rearmost face of all plates and wheels [mm]."""
        places, way = self.plan.places, max if self._side > 0 else min
        faces = [face for plate in (places.back, places.front, self.plan.bridge or ()) for face in plate]
        return way([*faces, *(face for disc in self.plan.discs for face in (disc.low, disc.high))])

    def cock(self) -> Iterator[TurnedPart]:
        """Yield the stud in the frame from which the pendulum hangs, if there is a pendulum."""
        if self.pendulum is None:
            return
        stack, places, side = self.plan.stack, self.plan.places, self._side
        plate = max((places.back, places.front), key=lambda faces: side * faces[0])
        end = dot(self.pendulum.point, stack.normal) + side * 2 * _COCK
        low, high = sorted((plate[1] if side > 0 else plate[0], end))
        bands = Band(*plate, TENON * _COCK), Band(low, high, _COCK)
        at, joint = stack.flat(self.pendulum.point), f"in its plate, {self.plan.process.joint}"
        yield TurnedPart(stack.frame, "pendulum cock", "cock", at, bands if side > 0 else bands[::-1], joint)

    def _weight(self) -> Iterator[SceneHanger]:
        """Yield the line that hangs from the barrel, and the weight."""
        barrel, drive, crank = self.barrel, self.declared.drive, self.scene.crank
        if barrel is None or drive is None or drive.weight is None or crank is None or self.front is None:
            return
        body, down = self.scene.bodies[crank], self.front[1]
        way = Fraction(body.speed or 0) * body.sense
        if not way:
            return
        (band,) = barrel.part.bands
        middle = self.plan.stack.in_space(barrel.part.at, (band.low + band.high) / 2)
        # the side on which the rim of the barrel moves down as it turns forward
        arm = band.radius if way > 0 else -band.radius
        side, rate = plus(middle, cross(down, body.direction), arm), arm / drive.falls
        lead = material_named(self.declared, "lead").density
        assert lead is not None
        # a lead cylinder of the declared mass: m = rho pi r^2 (4 r)
        radius = 1000 * (drive.weight.si / lead.si / (pi * _TALL)) ** (1 / 3)
        yield SceneHanger("line", crank, side, body.direction, down, _START, rate, _LINE)
        yield SceneHanger("weight", crank, side, body.direction, down, _START, rate, radius)


def hanging_solids(hanger: SceneHanger, frame: int) -> Iterator[SolidPart]:
    """Yield the solids of a pendulum or a weight, fixed to the body with index `frame`; yield nothing for a line."""
    end, wide = plus(hanger.point, hanger.down, hanger.length), hanger.wide
    if hanger.kind == "pendulum":
        rod = Band(_COCK, hanger.length - wide, _ROD * wide)
        yield turned_about(frame, _hung("pendulum rod", rod), hanger.down, hanger.point)
        bob = Band(-_THICK * wide, _THICK * wide, wide)
        yield turned_about(frame, _hung("pendulum bob", bob), hanger.direction, end)
    elif hanger.kind == "weight":
        yield turned_about(frame, _hung("weight", Band(0.0, _TALL * wide, wide)), hanger.down, end)


def _hung(name: str, band: Band) -> TurnedPart:
    return TurnedPart("", name, name.split()[-1], (0.0, 0.0), (band,))


# ------------------------------------------------------------------------------------------------------------- brackets


GAP = 0.5
"""Axial clearance between the last wheel of an arbor and the support of the arbor [mm]."""
_ROOM = 1.5  # mm, the same for a bracket, including a web beside the wheel's window in the plate
LAND = 2.0
"""Width of the metal around a bearing [mm]."""
_FLAT = 1e-6


@dataclass(frozen=True)
class Bracket:
    """Support of one end of an arbor that is parallel to the plates: a plate with a hole, fixed in a frame plate."""

    body: int
    """Index of the arbor's body."""
    reach: float
    """Position of the bracket's outer face along the arbor's direction [mm]."""
    side: str
    """Name of the frame plate to which the bracket is fixed, through the passage `mortise`."""
    mortise: Passage
    part: SolidPart


def find_brackets(scene: Scene, plan: FramePlan, bores: Mapping[str, float]) -> tuple[Bracket, ...]:
    """Return the brackets of all arbors parallel to the frame plates; `bores` are arbor diameters by axis [mm]."""
    sides = FramePlates(plan).sides
    borne = {column.axis for column in plan.all_columns}
    found: list[Bracket] = []
    for at, body in enumerate(scene.bodies):
        frame = body.parent is not None and scene.bodies[body.parent].id == plan.stack.frame
        across = abs(float(np.dot(body.direction, plan.stack.normal))) < _FLAT if frame else False
        if across and body.axis not in borne and bores.get(body.axis):
            found += _brackets(scene, plan, sides, at, bores[body.axis] / 2)
    return tuple(found)


def wheel_ends(scene: Scene, at: int) -> tuple[float, float] | None:
    """Return the ends of a body's wheels along its direction, relative to its point [mm]; None without such wheels."""
    body = scene.bodies[at]
    along = np.array(body.direction)
    own = [wheel for wheel in scene.wheels if wheel.body == at and wheel.kind != "ring"]
    centres = [float((np.array(wheel.centre) - np.array(body.point)) @ along) for wheel in own]
    ends = [centre + end for wheel, centre in zip(own, centres, strict=True) for end in wheel.span]
    return (min(ends), max(ends)) if ends else None


def _brackets(
    scene: Scene, plan: FramePlan, sides: Mapping[str, tuple[float, float]], at: int, radius: float
) -> Iterator[Bracket]:
    """Yield the brackets of one arbor, at both ends or at the end nearer to the middle of the train.

    sides    heights of the faces of the frame plates, by name
    at       index of the arbor's body
    radius   radius of the arbor [mm]
    """
    body, ends, stack = scene.bodies[at], wheel_ends(scene, at), plan.stack
    if ends is None:
        return
    along, normal = np.array(body.direction), np.array(stack.normal)
    middle = np.mean([stack.in_space(column.at) for column in plan.columns], axis=0)
    centre = float((middle - np.array(body.point)) @ along)
    low, high = ends
    faces = {1: high + _ROOM, -1: low - _ROOM}
    places = {way: np.array(body.point) + (face + way * plan.thickness / 2) * along for way, face in faces.items()}
    best = {way: _best_plate(plan, place, sides) for way, place in places.items()}
    ways = [way for way, inner in ((1, high > centre - _FLAT), (-1, low < centre + _FLAT)) if inner]
    if len(ways) == 1:  # on the inner side, unless wheels obstruct it there
        ways = [min(ways[0], -ways[0], key=lambda way: best[way][0])]
    aside = np.cross(body.direction, normal)
    turn, edge = np.column_stack([normal, aside, body.direction]), radius + LAND
    for way in ways:
        place, side = places[way], best[way][1]
        height, foot = float(place @ normal), stack.flat(tuple(place.tolist()))
        away = max(sides[side], key=lambda each: abs(each - height)) - height
        down = max(abs(away) - edge, 0.0) * (1 if away > 0 else -1)
        cut = around([(0.0, 0.0), (down, 0.0)], edge), Contour.circle(radius + plan.process.running / 2)
        name = f"{body.id} bracket" + (" 2" if way < 0 else "")
        mortise = Passage(foot, stack.flat(tuple(aside.tolist())), edge, (plan.thickness + plan.process.press) / 2)
        part = SolidPart(_frame(scene, plan), name, "plate", turn, place, "", cut, plan.thickness)
        yield Bracket(at, faces[way] + way * plan.thickness, side, mortise, part)


def _best_plate(plan: FramePlan, place: Floats, sides: Mapping[str, tuple[float, float]]) -> tuple[int, str]:
    """Return the number of wheels between a bracket and the frame plate that suits it best, and this plate's name.

    place   centre of the bracket [mm]
    sides   heights of the faces of the frame plates, by name
    """
    height, foot = float(place @ np.array(plan.stack.normal)), plan.stack.flat(tuple(place.tolist()))

    def cost(side: str) -> tuple[int, float]:
        low, high = sorted((height, sum(sides[side]) / 2))
        wheels = [swept_circle(disc) for disc in plan.discs if disc.low < high and low < disc.high]
        return sum(dist(foot, middle) < reach for middle, reach in wheels), high - low

    side = min(sides, key=cost)
    return cost(side)[0], side


def _frame(scene: Scene, plan: FramePlan) -> int:
    return next(at for at, body in enumerate(scene.bodies) if body.id == plan.stack.frame)


def on_axis(body: SceneBody, along: float) -> Floats:
    """Return the point on a body's axis at the position `along` [mm]."""
    return np.asarray(np.array(body.point) + along * np.array(body.direction))


# ---------------------------------------------------------------------------------------------------------------- cages


_ARM = 1.0  # mm: thickness of an arm
_PAST = 0.25  # mm between a wheel and an arm
_SAME = 1e-6


@dataclass(frozen=True)
class Cage:
    """Support of a body whose axis is inclined to the axis of its carrier."""

    body: int
    reach: float
    """Position of the outer end of the body's arbor along its axis [mm]."""
    parts: tuple[SolidPart, ...]


def find_cages(scene: Scene, plan: FramePlan, bores: Mapping[str, float]) -> tuple[Cage, ...]:
    """Return the cages of axes that are inclined to the axis of their carrier, from arbor diameters by axis [mm]."""
    found = []
    for at, body in enumerate(scene.bodies):
        carrier = None if body.parent is None else scene.bodies[body.parent]
        if carrier is None or carrier.parent is None or not bores.get(body.axis) or wheel_ends(scene, at) is None:
            continue
        if abs(float(np.dot(body.direction, carrier.direction))) < 1 - _SAME:
            found.append(_CageBuilder(scene, plan, at, bores).cage())
    return tuple(found)


class _CageBuilder:
    """Builder of the cage of the body with the index `at`; `along` is the unit vector of the axis of its carrier."""

    def __init__(self, scene: Scene, plan: FramePlan, at: int, bores: Mapping[str, float]) -> None:
        self.scene, self.plan, self.at, self.bores = scene, plan, at, bores
        self.body = scene.bodies[at]
        assert self.body.parent is not None
        self.index, self.carrier = self.body.parent, scene.bodies[self.body.parent]
        self.along = np.array(self.carrier.direction)

    def height(self, point: object) -> float:
        """Return the position of a point along the carrier's axis [mm]."""
        return float((np.asarray(point, dtype=float) - np.array(self.carrier.point)) @ self.along)

    def cage(self) -> Cage:
        """Return the bearing of the arbor's outer end (eye), its post, and an arm if no wheel can hold the post."""
        radius = self.bores[self.body.axis] / 2
        post = min(2.0, 0.6 + 0.8 * radius)
        side, end = self._outer_end()
        bore = radius + self.plan.process.running / 2
        ring = (Band(-post, post, radius + LAND, bore),)
        part = TurnedPart(self.carrier.id, f"{self.body.id} eye", "collar", (0.0, 0.0), ring)
        middle = on_axis(self.body, end + side * (GAP + post))
        eye = turned_about(self.index, part, self.body.direction, middle)
        height = self.height(eye.place)
        aside = eye.place - on_axis(self.carrier, height)
        away = float(np.linalg.norm(np.cross(self.carrier.direction, aside)))
        # the nearest face of the carrier's own wheels that extend beyond the post
        own = (wheel for wheel in self._coaxial() if wheel.body == self.index and wheel.tip > away)
        faces = (face for wheel in own for face in self._faces(wheel, wheel.web))
        seat = min(faces, key=lambda each: abs(each - height), default=None)
        if seat is not None and self._is_behind_a_plate(height, seat):
            seat, level = None, self._beside(height)
        else:
            level = self._level(height, away - post) if seat is None else seat
        way = 1 if level > height else -1
        ends = [height + way * (radius + LAND / 2), level]
        if seat is None:  # the post passes through the arm, in which it has a tenon
            ends[1:] = level - way * _ARM / 2, level + way * _ARM / 2
        sizes = zip(pairwise(ends), (post, TENON * post), strict=False)
        bands = sorted((Band(min(pair), max(pair), size) for pair, size in sizes), key=lambda band: band.low)
        part = TurnedPart(self.carrier.id, f"{self.body.id} cage post", "post", (0.0, 0.0), tuple(bands))
        parts = [eye, turned_about(self.index, part, self.carrier.direction, eye.place - height * self.along)]
        if seat is None:
            parts.append(self._arm(aside, away, level, post))
        return Cage(self.at, end + side * (GAP + 2 * post), tuple(parts))

    def _outer_end(self) -> tuple[int, float]:
        """Return the outer end of the wheels on an arbor: its side along the arbor (1 or -1) and its position [mm]."""
        ends = wheel_ends(self.scene, self.at)
        assert ends is not None
        normal = np.cross(self.body.direction, self.along)
        gap = np.array(self.carrier.point) - np.array(self.body.point)
        near = float(np.cross(gap, self.along) @ normal / (normal @ normal))  # the point where the axes intersect
        side = 1 if sum(ends) / 2 > near else -1
        return side, max(ends) if side > 0 else min(ends)

    def _is_behind_a_plate(self, height: float, seat: float) -> bool:
        """Return True if a plate of the frame is between two heights."""
        stack, places = self.plan.stack, self.plan.places
        if abs(float(np.dot(self.along, stack.normal))) < 1 - _SAME:
            return False
        low, high = sorted((height, seat))
        plates = (self.height(stack.in_space((0.0, 0.0), sum(faces) / 2)) for faces in (places.back, places.front))
        return any(low < each < high for each in plates)

    def _beside(self, height: float) -> float:
        """Return the mid-height of an arm next to the wheels of the body [mm], where fewer wheels obstruct it."""
        reach = max(wheel.radius for wheel in self.scene.wheels if wheel.body == self.at) + _PAST + _ARM / 2

        def hit(level: float) -> int:
            wheels = list(self._coaxial())
            faces = (self._faces(wheel, wheel.span) for wheel in wheels)
            return sum(low - _ARM / 2 < level < high + _ARM / 2 for low, high in faces)

        return min((height + reach, height - reach), key=hit)

    def _coaxial(self) -> Iterator[SceneWheel]:
        """Yield the wheels that turn about the carrier's axis."""
        for wheel in self.scene.wheels:
            aside = np.array(wheel.centre) - on_axis(self.carrier, self.height(wheel.centre))
            upright = abs(float(np.dot(wheel.direction, self.along))) > 1 - _SAME
            if upright and float(np.abs(aside).max()) < _SAME:
                yield wheel

    def _faces(self, wheel: SceneWheel, ends: tuple[float, float]) -> tuple[float, float]:
        """Return the heights along the carrier's axis [mm] of two `ends` that are relative to the wheel's centre."""
        up = 1 if float(np.dot(wheel.direction, self.along)) > 0 else -1
        low, high = sorted(self.height(wheel.centre) + up * end for end in ends)
        return low, high

    def _level(self, height: float, inner: float) -> float:
        """Return the mid-height of an arm beyond all wheels [mm], above or below, where fewer wheels obstruct the post.

        height   height of the eye on the carrier's axis [mm]
        inner    distance of the post's inner edge from this axis [mm]
        """
        wheels = list(self._coaxial())

        def cost(side: int) -> tuple[int, float]:
            there = [wheel for wheel in wheels if side * (self.height(wheel.centre) - height) > 0]
            hit = sum(wheel.tip > inner or wheel.kind == "ring" for wheel in there)
            return hit, side * beyond(side)

        def beyond(side: int) -> float:
            own = [max(side * face for face in self._faces(wheel, wheel.span)) for wheel in wheels]
            reach = max(wheel.radius for wheel in self.scene.wheels if wheel.body == self.at)
            return side * (max([each for each in own if each > side * height] or [side * height + reach]))

        side = min((1, -1), key=cost)
        return beyond(side) + side * (_PAST + _ARM / 2)

    def _arm(self, aside: Floats, away: float, level: float, post: float) -> SolidPart:
        """Return the arm between the carrier's axis, about which its hub turns, and a post.

        aside   vector from the carrier's axis to the post [mm]; `away` is its length
        level   mid-height of the arm [mm]; `post` is the radius of the post [mm]
        """
        hub = self.bores.get(self.carrier.axis, 2.0) / 2 + self.plan.process.running / 2
        across = aside / (away or 1.0)
        wide = max(hub + LAND, post)
        tenon = TENON * post + self.plan.process.press / 2
        cut = around([(0.0, 0.0), (away, 0.0)], wide), Contour.circle(hub), Contour.circle(tenon, (away, 0.0))
        turn = np.column_stack([across, np.cross(self.along, across), self.along])
        place = on_axis(self.carrier, level)
        return SolidPart(self.index, f"{self.body.id} cage arm", "plate", turn, place, "", cut, _ARM)
