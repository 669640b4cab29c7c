"""Error against run time of ways to the speeds of many trains that differ in tooth counts: the stage `variants`.

In goes a train; out come two rows, each with its time for one train: the formulas of all outputs for a whole table, and
a train declared and solved for every row, of which every so many are run. The error is the greatest of any output.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.analysis.method_accuracy import VARIANTS, AbsentStageError, MethodAccuracy, best_of
from geartrain.errors import GearTrainError
from geartrain.kinematics.formulas.speed_formulas import speed_formulas

if TYPE_CHECKING:
    from geartrain.analysis.train_variants import TrainVariants

_WHEELS, _COUNTS = 3, 27  # that are varied, and counts of each
_SOLVED = 40  # trains that are solved one by one


def measure_variants(train: GearTrain, state: str | None) -> Iterator[MethodAccuracy]:
    """A table of trains by their formulas, and one by one."""
    counts = _varied(train, state)
    start = time.perf_counter()
    _ = train.variants({wheel: each[:1] for wheel, each in counts.items()}, state=state)
    prepared = time.perf_counter() - start
    took, found = best_of(partial(train.variants, counts, state=state))
    rows = range(0, len(found), max(len(found) // _SOLVED, 1))
    alone, exact = best_of(partial(_solved, train, state, found, rows))
    method = f"formulas, {len(found)} trains of {len(found.outputs)} outputs"
    error = max(map(partial(_off, found), rows, exact), default=0.0)
    yield MethodAccuracy(VARIANTS, method, took / len(found), error, "relative", "each train solved", prepared)
    reference = "the other is held against it"
    yield MethodAccuracy(VARIANTS, "each declared and solved", alone / len(rows), None, "relative", reference)


def _varied(train: GearTrain, state: str | None) -> Mapping[str, Sequence[int]]:
    """Counts about those declared, of the first few wheels on which an output depends."""
    try:
        formulas = speed_formulas(train.declaration, train.declaration.single_state(state))
    except GearTrainError as error:
        raise AbsentStageError(error.problems[0].what) from None
    shares = (share for formula in formulas for share in formula.shares)
    wheels = dict.fromkeys(wheel for share in shares for wheel in share.ratio.formula.wheels)
    if not wheels:
        raise AbsentStageError("no output depends on a tooth count")
    about = {wheel: train.declaration.wheels[wheel][1].count or 0 for wheel in islice(wheels, _WHEELS)}
    lowest = {wheel: max(count - _COUNTS // 2, 1) for wheel, count in about.items()}
    return {wheel: range(low, low + _COUNTS) for wheel, low in lowest.items()}


def _solved(
    train: GearTrain, state: str | None, found: TrainVariants, rows: Sequence[int]
) -> list[Mapping[str, Fraction]]:
    """By row, the speeds of outputs; nothing of those that do not turn."""
    answers: list[Mapping[str, Fraction]] = []
    for row in rows:
        counts = dict(zip(found.wheels, found.counts[row].tolist(), strict=True))
        answer = train.with_teeth(counts).solve(state)
        speeds = ((name, answer.outputs[name].speed) for name in found.outputs if name in answer.outputs)
        answers.append({name: Fraction(speed) for name, speed in speeds if speed is not None} if answer.verdict else {})
    return answers


def _off(found: TrainVariants, row: int, exact: Mapping[str, Fraction]) -> float:
    """Greatest relative error of an output of one train; that of a speed of 0 is its size."""
    near = ((Fraction(float(found[name][row])), speed) for name, speed in exact.items())
    return max((float(abs(one / speed - 1 if speed else one)) for one, speed in near), default=0.0)
