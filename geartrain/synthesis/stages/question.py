"""One ratio by stages as a question in plain data: what every piece of the search has to know."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from geartrain.exact import written
from geartrain.synthesis.stages.fit import Fit
from geartrain.synthesis.stages.products import PLAIN, Products, multisets, products_of

Set = tuple[int, ...]


@dataclass(frozen=True)
class Question:
    """Products of `stages` counts on top over as many beneath, within a tolerance of a value.

    value      the wanted ratio, positive
    stages     1 to 5
    top        admissible counts on top, ascending
    beneath    admissible counts beneath, ascending
    fit        conditions on the counts; `largest` is already in the counts
    by         order of the solutions
    best       how many are kept
    tolerance  greatest |error|, as a fraction of the value
    """

    value: Fraction
    stages: int
    top: Set
    beneath: Set
    fit: Fit
    by: str
    best: int
    tolerance: Fraction

    @property
    def plain_integers(self) -> bool:
        """True if int64 holds all products, and float64 holds them exactly."""
        return bool(max(self.top[-1:] + self.beneath[-1:], default=1) ** self.stages < PLAIN)

    @cached_property
    def over(self) -> Products:
        """Products of the counts on top."""
        return products_of(self.top, self.stages, self.plain_integers)

    @cached_property
    def under(self) -> Products:
        """Products of the counts beneath."""
        return products_of(self.beneath, self.stages, self.plain_integers)

    @property
    def reach(self) -> tuple[Fraction, Fraction]:
        """Least and greatest ratio of the products."""
        low, high = Fraction(self.top[0], self.beneath[-1]), Fraction(self.top[-1], self.beneath[0])
        return low**self.stages, high**self.stages

    @cached_property
    def edges(self) -> tuple[Fraction, Fraction]:
        """Least and greatest ratio within the tolerance, and within reach of the products."""
        least, most = self.reach
        return max(self.value * (1 - self.tolerance), least), min(self.value * (1 + self.tolerance), most)

    @property
    def reachable(self) -> bool:
        """True if some ratio of the products may be within the tolerance."""
        low, high = self.edges
        return low <= high

    @property
    def considered(self) -> int:
        """Number of pairs of unordered sets, one on top and one beneath."""
        return multisets(len(self.top), self.stages) * multisets(len(self.beneath), self.stages)

    def beneath_within(self, low: int, high: int) -> tuple[int, int]:
        """The part of [low, high) of products beneath that some product on top can go with."""
        first, last = self.edges
        least, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(low, -(-least * last.denominator // last.numerator)), min(
            high, most * first.denominator // first.numerator + 1
        )

    def tops_for(self, low: int, high: int) -> tuple[int, int]:
        """The half-open range of products on top that products beneath in [low, high) may need."""
        first, last = self.edges
        least, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(-(-low * first.numerator // first.denominator), least), min(
            (high - 1) * last.numerator // last.denominator, most
        ) + 1

    @property
    def loose(self) -> bool:
        """True if every pair of sets within the tolerance is a solution."""
        low, high = self.edges
        # one ring is always possible unless all counts are equal, and then the ratio is 1
        ring_alone = self.fit.internal == 1 and not low <= 1 <= high
        return self.fit.free or (ring_alone and replace(self.fit, internal=0).free)

    def plain(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "value": written(self.value),
            "stages": self.stages,
            "top": list(self.top),
            "beneath": list(self.beneath),
            "fit": self.fit.to_dict(),
            "by": self.by,
            "best": self.best,
            "tolerance": str(self.tolerance),
        }


def question_of(plain: Mapping[str, Any]) -> Question:
    """The question that `Question.plain` wrote."""
    return Question(
        Fraction(plain["value"]),
        plain["stages"],
        tuple(plain["top"]),
        tuple(plain["beneath"]),
        Fit(**plain["fit"]),
        plain["by"],
        plain["best"],
        Fraction(plain["tolerance"]),
    )
