"""Error against run time of the methods on one train, as a document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.analysis import MethodAccuracy, TrainAccuracy
from geartrain.numerics.plain_data import Result
from geartrain.report.document import Document, Section, Table

_LEAD = (
    "Times are the best of repeats on this machine, or of one run where that takes long; compare them within a stage "
    "only, as ratios to its cheapest way. `prepared` is what comes once, before: laws, windows of clearance, tables."
)


@dataclass(frozen=True, slots=True)
class AccuracyReport(Result):
    """Methods on a train in every state that was asked for."""

    name: str
    title: str
    states: tuple[TrainAccuracy, ...]


def describe_accuracy(found: AccuracyReport) -> Document:
    """A section for each state with a table of each stage, and what the train does not have."""
    sections = [section for each in found.states for section in _sections(each)]
    return Document(f"Error against run time: {found.name}", [_LEAD], sections)


def _sections(found: TrainAccuracy) -> list[Section]:
    state = "" if found.state is None else f"State {found.state}: "
    stages = dict.fromkeys(row.stage for row in found.methods)
    sections = [
        Section(f"{state}{stage}", (), [_table([row for row in found.methods if row.stage == stage])])
        for stage in stages
    ]
    left_out = [f"{stage}: {why}." for stage, why in found.left_out.items()]
    return [*sections, Section(f"{state}left out", left_out)] if left_out else sections


def _table(rows: Sequence[MethodAccuracy]) -> Table:
    header = ["method", "prepared", "time", "over the cheapest", "error", "held against"]
    cells = [
        [row.method, _time(row.prepared), _time(row.seconds), f"{row.ratio:.3g}", _error(row), row.reference]
        for row in rows
    ]
    if any(row.evaluations is not None for row in rows):
        header.append("evaluations")
        for row, line in zip(rows, cells, strict=True):
            line.append("-" if row.evaluations is None else str(row.evaluations))
    return Table(header, cells)


def _error(row: MethodAccuracy) -> str:
    if row.error is None:
        return "-"
    return "0" if row.error == 0 else f"{row.error:.1e} {'' if row.unit == 'relative' else row.unit}".strip()


def _time(seconds: float | None) -> str:
    """Three digits, in milliseconds below a second."""
    if seconds is None:
        return "-"
    return f"{seconds:.3g} s" if seconds >= 1 else f"{seconds * 1e3:.3g} ms"
