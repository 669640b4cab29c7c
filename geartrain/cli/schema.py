"""`geartrain schema`: the JSON Schema of the declaration, for editors."""

from __future__ import annotations

from geartrain.cli.common import Out, as_json, emit


def run(out: Out = None) -> None:
    """Print the JSON Schema of the declaration; editors with a YAML plugin complete and check with it."""
    from geartrain.train import Train

    schema = Train.model_json_schema(by_alias=True)
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "geartrain declaration"}
    emit(as_json(head | {key: value for key, value in schema.items() if key != "title"}), out)
