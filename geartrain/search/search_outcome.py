"""Results of a search for tooth counts, and the reasons why candidates were rejected."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, brief


@dataclass(frozen=True, slots=True)
class Shortfall(Result):
    """Number of candidates rejected by a search, for each reason. These numbers explain an empty or short list of
    solutions.
    """

    considered: int = 0
    """Number of candidates before any constraint is applied."""
    removed: Mapping[str, int] = field(default_factory=dict)
    """Number of rejected candidates, keyed by reason. A candidate is counted under the first constraint that rejected
    it.
    """
    nearest: str = ""
    """Description of the rejected candidate with the smallest violation of a constraint, with its tooth counts and
    ratio error, or description of a constraint that no candidate satisfies. Empty if there is a solution or if the
    search was interrupted.
    """
    advice: str = ""
    """Suggestions of which constraints to relax, with the effect of each suggestion; empty if there is a solution."""


class CountSizes(ABC):
    """Base class of results with tooth counts. It provides their sum, their maximum, and the number of distinct tooth
    counts.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def counts(self) -> Collection[int]:
        """Tooth counts of all wheels."""

    @property
    def total(self) -> int:
        """Sum of the tooth counts."""
        return sum(self.counts)

    @property
    def largest(self) -> int:
        """Maximum tooth count; 0 if there are no tooth counts."""
        return max(self.counts, default=0)

    @property
    def distinct(self) -> int:
        """Number of distinct tooth counts."""
        return len(set(self.counts))


@dataclass(frozen=True, slots=True)
class GearStages(CountSizes, Result):
    """Gear pairs in series that approximate a ratio: tooth counts of the numerator (`top`) and of the denominator
    (`beneath`).
    """

    KEYS = (
        Key("teeth", "sides"),
        "ratio",
        Key("value", "ratio", as_float),
        Key("error", to=float),
        Key("exact_error", "error"),
        Key("stages", "pairs"),
        "total",
        "largest",
        "distinct",
    )

    top: tuple[int, ...]
    """Tooth counts of the numerator in ascending order, one for each stage."""
    beneath: tuple[int, ...]
    """Tooth counts of the denominator in ascending order, one for each stage."""
    ratio: Fraction
    """Exact ratio: product of the tooth counts in `top` divided by product of the tooth counts in `beneath`."""
    error: Fraction
    """Exact relative error: `ratio` divided by the magnitude of the requested ratio, minus 1."""
    pairs: tuple[tuple[int, int], ...]
    """Pairs of tooth counts (numerator, denominator), one for each stage. The pairing is the feasible pairing with the
    maximum number of stages with coprime tooth counts.
    """

    def _summary(self) -> str:
        teeth = " ".join(f"{top}/{beneath}" for top, beneath in self.pairs)
        return f"{teeth} = {brief(self.ratio)}, error {float(self.error):.3g}"

    @property
    def counts(self) -> tuple[int, ...]:
        """Tooth counts of the numerator, followed by the tooth counts of the denominator."""
        return self.top + self.beneath

    @property
    def sides(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Tooth counts of the numerator, and tooth counts of the denominator, as two tuples."""
        return self.top, self.beneath
