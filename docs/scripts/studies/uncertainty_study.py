"""Counts in doubt and wheels cut by hand: trials a second as ratios to a plain loop, and errors against trials.

Whatever is done many at a time is held against a loop over single solutions in the same rounds: its time, and its
results. Estimates are held against a pair whose chance of a jam is a finite sum, and against a run of many trials.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from studies.count_trials import Counted
from studies.cut_pair_trials import EVERY, EXACT, NORMAL, PLACES, Batch, errors_of, jams
from studies.displaced_pair_trials import FORMS, DisplacedBatch
from studies.measurement import Step, in_turns, measure, taken
from studies.uncertainty_records import (
    COUNTS,
    DISPLACED,
    SINGLY,
    TOGETHER,
    ErrorRecord,
    RateRecord,
    UncertaintyRecords,
)

_TRAIN = "freeth-2008"
_PAIRS = ((64, 38, 0.02), (48, 24, 0.02), (45, 225, 0.01))
_NUMBERS = (100, 200, 500, 1000, 2000, 5000, 10_000)


@dataclass(frozen=True, slots=True)
class Effort:
    """How much is done: rounds, combinations, couples of a batch, single solutions, blocks of trials for estimates."""

    rounds: int
    combinations: int
    pitches: int
    counted: int
    solved: int
    blocks: int
    numbers: tuple[int, ...]


_QUICK = Effort(1, 20_000, 100_000, 5, 1, 2, _NUMBERS[:4])
_FULL = Effort(3, 500_000, 2_000_000, 100, 3, 50, _NUMBERS)


def uncertainty(quick: bool = False) -> UncertaintyRecords:
    """Measure all of it (`quick`: small numbers, one round)."""
    found = taken(_steps(_QUICK if quick else _FULL, quick))
    return UncertaintyRecords.sorted_by_kind("Counts in doubt and wheels cut by hand: error against run time", found)


def _steps(effort: Effort, quick: bool) -> Iterator[Step]:
    yield f"{_TRAIN}, every wheel uncertain", partial(_counts, effort)
    for errors in (PLACES, EVERY):
        for pair in _PAIRS[:1] if quick else _PAIRS:
            yield f"{pair[0]}/{pair[1]}, {errors}", partial(_pitches, Batch(*pair, errors, 1), effort)
    for form in FORMS:
        yield f"64/38, {form}", partial(_displaced, form, effort)
    for case in (EXACT, NORMAL):
        yield f"estimates, {case}", partial(_estimates, case, effort)


# ------------------------------------------------------------------------------------------------------------- counts


def _counts(effort: Effort) -> list[RateRecord]:
    """Whether combinations fit, and all that their outputs do, against whole solutions one by one."""
    requested = Counted(_TRAIN, effort.combinations)
    case = f"{_TRAIN}, {len(requested.question.uncertainties)} uncertain wheels"
    (
        requested.decided(),
        requested.told(),
    )  # formulas, tables and counts are found once, whatever the number of combinations
    ways: list[tuple[str, int, Callable[[], Any]]] = [
        (SINGLY, effort.counted, partial(requested.singly, effort.counted)),
        (f"fit or not, {len(requested.question.witnesses)} outputs, drawn", effort.combinations, requested.decided),
        (f"speeds of {len(requested.question.outputs)} outputs, with bounds", effort.combinations, requested.told),
    ]
    rows, singles = _measured(COUNTS, case, 1, ways, effort.rounds)
    error, share = requested.off(singles)
    differing = requested.differing(singles)
    fitting = sum(fits for _, fits in singles)
    notes = ("", f"{fitting} of those checked fit", f"errors are {share:.2g} of their bounds at most")
    checks = ((None, 0, 0), (None, differing, len(singles)), (error, 0, 0))
    return [_checked(row, *check, note) for row, check, note in zip(rows, checks, notes, strict=True)]


# -------------------------------------------------------------------------------------------------------------- pairs


def _pitches(one: Batch, effort: Effort) -> list[RateRecord]:
    """Full cycles of one pair's hand-cut wheels, judged together and one by one."""
    pitches = effort.pitches if one.errors == PLACES else effort.pitches // 10
    batch = Batch(one.z1, one.z2, one.excess, one.errors, max(effort.solved, pitches // one.pitches))
    found = batch.together()  # tables of the even pair are found once
    ways: list[tuple[str, int, Callable[[], Any]]] = [
        (SINGLY, effort.solved, partial(batch.singly, effort.solved)),
        (TOGETHER, batch.trials, batch.together),
    ]
    rows, singles = _measured(batch.errors, batch.name, batch.pitches, ways, effort.rounds)
    note = f"{found.stops.mean():.2g} of the trials stop"
    return [rows[0], _checked(rows[1], *batch.compared(found, singles), len(singles), note)]


def _displaced(form: str, effort: Effort) -> list[RateRecord]:
    """Full cycles of a pair with a path of contact, out of place and eccentric, judged together and one by one."""
    trials = max(effort.solved, effort.pitches // 10 // DisplacedBatch(form, 64, 38, 1).pitches)
    batch = DisplacedBatch(form, 64, 38, trials)
    found = batch.together()
    ways: list[tuple[str, int, Callable[[], Any]]] = [
        (SINGLY, effort.solved, partial(batch.singly, effort.solved)),
        (TOGETHER, batch.trials, batch.together),
    ]
    rows, singles = _measured(DISPLACED, batch.name, batch.pitches, ways, effort.rounds)
    note = f"{found.stops.mean():.2g} of the trials stop"
    return [rows[0], _checked(rows[1], *batch.compared(found, singles), len(singles), note)]


def _measured(
    family: str, case: str, work: int, ways: list[tuple[str, int, Callable[[], Any]]], rounds: int
) -> tuple[list[RateRecord], Any]:
    """All ways round by round, the loop first; and what the loop came to."""
    # other work on the machine is not counted
    loop, *_ = found = in_turns((task for _, _, task in ways), rounds, time.process_time)
    rows = []
    for (name, trials, task), own in zip(ways, found, strict=True):
        ratio = loop.over(own) * trials / ways[0][1]
        # a loop takes what one solution takes
        memory = None if name == SINGLY else measure(task).megabytes
        rows.append(RateRecord(family, case, name, trials, work, own.median, ratio, memory))
    return rows, loop.found


def _checked(row: RateRecord, error: float | None, differing: int, checked: int, note: str) -> RateRecord:
    return replace(row, error=error, differing=differing, checked=checked, note=note)


# ---------------------------------------------------------------------------------------------------------- estimates


def _estimates(case: str, effort: Effort) -> list[ErrorRecord]:
    return errors_of(case, jams(case, effort.blocks), effort.numbers)
