"""`geartrain motion`: what real teeth and pins do to the outputs while the input turns."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import PICTURES, File, Json, Out, StateName, as_json, draw, emit, show, suffix_of

if TYPE_CHECKING:
    from geartrain.motion import Ripple


def run(
    file: File,
    turns: Annotated[float, typer.Option("--turns", help="Turns of the input.")] = 20.0,
    samples: Annotated[int, typer.Option("--samples", min=2, help="Positions of the input.")] = 200_000,
    output: Annotated[list[str] | None, typer.Option("--output", help="Output or link; may be repeated.")] = None,
    state: StateName = None,
    json: Json = False,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw errors and speeds to this file.")] = None,
    out: Out = None,
) -> None:
    """Transmission error and speed of outputs with real teeth and pins; to a .csv, every position."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain.files import load
    from geartrain.quantity import RADIANS_PER_TURN

    suffix = suffix_of(out, (".md", ".html", ".json", ".csv"))
    picture = suffix_of(plot, PICTURES) or ".svg"
    motion = load(file).motion(state, tuple(output or ()))
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("motion", total=samples)
        angle, found = motion.ripples(turns, samples, lambda done: progress.update(task, advance=done))
    in_turns = angle / RADIANS_PER_TURN
    if suffix == ".csv":
        emit(_csv(in_turns, found), out)
    elif json or suffix == ".json":
        emit(as_json({"turns": turns, "outputs": {name: ripple.to_dict() for name, ripple in found.items()}}), out)
    else:
        from geartrain import report

        show([report.motion_document(motion.train.lead, turns, found)], out, suffix)
    if plot is not None:
        from geartrain.plot import motion_figure

        speeds = {name: ripple.speed / (ripple.mean or 1.0) for name, ripple in found.items()}
        draw(motion_figure(in_turns, {name: ripple.error for name, ripple in found.items()}, speeds), plot, picture)


def _csv(turns: Any, found: dict[str, Ripple]) -> str:
    names = [column for name in found for column in (f"{name} error (rad)", f"{name} speed")]
    columns = [turns, *(values for ripple in found.values() for values in (ripple.error, ripple.speed))]
    rows = [",".join(map(repr, row)) for row in zip(*(column.tolist() for column in columns), strict=True)]
    return "\n".join([",".join(["turns", *names]), *rows])
