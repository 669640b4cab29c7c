"""`geartrain teeth train FILE`: the free wheels of a train."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import File, Force, Json, Names, Out, StateName
from geartrain.cli.long_runs import Dask, Resume, RunOptions, Workers, close_journal, long_run
from geartrain.search.teeth_verb import Best, Csv, Pick, SearchAnswer, Tolerance, read_tolerance

Flag = bool


def run(
    file: File,
    free: Annotated[
        str, typer.Option("--free", help="Which wheels: search, uncertain, or wheels by name with commas.")
    ] = "search",
    state: StateName = None,
    tolerance: Tolerance = None,
    best: Best = 20,
    by: Annotated[
        str, typer.Option("--by", help="Order: error, total, largest, distinct, hunting, centres, change.")
    ] = "error",
    planets: Annotated[str | None, typer.Option("--planets", help="Equal planets: 3, or carrier=3,...")] = None,
    clearance: Annotated[
        str | None, typer.Option("--clearance", help="Room between the tips of neighbouring planets, in modules.")
    ] = None,
    undercut: Annotated[
        str | None, typer.Option("--undercut", help="No wheel is undercut at this pressure angle.")
    ] = None,
    interference: Annotated[
        str | None, typer.Option("--interference", help="Tips keep to the involute of their mates at this angle.")
    ] = None,
    largest_radius: Annotated[
        str | None, typer.Option("--largest-radius", help="Of a free wheel: a length, or modules.")
    ] = None,
    addendum: Annotated[str | None, typer.Option("--addendum", help="Of wheels, in modules.")] = None,
    ring_addendum: Annotated[str | None, typer.Option("--ring-addendum", help="Of rings, in modules.")] = None,
    minimum: Annotated[int | None, typer.Option("--minimum", help="Minimum tooth count of a free wheel.")] = None,
    most_teeth: Annotated[int | None, typer.Option("--most-teeth", help="Most teeth of a free wheel.")] = None,
    shift: Annotated[
        int, typer.Option("--shift", min=0, help="Half modules by which centre distances may differ.")
    ] = 0,
    coaxial: Annotated[
        bool | None, typer.Option("--coaxial/--no-coaxial", help="Wheels between the same axes fit in one module.")
    ] = None,
    hunting: Annotated[Flag, typer.Option("--hunting", help="Wheels that mesh have no common divisor.")] = False,
    different: Annotated[Flag, typer.Option("--different", help="No count is there twice.")] = False,
    closure: Annotated[Flag, typer.Option("--closure", help="Teeth of loops meet at the declared positions.")] = False,
    where: Annotated[
        Names, typer.Option("--where", help="Where an assignment stands: wheel=32,wheel=50; may be repeated.")
    ] = None,
    pick: Pick = 1,
    workers: Workers = None,
    dask: Dask = None,
    resume: Resume = False,
    csv: Csv = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Counts of the free wheels of a train that meet all its targets at once, under the rules given."""
    from geartrain.search.constraints.constraint_options import read_constraint_options
    from geartrain.search.tooth_numbers_report import assignment_rows, describe_assignments
    from geartrain.search.train.train_search import TrainSearchRequest, answer_search
    from geartrain.train.declaration_files import read_declaration

    answer = SearchAnswer.of(csv, json, out, force, pick)
    train = read_declaration(file)
    _check_kept(file, answer.out.path)
    request = TrainSearchRequest(
        train,
        state,
        free=free if free in ("search", "uncertain") else tuple(name.strip() for name in free.split(",")),
        rules=read_constraint_options(
            planets=planets,
            clearance=clearance,
            undercut=undercut,
            interference=interference,
            largest_radius=largest_radius,
            addendum=addendum,
            ring_addendum=ring_addendum,
            minimum=minimum,
            most_teeth=most_teeth,
            shift=shift,
            coaxial=coaxial,
            hunting=hunting,
            different=different,
            closure=closure,
        ),
        tolerance=read_tolerance(tolerance),
        best=best,
        by=by,  # type: ignore[arg-type]
        where=tuple(_assignment(text) for text in where or ()),
    )
    with long_run("teeth", request.to_dict(), out, RunOptions(workers, dask, resume)) as given:
        found = answer_search(request, given)
        close_journal(given.journal, cut=found.ended == "interrupted")
    answer.give(
        found,
        assignment_rows(found),
        describe_assignments,
        lambda at: found.declaration(found.solutions[at], _parent(file, answer.out.path)),
    )


def _assignment(text: str) -> dict[str, int]:
    """`o1=32,o2=50`."""
    try:
        pairs = (part.split("=") for part in text.split(","))
        return {name.strip(): int(count) for name, count in pairs}
    except ValueError:
        raise typer.BadParameter(f"'{text}' is not of the form wheel=32,wheel=50", param_hint="--where") from None


def _check_kept(file: str, out: Path | None) -> None:
    """A solution extends the train: it cannot take its place, and a table must not."""
    if out is not None and out.exists() and Path(file).exists() and out.samefile(file):
        raise typer.BadParameter(f"'{out}' is the train itself; write to another file", param_hint="-o")


def _parent(file: str, out: Path | None) -> str:
    """What a solution extends, as seen from the file it is written to."""
    import os

    from geartrain.train.declaration_files import shipped

    if file in shipped() or out is None:
        return file
    return os.path.relpath(file, out.parent)
