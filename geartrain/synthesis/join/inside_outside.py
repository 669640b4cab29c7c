"""Sums over all assignments of a recorded join: their weight, and that of those with each count of each wheel.

They are inside and outside sums over tables of `numerics.weighted_alternatives`; whole numbers stay exact. All sums are
linear in the weights of each wheel, which may have either sign: with weights w(z) (z - mean) of one wheel in place of
w(z), the sums of the others are their covariances with it.

The best assignments, best first, by a search along the tree that knows the least that is to come (A*).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from typing import Any

import numpy as np

from geartrain.numerics.arrays import Floats
from geartrain.numerics.weighted_alternatives import AlternativeRows, WeightedAlternatives
from geartrain.synthesis.join.product_lists import ProductStep, Tallies
from geartrain.synthesis.join.recorded_join import CountWeights, RecordedItem, RecordedNode

_Table = RecordedNode | RecordedItem | ProductStep


class AssignmentSums:
    """Sums over the assignments of a recorded join.

    graded   True: the weight of an assignment, the product of the weights of its counts, is multiplied by
             exp(-misfit / 2)
    """

    def __init__(self, root: RecordedNode, graded: bool) -> None:
        self.root, self.graded = root, graded

    def total(self, weights: CountWeights) -> Any:
        """The weight of all assignments."""
        return self._sums(weights).total.sum()

    def marginals(self, weights: CountWeights) -> dict[str, Tallies]:
        """Wheel -> the weight of all assignments with each of its counts."""
        return {str(wheel): sums for wheel, sums in self._sums(weights).marginals.items()}

    def _sums(self, weights: CountWeights) -> WeightedAlternatives[_Table]:
        return WeightedAlternatives(self.root, lambda table: iter([self._alternatives(table, weights)]))

    def _alternatives(self, table: _Table, weights: CountWeights) -> AlternativeRows[_Table]:
        """A row goes on with a value of its item and a row of each child; a value, and a product, by how it is made."""
        if isinstance(table, RecordedNode):
            grade = 1 if not self.graded or table.misfit is None else np.exp(-table.misfit / 2)
            return AlternativeRows(grade, table.size, table.parents, ((table.values, table.places), *table.children))
        if isinstance(table, RecordedItem):
            return AlternativeRows(1, table.size, None, tuple(table.sides))
        own = weights[table.wheel]
        told = ((table.wheel, len(own), table.choices),)
        before = () if table.before is None else ((table.before, table.parents),)
        return AlternativeRows(own[table.choices], table.size, table.children, before, told)

    def covariances(self, weights: CountWeights, counts: Mapping[str, Sequence[int]]) -> dict[tuple[str, str], float]:
        """The covariance of the counts of every two wheels, in the order of `counts`, to rounding.

        weights   float64, none negative
        """
        total, marginals = float(self.total(weights)), self.marginals(weights)
        wheels = [wheel for wheel in counts if wheel in marginals]
        steps, found = {}, {}
        for wheel in wheels:
            sizes = np.array(counts[wheel], dtype=np.float64)
            # about the mean: E[xy] - E[x] E[y] would lose the digits of a small covariance
            steps[wheel] = sizes - float((marginals[wheel] * sizes).sum()) / total
        for at, first in enumerate(wheels):
            tilted = self.marginals({**weights, first: weights[first] * steps[first]})
            for second in wheels[at + 1 :]:
                found[first, second] = float((tilted[second] * steps[second]).sum()) / total
        return found


@dataclass(frozen=True, slots=True)
class GradedAssignment:
    """An assignment and its misfit to rounding."""

    misfit: float
    teeth: Mapping[str, int]


class BestFirst:
    """The assignments of a recorded join that agree best, best first.

    counts   wheel -> its counts
    """

    def __init__(self, root: RecordedNode, counts: Mapping[str, Sequence[int]]) -> None:
        self._counts = counts
        self._nodes: list[RecordedNode] = []
        self._ahead: list[Floats] = []
        self._below: list[tuple[int, ...]] = []
        self._add(root)

    def _add(self, node: RecordedNode) -> int:
        """Number a node and all below, with the least misfit to come from each row on."""
        at = len(self._nodes)
        self._nodes.append(node)
        self._ahead.append(np.full(node.size, np.inf))
        self._below.append(())
        self._below[at] = tuple(self._add(child) for child, _ in node.children)
        least = np.zeros(len(node.parents)) if node.misfit is None else node.misfit.copy()
        for number, (_, to) in zip(self._below[at], node.children, strict=True):
            least += self._ahead[number][to]
        np.minimum.at(self._ahead[at], node.parents, least)
        return at

    def __iter__(self) -> Iterator[GradedAssignment]:
        """Rows to be gone on from are kept as (node, row), values set as (node, place)."""
        heap: list[tuple[float, int, float, tuple[tuple[int, int], ...], tuple[tuple[int, int], ...]]] = []
        if np.isfinite(self._ahead[0][0]):
            heappush(heap, (float(self._ahead[0][0]), 0, 0.0, ((0, 0),), ()))
        while heap:
            bound, depth, spent, agenda, taken = heappop(heap)
            if not agenda:
                yield from (GradedAssignment(spent, teeth) for teeth in self._teeth(taken))
                continue
            (number, row), *later = agenda
            node = self._nodes[number]
            first, last = np.searchsorted(node.parents, [row, row + 1])
            for at in range(int(first), int(last)):
                so_far = spent + (0.0 if node.misfit is None else float(node.misfit[at]))
                below = zip(self._below[number], node.children, strict=True)
                then = (*((child, int(to[at])) for child, (_, to) in below), *later)
                ahead = so_far + sum(float(self._ahead[one][its]) for one, its in then)
                # depth falls: of equal bounds the one farthest on comes first, and assignments are whole soon
                # rounding must not let a child come before its parent
                heappush(heap, (max(ahead, bound), depth - 1, so_far, then, (*taken, (number, int(node.places[at])))))

    def _teeth(self, taken: Sequence[tuple[int, int]]) -> Iterator[dict[str, int]]:
        """All assignments of wheels that make up some values."""
        if not taken:
            yield {}
            return
        (number, value), *others = taken
        for way in self._nodes[number].values.ways(value):
            named = {wheel: self._counts[wheel][index] for wheel, index in way.items()}
            yield from (named | more for more in self._teeth(others))
