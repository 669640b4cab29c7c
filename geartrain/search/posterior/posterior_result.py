"""Posterior of tooth counts: of single wheels, of pairs of wheels, and of combinations of all wheels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any, ClassVar, Literal, NotRequired, TypedDict

from geartrain.numerics.exact import as_float, decimal
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.information import relative_entropy
from geartrain.search.posterior.inference_problem import ToothCountPrior
from geartrain.search.train.output_requirements import OutputRequirement

Method = Literal["exact", "sample"]


@dataclass(frozen=True, slots=True)
class CountProbability(Result):
    """Probability of a tooth count or of an observation. It is exact, correct up to rounding errors, or estimated from
    a sample.
    """

    KEYS = (Key("value", to=float), "exact", "low", "high")

    value: Fraction | float
    """Probability, 0 to 1. A Fraction is exact. A float is estimated from a sample, or correct up to rounding
    errors.
    """
    low: float | None = None
    """Lower end of the 95 % confidence interval of an estimated probability; None if the probability is not an
    estimate.
    """
    high: float | None = None
    """Upper end of the 95 % confidence interval of an estimated probability; None if the probability is not an
    estimate.
    """

    @property
    def exact(self) -> Fraction | None:
        """Exact probability; None if the probability is a float."""
        return self.value if isinstance(self.value, Fraction) else None

    def __float__(self) -> float:
        return float(self.value)

    def __str__(self) -> str:
        text = decimal(self.value, 4) if isinstance(self.value, Fraction) else f"{self.value:.4g}"
        return text if self.low is None or self.high is None else f"{text} ({self.low:.3g} to {self.high:.3g})"


@dataclass(frozen=True, slots=True)
class WheelPosterior(Result):
    """Posterior of the tooth count of one wheel, with its prior and the information gained."""

    KEYS = (Key("", "uncertainty"), Key("posterior", "probabilities"), "likeliest", "bits", "idle")

    uncertainty: ToothCountPrior
    """Possible tooth counts of the wheel with their prior probabilities."""
    probabilities: tuple[CountProbability, ...]
    """Posterior probability of each tooth count. The sum is 1; empty if no combination satisfies the observations."""
    idle: bool
    """True if no observed output depends on the wheel, so that its posterior equals its prior."""

    @property
    def likeliest(self) -> int | None:
        """Most probable tooth count; None if no combination satisfies the observations. If several tooth counts are
        equally probable, the smallest is returned.
        """
        if not self.probabilities:
            return None
        # -at: the smallest of equally probable counts
        best = max(range(len(self.probabilities)), key=lambda at: (self.probabilities[at].value, -at))
        return self.uncertainty.counts[best]

    @property
    def bits(self) -> float:
        """Information about the tooth count that is gained from the outputs: relative entropy of the posterior with
        respect to the prior [bit].
        """
        return relative_entropy(map(float, self.probabilities), self.uncertainty.priors)

    def probability(self, count: int) -> CountProbability:
        """Return the posterior probability of a tooth count.

        count   tooth count. The probability of an impossible count is 0.
        """
        if count not in self.uncertainty.counts or not self.probabilities:
            return CountProbability(Fraction(0))
        return self.probabilities[self.uncertainty.counts.index(count)]


@dataclass(frozen=True, slots=True)
class CombinedOutput:
    """Speed of an output for one combination of tooth counts, with its relative error."""

    KEYS = (Key("exact", "speed"), Key("value", "speed", as_float), Key("error", to=float))

    speed: Fraction
    """Exact speed of the output [the train's unit of speed]."""
    error: Fraction
    """Relative error of the speed with respect to the observed speed."""


@dataclass(frozen=True, slots=True)
class CountCombination(Result):
    """Combination of tooth counts of all wheels on which an observed output depends."""

    KEYS = ("teeth", "outputs", Key("misfit", to=float), "probability", "changed")

    teeth: Mapping[str, int]
    """Tooth count of each wheel, keyed by wheel in the order of declaration."""
    speeds: Mapping[str, Fraction]
    """Exact speed of each output [the train's unit of speed]."""
    errors: Mapping[str, Fraction]
    """Relative error of the speed of each output with respect to the observation that has the largest misfit. If this
    observed speed is 0, the value is the speed itself.
    """
    misfit: Fraction
    """Sum of (error / tolerance)^2 over all observations. Observations without tolerance (exact observations)
    contribute 0.
    """
    probability: CountProbability | None
    """Posterior probability; None if it is unknown, for example if it is not estimated from a sample."""
    changed: tuple[str, ...]
    """Names of the wheels whose tooth count differs from the declared tooth count."""

    @property
    def outputs(self) -> Mapping[str, CombinedOutput]:
        """Speed and relative error of each output, keyed by output."""
        return {name: CombinedOutput(speed, self.errors[name]) for name, speed in self.speeds.items()}


@dataclass(frozen=True, slots=True)
class VarianceShares(Result):
    """Sobol indices of the speed of an output, for tooth counts distributed according to their priors."""

    KEYS = ("output", Key("mean", to=as_float), "spread", Key("own", to=float), Key("whole", to=float))

    output: str
    """Name of the output."""
    mean: Fraction | float
    """Prior mean of the speed [the train's unit of speed]."""
    spread: float | None
    """Prior standard deviation of the speed [the train's unit of speed]; None if it is out of the range of float64."""
    own: Mapping[str, Fraction | float]
    """First-order Sobol index of each wheel, 0 to 1: fraction of the variance that is removed if the tooth count of
    this wheel is known.
    """
    whole: Mapping[str, Fraction | float]
    """Total Sobol index of each wheel, 0 to 1: fraction of the variance that remains if the tooth counts of all other
    wheels are known.
    """


class KnownOutput(TypedDict):
    """Observed output as plain data, with its observations, its formula, and its evidence (marginal likelihood)."""

    output: str
    """Name of the output."""
    claims: list[str]
    """Descriptions of the observations of the speed of the output."""
    formula: str
    """Formula of the speed as a function of the uncertain tooth counts."""
    alone: NotRequired[CountProbability]
    """Evidence computed from the observations of this output only: prior mean of their likelihood."""


@dataclass(frozen=True, slots=True)
class ToothCountPosterior(Tabular, Result):
    """Posterior of all uncertain tooth counts. `found["wheel"]` is the posterior of one wheel.

    See Also
    --------
    infer_counts : Compute the posterior of uncertain tooth counts.
    """

    MEANINGS: ClassVar = {
        "wheel": "Wheel with an uncertain tooth count.",
        "teeth": "Tooth count.",
        "prior": "Prior probability of the count [1].",
        "posterior": "Posterior probability of the count; empty if no combination satisfies the observations [1].",
    }

    PAGE = "search.posterior.posterior_report:describe_posterior"

    KEYS = (
        *(Key("train", "name"), "method", "soft", "combinations", "examined", "evidence", "turning", "fits", "ranked"),
        *("seed", "ended", "assumed", "remarks", Key("witnesses", "known"), Key("wheels", "posteriors")),
        *(Key("correlations", "correlated"), "shares", "best"),
    )

    name: str
    """Name of the train."""
    method: Method
    """Method of computation: exact join of all combinations, or sampling."""
    soft: bool
    """True for a Gaussian likelihood; False for a likelihood that is 1 within all tolerances and 0 outside."""
    combinations: int
    """Number of combinations of possible tooth counts."""
    examined: int
    """Number of steps of the exact join, or number of sampled combinations."""
    evidence: CountProbability
    """Evidence (marginal likelihood): prior probability that all observations are satisfied, or the prior mean of
    exp(-misfit / 2) if `soft` is True.
    """
    turning: CountProbability
    """Prior probability that the train can turn."""
    fits: int | None
    """Number of combinations that satisfy all observations; None if the number is not known."""
    witnesses: tuple[OutputRequirement, ...]
    """Outputs with observed speeds, which provide the evidence."""
    alone: Mapping[str, CountProbability]
    """Evidence of each output, computed from the observations of this output only."""
    posteriors: Mapping[str, WheelPosterior]
    """Posterior of the tooth count of each wheel."""
    correlations: Mapping[tuple[str, str], float]
    """Posterior correlation of the tooth counts of each pair of wheels, -1 to 1, in descending order of magnitude."""
    best: tuple[CountCombination, ...]
    """Best combinations, in ascending order of misfit."""
    ranked: bool
    """True if no unlisted combination is better than the last listed combination."""
    shares: Mapping[str, VarianceShares]
    """Sobol indices of the speed of each output with respect to the tooth count of each wheel."""
    remarks: tuple[str, ...]
    """Remarks on observations that are not used, and on the reliability of estimates."""
    seed: int | None
    """Random seed of the sample; None for the exact method."""
    cut: bool
    """True if the computation was interrupted, so that the results are based only on the combinations sampled until
    then.
    """

    def _summary(self) -> str:
        likely = ", ".join(
            f"{wheel} {found.likeliest}" for wheel, found in islice(self.posteriors.items(), 4) if found.probabilities
        )
        more = f", {len(self.posteriors) - 4} more wheels" if len(self.posteriors) > 4 else ""
        searched = f"{self.combinations:,} combinations, {self.method}"
        return f"{self.name}: most probable {likely or 'nothing fits'}{more}; {searched}"

    def __getitem__(self, wheel: str) -> WheelPosterior:
        return self.posteriors[wheel]

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each tooth count of each wheel: prior and posterior probability.

        The posterior probability is None if no combination satisfies the observations.
        """
        rows = [
            (wheel, found, at)
            for wheel, found in self.posteriors.items()
            for at in range(len(found.uncertainty.counts))
        ]
        return {
            "wheel": [wheel for wheel, _, _ in rows],
            "teeth": [found.uncertainty.counts[at] for _, found, at in rows],
            "prior": [float(found.uncertainty.priors[at]) for _, found, at in rows],
            "posterior": [float(found.probabilities[at]) if found.probabilities else None for _, found, at in rows],
        }

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """Outcome of the computation: "whole" if it was completed, "interrupted" if it was not."""
        return "interrupted" if self.cut else "whole"

    @property
    def known(self) -> list[KnownOutput]:
        """Observed outputs as plain data, with the evidence of each output if it was computed."""
        found = []
        for one in self.witnesses:
            known = KnownOutput(
                output=one.name, claims=[claim.label for claim in one.demands], formula=str(one.function)
            )
            if one.name in self.alone:
                known["alone"] = self.alone[one.name]
            found.append(known)
        return found

    @property
    def correlated(self) -> list[tuple[str, str, float]]:
        """Pairs of wheels with the correlation of their tooth counts (wheel, wheel, correlation), in descending order
        of magnitude.
        """
        return [(*pair, value) for pair, value in self.correlations.items()]

    @property
    def assumed(self) -> Sequence[str]:
        """Assumptions of the inference, one sentence each."""
        agree = (
            "The likelihood is exp(-misfit/2), with the tolerances as standard deviations; errors of more than 5 "
            "tolerances are rejected."
            if self.soft
            else "A combination fits if every output is within its tolerance; its likelihood is then 1, else 0."
        )
        return (
            "The prior treats the counts of different wheels as independent.",
            agree,
            "The observed speeds are assumed to be the intended ones, without misprints or repairs.",
        )
