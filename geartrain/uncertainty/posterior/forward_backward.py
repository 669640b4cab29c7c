"""Sums over all combinations of a decomposed part: evidence, posteriors, products of counts; and the best ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from heapq import heappop, heappush
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.join.product_lists import Floats, Ints
from geartrain.uncertainty.posterior.priors import ToothCountPrior
from geartrain.uncertainty.posterior.variable_elimination import EliminationPart

Weights = NDArray[Any]
"""Whole numbers, int64 where all sums fit and Python's otherwise; or float64 where agreement is a matter of degree."""

_LONG = 1 << 62


class ForwardBackwardSums:
    """Weights of all paths through a part.

    doubts   wheel -> counts and weights
    soft     True: a path's weight is its prior weight times exp(-misfit / 2)
    """

    def __init__(self, part: EliminationPart, doubts: Mapping[str, ToothCountPrior], soft: bool) -> None:
        self.part, self.soft = part, soft
        self.doubts = [doubts[step.wheel] for step in part.steps]
        self.total = 1
        for doubt in self.doubts:
            self.total *= doubt.total
        self._dtype: Any = np.float64 if soft else np.int64 if self.total < _LONG else object
        self._scale = [float(doubt.total) if soft else 1 for doubt in self.doubts]

    @cached_property
    def evidence(self) -> Any:
        """The weight of all that fits, of `total`; a share of 1 where agreement is a matter of degree."""
        ends = self._forward[-1]
        return plain_number(ends.sum()) if len(ends) else 0

    @cached_property
    def posteriors(self) -> dict[str, list[Any]]:
        """Wheel -> the weight of all that fits with each of its counts; they sum to `evidence`."""
        found = {}
        for at, (step, doubt) in enumerate(zip(self.part.steps, self.doubts, strict=True)):
            flow = self._flow(at)
            found[doubt.wheel] = [
                plain_number(flow[step.choices == choice].sum()) for choice in range(len(doubt.counts))
            ]
        return found

    @cached_property
    def covariances(self) -> dict[tuple[str, str], float]:
        """The posterior covariance of two wheels' counts, to rounding: counts are taken from their means on."""
        found: dict[tuple[str, str], float] = {}
        if not self.evidence:
            return found
        means = self._means()
        for first in range(len(self.part.steps)):
            carried: Floats | None = None
            for at in range(first, len(self.part.steps)):
                step, doubt = self.part.steps[at], self.doubts[at]
                size = (np.array(doubt.counts, dtype=np.float64) - means[doubt.wheel])[step.choices]
                own = self._shares(at)
                if carried is None:
                    carried = self._gathered(at, self._heads[at][step.parents] * own * size)
                    continue
                into = carried[step.parents] * own
                after = self._tails[at + 1][step.children]
                found[self.doubts[first].wheel, doubt.wheel] = float((into * size * after).sum() / self._tails[0][0])
                carried = self._gathered(at, into)
        return found

    def _means(self) -> dict[str, float]:
        """Posterior mean of every wheel's count."""
        found = {}
        for doubt in self.doubts:
            pairs = zip(doubt.counts, self.posteriors[doubt.wheel], strict=True)
            found[doubt.wheel] = float(sum(count * weight for count, weight in pairs) / self.evidence)
        return found

    def _weights(self, at: int) -> Weights:
        """What each transition multiplies."""
        step, doubt = self.part.steps[at], self.doubts[at]
        if not self.soft:
            return np.array(doubt.weights, dtype=self._dtype)[step.choices]
        own = np.array(doubt.weights, dtype=np.float64)[step.choices] / self._scale[at]
        return own if step.misfit is None else own * np.exp(-step.misfit / 2)

    def _shares(self, at: int) -> Floats:
        """The same as chances, in float64."""
        step, doubt = self.part.steps[at], self.doubts[at]
        own = np.array([float(prior) for prior in doubt.priors])[step.choices]
        return own if step.misfit is None or not self.soft else own * np.exp(-step.misfit / 2)

    def _flow(self, at: int) -> Weights:
        """The weight of all paths through each transition."""
        step = self.part.steps[at]
        found: Weights = self._forward[at][step.parents] * self._weights(at) * self._backward[at + 1][step.children]
        return found

    @cached_property
    def _forward(self) -> list[Weights]:
        rows: list[Weights] = [np.ones(1, dtype=self._dtype)]
        for at, step in enumerate(self.part.steps):
            rows.append(_summed(step.children, rows[-1][step.parents] * self._weights(at), step.size))
        return rows

    @cached_property
    def _backward(self) -> list[Weights]:
        ends = self.part.steps[-1].size
        rows: list[Weights] = [np.ones(ends, dtype=self._dtype)]
        for at in range(len(self.part.steps) - 1, -1, -1):
            step = self.part.steps[at]
            before = self.part.steps[at - 1].size if at else 1
            rows.append(_summed(step.parents, self._weights(at) * rows[-1][step.children], before))
        return rows[::-1]

    @cached_property
    def _heads(self) -> list[Floats]:
        """Chances of all ways to each row."""
        rows = [np.ones(1)]
        for at, step in enumerate(self.part.steps):
            rows.append(self._gathered(at, rows[-1][step.parents] * self._shares(at)))
        return rows

    @cached_property
    def _tails(self) -> list[Floats]:
        """Chances of all ways from each row on."""
        rows = [np.ones(self.part.steps[-1].size)]
        for at in range(len(self.part.steps) - 1, -1, -1):
            step, before = self.part.steps[at], self.part.steps[at - 1].size if at else 1
            flow = self._shares(at) * rows[-1][step.children]
            rows.append(_counted(step.parents, flow, before))
        return rows[::-1]

    def _gathered(self, at: int, values: Floats) -> Floats:
        step = self.part.steps[at]
        return _counted(step.children, values, step.size)


def plain_number(value: Any) -> int | float:
    """A sum as Python's own number, which does not overflow."""
    return float(value) if isinstance(value, float | np.floating) else int(value)


def _counted(owners: Ints, values: Floats, size: int) -> Floats:
    """Floats added up by owner."""
    return np.asarray(np.bincount(owners, values, minlength=size), dtype=np.float64)


def _summed(owners: Ints, values: Weights, size: int) -> Weights:
    """Values added up by owner; whole numbers stay exact."""
    found: Weights = np.zeros(size, dtype=values.dtype)
    if not len(owners):
        return found
    order = np.argsort(owners, kind="stable")
    sorted_ = owners[order]
    first = np.flatnonzero(np.concatenate([[True], sorted_[1:] != sorted_[:-1]]))
    found[sorted_[first]] = np.add.reduceat(values[order], first)
    return found


@dataclass(frozen=True, slots=True)
class CombinationCandidate:
    """One combination of a part's counts, and its misfit to rounding."""

    misfit: float
    teeth: Mapping[str, int]


class BestCombinations:
    """The combinations of a part that agree best, best first: a search along the paths that knows what is to come."""

    def __init__(self, part: EliminationPart, doubts: Mapping[str, ToothCountPrior]) -> None:
        self.steps = part.steps
        self.counts = [doubts[step.wheel].counts for step in part.steps]
        self._ahead = self._bounds()

    def __iter__(self) -> Iterator[CombinationCandidate]:
        heap: list[tuple[float, int, int, float, tuple[int, ...]]] = []
        if len(self._ahead[0]) and np.isfinite(self._ahead[0][0]):
            heappush(heap, (float(self._ahead[0][0]), 0, 0, 0.0, ()))
        while heap:
            bound, depth, row, spent, taken = heappop(heap)
            if -depth == len(self.steps):
                yield CombinationCandidate(spent, dict(self._named(taken)))
                continue
            for choice, child, misfit in self._onward(-depth, row):
                ahead = spent + misfit + float(self._ahead[-depth + 1][child])
                heappush(heap, (max(ahead, bound), depth - 1, child, spent + misfit, (*taken, choice)))

    def _named(self, taken: Sequence[int]) -> Iterator[tuple[str, int]]:
        for step, counts, choice in zip(self.steps, self.counts, taken, strict=True):
            yield step.wheel, counts[choice]

    def _onward(self, at: int, row: int) -> Iterator[tuple[int, int, float]]:
        step = self.steps[at]
        first, last = np.searchsorted(step.parents, [row, row + 1])
        for here in range(int(first), int(last)):
            misfit = 0.0 if step.misfit is None else float(step.misfit[here])
            yield int(step.choices[here]), int(step.children[here]), misfit

    def _bounds(self) -> list[Floats]:
        """The least misfit to come after each row."""
        rows = [np.zeros(self.steps[-1].size)]
        for at in range(len(self.steps) - 1, -1, -1):
            step = self.steps[at]
            found = np.full(self.steps[at - 1].size if at else 1, np.inf)
            own = rows[-1][step.children] + (0.0 if step.misfit is None else step.misfit)
            np.minimum.at(found, step.parents, own)
            rows.append(found)
        return rows[::-1]
