"""`geartrain torques`: torques, flow of power, losses, self-locking."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    GOOD,
    PICTURES,
    VERDICT,
    File,
    Force,
    Json,
    Out,
    Sink,
    StateName,
    check_distinct_outputs,
    draw,
    give,
    sink,
)

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Torques


def run(
    file: File,
    state: StateName = None,
    json: Json = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw the flow of power of one state to this file.")
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Torques on links and pairs under the declared loads, flow of power and losses, efficiency there and back."""
    from geartrain.analysis.loader import load
    from geartrain.report.torque_figures import collect_torque_report
    from geartrain.report.torque_report import describe_torques

    to = sink(out, force, (".md", ".html", ".json"))
    picture = sink(plot, force, PICTURES, "--plot")
    check_distinct_outputs(to, picture)
    train = load(file)
    states = (state,) if state is not None else train.states or (None,)
    found = [train.torques(name) for name in states]
    sound = all(each.verdict or each.verdict.kind == "unloaded" for each in found)
    if plot is not None:
        _draw(train, found, picture)
    report = collect_torque_report(train, found)
    give(to, json, lambda: report, lambda: [describe_torques(report)])
    raise typer.Exit(GOOD if sound else VERDICT)


def _draw(train: GearTrain, found: Sequence[Torques], picture: Sink) -> None:
    """The flow under the declared loads; without any, that of a unit of power from the input to the output."""
    from geartrain.drawing import power_figure
    from geartrain.dynamics.torques.power_flow import watts_per_unit
    from geartrain.report.torque_report import summary_text

    loaded = [each for each in found if each.verdict.kind != "unloaded"] if len(found) > 1 else list(found)
    if len(loaded) != 1:
        names = ", ".join(train.states)
        raise typer.BadParameter(f"one state is drawn: name it with --state, of {names}", param_hint="--plot")
    (torques,) = loaded
    name = train.name if torques.state is None else f"{train.name}, state {torques.state}"
    watts = watts_per_unit(train.declaration, train.declaration.case(torques.state))
    if torques.verdict.kind == "unloaded" and (ways := train.drive_both_ways(torques.state)):
        torques, source, load = ways[0]
        name, watts = f"{name}, while a unit of power leaves at '{load}', driven from '{source}'", None
    draw(power_figure(train.power_flow(torques), f"{name}: {summary_text(torques)}", watts), picture)
