"""`geartrain dynamics`: motion in time, with inertia, play, impacts, drag and friction."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from math import tau
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    PICTURES,
    Fast,
    File,
    FirstState,
    Force,
    Json,
    Names,
    Out,
    Without,
    check_distinct_outputs,
    draw,
    emit,
    give,
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import MOST_COUNT, exact, input_rate
from geartrain.cli.option_values import restitution as read_restitution

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import SteppedSeparation, TimeRun

_MOST_TURNS = 1e9
_WHOLE = 1_000_000  # of a bar


def run(
    file: File,
    rate: Annotated[
        str | None, typer.Option("--rate", help="Turns a second of the input, or such as '30 rpm'; default the drive.")
    ] = None,
    turns: Annotated[str, typer.Option("--turns", help="Turns of the input that are counted.")] = "10",
    skip: Annotated[str, typer.Option("--skip", help="Turns before, which are not counted.")] = "1",
    steps: Annotated[
        int | None,
        typer.Option("--steps", min=1, max=MOST_COUNT, help="Steps in a turn of the input; default by its teeth."),
    ] = None,
    restitution: Annotated[
        str | None, typer.Option("--restitution", help="Of all impacts, 0 to 1; default as declared, or 0.")
    ] = None,
    model: Annotated[
        Literal["rigid", "compliant"],
        typer.Option("--model", help="Teeth that are rigid, or yield by their stiffness."),
    ] = "rigid",
    find_rate: Annotated[
        bool, typer.Option("--find-rate", help="Also seek by stepping the rate at which teeth first part.")
    ] = False,
    output: Annotated[Names, typer.Option("--output", help="Output or link; may be repeated.")] = None,
    state: FirstState = None,
    without: Without = None,
    fast: Fast = None,
    json: Json = False,
    csv: Annotated[bool, typer.Option("--csv", help="Print angles, speeds, torques and gaps as CSV.")] = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw gaps, outputs ahead and behind, and spectrum to this file.")
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Motion in time: when teeth part, how often they strike, what outputs and energy do; to a .csv, its course."""
    from geartrain.analysis.loader import load
    from geartrain.report.time_report import collect_time_report, describe_time_run

    to = sink(out, force, (".md", ".html", ".json", ".csv"))
    picture = sink(plot, force, PICTURES, "--plot")
    check_distinct_outputs(to, picture)
    if csv and to.path is not None:
        raise typer.BadParameter("the course is printed, or written: give --csv, or -o x.csv", param_hint="--csv")
    asked: dict[str, Any] = {
        "rate": None if rate is None else input_rate(rate),
        "turns": float(exact("--turns", turns, "number of turns", "20", 0, _MOST_TURNS)),
        "skip": float(exact("--skip", skip, "number of turns", "1", 0, _MOST_TURNS)),
        "steps": steps,
        "restitution": None if restitution is None else read_restitution(restitution),
        "outputs": tuple(output or ()),
        "without": tuple(without or ()),
        "fast": fast,
        "model": model,
    }
    train = load(file)
    found = _run(train, train.state_or_first(state), asked)
    if csv or to.suffix == ".csv":
        emit(found.to_csv().rstrip("\n"), to)
    else:
        stepped = _stepped(train, found, asked) if find_rate and found.complete else None
        report = collect_time_report(train, found, asked["without"], stepped)
        give(to, json, lambda: report, lambda: [describe_time_run(report)])
    if plot is not None:
        from geartrain.drawing import time_run_figure

        name = train.name if found.state is None else f"{train.name}, state {found.state}"
        draw(time_run_figure(found, f"{name}: in time, {abs(found.rate) / tau:.4g} turn/s of {found.lead}"), picture)
    if not found.complete:
        tell(f"stopped after {found.turns[-1]:.4g} turns; the figures are of those")
        raise typer.Exit(INTERRUPTED)


def _run(train: GearTrain, state: str | None, asked: dict[str, Any]) -> TimeRun:
    """The run, with a bar that tells how far it is; Ctrl-C ends it after the step that it is in."""
    with progress("motion in time", _WHOLE, patience=2.0) as bar, _interrupts() as came:

        def on_done(share: float) -> bool:
            bar.advance(round(share * _WHOLE))
            return bool(came)

        return train.dynamics(state=state, **asked, on_done=on_done)


def _stepped(train: GearTrain, found: TimeRun, asked: dict[str, Any]) -> SteppedSeparation:
    """The rate at which teeth first part, in as many turns from the start."""
    more = {name: asked[name] for name in ("steps", "without", "fast")}
    with progress("rate at which teeth part", patience=2.0) as bar:
        return train.stepped_separation(found.state, asked["turns"] + asked["skip"], **more, on_done=bar.advance)


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
