"""Plan of parallel axes: points of a plane at given distances, with clearance between the wheels of the axes.

`PlanProblem` contains distances, rows, sides, and discs that need clearance. `plan_axes` finds the points by beam
search: axes are placed one after the other, each at an intersection of circles or in one of 48 directions, and the
plans of lowest cost are continued. Distances that cannot all be satisfied are fitted by least squares.

The order is greedy: the axis that the most distances to placed axes determine comes first. An axis of a closed chain of
distances must stay near enough to placed axes for the rest of the chain to close. Shortest paths (Dijkstra's algorithm)
give the bounds of its distance. The cost of a position is the overlap of wheels of parallel axes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import combinations
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.graphs import joined_groups
from geartrain.scene.layout.declared_geometry import Point
from geartrain.scene.layout.plan_problem import PlanProblem
from geartrain.scene.layout.wheel_modules import WheelSize

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices


# ------------------------------------------------------------------------------------------------------- plan clearance


_HARD = 100.0  # cost per mm of overlap of wheels in one level
_PULLEYS = 1.1  # minimum distance of two pulleys of one belt, divided by the sum of their radii
_OVER = 1.0  # cost per mm of overlap of discs in different levels, because fewer levels are better
_COVER = 2.0  # cost per mm of a disc over another axis, whose arbor it may hit


class PlanClearance:
    """Cost of overlap of wheels at constant distance: on axes of one carrier, or on these axes and the carrier's axis.

    Wheels on axes that carriers move relative to each other are placed on different levels instead.

    still    (axes, axes): True if the distance between the two axes is constant
    radius   radius of the widest wheel of each axis [mm], without rings
    need     (axes, axes): minimum distances between axes whose wheels share a level and do not mesh [mm]
    meet     (axes, axes): True if wheels of the two axes mesh
    """

    def __init__(self, problem: PlanProblem) -> None:
        labels = problem.labels
        number = {label: at for at, label in enumerate(labels)}
        bearer = np.array([problem.bearers[label] for label in labels])
        self.still = bearer[:, None] == bearer[None, :]
        for label, pivot in problem.pivots.items():
            if pivot in number:
                ends = number[label], number[pivot]
                self.still[ends] = self.still[ends[::-1]] = True
        plain = [{name: disc for name, disc in problem.discs[label].items() if not disc.inner} for label in labels]
        self.radius = np.array([max((disc.outer for disc in discs.values()), default=0.0) for discs in plain])
        self.need = _minimum_distances(plain, problem)
        self.meet = np.zeros((len(labels), len(labels)), bool)
        axis = {wheel: at for at, label in enumerate(labels) for wheel in problem.discs[label]}
        for pair in problem.mates:
            both = [axis[wheel] for wheel in pair if wheel in axis]
            if len(both) == 2:
                self.meet[both[0], both[1]] = self.meet[both[1], both[0]] = True

    def cost(self, at: int, placed: Indices, candidates: Floats, points: Floats) -> Floats:
        """Return the cost of each candidate position of an axis: weighted overlaps with placed wheels [mm]."""
        near = placed[self.still[at, placed]]
        # only axes whose wheels may overlap the wheels of this axis at one of its candidate positions cause a cost
        low, high = candidates.min(axis=0), candidates.max(axis=0)
        away = np.maximum(np.maximum(low - points[near], points[near] - high), 0)
        reach = np.maximum(self.radius[at] + self.radius[near], self.need[at, near])
        near = near[np.hypot(away[:, 0], away[:, 1]) < reach]
        apart = candidates[:, None, :] - points[near][None, :, :]
        far = np.hypot(apart[:, :, 0], apart[:, :, 1])
        own, other = self.radius[at], self.radius[near]
        free = ~self.meet[at, near]
        cost = _HARD * np.maximum(self.need[at, near] - far, 0).sum(axis=1)
        cost += _OVER * (np.maximum(own + other - far, 0) * free).sum(axis=1)
        cost += _COVER * (np.maximum(np.maximum(own, other) - far, 0) * free).sum(axis=1)
        return np.asarray(cost, float)


def _minimum_distances(discs: Sequence[Mapping[str, WheelSize]], problem: PlanProblem) -> Floats:
    """Return minimum distances [mm] between axes with wheels on one level, or pulleys of one belt; 0 for others."""
    need = np.zeros((len(discs), len(discs)))
    clusters: dict[int, list[tuple[int, str]]] = {}
    for at, own in enumerate(discs):
        for wheel in own:
            clusters.setdefault(problem.cluster[wheel], []).append((at, wheel))
    for members in clusters.values():
        for (a, one), (b, other) in combinations(members, 2):
            if a != b and frozenset((one, other)) not in problem.mates:
                need[a, b] = need[b, a] = max(need[a, b], discs[a][one].outer + discs[b][other].outer)
    number = {label: at for at, label in enumerate(problem.labels)}
    for belt in problem.belts:
        for one, other in combinations(belt.keys() & number.keys(), 2):
            a, b = number[one], number[other]
            need[a, b] = need[b, a] = max(need[a, b], _PULLEYS * (belt[one] + belt[other]))
    return need


# ----------------------------------------------------------------------------------------------------------- plan order


_NEAR = 60  # maximum number of axes on closed chains for which bounds are found: time grows with its square


Bar = tuple[int, int, float]
"""Required distance: indices of two axes, and the distance [mm]."""


class DistanceBound(NamedTuple):
    """Minimum and maximum distance of an axis from a placed axis [mm], and the index of the placed axis."""

    axis: int
    minimum: float
    most: float


@dataclass(frozen=True)
class PlanStep:
    """Step of the search for a plan: the axis to be placed, and the bounds on its distances from placed axes."""

    axis: int
    placed: Indices
    tied: tuple[DistanceBound, ...]
    """Placed axes whose distance from the axis to be placed is prescribed."""
    bounds: tuple[DistanceBound, ...]
    """Placed axes to which the axis must be connected later by a chain of axes that are not placed yet."""


class PlanOrder:
    """Order in which the axes are placed in the plan, with their distances regarded as bars between joints.

    index    index of each axis
    radius   radius of the widest wheel of each axis [mm]
    bars     all required distances
    pivot    axis of the carrier of each carried axis
    alike    for an axis with only one bar, to the axis of its carrier: all such axes with a bar of equal length
    rotated  for an axis in a repeated group of planets: the same axis in the first group, and the angle between the
             groups about the axis of the carrier [turns]
    steps    axes in the order in which they are placed
    """

    def __init__(self, problem: PlanProblem) -> None:
        self.index = {label: at for at, label in enumerate(problem.labels)}
        self.radius = np.array([problem.radius(label) for label in problem.labels])
        self.bars = [(self.index[a], self.index[b], length) for (a, b), length in problem.distances.items()]
        self._joined: list[dict[int, float]] = [{} for _ in problem.labels]
        for a, b, length in self.bars:
            self._joined[a][b] = self._joined[b][a] = length
        self.pivot = {self.index[a]: self.index[b] for a, b in problem.pivots.items() if b in self.index}
        fixed = {self.index[label] for label in problem.fixed}
        groups = list(self._find_alike(fixed))
        self.alike = {each[0]: tuple(at for (at,) in equal) for equal in groups for each in equal if len(each) == 1}
        self.rotated = {
            at: (first, number / len(equal))
            for equal in groups
            for number, each in enumerate(equal)
            for at, first in zip(each, equal[0], strict=True)
            if number and len(each) > 1
        }
        self.steps = self._find_steps(fixed)

    def _find_alike(self, fixed: set[int]) -> Iterable[Sequence[Sequence[int]]]:
        """Return lists of groups of carried axes with equal wheels and distances, connected only to the carrier."""
        carried = [at for at in self.pivot if at not in fixed]
        bars = [bar[:2] for bar in self.bars if self.pivot.get(bar[0]) != bar[1] and self.pivot.get(bar[1]) != bar[0]]
        alike: dict[tuple[object, ...], list[list[int]]] = {}
        for group in joined_groups(sorted(carried), bars):
            pivot = self.pivot[group[0]]
            ends = {end for at in group for end in self._joined[at]}
            if pivot in ends and ends <= {pivot, *group} and all(self.pivot[at] == pivot for at in group):
                alike.setdefault((pivot, *self._shape(group, pivot)), []).append(group)
        return alike.values()

    def _shape(self, group: Sequence[int], pivot: int) -> Iterator[tuple[float, ...]]:
        """Yield the rounded radius of each axis of a group and its distances to the group and to the pivot [mm]."""
        for at in group:
            joined = self._joined[at]
            yield (round(float(self.radius[at]), 9), *(round(joined.get(end, -1.0), 9) for end in (*group, pivot)))

    def _find_steps(self, placed: set[int]) -> list[PlanStep]:
        order, found = sorted(placed), []
        # axes on closed chains: the 2-core of the graph of bars, in which all placed axes are one node
        closing = set(range(len(self._joined)))
        while ends := {at for at in closing - placed if len(self._joined[at].keys() & closing) < 2}:
            closing -= ends
        if len(closing) > _NEAR:
            closing = set()
        while len(order) < len(self._joined):
            at = min((at for at in range(len(self._joined)) if at not in placed), key=lambda at: self._rank(at, placed))
            tied = tuple(
                DistanceBound(other, length, length) for other, length in self._joined[at].items() if other in placed
            )
            bounds = tuple(self._bounds(at, placed, closing)) if at in closing else ()
            found.append(PlanStep(at, np.array(order, np.intp), tied, bounds))
            placed.add(at)
            order.append(at)
        return found

    def _rank(self, at: int, placed: set[int]) -> tuple[bool, int, float]:
        """Return an axis's sort key: after its carrier, by number of placed neighbours, then by radius or bars."""
        late = at in self.pivot and self.pivot[at] not in placed
        tied = len(self._joined[at].keys() & placed)
        weight = float(self.radius[at]) if tied else float(len(self._joined[at]))
        # rounded, so that equal radii keep the order declared
        return late, -tied, -round(weight, 9)

    def _bounds(self, at: int, placed: set[int], closing: set[int]) -> list[DistanceBound]:
        """Return bounds on the distances of an axis from placed axes to which a chain of axes will connect it.

        closing   axes in closed chains, through which the chain may lead
        """
        ways: list[tuple[float, float, int]] = [(0.0, 0.0, at)]  # (length, longest bar, end)
        done: set[int] = set()
        found: list[DistanceBound] = []
        while ways:
            length, longest, here = heappop(ways)
            if here in done:
                continue
            done.add(here)
            if here in placed:
                if here not in self._joined[at]:
                    # polygon inequality: the longest bar minus all other bars is 2 longest - length
                    found.append(DistanceBound(here, max(0.0, 2 * longest - length), length))
                continue
            for other, bar in self._joined[here].items():
                if other in closing and (here != at or other not in placed):
                    heappush(ways, (length + bar, max(longest, bar), other))
        return found


# ---------------------------------------------------------------------------------------------------------- plan search


_TOUCH = 1e-10  # relative error below which a distance is satisfied
_MOST = 400  # maximum number of points for a dense matrix
_DIRECTIONS = 48  # candidates on a circle
_BEAM = ((60, 12), (200, 4))  # (maximum number of axes, width of the beam)
_MISS = 1e4  # cost per mm of error of a distance
_FAR = 0.15  # cost per mm from the middle of the placed axes
_SIDE = 0.3  # gain per mm towards the side of a crossing wheel
_ROW = 1.2  # default distance between two axes on a line divided by the sum of their radii


def crossings(a: Sequence[float], radius: float, b: Sequence[float], other: float) -> list[Point]:
    """Return the intersections of a circle about `a` with the radius r (`radius`) and one about `b` with s (`other`).

    For circles that do not intersect, the result is the point on the line of centres midway between them; it is empty
    for concentric circles. With the distance d of the centres, the intersections are at x = (d^2 + r^2 - s^2) / 2d
    along the line of centres and at sqrt(r^2 - x^2) on either side of it.
    """
    apart = hypot(b[0] - a[0], b[1] - a[1])
    if apart < 1e-12 * (radius + other):
        return []
    along = (apart * apart + radius * radius - other * other) / (2 * apart)
    square = radius * radius - along * along
    if square < -1e-9 * radius * radius:
        # no intersection: the point equidistant from both circles
        side, back = (-1 if other > apart + radius else 1), (1 if radius > apart + other else -1)
        along, square = (apart + back * other + side * radius) / 2, 0.0
    high = max(square, 0.0) ** 0.5  # for tangent circles rounding errors may make it negative
    u, v = (b[0] - a[0]) / apart, (b[1] - a[1]) / apart
    x, y = a[0] + along * u, a[1] + along * v
    return [(x - high * v, y + high * u), (x + high * v, y - high * u)] if high else [(x, y)]


def line_crossings(point: Point, way: Point, centre: Sequence[float], radius: float) -> list[Point]:
    """Return the two intersections of a circle with a line, which is given by a point and the unit vector `way`.

    If they do not intersect, the result contains twice the point of the line that is nearest to the centre.
    """
    u, v = centre[0] - point[0], centre[1] - point[1]
    middle = u * way[0] + v * way[1]
    square = radius * radius - (u * u + v * v - middle * middle)
    half = max(square, 0.0) ** 0.5
    return [
        (point[0] + (middle + side * half) * way[0], point[1] + (middle + side * half) * way[1]) for side in (1, -1)
    ]


def fit_distances(points: Floats, bars: Sequence[Bar], fixed: Iterable[int]) -> Floats:
    """Return the points that minimise the sum of the squared errors of the required distances, shape (n, 2).

    The search starts at `points`. The `fixed` points do not move. If there are more than 400 points, they are returned
    unchanged.
    """
    free = np.setdiff1d(np.arange(len(points)), list(fixed))
    if not bars or not len(free) or len(points) > _MOST:
        return points
    first, second, lengths = (np.array(column) for column in zip(*bars, strict=True))

    def fitted(moved: Floats) -> Floats:
        found = points.copy()
        found[free] = moved.reshape(-1, 2)
        return found

    def misses(moved: Floats) -> Floats:
        found = fitted(moved)
        return np.asarray(np.hypot(*(found[second] - found[first]).T) - lengths)

    start = points[free].ravel()
    # a distance of 0 defines no scale
    if np.all(np.abs(misses(start)) <= _TOUCH * np.maximum(lengths, 1e-9)):
        return points
    from scipy.optimize import least_squares

    # to rounding accuracy, because pitch circles with larger gaps are reported as notices
    return fitted(least_squares(misses, start, xtol=1e-15, ftol=1e-15, gtol=1e-15).x)


def plan_axes(problem: PlanProblem) -> dict[str, Point]:
    """Return points in the plan of all axes [mm], at the required distances or fitted to them; deterministic."""
    return _BeamSearch(problem).found()


class _BeamSearch:
    def __init__(self, problem: PlanProblem) -> None:
        self.problem = problem
        self.order = PlanOrder(problem)
        self.clearance = PlanClearance(problem)
        self.width = next((wide for most, wide in _BEAM if len(problem.labels) <= most), 1)

    def found(self) -> dict[str, Point]:
        """Return the points of the axes [mm] in the plan with the lowest cost, by label."""
        problem, index = self.problem, self.order.index
        points = np.zeros((len(problem.labels), 2))
        for label, point in problem.fixed.items():
            points[index[label]] = point
        plans = [(0.0, points)]  # cost, and points of the placed axes
        for step in self.order.steps:
            options = [
                (round(before + cost, 9), points, place)
                for before, points in plans
                for cost, place in self._options(step, points)
            ]
            plans = []
            for cost, points, place in sorted(options, key=lambda option: option[0])[: self.width]:
                extended = points.copy()
                extended[step.axis] = place
                plans.append((cost, extended))
        fitted = fit_distances(plans[0][1], self.order.bars, [index[label] for label in problem.fixed])
        return {label: (float(fitted[at, 0]), float(fitted[at, 1])) for label, at in index.items()}

    def _options(self, step: PlanStep, points: Floats) -> list[tuple[float, Floats]]:
        """Return the best positions of the axis of a step in one partial plan, each with its cost."""
        candidates = self._candidates(step, points)
        costs = np.zeros(len(candidates))
        for bound in (*step.tied, *step.bounds):  # distances that the position violates or makes impossible
            apart = candidates - points[bound.axis]
            far = np.hypot(apart[:, 0], apart[:, 1])
            costs += _MISS * (np.maximum(far - bound.most, 0) + np.maximum(bound.minimum - far, 0))
        costs += self.clearance.cost(step.axis, step.placed, candidates, points)
        if len(step.placed):
            apart = candidates - points[step.placed].mean(axis=0)
            costs += _FAR * np.hypot(apart[:, 0], apart[:, 1])
            costs -= _SIDE * apart @ np.array(self.problem.sides.get(self.problem.labels[step.axis], (0.0, 0.0)))
        # rounded and stable, so that ties are broken alike on every machine
        best = np.argsort(costs.round(9), kind="stable")[: self.width].tolist()
        return [(float(costs[at]), candidates[at]) for at in best]

    def _candidates(self, step: PlanStep, points: Floats) -> Floats:
        """Return candidate positions of the axis of a step [mm], shape (n, 2)."""
        row = self._in_row(step, points)
        if row:
            return np.array(row)
        rotated = self._rotated(step, points)
        if rotated:
            return np.array(rotated)
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
        """Return candidate points for an axis that meets a crossing axis with a placed axis; empty for others."""
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

    def _rotated(self, step: PlanStep, points: Floats) -> list[Point]:
        """Return the position of an axis in a repeated group of planets as a list with one point, rotated from the
        first group; an empty list if the axis is not in such a group or the first group is not placed.
        """
        first, turn = self.order.rotated.get(step.axis, (None, 0.0))
        placed = set(step.placed.tolist())
        if first not in placed or self.order.pivot[step.axis] not in placed:
            return []
        x, y = points[self.order.pivot[step.axis]].tolist()
        u, v = (points[first] - (x, y)).tolist()
        c, s = cos(2 * pi * turn), sin(2 * pi * turn)
        return [(x + c * u - s * v, y + s * u + c * v)]

    def _outside(self, step: PlanStep, points: Floats) -> list[Point]:
        """Return points in eight directions outside all placed axes; return the origin if no axis is placed."""
        if not len(step.placed):
            return [(0.0, 0.0)]
        radius = self.order.radius
        middle = points[step.placed].mean(axis=0)
        apart = points[step.placed] - middle
        far = float(np.max(np.hypot(apart[:, 0], apart[:, 1]) + radius[step.placed])) + 1.1 * float(radius[step.axis])
        x, y = middle.tolist()
        return [(x + far * cos(pi * at / 4), y + far * sin(pi * at / 4)) for at in range(8)]

    def _round_first(self, step: PlanStep, points: Floats) -> list[Point]:
        """Return points on the circle about the first placed axis at a prescribed distance, in all directions.

        Planets have only the positions in which they can be assembled. Equal planets on a carrier are evenly spaced.
        """
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
        for bound in step.bounds:  # feasible arcs may be narrower than the spacing of directions
            found += crossings((x, y), far, points[bound.axis].tolist(), (bound.minimum + bound.most) / 2)
        return found
