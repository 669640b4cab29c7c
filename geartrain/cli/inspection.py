"""`geartrain inspect`: equations, formulas and graph of a train, accuracy of its results, JSON Schema of the files."""

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
from geartrain.cli.verbs import LazyGroup, Verbs

_HERE = "geartrain.cli.inspection"


class InspectGroup(LazyGroup):
    """Group of commands that print equations, formulas, graphs and other data of a train."""

    verbs = Verbs(
        {name: f"{_HERE}:{name}" for name in ("equations", "formula", "graph", "bench", "schema")}
        | {"wheels": "geartrain.workshop.cutting.verb"}
    )


app = typer.Typer(
    cls=InspectGroup,
    add_completion=False,
    no_args_is_help=True,
    help="Print equations, formulas, graph, accuracy or measured wheels of a train, or the JSON Schema of files.\n\n"
    "Example: `geartrain inspect formula wolfrom-175`.",
)


@app.callback()
def _group() -> None:
    pass


def equations(
    file: File,
    state: StateName = None,
    latex: Annotated[bool, typer.Option("--latex", help="Print a LaTeX align environment.")] = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the Willis system of a train as text or LaTeX, with one labelled equation per line.

    Example: `geartrain inspect equations planetary-24-18-60 --latex`.
    """
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
        list[str] | None, typer.Option("--of", help="Output to derive a formula for; may be repeated.")
    ] = None,
    state: StateName = None,
    inverse: Annotated[bool, typer.Option("--inverse", help="Also print each ratio as input / output.")] = False,
    sensitivities: Annotated[
        bool,
        typer.Option("--sensitivities", help="Print the sensitivity of each ratio to each tooth count, as formulas."),
    ] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Print formulas as LaTeX.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Derive each output as a formula in tooth counts and input speeds, in lowest terms, with its locking condition.

    Example: `geartrain inspect formula wolfrom-175 --inverse`.
    """
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


_SUFFIXES = {".md": "", ".dot": "dot", ".gv": "dot", ".graphml": "graphml", ".json": "json"}


def graph(
    file: File,
    form: Annotated[
        Literal["labels", "edges", "matrix", "dot", "graphml", "json"] | None,
        typer.Option(
            "--as",
            metavar="FORMAT",
            help="Format: labels, edges, matrix, dot, graphml or json. Default: given by the suffix of -o; without a "
            "known suffix, labels (edges for more than 48 links).",
        ),
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the graph of a train as an adjacency matrix of letters (R(axis), G#) or numbers, as a list of edges, or in
    Graphviz, GraphML or JSON format.

    Example: `geartrain inspect graph pennestri-2002 -o train.dot`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.kinematics import graph as formats
    from geartrain.report.text import to_markdown
    from geartrain.report.train_report import describe_adjacency, describe_edges

    to = sink(out, force, _SUFFIXES)
    chosen: str = form or _SUFFIXES.get(to.suffix, "")
    train = load(file)
    chosen = chosen or ("labels" if len(train.graph) <= formats.MOST_SQUARE else "edges")
    if chosen == "matrix":
        text = as_json(formats.adjacency_matrix(train.graph))
    elif chosen == "edges":
        text = to_markdown([describe_edges(train)])
    elif chosen == "labels":
        text = to_markdown([describe_adjacency(train)])
    else:
        text = {"dot": formats.to_dot, "graphml": formats.to_graphml, "json": formats.to_json}[chosen](train.graph)
    emit(text, to)


def bench(
    file: File,
    state: StateName = None,
    samples: Annotated[
        int,
        typer.Option("--samples", min=2, max=1_000_000, help="Number of input positions."),
    ] = 10_000,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Measure the accuracy and run time of each method on a train: speeds, motion, torques.

    Example: `geartrain inspect bench moon-triangular`.
    """
    from geartrain.analysis.accuracy import find_accuracy
    from geartrain.analysis.gear_train import load
    from geartrain.report.accuracy_report import AccuracyReport, describe_accuracy

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    measured = tuple(find_accuracy(train, name, samples) for name in chosen_states(train, state))
    found = AccuracyReport(train.name, train.declaration.title, measured)
    give(to, json, lambda: found, lambda: [describe_accuracy(found)])
    raise typer.Exit(VERDICT if any("speeds" in each.neglected for each in measured) else GOOD)


def schema(
    question: Annotated[
        list[str] | None,
        typer.Argument(help="Command whose JSON keys are printed, such as motion or teeth ratio.", metavar="COMMAND"),
    ] = None,
    form: Annotated[
        Literal["json", "markdown", "answers"],
        typer.Option(
            "--as",
            help="Document to print: JSON Schema of declarations (json), their reference (markdown), or JSON Schema of "
            "results (answers).",
        ),
    ] = "json",
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the JSON Schema of declarations, which editors with a YAML plugin use to complete and validate them.

    With --as answers, print the JSON Schema of the --json output of all commands. With COMMAND, print the keys of its
    JSON output as a table.

    Example: `geartrain inspect schema -o geartrain.schema.json`.
    """
    from geartrain.report.declaration_schema import declaration_reference
    from geartrain.report.declaration_schema import schema as declaration_schema
    from geartrain.report.json_schema import answer_schema, describe_answer
    from geartrain.report.text import to_markdown, to_text

    to = sink(out, force)
    if question:
        keys = [describe_answer(" ".join(question))]
        emit(to_markdown(keys) if form == "markdown" else to_text(keys, 120), to)  # columns, because keys are long
    elif form == "markdown":
        emit(declaration_reference(), to)
    else:
        emit(as_json(declaration_schema() if form == "json" else answer_schema()), to)
