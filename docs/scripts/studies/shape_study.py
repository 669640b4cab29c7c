"""Tooth shapes: error of the last contact against run time, for each of the six problems and for extreme pairs.

The three criteria, spur and bevel, by marching from a series beside the pitch point (explicit Runge-Kutta pairs, and
implicit), by collocation with a number of nodes, by the package's own choice of nodes, and for least friction by its
closed form and by a direct search over a path of short straight pieces. The truth is in `shapes_truth`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from geartrain.errors import GearTrainError
from studies.measurement import Step, taken, timed
from studies.records import StudyRecords
from studies.shape_cases import CASES, EXTREMES, ShapeCase
from studies.shape_methods import collocated, marched, nodes_of, packaged, searched

_PAIRS = ("RK45", "DOP853", "Radau", "BDF")
_TOLERANCES, _FEW = tuple(10.0**-n for n in range(3, 14, 2)), (1e-4, 1e-8, 1e-12)
_NODES, _FEW_NODES = (4, 6, 8, 10, 12, 16, 20, 24, 32, 48, 96), (6, 12, 24)
_CELLS, _FEW_CELLS = (10, 20, 40), (10,)
_START = 1e-3  # of the arc: where marching starts, its series to d^2


@dataclass(frozen=True, slots=True)
class WorkRecord:
    """One way to the last contact of one shape, at one setting.

    setting   tolerance, nodes, cells, or distance of the start over the arc
    error     of the distance of the last contact, relative; None where the way fails
    seconds   for one solution
    """

    problem: str
    method: str
    setting: float
    error: float | None
    seconds: float


@dataclass(frozen=True, slots=True)
class ExtremeRecord:
    """One extreme pair by one way: errors and seconds as in `WorkRecord`; `nodes` where there are any."""

    case: str
    method: str
    error: float | None
    seconds: float
    nodes: int = 0


@dataclass(frozen=True)
class ShapeRecords(StudyRecords):
    """All measurements of one run on one machine."""

    work: Sequence[WorkRecord]
    extremes: Sequence[ExtremeRecord]


def quickest(rows: Sequence[WorkRecord], accuracy: float) -> WorkRecord | None:
    """The row of least time among those with an error of at most `accuracy`."""
    good = [row for row in rows if row.error is not None and row.error <= accuracy]
    return min(good, key=lambda row: row.seconds, default=None)


# measurements --------------------------------------------------------------------------------------------------------


def shapes(quick: bool = False) -> ShapeRecords:
    """Measure all ways (`quick`: few settings, few extreme pairs)."""
    return ShapeRecords.sorted_by_kind("Tooth shapes: error of the last contact against run time", taken(_steps(quick)))


def _steps(quick: bool) -> Iterator[Step]:
    rounds = 1 if quick else 5
    tolerances, nodes = (_FEW, _FEW_NODES) if quick else (_TOLERANCES, _NODES)
    for case in CASES:
        yield f"{case.name}: package", partial(_work, case, "package", (0.0,), rounds)
        for method in _PAIRS:
            yield f"{case.name}: {method}", partial(_work, case, method, tolerances, rounds)
        if case.kind == "friction":
            cells = _FEW_CELLS if quick else _CELLS
            yield f"{case.name}: search", partial(_work, case, "direct search", cells, 1)
            continue
        yield f"{case.name}: collocation", partial(_work, case, "collocation", nodes, rounds)
    for case in EXTREMES[:3] if quick else EXTREMES:
        yield case.name, partial(_extreme, case, rounds)


def _work(case: ShapeCase, method: str, settings: Sequence[float], rounds: int) -> list[WorkRecord]:
    """One way at each of its settings."""
    ways: dict[str, Callable[[float], float]] = {
        "package": lambda _: packaged(case),
        "collocation": lambda nodes: collocated(case, int(nodes)),
        "direct search": lambda cells: searched(case, int(cells)),
    }
    way = ways.get(method, lambda tolerance: marched(case, method, tolerance, _START))
    return [
        WorkRecord(case.name, method, setting, *_measured(case, partial(way, setting), rounds)) for setting in settings
    ]


def _measured(case: ShapeCase, way: Callable[[], float], rounds: int) -> tuple[float | None, float]:
    """Relative error, and the least time of some rounds, for one solution; None and 0 where the way fails."""
    times, end = [], float("nan")
    for _ in range(rounds):
        try:
            seconds, end = timed(way)
        except (GearTrainError, ArithmeticError, ValueError):
            return None, 0.0
        times.append(seconds)
    error = abs(end / case.end - 1)
    return (error if error == error else None), min(times)


def _extreme(case: ShapeCase, rounds: int) -> list[ExtremeRecord]:
    """The package's own way, and marching at the sharpest tolerance."""
    rows = [ExtremeRecord(case.name, "package", *_measured(case, partial(packaged, case), rounds), nodes_of(case))]
    for start in (1e-2, 1e-4):
        way = partial(marched, case, "DOP853", 1e-13, start)
        rows.append(ExtremeRecord(case.name, f"DOP853 from {start:.0e}", *_measured(case, way, rounds)))
    return rows
