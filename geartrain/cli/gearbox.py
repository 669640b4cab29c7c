"""`geartrain gearbox`: table of all states of a train with clutches, and search for all possible gears."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, give, sink


def run(
    file: File,
    output: Annotated[
        str | None, typer.Option("--of", help="Output link; default: the first output that is not the input.")
    ] = None,
    search: Annotated[
        bool, typer.Option("--search", help="Try every combination of clutches and brakes that determines the speeds.")
    ] = False,
    gears: Annotated[
        int,
        typer.Option(
            "--gears",
            min=0,
            help="Number of forward gears; lists gear sequences of this length, in order of ratio.",
        ),
    ] = 0,
    steps: Annotated[
        tuple[float, float],
        typer.Option("--ratio-steps", help="Minimum and maximum ratio step between successive gears of a series."),
    ] = (1.05, 2.0),
    single: Annotated[
        bool, typer.Option("--single", help="Allow only shifts in which one element opens and one closes.")
    ] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Tabulate the ratio, step, speeds, slip, recirculating power, and torques of clutches and brakes in every state.

    Example: `geartrain gearbox zf-8hp70 --search --gears 8`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.report.gearbox_report import describe_gear_search, describe_gearbox

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    if search or gears:
        from geartrain.analysis.gear_series import find_gears

        found = find_gears(train, output, gears, steps, single)
        give(to, json, lambda: found, lambda: [describe_gear_search(found)])
        raise typer.Exit(GOOD if found.gears and (gears < 2 or found.series) else VERDICT)
    box = train.gearbox(output)
    give(to, json, lambda: box, lambda: [describe_gearbox(box)])
    raise typer.Exit(GOOD if all(train.solve(name) for name in train.states) else VERDICT)
