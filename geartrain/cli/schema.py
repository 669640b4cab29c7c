"""`geartrain schema`: the declaration, for editors and for readers."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import Force, Out, as_json, emit, sink


def run(
    form: Annotated[
        str, typer.Option("--as", help="json for editors, markdown for readers, answers: of --json.")
    ] = "json",
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the JSON Schema of the declaration; editors with a YAML plugin complete and check with it.

    With --as answers, the JSON Schema of what commands print with --json, by command.
    """
    from geartrain.report.json_schema import answer_schema, declaration_reference, schema

    if form not in ("json", "markdown", "answers"):
        what = f"'{form}' is not a form of schema; use json or markdown, or answers"
        raise typer.BadParameter(what, param_hint="--as")
    to = sink(out, force)
    emit(
        declaration_reference() if form == "markdown" else as_json(schema() if form == "json" else answer_schema()), to
    )
