"""Command `geartrain teeth set RATIO --kind ...`: search for epicyclic sets with a given ratio."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from geartrain.cli.common import Force, Json, Out, give, option_error
from geartrain.cli.option_values import decimal
from geartrain.search.teeth_verb import (
    ANY_COUNT,
    NEGATIVE_NUMBERS,
    Best,
    Clearance,
    Per,
    Pick,
    Range,
    SearchAnswer,
    Shift,
    Tolerance,
    check_number,
    read_tolerance,
)

context_settings = NEGATIVE_NUMBERS


def run(
    context: typer.Context,
    kind: Annotated[str, typer.Option("--kind", help="Kind of epicyclic set; 'list' prints all kinds.")],
    ratio: Annotated[
        str | None, typer.Argument(help="Requested ratio; omit it with --kind list.", metavar="RATIO")
    ] = None,
    counts: Range = ANY_COUNT,
    mode: Annotated[
        str,
        typer.Option("--mode", help="Modes INPUT:OUTPUT:HELD such as sun:carrier:ring, separated by commas, or all."),
    ] = "all",
    ratio_is: Annotated[
        str, typer.Option("--ratio-is", help="Definition of the ratio: input/output or output/input.")
    ] = "input/output",
    planets: Annotated[
        int | None,
        typer.Option("--planets", help="Require that this number of equal, equally spaced planets can be assembled."),
    ] = None,
    clearance: Clearance = None,
    shift: Shift = 0,
    tolerance: Tolerance = None,
    best: Best = 20,
    by: Annotated[
        str,
        typer.Option(
            "--sort",
            help="Sort the solutions by error, total (sum of tooth counts) or largest (largest tooth count).",
        ),
    ] = "error",
    per: Per = None,
    pick: Pick = 1,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Find epicyclic sets of one kind that have a given ratio and can be assembled with equal planets.

    Example: `geartrain teeth set 7/2 --kind planetary --planets 3`.
    """
    from geartrain.search.epicyclic.set_search import find_sets
    from geartrain.search.target_ratio import read_ratio
    from geartrain.search.tooth_count_ranges import read_counts

    answer = SearchAnswer.of(json, out, force, pick)
    if kind == "list":
        from geartrain.search.epicyclic.epicyclic_sets import EPICYCLIC_KINDS
        from geartrain.search.tooth_numbers_report import describe_set_kinds

        give(answer.out, answer.json, lambda: EPICYCLIC_KINDS, lambda: [describe_set_kinds(EPICYCLIC_KINDS)])
        return
    if ratio is None:
        raise option_error("RATIO", "the ratio is missing", "give a ratio, or list the kinds with --kind list")
    if clearance is not None and planets is None:
        raise option_error(
            "--clearance", "--planets is missing", "add --planets 3", "the clearance depends on the number of planets"
        )
    room = decimal("--clearance", clearance or "0", "number of modules", "0.5")
    chosen: Any = "all" if mode == "all" else tuple(mode.split(","))
    found = find_sets(
        read_ratio(check_number(context, ratio), per),
        kind,
        chosen,
        read_counts(counts),
        3 if planets is None else planets,
        read_tolerance(tolerance),
        best,
        ratio_is=ratio_is,  # type: ignore[arg-type]
        by=by,  # type: ignore[arg-type]
        spaced=planets is not None,
        clearance=room,
        slack=shift,
    )
    answer.give(found, lambda at: found.solutions[at].to_train(planets or 1))
