"""What the benchmark of motion measured, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from geartrain.bench.record import Record, Records

BOUND, INDEPENDENT = "sum of ranges", "independent rms"
NOMINAL, LAGGED = "superposition", "superposition with lag"
DIRECT, TABULATED = "direct", "tabulated"
FIXED, ADAPTIVE = "marching", "marching, RK45"
TOLERANCES = (1e-6, 1e-9, 1e-12)
TABLES = tuple(f"{TABULATED}, {tolerance:.0e}" for tolerance in TOLERANCES)
PER_POSITION = (DIRECT, *TABLES, NOMINAL, LAGGED)


@dataclass(frozen=True, slots=True)
class MotionRecord(Record):
    """A method on a train: `links` counts the lively ones, `seconds` is for all positions, without preparation.

    error, rms   greatest and root mean square error (deg) of the output that has the greatest, `output`; that of the
                 peak-to-peak ripple for the sum of ranges, and that of its rms for independent phases
    ratio        seconds over those of the direct composition in the same round
    prepared     seconds from the declaration to the first position, every law and window found anew
    positions    that were worked out; marching is extrapolated from fewer to all
    """

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


@dataclass(frozen=True, slots=True)
class MotionRecords(Records):
    """All measurements of one run: a table a train, and one of the chains."""

    rows: Sequence[MotionRecord]
    trains: Sequence[TrainRecord] = ()
    growth: Sequence[GrowthRecord] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        more = {"trains": [asdict(each) for each in self.trains], "growth": [asdict(each) for each in self.growth]}
        return {"title": self.title, "rows": [asdict(row) for row in self.rows], **more}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> MotionRecords:
        """What `to_dict` gave."""
        return cls(
            data["title"],
            [MotionRecord(**row) for row in data["rows"]],
            [TrainRecord(**row) for row in data["trains"]],
            [GrowthRecord(**row) for row in data["growth"]],
        )

    def to_markdown(self) -> str:
        """One table for each train, and the growth with the number of pairs."""
        lines = [f"# {self.title}", ""]
        for train in self.trains:
            ripple = (f"{name} {each['peak_to_peak']:.4g} ({each['rms']:.4g})" for name, each in train.outputs.items())
            lines += [
                f"## {train.family}",
                "",
                f"{train.positions} positions over {train.turns:g} turns, {len(train.rippling)} rippling pairs, "
                f"{train.links} lively links.",
                f"Peak-to-peak (rms) ripple in degrees: {', '.join(ripple)}.",
                "",
                *_table([row for row in self.rows if row.family == train.family]),
            ]
        return "\n".join([*lines, "## Chains of pairs", "", *_growth_table(self.growth)])


def _table(rows: Sequence[MotionRecord]) -> list[str]:
    lines = [
        "| method | greatest error | rms error | of | time | time over direct | links/s | prepared | memory | |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        errors = ("-" if each is None else f"{each:.1e} deg" for each in (row.error, row.rms))
        times = (f"{_seconds(row.seconds)} | {_number(row.ratio)} | {_number(row.rate, '.2g')}", _seconds(row.prepared))
        memory = "-" if row.megabytes is None else f"{row.megabytes:.1f} MB"
        lines.append(f"| {row.method} | {' | '.join((*errors, row.output, *times, memory))} | {row.note} |")
    return [*lines, ""]


def _growth_table(rows: Sequence[GrowthRecord]) -> list[str]:
    lines = [
        "| pairs | declare | windows | spread and laws | positions | run | links/s | positions at once |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        times = (_seconds(each) for each in (row.declared, row.windows, row.prepared))
        rest = (str(row.positions), _seconds(row.seconds), f"{row.rate:.2g}", str(row.chunk))
        lines.append(f"| {row.pairs} | {' | '.join((*times, *rest))} |")
    return [*lines, ""]


def _seconds(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value * 1e3:.3g} ms" if value < 1 else f"{value:.3g} s" if value < 1000 else f"{value:.0f} s"


def _number(value: float | None, form: str = ".3g") -> str:
    return "-" if value is None else f"{value:{form}}"
