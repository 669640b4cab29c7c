"""YAML 1.2 (core schema) parsed to nodes with line numbers.

Every scalar is kept as a string, so that `1:30`, `010`, `no` and `1.0000` reach the models unchanged; only a plain null
becomes None. Nesting depth, number of values and expansion of aliases are limited.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml
from pydantic import BaseModel

from geartrain.errors import MOST_REPORTED, DeclarationError, Loc, Marks, Problem, dotted
from geartrain.numerics.containers import collector_paused

MOST_DEPTH = 32
MOST_VALUES = 3_000_000  # about 200,000 links; the parser needs 0.25 kB for each value
MOST_EXPANDED = 1_000_000
_NULLS = {"", "~", "null", "Null", "NULL"}
_STANDARD = ("str", "int", "float", "bool", "null", "timestamp", "merge", "value", "seq", "map")
_TAGS = {None, "!", *(f"tag:yaml.org,2002:{kind}" for kind in _STANDARD)}

_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass(slots=True)
class YamlNode:
    """Mapping, list, scalar or null of a YAML document, with the place where it was written."""

    value: Any
    """Value of the node. Scalars from a file are strings; scalars from plain data are the given objects."""
    place: str
    keys: dict[str, str] = field(default_factory=dict)
    """Place of each key of a mapping."""
    size: int = 1
    """Number of nodes after expansion of all aliases."""

    @property
    def mapping(self) -> dict[str, YamlNode]:
        """Entries of a mapping; empty for other nodes."""
        return self.value if isinstance(self.value, dict) else {}

    @property
    def items(self) -> list[YamlNode]:
        """Elements of a list; empty for other nodes."""
        return self.value if isinstance(self.value, list) else []

    @property
    def text(self) -> str:
        """Scalar as text; empty for other nodes."""
        return "" if self.value is None or isinstance(self.value, dict | list) else str(self.value)

    def plain(self) -> Any:
        """Return the node as plain Python data, without the places."""
        if isinstance(self.value, dict):
            return {key: node.plain() for key, node in self.value.items()}
        if isinstance(self.value, list):
            return [node.plain() for node in self.value]
        return self.value

    def place_of(self, loc: Loc) -> str:
        """Return the place of the value at path `loc`. Keys and indices in the path that the file lacks are skipped."""
        node, place = self, self.place
        for step in loc:
            if isinstance(node.value, dict) and str(step) in node.value:
                place = node.keys.get(str(step), place)
                node = node.value[str(step)]
            elif isinstance(node.value, list) and isinstance(step, int) and step < len(node.value):
                node = node.value[step]
                place = node.place
        return place


@collector_paused()
def parse_yaml(text: str, name: str) -> YamlNode:
    """Parse one YAML document; the places of its nodes contain the file name `name`. Invalid YAML raises an error."""
    reader = _Reader(name, yaml.parse(text, Loader=_Loader))
    try:
        node = reader.document()
    except yaml.MarkedYAMLError as error:
        raise DeclarationError(_syntax(error, name, text)) from None
    except yaml.YAMLError as error:
        why = str(error).splitlines()[0]
        raise DeclarationError(Problem("this is not YAML", why, "save it as UTF-8 text", name)) from None
    if reader.problems:
        raise DeclarationError(reader.problems)
    if node.value is None:
        why = "a declaration has at least the key `links`"
        raise DeclarationError(Problem("the declaration is empty", why, "begin with `links:`", name))
    if not isinstance(node.value, dict):
        why = "a train is declared by keys such as links and gears"
        raise DeclarationError(Problem("the declaration is not a mapping", why, "begin with `links:`", node.place))
    return node


def _too_deep(place: str) -> Problem:
    why = f"at most {MOST_DEPTH} levels are allowed"
    return Problem("the values are nested too deeply", why, "check the brackets", place)


def _syntax(error: yaml.MarkedYAMLError, name: str, text: str) -> Problem:
    mark = error.problem_mark or error.context_mark
    place = f"{name}:{mark.line + 1}" if mark else name
    why = " ".join(part for part in (error.context, error.problem) if part)
    if "nesting depth" in why:  # libyaml 0.2.6 and newer refuse deep nesting themselves
        return _too_deep(place)
    lines = text.splitlines()
    if mark and mark.line < len(lines) and "\t" in lines[mark.line]:
        return Problem(
            "the line contains a tab", "YAML is indented with spaces only", "replace the tab with spaces", place
        )
    if "did not find expected key" in why:
        why = "a key and a colon are expected here, with the same indentation as the keys above"
        fix = "write `key: value`, and indent all keys of a mapping equally"
    elif "','" in why:
        why, fix = "a comma or a closing bracket is missing", "close every { with } and every [ with ]"
    else:
        fix = "check indentation, brackets, quotes and colons near this line"
    return Problem("invalid YAML syntax", why, fix, place)


class _Reader:
    """Recursive converter of the parser's events to nodes, which collects problems with keys."""

    def __init__(self, name: str, events: Iterator[Any]) -> None:
        self.name, self.events = name, events
        self.problems: list[Problem] = []
        self.values, self.expanded = 0, 0
        self._anchored: dict[str | None, YamlNode | None] = {}

    def document(self) -> YamlNode:
        """Return the root node of the only document. Raises `DeclarationError` for content that exceeds a limit."""
        next(self.events)  # start of the stream
        if isinstance(next(self.events), yaml.StreamEndEvent):
            return YamlNode(None, self.name)
        node = self._node(next(self.events), 0)
        next(self.events)  # end of the document
        after = next(self.events)
        if not isinstance(after, yaml.StreamEndEvent):
            why, fix = "a file declares one train", "declare each train in its own file"
            place = f"{self.name}:{after.start_mark.line + 1}"
            raise DeclarationError(Problem("the file contains a second document", why, fix, place))
        return node

    def _node(self, event: Any, depth: int) -> YamlNode:
        """Return the value that begins with an event as a node; `depth` is the number of enclosing collections."""
        place = f"{self.name}:{event.start_mark.line + 1}"
        self.values += 1
        if self.values > MOST_VALUES:
            why = f"a file has at most {MOST_VALUES} values"
            fix = "build the train in Python with `GearTrain.declare`"
            raise DeclarationError(Problem("the file is too large", why, fix, self.name))
        # stops early, because a large file that is wrong can have millions of problems
        if len(self.problems) > MOST_REPORTED + 1:
            raise DeclarationError(self.problems)
        if isinstance(event, yaml.AliasEvent):
            return self._repeated(event.anchor, place)
        if event.tag not in _TAGS:
            what = f"tag '{event.tag}' is not supported"
            raise DeclarationError(Problem(what, "a declaration is plain data", "remove the tag", place))
        if event.anchor in self._anchored:
            what, why = f"anchor '&{event.anchor}' is given twice", "an alias repeats one value"
            raise DeclarationError(Problem(what, why, "rename one of the two anchors", place))
        if event.anchor:
            self._anchored[event.anchor] = None  # not finished
        if not isinstance(event, yaml.ScalarEvent):
            made = self._collection(event, depth, place)
        elif event.value in _NULLS and (event.implicit[0] or (event.tag or "").endswith(":null")):
            made = YamlNode(None, place)
        else:
            made = YamlNode(event.value, place)
        if event.anchor:
            self._anchored[event.anchor] = made
        return made

    def _collection(self, event: Any, depth: int, place: str) -> YamlNode:
        """Convert a mapping or list and all values in it, up to its last event."""
        if depth == MOST_DEPTH:
            raise DeclarationError(_too_deep(place))
        made = YamlNode({} if isinstance(event, yaml.MappingStartEvent) else [], place)
        while not isinstance(first := next(self.events), yaml.CollectionEndEvent):
            node = self._node(first, depth + 1)
            if isinstance(made.value, dict):
                self._add(made, node, self._node(next(self.events), depth + 1))
            else:
                made.value.append(node)
                made.size += node.size
        return made

    def _repeated(self, anchor: str | None, place: str) -> YamlNode:
        target = self._anchored.get(anchor)
        if target is None:
            what = f"alias '*{anchor}' {'contains itself' if anchor in self._anchored else 'has no anchor'}"
            fix = f"write the value out, or put the anchor '&{anchor}' on an earlier value"
            raise DeclarationError(Problem(what, "an alias can repeat only a value that ends before it", fix, place))
        # aliases of aliases grow exponentially ("billion laughs"), so the expanded size is counted
        self.expanded += target.size
        if self.expanded > MOST_EXPANDED:
            why = f"at most {MOST_EXPANDED} values are allowed after expansion"
            raise DeclarationError(Problem("the aliases expand to too many values", why, "write the values out", place))
        return target

    def _add(self, mapping: YamlNode, key: YamlNode, value: YamlNode) -> None:
        """Add an entry to a mapping, or a problem to `problems` if the key is null, repeated, or not a scalar."""
        if not isinstance(key.value, str):
            text = "null" if key.value is None else "a list or mapping"
            self.problems.append(
                Problem(f"{text} is used as a key", "keys must be strings", "quote it, or give a name", key.place)
            )
            return
        if key.value in mapping.value:
            why = f"it is also at {mapping.keys[key.value]}, and one of the two values would be lost"
            self.problems.append(
                Problem(f"key '{key.value}' is given twice", why, "rename or remove one of the two keys", key.place)
            )
        mapping.value[key.value] = value
        mapping.keys[key.value] = key.place
        mapping.size += value.size


def node_from_data(data: Any, loc: Loc = (), marks: Marks = dotted) -> YamlNode:
    """Convert plain data or parts of a declaration to nodes; `marks` returns the place of a path in the file."""
    place = marks(loc)
    if isinstance(data, BaseModel):
        data = data.model_dump(mode="json", exclude_unset=True, by_alias=True)
    if len(loc) > MOST_DEPTH:
        raise DeclarationError(_too_deep(place))
    if isinstance(data, Mapping):
        entries = {str(key): node_from_data(value, (*loc, str(key)), marks) for key, value in data.items()}
        return YamlNode(entries, place, {key: node.place for key, node in entries.items()})
    if isinstance(data, list | tuple):
        return YamlNode([node_from_data(value, (*loc, at), marks) for at, value in enumerate(data)], place)
    return YamlNode(data, place)


def texts(node: YamlNode | None) -> Iterator[str]:
    """Return an iterator over the scalars of a list node as strings. The iterator is empty if the node is None."""
    return (item.text for item in node.items) if node else iter(())


def as_yaml(data: Mapping[str, Any]) -> str:
    """Return YAML text that `load` reads as the same declaration. Parts have one line each; keys keep their order."""
    return "".join(_section(key, value) for key, value in data.items())


def _section(key: str, value: Any) -> str:
    """Return the YAML text of one top-level key, with one entry per line."""
    if isinstance(value, Mapping) and value:
        lines = [f"  {on_one_line(name)}: {on_one_line(part)}\n" for name, part in value.items()]
    elif isinstance(value, list | tuple) and value:
        lines = [f"  - {on_one_line(part)}\n" for part in value]
    else:
        return f"{on_one_line(key)}: {on_one_line(value)}\n"
    return f"{on_one_line(key)}:\n{''.join(lines)}"


def on_one_line(value: Any) -> str:
    """Return a value as YAML on one line. Numbers are written by `repr`, as declarations preserve their text."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{on_one_line(key)}: {on_one_line(part)}" for key, part in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(on_one_line, value)) + "]"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return repr(value)
    # dumped as a list entry, so that texts with commas and brackets are quoted
    text: str = yaml.safe_dump([value], default_flow_style=True, width=float("inf"), allow_unicode=True)
    return text.removesuffix("\n").removeprefix("[").removesuffix("]")
