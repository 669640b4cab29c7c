"""`geartrain graph`: the adjacency matrix, the edges, or the graph in formats of other tools."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from geartrain.cli.common import File, Force, Out, as_json, emit, sink

_SUFFIXES = {".md": "", ".dot": "dot", ".gv": "dot", ".graphml": "graphml", ".json": "json"}


def run(
    file: File,
    form: Annotated[
        Literal["labels", "edges", "matrix", "dot", "graphml", "json"] | None,
        typer.Option("--as", help="Format; default by the suffix of -o, else labels (edges above 48 links)."),
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the graph: adjacency in letters (R(axis), G#) or numbers, edges, Graphviz, GraphML, or JSON."""
    from geartrain.analysis.gear_train import load
    from geartrain.kinematics import graph
    from geartrain.report.text import to_markdown
    from geartrain.report.train_report import describe_adjacency, describe_edges

    to = sink(out, force, _SUFFIXES)
    chosen: str = form or _SUFFIXES.get(to.suffix, "")
    train = load(file)
    chosen = chosen or ("labels" if len(train.graph) <= graph.MOST_SQUARE else "edges")
    if chosen == "matrix":
        text = as_json(graph.adjacency_matrix(train.graph))
    elif chosen == "edges":
        text = to_markdown([describe_edges(train)])
    elif chosen == "labels":
        text = to_markdown([describe_adjacency(train)])
    else:
        text = {"dot": graph.to_dot, "graphml": graph.to_graphml, "json": graph.to_json}[chosen](train.graph)
    emit(text, to)
