"""Executors, journals and progress bars of long commands, and options of simulations in the time domain.

Ctrl-C ends a simulation after the current step.
"""

from __future__ import annotations

import hashlib
import json
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from geartrain.cli.common import Names, tell
from geartrain.cli.option_values import MOST_COUNT, exact, input_rate, whole
from geartrain.cli.option_values import restitution as read_restitution
from geartrain.errors import QuestionError

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from rich.progress import Progress, TaskID

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.work import Execution, Journal
    from geartrain.scene.scene_run import TimeRun

Workers = Annotated[
    str | None,
    typer.Option(
        "--workers",
        metavar="N",
        help="Number of processes (default: one per core), or the address of a dask scheduler, such as tcp://host:8786.",
    ),
]
Resume = Annotated[bool, typer.Option("--resume", help="Resume an interrupted run.")]

COMPILING = "compiling kernels for this machine: 10 to 30 s, only once"


class ProgressBar:
    """Progress bar with the completed part of a long computation, displayed only on a terminal."""

    def __init__(self, shown: Progress, task: TaskID, patience: float) -> None:
        self._shown, self._task, self._from = shown, task, time.monotonic() + patience

    def advance(self, steps: int = 1) -> None:
        """Add `steps` to the number of completed parts of the computation."""
        self._shown.update(self._task, advance=steps, visible=time.monotonic() >= self._from)

    def reach(self, done: int, total: int) -> None:
        """Set the numbers of completed and of all parts of the computation; hide the bar if there is only one part."""
        self._shown.update(self._task, completed=done, total=total or None, visible=total > 1)


@contextmanager
def progress(what: str, total: int | None = None, patience: float = 0.0) -> Iterator[ProgressBar]:
    """Show a progress bar on standard error, if the work takes longer than `patience` [s], and notes on compilation."""
    from rich.console import Console
    from rich.progress import Progress, TimeElapsedColumn

    from geartrain.numerics.kernels import telling

    columns = (*Progress.get_default_columns(), TimeElapsedColumn())
    hidden = not sys.stderr.isatty()
    with Progress(*columns, console=Console(stderr=True, quiet=hidden), transient=True, disable=hidden) as shown:
        task = shown.add_task(what, total=total, visible=total is not None and not patience)
        with telling(partial(shown.console.print, COMPILING, highlight=False)):
            yield ProgressBar(shown, task, patience)


@dataclass(frozen=True)
class RunOptions:
    """Options of a long computation: the workers, and whether an interrupted computation is resumed."""

    workers: str | None
    """Number of processes or address of a dask scheduler, as text; None for one process per core."""
    resume: bool = False

    @contextmanager
    def executor(self, what: str) -> Iterator[Executor | None]:
        """Open an executor and print the numbers of tasks and workers; yield None if tasks run in this process."""
        from geartrain.numerics.work import open_executor

        def announce(tasks: int, workers: int) -> None:
            size = f"{tasks} tasks on " if tasks else ""
            tell(f"{what}: {size}{workers} worker {'process' if workers == 1 else 'processes'}")

        text = self.workers or ""
        # a colon marks the address of a scheduler
        count = None if not text or ":" in text else whole("--workers", text, "number of processes", "4", 1)
        with open_executor(count, text if ":" in text else None, announce) as executor:
            yield executor


def close_journal(journal: Journal | None, cut: bool) -> None:
    """Remove the journal of a complete computation, or print how an interrupted (`cut`) computation can be resumed."""
    if not cut:
        if journal is not None:
            journal.finish()
    elif journal is not None and len(journal):
        tell(f"stopped; finished work is in {journal.path}; repeat the command with --resume to continue")
    else:
        tell("stopped before any work was finished")


@contextmanager
def long_run(what: str, question: Mapping[str, Any], out: Path | None, options: RunOptions) -> Iterator[Execution]:
    """Open an executor, a progress bar and, if the folder is writable, a journal for the computation of `question`."""
    from geartrain.numerics.work import Execution

    # in the form in which it is read from a journal, so that both can be compared
    plain = json.loads(json.dumps(question, default=str))
    # the name depends on the question, so that runs with other options have other journals
    mark = hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()[:8]
    path = (out.parent if out else Path()) / f"{what}-{mark}.partial.jsonl"
    with (
        options.executor(what) as executor,
        _journal(path, plain, options.resume) as journal,
        progress(what) as bar,
    ):
        yield Execution(executor, journal, bar.reach)


@contextmanager
def _journal(path: Path, question: Mapping[str, Any], resume: bool) -> Iterator[Journal | None]:
    """Yield the journal at `path` for the computation of `question`; None if its folder is not writable."""
    from geartrain.numerics.work import Journal, another_question

    # a run works without a journal, but it cannot be resumed then
    if not resume and not os.access(path.parent, os.W_OK):
        yield None
        return
    if resume and not path.exists():
        # journals of the same command with other options
        others = sorted(path.parent.glob(f"{path.name.partition('-')[0]}-*.partial.jsonl"))
        if problems := [another_question(other, question) for other in others]:
            raise QuestionError(problems)
        tell(f"nothing to resume: {path} does not exist; starting a new run")
    with Journal(path, question, resume=resume) as journal:
        try:
            yield journal
        finally:
            if not journal.closed and not len(journal):  # an empty journal is not kept
                journal.finish()


# ------------------------------------------------------------------------------------------------------- motion in time


TURNS, SKIP = "10", "1"
Rate = Annotated[
    str | None,
    typer.Option(
        "--rate", help="Input speed, in turns per second or with a unit such as '30 rpm'; default: the declared speed."
    ),
]
Turns = Annotated[
    str | None, typer.Option("--turns", help=f"Revolutions of the driving link to evaluate; default: {TURNS}.")
]
Skip = Annotated[
    str | None, typer.Option("--skip", help=f"Revolutions to simulate before evaluation; default: {SKIP}.")
]
Steps = Annotated[
    int | None,
    typer.Option(
        "--steps",
        min=1,
        max=MOST_COUNT,
        help="Time steps per revolution of the driving link; default: chosen from tooth counts, stiffness and "
        "escapements.",
    ),
]
Restitution = Annotated[
    str | None,
    typer.Option(
        "--restitution", help="Coefficient of restitution of every impact, 0 to 1; default: the declared value, or 0."
    ),
]
ToothModel = Annotated[
    Literal["rigid", "compliant"] | None,
    typer.Option("--model", help="Tooth model: rigid (default), or compliant (with tooth stiffness)."),
]

_MOST_TURNS = 1e9
_WHOLE = 1_000_000  # length of a progress bar


@dataclass(frozen=True)
class TimeRequest:
    """Options of a simulation in the time domain. Options that are not given on the command line are None."""

    rate: str | None = None
    turns: str | None = None
    skip: str | None = None
    steps: int | None = None
    restitution: str | None = None
    model: Literal["rigid", "compliant"] | None = None
    without: Names = None
    fast: bool | None = None

    def arguments(self) -> dict[str, Any]:
        """Return the arguments of `GearTrain.dynamics`. Raise `GearTrainError` if a value is not allowed."""
        turns, skip = TURNS if self.turns is None else self.turns, SKIP if self.skip is None else self.skip
        return {
            "rate": None if self.rate is None else input_rate(self.rate),
            "turns": float(exact("--turns", turns, "number of turns", "20", 0, _MOST_TURNS)),
            "skip": float(exact("--skip", skip, "number of turns", "1", 0, _MOST_TURNS)),
            "steps": self.steps,
            "restitution": None if self.restitution is None else read_restitution(self.restitution),
            "without": tuple(self.without or ()),
            "fast": self.fast,
            "model": self.model or "rigid",
        }


def run_in_time(train: GearTrain, state: str | None, requested: dict[str, Any]) -> TimeRun:
    """Run a simulation in the time domain with a progress bar. Ctrl-C ends the simulation after the current step."""
    with interruptible("motion in time") as on_done:
        return train.dynamics(state=state, **requested, on_done=on_done)


@contextmanager
def interruptible(what: str) -> Iterator[Callable[[float], bool]]:
    """Yield a function that advances a progress bar by a fraction of the work, and returns True after a Ctrl-C."""
    interrupted = False

    def note(number: int, frame: Any) -> None:
        nonlocal interrupted
        signal.signal(signal.SIGINT, before)
        interrupted = True

    with progress(what, _WHOLE, patience=2.0) as bar:

        def on_done(share: float) -> bool:
            bar.advance(round(share * _WHOLE))
            return interrupted

        before = signal.getsignal(signal.SIGINT)
        signal.signal(signal.SIGINT, note)
        try:
            yield on_done
        finally:
            signal.signal(signal.SIGINT, before)
