"""What the study of tooth numbers measured, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from studies.records import StudyRecords

FACTORED, WALKED = "convergents, factored", "Stern-Brocot, factored"
PAIRS = "Stern-Brocot by stage"
PRODUCTS, TRAIN, EVERY = "sorted products", "in a train", "every set"
METHODS = (FACTORED, WALKED, PAIRS, PRODUCTS, TRAIN, EVERY)
RATIO, CHAIN = "one ratio", "in a train"
PRINTED = "one ratio, all within 1e-6"
"""The question whose time by brute force is printed: 13.368267, three stages, wheels 30:100, pinions 15:40."""


@dataclass(frozen=True, slots=True)
class TeethRecord:
    """A way to tooth numbers on one question; several rows where it can be given more or less time.

    name        of the ratio, `wanted` the ratio as an exact fraction
    wheels      counts on top, `pinions` those beneath, first:last
    considered  pairs of unordered sets that there are
    tries       candidates looked at
    seconds     median of rounds; since the start for "every set", which runs once
    error       |ratio / wanted - 1| of the best found, an exact fraction; None where nothing was found
    teeth       counts on top, and beneath
    proved      True if the way shows that no set is nearer
    """

    name: str
    wanted: str
    stages: int
    wheels: str
    pinions: str
    considered: int
    method: str
    tries: int
    seconds: float
    error: str | None
    teeth: Sequence[Sequence[int]]
    proved: bool

    @property
    def miss(self) -> Fraction | None:
        """The error."""
        return None if self.error is None else Fraction(self.error)

    @property
    def question(self) -> tuple[str, int, str, str]:
        """What is asked: rows with the same can be compared."""
        return self.name, self.stages, self.wheels, self.pinions


@dataclass(frozen=True, slots=True)
class TeethGrowth:
    """Cost of a complete search as its question grows.

    family      one ratio by sorted products, or in a train
    stages      of the ratio, or between input and output
    counts      admissible counts of each wheel
    considered  pairs of sets, or assignments
    seconds     median of rounds
    megabytes   growth of peak memory
    solutions   that were counted; -1 if only the best one was requested
    """

    family: str
    stages: int
    counts: int
    considered: int
    seconds: float | None
    megabytes: float | None
    solutions: int = -1


@dataclass(frozen=True)
class TeethRecords(StudyRecords):
    """All measurements of one run on one machine."""

    rows: Sequence[TeethRecord]
    growth: Sequence[TeethGrowth]

    @property
    def questions(self) -> list[list[TeethRecord]]:
        """The rows, question by question."""
        keys = dict.fromkeys(row.question for row in self.rows)
        return [[row for row in self.rows if row.question == key] for key in keys]
