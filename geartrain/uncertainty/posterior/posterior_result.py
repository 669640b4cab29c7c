"""What is known of tooth counts once the outputs have spoken.

Counts of two wheels together: how likely each two of them are once the outputs have spoken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import log2
from typing import Any, Literal

from geartrain.numerics.decimal_text import decimal, fraction_text
from geartrain.numerics.exact import as_float
from geartrain.uncertainty.posterior.observations import ObservedOutput
from geartrain.uncertainty.posterior.priors import ToothCountPrior

Method = Literal["exact", "sample"]


@dataclass(frozen=True, slots=True)
class CountProbability:
    """A probability.

    value      exact where it is a Fraction, to rounding where it is a float
    low, high  95 % interval where it is estimated from a sample; None where it is not
    """

    value: Fraction | float
    low: float | None = None
    high: float | None = None

    @property
    def is_exact(self) -> bool:
        """True for a Fraction."""
        return isinstance(self.value, Fraction)

    def __float__(self) -> float:
        return float(self.value)

    def __str__(self) -> str:
        text = decimal(self.value, 4) if isinstance(self.value, Fraction) else f"{self.value:.4g}"
        return text if self.low is None or self.high is None else f"{text} ({self.low:.3g} to {self.high:.3g})"

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        exact = fraction_text(self.value) if isinstance(self.value, Fraction) else None
        return {"value": float(self.value), "exact": exact, "low": self.low, "high": self.high}


@dataclass(frozen=True, slots=True)
class WheelPosterior:
    """A wheel's counts once the outputs have spoken.

    doubt    its counts and their chances before
    chances  in parallel to its counts; they sum to 1. Empty where nothing fits
    idle     True if no output that is known depends on it
    """

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

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            **self.doubt.to_dict(),
            "posterior": [chance.to_dict() for chance in self.chances],
            "likeliest": self.likeliest,
            "bits": self.bits,
            "idle": self.idle,
        }


@dataclass(frozen=True, slots=True)
class CountCombination:
    """Counts of all wheels that some known output depends on.

    teeth    wheel -> count, in the order declared
    speeds   output -> exact speed, in the train's unit
    errors   output -> relative error against the claim it agrees with least; the speed itself where 0 is wanted
    misfit   sum over the claims of (error / tolerance)^2, exact; an exact claim adds nothing
    chance   posterior; None where it is not known (a sample)
    changed  wheels whose count is not the declared one
    """

    teeth: Mapping[str, int]
    speeds: Mapping[str, Fraction]
    errors: Mapping[str, Fraction]
    misfit: Fraction
    chance: CountProbability | None
    changed: tuple[str, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "teeth": dict(self.teeth),
            "outputs": {
                name: {"exact": fraction_text(speed), "value": as_float(speed), "error": float(self.errors[name])}
                for name, speed in self.speeds.items()
            },
            "misfit": float(self.misfit),
            "chance": None if self.chance is None else self.chance.to_dict(),
            "changed": list(self.changed),
        }


@dataclass(frozen=True, slots=True)
class VarianceShares:
    """Which wheel decides an output: parts of the variance of its speed over the counts as they are before evidence.

    output   its name
    mean     of its speed, in the train's unit
    spread   its standard deviation
    own      wheel -> share of the variance that goes if the wheel's count is known, 0 to 1 (first-order Sobol index)
    whole    wheel -> share that stays if all other counts are known (total Sobol index); `whole` is at least `own`
    exact    True where the shares are exact; False where they are estimated from `samples` combinations
    """

    output: str
    mean: Fraction | float
    spread: float
    own: Mapping[str, Fraction | float]
    whole: Mapping[str, Fraction | float]
    exact: bool
    samples: int = 0

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "output": self.output,
            "mean": float(self.mean),
            "spread": self.spread,
            "own": {wheel: float(share) for wheel, share in self.own.items()},
            "whole": {wheel: float(share) for wheel, share in self.whole.items()},
            "exact": self.exact,
            "samples": self.samples,
        }


@dataclass(frozen=True, slots=True)
class ToothCountPosterior:
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

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "train": self.name,
            "method": self.method,
            "soft": self.soft,
            "combinations": self.combinations,
            "looked": self.looked,
            "evidence": self.evidence.to_dict(),
            "turning": self.turning.to_dict(),
            "fits": self.fits,
            "ranked": self.ranked,
            "seed": self.seed,
            "ended": "interrupted" if self.cut else "whole",
            "assumed": list(self.assumed),
            "remarks": list(self.remarks),
            "witnesses": [
                witness.to_dict()
                | ({"alone": self.alone[witness.name].to_dict()} if witness.name in self.alone else {})
                for witness in self.witnesses
            ],
            "wheels": {wheel: posterior.to_dict() for wheel, posterior in self.posteriors.items()},
            "correlations": [[*pair, value] for pair, value in self.correlations.items()],
            "shares": {name: shares.to_dict() for name, shares in self.shares.items()},
            "best": [combination.to_dict() for combination in self.best],
        }


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
