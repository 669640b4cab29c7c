"""`geartrain view`: one HTML file in which the train turns."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    GOOD,
    INTERRUPTED,
    STANDARD_NAME,
    VERDICT,
    Fast,
    File,
    Force,
    StateName,
    Without,
    file_name,
    is_sound,
    load_all,
    plural,
    sink,
    tell,
)
from geartrain.cli.time_runs import Rate, Restitution, Skip, Steps, TimeRequest, ToothModel, Turns, run_in_time
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TimeRun

_MOST_ANGLES = 2_000_000  # of all links together, before few of them are chosen

Other = Annotated[str | None, typer.Argument(help="Another train, shown beside the first.", metavar="[FILE2]")]
Page = Annotated[
    Path | None,
    typer.Option("--output-file", "-o", help="The page; default NAME.html in this folder; - is standard output."),
]


def run(
    file: File,
    other: Other = None,
    out: Page = None,
    state: StateName = None,
    open_it: Annotated[bool, typer.Option("--open", help="Show it in the browser.")] = False,
    force: Force = False,
    teeth: Annotated[bool, typer.Option("--teeth/--no-teeth", help="Draw the teeth, or plain discs.")] = True,
    dynamics: Annotated[
        bool, typer.Option("--dynamics", help="Play the motion in time of one state, with play and impacts.")
    ] = False,
    rate: Rate = None,
    turns: Turns = None,
    skip: Skip = None,
    steps: Steps = None,
    restitution: Restitution = None,
    model: ToothModel = None,
    without: Without = None,
    fast: Fast = None,
) -> None:
    """A page in which the train turns: one file, no server, no network; two trains stand side by side."""
    from geartrain.scene import make_scene
    from geartrain.viewer import page

    request = TimeRequest(rate, turns, skip, steps, restitution, model, without, fast)
    _check_request(request, dynamics, other)
    trains = load_all([file] if other is None else [file, other])
    path = out or file_name("-".join(train.name for train in trains), ".html")
    _check_suffix(path)
    to = sink(path, force)
    shown = [(train, each) for train in trains for each in _states(train, state, first=dynamics or other is not None)]
    runs = [_played(train, each, request) if dynamics else None for train, each in shown]
    scenes = [make_scene(train, each, run=run, formulas=True) for (train, each), run in zip(shown, runs, strict=True)]
    text = page(scenes, compare=other is not None, teeth=teeth)
    data = text.encode("utf-8")
    to.write(data, f": {plural(len(scenes), 'scene')}, {len(data) / 1000:,.0f} kB")
    if open_it and to.path is not None and not webbrowser.open(path.resolve().as_uri()):
        tell("no browser could be started here; open the file by hand")
    for run in runs:
        if run is not None and not run.complete:
            tell(f"stopped after {run.turns[-1]:.4g} turns; the page shows those")
            raise typer.Exit(INTERRUPTED)
    raise typer.Exit(GOOD if all(is_sound(train, each) for train, each in shown) else VERDICT)


def _check_request(request: TimeRequest, dynamics: bool, other: str | None) -> None:
    """Raises `QuestionError` for options of a motion in time that is not asked for, or asked of two trains."""
    if not dynamics and request != TimeRequest():
        why = "without --dynamics the train turns as its crank does, and nothing is simulated"
        raise QuestionError(Problem("options of motion in time", why, "add --dynamics, or leave them out"))
    if dynamics and other is not None:
        why = "each runs by its own clock, and two trains on one page have one crank"
        raise QuestionError(Problem("motion in time of two trains", why, "write a page for each", other))


def _played(train: GearTrain, state: str | None, request: TimeRequest) -> TimeRun:
    """The run that is shown, sampled at every step of its coarser run where that is not too much."""
    samples = _MOST_ANGLES // len(train.declaration.links)
    return run_in_time(train, state, request.arguments() | {"samples": samples})


def _states(train: GearTrain, state: str | None, first: bool) -> Sequence[str | None]:
    """The states that are shown: the one that is named, else all, or the `first` only."""
    if state is not None:
        return (state,)
    names = train.states or (None,)
    return names[:1] if first else names


def _check_suffix(path: Path) -> None:
    """Raises `QuestionError` where a browser would not know the file for a page."""
    if path == STANDARD_NAME or path.suffix.lower() in (".html", ".htm") or path.is_dir():
        return
    why = f"'{path.suffix}' is no suffix of a page" if path.suffix else "its name has no suffix"
    raise QuestionError(Problem("the page cannot be written", why, "let it end in .html", str(path)))
