"""The plan of parallel axes: points of a plane at given distances, with room between them.

Distances that cannot all be had are missed as little as can be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.placement_order import PlacementOrder, PlacementStep
from geartrain.scene.layout.plan_clearance import Disc, PlanClearance

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_TOUCH = 1e-10  # of a distance: nearer than this it is kept
_STEPS = 60
_MOST = 400  # points up to which a dense matrix is solved


def fit(points: Floats, edges: Sequence[tuple[int, int, float]], fixed: Sequence[int]) -> Floats:
    """Least squares of the misses by Gauss and Newton, in steps of at most a tenth of a distance; `fixed` stay."""
    free = [at for at in range(len(points)) if at not in set(fixed)]
    edges = [(a, b, far) for a, b, far in edges if not {a, b} <= set(fixed)]
    if (
        not edges
        or not free
        or len(points) > _MOST
        or np.all(np.abs(_distance_misses(points, edges)[0]) <= _tolerance(edges))
    ):
        return points
    column = {at: 2 * nth for nth, at in enumerate(free)}
    points = points.copy()
    for _ in range(_STEPS):
        miss, ways = _distance_misses(points, edges)
        matrix = np.zeros((len(edges), 2 * len(free)))
        for row, (a, b, _) in enumerate(edges):
            for end, sign in ((a, -1.0), (b, 1.0)):
                if end in column:
                    matrix[row, column[end] : column[end] + 2] = sign * ways[row]
        move = np.linalg.lstsq(matrix, -miss, rcond=1e-9)[0].reshape(-1, 2)
        most = 0.1 * max(far for *_, far in edges)
        longest = float(np.abs(move).max())
        points[free] += move * min(1.0, most / longest) if longest else 0.0
        if longest < _TOUCH * most:
            break
    return points


def _distance_misses(points: Floats, edges: Sequence[tuple[int, int, float]]) -> tuple[Floats, Floats]:
    ends = np.array([(a, b) for a, b, _ in edges])
    apart = points[ends[:, 1]] - points[ends[:, 0]]
    far = np.hypot(apart[:, 0], apart[:, 1])
    ways = apart / np.where(far > 0, far, 1.0)[:, None]
    return far - np.array([each[2] for each in edges]), ways


def _tolerance(edges: Sequence[tuple[int, int, float]]) -> Floats:
    return _TOUCH * np.array([max(far, 1e-9) for *_, far in edges])


Point = tuple[float, float]
_DIRECTIONS = 48
_BEAM = ((60, 12), (200, 4))  # axes up to which that many plans are kept
_MISS = 1e4  # cost of a distance that is missed (mm over mm)
_FAR = 0.15  # of the way from the middle of all that stands
_SIDE = 0.3  # of standing away from the side where a wheel across needs room


@dataclass(frozen=True)
class PlacementProblem:
    """What is asked of a plan.

    labels     axes; `bearers`, the link that bears each, and `carried`, whether it moves
    pivots     axes of carriers, which are placed before what they carry
    fixed      points that are given
    distances  of pairs of axes
    discs      wheels of each axis, as far as they stand upright
    mates      pairs of wheels that mesh
    rows       pairs of axes that must stand in a row, and its direction
    sides      directions in which an axis has a wheel across, best on the outside
    turns      axis -> the number of places round its pivot at which its teeth meet both its mates
    """

    labels: Sequence[str]
    bearers: Mapping[str, str]
    pivots: Mapping[str, str]
    fixed: Mapping[str, Point]
    distances: Mapping[tuple[str, str], float]
    discs: Mapping[str, Sequence[Disc]]
    mates: frozenset[frozenset[str]]
    rows: Mapping[tuple[str, str], Point] = field(default_factory=dict)
    sides: Mapping[str, Point] = field(default_factory=dict)
    turns: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class _Plan:
    points: Floats
    cost: float


@dataclass(frozen=True)
class _Option:
    """A plan and a place for the next axis; made only if it is among the best."""

    plan: _Plan
    place: Floats
    cost: float

    def made(self, at: int) -> _Plan:
        points = self.plan.points.copy()
        points[at] = self.place
        return _Plan(points, self.cost)


def plan(task: PlacementProblem) -> dict[str, Point]:
    """Points of all axes: distances kept where they can be, in least squares where not; the same for the same task.

    Axes are put in one after the other, those first that most distances tie down: at the crossings of circles, or in
    some dozens of directions; of many plans the few that crowd least are carried on.
    """
    linkage = PlacementOrder(
        task.labels, task.distances, task.fixed, task.pivots, {a: _radius(task, a) for a in task.labels}
    )
    room = PlanClearance(task.labels, task.bearers, task.pivots, task.discs, task.mates)
    points = np.zeros((len(task.labels), 2))
    for label, point in task.fixed.items():
        points[linkage.index[label]] = point
    width = next((wide for most, wide in _BEAM if len(task.labels) <= most), 1)
    plans = [_Plan(points, 0.0)]
    for step in linkage.steps:
        found = [option for one in plans for option in _options(task, linkage, room, step, one, width)]
        plans = [option.made(step.at) for option in sorted(found, key=lambda option: option.cost)[:width]]
    best = fit(plans[0].points, linkage.edges, [linkage.index[label] for label in task.fixed])
    return {label: (float(best[at, 0]), float(best[at, 1])) for label, at in linkage.index.items()}


def _radius(task: PlacementProblem, label: str) -> float:
    return max((disc.outer for disc in task.discs.get(label, ())), default=0.0)


def _options(
    task: PlacementProblem, linkage: PlacementOrder, room: PlanClearance, step: PlacementStep, plan: _Plan, most: int
) -> list[_Option]:
    label = task.labels[step.at]
    candidates = _candidates(task, linkage, step, plan.points)
    costs = _misses(step, candidates, plan.points) + room.cost(step.at, step.placed, candidates, plan.points)
    if len(step.placed):
        apart = candidates - plan.points[step.placed].mean(axis=0)
        costs += _FAR * np.hypot(apart[:, 0], apart[:, 1])
        costs -= _SIDE * apart @ np.array(task.sides.get(label, (0.0, 0.0)))
    best = np.argsort(costs.round(9), kind="stable")[:most].tolist()
    return [_Option(plan, candidates[at], round(plan.cost + float(costs[at]), 9)) for at in best]


def _misses(step: PlacementStep, candidates: Floats, points: Floats) -> Floats:
    total = np.zeros(len(candidates))
    for other, low, high in (*step.tied, *step.bounds):
        apart = candidates - points[other]
        far = np.hypot(apart[:, 0], apart[:, 1])
        total += _MISS * (np.maximum(far - high, 0) + np.maximum(low - far, 0))
    return total


def _candidates(task: PlacementProblem, linkage: PlacementOrder, step: PlacementStep, points: Floats) -> Floats:
    label = task.labels[step.at]
    row = _row(task, linkage, step, points)
    if not step.tied:
        return np.array(row or _outside(task, linkage, step, points))
    if row:
        return np.array(row)
    if len(step.tied) > 1:
        found = [
            point
            for at, (one, first, _) in enumerate(step.tied)
            for other, second, _ in step.tied[at + 1 :]
            for point in crossings(points[one].tolist(), first, points[other].tolist(), second)
        ]
        if found:
            return np.array(found)
    pivot, far, _ = step.tied[0]
    return np.array(_round(task, linkage, step, label, points, pivot, far))


def _round(
    task: PlacementProblem,
    linkage: PlacementOrder,
    step: PlacementStep,
    label: str,
    points: Floats,
    pivot: int,
    far: float,
) -> list[Point]:
    """Points of a circle: in all directions, where teeth meet, or opposite to what is already there."""
    x, y = points[pivot].tolist()
    brothers = linkage.brothers.get(step.at, ())
    count, first = task.turns.get(label, 0), 0.0
    if brothers and brothers[0] != step.at:
        u, v = (points[brothers[0]] - points[pivot]).tolist()
        first = float(np.arctan2(v, u))
        turns = [brothers.index(step.at) / len(brothers)]
    else:
        turns = [at / _DIRECTIONS for at in range(_DIRECTIONS)]
    if count and (brothers or step.at in brothers):
        turns = list(dict.fromkeys(round(turn * count) / count for turn in turns))
    found = [(x + far * cos(first + 2 * pi * turn), y + far * sin(first + 2 * pi * turn)) for turn in turns]
    for other, low, high in step.bounds:  # arcs from which the rest still reaches may be narrow
        found += crossings((x, y), far, points[other].tolist(), (low + high) / 2)
    return found


def _outside(task: PlacementProblem, linkage: PlacementOrder, step: PlacementStep, points: Floats) -> list[Point]:
    """Beside all that stands."""
    if not len(step.placed):
        return [(0.0, 0.0)]
    reach = linkage.radius
    middle = points[step.placed].mean(axis=0)
    apart = points[step.placed] - middle
    far = float(np.max(np.hypot(apart[:, 0], apart[:, 1]) + reach[step.placed])) + 1.1 * float(reach[step.at])
    x, y = middle.tolist()
    return [(x + far * cos(pi * at / 4), y + far * sin(pi * at / 4)) for at in range(8)]


def _row(task: PlacementProblem, linkage: PlacementOrder, step: PlacementStep, points: Floats) -> list[Point]:
    """Points in a row with an axis that stands already: at the distance it must have from another, or free."""
    label, placed = task.labels[step.at], set(step.placed.tolist())
    for pair, way in task.rows.items():
        if label not in pair:
            continue
        other = linkage.index[pair[0] if pair[1] == label else pair[1]]
        if other not in placed:
            continue
        x, y = points[other].tolist()
        if step.tied:
            centre, far, _ = step.tied[0]
            return line_crossings((x, y), way, points[centre].tolist(), far)
        far = 1.2 * float(linkage.radius[step.at] + linkage.radius[other])
        return [
            (x + side * times * far * way[0], y + side * times * far * way[1]) for times in (1, 2) for side in (1, -1)
        ]
    return []


def crossings(a: Sequence[float], far: float, b: Sequence[float], other: float) -> list[Point]:
    """Where two circles cross; the nearest point between where they do not; nothing about one centre."""
    apart = hypot(b[0] - a[0], b[1] - a[1])
    if apart < 1e-12 * (far + other):
        return []
    along = (apart * apart + far * far - other * other) / (2 * apart)
    square = far * far - along * along
    if square < -1e-9 * far * far:
        # as far off from one circle as from the other
        side, back = (-1 if other > apart + far else 1), (1 if far > apart + other else -1)
        along, square = (apart + back * other + side * far) / 2, 0.0
    high = max(square, 0.0) ** 0.5
    u, v = (b[0] - a[0]) / apart, (b[1] - a[1]) / apart
    x, y = a[0] + along * u, a[1] + along * v
    return [(x - high * v, y + high * u), (x + high * v, y - high * u)] if high else [(x, y)]


def line_crossings(point: Point, way: Point, centre: Sequence[float], far: float) -> list[Point]:
    """Where a line crosses a circle; its nearest point where it does not."""
    u, v = centre[0] - point[0], centre[1] - point[1]
    middle = u * way[0] + v * way[1]
    square = far * far - (u * u + v * v - middle * middle)
    half = max(square, 0.0) ** 0.5
    return [
        (point[0] + (middle + side * half) * way[0], point[1] + (middle + side * half) * way[1]) for side in (1, -1)
    ]
