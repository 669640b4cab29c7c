"""`geartrain solve`: speeds, of everything or of one output."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, as_json, emit, sink

OutputName = Annotated[str | None, typer.Option("--output", help="An output or a link: only what drives it is solved.")]


def run(
    file: File,
    output: OutputName = None,
    state: StateName = None,
    json: Json = False,
    out: Out = None,
    method: Annotated[str, typer.Option("--method", help="auto, exact or sparse (also called floats).")] = "auto",
    force: Force = False,
) -> None:
    """Solve a train and print its speeds as fractions and decimals."""
    from geartrain.analysis.gear_train import load

    if method not in ("auto", "exact", "sparse", "floats"):
        raise typer.BadParameter(f"'{method}' is not a method; use auto, exact or sparse", param_hint="--method")
    to = sink(out, force)
    train = load(file)
    states = [state] if state is not None or not train.states else list(train.states)
    answers = [train.solve(name, output, method) for name in states]  # type: ignore[arg-type]
    if json or to.suffix == ".json":
        from geartrain.report.train_data import collect_answers

        emit(as_json(collect_answers(train, answers, whole=output is None)), to)
    else:
        from geartrain.report.answers import speeds_text
        from geartrain.train.trade_words import told_words

        words = told_words("\n".join(str(answer.verdict) for answer in answers if not answer))
        tables = (speeds_text(answer, output, train.kinematics.joint_sums) for answer in answers)
        emit("\n".join((*tables, *filter(None, [words]))), to)
    raise typer.Exit(GOOD if all(answers) else VERDICT)
