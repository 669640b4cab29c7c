"""Where pins and bars stand in plates and wheels.

Plates bear the pins of rings of pins, and those that work in holes of a disc. A bar beside an axis joins an arm to its
link; it stands on the widest of its wheels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import asin, atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.elements import ToothProfile
from geartrain.scene.parts.arbor_columns import APART
from geartrain.scene.parts.carried_axes import seen_from_carrier
from geartrain.scene.parts.pillar_places import clear_of
from geartrain.scene.parts.pin_circles import StandingPins
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.solids.pin_couplings import slot_reach
from geartrain.scene.solids.solid_part import wheel_frame

if TYPE_CHECKING:
    from geartrain.scene.elements import SceneCoupling, SceneWheel
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.solids.wheel_blanks import Blank
    from geartrain.scene.train_scene import Scene

_CHORDS = 13  # of half a seat


def standing_pins(scene: Scene, plan: FramePlan) -> Iterator[StandingPins]:
    """All of a train, in the coordinates of its stack."""
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
        done.add(link)  # pins of one link go through all discs that it has pins for
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
    """The scene with rings as they are without their pins, which are parts: teeth stand between two seats."""
    wheels, profiles = list(scene.wheels), list(scene.profiles)
    for at, wheel in enumerate(wheels):
        blank = plan.stack.blanks.get(wheel.id)
        if blank is not None and blank.pins is not None:
            form = profiles[wheel.profile].form
            points = _land(blank)
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


def _land(blank: Blank) -> tuple[tuple[float, float], ...]:
    """What a ring has between the middles of two seats, radius over its pitch radius and angle."""
    assert blank.pins is not None
    x, y = (float(part) for part in blank.contours[1].points[0])  # on the circle inside, where the first seat begins
    R, half, pitch = blank.pins.circle * blank.module, pi / blank.teeth, blank.pitch_radius
    inside = float(np.hypot(x, y)) / pitch
    if blank.contours[1].is_circle:
        return (inside, -half), (inside, half)
    reach = float(np.hypot(x - R, y))
    seat = R + reach * np.exp(1j * np.linspace(0, float(np.arctan2(-y, x - R)), _CHORDS))
    left = list(zip((abs(seat) / pitch).tolist(), (np.angle(seat) - half).tolist(), strict=True))
    return *left, (inside, 0.0), *((radius, -angle) for radius, angle in left[::-1])


# ----------------------------------------------------------------------------------------------------------------- bars

_RADIUS = 1.5  # mm: of a bar
_EDGE = 1.0  # mm of the wheel round its end
_WAYS, _STEP = 120, 1.0  # directions in which a bar is tried, and by how much farther in each time (mm)
_ENOUGH = 1.0  # mm: more room than that is not looked for
_PARTS = 8  # of a swing, at which a bar with a slot is looked at


def side_bars(scene: Scene, plan: FramePlan) -> Iterator[StandingPins]:
    """All of a plan, in the coordinates of its stack."""
    discs = {disc.name: disc for disc in plan.discs}
    for plate in plan.turning:
        if plate.disc.apart:
            own = [disc for disc in plan.discs if disc.axis == plate.disc.axis and disc.link == plate.disc.link]
            wheel = max((disc for disc in own if disc.hub and not disc.apart), key=lambda disc: disc.root)
            spot = _spot(scene, plan, wheel, discs[plate.disc.name])
            yield StandingPins(f"{wheel.link} bar", wheel.link, plate.disc.name, wheel.name, (spot,), _RADIUS, True)


def _spot(scene: Scene, plan: FramePlan, wheel: StackDisc, arm: StackDisc) -> Point:
    """The farthest out with enough room, as one sees it who turns with wheel and arm; else that with the most."""
    low, high = min(wheel.high, arm.high), max(wheel.low, arm.low)
    seen = [seen_from_carrier(wheel.link, wheel.at, disc) for disc in plan.discs if disc.low < high and low < disc.high]
    rods = [(each.at, wide) for each in plan.all_columns if (wide := each.radius(wheel.low, high))]
    slots = [circle for each in scene.couplings for circle in _swept(scene, plan, each, wheel)]

    def room(at: Point) -> float:
        near = min((disc.room_for(at, _RADIUS) for disc in seen), default=_ENOUGH)
        return min(near, clear_of(at, [*rods, *slots]) - _RADIUS, _ENOUGH)

    best, least = wheel.at, -wheel.root
    away = wheel.root - _RADIUS - _EDGE
    while away > 0 and least < _ENOUGH - APART:
        at = max(_round(wheel.at, away), key=room)
        if room(at) > least:
            best, least = at, room(at)
        away -= _STEP
    return best


def _round(centre: Point, radius: float) -> Iterator[Point]:
    """Points on a circle."""
    for way in range(_WAYS):
        turn = 2 * pi * way / _WAYS
        yield centre[0] + radius * cos(turn), centre[1] + radius * sin(turn)


def _swept(scene: Scene, plan: FramePlan, coupling: SceneCoupling, wheel: StackDisc) -> Iterator[tuple[Point, float]]:
    """Circles that hold the bar with a slot wherever its pin takes it, as the carrier of both sees it."""
    if scene.bodies[coupling.carrier].id != wheel.link:
        return
    stack = plan.stack
    (x, y), pin = stack.flat(coupling.slot_at), stack.flat(scene.bodies[coupling.pin].point)
    far, wide = slot_reach(coupling)
    r, e = coupling.pin_radius, hypot(pin[0] - x, pin[1] - y)
    if r >= e:  # it goes round with the pin
        yield (x, y), far + wide
        return
    middle, swing = atan2(pin[1] - y, pin[0] - x), asin(r / e)
    for part in range(-_PARTS, _PARTS + 1):
        turn, along = middle + swing * part / _PARTS, 0.0
        while along < far + wide:
            yield (x + along * cos(turn), y + along * sin(turn)), wide
            along += wide / 2
