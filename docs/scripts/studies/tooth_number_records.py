"""What the study of tooth numbers measured, and its tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from studies.records import StudyRecords, distinct, number_text, ratio_text, seconds_text, table

FACTORED, WALKED = "convergents, factored", "Stern-Brocot, factored"
CONVERGENTS, PAIRS = "convergents by stage", "Stern-Brocot by stage"
PRODUCTS, TRAIN, EVERY = "sorted products", "in a train", "every set"
METHODS = (FACTORED, WALKED, CONVERGENTS, PAIRS, PRODUCTS, TRAIN, EVERY)
RATIO, CHAIN, FORK = "one ratio", "one output", "two outputs"
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
    """What a complete search costs as its question grows.

    family      one ratio by sorted products, or in a train with one output or two
    stages      of the ratio, or between input and output
    free        free wheels, of which `shared` are met by both outputs
    counts      admissible counts of each wheel
    considered  pairs of sets, or assignments
    seconds     median of rounds, of the share that was run
    megabytes   growth of peak memory
    solutions   that were counted; -1 where the best one was asked for
    share       part of the work that was run: where less than 1, the whole is extrapolated
    """

    family: str
    stages: int
    free: int
    shared: int
    counts: int
    considered: int
    seconds: float | None
    megabytes: float | None
    solutions: int = -1
    share: float = 1.0
    note: str = ""

    @property
    def whole(self) -> float | None:
        """Seconds of the whole, extrapolated in proportion where only a share was run."""
        return None if self.seconds is None else self.seconds / self.share


@dataclass(frozen=True)
class TeethRecords(StudyRecords):
    """All measurements of one run on one machine."""

    rows: Sequence[TeethRecord]
    growth: Sequence[TeethGrowth]

    @property
    def questions(self) -> list[list[TeethRecord]]:
        """The rows, question by question."""
        keys = distinct(row.question for row in self.rows)
        return [[row for row in self.rows if row.question == key] for key in keys]

    def tables(self) -> list[str]:
        """A table of every question, and of growth."""
        lines = []
        for rows in self.questions:
            lines += [*_heading(rows[0]), *_question_table(rows)]
        return [*lines, "## Growth", "", *table(_GROWTH, self.growth)]


def shown(rows: Sequence[TeethRecord]) -> list[TeethRecord]:
    """One question's rows, of "every set" the last alone."""
    every = [row for row in rows if row.method == EVERY]
    return [row for row in rows if row.method != EVERY] + every[-1:]


def times(value: Fraction | None, best: Fraction | None) -> str:
    """An error over the best one."""
    if value is None or best is None:
        return "-"
    if not best:
        return "1" if not value else "-"
    return f"{float(value / best):,.3g}"


def miss_text(value: Fraction | None) -> str:
    """An error in three digits; 0 where it is exactly that."""
    return "none found" if value is None else f"{float(value):.3g}" if value else "0"


def _heading(row: TeethRecord) -> list[str]:
    many = f"{row.stages} stage{'s' if row.stages > 1 else ''}"
    counts = row.wheels if row.wheels == row.pinions else f"{row.wheels} over {row.pinions}"
    return [f"## {row.name}, {many} of {counts}", "", f"{row.considered:,} pairs of sets.", ""]


def _question_table(rows: Sequence[TeethRecord]) -> list[str]:
    proved = next((row for row in rows if row.method == PRODUCTS), rows[-1])
    columns: dict[str, Callable[[TeethRecord], str]] = {
        "way": lambda row: row.method,
        "tries": lambda row: "all" if row.method in (PRODUCTS, TRAIN) else f"{row.tries:,}",
        "time": lambda row: seconds_text(row.seconds),
        "over products": lambda row: ratio_text(row.seconds, proved.seconds),
        "error": lambda row: miss_text(row.miss),
        "over the best": lambda row: times(row.miss, proved.miss),
        "teeth": lambda row: " / ".join(" ".join(map(str, side)) for side in row.teeth) or "-",
        "proved": lambda row: "yes" if row.proved else "no",
    }
    return table(columns, shown(rows))


def _took(row: TeethGrowth) -> str:
    return row.note or seconds_text(row.whole) + (f", from {row.share:.2g} of it" if row.share < 1 else "")


_GROWTH: dict[str, Callable[[TeethGrowth], str]] = {
    "search": lambda row: row.family,
    "stages": lambda row: str(row.stages),
    "free wheels": lambda row: str(row.free),
    "shared": lambda row: str(row.shared),
    "counts": lambda row: str(row.counts),
    "considered": lambda row: f"{row.considered:.1e}",
    "time": _took,
    "memory": lambda row: number_text(row.megabytes, ".0f", " MB"),
    "solutions": lambda row: "the best" if row.solutions < 0 else f"{row.solutions:,}",
}
