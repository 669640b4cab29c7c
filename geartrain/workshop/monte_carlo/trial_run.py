"""Execution of trials as tasks in one or several processes with a journal, their results, and a table file."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from importlib.metadata import version
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.files import ColumnTable, LongTable, csv_line, csv_lines
from geartrain.numerics.work import Execution
from geartrain.workshop.monte_carlo.trial_block import (
    BLOCK,
    RandomStreams,
    TrialWheels,
    draw_trial_wheels,
    input_positions,
    judge_trial_pairs,
    trial_pointers,
)
from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan


VERSION = 3
"""Version of the algorithm that draws and evaluates trials. A journal of another version is rejected."""
_CHECKED = 1024  # trials in which superposition is compared with exact composition
_TASKS = 16  # minimum number of tasks if there are enough trials: 8 processes then finish at nearly the same time
_FEWEST = 32  # minimum trials of a task: its fixed cost is then smaller than the cost of its trials
_COURSE = 1 << 20  # block number of courses, so that their random streams differ from those of the trials
_MOST = 10**9  # trials: more would not fit into memory


@dataclass(frozen=True, slots=True)
class TrialRecord:
    """Results of the trials of one task, with fields as in `TrialResults`."""

    first: int
    """Number of the first trial in the task."""
    turns: Floats
    marks: NDArray[np.uint8]
    backlash: Floats
    """Minimum backlash of each pair, shape (trials, pairs) [pitch of the driven wheel]."""
    errors: Floats
    linear: Floats
    lags: Floats
    filing: Floats


def journal_key(plan: TrialPlan, seed: int, trials: int, **more: Any) -> dict[str, Any]:
    """Return the data that identify a run in a journal, which are all data on which its results depend."""
    made = {"geartrain": version("geartrain"), "numpy": version("numpy"), "errors": VERSION}
    return {**made, "seed": seed, "trials": trials, "block": BLOCK, **plan.question(), **more}


def check_trials(trials: int) -> None:
    """Raise `QuestionError` if the number of trials is below 1 or above 10^9."""
    if not 1 <= trials <= _MOST:
        what = f"{trials if trials < 1 else f'{trials:.3g}'} is not a valid number of trials"
        raise QuestionError(Problem(what, f"a run has from 1 to {_MOST:,} trials", "for example, give --trials 1000"))


def trial_tasks(trials: int, cases: int = 1) -> list[list[int]]:
    """Return first trial and number of trials of each task: a block, or a part of a block if there are few blocks.

    cases   number of times that all trials are run, each with other sizes or errors
    """
    # sums are rounded task by task, so the tasks must not depend on the number of workers
    blocks = [range(start, min(start + BLOCK, trials)) for start in range(0, trials, BLOCK)]
    parts = min(4, -(-_TASKS // (len(blocks) * cases)))
    found = []
    for block in blocks:
        size = max(_FEWEST, -(-len(block) // parts))
        found += [[part[0], len(part)] for part in (block[at : at + size] for at in range(0, len(block), size))]
    return found


def run_trials(
    plan: TrialPlan,
    trials: int,
    seed: int = 1,
    means: Execution | None = None,
    take: Callable[[TrialRecord], None] | None = None,
) -> TrialResults:
    """Run Monte Carlo trials of a train. Each trial draws errors of all wheels and turns each pair through a full
    meshing cycle.

    The result is the same for any number of workers, and for a run that was interrupted and resumed. After an interrupt
    (Ctrl-C), the results of the completed trials are returned.

    Parameters
    ----------
    plan : TrialPlan
        Train with its cutting and fitting errors.
    trials : int
        Number of trials, 1 to 10^9.
    seed : int
        Random seed. The same seed gives the same wheels in every computation.
    means : Execution, optional
        Executor, journal and progress function; by default this process without journal and progress function.
    take : callable, optional
        Function that is called with the `TrialRecord` of each finished task.

    Returns
    -------
    TrialResults
        Event probabilities of the pairs and errors of the pointers.

    Raises
    ------
    QuestionError
        If the number of trials is out of range.
    RangeError
        If wheels cannot be cut in more than half of the trials.

    Notes
    -----
    The transmission functions of cut pairs are composed exactly (docs/motion.md, equation 3). The events of a pair are
    defined in docs/cut-by-hand.md, section 2.

    Examples
    --------
    Pitch deviations of 0.1 % cause no jam. If no event occurs in 64 trials, Wilson's upper limit is z^2 / (64 + z^2).

    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> jam = run_trials(plan, 64).train.events["jam"]
    >>> jam.count, [round(end, 4) for end in jam.interval]
    (0, [0.0, 0.0566])
    """
    check_trials(trials)
    means, work, tasks = means or Execution(), partial(work_block, plan, seed), trial_tasks(trials)
    # before the run, so that a refused run leaves no journal
    _check_cut(draw_trial_wheels(plan, RandomStreams(seed, 0), tasks[0][1]))
    found: list[TrialRecord] = []
    try:
        for (first, _), packed in zip(tasks, means.run(work, tasks), strict=True):
            rows = unpack(first, packed)
            if take is not None:
                take(rows)
            # only the table needs the backlash, so its memory is freed
            found.append(replace(rows, backlash=np.zeros((0, 0))))
    except KeyboardInterrupt:
        if not found:  # without a complete task there is nothing to return
            raise
    return gathered(plan, seed, trials, found)


def _check_cut(drawn: TrialWheels) -> None:
    """Raise `RangeError` if at least one wheel cannot be cut in more than half of the trials."""
    plan = drawn.plan
    uncut = np.stack([~(drawn.good[pair.first] & drawn.good[pair.second]) for pair in plan.pairs], axis=1)
    share = uncut.any(axis=1).mean()
    if share <= 0.5:
        return
    pair = plan.pairs[int(uncut.mean(axis=0).argmax())]
    wheel = max((plan.wheels[pair.first], plan.wheels[pair.second]), key=lambda each: each.z)
    what = f"in {share:.0%} of the trials a wheel cannot be cut, most often in pair '{pair.name}'"
    why = f"errors must be smaller than a tooth: the angular pitch of '{wheel.name}' is {360 / wheel.z:.3g} deg"
    raise RangeError(Problem(what, why, "give smaller errors: --cutting pitch_deviation='2 %'"))


# -------------------------------------------------------------------------------------------------------------- workers


def work_block(plan: TrialPlan, seed: int, task: Sequence[int]) -> dict[str, Any]:
    """Return the results of all trials in one task as plain data."""
    number, trials = task
    drawn = draw_trial_wheels(plan, RandomStreams(seed, number // BLOCK), trials, number % BLOCK)
    marks, backlash = judge_trial_pairs(drawn)
    turns = input_positions(drawn)
    found = trial_pointers(drawn, np.arange(trials))
    linear = found.superposed(turns).T if number < _CHECKED else np.zeros((0, len(plan.outputs)))
    errors = found.errors(turns).T  # after the superposition, because the lags are those of this last evaluation
    lags = np.zeros(marks.shape)
    for at, pair in enumerate(plan.pairs):
        if pair.name in found.transmissions:
            lags[:, at] = found.transmissions[pair.name].last - pair.even
    arrays: dict[str, NDArray[Any]] = {"turns": turns, "marks": marks, "backlash": backlash, "errors": errors}
    arrays |= {"linear": linear, "lags": lags, "filing": drawn.strokes()}
    return {name: _pack(each) for name, each in arrays.items()}


def _pack(array: NDArray[Any]) -> str:
    file = BytesIO()
    # exact bytes instead of decimals, so that a resumed run gives the same results
    np.save(file, array, allow_pickle=False)
    return b64encode(file.getvalue()).decode()


def unpack(first: int, packed: Mapping[str, str]) -> TrialRecord:
    """Return the results of one task, which begins with trial `first`, from arrays in base64 text."""
    return TrialRecord(first, **{name: np.load(BytesIO(b64decode(each))) for name, each in packed.items()})


# ----------------------------------------------------------------------------------------------------------- all trials


def gathered(plan: TrialPlan, seed: int, wanted: int, found: Sequence[TrialRecord]) -> TrialResults:
    """Return one result that combines the records of all tasks."""
    names = ("marks", "turns", "errors", "linear", "lags", "filing")
    arrays = {name: np.concatenate([getattr(rows, name) for rows in found]) for name in names}
    return TrialResults(plan, seed, wanted, **arrays)


def run_course(plan: TrialPlan, output: int, positions: int, seed: int = 1, trials: int = BLOCK) -> PointerErrorCourse:
    """Compute the pointer errors of one output over one revolution of the output, or of the input if the output is
    fixed.

    Parameters
    ----------
    plan : TrialPlan
        Train with its cutting and fitting errors.
    output : int
        Index of the output in `plan.outputs`, from 0.
    positions : int
        Number of positions along the revolution, including both ends.
    seed : int
        Random seed. The random numbers are independent of the random numbers in `run_trials`.
    trials : int
        Number of trials, at most 256.

    Returns
    -------
    PointerErrorCourse
        Pointer errors [rad], shape (trials, positions).

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> course = run_course(plan, 0, 5, trials=8)
    >>> course.errors.shape, course.bands().shape
    ((8, 5), (7, 5))
    """
    trials = min(trials, BLOCK)  # one stream of random numbers gives one block
    drawn = draw_trial_wheels(plan, RandomStreams(seed, _COURSE), trials)
    speed = abs(plan.speeds[output])
    turns = np.linspace(0.0, float(1 / speed) if speed else 1.0, positions)
    # in chunks, because the arrays of all trials at all positions would not fit into the cache
    rows, chunk = np.repeat(np.arange(trials), positions), plan.composition.chunk
    everywhere = np.tile(turns, trials)
    parts = []
    for start in range(0, len(rows), chunk):
        part = slice(start, start + chunk)
        parts.append(trial_pointers(drawn, rows[part], (output,)).errors(everywhere[part])[0])
    return PointerErrorCourse(plan.outputs[output], turns, np.concatenate(parts).reshape(trials, positions))


# ----------------------------------------------------------------------------------------------------------- table file


SUFFIXES = (".parquet", ".csv")
_EVENTS = "bit mask: 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 wheels cannot be cut"


@contextmanager
def trial_table(
    plan: TrialPlan, path: Path, force: bool = False, replay: bool = False
) -> Iterator[Callable[[TrialRecord], None]]:
    """Yield a function that appends one record to a table file (.parquet or .csv) with one row for each trial.

    force    True if an existing file may be overwritten
    replay   True if an interrupted run is resumed, and the file is written again from the journal
    """
    if path.suffix.lower() == ".parquet":
        with ColumnTable(path, {"train": plan.name, "events": _EVENTS}, force, replay=replay) as columns:
            yield lambda rows: columns.write(dict(zip(_names(plan), _columns(plan, rows), strict=True)))
    else:
        with LongTable(path, csv_line(_names(plan)), force=force, replay=replay) as table:
            yield lambda rows: table.write(
                csv_lines(zip(*(column.tolist() for column in _columns(plan, rows)), strict=True))
            )


def _names(plan: TrialPlan) -> list[str]:
    return [
        "trial",
        "turns",
        *(f"{name} error (deg)" for name in plan.outputs),
        *(f"{pair.name} {what}" for pair in plan.pairs for what in ("backlash (pitches)", "events")),
        *(f"{pair.name} {what}" for pair in plan.pairs if pair.stroke for what in ("strokes", "teeth filed")),
    ]


def _columns(plan: TrialPlan, rows: TrialRecord) -> list[Floats]:
    """Return the columns of the table for one record, in the order of the column names."""
    values = [rows.first + np.arange(len(rows.turns)), rows.turns, *np.degrees(rows.errors.T)]
    for at in range(len(plan.pairs)):
        values += [rows.backlash[:, at], rows.marks[:, at]]
    for at, pair in enumerate(plan.pairs):
        if pair.stroke:
            values += [rows.filing[:, 2 * at].astype(np.int64), rows.filing[:, 2 * at + 1].astype(np.int64)]
    return values
