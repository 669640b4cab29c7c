"""`geartrain solve`, `equations` and `formula`: speeds, the Willis system, outputs as formulas in tooth counts."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    File,
    Force,
    Json,
    Out,
    StateName,
    as_json,
    chosen_states,
    emit,
    give,
    sink,
)

OutputName = Annotated[
    str | None, typer.Option("--output", help="Output or link; only the part of the train that drives it is solved.")
]


def solve(
    file: File,
    output: OutputName = None,
    state: StateName = None,
    json: Json = False,
    out: Out = None,
    method: Annotated[
        Literal["auto", "exact", "sparse", "floats"],
        typer.Option("--method", help="Solution method; floats is another name of sparse."),
    ] = "auto",
    force: Force = False,
) -> None:
    """Solve a train and print its speeds as fractions and decimals."""
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


def equations(
    file: File,
    state: StateName = None,
    latex: Annotated[bool, typer.Option("--latex", help="Print a LaTeX align environment.")] = False,
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


def formula(
    file: File,
    output: Annotated[
        list[str] | None, typer.Option("--output", help="Output to derive a formula for; may be repeated.")
    ] = None,
    state: StateName = None,
    inverse: Annotated[bool, typer.Option("--inverse", help="Also print ratios as input over output.")] = False,
    sensitivities: Annotated[
        bool,
        typer.Option("--sensitivities", help="Print the sensitivity of each ratio to each tooth count, as formulas."),
    ] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Print formulas as LaTeX.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Derive each output in lowest terms as a formula in tooth counts and input speeds, and where it locks."""
    from geartrain.analysis.gear_train import load
    from geartrain.report.formula_report import collect_formulas, describe_formulas

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    states = chosen_states(train, state)
    report = collect_formulas(train, states, tuple(output or ()), sensitivities)
    give(to, json, lambda: report, lambda: [describe_formulas(report, latex, inverse)])
    # a state declared as free need not determine its outputs
    bound = [name for name in states if train.solve(name).verdict or not train.solve(name).as_expected]
    requested = sum(len(output or train.declaration.case(name).outputs) for name in bound)
    raise typer.Exit(GOOD if sum(each.state in bound for each in report.formulas) == requested else VERDICT)
