"""`geartrain teeth moon=29.53 venus=224.7 ...`: several periods from one arbor."""

from __future__ import annotations

import sys
from fractions import Fraction

import typer

from geartrain.cli.teeth.search_options import SearchOptions

_TOLERANCE = Fraction(1, 10**6)


def run(asked: SearchOptions, texts: list[str], effort: int, walk: int | None) -> None:
    """Answer for an orrery."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain.report.tooth_numbers import orrery_document, orrery_rows
    from geartrain.synthesis.orrery.orrery_search import find_orrery

    periods = _periods(texts)
    with Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as progress:
        task = progress.add_task("trees", total=None)
        found = find_orrery(
            periods,
            asked.counts,
            _TOLERANCE if asked.tolerance is None else asked.tolerance,
            effort=effort,
            walk=walk,
            tell=lambda done, total: progress.update(task, completed=done, total=total),
        )
    ended = {"interrupt": "interrupted"}.get(found.ended, found.ended)
    data = {**found.to_dict(), "ended": ended}
    asked.answer(data, orrery_rows(found), lambda: orrery_document(found), lambda _: found.to_train())


def _periods(texts: list[str]) -> dict[str, Fraction]:
    """Name -> period in turns of the first arbor."""
    from geartrain.synthesis.target_ratio import read_ratio

    found: dict[str, Fraction] = {}
    for text in texts:
        name, sign, period = text.partition("=")
        if not sign or not name.strip():
            raise typer.BadParameter(f"'{text}' is not of the form moon=29.53058853", param_hint="WANTED")
        if name.strip() in found:
            raise typer.BadParameter(f"two periods are named '{name.strip()}'", param_hint="WANTED")
        wanted = read_ratio(period)
        if wanted.sense:
            what = f"'{text}' asks for a sense, which is left open here; the answer tells that of every arbor"
            raise typer.BadParameter(what, param_hint="WANTED")
        found[name.strip()] = wanted.value
    return found
