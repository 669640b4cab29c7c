"""`geartrain list` and `geartrain periods`: what is shipped."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import emit


def trains() -> None:
    """List the shipped trains with their titles."""
    from geartrain.files import load, shipped

    width = max((len(name) for name in shipped()), default=0)
    lines = [f"{name:<{width}}  {load(path).declaration.title}" for name, path in shipped().items()]
    emit("\n".join(lines))


def periods(word: Annotated[str, typer.Argument(help="Show only names that contain this.")] = "") -> None:
    """List the shipped table of astronomical periods, speeds and counts."""
    from geartrain.periods import table

    units = {"period": "d", "speed": "turns per year", "count": ""}
    rows = [row for row in table().values() if word in row.name]
    width = max((len(row.name) for row in rows), default=0)
    emit("\n".join(f"{row.name:<{width}}  {float(row.value):.12g} {units[row.kind]}  ({row.source})" for row in rows))
