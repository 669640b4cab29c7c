"""One ratio by stages as a question in plain data: the ratio, and the constraints on its stages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Result
from geartrain.search.ratio.product_windows import PLAIN, ProductWindows, multisets, products_of


@dataclass(frozen=True, slots=True)
class StageConstraints(Result):
    """Conditions on the counts of a train of stages, and on how they can be paired; all in one and the same pairing.

    Attributes
    ----------
    hunting : bool
        The two counts of every stage have no common divisor, so that every tooth meets every tooth of its mate.
    reverted : bool
        All stages have one centre distance in one module: equal sums of their counts, or differences for a stage with
        a ring.
    different : bool
        No count is there twice.
    internal : int
        How many of the meshes are with a ring, 0 to the number of stages. Such a mesh keeps the sense, the others
        reverse it; its ring has more teeth than its pinion.
    least_total, most_total : int, optional
        Least and greatest sum of all counts.
    largest : int, optional
        Greatest count.

    Examples
    --------
    >>> StageConstraints(reverted=True, internal=1).sense(stages=2)
    -1
    """

    hunting: bool = False
    reverted: bool = False
    different: bool = False
    internal: int = 0
    least_total: int | None = None
    most_total: int | None = None
    largest: int | None = None

    def sense(self, stages: int) -> int:
        """1 if output and input turn the same way, -1 if not.

        Parameters
        ----------
        stages : int
            Gear pairs one after the other.
        """
        return -1 if (stages - self.internal) % 2 else 1

    @property
    def pairs_matter(self) -> bool:
        """True if a condition is on the pairing, and not on the counts alone."""
        return self.hunting or self.reverted or self.internal > 0

    @property
    def totals(self) -> tuple[int, int]:
        """Least and greatest sum of all counts."""
        least = 0 if self.least_total is None else self.least_total
        return least, (1 << 62) if self.most_total is None else self.most_total

    @property
    def totals_matter(self) -> bool:
        """True if the sum of all counts is bounded."""
        return self.least_total is not None or self.most_total is not None

    @property
    def free(self) -> bool:
        """True if every unordered pair of sets will do, `largest` aside."""
        return not (self.pairs_matter or self.different or self.totals_matter)

    def check(self, stages: int) -> None:
        """Refuse what no train of so many stages can be asked, by a `QuestionError`.

        Parameters
        ----------
        stages : int
            Gear pairs one after the other.
        """
        if not 0 <= self.internal <= stages:
            raise QuestionError(
                Problem(
                    f"internal is {self.internal}",
                    f"of {stages} meshes, 0 to {stages} can be with a ring",
                    f"give internal from 0 to {stages}",
                )
            )
        least, most = self.totals
        if least > most:
            what = f"least_total is {least}, most_total is {most}"
            raise QuestionError(Problem(what, "no sum is between them", "exchange them, or leave one out"))


Set = tuple[int, ...]


@dataclass(frozen=True)
class StageProblem:
    """Products of `stages` counts on top over as many beneath, within a tolerance of a value.

    value      the wanted ratio, positive
    stages     1 to 5
    top        admissible counts on top, ascending
    beneath    admissible counts beneath, ascending
    fit        conditions on the counts; `largest` is already applied to `top` and `beneath`
    by         order of the solutions
    best       how many are kept
    tolerance  greatest |error|, as a fraction of the value
    """

    value: Fraction
    stages: int
    top: Set
    beneath: Set
    fit: StageConstraints
    by: str
    best: int
    tolerance: Fraction

    @property
    def plain_integers(self) -> bool:
        """True if int64 holds all products, and float64 holds them exactly."""
        return bool(max(self.top[-1:] + self.beneath[-1:], default=1) ** self.stages < PLAIN)

    @cached_property
    def over(self) -> ProductWindows:
        """Products of the counts on top."""
        return products_of(self.top, self.stages, self.plain_integers)

    @cached_property
    def under(self) -> ProductWindows:
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
            "value": fraction_text(self.value),
            "stages": self.stages,
            "top": list(self.top),
            "beneath": list(self.beneath),
            "fit": self.fit.to_dict(),
            "by": self.by,
            "best": self.best,
            "tolerance": str(self.tolerance),
        }


def stage_problem_of(plain: Mapping[str, Any]) -> StageProblem:
    """The question that `StageProblem.plain` wrote."""
    return StageProblem(
        Fraction(plain["value"]),
        plain["stages"],
        tuple(plain["top"]),
        tuple(plain["beneath"]),
        StageConstraints(**plain["fit"]),
        plain["by"],
        plain["best"],
        Fraction(plain["tolerance"]),
    )
