"""Inheritance by `extends`: a child declaration is merged into its parent, after `remove`. Line numbers are kept."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from geartrain.errors import DeclarationError, Loc, Problem, suggest
from geartrain.train.validation import declare, written_out
from geartrain.train.yaml_nodes import YamlNode, node_from_data, texts

if TYPE_CHECKING:
    from geartrain.train.declaration import Train

_NOT_INHERITED = ("name", "title", "note", "extends", "remove")
_BY_NAME = ("sources", "links", "axes", "outputs", "dials", "clutches", "states")
_SHORT = {"wheels": "teeth", "sources": "cite"}


def merge_parent(parent: YamlNode, child: YamlNode) -> YamlNode:
    """Merge a child declaration into its parent and return the result as a new node.

    Raises `DeclarationError` if `remove` names a part that does not exist, or if a wheel of the parent is declared on
    another link.
    """
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
        elif old is not None and key in ("gears", "couplings", "revolutes"):
            result[key] = _merge_lists(old, node, _identity(key))
        else:
            result[key] = node
    merged = YamlNode(result, child.place, keys)
    if problems := list(_moved_wheels(root, child, merged)):
        raise DeclarationError(problems)
    return merged


def change_declaration(declared: Train, changes: Mapping[str, Any]) -> Train:
    """Return a declaration with changed values by the rules of `extends`; unchanged values keep their line numbers."""

    def place(loc: Loc) -> str:
        return declared.place(*loc)

    merged = merge_parent(node_from_data(declared, marks=place), written_out(node_from_data(changes)))
    # a changed copy keeps name, title and note, which a child file does not inherit
    kept = {key: getattr(declared, key) for key in _NOT_INHERITED if key in declared.model_fields_set}
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
    """Merge two mappings entry by entry; null removes an entry."""
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
    """Merge two entries of the same kind; short forms are expanded first."""
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


def _identity(kind: str) -> Callable[[YamlNode], object]:
    """Return the function whose value identifies an entry of a list."""
    if kind == "revolutes":
        return lambda node: frozenset(texts(node.mapping.get("pair")))
    return _pair_name if kind == "gears" else _coupling_name


def _pair_name(node: YamlNode) -> str:
    given = node.mapping.get("id")
    return given.text if given else "~".join(texts(node.mapping.get("pair")))


def _coupling_name(node: YamlNode) -> str:
    given, pin, slot = (node.mapping.get(key) for key in ("id", "pin", "slot"))
    return given.text if given else f"{pin.text if pin else ''}~{slot.text if slot else ''}"


def _merge_lists(old: YamlNode, new: YamlNode, identity: Callable[[YamlNode], object]) -> YamlNode:
    if not isinstance(old.value, list) or not isinstance(new.value, list):
        return new
    result = list(old.value)
    at = {identity(node): position for position, node in enumerate(result)}
    for node in new.value:
        position = at.get(identity(node))
        if position is None:
            result.append(node)
        else:
            result[position] = _merge_entry(result[position], node, "list")
    return YamlNode(result, new.place)


def _apply_remove(root: YamlNode, remove: YamlNode) -> YamlNode:
    """Remove the parts named by `remove` from the parent; a link is removed with its wheels, joints, pairs and
    couplings.
    """
    # turning pairs have no names, and are removed by their two links
    gone = {key: list(texts(node)) for key, node in remove.mapping.items() if key != "revolutes"}
    joints = (
        [frozenset(texts(node)) for node in remove.mapping["revolutes"].items] if "revolutes" in remove.mapping else []
    )
    _check_known(root, remove, gone, joints)
    links = set(gone.get("links", ()))
    wheels = set(gone.get("wheels", ()))
    for link in links:
        wheels.update(_child(root, "links", link, "wheels"))
    result = dict(root.mapping)
    for key in ("outputs", "dials", "states", "axes"):
        if key in gone and key in result:
            result[key] = _drop(result[key], gone[key])
    if "links" in result:
        kept = _drop(result["links"], links)
        result["links"] = YamlNode(
            {name: _without_wheels(node, wheels) for name, node in kept.mapping.items()}, kept.place, kept.keys
        )
    pairs, couplings = set(gone.get("gears", ())), set(gone.get("couplings", ()))
    _filter(
        result,
        "revolutes",
        lambda node: (
            not links.intersection(ends := set(texts(node.mapping.get("pair")))) and frozenset(ends) not in joints
        ),
    )
    _filter(
        result,
        "gears",
        lambda node: not wheels.intersection(texts(node.mapping.get("pair"))) and _pair_name(node) not in pairs,
    )
    _filter(
        result,
        "couplings",
        lambda node: (
            not links.intersection(node.mapping[key].text for key in ("pin", "slot") if key in node.mapping)
            and _coupling_name(node) not in couplings
        ),
    )
    return YamlNode(result, root.place, root.keys)


def _child(node: YamlNode, *keys: str) -> Mapping[str, YamlNode]:
    for key in keys:
        node = node.mapping.get(key, YamlNode(None, node.place))
    return node.mapping


def _drop(node: YamlNode, names: Iterable[str]) -> YamlNode:
    gone = set(names)
    return YamlNode({name: part for name, part in node.mapping.items() if name not in gone}, node.place, node.keys)


def _without_wheels(link: YamlNode, wheels: set[str]) -> YamlNode:
    """Return a link without the wheels named in `wheels`; the link itself if it has none of them."""
    if "wheels" not in link.mapping or not wheels.intersection(link.mapping["wheels"].mapping):
        return link
    return YamlNode({**link.mapping, "wheels": _drop(link.mapping["wheels"], wheels)}, link.place, link.keys)


def _filter(result: dict[str, YamlNode], key: str, keep: Callable[[YamlNode], bool]) -> None:
    if key in result:
        result[key] = YamlNode([node for node in result[key].items if keep(node)], result[key].place)


def _check_known(root: YamlNode, remove: YamlNode, gone: Mapping[str, list[str]], joints: list[frozenset[str]]) -> None:
    known: dict[str, set[str]] = {
        key: set(_child(root, key)) for key in ("links", "outputs", "dials", "states", "axes")
    }
    known["wheels"] = {wheel for link in _child(root, "links").values() for wheel in _child(link, "wheels")}
    known["gears"] = {_pair_name(node) for node in root.mapping.get("gears", YamlNode([], "")).items}
    known["couplings"] = {_coupling_name(node) for node in root.mapping.get("couplings", YamlNode([], "")).items}
    problems = []
    for key, names in gone.items():
        for at, name in enumerate(names):
            if key in known and name not in known[key]:
                fix = suggest(name, known[key], otherwise="delete this entry")
                problems.append(
                    Problem(
                        f"`remove` names the unknown part '{name}'",
                        f"the parent has no such entry in {key}",
                        fix,
                        remove.place_of((key, at)),
                    )
                )
    present = {
        frozenset(texts(node.mapping.get("pair"))) for node in root.mapping.get("revolutes", YamlNode([], "")).items
    }
    for at, joint in enumerate(joints):
        if joint not in present:
            problems.append(
                Problem(
                    f"`remove` names an unknown turning pair of {' and '.join(sorted(joint))}",
                    "the parent does not declare it",
                    "delete this entry",
                    remove.place_of(("revolutes", at)),
                )
            )
    if problems:
        raise DeclarationError(problems)
