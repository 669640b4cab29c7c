"""The order in which axes are put into a plan, and what the axes still to come ask of their places.

Greedy, those first that most distances tie down, from a priority queue. An axis of a closed chain of distances must
stay near enough to those that stand for the rest of the chain to reach: Dijkstra's shortest ways give those bounds.
"""

from __future__ import annotations

from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.scene.layout.plan_problem import PlanProblem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Indices

_NEAR = 60  # axes on closed chains up to which chains are followed: that takes time with their square


class Bar(NamedTuple):
    """Two axes by number, and their distance (mm)."""

    first: int
    second: int
    length: float


class DistanceBound(NamedTuple):
    """An axis by number, and the least and greatest distance (mm) from it."""

    axis: int
    least: float
    most: float


class _Rank(NamedTuple):
    """The least is put in first: not before its carrier's axis, most tied, then largest, or with most bars.

    The two numbers are negative, so that the greatest comes first.
    """

    before_pivot: bool
    minus_tied: int
    minus_weight: float
    axis: int


@dataclass(frozen=True)
class PlanStep:
    """An axis, by number, to be put in.

    placed  those that stand by then
    tied    those of them at a given distance
    bounds  those to which a chain of axes still to come must reach
    """

    axis: int
    placed: Indices
    tied: tuple[DistanceBound, ...]
    bounds: tuple[DistanceBound, ...]


class PlanOrder:
    """Axes as joints of bars, by number.

    index      number of each axis; radius, the room each needs (mm)
    bars       all distances
    alike      axis -> all that are alike on its carrier, itself among them: one bar of one length to the carrier's axis
    steps      axes in the order in which they are put in
    """

    def __init__(self, problem: PlanProblem) -> None:
        self.index = {label: at for at, label in enumerate(problem.labels)}
        self.radius = np.array([problem.radius(label) for label in problem.labels])
        self.bars = [Bar(self.index[a], self.index[b], length) for (a, b), length in problem.distances.items()]
        self._joined: list[dict[int, float]] = [{} for _ in problem.labels]
        for a, b, length in self.bars:
            self._joined[a][b] = self._joined[b][a] = length
        self._pivot = {self.index[a]: self.index[b] for a, b in problem.pivots.items() if b in self.index}
        fixed = {self.index[label] for label in problem.fixed}
        self.alike = self._find_alike(fixed)
        self.steps = self._find_steps(fixed)

    def _find_alike(self, fixed: set[int]) -> dict[int, tuple[int, ...]]:
        alike: dict[tuple[int, float, float], list[int]] = {}
        for at, joined in enumerate(self._joined):
            if len(joined) == 1 and self._pivot.get(at) in joined and at not in fixed:
                (pivot, length), *_ = joined.items()
                # rounded: lengths that are equal but for rounding are alike
                alike.setdefault((pivot, round(length, 9), round(float(self.radius[at]), 9)), []).append(at)
        return {at: tuple(group) for group in alike.values() for at in group}

    def _find_steps(self, placed: set[int]) -> list[PlanStep]:
        order = sorted(placed)
        count = [len(joined.keys() & placed) for joined in self._joined]
        closing = self._on_closed_chains(placed)
        carried: dict[int, list[int]] = {}
        for at, pivot in self._pivot.items():
            carried.setdefault(pivot, []).append(at)
        waiting = [self._rank(at, count[at], placed) for at in range(len(self._joined)) if at not in placed]
        heapify(waiting)
        found = []
        while waiting:
            rank = heappop(waiting)
            at = rank.axis
            if at in placed or rank != self._rank(at, count[at], placed):
                continue  # it has been put in, or waits with another rank too
            tied = tuple(
                DistanceBound(other, length, length) for other, length in self._joined[at].items() if other in placed
            )
            bounds = tuple(self._bounds(at, placed, closing)) if at in closing else ()
            found.append((at, len(order), tied, bounds))
            placed.add(at)
            order.append(at)
            for other in self._joined[at]:
                count[other] += 1
            for other in {*self._joined[at], *carried.get(at, ())} - placed:
                heappush(waiting, self._rank(other, count[other], placed))
        stand = np.array(order, np.intp)  # each step sees a part of one array: no copy a step
        return [PlanStep(at, stand[:known], tied, bounds) for at, known, tied, bounds in found]

    def _rank(self, at: int, tied: int, placed: set[int]) -> _Rank:
        late = at in self._pivot and self._pivot[at] not in placed
        weight = float(self.radius[at]) if tied else float(len(self._joined[at]))
        # rounded, so that radii equal but for rounding stand in the order declared
        return _Rank(late, -tied, -round(weight, 9), at)

    def _on_closed_chains(self, placed: set[int]) -> set[int]:
        """What is left when loose ends are taken off, all that stands counting as one; none of them if too many."""
        left = set(range(len(self._joined)))
        count = [len(joined) for joined in self._joined]
        ends = [at for at in left if at not in placed and count[at] < 2]
        while ends:
            at = ends.pop()
            left.discard(at)
            for other in self._joined[at]:
                count[other] -= 1
                if count[other] == 1 and other in left and other not in placed:
                    ends.append(other)
        return left if len(left) <= _NEAR else set()

    def _bounds(self, at: int, placed: set[int], closing: set[int]) -> list[DistanceBound]:
        """Bounds from the shortest ways to axes that stand, over axes to come.

        A chain of bars reaches as far as its length, and no nearer than its longest bar outruns the rest.
        """
        ways: list[tuple[float, float, int]] = [(0.0, 0.0, at)]  # length, longest bar, end
        done: set[int] = set()
        found: list[DistanceBound] = []
        while ways:
            length, longest, here = heappop(ways)
            if here in done:
                continue
            done.add(here)
            if here in placed:
                if here not in self._joined[at]:
                    found.append(DistanceBound(here, max(0.0, 2 * longest - length), length))
                continue
            for other, bar in self._joined[here].items():
                if other in closing and (here != at or other not in placed):
                    heappush(ways, (length + bar, max(longest, bar), other))
        return found
