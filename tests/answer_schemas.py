"""Schemas of JSON results for the tests, without keys that the shipped schema does not name."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from commands import call
from jsonschema import Draft202012Validator


@cache
def answer_schema() -> Any:
    """Return the schema that the package prints."""
    return json.loads(call("inspect", "schema", "--as", "answers").stdout)


def closed(schema: Any) -> Any:
    """Return the schema with additional keys forbidden."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, Mapping):
        return schema
    found = {key: closed(value) for key, value in schema.items() if key not in ("required", "enum", "properties")}
    found |= {key: schema[key] for key in ("required", "enum") if key in schema}
    if "properties" in schema:
        found["properties"] = {key: closed(value) for key, value in schema["properties"].items()}
        found.setdefault("additionalProperties", False)
    return found


@cache
def validators(question: str) -> list[Draft202012Validator]:
    shipped = answer_schema()["$defs"][question]
    return [Draft202012Validator(each) for each in (shipped, *([] if question in OPEN else [closed(shipped)]))]


def holds(question: str, data: Any) -> None:
    for validator in validators(question):
        faults = sorted(validator.iter_errors(data), key=lambda fault: list(map(str, fault.path)))
        assert not faults, [(list(fault.path), fault.message[:300]) for fault in faults[:5]]


# of these some parts are told by hand, with keys that are not all named
OPEN = {"mesh", "mesh --compare", "mesh --form triangular --vary", "inspect graph --as json"}
