"""Posts that hold rings: in a plate of the frame, or in the disc of a ring that turns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import cos, pi, sin
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.scene.parts.pillar_places import clear_of
from geartrain.scene.parts.stack_discs import Point, StackDisc, swept_circle
from geartrain.scene.parts.turned_parts import Band, TurnedPart

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plan import FramePlan

TENON = 0.6
"""Of the radius of a pillar or a post: what stands in a plate."""
_POSTS, _TRIED = 3, 72
_POST_WIDEST = 2.0  # mm: radius of a post
_RIM_PART = 0.3  # of a ring's rim: the radius of what goes through it


def ring_posts(plan: FramePlan) -> tuple[TurnedPart, ...]:
    """All posts of a plan."""
    found: list[TurnedPart] = []
    discs = {plate.ring: plate.disc.name for plate in plan.turning if plate.ring}
    for disc in plan.discs:
        if disc.hub:
            continue
        if disc.link == plan.stack.frame:
            found += _posts(plan, disc, nearer_plate(plan, disc.middle), (disc.name,))
        elif disc.name in discs:
            found += _posts(plan, disc, plan.heights.plates[discs[disc.name]], (disc.name, discs[disc.name]))
    return tuple(found)


def nearer_plate(plan: FramePlan, height: float) -> tuple[float, float]:
    """The plate of the frame that is nearer to a height."""
    return min((plan.places.back, plan.places.front), key=lambda each: abs(sum(each) / 2 - height))


def _posts(
    plan: FramePlan, ring: StackDisc, plate: tuple[float, float], through: tuple[str, ...]
) -> Iterator[TurnedPart]:
    """Of one ring; in a plate of the frame where they are in nobody's way."""
    wide = ring.outer - ring.root
    radius = min(_RIM_PART * wide, _POST_WIDEST)
    away = (ring.outer + ring.root) / 2
    free = ring.link == plan.stack.frame
    spots = _spots(plan, ring, plate, away, radius) if free else _evenly(ring.at, away, 2 * _POSTS)
    low, high = min(plate[0], ring.low), max(plate[1], ring.high)
    inner = (plate[1], ring.low) if plate[1] < ring.low else (ring.high, plate[0])
    for number, at in enumerate(spots, 1):
        bands = Band(low, inner[0], radius * TENON), Band(*inner, radius), Band(inner[1], high, radius * TENON)
        yield TurnedPart(ring.link, f"{ring.name} post {number}", "post", at, bands, plan.process.joint, through)


def _spots(plan: FramePlan, ring: StackDisc, plate: tuple[float, float], away: float, radius: float) -> list[Point]:
    """Three places on a rim that no axis, and nothing between it and the plate, comes near to; evenly if free."""
    low, high = sorted((sum(plate) / 2, ring.middle))
    between = [disc for disc in plan.discs if low < disc.middle < high and disc.name != ring.name]
    circles = [swept_circle(disc) for disc in between]
    reach = min(plate[0], ring.low), max(plate[1], ring.high)
    circles += [(column.at, column.radius(*reach)) for column in plan.columns]
    tried = [_evenly(ring.at, away, _POSTS, 2 * pi * k / _TRIED / _POSTS) for k in range(_TRIED)]
    return max(tried, key=lambda spots: min(0.5, *(clear_of(at, circles) - radius for at in spots)))


def blocked_posts(plan: FramePlan, posts: Iterable[TurnedPart]) -> Iterator[Problem]:
    """Posts in the frame that are in the way of wheels."""
    low, high = plan.places.back[0], plan.places.front[1]
    for post in (each for each in posts if each.link == plan.stack.frame):
        inside = [disc for disc in plan.discs if post.ends[0] < disc.low and disc.high < post.ends[1]]
        for disc in (each for each in inside if low < each.middle < high and each.hub):
            if (room := clear_of(post.at, [swept_circle(disc)]) - post.diameter / 2) < 0:
                what = f"{post.name} has no way past '{disc.name}'"
                yield Problem(what, f"they overlap by {-room:.3f} mm", "hold the ring by a bracket from its side")


def _evenly(at: Point, away: float, count: int, start: float = 0.0) -> list[Point]:
    turns: Sequence[float] = [start + 2 * pi * k / count for k in range(count)]
    return [(at[0] + away * cos(turn), at[1] + away * sin(turn)) for turn in turns]
