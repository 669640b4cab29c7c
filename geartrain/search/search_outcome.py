"""What a search for tooth numbers found, and why it found no more."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, brief


@dataclass(frozen=True, slots=True)
class Shortfall(Result):
    """Where candidates went: the infeasibility certificate of an empty or short list.

    See Also
    --------
    geartrain.search.find_stages, geartrain.search.find_sets : whose findings hold one.
    """

    KEYS = ("considered", Key("removed", "removals"), "nearest", "advice")

    considered: int = 0
    """Candidates there were before any constraint."""
    removed: Mapping[str, int] | None = None
    """Reason -> candidates it removed; each candidate is charged to the first reason that refuses it."""
    nearest: str = ""
    """The nearest miss in words, with its teeth and its error; empty where something was found."""
    advice: str = ""
    """What to relax, and what that would give; empty where something was found."""

    @property
    def removals(self) -> Mapping[str, int]:
        """The same; nothing where it was not counted."""
        return self.removed or {}


class CountSizes(ABC):
    """How large tooth counts are, taken together."""

    __slots__ = ()

    @property
    @abstractmethod
    def counts(self) -> Collection[int]:
        """All the counts."""

    @property
    def total(self) -> int:
        """Their sum."""
        return sum(self.counts)

    @property
    def largest(self) -> int:
        """The greatest; 0 where there are none."""
        return max(self.counts, default=0)

    @property
    def distinct(self) -> int:
        """How many different ones there are."""
        return len(set(self.counts))


@dataclass(frozen=True, slots=True)
class GearStages(CountSizes, Result):
    """Tooth numbers of one ratio: the counts on top over the counts beneath, each an unordered set.

    See Also
    --------
    find_stages : finds them.
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
    """Counts on top, ascending, one for each stage."""
    beneath: tuple[int, ...]
    """Counts beneath, ascending, one for each stage."""
    ratio: Fraction
    """Product of `top` over product of `beneath`, exact; positive."""
    error: Fraction
    """`ratio` over the wanted magnitude, less 1; exact."""
    pairs: tuple[tuple[int, int], ...]
    """The stages as they are best paired: count on top, count beneath."""

    def _summary(self) -> str:
        teeth = " ".join(f"{top}/{beneath}" for top, beneath in self.pairs)
        return f"{teeth} = {brief(self.ratio)}, error {float(self.error):.3g}"

    @property
    def teeth(self) -> tuple[int, ...]:
        """All counts, those on top first."""
        return self.top + self.beneath

    @property
    def counts(self) -> tuple[int, ...]:
        """All counts."""
        return self.teeth

    @property
    def sides(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The counts on top, and those beneath."""
        return self.top, self.beneath
