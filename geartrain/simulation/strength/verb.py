"""Command `geartrain strength`: compute contact pressure, root stress, safety factors and wear of pairs, and stresses
of arbors.
"""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, chosen_states, give, sink


def run(
    file: File,
    state: StateName = None,
    json: Json = False,
    turns: Annotated[
        float | None,
        typer.Option("--turns", min=0, help="Compute wear over this number of revolutions of the driving link."),
    ] = None,
    years: Annotated[
        float | None,
        typer.Option(
            "--years", min=0, help="Compute wear over this number of years; the train must declare `unit` or `rate`."
        ),
    ] = None,
    wear: Annotated[
        tuple[float, float] | None,
        typer.Option("--wear", help="Minimum and maximum coefficient K of Archard's wear law; default: 1e-7 1e-3."),
    ] = None,
    over: Annotated[
        float | None,
        typer.Option(
            "--peak-turns",
            min=0,
            help="Compute stresses from the maximum torques over this number of revolutions; default: mean torques.",
        ),
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute contact pressure, root stress, safety and wear of pairs, and stresses of arbors, under declared loads.

    Example: `geartrain strength longcase-clock-loaded --years 10`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.simulation.strength.strength_report import collect_strength_report, describe_strength

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    states = chosen_states(train, state)
    found = [train.strength(name, turns=turns, years=years, wear=wear, over=over) for name in states]
    report = collect_strength_report(train, found)
    give(to, json, lambda: report, lambda: [describe_strength(report)])
    weak = any(each.weakest is not None and each.weakest.safety < 1 for each in found)
    sound = all(each.verdict and (each.pairs or each.points or each.pins) for each in found) and not weak
    raise typer.Exit(GOOD if sound else VERDICT)
