"""Positions of the pillars of a frame and of the posts that hold rings.

Pillars are outside of all parts that turn between the plates, and surround all axes. Posts connect a ring to a plate
of the frame, or to the disc of a turning ring.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from math import cos, dist, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem
from geartrain.scene.parts.stack_discs import Point, StackDisc, swept_circle
from geartrain.scene.parts.turned_parts import Band, TurnedPart

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.frame_plan import FramePlan

_WAYS = 24  # directions of candidate places from the middle of the axes
_STEP = 0.25  # mm beyond the blocked part of a ray
_GAP = 1.0  # mm of clearance between a pillar and a tip circle
_HOLE = 4.0  # mm from a pillar to the centre of a pivot hole
_FEWEST, _MOST = 3, 5
_SPREAD = 4.0  # minimum distance of neighbours in radii
_UNEVEN = 0.3  # mm of perimeter per mm from the middle of the axes to that of the pillars
_UPWARDS = 0.05  # mm of perimeter per mm of their mean vertical distance from the middle


def pillar_places(
    axes: Sequence[Point],
    circles: Sequence[tuple[Point, float]],
    radius: float,
    suits: Callable[[Point], bool] = lambda _: True,
    even: bool = False,
) -> list[Point]:
    """Return four, three or five positions of pillars [mm], in this order of preference.

    They are the polygon around all axes with the shortest perimeter or, if there is none, up to five positions that are
    far apart. In each direction from the middle of the axes, the candidate is the innermost position with free space
    outwards. Candidates that do not satisfy `suits` are used only if too few satisfy it. If `even` is True, the
    positions surround a single axis evenly, and their polygon is wider than high.
    """
    points = np.array(axes, dtype=float)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    blocked = [(np.array(at), reach + radius + _GAP) for at, reach in circles]
    blocked += [(each, radius + _HOLE) for each in points]
    tried = np.array([_free(middle, 2 * pi * (k + 0.5) / _WAYS, blocked) for k in range(_WAYS)])
    suiting = [suits((float(x), float(y))) for x, y in tried]
    tried = tried[suiting] if sum(suiting) >= _FEWEST else tried
    even = even and not np.ptp(points, axis=0).any()
    for count in (4, _FEWEST, _MOST):
        if (found := _around(tried - middle, points - middle, count, _SPREAD * radius, even)) is not None:
            return [(float(x), float(y)) for x, y in middle + found]
    spots = [(float(x), float(y)) for x, y in tried]
    return far_apart(spots, max(spots, key=lambda each: dist(each, middle)), _MOST)


def far_apart(spots: Sequence[Point], first: Point, count: int) -> list[Point]:
    """Return `count` positions: the first, then repeatedly the one farthest from those chosen (greedy dispersion)."""
    taken = [first]
    while len(taken) < min(count, len(set(spots))):
        taken.append(max(spots, key=lambda each: min(dist(each, other) for other in taken)))
    return taken


def _free(middle: Floats, angle: float, blocked: Sequence[tuple[Floats, float]]) -> Floats:
    """Return the point on a ray from `middle` that is just beyond the last circle that the ray intersects [mm]."""
    along = np.array([cos(angle), sin(angle)])
    far = 0.0
    for centre, reach in blocked:
        away = centre - middle
        near, aside = float(away @ along), float(away[0] * along[1] - away[1] * along[0])
        if abs(aside) < reach:
            far = max(far, near + float(np.sqrt(reach**2 - aside**2)))
    return np.asarray(middle + (far + _STEP) * along)


def _around(tried: Floats, axes: Floats, count: int, minimum_edge: float, even: bool) -> Floats | None:
    """Return the shortest polygon around all axes, shape (count, 2); None if none exists.

    tried          candidates for its corners, counter-clockwise
    minimum_edge   minimum length of an edge [mm]
    even           True for a polygon that is wider than high
    """
    best, minimum = None, np.inf
    steps = tried[None, :, :] - tried[:, None, :]
    cross = steps[:, :, None, 0] * (axes[None, None, :, 1] - tried[:, None, None, 1])
    cross = cross - steps[:, :, None, 1] * (axes[None, None, :, 0] - tried[:, None, None, 0])
    left = np.all(cross > 0, axis=2)  # all axes are to the left of the edge from one place to another
    length = np.hypot(steps[..., 0], steps[..., 1])
    left &= length >= minimum_edge
    for chosen in combinations(range(len(tried)), count):
        edges = list(zip(chosen, (*chosen[1:], chosen[0]), strict=True))
        if all(left[a, b] for a, b in edges):
            places = tried[[*chosen]]
            whole = sum(float(length[a, b]) for a, b in edges)
            if even:
                whole += _UNEVEN * float(np.hypot(*places.mean(axis=0))) + _UPWARDS * float(abs(places[:, 1]).mean())
            if whole < minimum:
                best, minimum = places, whole
    return best


def clear_of(at: Point, circles: Sequence[tuple[Point, float]]) -> float:
    """Return the minimum distance from a point to the circles [mm]: negative in a circle, infinite without circles."""
    return min((dist(at, centre) - reach for centre, reach in circles), default=np.inf)


# ------------------------------------------------------------------------------------------------------- posts of rings


TENON = 0.6
"""Radius of the tenon of a pillar or post, which is fixed in a plate, divided by the radius of the pillar or post."""
_POSTS, _TRIED = 3, 72
_POST_WIDEST = 2.0  # mm: maximum radius of a post
_RIM_PART = 0.3  # radius of the end of a post divided by the width of a ring's rim


def ring_posts(plan: FramePlan) -> tuple[TurnedPart, ...]:
    """Return the parts that hold all rings: posts in a frame plate, and drums between turning rings and their discs."""
    found: list[TurnedPart] = []
    discs = {plate.ring: plate.disc.name for plate in plan.turning if plate.ring}
    for disc in plan.discs:
        if disc.hub:
            continue
        if disc.link == plan.stack.frame:
            found += _posts(plan, disc)
        elif disc.name in discs:
            wall = Band(*_between(disc, plan.heights.plates[discs[disc.name]]), disc.outer, disc.root)
            found.append(TurnedPart(disc.link, f"{disc.name} drum", "drum", disc.at, (wall,), plan.process.joint))
    return tuple(found)


def nearer_plate(plan: FramePlan, height: float) -> tuple[float, float]:
    """Return the heights of the faces of the frame plate whose middle is nearer to a height [mm]."""
    return min((plan.places.back, plan.places.front), key=lambda each: abs(sum(each) / 2 - height))


def _between(ring: StackDisc, plate: tuple[float, float]) -> tuple[float, float]:
    """Return the heights of the facing faces of a ring and a plate, in ascending order [mm]."""
    return (plate[1], ring.low) if plate[1] < ring.low else (ring.high, plate[0])


def _posts(plan: FramePlan, ring: StackDisc) -> Iterator[TurnedPart]:
    """Yield three equally spaced posts of a ring in the nearer frame plate, with clearance from other parts."""
    plate, radius = nearer_plate(plan, ring.middle), min(_RIM_PART / TENON * (ring.outer - ring.root), _POST_WIDEST)
    start, end = sorted((sum(plate) / 2, ring.middle))
    between = [disc for disc in plan.discs if start < disc.middle < end and disc.name != ring.name]
    low, high, inner = min(plate[0], ring.low), max(plate[1], ring.high), _between(ring, plate)
    circles = [swept_circle(disc) for disc in between]
    circles += [(column.at, column.radius(low, high)) for column in plan.columns]
    away = (ring.outer + ring.root) / 2
    tried = [evenly(ring.at, away, _POSTS, 2 * pi * k / _TRIED / _POSTS) for k in range(_TRIED)]
    # clearance above 0.5 mm does not matter: the first such rotation is used, so that the result is stable
    spots = max(tried, key=lambda spots: min(0.5, *(clear_of(at, circles) - radius for at in spots)))
    for number, at in enumerate(spots, 1):
        bands = Band(low, inner[0], radius * TENON), Band(*inner, radius), Band(inner[1], high, radius * TENON)
        yield TurnedPart(ring.link, f"{ring.name} post {number}", "post", at, bands, plan.process.joint, (ring.name,))


def blocked_posts(plan: FramePlan, posts: Iterable[TurnedPart]) -> Iterator[Problem]:
    """Yield a problem for each post in the frame that would collide with a wheel."""
    low, high = plan.places.back[0], plan.places.front[1]
    for post in (each for each in posts if each.link == plan.stack.frame):
        inside = [disc for disc in plan.discs if post.ends[0] < disc.low and disc.high < post.ends[1]]
        for disc in (each for each in inside if low < each.middle < high and each.hub):
            if (room := clear_of(post.at, [swept_circle(disc)]) - post.diameter / 2) < 0:
                what = f"{post.name} collides with '{disc.name}'"
                yield Problem(
                    what, f"post and wheel overlap by {-room:.3f} mm", "support the ring with a bracket at its side"
                )


def evenly(at: Point, away: float, count: int, start: float = 0.0) -> list[Point]:
    """Return equally spaced points on a circle of radius `away` [mm], from the angle `start` [rad]."""
    turns: Sequence[float] = [start + 2 * pi * k / count for k in range(count)]
    return [(at[0] + away * cos(turn), at[1] + away * sin(turn)) for turn in turns]
