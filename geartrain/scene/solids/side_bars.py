"""Bars beside an axis, which join an arm to its link: where they stand on the widest of its wheels."""

from __future__ import annotations

from collections.abc import Iterator
from math import asin, atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

from geartrain.scene.parts.arbor_columns import APART
from geartrain.scene.parts.carried_axes import seen_from_carrier
from geartrain.scene.parts.pillar_places import clear_of
from geartrain.scene.parts.pin_circles import StandingPins
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.solids.pin_couplings import slot_reach

if TYPE_CHECKING:
    from geartrain.scene.elements import SceneCoupling
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.train_scene import Scene

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
