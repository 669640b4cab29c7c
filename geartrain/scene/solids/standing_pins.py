"""Where the pins stand that plates bear: those of rings of pins, and those that work in holes of a disc."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.elements import ToothProfile
from geartrain.scene.parts.pin_circles import StandingPins
from geartrain.scene.solids.solid_part import wheel_frame

if TYPE_CHECKING:
    from geartrain.scene.elements import SceneWheel
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
