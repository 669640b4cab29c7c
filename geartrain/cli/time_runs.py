"""Motion in time as commands ask for it: options, and a run that tells how far it is and can be ended."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from geartrain.cli.common import Names
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import MOST_COUNT, exact, input_rate
from geartrain.cli.option_values import restitution as read_restitution

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.scene_run import TimeRun

TURNS, SKIP = "10", "1"
Rate = Annotated[
    str | None, typer.Option("--rate", help="Turns a second of the input, or such as '30 rpm'; default the drive.")
]
Turns = Annotated[str | None, typer.Option("--turns", help=f"Turns of the input that are counted; default {TURNS}.")]
Skip = Annotated[str | None, typer.Option("--skip", help=f"Turns before, which are not counted; default {SKIP}.")]
Steps = Annotated[
    int | None,
    typer.Option("--steps", min=1, max=MOST_COUNT, help="Steps in a turn of the input; default by its teeth."),
]
Restitution = Annotated[
    str | None, typer.Option("--restitution", help="Of all impacts, 0 to 1; default as declared, or 0.")
]
ToothModel = Annotated[
    Literal["rigid", "compliant"] | None,
    typer.Option("--model", help="Teeth that are rigid, the default, or yield by their stiffness."),
]

_MOST_TURNS = 1e9
_WHOLE = 1_000_000  # of a bar


@dataclass(frozen=True)
class TimeRequest:
    """What is asked of a train in time, as options give it; None where nothing is."""

    rate: str | None = None
    turns: str | None = None
    skip: str | None = None
    steps: int | None = None
    restitution: str | None = None
    model: Literal["rigid", "compliant"] | None = None
    without: Names = None
    fast: bool | None = None

    def arguments(self) -> dict[str, Any]:
        """What `GearTrain.dynamics` is given. Raises `GearTrainError` for what is no number, or out of range."""
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


def run_in_time(train: GearTrain, state: str | None, asked: dict[str, Any]) -> TimeRun:
    """The run, with a bar that tells how far it is; Ctrl-C ends it after the step that it is in."""
    with interruptible("motion in time") as on_done:
        return train.dynamics(state=state, **asked, on_done=on_done)


@contextmanager
def interruptible(what: str) -> Iterator[Callable[[float], bool]]:
    """A bar, as what is told each further share of the work; it answers True once Ctrl-C has come."""
    with progress(what, _WHOLE, patience=2.0) as bar, _interrupts() as came:

        def on_done(share: float) -> bool:
            bar.advance(round(share * _WHOLE))
            return bool(came)

        yield on_done


@contextmanager
def _interrupts() -> Iterator[list[int]]:
    """A list into which the first Ctrl-C goes; the second ends all as ever."""
    came: list[int] = []

    def note(number: int, frame: Any) -> None:
        signal.signal(signal.SIGINT, before)
        came.append(number)

    before = signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, note)
    try:
        yield came
    finally:
        signal.signal(signal.SIGINT, before)
