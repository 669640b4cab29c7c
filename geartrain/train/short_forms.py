"""Short forms of turning pairs and gear pairs, each of which means exactly one long form.

`revolutes: {main: [frame, sun, carrier]}`: on each axis the first link carries the others.
`gears: [s ~ p]`: a pair of two wheels.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from geartrain.errors import DeclarationError, Problem
from geartrain.train.yaml_nodes import YamlNode, texts

JOINT_SCHEMA = {
    "type": "object",
    "additionalProperties": {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 2},
}
"""Of `revolutes` in short."""
_MARK = "~"


def has_short_forms(data: Mapping[str, Any]) -> bool:
    """True of plain data with any, and of data with lists where a pair belongs."""
    pairs = (each for key in ("gears", "revolutes") if isinstance(data.get(key), list | tuple) for each in data[key])
    return isinstance(data.get("revolutes"), Mapping) or any(isinstance(each, str | list | tuple) for each in pairs)


def written_out(root: YamlNode) -> YamlNode:
    """A declaration in long forms only, whose parts have the places of the short ones.

    Raises `DeclarationError` for short forms that say nothing.
    """
    joints, gears = root.mapping.get("revolutes"), root.mapping.get("gears")
    changed: dict[str, YamlNode] = {}
    problems = [*_lists("gears", gears, "{} ~ {}"), *_lists("revolutes", joints, "{{pair: [{}, {}], axis: A}}")]
    if joints is not None and isinstance(joints.value, dict):
        changed["revolutes"] = YamlNode(list(_joints(joints, problems)), joints.place)
    if gears is not None and any(isinstance(each.value, str) for each in gears.items):
        changed["gears"] = YamlNode([_pair(each, problems) for each in gears.items], gears.place)
    if problems:
        raise DeclarationError(problems)
    return YamlNode({**root.mapping, **changed}, root.place, root.keys) if changed else root


def _lists(key: str, parts: YamlNode | None, form: str) -> Iterator[Problem]:
    """One problem for all pairs that are written as bare lists."""
    listed = [part for part in parts.items if isinstance(part.value, list)] if parts is not None else []
    if listed:
        names = [*texts(listed[0]), "a", "b"][:2]
        several = len(listed) > 1
        what = f"{len(listed)} entries of `{key}` are lists" if several else f"an entry of `{key}` is a list"
        fix = f"write `{form.format(*names)}`" + (", and the others likewise" if several else "")
        yield Problem(what, "a pair has its own form", fix, listed[0].place)


def _joints(joints: YamlNode, problems: list[Problem]) -> Iterator[YamlNode]:
    for axis, links in joints.mapping.items():
        place = joints.keys.get(axis, joints.place)
        if len(links.items) < 2:
            why = "its links are a list that begins with the one that carries the others"
            fix = f"write for example `{axis}: [frame, arbor]`"
            problems.append(Problem(f"axis '{axis}' joins nothing", why, fix, place))
            continue
        first, *others = links.items
        for other in others:
            parts = {"pair": YamlNode([first, other], other.place), "axis": YamlNode(axis, place)}
            yield YamlNode(parts, other.place, dict.fromkeys(parts, other.place))


def _pair(gear: YamlNode, problems: list[Problem]) -> YamlNode:
    if not isinstance(gear.value, str):
        return gear
    names = [name.strip() for name in gear.value.split(_MARK)]
    if len(names) != 2 or not all(names):
        why = "a pair in short is two wheels with a tilde between them"
        problems.append(Problem(f"'{gear.value}' is no gear pair", why, "write for example `sun ~ planet`", gear.place))
    wheels = YamlNode([YamlNode(name, gear.place) for name in names], gear.place)
    return YamlNode({"pair": wheels}, gear.place, {"pair": gear.place})
