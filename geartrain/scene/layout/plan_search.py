"""The plan of parallel axes: points of a plane at given distances, with room between their wheels.

Beam search: axes are put in one after the other, those first that most distances tie down, each at the crossings of
circles or in some dozens of directions; of many plans the few that crowd least are carried on. Distances that cannot
all be had are missed as little as can be: least squares by the Gauss-Newton method.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.declared_geometry import Point
from geartrain.scene.layout.plan_clearance import PlanClearance
from geartrain.scene.layout.plan_order import Bar, PlanOrder, PlanStep
from geartrain.scene.layout.plan_problem import PlanProblem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_TOUCH = 1e-10  # of a distance: nearer than this it is kept
_STEPS = 60  # of Gauss-Newton
_MOST = 400  # points up to which a dense matrix is solved
_DIRECTIONS = 48  # in which an axis on one circle is tried
_BEAM = ((60, 12), (200, 4))  # axes up to which that many plans are kept
_MISS = 1e4  # cost of a distance that is missed (mm over mm)
_FAR = 0.15  # of the way from the middle of all that stands
_SIDE = 0.3  # of standing away from the side where a wheel across needs room
_ROW = 1.2  # of the radii of two axes in a row: their distance where nothing else gives it


def crossings(a: Sequence[float], radius: float, b: Sequence[float], other: float) -> list[Point]:
    """Where two circles cross; the nearest point between where they do not; nothing about one centre.

    With the distance d of the centres they cross at x = (d^2 + r^2 - s^2) / 2d along it, sqrt(r^2 - x^2) aside.
    """
    apart = hypot(b[0] - a[0], b[1] - a[1])
    if apart < 1e-12 * (radius + other):
        return []
    along = (apart * apart + radius * radius - other * other) / (2 * apart)
    square = radius * radius - along * along
    if square < -1e-9 * radius * radius:
        # they do not cross: the point as far off from one circle as from the other
        side, back = (-1 if other > apart + radius else 1), (1 if radius > apart + other else -1)
        along, square = (apart + back * other + side * radius) / 2, 0.0
    high = max(square, 0.0) ** 0.5  # circles that touch may miss each other by rounding
    u, v = (b[0] - a[0]) / apart, (b[1] - a[1]) / apart
    x, y = a[0] + along * u, a[1] + along * v
    return [(x - high * v, y + high * u), (x + high * v, y - high * u)] if high else [(x, y)]


def line_crossings(point: Point, way: Point, centre: Sequence[float], radius: float) -> list[Point]:
    """Where a line, a point and a unit vector, crosses a circle; its nearest point where it does not."""
    u, v = centre[0] - point[0], centre[1] - point[1]
    middle = u * way[0] + v * way[1]
    square = radius * radius - (u * u + v * v - middle * middle)
    half = max(square, 0.0) ** 0.5
    return [
        (point[0] + (middle + side * half) * way[0], point[1] + (middle + side * half) * way[1]) for side in (1, -1)
    ]


def fit_distances(points: Floats, bars: Sequence[Bar], fixed: Iterable[int]) -> Floats:
    """Points (n, 2) nearest to some at which distances are missed least, in least squares; `fixed` stay.

    Gauss-Newton: the Jacobian of |p_b - p_a| has the unit vector from a to b at b, and its opposite at a. Steps are at
    most a tenth of the longest distance, for far from the solution the linear model is worth little.
    """
    fixed = set(fixed)
    free = [at for at in range(len(points)) if at not in fixed]
    bars = [bar for bar in bars if not {bar.first, bar.second} <= fixed]
    if not bars or not free or len(points) > _MOST:
        return points
    # a distance of 0 gives no scale of its own
    kept = _TOUCH * np.array([max(bar.length, 1e-9) for bar in bars])
    if np.all(np.abs(_distance_misses(points, bars)[0]) <= kept):
        return points
    column = {at: 2 * nth for nth, at in enumerate(free)}
    points = points.copy()
    longest_step = 0.1 * max(bar.length for bar in bars)
    for _ in range(_STEPS):
        miss, ways = _distance_misses(points, bars)
        jacobian = np.zeros((len(bars), 2 * len(free)))
        for row, bar in enumerate(bars):
            for end, sign in ((bar.first, -1.0), (bar.second, 1.0)):
                if end in column:
                    jacobian[row, column[end] : column[end] + 2] = sign * ways[row]
        # the least step: plans that may turn or bend freely have no unique one
        move = np.linalg.lstsq(jacobian, -miss, rcond=1e-9)[0].reshape(-1, 2)
        longest = float(np.abs(move).max())
        points[free] += move * min(1.0, longest_step / longest) if longest else 0.0
        if longest < _TOUCH * longest_step:
            break
    return points


def _distance_misses(points: Floats, bars: Sequence[Bar]) -> tuple[Floats, Floats]:
    """How much too long each distance is, and the unit vector along it; zero where both ends are one point."""
    ends = np.array([(bar.first, bar.second) for bar in bars])
    apart = points[ends[:, 1]] - points[ends[:, 0]]
    far = np.hypot(apart[:, 0], apart[:, 1])
    ways = apart / np.where(far > 0, far, 1.0)[:, None]
    return far - np.array([bar.length for bar in bars]), ways


def plan_axes(problem: PlanProblem) -> dict[str, Point]:
    """Points of all axes: distances kept where they can be, in least squares where not; the same each time."""
    return _BeamSearch(problem).found()


@dataclass(frozen=True)
class _Plan:
    """Points of all axes, of which some are put in, and what they cost."""

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


class _BeamSearch:
    def __init__(self, problem: PlanProblem) -> None:
        self.problem = problem
        self.order = PlanOrder(problem)
        self.clearance = PlanClearance(problem)
        self.width = next((wide for most, wide in _BEAM if len(problem.labels) <= most), 1)

    def found(self) -> dict[str, Point]:
        """Points of the best plan."""
        problem, index = self.problem, self.order.index
        points = np.zeros((len(problem.labels), 2))
        for label, point in problem.fixed.items():
            points[index[label]] = point
        plans = [_Plan(points, 0.0)]
        for step in self.order.steps:
            options = [option for plan in plans for option in self._options(step, plan)]
            best = sorted(options, key=lambda option: option.cost)[: self.width]
            plans = [option.made(step.axis) for option in best]
        fitted = fit_distances(plans[0].points, self.order.bars, [index[label] for label in problem.fixed])
        return {label: (float(fitted[at, 0]), float(fitted[at, 1])) for label, at in index.items()}

    def _options(self, step: PlanStep, plan: _Plan) -> list[_Option]:
        """The best places of an axis in one plan."""
        candidates = self._candidates(step, plan.points)
        costs = _missed(step, candidates, plan.points)
        costs += self.clearance.cost(step.axis, step.placed, candidates, plan.points)
        if len(step.placed):
            apart = candidates - plan.points[step.placed].mean(axis=0)
            costs += _FAR * np.hypot(apart[:, 0], apart[:, 1])
            costs -= _SIDE * apart @ np.array(self.problem.sides.get(self.problem.labels[step.axis], (0.0, 0.0)))
        # rounded and stable: of places that are equal but for rounding, the first on every machine
        best = np.argsort(costs.round(9), kind="stable")[: self.width].tolist()
        return [_Option(plan, candidates[at], round(plan.cost + float(costs[at]), 9)) for at in best]

    def _candidates(self, step: PlanStep, points: Floats) -> Floats:
        """Places to be tried for an axis."""
        row = self._in_row(step, points)
        if row:
            return np.array(row)
        if not step.tied:
            return np.array(self._outside(step, points))
        found = [
            point
            for at, one in enumerate(step.tied)
            for other in step.tied[at + 1 :]
            for point in crossings(points[one.axis].tolist(), one.most, points[other.axis].tolist(), other.most)
        ]
        return np.array(found or self._round_first(step, points))

    def _in_row(self, step: PlanStep, points: Floats) -> list[Point]:
        """Points in a row with an axis that stands already: at the distance it must have from another, or free."""
        label, placed = self.problem.labels[step.axis], set(step.placed.tolist())
        for pair, way in self.problem.rows.items():
            if label not in pair:
                continue
            other = self.order.index[pair[0] if pair[1] == label else pair[1]]
            if other not in placed:
                continue
            x, y = points[other].tolist()
            if step.tied:
                first = step.tied[0]
                return line_crossings((x, y), way, points[first.axis].tolist(), first.most)
            far = _ROW * float(self.order.radius[step.axis] + self.order.radius[other])
            return [
                (x + side * times * far * way[0], y + side * times * far * way[1])
                for times in (1, 2)
                for side in (1, -1)
            ]
        return []

    def _outside(self, step: PlanStep, points: Floats) -> list[Point]:
        """Beside all that stands."""
        if not len(step.placed):
            return [(0.0, 0.0)]
        radius = self.order.radius
        middle = points[step.placed].mean(axis=0)
        apart = points[step.placed] - middle
        far = float(np.max(np.hypot(apart[:, 0], apart[:, 1]) + radius[step.placed])) + 1.1 * float(radius[step.axis])
        x, y = middle.tolist()
        return [(x + far * cos(pi * at / 4), y + far * sin(pi * at / 4)) for at in range(8)]

    def _round_first(self, step: PlanStep, points: Floats) -> list[Point]:
        """Points of the circle about the first axis it is tied to: in all directions, where teeth meet, or, of axes
        alike on one carrier, evenly spaced from the first of them."""
        pivot, far = step.tied[0].axis, step.tied[0].most
        x, y = points[pivot].tolist()
        alike = self.order.alike.get(step.axis, ())
        first = 0.0
        if alike and alike[0] != step.axis:
            u, v = (points[alike[0]] - points[pivot]).tolist()
            first = float(np.arctan2(v, u))
            turns = [alike.index(step.axis) / len(alike)]
        else:
            turns = [at / _DIRECTIONS for at in range(_DIRECTIONS)]
        count = self.problem.places.get(self.problem.labels[step.axis], 0)
        if count and alike:
            turns = list(dict.fromkeys(round(turn * count) / count for turn in turns))
        found = [(x + far * cos(first + 2 * pi * turn), y + far * sin(first + 2 * pi * turn)) for turn in turns]
        for bound in step.bounds:  # arcs from which the rest still reaches may be narrow
            found += crossings((x, y), far, points[bound.axis].tolist(), (bound.least + bound.most) / 2)
        return found


def _missed(step: PlanStep, candidates: Floats, points: Floats) -> Floats:
    """Cost of the distances that each candidate misses, or leaves no way to keep."""
    total = np.zeros(len(candidates))
    for bound in (*step.tied, *step.bounds):
        apart = candidates - points[bound.axis]
        far = np.hypot(apart[:, 0], apart[:, 1])
        total += _MISS * (np.maximum(far - bound.most, 0) + np.maximum(bound.least - far, 0))
    return total
