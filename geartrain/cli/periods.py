"""`geartrain periods`: the shipped table of astronomical periods."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import emit


def run(
    word: Annotated[str, typer.Argument(help="Show only names that contain this.", metavar="[WORD]")] = "",
) -> None:
    """List the shipped table of astronomical periods, speeds and counts."""
    from geartrain.errors import Problem, QuestionError
    from geartrain.train.periods import period_table, suggested_period

    units = {"period": "d", "speed": "turns per year", "count": ""}
    rows = [row for row in period_table().values() if word in row.name]
    if not rows:
        raise QuestionError(
            Problem(f"no name contains '{word}'", "the shipped table has no such row", suggested_period(word))
        )
    width = max(len(row.name) for row in rows)
    emit("\n".join(f"{row.name:<{width}}  {float(row.value):.12g} {units[row.kind]}  ({row.source})" for row in rows))
