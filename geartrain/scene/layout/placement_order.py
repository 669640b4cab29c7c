"""The order in which axes are put in, and what the axes still to come ask of their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Indices


DistanceBound = tuple[int, float, float]
"""An axis, and the least and greatest distance from it."""

_NEAR = 60  # axes up to which chains that must close again are followed


@dataclass(frozen=True)
class PlacementStep:
    """An axis to be put in.

    placed  those that stand by then
    tied    those of them at a given distance
    bounds  those to which a chain of axes still to come must reach
    """

    at: int
    placed: Indices
    tied: tuple[DistanceBound, ...]
    bounds: tuple[DistanceBound, ...]


class PlacementOrder:
    """Axes as joints of bars; `steps` puts them in, those first that most bars tie down."""

    def __init__(
        self,
        labels: Sequence[str],
        distances: Mapping[tuple[str, str], float],
        fixed: Mapping[str, object],
        pivots: Mapping[str, str],
        radius: Mapping[str, float],
    ) -> None:
        self.index = {label: at for at, label in enumerate(labels)}
        self.radius = np.array([radius[label] for label in labels])
        self.edges = [
            (self.index[a], self.index[b], far)
            for (a, b), far in distances.items()
            if a in self.index and b in self.index
        ]
        self.bars: list[dict[int, float]] = [{} for _ in labels]
        for a, b, far in self.edges:
            self.bars[a][b] = self.bars[b][a] = far
        self.pivot = {self.index[a]: self.index[b] for a, b in pivots.items() if a in self.index and b in self.index}
        self.brothers = self._brothers(set(fixed))
        self.steps = list(self._order({self.index[label] for label in fixed}))

    def _brothers(self, fixed: set[str]) -> dict[int, tuple[int, ...]]:
        """Axes alike on one carrier: they hang by one bar of one length on the carrier's own axis."""
        alike: dict[tuple[int, float, float], list[int]] = {}
        names = list(self.index)
        for at, bars in enumerate(self.bars):
            if len(bars) == 1 and self.pivot.get(at) in bars and names[at] not in fixed:
                (pivot, far), *_ = bars.items()
                alike.setdefault((pivot, round(far, 9), round(float(self.radius[at]), 9)), []).append(at)
        return {at: tuple(group) for group in alike.values() for at in group}

    def _order(self, placed: set[int]) -> list[PlacementStep]:
        order = sorted(placed)
        count = [len(self.bars[at].keys() & placed) for at in range(len(self.bars))]
        closing = self._closing(placed)
        carried: dict[int, list[int]] = {}
        for at, pivot in self.pivot.items():
            carried.setdefault(pivot, []).append(at)
        waiting = [(self._rank(at, count[at], placed), at) for at in range(len(self.bars)) if at not in placed]
        heapify(waiting)
        found = []
        while waiting:
            rank, at = heappop(waiting)
            if at in placed or rank != self._rank(at, count[at], placed):
                continue  # it has been put in, or waits with another rank too
            tied = tuple((other, far, far) for other, far in self.bars[at].items() if other in placed)
            bounds = tuple(self._bounds(at, placed, closing)) if at in closing else ()
            found.append((at, len(order), tied, bounds))
            placed.add(at)
            order.append(at)
            for other in self.bars[at]:
                count[other] += 1
            for other in {*self.bars[at], *carried.get(at, ())} - placed:
                heappush(waiting, (self._rank(other, count[other], placed), other))
        stand = np.array(order, np.intp)
        return [PlacementStep(at, stand[:known], tied, bounds) for at, known, tied, bounds in found]

    def _rank(self, at: int, tied: int, placed: set[int]) -> tuple[bool, int, float, int]:
        late = at in self.pivot and self.pivot[at] not in placed
        weight = float(self.radius[at]) if tied else float(len(self.bars[at]))
        return late, -tied, -round(weight, 9), at

    def _closing(self, placed: set[int]) -> set[int]:
        """Axes on closed chains: what is left when loose ends are taken off, all that stands counting as one."""
        left = set(range(len(self.bars)))
        count = [len(bars) for bars in self.bars]
        ends = [at for at in left if at not in placed and count[at] < 2]
        while ends:
            at = ends.pop()
            left.discard(at)
            for other in self.bars[at]:
                count[other] -= 1
                if count[other] == 1 and other in left and other not in placed:
                    ends.append(other)
        return left if len(left) <= _NEAR else set()

    def _bounds(self, at: int, placed: set[int], closing: set[int]) -> list[DistanceBound]:
        """Shortest ways to axes that stand, over axes to come: their length, and how far their longest bar outruns
        the rest."""
        ways: list[tuple[float, float, int]] = [(0.0, 0.0, at)]
        done: set[int] = set()
        found: list[DistanceBound] = []
        while ways:
            length, longest, here = heappop(ways)
            if here in done:
                continue
            done.add(here)
            if here in placed:
                if here not in self.bars[at]:
                    found.append((here, max(0.0, 2 * longest - length), length))
                continue
            for other, far in self.bars[here].items():
                if other in closing and (here != at or other not in placed):
                    heappush(ways, (length + far, max(longest, far), other))
        return found
