"""`geartrain schema`: the declaration, for editors and for readers."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import Force, Out, as_json, emit, sink


def run(
    form: Annotated[str, typer.Option("--as", help="json for editors, markdown for readers.")] = "json",
    out: Out = None,
    force: Force = False,
) -> None:
    """Print the JSON Schema of the declaration; editors with a YAML plugin complete and check with it."""
    from geartrain.report.reference import declaration_reference, schema

    if form not in ("json", "markdown"):
        raise typer.BadParameter(f"'{form}' is not a form of schema; use json or markdown", param_hint="--as")
    to = sink(out, force)
    emit(as_json(schema()) if form == "json" else declaration_reference(), to)
