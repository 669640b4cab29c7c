"""`geartrain teeth`: tooth numbers for a ratio, for the free wheels of a train, for an epicyclic set, for an orrery."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import Force, Json, Out, StateName, sink
from geartrain.cli.teeth import epicyclic, orrery, ratio, train
from geartrain.cli.teeth import search_options as belonging
from geartrain.cli.teeth.search_options import FORMS, SearchExecution, SearchOptions, is_train

Names = list[str] | None
Flag = bool


def run(
    context: typer.Context,
    wanted: Annotated[
        list[str],
        typer.Argument(
            help="A ratio; a train with free wheels; or several NAME=PERIOD in turns of one arbor.", metavar="WANTED..."
        ),
    ],
    stages: Annotated[int, typer.Option("--stages", min=1, max=5, help="Gear pairs one after the other.")] = 2,
    counts: Annotated[
        str, typer.Option("--range", help="Tooth counts that may be used, such as 15:120 or 30,36,48.")
    ] = "12:120",
    wheels: Annotated[str | None, typer.Option("--wheels", help="Counts of the larger wheel of each pair.")] = None,
    pinions: Annotated[str | None, typer.Option("--pinions", help="Counts of the smaller wheel of each pair.")] = None,
    tolerance: Annotated[
        str | None, typer.Option("--tolerance", help="Greatest relative error: 1e-6, 20 ppm, 0.001 %.")
    ] = None,
    best: Annotated[int, typer.Option("--best", min=1, max=100_000, help="How many solutions to list.")] = 20,
    by: Annotated[
        str, typer.Option("--by", help="Order: error, total, largest, distinct, hunting, centres; in a train: change.")
    ] = "error",
    per: Annotated[str | None, typer.Option("--per", help="With one period by name: the period it is seen in.")] = None,
    approximants: Annotated[Flag, typer.Option("--approximants", help="Fractions on the way to the ratio.")] = False,
    internal: Annotated[int, typer.Option("--internal", min=0, help="Pairs with a ring, which keep the sense.")] = 0,
    hunting: Annotated[Flag, typer.Option("--hunting", help="Wheels that mesh have no common divisor.")] = False,
    reverted: Annotated[Flag, typer.Option("--reverted", help="All pairs have one centre distance.")] = False,
    different: Annotated[Flag, typer.Option("--different", help="No count is there twice.")] = False,
    most_total: Annotated[int | None, typer.Option("--most-total", min=2, help="Greatest sum of all counts.")] = None,
    kind: Annotated[
        str | None, typer.Option("--kind", help="An epicyclic set instead of stages; 'list' names the kinds.")
    ] = None,
    mode: Annotated[str, typer.Option("--mode", help="Of a set: input:output:held, or all.")] = "all",
    ratio_is: Annotated[str, typer.Option("--ratio-is", help="input/output or output/input.")] = "input/output",
    planets: Annotated[str | None, typer.Option("--planets", help="Equal planets: 3, or carrier=3,...")] = None,
    clearance: Annotated[
        str | None, typer.Option("--clearance", help="Room between the tips of neighbouring planets, in modules.")
    ] = None,
    undercut: Annotated[
        str | None, typer.Option("--undercut", help="No wheel of a train is undercut at this pressure angle.")
    ] = None,
    interference: Annotated[
        str | None, typer.Option("--interference", help="Tips keep to the involute of their mates at this angle.")
    ] = None,
    largest_radius: Annotated[
        str | None, typer.Option("--largest-radius", help="Of a free wheel: a length, or modules.")
    ] = None,
    addendum: Annotated[str | None, typer.Option("--addendum", help="Of wheels of a train, in modules.")] = None,
    ring_addendum: Annotated[str | None, typer.Option("--ring-addendum", help="Of rings, in modules.")] = None,
    least: Annotated[int | None, typer.Option("--least", help="Least teeth of a free wheel.")] = None,
    most_teeth: Annotated[int | None, typer.Option("--most-teeth", help="Most teeth of a free wheel.")] = None,
    shift: Annotated[
        int, typer.Option("--shift", min=0, help="Half modules by which centre distances may differ.")
    ] = 0,
    coaxial: Annotated[
        bool | None, typer.Option("--coaxial/--no-coaxial", help="Wheels between the same axes fit in one module.")
    ] = None,
    closure: Annotated[Flag, typer.Option("--closure", help="Teeth of loops meet at the declared positions.")] = False,
    free: Annotated[
        str, typer.Option("--free", help="Of a train: search, uncertain, or wheels by name with commas.")
    ] = "search",
    state: StateName = None,
    where: Annotated[
        Names, typer.Option("--where", help="Where an assignment stands: wheel=32,wheel=50; may be repeated.")
    ] = None,
    pick: Annotated[int, typer.Option("--pick", min=1, help="Which solution -o writes as a declaration.")] = 1,
    effort: Annotated[int, typer.Option("--effort", min=1, help="Of an orrery: how widely to search.")] = 16,
    walk: Annotated[
        int | None, typer.Option("--walk", min=0, help="Of an orrery: extra arbors up to which all trees are walked.")
    ] = None,
    workers: Annotated[int | None, typer.Option("--workers", min=1, help="Processes; default all cores.")] = None,
    scheduler: Annotated[str | None, typer.Option("--scheduler", help="A dask scheduler, tcp://...")] = None,
    resume: Annotated[Flag, typer.Option("--resume", help="Take up a search that was cut.")] = False,
    csv: Annotated[Flag, typer.Option("--csv", help="Print the solutions as CSV.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Tooth numbers for a wanted motion: complete, exact, and with a reason where there are none."""
    asked = SearchOptions(tolerance, best, by, counts, wheels, pinions, csv, json, sink(out, force, FORMS), pick)
    means = SearchExecution(workers, scheduler, resume, out)
    belonging.check_texts(context, wanted)
    if kind is not None:
        if kind != "list":
            belonging.check(context, "an epicyclic set")
        epicyclic.run(asked, wanted, kind, mode, ratio_is, planets, clearance, per, shift)
    elif len(wanted) > 1 or "=" in wanted[0]:
        belonging.check(context, "an orrery")
        orrery.run(asked, wanted, effort, walk)
    elif is_train(wanted[0]):
        belonging.check(context, "a train")
        rules = {
            "planets": planets,
            "clearance": clearance,
            "undercut": undercut,
            "interference": interference,
            "largest_radius": largest_radius,
            "addendum": addendum,
            "ring_addendum": ring_addendum,
            "least": least,
            "most_teeth": most_teeth,
            "shift": shift,
            "coaxial": coaxial,
            "hunting": hunting,
            "different": different,
            "closure": closure,
        }
        train.run(asked, means, wanted[0], state, free, rules, where or [])
    else:
        belonging.check(context, "the fractions on the way" if approximants else "a ratio")
        fit = {
            "internal": internal,
            "hunting": hunting,
            "reverted": reverted,
            "different": different,
            "most_total": most_total,
        }
        ratio.run(asked, means, wanted[0], per, stages, fit, approximants)
