"""`geartrain dynamics`: motion in time, with inertia, play, impacts, drag and friction."""

from __future__ import annotations

from math import tau
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    VERDICT,
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
    picture_sink,
    sink,
    tell,
)
from geartrain.cli.long_runs import (
    Rate,
    Restitution,
    Skip,
    Steps,
    TimeRequest,
    ToothModel,
    Turns,
    interruptible,
    run_in_time,
)
from geartrain.cli.option_values import Theme

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.simulation.time.stepped_separation import SteppedSeparation
    from geartrain.simulation.time.time_run import TimeRun


def run(
    file: File,
    rate: Rate = None,
    turns: Turns = None,
    skip: Skip = None,
    steps: Steps = None,
    restitution: Restitution = None,
    model: ToothModel = None,
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
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Motion in time: when teeth part, how often they strike, what outputs and energy do; to a .csv, its course."""
    from geartrain.analysis.gear_train import load
    from geartrain.simulation.time.time_report import collect_time_report, describe_time_run

    to = sink(out, force, (".md", ".html", ".json", ".csv"))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    if csv and to.path is not None:
        raise typer.BadParameter("the course is printed, or written: give --csv, or -o x.csv", param_hint="--csv")
    request = TimeRequest(rate, turns, skip, steps, restitution, model, without, fast)
    requested = request.arguments() | {"outputs": tuple(output or ())}
    train = load(file)
    found = run_in_time(train, train.declaration.state_or_first(state), requested)
    stepped = None
    if csv or to.suffix == ".csv":
        emit(found.to_csv().rstrip("\n"), to)
    else:
        if find_rate and found.complete:
            stepped = _stepped(train, found, requested)
        report = collect_time_report(train, found, requested["without"], stepped)
        give(to, json, lambda: report, lambda: [describe_time_run(report)])
    if plot is not None:
        from geartrain.simulation.time.time_run_plot import time_run_figure

        name = train.name if found.state is None else f"{train.name}, state {found.state}"
        draw(
            time_run_figure(found, f"{name}: in time, {abs(found.rate) / tau:.4g} turn/s of {found.driving_link}"),
            picture,
        )
    if not found.complete:
        tell(f"stopped after {found.turns[-1]:.4g} turns; the figures are of those")
        raise typer.Exit(INTERRUPTED)
    if stepped is not None and not stepped.complete:
        tell("stopped before the rate at which teeth part was found as well as it can be")
        raise typer.Exit(INTERRUPTED)
    if found.unsolved:
        raise typer.Exit(VERDICT)


def _stepped(train: GearTrain, found: TimeRun, requested: dict[str, Any]) -> SteppedSeparation:
    """The rate at which teeth first part, in as many turns from the start; Ctrl-C ends it with what is known."""
    from geartrain.simulation.time.train_in_time import step_to_separation

    more = {name: requested[name] for name in ("steps", "without", "fast")}
    with interruptible("rate at which teeth part") as on_done:
        turns = requested["turns"] + requested["skip"]
        return step_to_separation(train.mechanics, found.state, turns, **more, on_done=on_done)
