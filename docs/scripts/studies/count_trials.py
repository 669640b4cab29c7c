"""Combinations of tooth counts for the benchmark, worked out in batches and one by one."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from geartrain import GearTrain, load
from geartrain.kinematics.formulas import with_counts
from geartrain.search.posterior.inference_problem import InferenceProblem, build_inference_problem, find_priors
from geartrain.search.posterior.sampled_posterior import LikelihoodBatch

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Singles = list[tuple[dict[str, Fraction], bool]]
"""Of each combination the exact speeds of all outputs, and whether they are all as asked."""


@dataclass(frozen=True)
class Counted:
    """A shipped train of which every wheel is in doubt, and random combinations of counts.

    width       counts below and above the declared one
    tolerance   of every target, relative
    """

    train: str
    combinations: int
    width: int = 2
    tolerance: Fraction = Fraction(1, 200)
    seed: int = 1

    @cached_property
    def given(self) -> GearTrain:
        """The train as it is shipped."""
        return load(self.train)

    @cached_property
    def question(self) -> InferenceProblem:
        """Which combinations meet the targets?"""
        train = self.given.declaration
        free = {
            name: range(wheel.count - self.width, wheel.count + self.width + 1)
            for name, (_, wheel) in train.wheels.items()
            if wheel.count is not None
        }
        return build_inference_problem(train, find_priors(train, free), tolerance=self.tolerance, against="targets")

    @cached_property
    def judge(self) -> LikelihoodBatch:
        """Tells of many combinations whether they fit."""
        return LikelihoodBatch(self.question)

    @cached_property
    def counts(self) -> dict[str, Ints]:
        """Wheel -> its counts in every combination; one in two is as declared but for one wheel."""
        rng, found = np.random.default_rng(self.seed), {}
        near = rng.random(self.combinations) < 0.5
        odd = rng.integers(0, len(self.question.uncertainties), self.combinations)
        for at, (wheel, doubt) in enumerate(self.question.uncertainties.items()):
            drawn = rng.choice(np.array(doubt.counts), self.combinations)
            found[wheel] = np.where(near & (odd != at), doubt.declared or drawn, drawn)
        return found

    # ------------------------------------------------------------------------------------------------------------ ways

    def decided(self) -> Bools:
        """Whether each combination fits, decided exactly, (combinations,)."""
        return self.judge.judged(self.counts)[0]

    def told(self) -> dict[str, tuple[Floats, Floats]]:
        """Output -> its speed in every combination, and a bound on its error."""
        return {name: formula.bounded(self.counts) for name, formula in self.question.outputs.items()}

    def singly(self, combinations: int) -> Singles:
        """The first combinations by a plain loop over whole solutions."""
        return [self._single(at) for at in range(combinations)]

    def _single(self, at: int) -> tuple[dict[str, Fraction], bool]:
        counts = {wheel: int(column[at]) for wheel, column in self.counts.items()}
        solved = GearTrain(with_counts(self.given.declaration, counts)).solve()
        speeds = {name: Fraction(solved[name]) for name in self.question.outputs}
        return speeds, all(witness.fits(speeds[witness.name]) for witness in self.question.witnesses)

    # -------------------------------------------------------------------------------------------------------- accuracy

    def off(self, singles: Singles) -> tuple[float, float]:
        """Greatest relative error of the speeds told, and the greatest share of its own bound that an error has."""
        worst = share = 0.0
        for name, (values, bounds) in self.told().items():
            for at, (speeds, _) in enumerate(singles):
                error = abs(Fraction(float(values[at])) - speeds[name])
                worst = max(worst, float(error / abs(speeds[name])))
                share = max(share, float(error / Fraction(float(bounds[at]))))
        return worst, share

    def differing(self, singles: Singles) -> int:
        """Combinations on which the loop decides otherwise."""
        return int((self.decided()[: len(singles)] != np.array([fits for _, fits in singles])).sum())
