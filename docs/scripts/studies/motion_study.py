"""Every way to the motion of whole trains with real teeth and pins: error and time, as ratios to direct composition.

Direct asks every law itself, in the solved order. Its alternatives: tables of the laws, sums over pairs to first order,
two estimates without any position, and marching in time as a general multibody program does. The direct composition
itself is judged by the laws' definitions in 40 digits.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from statistics import median

import numpy as np

from geartrain import GearTrain
from studies.measurement import Step, taken
from studies.motion_methods import Effort, MotionCase, forget
from studies.motion_records import GrowthRecord, MotionRecord, MotionRecords, TrainRecord
from studies.train_families import TEETH, toothed_chain

_DIALS = ("sun", "moon", "synodic month", "lunar year", "four years")
_POINTERS = ("moon", "mercury", "venus", "mars", "jupiter", "saturn")
_PAIRS = (10, 100, 1_000)
_FEW_PAIRS = (10, 30)
_QUICKEST = 20_000  # most positions of a quick run
_GROWN = 4_000  # positions of the chains


def motion(quick: bool = False, positions: int = 1_000_000) -> MotionRecords:
    """Measure all methods on all trains (`quick`: two trains, few positions)."""
    found = taken(_steps(quick, positions))
    return MotionRecords.sorted_by_kind("Motion of whole trains: error against run time", found)


def _steps(quick: bool, positions: int) -> Iterator[Step]:
    for case in _cases(quick, positions):
        for name, step in case.steps():
            yield f"{case.name}: {name}", partial(_without_rows, step)
        yield f"{case.name}: records", partial(_of_a_case, case)
    for pairs in _FEW_PAIRS if quick else _PAIRS:
        yield f"chain of {pairs} pairs", partial(_grown, pairs, 1 if quick else 5)


def _without_rows(step: Callable[[], None]) -> Sequence[MotionRecord]:
    step()
    return ()


def _of_a_case(case: MotionCase) -> list[MotionRecord | TrainRecord]:
    return [*case.rows(), case.summary()]


def _cases(quick: bool, positions: int) -> list[MotionCase]:
    if quick:
        effort = Effort(min(positions, _QUICKEST), rounds=1, marched=5, sample=3)
    else:
        effort = Effort(positions, rounds=5, marched=max(10, positions // 200), sample=100)
    cases = [
        MotionCase("moon-triangular", "moon-triangular", ("moon",), 95.0, effort),
        MotionCase("price-1974, triangular teeth", _toothed("price-1974"), _DIALS, 19.0, effort),
        MotionCase("freeth-2021, pins", "freeth-2021", _POINTERS, 19.0, effort),
        MotionCase("freeth-2021, pins and triangular teeth", _toothed("freeth-2021"), _POINTERS, 19.0, effort),
    ]
    return cases[:2] if quick else cases


def _toothed(name: str) -> str:
    """A shipped train with triangular teeth in the middle of each pair's window."""
    form = ", ".join(f"{key}: {value}" for key, value in TEETH.items())
    return f"extends: {name}\nname: {name}-triangular\ntooth_form: {{{form}}}\n"


# growth --------------------------------------------------------------------------------------------------------------


def _grown(pairs: int, rounds: int) -> list[GrowthRecord]:
    """Preparation and run of a chain; the medians of some rounds, fewer where they take more than half a minute."""
    found: list[GrowthRecord] = []
    start = time.perf_counter()
    while len(found) < rounds and (not found or (time.perf_counter() - start) * (1 + 1 / len(found)) < 30):
        found.append(_grow(pairs))
    medians = {key: median(getattr(each, key) for each in found) for key in _TIMES}
    return [GrowthRecord(pairs, _GROWN, found[0].chunk, **medians)]


_TIMES = ("declared", "windows", "prepared", "seconds")


def _grow(pairs: int) -> GrowthRecord:
    forget()
    data = toothed_chain(pairs)
    marks = [time.perf_counter()]
    train = GearTrain.declare(data)
    _ = train.circuits
    marks.append(time.perf_counter())
    _ = train.meshes
    marks.append(time.perf_counter())
    built = train.motion()
    built.at(np.zeros(1))
    marks.append(time.perf_counter())
    for _passage in built._stretches(1.0, _GROWN):
        pass
    marks.append(time.perf_counter())
    took = dict(zip(_TIMES, np.diff(marks).tolist(), strict=True))
    return GrowthRecord(pairs, _GROWN, built._forward.chunk, **took)
