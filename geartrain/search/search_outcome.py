"""Results of a search for tooth counts, and the reasons for which candidates were rejected."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, brief


@dataclass(frozen=True, slots=True)
class Shortfall(Result):
    """Numbers of candidates that a search rejected, by reason. They explain an empty or short list of solutions."""

    KEYS = ("considered", Key("removed", "removals"), "nearest", "advice")

    considered: int = 0
    """Number of candidates before any constraint is applied."""
    removed: Mapping[str, int] | None = None
    """Number of rejected candidates by reason. A candidate is counted under the constraint at which the search
    rejected it.
    """
    nearest: str = ""
    """Description of the rejected candidate with the smallest violation of a constraint, with its tooth counts and
    ratio error, or of a constraint that no candidate satisfies. It is "" if there is a solution or the search was
    interrupted.
    """
    advice: str = ""
    """Suggestions of constraints to relax, with the effect of each; "" if there is a solution."""

    @property
    def removals(self) -> Mapping[str, int]:
        """Number of rejected candidates by reason, as in `removed`; an empty mapping if they were not counted."""
        return self.removed or {}  # None means that rejected candidates were not counted


class CountSizes(ABC):
    """Base class of results with tooth counts. It provides the sum, the maximum, and the number of distinct tooth
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
    """Gear pairs in series that approximate a ratio: the tooth counts of the numerator (`top`) and of the denominator
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
    """Tooth counts of the numerator, ascending, one for each stage."""
    beneath: tuple[int, ...]
    """Tooth counts of the denominator, ascending, one for each stage."""
    ratio: Fraction
    """Product of `top` divided by product of `beneath`, exact and positive."""
    error: Fraction
    """Relative error: `ratio` divided by the magnitude of the requested ratio, minus 1; exact."""
    pairs: tuple[tuple[int, int], ...]
    """Tooth counts (numerator, denominator) of each stage, in the feasible pairing with the most coprime stages."""

    def _summary(self) -> str:
        teeth = " ".join(f"{top}/{beneath}" for top, beneath in self.pairs)
        return f"{teeth} = {brief(self.ratio)}, error {float(self.error):.3g}"

    @property
    def teeth(self) -> tuple[int, ...]:
        """All tooth counts: the numerator, then the denominator."""
        return self.top + self.beneath

    @property
    def counts(self) -> tuple[int, ...]:
        """All tooth counts: the numerator, then the denominator."""
        return self.teeth

    @property
    def sides(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Tooth counts of the two sides of the ratio: numerator, denominator."""
        return self.top, self.beneath
