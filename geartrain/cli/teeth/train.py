"""`geartrain teeth TRAIN`: the free wheels of a train."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from geartrain.cli.long_runs import close_journal
from geartrain.cli.teeth.search_options import SearchExecution, SearchOptions

if TYPE_CHECKING:
    from geartrain.synthesis.train.train_findings import Standing, TrainFindings
    from geartrain.train import Train


def run(
    asked: SearchOptions,
    means: SearchExecution,
    file: str,
    state: str | None,
    free: str,
    rules: dict[str, Any],
    where: list[str],
) -> None:
    """Answer for the free wheels of a train."""
    from geartrain.report.tooth_numbers import assignment_rows, assignments_document
    from geartrain.synthesis.constraints.constraint_options import read_constraint_options
    from geartrain.train.declaration_files import read_declaration

    train = read_declaration(file)
    _check_kept(file, asked.out.path)
    options = {name: value for name, value in rules.items() if value is not None}
    chosen = free if free in ("search", "uncertain") else tuple(name.strip() for name in free.split(","))
    stands = [_assignment(text) for text in where]
    found, standings, cut = _search(
        asked, means, train, state, chosen, read_constraint_options(**options), options, stands
    )
    data = {
        **found.to_dict(),
        "where": [standing.to_dict() for standing in standings],
        "ended": "interrupted" if cut else "whole",
    }
    solutions = found.solutions
    asked.answer(
        data,
        assignment_rows(found),
        lambda: assignments_document(found, standings),
        lambda at: found.declaration(solutions[at], _parent(file, asked.out.path)),
    )


def _search(
    asked: SearchOptions,
    means: SearchExecution,
    train: Train,
    state: str | None,
    free: Any,
    rules: Any,
    options: dict[str, Any],
    stands: list[dict[str, int]],
) -> tuple[TrainFindings, list[Standing], bool]:
    from geartrain.synthesis.train.train_search import search

    question = {
        "train": train.model_dump(mode="json"),
        "state": state,
        "free": free,
        "rules": options,
        "tolerance": str(asked.tolerance),
        "best": asked.best,
        "by": asked.by,
    }
    with means.work(question) as (executor, journal, tell):
        found = search(
            train,
            state,
            free=free,
            rules=rules,
            tolerance=asked.tolerance,
            best=asked.best,
            by=asked.by,  # type: ignore[arg-type]
            executor=executor,
            journal=journal,
            tell=tell,
        )
        cut = any(part.reason.startswith("interrupted") for part in found.parts)
        standings = [standing for teeth in stands for standing in found.standing(teeth)]
        close_journal(journal, cut)
    return found, standings, cut


def _assignment(text: str) -> dict[str, int]:
    """`o1=32,o2=50`."""
    try:
        pairs = (part.split("=") for part in text.split(","))
        return {name.strip(): int(count) for name, count in pairs}
    except ValueError:
        raise typer.BadParameter(f"'{text}' is not of the form wheel=32,wheel=50", param_hint="--where") from None


def _check_kept(file: str, out: Path | None) -> None:
    """A solution extends the train: it cannot take its place, and a table shall not."""
    if out is not None and out.exists() and Path(file).exists() and out.samefile(file):
        raise typer.BadParameter(f"'{out}' is the train itself; write to another file", param_hint="-o")


def _parent(file: str, out: Path | None) -> str:
    """What a solution extends, as seen from the file it is written to."""
    import os

    from geartrain.train.declaration_files import shipped

    if file in shipped() or out is None:
        return file
    return os.path.relpath(file, out.parent)
