"""Feet of dials: where pins between a dial and the plate behind it pass all that turns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from math import cos, dist, inf, pi, sin

from geartrain.scene.parts.frame_plan import FramePlan
from geartrain.scene.parts.pillar_places import clear_of, pillar_places
from geartrain.scene.parts.stack_discs import Point, swept_circle
from geartrain.scene.parts.turned_parts import Band, TurnedPart

RADIUS = 1.5  # mm: of a foot; its ends in the plates are thinner
TENON = 0.6
_GAP = 0.5  # mm between a foot and what turns
_FEET, _MOST, _WAYS = 3, 4, 48
_AWAY = (0.92, 0.8, 0.65, 0.5, 0.35)  # of the radius of the dial: where a foot is tried, the outermost first
_EDGE = 1.0  # mm of dial round the end of a foot
_STEPS = 32  # from the middle of a dial to a foot, at which the straight edge between them is looked at


def dial_feet(
    plan: FramePlan, name: str, circles: Sequence[tuple[Point, float]], faces: tuple[float, float]
) -> list[TurnedPart]:
    """Feet of a plate of dials, up to four inside its dials and as far apart as they can be, else round all that turns.

    circles   middles and radii of its dials; `faces`, its heights (mm)
    """
    above = faces[0] > plan.places.front[1]
    plate = plan.places.front if above else plan.places.back
    low, high = (plate[1], faces[0]) if above else (faces[1], plate[0])
    turning = list(_between(plan, low, high))
    free = [spot for at, radius in circles for spot in _tried(at, radius) if clear_of(spot, turning) > RADIUS + _GAP]
    spots = _apart(free)
    if len(spots) < _FEET or max(dist(one, other) for one, other in combinations(spots, 2)) < circles[0][1]:
        even = len({column.at for column in plan.columns}) == 1  # as its pillars are
        spots = pillar_places(
            [at for at, _ in circles],
            turning,
            RADIUS,
            lambda spot: _reaches(spot, circles, plan.across(*faces)) > 0,
            even,
        )
    ends = (plate, faces) if above else (faces, plate)
    return [_foot(plan, f"{name} foot {number}", spot, ends) for number, spot in enumerate(spots, 1)]


def _between(plan: FramePlan, low: float, high: float) -> Iterator[tuple[Point, float]]:
    """What stands or turns between two heights, as circles."""
    yield from (swept_circle(disc) for disc in plan.discs if disc.low < high and low < disc.high)
    yield from ((column.at, wide) for column in plan.columns if (wide := column.radius(low, high)))
    yield from plan.across(low, high)


def _reaches(spot: Point, dials: Sequence[tuple[Point, float]], others: Sequence[tuple[Point, float]]) -> float:
    """How far from some circles (mm) a plate is that goes straight from its dials to the end of a foot."""
    least = inf
    for (x, y), radius in dials:
        for step in range(_STEPS + 1):
            t = step / _STEPS
            at = x + t * (spot[0] - x), y + t * (spot[1] - y)
            least = min(least, clear_of(at, others) - (radius + t * (RADIUS + _EDGE - radius)))
    return least


def _tried(at: Point, radius: float) -> Iterator[Point]:
    for share, way in product(_AWAY, range(_WAYS)):
        away, turn = min(share * radius, radius - RADIUS - _EDGE), 2 * pi * (way + 0.5) / _WAYS
        yield at[0] + away * cos(turn), at[1] + away * sin(turn)


def _apart(free: Sequence[Point]) -> list[Point]:
    """The first, then always the one that is farthest from those taken."""
    taken = list(free[:1])
    while len(taken) < min(_MOST, len(free)):
        spot = max(free, key=lambda each: min(dist(each, other) for other in taken))
        if spot in taken:
            break
        taken.append(spot)
    return taken


def _foot(plan: FramePlan, name: str, at: Point, ends: tuple[tuple[float, float], ...]) -> TurnedPart:
    below, above = ends
    thin = TENON * RADIUS
    bands = Band(*below, thin), Band(below[1], above[0], RADIUS), Band(*above, thin)
    return TurnedPart(plan.stack.frame, name, "foot", at, bands, f"in both plates, {plan.process.joint}")
