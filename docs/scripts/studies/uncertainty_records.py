"""What the study of uncertainty measured, and its tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import exp, log

from studies.records import StudyRecords, distinct, number_text, seconds_text, table

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


@dataclass(frozen=True, slots=True)
class WorkerRecord:
    """The same trials by so many worker processes.

    seconds   by the clock, median of rounds; `ratio`, how many times as fast as a loop of single solutions
    same      the results are those of one worker, bit for bit
    """

    case: str
    workers: int
    trials: int
    seconds: float
    ratio: float
    same: bool


@dataclass(frozen=True)
class UncertaintyRecords(StudyRecords):
    """All measurements of one run on one machine."""

    rates: Sequence[RateRecord]
    errors: Sequence[ErrorRecord]
    workers: Sequence[WorkerRecord]

    @property
    def slopes(self) -> dict[str, tuple[float, float]]:
        """Of each case, the power of the number of trials with which the error changes, and its standard error."""
        return {
            case: slope([row for row in self.errors if row.case == case])
            for case in distinct(row.case for row in self.errors)
        }

    def tables(self) -> list[str]:
        """Rates by family, errors against trials, workers."""
        lines = []
        for family in distinct(row.family for row in self.rates):
            rows = [row for row in self.rates if row.family == family]
            lines += [f"## {family[0].upper()}{family[1:]}", "", *table(_rates(family), rows)]
        lines += ["## Error against trials", "", *table(_ERRORS, self.errors)]
        lines += [f"{case}: error as trials to the power {a:.3f} +- {b:.3f}." for case, (a, b) in self.slopes.items()]
        return [*lines, "", "## Workers", "", *table(_WORKERS, self.workers)]


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


def _rates(family: str) -> dict[str, Callable[[RateRecord], str]]:
    unit = "combinations" if family == COUNTS else "tooth pitches"
    return {
        "case": lambda row: row.case,
        "way": lambda row: row.method,
        "trials": lambda row: f"{row.trials:,}",
        "time": lambda row: seconds_text(row.seconds),
        f"{unit}/s": lambda row: f"{row.rate:,.3g}",
        "over the loop": lambda row: f"{row.ratio:,.3g}",
        "memory": lambda row: number_text(row.megabytes, ".1f", " MB"),
        "greatest error": lambda row: number_text(row.error, ".1e"),
        "decided otherwise": lambda row: f"{row.differing} of {row.checked}" if row.checked else "-",
    }


_ERRORS: dict[str, Callable[[ErrorRecord], str]] = {
    "case": lambda row: row.case,
    "truth": lambda row: f"{row.truth:.6f}" + (f" +- {row.truth_error:.1e}" if row.truth_error else ""),
    "trials": lambda row: f"{row.trials:,}",
    "estimates": lambda row: f"{row.estimates:,}",
    "rms error": lambda row: f"{row.rms:.2e}",
    "expected": lambda row: f"{row.expected:.2e}",
    "intervals that hold it": lambda row: f"{row.covered:.1%}",
}
_WORKERS: dict[str, Callable[[WorkerRecord], str]] = {
    "case": lambda row: row.case,
    "workers": lambda row: str(row.workers),
    "trials": lambda row: f"{row.trials:,}",
    "time": lambda row: seconds_text(row.seconds),
    "trials a second": lambda row: f"{row.trials / row.seconds:,.3g}",
    "over the loop": lambda row: f"{row.ratio:,.3g}",
    "same results": lambda row: "yes" if row.same else "no",
}
