"""The posterior of tooth counts: of each wheel by itself, of two together, of whole combinations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any, ClassVar, Literal, NotRequired, TypedDict

from geartrain.numerics.exact import as_float, decimal
from geartrain.numerics.long_float import Real, as_plain
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.posterior.inference_problem import ObservedOutput, ToothCountPrior
from geartrain.search.weighted_alternatives import relative_entropy

Method = Literal["exact", "sample"]


@dataclass(frozen=True, slots=True)
class CountProbability(Result):
    """A probability: exact, to rounding, or estimated from a sample.

    Examples
    --------
    >>> from fractions import Fraction
    >>> one = CountProbability(Fraction(1, 3))
    >>> one.is_exact, float(one) == 1 / 3, str(one), str(CountProbability(0.25, 0.2, 0.3))
    (True, True, '0.3333', '0.25 (0.2 to 0.3)')
    """

    KEYS = (Key("value", to=float), "exact", "low", "high")

    value: Fraction | float
    """0 to 1; exact where it is a Fraction, to rounding where it is a float."""
    low: float | None = None
    """Lower end of the 95 % interval where the value is estimated from a sample."""
    high: float | None = None
    """Upper end of the 95 % interval where the value is estimated from a sample."""

    @property
    def exact(self) -> Fraction | None:
        """The value where it is exact."""
        return self.value if isinstance(self.value, Fraction) else None

    @property
    def is_exact(self) -> bool:
        """True for a Fraction."""
        return isinstance(self.value, Fraction)

    def __float__(self) -> float:
        return float(self.value)

    def __str__(self) -> str:
        text = decimal(self.value, 4) if isinstance(self.value, Fraction) else f"{self.value:.4g}"
        return text if self.low is None or self.high is None else f"{text} ({self.low:.3g} to {self.high:.3g})"


@dataclass(frozen=True, slots=True)
class WheelPosterior(Result):
    """The posterior of one wheel's count.

    See Also
    --------
    infer_counts : gives it, by wheel
    """

    KEYS = (Key("", "doubt"), Key("posterior", "chances"), "likeliest", "bits", "idle")

    doubt: ToothCountPrior
    """Its `counts`, and their `priors`: the probabilities before the outputs are looked at."""
    chances: tuple[CountProbability, ...]
    """Posterior probabilities in parallel to the counts; they sum to 1. Empty where nothing fits."""
    idle: bool
    """True if no known output depends on it, so that its posterior is its prior."""

    @property
    def likeliest(self) -> int | None:
        """The count of the greatest chance, the least of equals; None where nothing fits."""
        if not self.chances:
            return None
        best = max(range(len(self.chances)), key=lambda at: (self.chances[at].value, -at))
        return self.doubt.counts[best]

    @property
    def bits(self) -> float:
        """What the outputs tell of it: the relative entropy of posterior and prior [bit]; 0 for nothing."""
        return relative_entropy(map(float, self.chances), self.doubt.priors)

    def chance(self, count: int) -> CountProbability:
        """The posterior probability of a count.

        Parameters
        ----------
        count : int
            A tooth count; of one the wheel cannot have the probability is 0.
        """
        if count not in self.doubt.counts or not self.chances:
            return CountProbability(Fraction(0))
        return self.chances[self.doubt.counts.index(count)]


@dataclass(frozen=True, slots=True)
class CombinedOutput:
    """The speed of an output under a combination of counts, and its relative error."""

    KEYS = (Key("exact", "speed"), Key("value", "speed", as_float), Key("error", to=float))

    speed: Fraction
    """Speed of the output under the combination."""
    error: Fraction
    """Relative error of the speed against what is known."""


@dataclass(frozen=True, slots=True)
class CountCombination(Result):
    """One combination: counts of all wheels that some known output depends on.

    See Also
    --------
    infer_counts : lists the best
    """

    KEYS = ("teeth", "outputs", Key("misfit", to=float), "chance", "changed")

    teeth: Mapping[str, int]
    """Wheel -> count, in the order declared."""
    speeds: Mapping[str, Fraction]
    """Output -> exact speed [unit of the train]."""
    errors: Mapping[str, Fraction]
    """Output -> relative error against the claim it agrees with least; the speed itself where 0 is wanted."""
    misfit: Fraction
    """Sum over the claims of (error / tolerance)^2; an exact claim adds nothing."""
    chance: CountProbability | None
    """Posterior probability; None where it is not known, in a sample."""
    changed: tuple[str, ...]
    """Wheels whose count is not the declared one."""

    @property
    def outputs(self) -> Mapping[str, CombinedOutput]:
        """Speed and error by output."""
        return {name: CombinedOutput(speed, self.errors[name]) for name, speed in self.speeds.items()}


@dataclass(frozen=True, slots=True)
class VarianceShares(Result):
    """Which wheel decides an output: Sobol indices of its speed over the prior of the counts.

    See Also
    --------
    infer_counts : gives it, by output

    References
    ----------
    Sobol, I. M. 2001. Global sensitivity indices for nonlinear mathematical models. Math. Comput. Simul. 55.
    """

    KEYS = (
        *("output", Key("mean", to=as_float), Key("spread", to=as_plain), Key("own", to=float), Key("whole", to=float)),
        *("exact", "samples"),
    )

    output: str
    """Its name."""
    mean: Fraction | float
    """Of its speed [unit of the train]."""
    spread: Real
    """Standard deviation of its speed [unit of the train]; `LongFloat` past 1e308."""
    own: Mapping[str, Fraction | float]
    """Wheel -> first-order index, 0 to 1: the share of the variance that goes if the wheel's count is known."""
    whole: Mapping[str, Fraction | float]
    """Wheel -> total index, at least `own`: the share that stays if all other counts are known."""
    exact: bool
    """False where the indices are estimated from `samples` combinations."""
    samples: int = 0
    """0 where they are exact."""


class KnownOutput(TypedDict):
    """An output of which something is known, its formula, and the share of the prior weight that fits it `alone`."""

    output: str
    """Name of the output."""
    claims: list[str]
    """What is known of its speed."""
    formula: str
    """Its speed as a function of the uncertain counts."""
    alone: NotRequired[CountProbability]
    """Share of the prior weight that fits this output alone."""


@dataclass(frozen=True, slots=True)
class ToothCountPosterior(Tabular, Result):
    """The posterior of all tooth counts in doubt; `found["wheel"]` is that of one wheel.

    See Also
    --------
    infer_counts : gives it
    """

    MEANINGS: ClassVar = {
        "wheel": "Wheel with an uncertain tooth count.",
        "teeth": "Tooth count.",
        "prior": "Prior probability of the count [1].",
        "posterior": "Posterior probability of the count; empty where nothing fits [1].",
    }

    PAGE = "search.posterior.posterior_report:describe_posterior"

    KEYS = (
        *(Key("train", "name"), "method", "soft", "combinations", "examined", "evidence", "turning", "fits", "ranked"),
        *("seed", "ended", "assumed", "remarks", Key("witnesses", "known"), Key("wheels", "posteriors")),
        *(Key("correlations", "correlated"), "shares", "best"),
    )

    name: str
    """Of the train."""
    method: Method
    """All combinations by the exact join, or a sample of them."""
    soft: bool
    """Whether agreement is a matter of degree."""
    combinations: int
    """Of counts there are."""
    examined: int
    """Steps of the exact join, or combinations drawn."""
    evidence: CountProbability
    """Share of the prior weight that fits; the mean of exp(-misfit / 2) where agreement is by degree."""
    turning: CountProbability
    """Share of the prior weight with which the train turns at all."""
    fits: int | None
    """Number of combinations that fit, where it is known."""
    witnesses: tuple[ObservedOutput, ...]
    """Outputs of which something is known."""
    alone: Mapping[str, CountProbability]
    """Output -> share of the prior weight that fits it alone."""
    posteriors: Mapping[str, WheelPosterior]
    """By wheel."""
    correlations: Mapping[tuple[str, str], float]
    """Pairs of wheels -> correlation of their counts in what fits, -1 to 1, strongest first."""
    best: tuple[CountCombination, ...]
    """Combinations that agree best, best first."""
    ranked: bool
    """Whether none better than the last of them is left out."""
    shares: Mapping[str, VarianceShares]
    """Output -> which wheel decides it."""
    remarks: tuple[str, ...]
    """What the reader should know."""
    seed: int | None
    """Of the sample, if there is one."""
    cut: bool
    """True if it was interrupted: the figures are of what had been drawn."""

    def _summary(self) -> str:
        likely = ", ".join(
            f"{wheel} {found.likeliest}" for wheel, found in islice(self.posteriors.items(), 4) if found.chances
        )
        more = f", {len(self.posteriors) - 4} more wheels" if len(self.posteriors) > 4 else ""
        searched = f"{self.combinations:,} combinations, {self.method}"
        return f"{self.name}: most probable {likely or 'nothing fits'}{more}; {searched}"

    def __getitem__(self, wheel: str) -> WheelPosterior:
        return self.posteriors[wheel]

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each count of each wheel: its chances before the outputs are looked at and after.

        After is None where nothing fits.
        """
        rows = [(wheel, found, at) for wheel, found in self.posteriors.items() for at in range(len(found.doubt.counts))]
        return {
            "wheel": [wheel for wheel, _, _ in rows],
            "teeth": [found.doubt.counts[at] for _, found, at in rows],
            "prior": [float(found.doubt.priors[at]) for _, found, at in rows],
            "posterior": [float(found.chances[at]) if found.chances else None for _, found, at in rows],
        }

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """How the search ended."""
        return "interrupted" if self.cut else "whole"

    @property
    def known(self) -> list[KnownOutput]:
        """The witnesses, and how far each goes alone where that was found."""
        found = []
        for one in self.witnesses:
            known = KnownOutput(output=one.name, claims=[claim.label for claim in one.claims], formula=str(one.formula))
            if one.name in self.alone:
                known["alone"] = self.alone[one.name]
            found.append(known)
        return found

    @property
    def correlated(self) -> list[tuple[str, str, float]]:
        """Two wheels and the correlation of their counts, strongest first."""
        return [(*pair, value) for pair, value in self.correlations.items()]

    @property
    def assumed(self) -> Sequence[str]:
        """The assumptions behind the figures, in sentences."""
        agree = (
            "Agreement is by degree: a combination weighs exp(-misfit/2), the tolerances taken as standard deviations; "
            "what is more than 5 tolerances off is refused."
            if self.soft
            else "A combination fits if every output is within its tolerance, and otherwise it does not: no degrees."
        )
        return (
            "The counts of different wheels are independent before the outputs are looked at.",
            agree,
            "What the outputs show is taken to be what they were meant to show; no misprint or repair is allowed for.",
        )
