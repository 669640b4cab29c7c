"""`geartrain formula`: outputs as closed expressions in the tooth counts."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, chosen_states, give, sink


def run(
    file: File,
    output: Annotated[list[str] | None, typer.Option("--output", help="Of this output; may be repeated.")] = None,
    state: StateName = None,
    inverse: Annotated[bool, typer.Option("--inverse", help="Ratios as input over output too.")] = False,
    sensitivities: Annotated[
        bool, typer.Option("--sensitivities", help="How each count changes each ratio, as formulas.")
    ] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Formulas as LaTeX.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """What each output is, in lowest terms, as a formula in tooth counts and speeds of inputs; where it locks."""
    from geartrain.analysis.gear_train import load
    from geartrain.report.formula_report import collect_formulas, describe_formulas

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    states = chosen_states(train, state)
    report = collect_formulas(train, states, tuple(output or ()), sensitivities)
    give(to, json, lambda: report, lambda: [describe_formulas(report, latex, inverse)])
    # a state that is free, as it says, need not determine its outputs
    bound = [name for name in states if train.solve(name).verdict or not train.solve(name).as_expected]
    asked = sum(len(output or train.declaration.case(name).outputs) for name in bound)
    raise typer.Exit(GOOD if sum(each.state in bound for each in report.formulas) == asked else VERDICT)
