"""Command `geartrain teeth train FILE`: search for tooth counts of the varied wheels of a train."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import File, Force, Json, Names, Out, StateName, option_error
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run
from geartrain.search.teeth_verb import (
    Best,
    Clearance,
    Different,
    Hunting,
    Pick,
    SearchAnswer,
    Shift,
    Tolerance,
    read_tolerance,
)


def run(
    file: File,
    free: Annotated[
        str,
        typer.Option(
            "--free",
            help="Wheels to vary: search (wheels declared with `search`), uncertain (also wheels with a `range` of "
            "tooth counts), or names separated by commas.",
        ),
    ] = "search",
    state: StateName = None,
    tolerance: Tolerance = None,
    best: Best = 20,
    by: Annotated[
        str,
        typer.Option(
            "--sort",
            help="Sort the solutions by error, total (sum of tooth counts), largest (largest tooth count), distinct "
            "(number of different tooth counts) or change (number of changed wheels).",
        ),
    ] = "error",
    planets: Annotated[
        str | None,
        typer.Option(
            "--planets",
            help="Number of equal, equally spaced planets, such as 3, or by carrier, such as arm=3,inner=4.",
        ),
    ] = None,
    clearance: Clearance = None,
    largest_radius: Annotated[
        str | None,
        typer.Option("--max-radius", help="Maximum pitch radius of a varied wheel: a length, or a number of modules."),
    ] = None,
    shift: Shift = 0,
    hunting: Hunting = False,
    different: Different = False,
    where: Annotated[
        Names,
        typer.Option(
            "--where",
            metavar="WHEEL=N,...",
            help="Report the rank of these tooth counts, such as W=32,X=50; may be repeated.",
        ),
    ] = None,
    pick: Pick = 1,
    workers: Workers = None,
    resume: Resume = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Find tooth counts of the varied wheels of a train that satisfy all targets of the train and the given
    constraints.

    Example: `geartrain teeth train pennestri-2002-missing --best 5`.
    """
    from geartrain.search.constraints.constraint_options import read_constraint_options
    from geartrain.search.train.train_search import search_train
    from geartrain.train.declaration_files import read_declaration

    answer = SearchAnswer.of(json, out, force, pick)
    train = read_declaration(file)
    out_path = answer.out.path
    # the solution extends the declaration in the input file
    if out_path is not None and out_path.exists() and Path(file).exists() and out_path.samefile(file):
        raise option_error(
            "-o", f"'{out_path}' is the input file", "write to another file", "the solution extends this file"
        )
    varied = free if free in ("search", "uncertain") else tuple(name.strip() for name in free.split(","))
    rules = read_constraint_options(
        planets=planets,
        clearance=clearance,
        largest_radius=largest_radius,
        shift=shift,
        hunting=hunting,
        different=different,
    )
    most_error = read_tolerance(tolerance)
    assignments = [_assignment(text) for text in where or ()]
    question = {
        "train": train.model_dump(mode="json"),
        "state": state,
        "free": varied,
        "rules": rules.to_dict(),
        "tolerance": str(most_error),
        "best": best,
        "by": by,
    }
    with long_run("teeth", question, out, RunOptions(workers, resume)) as given:
        found = search_train(
            train,
            state,
            free=varied,
            rules=rules,
            tolerance=most_error,
            best=best,
            by=by,  # type: ignore[arg-type]
            executor=given.executor,
            journal=given.journal,
            tell=given.tell,
        )
        found = replace(found, where=tuple(place for teeth in assignments for place in found.standing(teeth)))
        close_journal(given.journal, cut=found.ended == "interrupted")
    answer.give(found, lambda at: found.declaration(found.solutions[at], _parent(file, answer.out.path)))


def _assignment(text: str) -> dict[str, int]:
    """Parse an assignment of tooth counts such as `o1=32,o2=50`."""
    try:
        pairs = (part.split("=") for part in text.split(","))
        return {name.strip(): int(count) for name, count in pairs}
    except ValueError:
        raise option_error(
            "--where", f"'{text}' is not an assignment", "give wheels with their counts, such as W=32,X=50"
        ) from None


def _parent(file: str, out: Path | None) -> str:
    """Return a reference to the train that a solution extends: the name of a bundled example, or a path relative to the
    folder of the output file.
    """
    import os

    from geartrain.train.declaration_files import shipped

    if file in shipped() or out is None:
        return file
    return os.path.relpath(file, out.parent)
