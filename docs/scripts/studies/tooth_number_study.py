"""Tooth numbers: best error found against time for several ways to them, and how complete searches grow.

Errors are exact fractions. Times are medians of rounds in which the ways take turns; memory is the growth of the peak
in a process of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from statistics import median
from typing import Any

from geartrain.search import TargetRatio, find_stages, read_ratio, search_train
from geartrain.search.ratio.product_windows import multisets, products_of
from geartrain.train import Train
from studies import tooth_number_methods as ways
from studies.measurement import Cost, Step, in_turns, measure, taken
from studies.tooth_number_methods import Found, Pair, RatioCase
from studies.tooth_number_records import (
    CHAIN,
    EVERY,
    FACTORED,
    PAIRS,
    PRINTED,
    PRODUCTS,
    RATIO,
    TRAIN,
    WALKED,
    TeethGrowth,
    TeethRecord,
    TeethRecords,
)

_RATIOS = {
    "tropical month": "13.368267",
    "synodic month": "year_tropical_J2000 / month_synodic_J2000",
    "Metonic month": "235/19",
    "pi": "3.14159265358979",
    "1009/997": "1009/997",
}
_PRINTED = ("tropical month", 3, (30, 100), (15, 40))  # the public brute-force tool's question
_TRIES = (1, 16, 256, 4096)
_MONTH = Fraction("13.36838")
_OUTPUT = Fraction("2.23607")
_ROOM = "1e-3"
_LIMIT = 300.0
_LONG = 5.0
_SIZES = (25, 50, 100, 200)


def tooth_numbers(quick: bool = False) -> TeethRecords:
    """Measure all questions and growths (`quick`: few and small ones, for a second or so)."""
    ways.by_products(RatioCase("", Fraction(3), 2, (12, 40), (12, 20)))  # what is loaded once is not timed
    return TeethRecords.sorted_by_kind("Tooth numbers: best error against time", taken(_steps(quick)))


def _steps(quick: bool) -> Iterator[Step]:
    for case in _cases(quick):
        name = f"{case.name}, {case.stages} stages"
        printed = case == _case(*_PRINTED)
        patience = 0.3 if quick else 90.0 if printed else 8.0
        yield name, partial(requested, case, 1 if quick else 3, _TRIES[:2] if quick else _TRIES, patience)
    yield from _growths(quick)


def _case(name: str, stages: int, wheels: Pair, pinions: Pair) -> RatioCase:
    return RatioCase(name, read_ratio(_RATIOS[name]).value, stages, wheels, pinions)


def _cases(quick: bool) -> Iterator[RatioCase]:
    if quick:
        for name in _RATIOS:
            yield _case(name, 2, (12, 40), (8, 24))
        yield _case("pi", 3, (12, 30), (12, 30))
        return
    yield _case(*_PRINTED)
    yield _case("tropical month", 2, (30, 130), (12, 40))
    for name in _RATIOS:
        for stages in (1, 2, 3):
            yield _case(name, stages, (12, 100), (12, 100))
    for counts in ((15, 60), (30, 200)):
        for stages in (2, 3):
            yield _case("pi", stages, counts, counts)


# error against time --------------------------------------------------------------------------------------------------


def requested(case: RatioCase, rounds: int, tries: Sequence[int], patience: float) -> list[TeethRecord]:
    """One question by all ways: pairs by stage with so many tries, brute force within `patience` seconds."""
    train = ways.chain(case)
    widths = [1] if case.stages == 1 else [round(number ** (1 / (case.stages - 1))) for number in tries]
    tasks: list[tuple[str, Callable[[], Found]]] = [
        (FACTORED, partial(ways.factored, case, "convergent")),
        (WALKED, partial(ways.factored, case, "intermediate")),
        *((PAIRS, partial(ways.by_stage, case, width)) for width in widths),
        (PRODUCTS, partial(ways.by_products, case)),
        (TRAIN, partial(ways.in_train, train, case)),
    ]
    found = in_turns((partial(_afresh, task) for _, task in tasks), rounds)
    rows = [_row(case, name, each.found, each.median) for (name, _), each in zip(tasks, found, strict=True)]
    return [*rows, *(_row(case, EVERY, one, one.seconds or 0.0) for one in ways.every_set(case, patience))]


def _afresh(task: Callable[[], Any]) -> Any:
    """The task without tables that an earlier one left."""
    products_of.cache_clear()
    return task()


def _row(case: RatioCase, method: str, found: Found, seconds: float) -> TeethRecord:
    return TeethRecord(
        case.name,
        str(case.value),
        case.stages,
        "{}:{}".format(*case.wheels),
        "{}:{}".format(*case.pinions),
        case.considered,
        method,
        found.tries,
        seconds,
        None if found.error is None else str(found.error),
        [list(found.top), list(found.beneath)] if found.top else [],
        found.proved,
    )


# growth --------------------------------------------------------------------------------------------------------------


def _growths(quick: bool) -> Iterator[Step]:
    rounds = 1 if quick else 3
    products = {2: (25, 50), 3: (25,)} if quick else {2: _SIZES, 3: _SIZES, 4: _SIZES, 5: _SIZES[:2]}
    yield "the printed question", partial(_of_printed, rounds)
    for stages, sizes in products.items():
        for size in sizes:
            yield f"{stages} stages of {size}", partial(_of_products, stages, size, rounds)
    for stages in (1, 2, 3) if quick else (1, 2, 3, 4, 5):
        for size in (16,) if quick else (26, 46, 86):
            if stages < 5 or size < 60:
                yield f"{2 * stages} free wheels of {size}", partial(_of_chain, stages, size, rounds)


def _of_products(stages: int, size: int, rounds: int) -> list[TeethGrowth]:
    counts = range(12, 12 + size)
    task = partial(find_stages, TargetRatio(_MONTH), stages, counts, counts, best=1)
    considered = multisets(size, stages) ** 2
    return [TeethGrowth(RATIO, stages, size, considered, *_cost(task, rounds)[:2])]


def _of_printed(rounds: int) -> list[TeethGrowth]:
    """All solutions within a tolerance, for which the public brute-force tool's time is known."""
    case = _case(*_PRINTED)
    task = partial(
        find_stages, TargetRatio(case.value), case.stages, case.top, case.beneath, tolerance=Fraction(1, 10**6)
    )
    cost = _cost(task, rounds, lambda found: float(found.count))
    return [TeethGrowth(PRINTED, case.stages, len(case.top), case.considered, *cost)]


def _of_chain(stages: int, size: int, rounds: int) -> list[TeethGrowth]:
    case = RatioCase("", _OUTPUT, stages, (15, 14 + size), (15, 14 + size))
    cost = _searched(ways.chain(case, _ROOM), rounds)
    return [TeethGrowth(CHAIN, stages, size, size ** (2 * stages), *cost)]


def _searched(train: Train, rounds: int) -> tuple[float | None, float | None, int]:
    return _cost(
        lambda: search_train(train, best=1), rounds, lambda found: float(found.count) if found.complete else -1.0
    )


def _cost(
    task: Callable[[], Any], rounds: int, number_of: Callable[[Any], float] = lambda _: -1.0
) -> tuple[float | None, float | None, int]:
    """Median seconds, greatest memory (MB) and what `number_of` counts; long tasks have one round."""
    found: list[Cost] = []
    for _ in range(rounds):
        found.append(measure(partial(_afresh, task), number_of, _LIMIT))
        if found[-1].seconds is None:
            return None, None, -1
        if found[-1].seconds > _LONG:
            break
    memory = [cost.megabytes for cost in found if cost.megabytes is not None]
    seconds = median(cost.seconds for cost in found if cost.seconds is not None)
    number = found[-1].error
    return seconds, max(memory, default=None), int(-1 if number is None else number)
