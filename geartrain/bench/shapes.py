"""Tooth shapes: error of the last contact against run time, for each of the six problems and for extreme pairs.

The three criteria, spur and bevel, by marching from a series beside the pitch point (explicit Runge-Kutta pairs, and
implicit), by collocation with a number of nodes, by the package's own choice of nodes, and for least friction by its
closed form and by a direct search over a path of short straight pieces. The truth is in `shapes_truth`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from geartrain.bench.shapes_cases import CASES, EXTREMES, Case
from geartrain.bench.shapes_records import ExtremeRecord, InwardRecord, ShapeRecords, WorkRecord
from geartrain.bench.shapes_ways import collocated, inwards, marched, nodes_of, packaged, searched
from geartrain.bench.timing import timed
from geartrain.errors import GearTrainError

Advance = Callable[[str], None]

_PAIRS = ("RK45", "DOP853", "Radau", "BDF")
_TOLERANCES, _FEW = tuple(10.0**-n for n in range(3, 14, 2)), (1e-4, 1e-8, 1e-12)
_STARTS, _FEW_STARTS = tuple(10.0 ** (-n / 2) for n in range(1, 11)), (1e-1, 1e-3, 1e-5)
_NODES, _FEW_NODES = (4, 6, 8, 10, 12, 16, 20, 24, 32, 48, 96), (6, 12, 24)
_CELLS, _FEW_CELLS = (10, 20, 40), (10,)
_START = 1e-3  # of the arc: where marching starts, its series to d^2


def shapes(quick: bool = False, advance: Advance = lambda _: None) -> ShapeRecords:
    """Measure all ways (`quick`: few settings, few extreme pairs); `advance` hears of every step."""
    found: list[Any] = []
    for name, task in _tasks(quick):
        advance(name)
        found += task()
    return ShapeRecords(
        "Tooth shapes: error of the last contact against run time",
        [row for row in found if isinstance(row, WorkRecord)],
        [row for row in found if isinstance(row, ExtremeRecord)],
        [row for row in found if isinstance(row, InwardRecord)],
    )


def count_shape_steps(quick: bool = False) -> int:
    """How many steps `shapes` will tell of."""
    return sum(1 for _ in _tasks(quick))


def _tasks(quick: bool) -> Iterator[tuple[str, Callable[[], Sequence[Any]]]]:
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
        yield f"{case.name}: start", partial(_work, case, "start", _FEW_STARTS if quick else _STARTS, rounds)
        yield f"{case.name}: inwards", partial(_inwards, case)
    for case in EXTREMES[:3] if quick else EXTREMES:
        yield case.name, partial(_extreme, case, rounds)


def _work(case: Case, method: str, settings: Sequence[float], rounds: int) -> list[WorkRecord]:
    """One way at each of its settings."""
    ways: dict[str, Callable[[float], float]] = {
        "package": lambda _: packaged(case),
        "collocation": lambda nodes: collocated(case, int(nodes)),
        "start": lambda start: marched(case, "DOP853", 1e-13, start),
        "direct search": lambda cells: searched(case, int(cells)),
    }
    way = ways.get(method, lambda tolerance: marched(case, method, tolerance, _START))
    return [
        WorkRecord(case.name, method, setting, *_measured(case, partial(way, setting), rounds)) for setting in settings
    ]


def _measured(case: Case, way: Callable[[], float], rounds: int) -> tuple[float, float]:
    """Relative error, and the least time of some rounds, for one solution."""
    times, end = [], float("nan")
    for _ in range(rounds):
        try:
            seconds, end = timed(way)
        except (GearTrainError, ArithmeticError, ValueError):
            seconds, end = float("inf"), float("nan")
        times.append(seconds)
    error = abs(end / case.end - 1)
    least = min(times)
    return (error if error == error else float("inf")), (least if least < float("inf") else 0.0)


def _inwards(case: Case) -> list[InwardRecord]:
    return [InwardRecord(case.name, distance, error, case.exponent) for distance, error in inwards(case)]


def _extreme(case: Case, rounds: int) -> list[ExtremeRecord]:
    """The package's own way, and marching at the sharpest tolerance."""
    rows = [ExtremeRecord(case.name, "package", *_measured(case, partial(packaged, case), rounds), nodes_of(case))]
    for start in (1e-2, 1e-4):
        way = partial(marched, case, "DOP853", 1e-13, start)
        rows.append(ExtremeRecord(case.name, f"DOP853 from {start:.0e}", *_measured(case, way, rounds)))
    return rows
