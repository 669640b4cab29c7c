"""`geartrain solve`: speeds of all links, or of one output."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, as_json, emit, sink


def solve(
    file: File,
    output: Annotated[
        str | None, typer.Option("--of", help="Output or link; only the part of the train that drives it is solved.")
    ] = None,
    state: StateName = None,
    json: Json = False,
    out: Out = None,
    method: Annotated[
        Literal["auto", "exact", "sparse", "floats"],
        typer.Option(
            "--method", metavar="METHOD", help="Solution method: auto, exact, sparse, or floats (an alias of sparse)."
        ),
    ] = "auto",
    force: Force = False,
) -> None:
    """Solve a train and print its speeds as fractions and decimals.

    Example: `geartrain solve freeth-2021 --of mars`.
    """
    from geartrain.analysis.gear_train import load

    to = sink(out, force)
    train = load(file)
    states = [state] if state is not None or not train.states else list(train.states)
    answers = [train.solve(name, output, method) for name in states]
    if json or to.suffix == ".json":
        from geartrain.report.train_data import collect_answers

        emit(as_json(collect_answers(train, answers, whole=output is None)), to)
    else:
        from geartrain.report.answers import speeds_text

        emit("\n".join(speeds_text(answer, output, train.kinematics.joint_sums) for answer in answers), to)
    raise typer.Exit(GOOD if all(answers) else VERDICT)
