"""Trials by the task, here or in other processes, kept in a journal as they come; all together, and as a table."""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from importlib.metadata import version
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.superposition import Superposition
from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.files import ColumnTable, LongTable, csv_line, csv_lines
from geartrain.numerics.work import Execution
from geartrain.workshop.monte_carlo.random_streams import BLOCK, RandomStreams
from geartrain.workshop.monte_carlo.trial_block import (
    UNCUT,
    TrialPointers,
    draw_trial_wheels,
    input_positions,
    judge_trial_pairs,
    trial_pointers,
)
from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults, turning_trials

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan


VERSION = 2
"""Of the way trials are drawn and worked out: a journal of another is refused."""
_CHECKED = 1024  # trials in which superposition is compared with composition
_TASKS = 16  # at least, where there are trials enough: so that 8 processes end at nearly the same time
_FEWEST = 32  # trials of a part of a block: what is computed once for each task then costs less than they do
_COURSE = 1 << 20  # courses draw from streams of their own
_MOST = 10**9


@dataclass(frozen=True, slots=True)
class TrialRecord:
    """The trials of one task: number of the first, and arrays as in `TrialResults`; `backlash` in driven pitches."""

    first: int
    turns: Floats
    marks: NDArray[np.uint8]
    backlash: Floats
    errors: Floats
    off: Sequence[tuple[float, float, int]] = ()
    sums: Sequence[Mapping[str, tuple[float, ...]]] = field(default_factory=tuple)
    filing: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    """Strokes of the file, and teeth that took them, by pair, (trials, 2 pairs); none where nothing is filed."""


def journal_key(plan: TrialPlan, seed: int, trials: int, **more: Any) -> dict[str, Any]:
    """What a journal knows a run by: everything on which its results depend."""
    made = {"geartrain": version("geartrain"), "numpy": version("numpy"), "errors": VERSION}
    return {**made, "seed": seed, "trials": trials, "block": BLOCK, **plan.question(), **more}


def check_trials(trials: int) -> None:
    """Raise `QuestionError` for a number of trials that tells nothing, or too much."""
    if not 1 <= trials <= _MOST:
        what = f"{trials} trials" if trials < 1 else f"{trials:.3g} trials are more than can be done"
        raise QuestionError(Problem(what, "shares are counted over trials", f"ask for 1 to {_MOST:.0e} of them"))


def trial_tasks(trials: int, cases: int = 1) -> list[list[int]]:
    """Tasks: the first trial and the number of trials of each.

    They are blocks, or a half or a quarter of one where there are few; they depend on the trials and on the number of
    cases for which they are repeated, not on who does them, for sums are rounded by tasks.
    """
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
    """Monte Carlo: each trial cuts all wheels anew and judges every pair over its whole cycle of teeth.

    The same for any number of workers, however often it was interrupted and taken up. Interrupted (Ctrl-C), it returns
    the trials that are done.

    Parameters
    ----------
    plan : TrialPlan
        The train with its errors.
    trials : int
        1 to 10^9.
    seed : int
        The same seed cuts the same wheels, whatever else is asked.
    means : Execution, optional
        Executor, journal of finished blocks, progress report; by default this process, and none of the others.
    take : callable, optional
        Given each block of trials as it comes, a TrialRecord.

    Returns
    -------
    TrialResults
        How often pairs jam, and how far pointers stray.

    Raises
    ------
    MissingExtraError
        If the kernel is asked for and numba is not installed.
    QuestionError
        For a number of trials that tells nothing.
    RangeError
        Where most wheels cannot be cut.

    Notes
    -----
    Laws of cut pairs are composed exactly, docs/motion.md (3); what becomes of a pair is in docs/cut-by-hand.md, 2.

    Examples
    --------
    Teeth a thousandth of a pitch out of place do not jam; of none in 64 trials Wilson's upper end is z^2 / (64 + z^2).

    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> jam = run_trials(plan, 64).train.events["jam"]
    >>> jam.count, [round(end, 4) for end in jam.interval]
    (0, [0.0, 0.0566])
    """
    check_trials(trials)
    means, work, tasks = means or Execution(), partial(work_block, plan, seed), trial_tasks(trials)
    found: list[TrialRecord] = []
    try:
        for (first, _), packed in zip(tasks, means.run(work, tasks), strict=True):
            rows = unpack(plan, first, packed)
            if not first:
                _check_cut(plan, rows)
            if take is not None:
                take(rows)
            found.append(replace(rows, backlash=np.zeros((0, 0))))
    except KeyboardInterrupt:
        if not found:
            raise
    return gathered(plan, seed, trials, found)


def _check_cut(plan: TrialPlan, rows: TrialRecord) -> None:
    """Refuse errors with which most wheels have no teeth."""
    uncut = (rows.marks & UNCUT) > 0
    if uncut.any(axis=1).mean() <= 0.5:
        return
    pair = plan.pairs[int(uncut.mean(axis=0).argmax())]
    wheel = max((plan.wheels[pair.first], plan.wheels[pair.second]), key=lambda each: each.z)
    raise RangeError(
        Problem(
            f"in {uncut.any(axis=1).mean():.0%} of the trials a wheel cannot be cut, most often in pair '{pair.name}'",
            f"errors are as great as the teeth: those of '{wheel.name}' are {360 / wheel.z:.3g} deg apart",
            "give errors smaller than the tooth",
        )
    )


# ------------------------------------------------------------------------------------------------------- in the workers


def work_block(plan: TrialPlan, seed: int, task: Sequence[int]) -> dict[str, Any]:
    """The trials of one task as plain data."""
    number, trials = task
    drawn = draw_trial_wheels(plan, RandomStreams(seed, number // BLOCK), trials, number % BLOCK)
    marks, backlash = judge_trial_pairs(drawn)
    turns = input_positions(drawn)
    found = trial_pointers(drawn, np.arange(trials))
    first = found.superposed(turns) if number < _CHECKED else None
    errors = found.errors(turns)  # after the superposition: laws remember what they said last
    runs = [turning_trials(marks, reach) & np.isfinite(row) for reach, row in zip(plan.reach, errors, strict=True)]
    off = [] if first is None else [_off(*both) for both in zip(first, errors, strict=True)]
    return {
        "marks": _pack(marks),
        "backlash": _pack(backlash),
        "turns": _pack(turns),
        "errors": _pack(errors.T),
        "off": off,
        "sums": _sums(plan, found, runs),
        **({"filing": _pack(drawn.strokes())} if plan.files else {}),
    }


def _off(first: Floats, exact: Floats) -> tuple[float, float, int]:
    with np.errstate(invalid="ignore"):
        # inf - inf in trials where nothing touches
        good = np.isfinite(first - exact)
    first, exact = first[good], exact[good]
    return float(np.sum((first - exact) ** 2)), float(np.sum(exact**2)), len(first)


def _sums(
    plan: TrialPlan, found: TrialPointers, runs: Sequence[NDArray[np.bool_]]
) -> list[dict[str, tuple[float, ...]]]:
    """By output and pair: how many trials, and sums of the pair's part, of the whole, and of their product."""
    superposition = Superposition(found.cut)
    even = {pair.name: pair.even for pair in plan.pairs}
    sums: list[dict[str, tuple[float, ...]]] = []
    for at, rows in enumerate(runs):
        parts = {
            source.id: source.sense * response * (found.transmissions[source.id].last[rows] - even[source.id])
            for source, response in zip(superposition.sources, superposition.response[at], strict=True)
            if source.id in found.transmissions and response
        }
        whole = sum(parts.values(), np.zeros(int(np.count_nonzero(rows))))
        sums.append(
            {
                name: (float(len(part)), float(part.sum()), float(whole.sum()), float(part @ whole))
                for name, part in parts.items()
            }
        )
    return sums


def _pack(array: NDArray[Any]) -> str:
    return b64encode(np.ascontiguousarray(array).tobytes()).decode()


def unpack(plan: TrialPlan, first: int, packed: Mapping[str, Any]) -> TrialRecord:
    """The trials of a task, `first` the number of the first of them, from the plain data of a worker or a journal."""

    def array(name: str, width: int = 0) -> Any:
        found = np.frombuffer(b64decode(packed[name]), np.uint8 if name == "marks" else np.float64)
        return found.reshape(-1, width) if width else found

    pairs = len(plan.pairs)
    return TrialRecord(
        first,
        array("turns"),
        array("marks", pairs),
        array("backlash", pairs),
        array("errors", len(plan.outputs)),
        [tuple(each) for each in packed["off"]],
        packed["sums"],
        array("filing", 2 * pairs) if plan.files else np.zeros((0, 0)),
    )


# ---------------------------------------------------------------------------------------------------------- all of them


def gathered(plan: TrialPlan, seed: int, wanted: int, found: Sequence[TrialRecord]) -> TrialResults:
    """All blocks as one."""
    outputs = range(len(plan.outputs))
    checked = [rows.off for rows in found if rows.off]
    first = [tuple(map(sum, zip(*(off[at] for off in checked), strict=True))) or (0.0, 0.0, 0) for at in outputs]
    sums = []
    for at in outputs:
        names = found[0].sums[at]
        sums.append(
            {name: tuple(map(sum, zip(*(rows.sums[at][name] for rows in found), strict=True))) for name in names}
        )
    return TrialResults(
        plan,
        seed,
        wanted,
        np.concatenate([rows.marks for rows in found]),
        np.concatenate([rows.turns for rows in found]),
        np.concatenate([rows.errors for rows in found]),
        first,  # type: ignore[arg-type]
        sums,
        jamming_bounds(plan),
        filing=np.concatenate([rows.filing for rows in found]),
    )


def jamming_bounds(plan: TrialPlan) -> dict[str, float]:
    """The bound on a jam of every pair whose two wheels have normal errors of placement, and no others."""
    found = {}
    for pair in plan.pairs:
        wheels = plan.wheels[pair.first], plan.wheels[pair.second]
        plain = all(not each.tables and set(each.errors) <= {"pitch_deviation"} for each in wheels)
        plain = plain and not pair.fitting and not pair.stroke
        normal = all(off.way == "normal" for each in wheels for off in each.errors.values())
        if plain and normal:
            # the bound is of one deviation for both wheels: the greater of the two
            sizes = [each.errors["pitch_deviation"].size for each in wheels if each.errors]
            found[pair.name] = pair.jamming_bound(max(sizes, default=0.0))
    return {name: bound for name, bound in found.items() if not isnan(bound)}


def run_course(plan: TrialPlan, output: int, positions: int, seed: int = 1, trials: int = BLOCK) -> PointerErrorCourse:
    """Errors of one output along one turn of it (of the input where it stands still), trial by trial.

    Parameters
    ----------
    plan : TrialPlan
        The train with its errors.
    output : int
        Its number in `plan.outputs`, from 0.
    positions : int
        Positions along the turn, both ends included.
    seed : int
        Of the random numbers, which are others than those of `run_trials`.
    trials : int
        At most 256.

    Returns
    -------
    PointerErrorCourse
        Errors, (trials, positions) [rad].

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> course = run_course(plan, 0, 5, trials=8)
    >>> course.errors.shape, course.bands().shape
    ((8, 5), (7, 5))
    """
    trials = min(trials, BLOCK)
    drawn = draw_trial_wheels(plan, RandomStreams(seed, _COURSE), trials)
    speed = abs(plan.speeds[output])
    turns = np.linspace(0.0, float(1 / speed) if speed else 1.0, positions)
    rows, chunk = np.repeat(np.arange(trials), positions), plan.composition.chunk
    everywhere = np.tile(turns, trials)
    parts = []
    for start in range(0, len(rows), chunk):
        part = slice(start, start + chunk)
        parts.append(trial_pointers(drawn, rows[part], (output,)).errors(everywhere[part])[0])
    return PointerErrorCourse(plan.outputs[output], turns, np.concatenate(parts).reshape(trials, positions))


# ---------------------------------------------------------------------------------------------------------------- table


SUFFIXES = (".parquet", ".csv")
_EVENTS = "sum of 1 jam, 2 clash, 4 standstill, 8 disengaged, 16 wheels cannot be cut"


@dataclass(frozen=True)
class TrialTable:
    """Every trial, block by block, into a file."""

    plan: TrialPlan
    path: Path
    """A .parquet or .csv."""
    force: bool = False
    """An existing file is written over."""
    replay: bool = False
    """The run was interrupted: its file is written anew from the journal."""

    @contextmanager
    def open(self) -> Iterator[Callable[[TrialRecord], None]]:
        """What takes every block."""
        plan = self.plan
        if self.path.suffix.lower() == ".parquet":
            about = {"train": plan.name, "events": _EVENTS}
            with ColumnTable(self.path, about, self.force, replay=self.replay) as columns:
                yield lambda rows: columns.write(dict(zip(_names(plan), _columns(plan, rows), strict=True)))
        else:
            with LongTable(self.path, csv_line(_names(plan)), force=self.force, replay=self.replay) as table:
                yield lambda rows: table.write(
                    csv_lines(zip(*(column.tolist() for column in _columns(plan, rows)), strict=True))
                )


def _names(plan: TrialPlan) -> list[str]:
    return [
        "trial",
        "turns",
        *(f"{name} error (deg)" for name in plan.outputs),
        *(f"{pair.name} {what}" for pair in plan.pairs for what in ("play (pitches)", "events")),
        *(f"{pair.name} {what}" for pair in plan.pairs if pair.stroke for what in ("strokes", "teeth filed")),
    ]


def _columns(plan: TrialPlan, rows: TrialRecord) -> list[Floats]:
    """The columns of one block, as `_names` names them."""
    values = [rows.first + np.arange(len(rows.turns)), rows.turns, *np.degrees(rows.errors.T)]
    for at in range(len(plan.pairs)):
        values += [rows.backlash[:, at], rows.marks[:, at]]
    for at, pair in enumerate(plan.pairs):
        if pair.stroke:
            values += [rows.filing[:, 2 * at].astype(np.int64), rows.filing[:, 2 * at + 1].astype(np.int64)]
    return values
