"""YAML 1.2 (core schema) as nodes with line numbers.

Every scalar is kept as a string, so that `1:30`, `010`, `no` and `1.0000` reach the models unchanged; only a plain null
becomes None. Nesting depth, number of values and expansion of aliases are limited, keys must be unique, and tags are
rejected. Plain Python data can be converted to nodes as well, and a declaration can be written as YAML text.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml
from pydantic import BaseModel

from geartrain.errors import MOST_REPORTED, DeclarationError, Loc, Marks, Problem, dotted

MOST_DEPTH = 32
MOST_VALUES = 3_000_000  # about 200,000 links; the parser needs 0.25 kB for each value
MOST_EXPANDED = 1_000_000
_NULLS = {"", "~", "null", "Null", "NULL"}
_TAGS = {f"tag:yaml.org,2002:{kind}" for kind in ("str", "int", "float", "bool", "null", "seq", "map")}

_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass(slots=True)
class YamlNode:
    """Mapping, list, scalar or null of a YAML document, with the place where it was written."""

    value: Any
    """Value. Scalars of a file are strings; scalars of plain data are the given objects."""
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
        """Scalar as text; "" for other nodes."""
        return "" if self.value is None or isinstance(self.value, dict | list) else str(self.value)

    def plain(self) -> Any:
        """Return the node as plain Python data, without the places."""
        if isinstance(self.value, dict):
            return {key: node.plain() for key, node in self.value.items()}
        if isinstance(self.value, list):
            return [node.plain() for node in self.value]
        return self.value

    def place_of(self, loc: Loc) -> str:
        """Return the place of the value at `loc`. Steps that are not in the file are skipped."""
        node, place = self, self.place
        for step in loc:
            if isinstance(node.value, dict) and str(step) in node.value:
                place = node.keys.get(str(step), place)
                node = node.value[str(step)]
            elif isinstance(node.value, list) and isinstance(step, int) and step < len(node.value):
                node = node.value[step]
                place = node.place
        return place


def parse_yaml(text: str, name: str) -> YamlNode:
    """Parse `text` as one YAML document. `name` is the file name in places. Raises `DeclarationError` for invalid
    YAML.
    """
    builder = _Builder(name)
    try:
        for event in yaml.parse(text, Loader=_Loader):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        raise DeclarationError(_syntax(error, name, text)) from None
    except (yaml.YAMLError, RecursionError) as error:
        raise DeclarationError(
            Problem("this is not YAML", str(error).splitlines()[0], "save it as UTF-8 text", name)
        ) from None
    return builder.finish()


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


class _Builder:
    """Iterative construction of nodes from parser events. Deep nesting is refused before the call stack overflows."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.root: YamlNode | None = None
        self.open: list[tuple[YamlNode, list[tuple[str, str] | None]]] = []
        self.anchors: dict[str, YamlNode] = {}
        self.unfinished: set[int] = set()
        self.problems: list[Problem] = []
        self.values = self.expanded = 0

    def take(self, event: yaml.Event) -> None:
        """Process one event of the parser. Raises `DeclarationError` for content that exceeds a limit or cannot be read
        further.
        """
        self.values += 1
        if self.values > MOST_VALUES:
            why = f"a file has at most {MOST_VALUES} values"
            raise DeclarationError(
                Problem("the file is too large", why, "build the train in Python with `GearTrain.declare`", self.name)
            )
        # stops early, because a large file that is wrong can have millions of problems
        if len(self.problems) > MOST_REPORTED + 1:
            raise DeclarationError(self.problems)
        place = f"{self.name}:{event.start_mark.line + 1}" if event.start_mark else self.name
        match event:
            case yaml.ScalarEvent():
                self._check_tag(event.tag, place)
                # only an unquoted null becomes None: "null" in quotes is a string
                plain = event.implicit[0] and event.value in _NULLS and event.style in (None, "")
                self._put(YamlNode(None if plain else event.value, place), event.anchor, place)
            case yaml.MappingStartEvent() | yaml.SequenceStartEvent():
                self._check_tag(event.tag, place)
                node = YamlNode({} if isinstance(event, yaml.MappingStartEvent) else [], place)
                if len(self.open) >= MOST_DEPTH:
                    raise DeclarationError(_too_deep(place))
                if event.anchor:
                    self.anchors[event.anchor] = node
                self.unfinished.add(id(node))
                self.open.append((node, [None]))
            case yaml.MappingEndEvent() | yaml.SequenceEndEvent():
                node, _ = self.open.pop()
                self.unfinished.discard(id(node))
                self._put(node, None, node.place)
            case yaml.AliasEvent():
                self._put(self._alias(event.anchor, place), None, place)
            case yaml.DocumentStartEvent() if self.root is not None:
                raise DeclarationError(
                    Problem(
                        "a second document begins",
                        "a file declares one train",
                        "declare each train in its own file",
                        place,
                    )
                )

    def _alias(self, anchor: str | None, place: str) -> YamlNode:
        target = self.anchors.get(anchor or "")
        if target is None or id(target) in self.unfinished:
            what = f"alias '*{anchor}' " + ("contains itself" if target else "has no anchor")
            raise DeclarationError(
                Problem(
                    what,
                    "an alias can repeat only a value that ends before it",
                    f"write the value out, or put the anchor '&{anchor}' on an earlier value",
                    place,
                )
            )
        # aliases of aliases grow exponentially ("billion laughs"), so the expanded size is counted
        self.expanded += target.size
        if self.expanded > MOST_EXPANDED:
            raise DeclarationError(
                Problem(
                    "the aliases expand to too many values",
                    f"at most {MOST_EXPANDED} values are allowed after expansion",
                    "write the values out",
                    place,
                )
            )
        return target

    def _check_tag(self, tag: str | None, place: str) -> None:
        if tag and tag != "!" and tag not in _TAGS:
            raise DeclarationError(
                Problem(f"tag '{tag}' is not supported", "a declaration is plain data", "remove the tag", place)
            )

    def _put(self, node: YamlNode, anchor: str | None, place: str) -> None:
        if anchor:
            self.anchors[anchor] = node
        if not self.open:
            self.root = node
            return
        parent, pending = self.open[-1]
        if isinstance(parent.value, list):
            parent.value.append(node)
            parent.size += node.size
        elif pending[0] is None:
            if not isinstance(node.value, str):
                text = "null" if node.value is None else "a list or mapping"
                self.problems.append(
                    Problem(f"{text} is used as a key", "keys are names", "quote it, or give a name", place)
                )
            # a unique substitute for an invalid key, so that parsing continues and collects further problems
            key = node.text if isinstance(node.value, str) else f"?{place}"
            pending[0] = (key, place)
        else:
            key, key_place = pending[0]
            pending[0] = None
            if key in parent.mapping:
                self.problems.append(
                    Problem(
                        f"key '{key}' is given twice",
                        f"it is also at {parent.keys[key]}, and one of the two values would be lost",
                        "rename or remove one of the two keys",
                        key_place,
                    )
                )
            parent.mapping[key] = node
            parent.keys[key] = key_place
            parent.size += node.size

    def finish(self) -> YamlNode:
        """Return the root node. Raises `DeclarationError` with all problems that were collected."""
        if self.problems:
            raise DeclarationError(self.problems)
        if self.root is None or self.root.value is None:
            raise DeclarationError(
                Problem(
                    "the declaration is empty",
                    "a declaration has at least the key `links`",
                    "begin with `links:`",
                    self.name,
                )
            )
        if not isinstance(self.root.value, dict):
            raise DeclarationError(
                Problem(
                    "the declaration is not a mapping",
                    "a train is declared by keys such as links and gears",
                    "begin with `links:`",
                    self.root.place,
                )
            )
        return self.root


def node_from_data(data: Any, loc: Loc = (), marks: Marks = dotted) -> YamlNode:
    """Convert plain data or parts of a declaration to nodes; their places are by default their paths.

    Raises `DeclarationError` for data nested too deeply.
    """
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
    """Return an iterator over the scalars of a list node as strings; it is empty for None."""
    return (item.text for item in node.items) if node else iter(())


def as_yaml(data: Mapping[str, Any]) -> str:
    """Return YAML text that `load` reads as the same declaration, with one part per line and keys in their order."""
    return "".join(_section(key, value) for key, value in data.items())


def _section(key: str, value: Any) -> str:
    """Return the text of one top-level key, with one entry per line."""
    if isinstance(value, Mapping) and value:
        lines = [f"  {on_one_line(name)}: {on_one_line(part)}\n" for name, part in value.items()]
    elif isinstance(value, list | tuple) and value:
        lines = [f"  - {on_one_line(part)}\n" for part in value]
    else:
        return f"{on_one_line(key)}: {on_one_line(value)}\n"
    return f"{on_one_line(key)}:\n{''.join(lines)}"


def on_one_line(value: Any) -> str:
    """Return a value on one line. Numbers are written by `repr`, as a declaration keeps the text of its numbers."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{on_one_line(key)}: {on_one_line(part)}" for key, part in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(on_one_line, value)) + "]"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return repr(value)
    # dumped as a list entry, so that texts with commas and brackets are quoted
    text: str = yaml.safe_dump([value], default_flow_style=True, width=float("inf"), allow_unicode=True)
    return text.removesuffix("\n").removeprefix("[").removesuffix("]")
