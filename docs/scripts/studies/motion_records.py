"""What the study of motion measured, and its tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from studies.records import StudyRecords, number_text, seconds_text, table

BOUND, INDEPENDENT = "sum of ranges", "independent rms"
NOMINAL, LAGGED = "superposition", "superposition with lag"
DIRECT, TABULATED = "direct", "tabulated"
FIXED, ADAPTIVE = "marching", "marching, RK45"
TOLERANCES = (1e-6, 1e-9, 1e-12)
TABLES = tuple(f"{TABULATED}, {tolerance:.0e}" for tolerance in TOLERANCES)
PER_POSITION = (DIRECT, *TABLES, NOMINAL, LAGGED)


@dataclass(frozen=True, slots=True)
class MotionRecord:
    """A method on a train.

    links        that an error reaches and an output depends on
    seconds      for all positions, without preparation
    megabytes    peak of memory that the positions take
    error, rms   greatest and root mean square error (deg) of the output that has the greatest, `output`; that of the
                 peak-to-peak ripple for the sum of ranges, and that of its rms for independent phases
    ratio        seconds over those of the direct composition in the same round
    prepared     seconds from the declaration to the first position, every law and window found anew
    positions    that were worked out; marching is extrapolated from fewer to all
    """

    family: str
    links: int
    method: str
    seconds: float | None = None
    megabytes: float | None = None
    error: float | None = None
    note: str = ""
    rms: float | None = None
    ratio: float | None = None
    prepared: float | None = None
    positions: int = 0
    output: str = ""

    @property
    def rate(self) -> float | None:
        """Positions times lively links a second."""
        return self.positions * self.links / self.seconds if self.seconds and self.positions else None


@dataclass(frozen=True, slots=True)
class TrainRecord:
    """One train of the run.

    turns     of the input, over `positions`
    rippling  pairs and couplings whose errors reach an output; `ideal`, those of the train that have no law
    outputs   name -> peak-to-peak and rms ripple (deg)
    peaks     positions -> peak memory (MB) of the direct composition
    sample    random positions at which the direct composition is judged
    """

    family: str
    turns: float
    positions: int
    links: int
    rippling: Sequence[str]
    ideal: Sequence[str]
    outputs: dict[str, dict[str, float]]
    peaks: dict[str, float]
    sample: int


@dataclass(frozen=True, slots=True)
class GrowthRecord:
    """A chain of so many pairs: seconds to declare it, to find windows, to spread errors and build laws, and to run."""

    pairs: int
    positions: int
    chunk: int
    declared: float
    windows: float
    prepared: float
    seconds: float

    @property
    def rate(self) -> float:
        """Positions times links a second."""
        return self.positions * self.pairs / self.seconds


@dataclass(frozen=True)
class MotionRecords(StudyRecords):
    """All measurements of one run: a table a train, and one of the chains."""

    rows: Sequence[MotionRecord]
    trains: Sequence[TrainRecord] = ()
    growth: Sequence[GrowthRecord] = ()

    def tables(self) -> list[str]:
        """One table for each train, and the growth with the number of pairs."""
        return [*self.tables_of_trains(), "## Chains of pairs", "", *self.table_of_chains()]

    def table_of_chains(self) -> list[str]:
        """How preparation and run grow with the pairs of a chain."""
        return table(_CHAINS, self.growth)

    def tables_of_trains(self) -> list[str]:
        """What each train does, and all methods on it."""
        lines = []
        for train in self.trains:
            ripple = (f"{name} {each['peak_to_peak']:.4g} ({each['rms']:.4g})" for name, each in train.outputs.items())
            lines += [
                f"## {train.family}",
                "",
                f"{train.positions} positions over {train.turns:g} turns, {len(train.rippling)} rippling pairs, "
                f"{train.links} lively links.",
                f"Peak-to-peak (rms) ripple in degrees: {', '.join(ripple)}.",
                "",
                *table(_METHODS, [row for row in self.rows if row.family == train.family]),
            ]
        return lines


_METHODS: dict[str, Callable[[MotionRecord], str]] = {
    "method": lambda row: row.method,
    "greatest error": lambda row: number_text(row.error, ".1e", " deg"),
    "rms error": lambda row: number_text(row.rms, ".1e", " deg"),
    "of": lambda row: row.output,
    "time": lambda row: seconds_text(row.seconds),
    "time over direct": lambda row: number_text(row.ratio, ".3g"),
    "links/s": lambda row: number_text(row.rate, ".2g"),
    "prepared": lambda row: seconds_text(row.prepared),
    "memory": lambda row: number_text(row.megabytes, ".1f", " MB"),
    "": lambda row: row.note,
}
_CHAINS: dict[str, Callable[[GrowthRecord], str]] = {
    "pairs": lambda row: str(row.pairs),
    "declare": lambda row: seconds_text(row.declared),
    "windows": lambda row: seconds_text(row.windows),
    "spread and laws": lambda row: seconds_text(row.prepared),
    "positions": lambda row: str(row.positions),
    "run": lambda row: seconds_text(row.seconds),
    "links/s": lambda row: f"{row.rate:.2g}",
    "positions at once": lambda row: str(row.chunk),
}
