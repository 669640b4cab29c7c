"""What the search for stages found."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from geartrain.synthesis.counts import Runs
from geartrain.synthesis.result import Shortfall, Stages
from geartrain.synthesis.stages.fit import Fit
from geartrain.synthesis.targets import Wanted


@dataclass(frozen=True, slots=True)
class StageFindings:
    """Solutions of one ratio by stages: pairs of unordered sets of counts.

    wanted      the ratio
    stages      number of stages
    top         admissible counts on top, ascending
    beneath     admissible counts beneath, ascending
    fit         conditions on the counts
    by          the order of `solutions`
    tolerance   the greatest |error|, as a fraction of the ratio: the one asked for, or one that proves the list
    complete    True if everything within the tolerance was looked at; False if the search was interrupted
    count       number of solutions within the tolerance, exact if `complete`
    solutions   the best of them
    shortfall   where the other pairs of sets went
    note        what was assumed, in words; empty if nothing
    """

    wanted: Wanted
    stages: int
    top: tuple[int, ...]
    beneath: tuple[int, ...]
    fit: Fit
    by: str
    tolerance: Fraction
    complete: bool
    count: int
    solutions: tuple[Stages, ...]
    shortfall: Shortfall
    note: str = ""

    @property
    def considered(self) -> int:
        """Number of pairs of unordered sets that the admissible counts make."""
        return self.shortfall.considered

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[Stages]:
        return iter(self.solutions)

    def __getitem__(self, at: int) -> Stages:
        return self.solutions[at]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "wanted": self.wanted.to_dict(),
            "stages": self.stages,
            "top": str(Runs.of(self.top)) if self.top else "",
            "beneath": str(Runs.of(self.beneath)) if self.beneath else "",
            "fit": self.fit.to_dict(),
            "order": self.by,
            "tolerance": float(self.tolerance),
            "complete": self.complete,
            "count": self.count,
            "considered": self.considered,
            "solutions": [solution.to_dict() for solution in self.solutions],
            "shortfall": self.shortfall.to_dict(),
            "note": self.note,
        }
