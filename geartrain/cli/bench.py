"""`geartrain bench`: error against run time on the user's own train."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, give, sink


def run(
    file: File,
    state: StateName = None,
    positions: Annotated[
        int, typer.Option("--positions", min=2, max=1_000_000, help="Positions of laws and of the motion.")
    ] = 10_000,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Measure error against run time on a train: exact and float speeds, transmission functions, motion, torques."""
    from geartrain.analysis import find_accuracy
    from geartrain.analysis.loader import load
    from geartrain.analysis.method_accuracy import SPEEDS
    from geartrain.report.accuracy_report import AccuracyReport, describe_accuracy

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    states = (state,) if state is not None else train.states or (None,)
    measured = tuple(find_accuracy(train, name, positions) for name in states)
    found = AccuracyReport(train.name, train.declaration.title, measured)
    give(to, json, lambda: found, lambda: [describe_accuracy(found)])
    raise typer.Exit(VERDICT if any(SPEEDS in each.left_out for each in measured) else GOOD)
