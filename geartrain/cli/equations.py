"""`geartrain equations`: the labelled Willis system."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import File, Force, Out, StateName, chosen_states, emit, sink


def run(
    file: File,
    state: StateName = None,
    latex: Annotated[bool, typer.Option("--latex", help="As a LaTeX align environment.")] = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the Willis system of a train, one labelled equation a line, as text or LaTeX."""
    from geartrain.analysis.gear_train import load

    to = sink(out, force)
    train = load(file)
    blocks = []
    for name in chosen_states(train, state):
        system = train.equations(name)
        head = [] if name is None else [f"{'%' if latex else '#'} state {name}"]
        blocks.append("\n".join([*head, system.latex() if latex else system.text()]))
    emit("\n\n".join(blocks), to)
