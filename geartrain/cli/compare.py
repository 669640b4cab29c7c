"""`geartrain compare`: alternative reconstructions side by side."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, Files, Force, Json, Out, give, load_all, sink


def run(
    files: Files,
    out: Out = None,
    json: Json = False,
    everything: Annotated[
        bool, typer.Option("--all", help="All outputs, not only those with a dial or target.")
    ] = False,
    force: Force = False,
) -> None:
    """Put the outputs of several trains side by side, with their errors against the targets."""
    from geartrain.report.reconstruction_comparison import describe_comparison
    from geartrain.report.train_data import collect_report

    to = sink(out, force, (".md", ".html", ".json"))
    trains = load_all(files)
    sound = all(answer for train in trains for answer in train.answers())
    give(
        to, json, lambda: [collect_report(train) for train in trains], lambda: [describe_comparison(trains, everything)]
    )
    raise typer.Exit(GOOD if sound else VERDICT)
