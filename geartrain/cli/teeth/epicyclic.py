"""`geartrain teeth RATIO --kind ...`: epicyclic sets."""

from __future__ import annotations

from typing import Any

import typer

from geartrain.cli.common import STANDARD, Sink, as_json, emit, show
from geartrain.cli.option_values import decimal
from geartrain.cli.teeth.search_options import SearchOptions


def run(
    asked: SearchOptions,
    texts: list[str],
    kind: str,
    mode: str,
    ratio_is: Any,
    planets: str | None,
    clearance: str | None,
    per: str | None,
    shift: int,
) -> None:
    """Answer for one kind of set."""
    from geartrain.report.tooth_numbers import set_row, sets_document

    if kind == "list":
        listing(asked.json, asked.out)
        return
    from geartrain.synthesis.epicyclic.epicyclic_sets import declaration_of
    from geartrain.synthesis.epicyclic.set_search import find_sets
    from geartrain.synthesis.target_ratio import read_ratio

    if len(texts) > 1:
        raise typer.BadParameter("a set is made for one ratio", param_hint="WANTED")
    if clearance is not None and planets is None:
        raise typer.BadParameter("room is asked of equal planets; give --planets too", param_hint="--clearance")
    wanted = read_ratio(texts[0], per)
    found = find_sets(
        wanted,
        kind,
        "all" if mode == "all" else tuple(mode.split(",")),
        asked.counts,
        _number(planets, "3", "--planets"),
        asked.tolerance,
        asked.best,
        ratio_is=ratio_is,
        by=asked.by,  # type: ignore[arg-type]
        spaced=planets is not None,
        clearance=float(_decimal(clearance)),
        slack=shift,
    )
    rows = [set_row(solution) for solution in found.solutions]
    asked.answer(
        found.to_dict(),
        rows,
        lambda: sets_document(found),
        lambda at: declaration_of(found.solutions[at]),
    )


def listing(json: bool, to: Sink = STANDARD) -> None:
    """The kinds there are."""
    from geartrain.report.tooth_numbers import kinds_document
    from geartrain.synthesis.epicyclic.set_kinds import kinds

    if json:
        emit(as_json({name: kind.to_dict() for name, kind in kinds().items()}), to)
    else:
        show([kinds_document(kinds())], to)


def _number(text: str | None, default: str, option: str) -> int:
    try:
        return int(text or default)
    except ValueError:
        raise typer.BadParameter(f"'{text}' is no number of planets", param_hint=option) from None


def _decimal(text: str | None) -> float:
    return decimal("--clearance", text or "0", "number of modules", "0.5")
