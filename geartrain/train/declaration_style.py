"""Rewriting of a declaration's turning, sliding and gear pairs and belts in short or in long forms.

All other lines are unchanged, and comments stay with their entries. The section `couplings` is renamed to `belts`, or
the reverse, only if all couplings of the train are belts around two wheels.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import yaml

from geartrain.train.validation import JOINTS

_WIDTH = 120
_NAME = re.compile(r"[^\s~'\"\[\]{},:#&*!|>%@`][^\s~'\"\[\]{},:#]*")
"""Pattern of a name that needs no quotes, not even in a flow list."""
_Loader: Any = yaml.SafeLoader
_RENAMED = {"couplings": "belts", "belts": "couplings"}
"""Sections whose name differs between the two forms."""


@dataclass(frozen=True)
class _Entry:
    """Text of one entry of a section of a declaration, with the comments before it and at the end of its line."""

    text: str
    before: tuple[str, ...] = ()
    behind: str = ""


def with_short_forms(text: str) -> str:
    """Rewrite a declaration: turning pairs grouped by axis, gear pairs and belts without other keys as `a ~ b`."""
    joints = {key: partial(_short_joints, key=key) for key in JOINTS}
    gears = partial(_pairs, write=_short_pair)
    return _rewritten(text, {**joints, "gears": gears, "couplings": _short_belts})


def with_long_forms(text: str) -> str:
    """Rewrite a declaration in long form, in which every turning pair, gear pair and belt is a separate mapping."""
    joints = {key: partial(_long_joints, key=key) for key in JOINTS}
    gears = partial(_pairs, write=_long_pair)
    return _rewritten(text, {**joints, "gears": gears, "belts": _long_belts})


def _rewritten(text: str, writers: Mapping[str, Callable[[_SectionSource], list[str] | None]]) -> str:
    lines = text.splitlines()
    root = yaml.compose(text, Loader=_Loader)
    # in a declaration in braces, sections do not begin on lines of their own
    if not isinstance(root, yaml.MappingNode) or root.flow_style:
        return text
    names = {key.value for key, _ in root.value}
    parts = [(key, value) for key, value in root.value if key.value in writers and _RENAMED.get(key.value) not in names]
    # from the last section to the first, so that the line numbers of earlier sections stay valid
    for key, value in sorted(parts, key=lambda part: -part[0].start_mark.line):
        written = _SectionSource(text, key, value)
        found = writers[key.value](written)
        if found is not None:
            lines[written.first : written.last + 1] = found
    return "\n".join(lines) + ("\n" if text.endswith("\n") else "")


def _last_line(node: yaml.Node) -> int:
    """Return the number of the last line of a node, not counting blank lines and comments after it."""
    if not isinstance(node, yaml.CollectionNode) or node.flow_style or not node.value:
        return int(node.end_mark.line)
    last = node.value[-1]
    return _last_line(last[1] if isinstance(last, tuple) else last)


class _SectionSource:
    """Section of a declaration as YAML source text, with its comments by line."""

    def __init__(self, text: str, key: yaml.Node, value: yaml.Node) -> None:
        self.text, self.value = text, value
        self.first, self.last = key.start_mark.line, _last_line(value)
        self._after = self.first
        ends: dict[int, int] = {}
        for token in yaml.scan(text, Loader=_Loader):
            if not isinstance(token, yaml.BlockEndToken | yaml.StreamEndToken):
                ends[token.end_mark.line] = max(ends.get(token.end_mark.line, 0), token.end_mark.column)
        self._behind: dict[int, str] = {}
        self._alone: dict[int, str] = {}
        for at, line in enumerate(text.splitlines()[: self.last + 1]):
            rest = line[ends.get(at, 0) :].strip()
            if at >= self.first and rest.startswith("#"):
                (self._behind if line[: ends.get(at, 0)].strip() else self._alone)[at] = rest

    @property
    def head(self) -> str:
        """Comment on the line of the section's key; empty if there is none."""
        return self._behind.get(self.first, "")

    @property
    def items(self) -> list[yaml.Node]:
        """Entries of the section if it is a list; empty for other values."""
        return list(self.value.value) if isinstance(self.value, yaml.SequenceNode) else []

    def source(self, node: yaml.Node) -> str:
        """Return the source text of a YAML node."""
        return self.text[node.start_mark.index : node.end_mark.index].strip()

    def entry(self, text: str, node: yaml.Node) -> _Entry:
        """Return an entry with the text `text` and the comments at a node. Comments of earlier entries are omitted."""
        start, end = node.start_mark.line, _last_line(node)
        before = tuple(each for at, each in self._alone.items() if self._after <= at < start)
        behind = [self._behind.pop(at) for at in range(max(start, self.first + 1), end + 1) if at in self._behind]
        self._after = end + 1
        return _Entry(text, before, " ".join(behind))


def _parts(node: yaml.Node) -> dict[str, yaml.Node]:
    return {key.value: value for key, value in node.value} if isinstance(node, yaml.MappingNode) else {}


def _pair_of(written: _SectionSource, node: yaml.Node, keys: set[str]) -> list[str]:
    """Return the source texts of the two names of a pair; [] if the node has other keys than `keys`."""
    parts = _parts(node)
    if set(parts) != keys or not isinstance(parts["pair"], yaml.SequenceNode) or len(parts["pair"].value) != 2:
        return []
    return [written.source(each) for each in parts["pair"].value]


# ------------------------------------------------------------------------------------------------------------ to short


def _short_joints(written: _SectionSource, key: str) -> list[str] | None:
    pairs = [_pair_of(written, node, {"pair", "axis"}) for node in written.items]
    if not pairs or not all(pairs):
        return None
    axes: dict[str, tuple[list[str], list[_Entry]]] = {}
    for node, (first, other) in zip(written.items, pairs, strict=True):
        links, entries = axes.setdefault(written.source(_parts(node)["axis"]), ([first], []))
        if links[0] != first:
            return None  # a chain of joints, in which no link carries all others
        links.append(other)
        entries.append(written.entry("", node))
    merged = [
        _Entry(
            f"{axis}: [{', '.join(links)}]",
            tuple(text for each in entries for text in each.before),
            " ".join(each.behind for each in entries if each.behind),
        )
        for axis, (links, entries) in axes.items()
    ]
    return list(_section(key, merged, written.head, "{}", ""))


def _short_pair(written: _SectionSource, node: yaml.Node) -> str:
    """Return the short form of a gear pair; if the pair has other keys, return its source text."""
    wheels = _pair_of(written, node, {"pair"})
    if not all(_NAME.fullmatch(wheel) for wheel in wheels) or not wheels:
        return written.source(node)
    return " ~ ".join(wheels)


def _short_belts(written: _SectionSource) -> list[str] | None:
    """Return the lines of a section that has only belts around two wheels; None if there are other couplings."""
    entries = []
    for node in written.items:
        parts = _parts(node)
        around = parts.get("around")
        wheels = [written.source(each) for each in around.value] if isinstance(around, yaml.SequenceNode) else []
        if set(parts) != {"kind", "around"} or parts["kind"].value != "belt":
            return None
        if len(wheels) != 2 or not all(map(_NAME.fullmatch, wheels)):
            return None
        entries.append(written.entry(" ~ ".join(wheels), node))
    return list(_section("belts", entries, written.head, "[]", "- ")) if entries else None


# ------------------------------------------------------------------------------------------------------------- to long


def _long_joints(written: _SectionSource, key: str) -> list[str] | None:
    if not isinstance(written.value, yaml.MappingNode):
        return None
    entries: list[_Entry] = []
    for label, links in written.value.value:
        names = [written.source(each) for each in links.value] if isinstance(links, yaml.SequenceNode) else []
        if len(names) < 2:
            return None
        own = written.entry("", links)
        for other in names[1:]:
            text = f"{{pair: [{names[0]}, {other}], axis: {written.source(label)}}}"
            entries.append(_Entry(text, own.before, own.behind))
            # the comments of an axis are kept at its first entry only
            own = _Entry("")
    return list(_section(key, entries, written.head, "", "- "))


def _long_pair(written: _SectionSource, node: yaml.Node) -> str:
    if isinstance(node, yaml.ScalarNode) and node.value.count("~") == 1:
        first, second = (wheel.strip() for wheel in node.value.split("~"))
        return f"{{pair: [{first}, {second}]}}"
    return written.source(node)


def _long_belts(written: _SectionSource) -> list[str] | None:
    pairs = [_long_pair(written, node) for node in written.items]
    if not pairs or not all(pair.startswith("{pair: ") for pair in pairs):
        return None
    nodes = zip(pairs, written.items, strict=True)
    entries = [written.entry(pair.replace("{pair: ", "{kind: belt, around: ", 1), node) for pair, node in nodes]
    return list(_section("couplings", entries, written.head, "", "- "))


def _pairs(written: _SectionSource, write: Callable[[_SectionSource, yaml.Node], str]) -> list[str] | None:
    """Return the lines of the section of gear pairs, with each entry rewritten by `write`; None if no entry changes."""
    entries = [written.entry(write(written, node), node) for node in written.items]
    unchanged = [each.text for each in entries] == [written.source(node) for node in written.items]
    if unchanged or any("\n" in each.text for each in entries):
        return None
    all_short = not any(each.text.startswith("{") for each in entries)
    return list(_section("gears", entries, written.head, "[]" if all_short else "", "- "))


def _section(key: str, entries: Sequence[_Entry], head: str, brackets: str, bullet: str) -> Iterator[str]:
    """Yield the lines of a rewritten section: a single line if it is short and has no comments, otherwise one line for
    each entry.
    """
    if brackets and not head and not any(each.before or each.behind for each in entries):
        line = f"{key}: {brackets[0]}{', '.join(each.text for each in entries)}{brackets[1]}"
        if len(line) <= _WIDTH:
            yield line
            return
    yield _with_comment(f"{key}:", head)
    for each in entries:
        yield from (f"  {text}" for text in each.before)
        yield _with_comment(f"  {bullet}{each.text}", each.behind)


def _with_comment(line: str, comment: str) -> str:
    return f"{line}  {comment}" if comment else line
