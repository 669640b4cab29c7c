"""Pins, slots and bars: cut into wheels, fixed in plates, or made as separate parts.

A wheel that extends beyond a pin carries the pin, and a wheel that covers its whole path contains the slot. An
eccentric bar connects an arm to the widest wheel of its link.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from math import asin, atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.elements import ToothProfile
from geartrain.scene.parts.arbor_columns import APART
from geartrain.scene.parts.carried_axes import seen_from_carrier
from geartrain.scene.parts.eccentrics import StandingPins
from geartrain.scene.parts.pillar_places import clear_of, evenly
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import around, holed_bar, pin_diameter, slotted_bar
from geartrain.scene.solids.solid_part import SolidPart, turned_about, wheel_frame
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneCoupling, SceneWheel
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.parts.processes import Process
    from geartrain.scene.solids.wheel_blanks import Blank
    from geartrain.scene.train_scene import Scene


# --------------------------------------------------------------------------------------------- pins and slots in wheels


WIDE = 0.55
"""Half the width of a slot divided by the diameter of its pin."""
_WEB = 0.6  # mm: minimum width of a wheel round a pin and round a slot


@dataclass(frozen=True, slots=True)
class CutCoupling:
    """Coupling cut into wheels: a pin in one wheel, and its slot or holes in another."""

    coupling: SceneCoupling
    pin: SceneWheel | None
    """Wheel with the pins; None if the pins move in round holes and no wheel carries them."""
    slot: SceneWheel


def cut_couplings(scene: Scene, blanks: Mapping[str, Blank], bores: Mapping[str, float]) -> dict[str, CutCoupling]:
    """Return the couplings that can be cut into flat wheels with the given bores [mm], by name."""
    found = {}
    for coupling in scene.couplings:
        r, e, half = coupling.pin_radius, coupling.offset, WIDE * pin_width(coupling)
        # a round hole has a fixed centre, whereas a pin moves in its slot by the offset to either side
        far = coupling.hole / 2 if coupling.hole else e + half
        pins = _wide_wheels(scene, coupling.pin, blanks, bores, (r - half, r + half))
        slots = _wide_wheels(scene, coupling.slot, blanks, bores, (abs(r - far), r + far))
        if coupling.drawn and slots and not pins and coupling.hole:
            found[coupling.id] = CutCoupling(coupling, None, slots[0])
        elif coupling.drawn and pins and slots:
            along = np.array(scene.bodies[coupling.slot].direction)
            near = min(product(pins, slots), key=lambda both: abs(np.subtract(both[0].centre, both[1].centre) @ along))
            found[coupling.id] = CutCoupling(coupling, *near)
    return found


def pin_width(coupling: SceneCoupling) -> float:
    """Return the diameter of the pins of a coupling [mm]."""
    return coupling.pin_diameter or pin_diameter(coupling.pin_radius)


def _wide_wheels(
    scene: Scene, body: int, blanks: Mapping[str, Blank], bores: Mapping[str, float], reach: tuple[float, float]
) -> list[SceneWheel]:
    """Return the flat external wheels of a body that are solid from the first to the second radius in `reach` [mm]."""
    low, high = reach
    return [
        wheel
        for wheel in scene.wheels
        if wheel.body == body
        and (blank := blanks.get(wheel.id)) is not None
        and blank.kind == "external"
        and bores.get(wheel.id, 0.0) / 2 + _WEB <= low
        and high + _WEB <= min(blank.root_radius, blank.tip_radius)
    ]


def slot_frame(scene: Scene, coupling: SceneCoupling) -> Floats:
    """Return unit vectors along the slot, across it and along its axis, as columns, in the zero pose."""
    along = np.array(scene.bodies[coupling.slot].direction)
    out = np.subtract(coupling.pin_at, coupling.slot_at)
    x = out / np.linalg.norm(out)
    x = cos(coupling.slot_turn) * x + sin(coupling.slot_turn) * np.cross(along, x)
    return np.column_stack([x, np.cross(along, x), along])


def holes(scene: Scene, cut: CutCoupling, wheel: str, turn: Floats, place: Floats, process: Process) -> list[Contour]:
    """Return a wheel's holes for pins and for a slot, in its coordinates (rotation matrix `turn`, origin `place`)."""
    coupling, thick = cut.coupling, pin_width(cut.coupling)
    found = []
    if cut.pin is not None and wheel == cut.pin.id:
        found += [
            Contour.circle((thick + process.press) / 2, _flat(at, turn, place))
            for at in coupling.pins_at or (coupling.pin_at,)
        ]
    if wheel == cut.slot.id and coupling.hole:
        found += [
            Contour.circle((coupling.hole + process.running) / 2, _flat(at, turn, place)) for at in coupling.holes_at
        ]
    elif wheel == cut.slot.id:
        x = slot_frame(scene, coupling)[:, 0]
        ends = abs(coupling.pin_radius - coupling.offset), coupling.pin_radius + coupling.offset
        points = [_flat(coupling.slot_at + x * end, turn, place) for end in ends]
        found.append(around(points, WIDE * thick))
    return found


def _flat(point: object, turn: Floats, place: Floats) -> tuple[float, float]:
    x, y, _ = turn.T @ (np.array(point, float) - place)
    return float(x), float(y)


# --------------------------------------------------------------------------------------------------------------- solids

_GAP = 1.0  # mm between a plate and the next turning part


@dataclass(frozen=True)
class CouplingParts:
    """Parts of the couplings of a scene: pins in wheels, and arms and bars where no wheel has space for them."""

    scene: Scene
    cut: Mapping[str, CutCoupling]
    process: Process

    def parts(self) -> Iterator[SolidPart]:
        """Yield the pins that connect two wheels, and the arms and bars of couplings that are not cut into wheels."""
        for coupling in self.scene.couplings:
            direction, cut = self.scene.bodies[coupling.slot].direction, self.cut.get(coupling.id)
            along = np.array(direction)
            if coupling.hole and (cut is None or cut.pin is None):
                continue  # no wheel carries such pins
            if cut is None or cut.pin is None:
                height = float(coupling.pin_at @ along)
                levels = [self._level(body, height, along) for body in (coupling.pin, coupling.slot)]
                low, high = min(levels) - _GAP, max(levels) + _GAP
            else:  # from the far face of the pin's wheel to the far face of the slot's wheel
                wheels = product((cut.pin, cut.slot), (-1, 1))
                ends = [float(wheel.centre @ along) + side * wheel.thickness / 2 for wheel, side in wheels]
                low, high = min(ends), max(ends)
            band = Band(low, high, pin_width(coupling) / 2)
            for at, place in enumerate(coupling.pins_at or (coupling.pin_at,)):
                name = f"{coupling.id} pin" + (f" {at + 1}" if coupling.pins_at else "")
                link = self.scene.bodies[coupling.pin].id
                part = TurnedPart(link, name, "pin", (0.0, 0.0), (band,), self.process.joint)
                foot = np.array(place) - along * (np.array(coupling.pin_at) @ along)  # at height 0
                yield turned_about(coupling.pin, part, direction, foot)
            if cut is None:
                yield self._pin_arm(coupling, along, levels[0])
                yield self._bar(coupling, along)

    def _pin_arm(self, coupling: SceneCoupling, along: Floats, level: float) -> SolidPart:
        """Return an arm from the axis of the pin's link to the pin."""
        body = self.scene.bodies[coupling.pin]
        pin = np.array(coupling.pin_at)
        hub = np.array(body.point) + along * (level - float(np.array(body.point) @ along))
        aside = pin - hub - along * float((pin - hub) @ along)
        away = float(np.linalg.norm(aside))
        x = aside / away
        cut = (around([(0.0, 0.0), (away, 0.0)], 0.9 * pin_width(coupling)),)
        name, own = f"{coupling.id} pin arm", np.column_stack([x, np.cross(along, x), along])
        return SolidPart(coupling.pin, name, "plate", own, hub, "", cut, _GAP)

    def _bar(self, coupling: SceneCoupling, along: Floats) -> SolidPart:
        hub, turn = np.array(coupling.slot_at), slot_frame(self.scene, coupling)
        level = self._level(coupling.slot, float(coupling.pin_at @ along), along)
        place = hub + along * (level - hub @ along)
        # without declared sizes the bar has a round hole in which the pin revolves
        shape = slotted_bar if coupling.drawn else holed_bar
        bar = shape(coupling.pin_radius, coupling.offset, pin_diameter(coupling.pin_radius))
        return SolidPart(coupling.slot, f"{coupling.id} slot", "plate", turn, place, "", bar, _GAP)

    def _level(self, body: int, height: float, along: Floats) -> float:
        """Return the mid-height of a plate on the face of a body's wheels that is nearest to the given height [mm]."""
        own = [wheel for wheel in self.scene.wheels if wheel.body == body]
        faces = [
            float(np.array(wheel.centre) @ along) + side * (wheel.thickness + _GAP) / 2
            for wheel in own
            for side in (-1, 1)
        ]
        return min(faces, key=lambda face: abs(face - height), default=float(height))


# ------------------------------------------------------------------------------------------------------- pins in plates


_CHORDS = 13  # points of half a seat


def standing_pins(scene: Scene, plan: FramePlan) -> Iterator[StandingPins]:
    """Yield all groups of pins that are fixed in plates, in the coordinates of the stack."""
    wheels = {wheel.id: wheel for wheel in scene.wheels}
    for name, blank in plan.stack.blanks.items():
        if blank.kind == "ring" and blank.pins is not None and any(disc.name == name for disc in plan.discs):
            yield _of_ring(scene, plan, wheels[name])
    circles, seats = plan.stack.pin_circles, plan.plated_pins
    done, normal = set[str](), np.array(plan.stack.normal)
    for coupling in scene.couplings:
        link = scene.bodies[coupling.pin].id
        if coupling.id not in seats or link in done:
            continue
        done.add(link)  # pins of one link pass through all its discs
        bodies = {each.slot for each in scene.couplings if each.id in seats and each.pin == coupling.pin}
        slots = [wheel for wheel in scene.wheels if wheel.body in bodies]
        if slots:
            plate = plan.heights.plates[seats[coupling.id]]
            far = max(slots, key=lambda wheel: abs(float(np.dot(wheel.centre, normal)) - sum(plate) / 2))
            spots = tuple(plan.stack.flat(place) for place in coupling.pins_at)
            yield StandingPins(
                f"{coupling.id} pin", link, seats[coupling.id], far.id, spots, circles[coupling.id].pin / 2
            )


def _of_ring(scene: Scene, plan: FramePlan, wheel: SceneWheel) -> StandingPins:
    blank = plan.stack.blanks[wheel.id]
    assert blank.pins is not None
    turn, place = wheel_frame(wheel)
    circle, angles = blank.pins.circle * blank.module, 2 * pi * np.arange(blank.teeth) / blank.teeth
    points = place + np.column_stack([circle * np.cos(angles), circle * np.sin(angles), 0 * angles]) @ turn.T
    spots = tuple(plan.stack.flat((x, y, z)) for x, y, z in points.tolist())
    link = scene.bodies[wheel.body].id
    seat = next((plate.disc.name for plate in plan.turning if plate.ring == wheel.id), "")
    return StandingPins(f"{wheel.id} pin", link, seat, wheel.id, spots, blank.pins.radius * blank.module)


def with_pins_apart(scene: Scene, plan: FramePlan) -> Scene:
    """Return the scene with new profiles for rings with separate pins: each tooth is the material between two pins."""
    wheels, profiles = list(scene.wheels), list(scene.profiles)
    for at, wheel in enumerate(wheels):
        blank = plan.stack.blanks.get(wheel.id)
        if blank is not None and blank.pins is not None:
            form = profiles[wheel.profile].form
            points = _tooth_between_seats(blank)
            radii = [blank.pitch_radius * radius for radius, _ in points]
            wheels[at] = replace(
                wheel,
                turn=wheel.turn + pi / blank.teeth,
                profile=len(profiles),
                tip=min(radii),
                root=max(max(radii), blank.root_radius),
            )
            profiles.append(ToothProfile(form, points))
    return replace(scene, wheels=tuple(wheels), profiles=tuple(profiles))


def _tooth_between_seats(blank: Blank) -> tuple[tuple[float, float], ...]:
    """Return the tooth of a pin ring between two recesses for pins, as points (radius in pitch radii, angle [rad])."""
    assert blank.pins is not None
    x, y = (float(part) for part in blank.contours[1].points[0])  # on the inner circle, at the start of the first seat
    R, half, pitch = blank.pins.circle * blank.module, pi / blank.teeth, blank.pitch_radius
    inside = float(np.hypot(x, y)) / pitch
    if blank.contours[1].is_circle:
        return (inside, -half), (inside, half)
    reach = float(np.hypot(x - R, y))
    seat = R + reach * np.exp(1j * np.linspace(0, float(np.arctan2(-y, x - R)), _CHORDS))
    left = list(zip((abs(seat) / pitch).tolist(), (np.angle(seat) - half).tolist(), strict=True))
    return *left, (inside, 0.0), *((radius, -angle) for radius, angle in left[::-1])


# ----------------------------------------------------------------------------------------------------------------- bars

_RADIUS = 1.5  # mm: radius of a bar
_EDGE = 1.0  # mm: width of the wheel round its end
_WAYS, _STEP = 120, 1.0  # directions of candidate places of a bar, and radial step (mm)
_ENOUGH = 1.0  # mm: sufficient clearance, at which the search ends
_PARTS = 8  # samples of half a swing of a bar with a slot


def side_bars(scene: Scene, plan: FramePlan) -> Iterator[StandingPins]:
    """Yield the bars, off the axis, that connect arms to the wheels of their links, in the coordinates of the stack."""
    discs = {disc.name: disc for disc in plan.discs}
    for plate in plan.turning:
        if plate.disc.apart:
            own = [disc for disc in plan.discs if disc.axis == plate.disc.axis and disc.link == plate.disc.link]
            wheel = max((disc for disc in own if disc.hub and not disc.apart), key=lambda disc: disc.root)
            spot = _spot(scene, plan, wheel, discs[plate.disc.name])
            yield StandingPins(f"{wheel.link} bar", wheel.link, plate.disc.name, wheel.name, (spot,), _RADIUS, True)


def _spot(scene: Scene, plan: FramePlan, wheel: StackDisc, arm: StackDisc) -> Point:
    """Return the position in the plane of the stack at which a bar from a wheel to an arm has sufficient clearance.

    The outermost such position is preferred. If none exists, it is the position with the largest clearance.
    """
    low, high = min(wheel.high, arm.high), max(wheel.low, arm.low)
    seen = [seen_from_carrier(wheel.link, wheel.at, disc) for disc in plan.discs if disc.low < high and low < disc.high]
    rods = [(each.at, wide) for each in plan.all_columns if (wide := each.radius(wheel.low, high))]
    slots = [circle for each in scene.couplings for circle in _swept(scene, plan, each, wheel)]

    def clearance(at: Point) -> float:
        near = min((disc.clearance_to(at, _RADIUS) for disc in seen), default=_ENOUGH)
        return min(near, clear_of(at, [*rods, *slots]) - _RADIUS, _ENOUGH)

    best, minimum = wheel.at, -wheel.root
    away = wheel.root - _RADIUS - _EDGE
    while away > 0 and minimum < _ENOUGH - APART:
        at = max(evenly(wheel.at, away, _WAYS), key=clearance)
        if clearance(at) > minimum:
            best, minimum = at, clearance(at)
        away -= _STEP
    return best


def _swept(scene: Scene, plan: FramePlan, coupling: SceneCoupling, wheel: StackDisc) -> Iterator[tuple[Point, float]]:
    """Yield circles that contain a slotted bar at all positions of its pin, as seen from its carrier.

    Nothing is yielded unless `wheel` belongs to the carrier of the coupling.
    """
    if scene.bodies[coupling.carrier].id != wheel.link:
        return
    stack = plan.stack
    (x, y), pin = stack.flat(coupling.slot_at), stack.flat(scene.bodies[coupling.pin].point)
    # distance to the centre of the bar's rounded end, and half the width of the bar
    far, wide = coupling.pin_radius + coupling.offset, 1.2 * pin_diameter(coupling.pin_radius)
    r, e = coupling.pin_radius, hypot(pin[0] - x, pin[1] - y)
    if r >= e:  # the bar turns with the pin
        yield (x, y), far + wide
        return
    # a circle of radius r at the distance e is seen from the slot axis at +- asin(r / e)
    middle, swing = atan2(pin[1] - y, pin[0] - x), asin(r / e)
    for part in range(-_PARTS, _PARTS + 1):
        turn, along = middle + swing * part / _PARTS, 0.0
        while along < far + wide:
            yield (x + along * cos(turn), y + along * sin(turn)), wide
            along += wide / 2
