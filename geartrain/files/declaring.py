"""Plain data of a declaration as the text of a YAML file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import yaml


def as_yaml(data: Mapping[str, Any]) -> str:
    """YAML text that `load` reads back as the same declaration: parts of a train one a line, keys in their order."""
    return "".join(_section(key, value) for key, value in data.items())


def _section(key: str, value: Any) -> str:
    """One top-level key; what stands below it in one line an entry."""
    if isinstance(value, Mapping) and value:
        lines = [f"  {_line(name)}: {_line(part)}\n" for name, part in value.items()]
    elif isinstance(value, list | tuple) and value:
        lines = [f"  - {_line(part)}\n" for part in value]
    else:
        return f"{_line(key)}: {_line(value)}\n"
    return f"{_line(key)}:\n{''.join(lines)}"


def _line(value: Any) -> str:
    """A value on one line. Numbers as Python writes them: a declaration remembers the text of its figures."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_line(key)}: {_line(part)}" for key, part in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_line, value)) + "]"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return repr(value)
    # within a list, so that commas and brackets of a text are quoted
    text: str = yaml.safe_dump([value], default_flow_style=True, width=float("inf"), allow_unicode=True)
    return text.removesuffix("\n").removeprefix("[").removesuffix("]")
