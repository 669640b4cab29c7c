"""JSON files read by `json`: the data as YAML would give them, with places only where somebody reads one."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from geartrain.errors import DeclarationError, Loc
from geartrain.train.yaml_nodes import MOST_DEPTH, MOST_VALUES, YamlNode, parse_yaml

# other characters are escaped, or refused, in different ways by JSON and YAML
_PLAIN = re.compile(r"[\n\r -\[\]-~]*")


@dataclass(frozen=True)
class JsonMarks:
    """The places in a JSON file, found by the YAML parser when the first one is read."""

    text: str
    name: str

    def __call__(self, loc: Loc) -> str:
        return self._node.place_of(loc)

    @cached_property
    def _node(self) -> YamlNode:
        try:
            return parse_yaml(self.text, self.name)
        except DeclarationError:  # it is JSON, but for example a key is longer than YAML allows
            return YamlNode({}, self.name)


def parse_json(text: str) -> dict[str, Any] | None:
    """The mapping that `text` is as JSON, scalars as the text they were; None where YAML might read it otherwise.

    Keys given twice, nan, infinity, deep nesting and too many values are left to the YAML parser, which places them.
    """
    values = sum(map(text.count, ",:{}[]{["))  # at least as many as the parser's events
    if values >= MOST_VALUES or not _PLAIN.fullmatch(text):
        return None
    try:
        data = json.loads(
            text, object_pairs_hook=_mapping, parse_int=str, parse_float=str, parse_constant=_refuse_constant
        )
    except (ValueError, RecursionError):
        return None
    return data if isinstance(data, dict) and _is_shallow(data) else None


def _mapping(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The entries of an object; `ValueError` for a key that is given twice."""
    found = {key: _BOOLEANS[value] if value is True or value is False else value for key, value in pairs}
    if len(found) < len(pairs):
        raise ValueError
    return found


_BOOLEANS = {True: "true", False: "false"}


def _refuse_constant(name: str) -> Any:
    raise ValueError(name)


def _is_shallow(data: Any) -> bool:
    """True if the data are nested no deeper than a declaration may be, and no list holds true or false."""
    level = [data]
    for _ in range(MOST_DEPTH):
        level = [part for each in level for part in (each.values() if type(each) is dict else each)
                 if type(part) in (dict, list, bool)]  # fmt: skip
        if any(type(part) is bool for part in level):
            return False
        if not level:
            return True
    return False
