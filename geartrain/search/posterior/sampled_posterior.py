"""A sample of combinations: what every output does in each, whether it fits, and what all of them come to.

The structure is solved once, as formulas; each combination then costs a few multiplications an output. Combinations are
taken in blocks that fit the processor's cache. Sums are plain data that add up: tasks of any size, in any order.
"""

from __future__ import annotations

import pickle
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.search.join.wheel_monomials import IntervalConstraint
from geartrain.search.posterior.inference_problem import InferenceProblem, ToothCountPrior
from geartrain.search.posterior.likelihood import (
    CombinationColumns,
    FormulaValues,
    MonomialColumns,
    OutputLikelihood,
    exact_constraint,
    find_monomials,
    find_product_plan,
)

BLOCK = 1 << 13
"""Combinations worked on at a time: 64 kB an array, so that a formula's columns stay in the processor's cache."""
_FEW = 0.5  # of the rows: where fewer are left, to copy them out costs less than to judge the others too


class LikelihoodBatch:
    """A question put to arrays of counts.

    every    True: the speeds of all outputs are to be had too
    wheels   those that matter to a witness or to whether the train turns, in the order declared; with `every`, those
             of all outputs
    """

    def __init__(self, question: InferenceProblem, every: bool = False) -> None:
        self.question = question
        functions = [IntervalConstraint(witness.name, witness.formula, ()) for witness in question.witnesses]
        functions += question.conditions
        if every:
            functions += [IntervalConstraint(name, formula, ()) for name, formula in question.outputs.items()]
        moved = {wheel for one in functions for wheel in one.function.wheels}
        self.wheels = tuple(wheel for wheel in question.doubts if wheel in moved)
        self.domains = {wheel: question.doubts[wheel].counts for wheel in self.wheels}
        self.monomials = find_monomials(functions, self.domains)
        # formulas of few wheels first: they cost least, and what they refuse the others need not judge
        ordered = sorted(question.witnesses, key=lambda one: len(one.formula.wheels))
        outputs = question.outputs.items() if every else ()
        self._values = {name: FormulaValues.of(f, self.monomials, self.domains) for name, f in outputs}
        self._judges = [
            OutputLikelihood(one, self.monomials, self.domains, question.soft, self._values.get(one.name))
            for one in ordered
        ]
        self._gates = [exact_constraint(one, self.monomials, self.domains) for one in question.conditions]
        values = [*self._values.values(), *(judge.value for judge in self._judges)]
        self._plan = find_product_plan(key for value in values for key in value.plan)

    def columns(self, counts: Mapping[str, Ints]) -> MonomialColumns:
        """Some combinations: wheel -> counts, of one length, for all `wheels`."""
        return CombinationColumns(self.monomials, counts, len(next(iter(counts.values()))) if counts else 1)

    def turns(self, rows: MonomialColumns) -> Bools:
        """With which combinations the train turns at all."""
        found: Bools = np.ones(rows.size, dtype=np.bool_)
        for gate in self._gates:
            found &= gate.holds(rows)
        return found

    def judged(self, rows: MonomialColumns) -> tuple[Bools, Floats]:
        """Which combinations fit, exactly, and their misfit, to rounding; infinite where they do not.

        What one output refuses is not shown to the next, as soon as that saves work.
        """
        alive, total = np.arange(rows.size), np.zeros(rows.size)
        some = rows
        met = self.turns(rows)
        for judge in self._judges:
            if np.count_nonzero(met) < _FEW * some.size:
                kept = np.flatnonzero(met)
                if not len(kept):
                    break
                alive, some, met = alive[kept], some.pick(kept), met[kept]
            own, off = judge.judge(some, self._plan)
            met &= own
            total[alive] += off
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        found[alive] = met
        return found, np.where(found, total, np.inf)

    def speeds(self, rows: MonomialColumns) -> dict[str, tuple[Floats, Floats]]:
        """Output -> speeds, and bounds on their errors."""
        return {name: value.bounded(rows, self._plan) for name, value in self._values.items()}


KEPT = 2000
"""Combinations that a task brings out to find the best; equals beyond are left out."""
TIE = 1 + 1e-9
"""Misfits in floats this near may be equal: which is less is decided later, exactly."""


class PosteriorTally:
    """Sums over combinations.

    looked    combinations
    turning   number of those with which the train turns
    weight    of those that fit: their number, or their degrees of agreement where that is asked for
    square    sum of squared degrees of agreement, for intervals
    by        for each wheel the weight of what fits with each of its counts
    sizes     sums of count x count', each from the wheel's `origin_of` on, weighted
    best      (misfit, indices of counts), best first
    ranked    False once equals had to be left out
    """

    def __init__(self, batch: LikelihoodBatch, most: int) -> None:
        self.batch, self.most = batch, most
        self.looked = self.turning = 0
        self.weight: Any = 0
        self.square = 0.0
        self.by: list[list[Any]] = [[0] * len(batch.domains[wheel]) for wheel in batch.wheels]
        self.sizes: Floats = np.zeros((len(batch.wheels), len(batch.wheels)))
        self.best: list[tuple[float, tuple[int, ...]]] = []
        self.ranked = True
        doubts = [batch.question.doubts[wheel] for wheel in batch.wheels]
        self._steps = [np.array(doubt.counts, dtype=np.float64) - origin_of(doubt) for doubt in doubts]

    def add(self, places: Mapping[str, Ints | int], misfit: Floats, weights: Any) -> None:
        """Rows that fit.

        places    wheel -> index of its count, one number for all rows or one for each
        misfit    of each row
        weights   of each row, whole numbers or floats
        """
        size = len(misfit)
        if not size:
            return
        at = [np.broadcast_to(places[wheel], (size,)) for wheel in self.batch.wheels]
        self.weight += plain_number(weights.sum())  # Python's own number: over many blocks int64 would not hold it
        self.square += float((weights.astype(np.float64) ** 2).sum())
        for sums, index in zip(self.by, at, strict=True):
            for choice in np.unique(index):
                sums[choice] += plain_number(weights[index == choice].sum())
        steps = np.array([own[index] for own, index in zip(self._steps, at, strict=True)])
        self.sizes += (steps * weights.astype(np.float64)) @ steps.T
        self._keep(misfit, at)

    def _keep(self, misfit: Floats, at: Sequence[Ints]) -> None:
        near = np.flatnonzero(misfit <= self._bar())
        order = near[np.argsort(misfit[near], kind="stable")[: KEPT + 1]]
        self.best += [(float(misfit[row]), tuple(int(index[row]) for index in at)) for row in order]
        self._trim()

    def _bar(self) -> float:
        return self.best[self.most - 1][0] * TIE if len(self.best) >= self.most else np.inf

    def _trim(self) -> None:
        self.best.sort()
        bar = self._bar()
        self.best = [one for one in self.best if one[0] <= bar]
        if len(self.best) > KEPT:
            self.ranked = False
            self.best = self.best[:KEPT]

    def join(self, other: Mapping[str, Any]) -> None:
        """Add what another tally came to."""
        self.looked += other["looked"]
        self.turning += other["turning"]
        self.weight += other["weight"]
        self.square += other["square"]
        self.by = [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(self.by, other["by"], strict=True)]
        self.sizes += np.array(other["sizes"]).reshape(self.sizes.shape)
        self.best += [(misfit, tuple(at)) for misfit, at in other["best"]]
        self.ranked &= other["ranked"]
        self._trim()

    def to_dict(self) -> dict[str, Any]:
        """Plain data, for `join`."""
        return {
            "looked": self.looked,
            "turning": self.turning,
            "weight": plain_number(self.weight),
            "square": self.square,
            "by": [[plain_number(value) for value in sums] for sums in self.by],
            "sizes": self.sizes.tolist(),
            "best": [[misfit, list(at)] for misfit, at in self.best],
            "ranked": self.ranked,
        }


def plain_number(value: Any) -> int | float:
    """A sum as Python's own number, which does not overflow."""
    return float(value) if isinstance(value, float | np.floating) else int(value)


def origin_of(doubt: ToothCountPrior) -> int:
    """The count from which the others are reckoned, so that sums of products keep their digits: the likeliest."""
    return doubt.counts[doubt.weights.index(max(doubt.weights))]


def packed(question: InferenceProblem, most: int) -> bytes:
    """What all tasks share, as a worker takes it."""
    return pickle.dumps((question, most))


@lru_cache(maxsize=1)
def _unpacked(shared: bytes) -> tuple[LikelihoodBatch, int]:
    question, most = pickle.loads(shared)
    return LikelihoodBatch(question), most


def sample_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """Combinations drawn by their prior chances: task is the seed, the number of the block, and how many."""
    batch, most = _unpacked(shared)
    tally = PosteriorTally(batch, most)
    seed, block, size = task
    # a stream for each block: what is drawn does not depend on how blocks are shared out
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, block])))
    places = {}
    for wheel in batch.wheels:
        chances = np.array([float(prior) for prior in batch.question.doubts[wheel].priors])
        places[wheel] = draw.choice(len(chances), size, p=chances / chances.sum())
    for start in range(0, size, BLOCK):
        here = {wheel: at[start : start + BLOCK] for wheel, at in places.items()}
        rows = batch.columns({wheel: np.array(batch.domains[wheel])[at] for wheel, at in here.items()})
        met, misfit = batch.judged(rows)
        tally.looked += rows.size
        tally.turning += int(batch.turns(rows).sum())
        fit = np.flatnonzero(met)
        weights = np.exp(-misfit[fit] / 2) if batch.question.soft else np.ones(len(fit), dtype=np.int64)
        tally.add({wheel: at[fit] for wheel, at in here.items()}, misfit[fit], weights)
    return tally.to_dict()
