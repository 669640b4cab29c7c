"""`geartrain bench`: accuracy against run time for a train."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, chosen_states, give, sink


def run(
    file: File,
    state: StateName = None,
    positions: Annotated[
        int,
        typer.Option(
            "--positions", min=2, max=1_000_000, help="Number of angles of each pair, and of input positions."
        ),
    ] = 10_000,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Measure accuracy against run time for a train: speeds, transmission functions, motion, torques."""
    from geartrain.analysis.accuracy import find_accuracy
    from geartrain.analysis.gear_train import load
    from geartrain.report.accuracy_report import AccuracyReport, describe_accuracy

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    measured = tuple(find_accuracy(train, name, positions) for name in chosen_states(train, state))
    found = AccuracyReport(train.name, train.declaration.title, measured)
    give(to, json, lambda: found, lambda: [describe_accuracy(found)])
    raise typer.Exit(VERDICT if any("speeds" in each.neglected for each in measured) else GOOD)
