"""Command `geartrain dynamics`: simulate the motion in time with inertia, backlash, impacts, drag and friction."""

from __future__ import annotations

from math import tau
from pathlib import Path
from typing import Annotated

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
    run_in_time,
)
from geartrain.cli.option_values import Theme


def run(
    file: File,
    rate: Rate = None,
    turns: Turns = None,
    skip: Skip = None,
    steps: Steps = None,
    restitution: Restitution = None,
    model: ToothModel = None,
    output: Annotated[Names, typer.Option("--of", help="Output or link to report; may be repeated.")] = None,
    state: FirstState = None,
    without: Without = None,
    fast: Fast = None,
    json: Json = False,
    plot: Annotated[
        Path | None,
        typer.Option("--plot", help="Plot tooth gaps, deviations of the outputs and their spectrum to this file."),
    ] = None,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Simulate the motion in time: separation of teeth, impacts, outputs and energy; -o x.csv writes all samples.

    Example: `geartrain dynamics moon-triangular-inertia --rate 1 --turns 1`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.simulation.time.time_report import collect_time_report, describe_time_run

    to = sink(out, force, (".md", ".html", ".json", ".csv"))
    picture = picture_sink(plot, force, theme)
    # both outputs must not overwrite each other
    check_distinct_outputs(to, picture)
    request = TimeRequest(rate, turns, skip, steps, restitution, model, without, fast)
    requested = request.arguments() | {"outputs": tuple(output or ())}
    train = load(file)
    found = run_in_time(train, train.declaration.state_or_first(state), requested)
    if to.suffix == ".csv":
        emit(found.to_csv().rstrip("\n"), to)
    else:
        report = collect_time_report(train, found, requested["without"])
        give(to, json, lambda: report, lambda: [describe_time_run(report)])
    if plot is not None:
        from geartrain.simulation.time.time_run_plot import time_run_figure

        name = train.name if found.state is None else f"{train.name}, state {found.state}"
        draw(
            time_run_figure(found, f"{name}: in time, {abs(found.rate) / tau:.4g} turn/s of {found.driving_link}"),
            picture,
        )
    if not found.complete:
        tell(f"stopped after {found.turns[-1]:.4g} turns; the results are for these turns")
        raise typer.Exit(INTERRUPTED)
    if found.unsolved:
        raise typer.Exit(VERDICT)
