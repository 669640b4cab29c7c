"""Examples of declarations for the reference, the JSON Schema and error messages."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import cache
from importlib.resources import files
from typing import Any

import yaml

from geartrain.errors import Loc
from geartrain.train.yaml_nodes import on_one_line, parse_yaml


@cache
def examples() -> Mapping[str, tuple[str, ...]]:
    """Return the examples as YAML texts, by the part that they declare, or by the key of parts of several kinds."""
    text = files("geartrain.train").joinpath("examples.yaml").read_text(encoding="utf-8")
    return {name: tuple(part.split("\n---\n")) for name, part in yaml.safe_load(text).items()}


def example_data() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the name of the declared part and the plain data of each example."""
    for part, each in examples().items():
        for text in each:
            yield part, _plain(parse_yaml(text, part).plain())


def _plain(data: Any) -> Any:
    """Return the data of a declaration; strings that represent numbers or booleans are replaced by these values."""
    if isinstance(data, dict):
        return {key: _plain(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_plain(value) for value in data]
    # a scalar that is not valid JSON remains a string
    with suppress(ValueError, TypeError):
        return json.loads(data)
    return data


def one_line(key: str, value: Any) -> str:
    """Return a key and its value as one line of YAML."""
    return f"{key}: {on_one_line(value)}"


_OF_NAMES = ("links", "wheels", "axes", "outputs", "states", "dials", "clutches", "sources", "materials")
"""Keys, such as `links`, whose values are mappings from names that the user chooses."""


def example_line(loc: Loc, kind: type) -> str:
    """Return a line of YAML with an example of the mapping or list at the path `loc`; "" without an example."""
    keys = [step for step in loc if isinstance(step, str)]
    if not keys:
        return ""
    values: Iterator[Any] = _named(keys[-1])
    if len(keys) > 1 and keys[-2] in _OF_NAMES and loc[-1] == keys[-1]:
        values = (each for value in _named(keys[-2]) if isinstance(value, dict) for each in value.values())
    found = next((value for value in values if value and isinstance(value, kind)), None)
    return "" if found is None else one_line(keys[-1], found)


def _named(key: str) -> Iterator[Any]:
    """Yield every value that the key `key` has in any mapping of the examples, however deeply nested."""
    # reversed, so that the stack returns values in the order of the examples
    stack: list[Any] = [data for _, data in example_data()][::-1]
    while stack:
        value = stack.pop()
        if isinstance(value, dict):
            if key in value:
                yield value[key]
            stack += reversed(list(value.values()))
        elif isinstance(value, list):
            stack += reversed(value)
