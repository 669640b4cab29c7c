"""`geartrain draw`: plan, stick diagram, graph, speed diagram or dials of a train as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from geartrain.cli.common import (
    PICTURES,
    VERDICT,
    File,
    Force,
    file_name,
    is_sound,
    is_standard,
    picture_sink,
    suffix_of,
    tell,
)
from geartrain.cli.common import draw as write_figure
from geartrain.cli.option_values import Theme
from geartrain.cli.option_values import turns as read_turns


def run(
    file: File,
    kind: Annotated[
        Literal["plan", "stick", "graph", "lever", "dials"],
        typer.Option("--kind", metavar="KIND", help="Kind of drawing: plan, stick, graph, lever or dials."),
    ] = "plan",
    out: Annotated[
        Path | None,
        typer.Option(
            "--output-file",
            "-o",
            metavar="FILE",
            help="Write the drawing to FILE, as .svg, .png or .pdf (- is standard output); default: NAME-KIND.svg.",
        ),
    ] = None,
    state: Annotated[
        str | None, typer.Option("--state", help="State to draw; default: the first (lever diagrams: all states).")
    ] = None,
    turns: Annotated[
        str,
        typer.Option(
            "--turns",
            help="Position to draw, in revolutions of the driving link from the start, such as 3, -1/4 or 2.5.",
        ),
    ] = "0",
    theme: Theme = "light",
    force: Force = False,
    labels: Annotated[
        bool, typer.Option("--labels/--no-labels", help="Print names and numbers in the drawing.")
    ] = True,
    output: Annotated[
        list[str] | None, typer.Option("--of", help="With dials: draw only this output; may be repeated.")
    ] = None,
) -> None:
    """Draw a train as a plan to scale, stick diagram, graph, speed diagram (lever) or dials.

    Example: `geartrain draw freeth-2021 --kind dials --turns 3 -o dials.svg`.
    """
    from geartrain.analysis.gear_train import load

    # options are checked before the train is read
    suffix_of(out, PICTURES)
    turned = read_turns("--turns", turns)
    train = load(file)
    if out is None:
        out = file_name(f"{train.name}-{kind}", ".svg")
    elif not out.suffix and not is_standard(out) and out.name not in ("", ".."):  # `.`, `/` and `..` are folders
        out = out.with_name(f"{out.name}.svg")
    to = picture_sink(out, force, theme, "-o")
    from geartrain.drawing import picture

    figure = picture(train, kind, state, turned, labels, tuple(output or ()))
    write_figure(figure, to)
    if is_sound(train, state):
        return
    verdict = train.solve(train.declaration.state_or_first(state)).verdict
    if not verdict:
        tell(f"the train is {verdict}")
    raise typer.Exit(VERDICT)
