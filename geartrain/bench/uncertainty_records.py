"""What the benchmark of uncertainty measured, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import exp, log
from typing import Any

from geartrain.bench.timing import seconds_text

TOGETHER, SINGLY = "together", "one by one"
COUNTS = "tooth counts"


@dataclass(frozen=True, slots=True)
class RateRecord:
    """One way to many trials.

    family     what is worked out: tooth counts, pairs with errors of place or with every error
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


@dataclass(frozen=True, slots=True)
class UncertaintyRecords:
    """All measurements of one run on one machine."""

    title: str
    rates: Sequence[RateRecord]
    errors: Sequence[ErrorRecord]
    workers: Sequence[WorkerRecord]

    @property
    def slopes(self) -> dict[str, tuple[float, float]]:
        """Of each case, the power of the number of trials with which the error changes, and its standard error."""
        return {case: slope([row for row in self.errors if row.case == case]) for case in _cases(self.errors)}

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> UncertaintyRecords:
        """What `to_dict` gave."""
        return cls(
            data["title"],
            [RateRecord(**row) for row in data["rates"]],
            [ErrorRecord(**row) for row in data["errors"]],
            [WorkerRecord(**row) for row in data["workers"]],
        )

    def to_markdown(self) -> str:
        """Rates by family, errors against trials, workers."""
        lines = [f"# {self.title}", ""]
        for family in dict.fromkeys(row.family for row in self.rates):
            lines += [
                f"## {family[0].upper()}{family[1:]}",
                "",
                *_rate_table([r for r in self.rates if r.family == family]),
            ]
        lines += ["## Error against trials", "", *_error_table(self.errors)]
        lines += [f"{case}: error as trials to the power {a:.3f} +- {b:.3f}." for case, (a, b) in self.slopes.items()]
        return "\n".join([*lines, "", "## Workers", "", *_worker_table(self.workers)])


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


def _cases(rows: Sequence[ErrorRecord]) -> list[str]:
    return list(dict.fromkeys(row.case for row in rows))


def _rate_table(rows: Sequence[RateRecord]) -> list[str]:
    unit = "combinations" if rows[0].family == COUNTS else "tooth pitches"
    lines = [
        f"| case | way | trials | time | {unit}/s | over the loop | memory | greatest error | decided otherwise |",
        "|---" * 9 + "|",
    ]
    for row in rows:
        memory = "-" if row.megabytes is None else f"{row.megabytes:.1f} MB"
        error = "-" if row.error is None else f"{row.error:.1e}"
        other = f"{row.differing} of {row.checked}" if row.checked else "-"
        lines.append(
            f"| {row.case} | {row.method} | {row.trials:,} | {seconds_text(row.seconds)} | {row.rate:,.3g} "
            f"| {row.ratio:,.3g} | {memory} | {error} | {other} |"
        )
    return [*lines, ""]


def _error_table(rows: Sequence[ErrorRecord]) -> list[str]:
    lines = ["| case | truth | trials | estimates | rms error | expected | intervals that hold it |", "|---" * 7 + "|"]
    for row in rows:
        known = f"{row.truth:.6f}" + (f" +- {row.truth_error:.1e}" if row.truth_error else "")
        lines.append(
            f"| {row.case} | {known} | {row.trials:,} | {row.estimates:,} | {row.rms:.2e} | {row.expected:.2e} "
            f"| {row.covered:.1%} |"
        )
    return [*lines, ""]


def _worker_table(rows: Sequence[WorkerRecord]) -> list[str]:
    lines = ["| case | workers | trials | time | trials a second | over the loop | same results |", "|---" * 7 + "|"]
    for row in rows:
        same = "yes" if row.same else "no"
        lines.append(
            f"| {row.case} | {row.workers} | {row.trials:,} | {seconds_text(row.seconds)} "
            f"| {row.trials / row.seconds:,.3g} | {row.ratio:,.3g} | {same} |"
        )
    return [*lines, ""]
