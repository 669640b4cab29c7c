"""Document on the error and run time of the solution methods for one train."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from geartrain.analysis.accuracy import MethodAccuracy, TrainAccuracy
from geartrain.numerics.results import Result
from geartrain.report.document import Document, Section, Table

_LEAD = (
    "Each time is the minimum of repeated runs on this machine; compare times only within a stage. `prepared` is the "
    "time of preparations that are done once."
)
_HEADER = ("method", "prepared (ms)", "time (ms)", "over the fastest", "error", "compared with")


@dataclass(frozen=True, slots=True)
class AccuracyReport(Result):
    """Errors and run times of the solution methods for a train in every requested state."""

    PAGE = "report.accuracy_report:describe_accuracy"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    states: tuple[TrainAccuracy, ...]
    """Errors and run times of the solution methods in each state."""


def describe_accuracy(found: AccuracyReport) -> Document:
    """Return a document with a section for each measured stage in each state, and one on the stages left out."""
    sections = [section for each in found.states for section in _sections(each)]
    return Document(f"Error against run time: {found.name}", [_LEAD], sections)


def accuracy_document(found: TrainAccuracy) -> Document:
    """Return the output of `geartrain inspect bench` for one state as a document."""
    name = "" if found._declaration is None else found._declaration.name
    return describe_accuracy(AccuracyReport(name, "", (found,)))


def _sections(found: TrainAccuracy) -> Iterator[Section]:
    state = "" if found.state is None else f"State {found.state}: "
    # stages in the order in which they were measured
    for stage in dict.fromkeys(row.stage for row in found.methods):
        table = Table(_HEADER, [_cells(row) for row in found.methods if row.stage == stage])
        yield Section(f"{state}{stage}", (), [table])
    if found.neglected:
        yield Section(f"{state}omitted", [f"{stage}: {why}." for stage, why in found.neglected.items()])


def _cells(row: MethodAccuracy) -> list[str]:
    prepared, seconds = ("-" if each is None else f"{1e3 * each:.3g}" for each in (row.prepared, row.seconds))
    error = "-" if row.error is None else f"{row.error:.1e} {row.unit.replace('relative', '')}".strip()
    return [row.method, prepared, seconds, f"{row.ratio:.3g}", error, row.reference]
