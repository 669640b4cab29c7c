"""Random sample of combinations of tooth counts: speeds of outputs, likelihoods, and their sums.

The speeds are computed by formulas in the tooth counts, so a combination requires only a few multiplications per
output. Sums over parts of the sample are plain data and can be added in any order.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import nan
from typing import Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.formulas import Formula
from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.exact import as_float
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.search.join.wheel_monomials import IntervalConstraint, is_within
from geartrain.search.posterior.inference_problem import InferenceProblem, ToothCountPrior, observation_constraint
from geartrain.search.train.output_requirements import OutputRequirement

KEPT = 2000
"""Maximum number of best combinations that a task returns. Further combinations with the same misfit are omitted."""
TIE = 1 + 1e-9
"""Ratio of two misfits in floating point below which they may be equal, so that they are compared exactly at a later
stage.
"""


class LikelihoodBatch:
    """Vectorised likelihood of an inference problem for arrays of tooth counts.

    domains  possible tooth counts of the wheels on which an observed output or a condition depends, in the order of
             declaration
    """

    def __init__(self, question: InferenceProblem) -> None:
        self.question = question
        self.domains = {wheel: uncertainty.counts for wheel, uncertainty in question.moved.items()}
        self.wheels = tuple(self.domains)
        # formulas of few wheels first: they are cheap, and rows that they reject need no further evaluation
        ordered = sorted(question.witnesses, key=lambda one: len(one.function.wheels))
        self._outputs = [(misfit_of(one), observation_constraint(one, question.soft, graded=False)) for one in ordered]

    def turns(self, counts: Mapping[str, Ints]) -> Bools:
        """Return, for each combination, whether the train turns. `counts` contains the tooth counts of each wheel, in
        arrays of equal length.
        """
        found: Bools = np.ones(len(counts[self.wheels[0]]), dtype=np.bool_)
        for condition in self.question.conditions:
            found &= decide(condition, counts)[0]
        return found

    def judged(self, counts: Mapping[str, Ints]) -> tuple[Bools, Floats]:
        """Return whether each combination satisfies the observations, by exact arithmetic, and its misfit up to
        rounding errors.

        The misfit of a rejected combination is infinite. Once a combination is rejected, its remaining outputs are not
        evaluated.
        """
        met = self.turns(counts)
        total = np.zeros(len(met))
        for misfit, constraint in self._outputs:
            rows = np.flatnonzero(met)
            met[rows], speeds = decide(constraint, {wheel: counts[wheel][rows] for wheel in constraint.function.wheels})
            total[rows] += misfit(speeds)
        return met, np.where(met, total, np.inf)


def decide(one: IntervalConstraint, counts: Mapping[str, Ints]) -> tuple[Bools, Floats]:
    """Return whether each combination satisfies a constraint, by exact comparison, and the value of the constrained
    function up to rounding errors.

    The values are compared as floats. If the distance from a value to an end of an interval is less than its error
    bound, exact rational numbers are compared.
    """
    function = one.function
    assert isinstance(function, Formula)
    value, room = function.bounded(counts)
    met: Bools = np.zeros(len(value), dtype=np.bool_)
    with np.errstate(invalid="ignore"):
        sure = np.isfinite(room)
        for interval in one.intervals:
            inside: Bools = np.ones(len(value), dtype=np.bool_)
            for end, sign in zip(interval, (1, -1), strict=True):
                if end is not None:
                    edge = as_float(end)
                    # with nan, for an end beyond float64, no combination is sure
                    gap = sign * (value - (nan if edge is None else edge))
                    inside &= gap >= 0
                    # error bound of the value, and the rounding of the end to float64
                    sure &= np.abs(gap) > room + 2 * UNIT_ROUNDOFF * abs(edge or 0)
            met |= inside
    rows = np.flatnonzero(~sure)
    if len(rows):
        places, at = np.unique([counts[wheel][rows] for wheel in function.wheels], axis=1, return_inverse=True)
        exact = [function.value(dict(zip(function.wheels, place, strict=True))) for place in places.T]
        excluded = {end for interval in one.intervals for end in interval} if one.strict else set()
        admitted = [each is not None and each not in excluded and is_within(each, one.intervals) for each in exact]
        met[rows] = np.array(admitted)[at.ravel()]
        value[rows] = np.array([as_float(each or Fraction(0)) or 0.0 for each in exact])[at.ravel()]
    return met, value


class PosteriorTally:
    """Sums of likelihoods over the combinations of a sample, from which the posterior is estimated.

    examined  number of combinations
    turning   number of combinations for which the train can turn
    weight    sum of the likelihoods
    square    sum of the squared likelihoods, for confidence intervals
    by        sum of the likelihoods for each tooth count of each wheel
    sizes     for each pair of wheels, sum of likelihood (x - a) (y - b), where x and y are the tooth counts of the two
              wheels, and a and b are their most probable tooth counts in the prior
    best      best combinations as (misfit, indices of tooth counts), in ascending order of misfit
    ranked    False if combinations with the same misfit as the last of `best` are omitted
    """

    def __init__(self, batch: LikelihoodBatch, most: int) -> None:
        self.batch, self.most = batch, most
        self.examined = self.turning = 0
        self.weight = self.square = 0.0
        self.by = [[0.0] * len(batch.domains[wheel]) for wheel in batch.wheels]
        self.sizes: Floats = np.zeros((len(batch.wheels), len(batch.wheels)))
        self.best: list[tuple[float, tuple[int, ...]]] = []
        self.ranked = True

    def join(self, other: Mapping[str, Any]) -> None:
        """Add the sums of one task, as returned by `sample_task`."""
        self.examined += other["examined"]
        self.turning += other["turning"]
        self.weight += other["weight"]
        self.square += other["square"]
        self.by = [np.add(own, more).tolist() for own, more in zip(self.by, other["by"], strict=True)]
        self.sizes += np.array(other["sizes"]).reshape(self.sizes.shape)
        self.best = sorted([*self.best, *((misfit, tuple(at)) for misfit, at in other["best"])])
        self.best = self.best[: _with_ties([misfit for misfit, _ in self.best], self.most)]
        self.ranked &= len(self.best) <= KEPT
        self.best = self.best[:KEPT]


def _with_ties(misfits: Sequence[float] | Floats, most: int) -> int:
    """Return the number of entries, from the start of a list of ascending misfits, that includes the first `most`
    entries and all ties of the last of them.
    """
    if len(misfits) < most:
        return len(misfits)
    return int(np.searchsorted(misfits, misfits[most - 1] * TIE, side="right"))


def plain_number(value: Any) -> int | float:
    """Convert a sum to a Python float, or to a Python integer if it is an integer. A Python integer cannot overflow."""
    return float(value) if isinstance(value, float | np.floating) else int(value)


def origin_of(uncertainty: ToothCountPrior) -> int:
    """Return the most probable tooth count of a prior. It is subtracted from the tooth counts so that sums of products
    lose no digits.
    """
    return uncertainty.counts[uncertainty.weights.index(max(uncertainty.weights))]


@lru_cache(maxsize=1)
def _unpacked(shared: bytes) -> tuple[LikelihoodBatch, int]:
    question, most = pickle.loads(shared)
    return LikelihoodBatch(question), most


def sample_task(shared: bytes, task: Sequence[int]) -> dict[str, Any]:
    """Draw combinations from the prior, and return the sums of their likelihoods as plain data.

    shared  pickled inference problem, and number of combinations to list
    task    random seed, number of the task (which selects an independent random stream), and size of the sample
    """
    batch, most = _unpacked(shared)
    seed, block, size = task
    # an independent random stream for each block: the draws do not depend on the distribution of tasks
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, block])))
    uncertainties = [batch.question.uncertainties[wheel] for wheel in batch.wheels]
    places, steps = [], []
    for one in uncertainties:
        probabilities = np.array([float(prior) for prior in one.priors])
        # divided by their sum, because numpy rejects probabilities whose rounded sum differs from 1
        places.append(draw.choice(len(probabilities), size, p=probabilities / probabilities.sum()))
        steps.append(np.array(one.counts, dtype=np.float64) - origin_of(one))
    counts = {wheel: np.array(batch.domains[wheel])[at] for wheel, at in zip(batch.wheels, places, strict=True)}
    # combinations outside the observations have the likelihood 0 and enter only the number of examined combinations
    met, misfit = batch.judged(counts)
    fit = np.flatnonzero(met)
    # ascending, so that the best are first
    fit = fit[np.argsort(misfit[fit], kind="stable")]
    weights = np.exp(-misfit[fit] / 2) if batch.question.soft else np.ones(len(fit))
    chosen = [at[fit] for at in places]
    sizes = np.array([own[at] for own, at in zip(steps, chosen, strict=True)])
    # one more than is kept, so that `PosteriorTally.join` detects omitted ties
    best = range(min(_with_ties(misfit[fit], most), KEPT + 1))
    return {
        "examined": size,
        "turning": int(batch.turns(counts).sum()),
        "weight": float(weights.sum()),
        "square": float((weights**2).sum()),
        "by": [np.bincount(at, weights, len(own)).tolist() for own, at in zip(steps, chosen, strict=True)],
        "sizes": ((sizes * weights) @ sizes.T).tolist(),
        "best": [[float(misfit[fit[row]]), [int(at[row]) for at in chosen]] for row in best],
    }


def misfit_of(witness: OutputRequirement) -> Callable[[Floats], Floats]:
    """Return a function that maps speeds of an output to misfits, which are sums of (error / tolerance)^2, up to
    rounding errors.
    """
    scales: list[tuple[bool, float, float, float]] = []
    for claim in witness.demands:
        if claim.exact:
            continue
        halves = (claim.half(side) for side in (False, True))
        wanted, below, above = (as_float(each or Fraction(0)) for each in (claim.wanted, *halves))
        if wanted is None or below is None or above is None:
            what = f"the speed '{claim.label}' is outside the range of float64"
            why = "misfits are computed in floats from 1e-308 to 1e308"
            raise RangeError(Problem(what, why, "omit this output, or give it an exact `expect`"))
        scales.append((claim.signed, wanted, 1 / below if below else 0.0, 1 / above if above else 0.0))

    def misfit(speeds: Floats) -> Floats:
        total: Floats = np.zeros(len(speeds))
        for signed, wanted, below, above in scales:
            off = (speeds if signed else np.abs(speeds)) - wanted
            total += (off * np.where(off > 0, above, below)) ** 2
        return total

    return misfit
