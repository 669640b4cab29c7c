"""What the study of uncertainty measured, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, log

from studies.records import StudyRecords

TOGETHER, SINGLY = "together", "one by one"
COUNTS = "tooth counts"
DISPLACED = "displaced flanks"


@dataclass(frozen=True, slots=True)
class RateRecord:
    """One way to many trials.

    family     what is worked out: tooth counts, pairs with errors of place or with every error, displaced flanks
    case       of it
    method     one by one, or a way of doing many together
    trials     worked out, each of `work` units: combinations of counts, or tooth pitches
    seconds    of the processor, median of rounds
    ratio      of the loop's time for as many trials over it, median of the same rounds; 1 for the loop
    megabytes  growth of peak memory
    error      greatest difference from the loop's results: of a play in pitches, of a speed relative; None
               where only decisions are made
    differing  of `checked` trials, those decided otherwise than by the loop
    """

    family: str
    case: str
    method: str
    trials: int
    work: int
    seconds: float
    ratio: float
    megabytes: float | None
    error: float | None = None
    differing: int = 0
    checked: int = 0
    note: str = ""

    @property
    def rate(self) -> float:
        """Units a second."""
        return self.trials * self.work / self.seconds


@dataclass(frozen=True, slots=True)
class ErrorRecord:
    """How far estimates of a probability from so many trials are off.

    case       what jams; `truth` how often it does, and `truth_error` how well that is known
    trials     of each estimate
    estimates  that were made, of trials of their own
    rms        root mean square of their errors, and `expected` of trials that are independent
    covered    share of the 95 percent intervals that hold the truth
    """

    case: str
    truth: float
    truth_error: float
    trials: int
    estimates: int
    rms: float
    expected: float
    covered: float


@dataclass(frozen=True)
class UncertaintyRecords(StudyRecords):
    """All measurements of one run on one machine."""

    rates: Sequence[RateRecord]
    errors: Sequence[ErrorRecord]

    @property
    def slopes(self) -> dict[str, tuple[float, float]]:
        """Of each case, the power of the number of trials with which the error changes, and its standard error."""
        return {
            case: slope([row for row in self.errors if row.case == case])
            for case in dict.fromkeys(row.case for row in self.errors)
        }


def slope(rows: Sequence[ErrorRecord]) -> tuple[float, float]:
    """The power of the number of trials with which the error of estimates changes, and its standard error.

    A straight line through the logarithms. The error of R normal estimates has a logarithm of variance 1 / (2 R), so
    they weigh as R.
    """
    x, y, weights = [log(row.trials) for row in rows], [log(row.rms) for row in rows], [row.estimates for row in rows]
    middle = sum(w * a for w, a in zip(weights, x, strict=True)) / sum(weights)
    square = sum(w * (a - middle) ** 2 for w, a in zip(weights, x, strict=True))
    power = sum(w * (a - middle) * b for w, a, b in zip(weights, x, y, strict=True)) / square
    return power, (2 * square) ** -0.5


def at_one(rows: Sequence[ErrorRecord]) -> float:
    """What the error would be with one trial, by the geometric mean of errors times roots of trials."""
    return exp(sum(log(row.rms) + log(row.trials) / 2 for row in rows) / len(rows))
