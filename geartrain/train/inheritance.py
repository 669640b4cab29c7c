"""Inheritance by `extends`: after `remove` is applied, a child is merged into its parent. Line numbers are kept."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from geartrain.errors import DeclarationError, Loc, Problem, suggest
from geartrain.teeth.coupling import COUPLING_ENDS
from geartrain.train.validation import JOINTS, declare, written_out
from geartrain.train.yaml_nodes import YamlNode, node_from_data, texts

if TYPE_CHECKING:
    from geartrain.train.declaration import Train

_NOT_INHERITED = ("name", "title", "note", "tour", "extends", "remove")
_BY_NAME = ("sources", "links", "axes", "outputs", "dials", "clutches", "states")
_REMOVED_BY_NAME = ("links", "outputs", "dials", "states", "axes")
_SHORT = {"wheels": "teeth", "sources": "cite"}


def merge_parent(parent: YamlNode, child: YamlNode) -> YamlNode:
    """Return a declaration merged with its parent: entries with a name replace or extend the parent's entries."""
    base = {key: node for key, node in parent.mapping.items() if key not in _NOT_INHERITED}
    keys = {key: parent.keys[key] for key in base}
    root = YamlNode(base, child.place, keys)
    if "remove" in child.mapping:
        root = _apply_remove(root, child.mapping["remove"])
    result = dict(root.mapping)
    for key, node in child.mapping.items():
        keys[key] = child.keys[key]
        old = result.get(key)
        if node.value is None:
            result.pop(key, None)
        elif old is not None and key in _BY_NAME:
            result[key] = _merge_mappings(old, node, key)
        elif old is not None and key in ("gears", "couplings", *JOINTS):
            result[key] = _merge_lists(old, node, key)
        else:
            result[key] = node
    merged = YamlNode(result, child.place, keys)
    if problems := list(_moved_wheels(root, child, merged)):
        raise DeclarationError(problems)
    return merged


def change_declaration(declared: Train, changes: Mapping[str, Any]) -> Train:
    """Return a declaration with values changed by the rules of `extends`; other values keep their line numbers."""

    def place(loc: Loc) -> str:
        return declared.place(*loc)

    merged = merge_parent(node_from_data(declared, marks=place), written_out(node_from_data(changes)))
    # a changed copy keeps name, title and note, which a child file does not inherit; its tour may show a removed part
    own = declared.model_fields_set.intersection(_NOT_INHERITED) - {"tour"}
    kept = {key: getattr(declared, key) for key in own}
    new = {key: value for key, value in merged.plain().items() if key != "remove"}  # already applied
    return declare(kept | new, merged.place_of)


def _moved_wheels(parent: YamlNode, child: YamlNode, merged: YamlNode) -> Iterator[Problem]:
    """Yield a problem for each wheel that a child declares on another link although the parent's link still has it."""
    owner = {wheel: link for link, part in _child(parent, "links").items() for wheel in _child(part, "wheels")}
    for link, part in _child(child, "links").items():
        for wheel in _child(part, "wheels"):
            old = owner.get(wheel, link)
            if old != link and wheel in _child(merged, "links", old, "wheels"):
                yield Problem(
                    f"wheel '{wheel}' is already on link '{old}' of the parent",
                    f"link '{link}' declares it again, and wheel ids are unique in a train",
                    f"to change the parent's wheel, write it under `{old}`: `links: {{{old}: {{wheels: {{{wheel}: "
                    "...}}}`; give an additional wheel another id",
                    child.place_of(("links", link, "wheels", wheel)),
                )


def _merge_mappings(old: YamlNode, new: YamlNode, kind: str) -> YamlNode:
    """Merge two mappings entry by entry, and return the result; null removes an entry."""
    if not isinstance(old.value, dict) or not isinstance(new.value, dict):
        return new
    result, keys = dict(old.value), dict(old.keys)
    for name, node in new.value.items():
        keys[name] = new.keys[name]
        before = result.get(name)
        if before is None:
            result[name] = node
        elif node.value is None:
            del result[name]
        else:
            result[name] = _merge_entry(before, node, kind)
    return YamlNode(result, new.place, keys)


def _merge_entry(old: YamlNode, new: YamlNode, kind: str) -> YamlNode:
    """Merge two entries of the same kind after expanding short forms, and return the result."""
    if kind == "clutches":  # exactly one of `fixes` and `locks`: merging could give both
        return new
    old, new = _expanded(old, kind), _expanded(new, kind)
    if not isinstance(old.value, dict) or not isinstance(new.value, dict):
        return new
    result, keys = dict(old.value), dict(old.keys)
    for key, node in new.value.items():
        keys[key] = new.keys[key]
        if key in result and ((kind == "links" and key == "wheels") or (kind == "states" and key == "outputs")):
            result[key] = _merge_mappings(result[key], node, key)
        elif node.value is None:
            result.pop(key, None)
        else:
            result[key] = node
    return YamlNode(result, new.place, keys)


def _expanded(node: YamlNode, kind: str) -> YamlNode:
    key = _SHORT.get(kind)
    if key is None or isinstance(node.value, dict) or node.value is None:
        return YamlNode({}, node.place) if node.value is None else node
    return YamlNode({key: node}, node.place, {key: node.place})


def _identity(key: str, node: YamlNode) -> object:
    """Return the value that an entry of the list `key` has in common with the parent's entry that it changes."""
    if key in JOINTS:
        return frozenset(_ends(key, node))
    given = node.mapping.get("id")
    if given:
        return given.text
    # a gear pair with more than two ends is an error and must not change another pair
    ends = _ends(key, node)
    return "~".join(ends[:2] if key == "couplings" else ends)


def _ends(key: str, node: YamlNode) -> list[str]:
    """Return the links or wheels that an entry of the list `key` connects. The driver of a coupling is the first."""
    keys = COUPLING_ENDS if key == "couplings" else ("pair",)
    given = (node.mapping[each] for each in keys if each in node.mapping)
    return [name for each in given for name in (each.mapping or texts(each))]


def _merge_lists(old: YamlNode, new: YamlNode, key: str) -> YamlNode:
    if not isinstance(old.value, list) or not isinstance(new.value, list):
        return new
    result = list(old.value)
    at = {_identity(key, node): position for position, node in enumerate(result)}
    for node in new.value:
        position = at.get(_identity(key, node))
        if position is None:
            result.append(node)
        else:
            result[position] = _merge_entry(result[position], node, "list")
    return YamlNode(result, new.place)


def _apply_remove(root: YamlNode, remove: YamlNode) -> YamlNode:
    """Remove parts from the parent; a link is removed together with its wheels, joints, pairs and couplings."""
    gone: dict[str, list[object]] = {key: list(texts(node)) for key, node in remove.mapping.items()}
    for key in (key for key in JOINTS if key in remove.mapping):
        # joints have no names, and are removed by their two links
        gone[key] = [frozenset(texts(node)) for node in remove.mapping[key].items]
    _check_known(root, remove, gone)
    links, wheels = set(gone.get("links", ())), set(gone.get("wheels", ()))
    for link in links:
        wheels.update(_child(root, "links", str(link), "wheels"))
    result = dict(root.mapping)
    for key in _REMOVED_BY_NAME:
        if key in gone and key in result:
            result[key] = _drop(result[key], gone[key])
    if "links" in result:
        kept = result["links"]
        parts = dict(kept.mapping)
        for name, link in parts.items():
            if wheels.intersection(_child(link, "wheels")):
                own = {**link.mapping, "wheels": _drop(link.mapping["wheels"], wheels)}
                parts[name] = YamlNode(own, link.place, link.keys)
        result["links"] = YamlNode(parts, kept.place, kept.keys)
    for key, removed in {**dict.fromkeys(JOINTS, links), "gears": wheels, "couplings": links | wheels}.items():
        if key in result:
            entries, named = result[key].items, gone.get(key, ())
            left = [
                node for node in entries if removed.isdisjoint(_ends(key, node)) and _identity(key, node) not in named
            ]
            result[key] = YamlNode(left, result[key].place)
    return YamlNode(result, root.place, root.keys)


def _child(node: YamlNode, *keys: str) -> Mapping[str, YamlNode]:
    for key in keys:
        node = node.mapping.get(key, YamlNode(None, node.place))
    return node.mapping


def _drop(node: YamlNode, names: Iterable[object]) -> YamlNode:
    gone = set(names)
    return YamlNode({name: part for name, part in node.mapping.items() if name not in gone}, node.place, node.keys)


def _check_known(root: YamlNode, remove: YamlNode, gone: Mapping[str, list[object]]) -> None:
    """Raise `DeclarationError` if the removed parts `gone` (by kind) are not all declared by the parent `root`."""
    known: dict[str, set[Any]] = {key: set(_child(root, key)) for key in _REMOVED_BY_NAME}
    known["wheels"] = {wheel for link in _child(root, "links").values() for wheel in _child(link, "wheels")}
    for key in (*JOINTS, "gears", "couplings"):
        known[key] = {_identity(key, node) for node in root.mapping.get(key, YamlNode([], "")).items}
    problems = []
    for key, names in gone.items():
        for at, name in enumerate(names):
            if key in known and name not in known[key]:
                part, fix = f"part '{name}'", "delete this entry"
                if isinstance(name, frozenset):
                    part = f"{'turning' if key == 'revolutes' else 'sliding'} pair of {' and '.join(sorted(name))}"
                else:
                    fix = suggest(str(name), known[key], otherwise=fix)
                why = f"the parent has no such entry in {key}"
                problems.append(Problem(f"`remove` names the unknown {part}", why, fix, remove.place_of((key, at))))
    if problems:
        raise DeclarationError(problems)
