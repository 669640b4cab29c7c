"""What is asked of the stages of one ratio beyond the ratio itself."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from geartrain.errors import Problem, QuestionError


@dataclass(frozen=True, slots=True)
class Fit:
    """Conditions on the counts of a train of stages, and on how they can be paired; all in one and the same pairing.

    hunting      the two counts of every stage have no common divisor
    reverted     all stages have one centre distance in one module: equal sums of their counts, or, for a stage with a
                 ring, that difference
    different    no count is there twice
    internal     how many of the meshes are with a ring: such a mesh keeps the sense, the others reverse it, and its
                 ring has more teeth than its pinion
    least_total  least sum of all counts
    most_total   greatest sum of all counts
    largest      greatest count
    """

    hunting: bool = False
    reverted: bool = False
    different: bool = False
    internal: int = 0
    least_total: int | None = None
    most_total: int | None = None
    largest: int | None = None

    def sense(self, stages: int) -> int:
        """1 if output and input turn the same way, -1 if not."""
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
        """`QuestionError` for what no train of so many stages can be asked."""
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

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return asdict(self)
