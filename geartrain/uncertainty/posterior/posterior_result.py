"""What is known of tooth counts once the outputs have spoken, of each by itself and of two together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import log2
from typing import Literal, NotRequired, TypedDict

from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.exact import as_float
from geartrain.numerics.plain_data import Key, Result
from geartrain.uncertainty.posterior.observations import ObservedOutput
from geartrain.uncertainty.posterior.priors import ToothCountPrior

Method = Literal["exact", "sample"]


@dataclass(frozen=True, slots=True)
class CountProbability(Result):
    """A probability.

    value      exact where it is a Fraction, to rounding where it is a float
    low, high  95 % interval where it is estimated from a sample; None where it is not
    """

    KEYS = (Key("value", to=float), "exact", "low", "high")

    value: Fraction | float
    low: float | None = None
    high: float | None = None

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
    """A wheel's counts once the outputs have spoken.

    doubt    its counts and their chances before
    chances  in parallel to its counts; they sum to 1. Empty where nothing fits
    idle     True if no output that is known depends on it
    """

    KEYS = (Key("", "doubt"), Key("posterior", "chances"), "likeliest", "bits", "idle")

    doubt: ToothCountPrior
    chances: tuple[CountProbability, ...]
    idle: bool

    @property
    def likeliest(self) -> int | None:
        """The count of the greatest chance, the least of equals; None where nothing fits."""
        if not self.chances:
            return None
        best = max(range(len(self.chances)), key=lambda at: (self.chances[at].value, -at))
        return self.doubt.counts[best]

    @property
    def bits(self) -> float:
        """What the outputs tell of it: the relative entropy of posterior and prior, in bits; 0 for nothing."""
        pairs = zip(map(float, self.chances), self.doubt.priors, strict=False)
        return max(0.0, sum(chance * log2(chance / prior) for chance, prior in pairs if chance))

    def chance(self, count: int) -> CountProbability:
        """The chance of a count: 0 for one the wheel cannot have."""
        if count not in self.doubt.counts or not self.chances:
            return CountProbability(Fraction(0))
        return self.chances[self.doubt.counts.index(count)]


@dataclass(frozen=True, slots=True)
class CombinedOutput:
    """The speed of an output under a combination of counts, and its relative error."""

    KEYS = (Key("exact", "speed"), Key("value", "speed", as_float), Key("error", to=float))

    speed: Fraction
    error: Fraction


@dataclass(frozen=True, slots=True)
class CountCombination(Result):
    """Counts of all wheels that some known output depends on.

    teeth    wheel -> count, in the order declared
    speeds   output -> exact speed, in the train's unit
    errors   output -> relative error against the claim it agrees with least; the speed itself where 0 is wanted
    misfit   sum over the claims of (error / tolerance)^2, exact; an exact claim adds nothing
    chance   posterior; None where it is not known (a sample)
    changed  wheels whose count is not the declared one
    """

    KEYS = ("teeth", "outputs", Key("misfit", to=float), "chance", "changed")

    teeth: Mapping[str, int]
    speeds: Mapping[str, Fraction]
    errors: Mapping[str, Fraction]
    misfit: Fraction
    chance: CountProbability | None
    changed: tuple[str, ...]

    @property
    def outputs(self) -> Mapping[str, CombinedOutput]:
        """Speed and error by output."""
        return {name: CombinedOutput(speed, self.errors[name]) for name, speed in self.speeds.items()}


@dataclass(frozen=True, slots=True)
class VarianceShares(Result):
    """Which wheel decides an output: parts of the variance of its speed over the counts as they are before evidence.

    output   its name
    mean     of its speed, in the train's unit
    spread   its standard deviation
    own      wheel -> share of the variance that goes if the wheel's count is known, 0 to 1 (first-order Sobol index)
    whole    wheel -> share that stays if all other counts are known (total Sobol index); `whole` is at least `own`
    exact    True where the shares are exact; False where they are estimated from `samples` combinations
    """

    KEYS = ("output", Key("mean", to=float), "spread", Key("own", to=float), Key("whole", to=float), "exact", "samples")

    output: str
    mean: Fraction | float
    spread: float
    own: Mapping[str, Fraction | float]
    whole: Mapping[str, Fraction | float]
    exact: bool
    samples: int = 0


class KnownOutput(TypedDict):
    """An output of which something is known, its formula, and the share of the prior weight that fits it `alone`."""

    output: str
    claims: list[str]
    formula: str
    alone: NotRequired[CountProbability]


@dataclass(frozen=True, slots=True)
class ToothCountPosterior(Result):
    """Everything a sweep found.

    name          of the train
    method        how: every combination, a decomposition of all of them, or a sample
    soft          whether agreement is a matter of degree
    combinations  of counts there are
    looked        rows looked at: combinations, transitions of the decomposition, or combinations drawn
    evidence      share of the prior weight that fits; the mean of exp(-misfit / 2) where agreement is by degree
    turning       share of the prior weight with which the train turns at all
    fits          number of combinations that fit; None where it is not known
    witnesses     outputs of which something is known
    alone         output -> share of the prior weight that fits it alone; empty where that was not found
    posteriors    wheel -> its counts now
    correlations  pairs of wheels -> correlation of their counts in what fits, strongest first
    best          combinations that agree best, best first; `ranked` says whether none better is left out
    shares        output -> which wheel decides it
    remarks       what the reader should know
    seed          of the sample; None without one
    cut           True if it was interrupted: figures are of what had been looked at
    """

    KEYS = (
        Key("train", "name"),
        "method",
        "soft",
        "combinations",
        "looked",
        "evidence",
        "turning",
        "fits",
        "ranked",
        "seed",
        "ended",
        "assumed",
        "remarks",
        Key("witnesses", "known"),
        Key("wheels", "posteriors"),
        Key("correlations", "correlated"),
        "shares",
        "best",
    )

    name: str
    method: Method
    soft: bool
    combinations: int
    looked: int
    evidence: CountProbability
    turning: CountProbability
    fits: int | None
    witnesses: tuple[ObservedOutput, ...]
    alone: Mapping[str, CountProbability]
    posteriors: Mapping[str, WheelPosterior]
    correlations: Mapping[tuple[str, str], float]
    best: tuple[CountCombination, ...]
    ranked: bool
    shares: Mapping[str, VarianceShares]
    remarks: tuple[str, ...]
    seed: int | None
    cut: bool

    def __getitem__(self, wheel: str) -> WheelPosterior:
        return self.posteriors[wheel]

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


Again = Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior]
Pairs = dict[tuple[str, str], dict[tuple[int, int], float]]


def most_informative_wheels(found: ToothCountPosterior, most: int = 6) -> list[str]:
    """The wheels of which the outputs tell most, in the order declared; those with one count possible say nothing."""
    heard = [wheel for wheel, each in found.posteriors.items() if not each.idle and len(each.doubt.counts) > 1]
    kept = set(sorted(heard, key=lambda wheel: -found[wheel].bits)[:most])
    return [wheel for wheel in heard if wheel in kept]


def joint_posterior(found: ToothCountPosterior, wheels: Sequence[str], again: Again) -> Pairs:
    """The chance of every two counts of every two of some wheels.

    again   sweeps the same train for the same evidence, with some wheels held to the counts given

    Each is the chance of the one times that of the other where the one is held: one more sweep for each count that is
    possible, of every wheel but the last. As exact as the sweeps.
    """
    pairs: Pairs = {(a, b): {} for at, a in enumerate(wheels) for b in wheels[at + 1 :]}
    for at, wheel in enumerate(wheels[:-1]):
        for count, chance in zip(found[wheel].doubt.counts, found[wheel].chances, strict=False):
            if not float(chance):
                continue
            held = again({wheel: [count]})
            for other in wheels[at + 1 :]:
                after = held[other]
                for its, likely in zip(after.doubt.counts, after.chances, strict=False):
                    if float(likely):
                        pairs[wheel, other][count, its] = float(chance) * float(likely)
    return pairs
