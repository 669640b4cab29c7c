"""`geartrain bench`: error against run time."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import Json, Out, as_json, emit

app = typer.Typer(help="Measure error against run time, as ratios within one run.", no_args_is_help=True)


@app.callback()
def _group() -> None:
    pass


@app.command()
def kinematics(
    most: Annotated[int, typer.Option("--most", help="Largest number of links.")] = 100_000,
    json: Json = False,
    out: Out = None,
) -> None:
    """Time and true error of every way to speeds, over train size: exact, sparse LU by ordering, with refinement, walking."""
    from geartrain import bench

    with bench.progress() as advance:
        results = bench.kinematics(most, advance)
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)
