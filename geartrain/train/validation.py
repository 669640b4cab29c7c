"""Validation of plain data as a `Train`: short forms are expanded, and each problem is reported with place, cause and
fix.

`revolutes: {main: [frame, sun, carrier]}`, and `slides` likewise: on each axis, the first link carries the other links.
`gears: [s ~ p]`: a pair of two wheels.
`belts: [p ~ q]`: a coupling of kind belt around two wheels.
"""

from __future__ import annotations

import re
import types
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import chain, islice
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from geartrain.errors import (
    DeclarationError,
    Loc,
    Marks,
    Problem,
    dotted,
    first_problems,
    nearest_names,
    suggest,
)
from geartrain.numerics.containers import collector_paused
from geartrain.teeth.any_tooth_form import form_names, tooth_forms
from geartrain.teeth.contact_coefficients import CoulombFriction
from geartrain.teeth.coupling import COUPLINGS, coupling_model
from geartrain.train.declaration import Train
from geartrain.train.fields import DeclaredCoupling, DeclaredFriction, DeclaredToothForm
from geartrain.train.mechanism import GearPair, Link, Wheel
from geartrain.train.outputs import Output
from geartrain.train.references import find_problems
from geartrain.train.states import State
from geartrain.train.yaml_nodes import YamlNode, node_from_data, texts


@collector_paused()
def declare(data: Mapping[str, Any], marks: Marks | None = None) -> Train:
    """Build a validated `Train` from plain data with the same keys as in YAML (docs/reference.md).

    Parameters
    ----------
    data : mapping of str
        Declaration. `extends` is preserved but not resolved; `geartrain.load` resolves it.
    marks : callable, optional
        Function that takes the path of a value and returns the location where it was written; by default the path, such
        as `gears[3].pair`.

    Returns
    -------
    Train
        Immutable declaration; equal data give equal trains.

    Raises
    ------
    DeclarationError
        If the data are not valid. The message reports the first problems, each with its location.

    Examples
    --------
    >>> train = declare({
    ...     "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}})
    >>> train.gears[0].name, train.wheels["w"][0], train.case(None).inputs
    ('p~w', 'b', {'a': Fraction(1, 1)})
    """
    if has_short_forms(data):
        node = written_out(node_from_data(data))
        data, marks = node.plain(), marks or node.place_of
    place = marks or dotted
    try:
        train = Train.model_validate(data)
    except ValidationError as error:
        raise DeclarationError(first_problems(_problems_of(error, place), error.error_count())) from None
    train._marks = marks
    problems = first_problems(find_problems(train))
    if problems:
        raise DeclarationError(problems)
    return train


_BLOCKS: dict[str, type[BaseModel]] = {
    "the train": Train,
    "a wheel": Wheel,
    "a link": Link,
    "a gear pair": GearPair,
    "an output": Output,
    "a state": State,
}
"""Models of the blocks of a declaration in which an unknown key may belong, by their description in messages."""
_LOOKED_UP = 200  # unknown keys for which similar keys are searched


def _problems_of(error: ValidationError, place: Marks) -> Iterator[Problem]:
    """Yield a problem for each validation error. A misspelt key is reported once, not also as a missing key."""
    errors = error.errors(include_url=False)
    incomplete = {item["loc"][:-1] for item in errors if item["type"] == "missing"}
    unknown = (item["loc"] for item in errors if item["type"] == "extra_forbidden" and item["loc"][:-1] in incomplete)
    misspelt = {
        (*loc[:-1], close[0])
        for loc in islice(unknown, _LOOKED_UP)
        if (close := nearest_names(str(loc[-1]), _keys_at(loc[:-1])))
    }
    return (_problem_of(item, place) for item in errors if item["type"] != "missing" or item["loc"] not in misspelt)


def _union_tags(kind: Any) -> tuple[Any, ...]:
    """Return the values of `form`, `law` or `kind` that select the class of a model; empty for other models."""
    field = next((kind.model_fields[key] for key in ("form", "law", "kind") if key in kind.model_fields), None)
    return get_args(field.annotation) if field else ()


@cache
def _laws() -> dict[str, type[BaseModel]]:
    """Return the class of each friction law by its tag, which is the value of `law`."""
    from geartrain.teeth.friction_law import AnyFrictionLaw

    return {name: law for law in get_args(get_args(AnyFrictionLaw)[0]) for name in _union_tags(law)}


_SHAPES: dict[str, tuple[str, type]] = {
    "dict_type": ("a mapping of keys to values", dict),
    "model_type": ("a mapping of keys to values", dict),
    "tuple_type": ("a list in brackets", list),
    "list_type": ("a list in brackets", list),
    "string_type": ("a string or a number", str),
    "too_long": ("a shorter list", list),
    "too_short": ("a longer list", list),
}


def _problem_of(error: Mapping[str, Any], place: Marks) -> Problem:
    loc: Loc = error["loc"]
    kind, context = error["type"], error.get("ctx", {})
    key = str(loc[-1]) if loc else ""
    # YAML reads `key:value` without a space as a single key
    if kind in ("extra_forbidden", "missing") and (joined := _without_space(loc, error["input"])):
        fix = f"write `{joined.replace(':', ': ', 1)}`"
        what, why = f"no space after the colon in `{joined}`", "without a space the colon is part of the key"
        return Problem(what, why, fix, place(loc))
    if kind == "extra_forbidden":
        allowed = tuple(_keys_at(loc[:-1]))
        homes = [block for block, model in _BLOCKS.items() if key in model.model_fields and key not in allowed]
        fix = suggest(key, allowed, otherwise=f"`{key}` is a key of {' or of '.join(homes)}" if homes else "")
        if key == "teeth" and "wheels" in allowed:
            fix = f"write `{loc[-2]}: {{wheels: {{w: {error['input']}}}}}`: teeth belong to a wheel, here named w"
        return Problem(
            f"unknown key '{key}'",
            f"{_where(loc[:-1])} accepts only known keys, so that a misspelt key is not ignored",
            fix,
            place(loc),
        )
    if kind == "missing" and isinstance(loc[-1], int):
        what, why = f"{_where(loc[:-1])} is too short", f"entry {loc[-1] + 1} is missing"
        return Problem(what, why, "add the missing entry", place(loc[:-1]))
    if kind == "missing":
        fix = f"add `{_wheel_pair(error['input'])}`" if _is_wheel_pair(loc) else f"add `{key}:`"
        return Problem(f"key '{key}' is missing", f"{_where(loc[:-1])} requires it", fix, place(loc[:-1]))
    if kind == "union_tag_invalid":
        tag, known = unknown_tag(error)
        what = f"`{tag}` has the unknown value '{context['tag']}'"
        return Problem(what, f"`{tag}` selects the kind of {_where(loc)}", suggest(context["tag"], known), place(loc))
    if kind == "union_tag_not_found":
        tag = context["discriminator"].strip("'")
        return Problem(f"key '{tag}' is missing", f"it selects the kind of {_where(loc)}", f"add `{tag}:`", place(loc))
    if "fix" in context:
        return Problem(f"{_where(loc)}: {error['msg']}", context.get("why", ""), context["fix"], place(loc))
    shown = repr(error["input"])
    got = f"the given value is {shown if len(shown) <= 60 else shown[:57] + '...'}"
    if kind in _SHAPES:
        from geartrain.train.examples import example_line  # reads a file, needed for errors only

        shape, of = _SHAPES[kind]
        line = _wheel_pair(error["input"]) if _is_wheel_pair(loc) else example_line(loc, of)
        fix = f"for example, write `{line}`" if line else f"write {shape}"
        return Problem(f"{_where(loc)} is not {shape}", got, fix, place(loc))
    if kind == "literal_error":
        return Problem(f"{_where(loc)} is not one of the allowed values", got, f"use {context['expected']}", place(loc))
    what = f"{_where(loc)}: {error['msg'][0].lower()}{error['msg'][1:]}"
    return Problem(what, got, "see `geartrain inspect schema`", place(loc))


def _is_wheel_pair(loc: Loc) -> bool:
    return len(loc) == 3 and loc[0] == "gears" and loc[2] == "pair"


def _wheel_pair(raw: Any) -> str:
    """Return a line such as `pair: [first, second]` as a fix, given text or an id such as `first ~ second`."""
    text = raw.get("id") if isinstance(raw, dict) else raw
    wheels = _wheels(text) if isinstance(text, str) else []
    return f"pair: [{', '.join(wheels if len(wheels) == 2 and all(wheels) else ('sun', 'planet'))}]"


def _without_space(loc: Loc, value: Any) -> str:
    """Return the first key in a path that probably lacks a space after its colon (`a:b`); "" if there is none."""
    for at, step in enumerate(loc):
        start, colon, _ = str(step).partition(":")
        if colon and (value is None or isinstance(value, dict) or start in _keys_at(loc[:at])):
            return str(step)
    return ""


def unknown_tag(error: Mapping[str, Any]) -> tuple[str, tuple[str, ...]]:
    """Return the key that selects a model, and its allowed values, from a pydantic error about an unknown value."""
    context = error["ctx"]
    return context["discriminator"].strip("'"), tuple(context["expected_tags"].replace("'", "").split(", "))


def _where(loc: Loc) -> str:
    """Return the path of a value, without the tags that pydantic inserts for unions, which do not occur in the file."""
    if not loc:
        return "the declaration"
    tags = {"count", "doubt", *COUPLINGS, *form_names(), *_laws()}

    def is_inserted(at: int) -> bool:
        after_union = at > 0 and loc[at - 1] in ("teeth", "tooth_form", "friction")
        return loc[at] in tags and (after_union or (at > 1 and loc[at - 2] == "couplings"))

    return f"`{dotted(tuple(step for at, step in enumerate(loc) if not is_inserted(at)))}`"


def _keys_at(loc: Loc) -> Iterator[str]:
    """Yield the keys that a declaration may have at the path `loc`, found by traversing the models."""
    kinds: list[Any] = [Train]
    for step in loc:
        named = [kind for kind in kinds if step in _union_tags(kind)]
        kinds = named or [after for kind in kinds for after in _step(kind, step)]
    for kind in kinds:
        for name, field in kind.model_fields.items():
            yield field.alias or name


def _step(kind: Any, step: str | int) -> Iterator[Any]:
    """Yield the models that a step of a path reaches from the model `kind`; a tag of a union reaches `kind` itself."""
    if isinstance(step, str) and step in kind.model_fields:
        yield from _models_in(kind.model_fields[step].annotation)
    else:
        yield kind


def _models_in(annotation: Any) -> Iterator[Any]:
    if annotation is DeclaredToothForm:
        yield from tooth_forms().values()
    elif annotation is DeclaredCoupling:
        yield from map(coupling_model, COUPLINGS)
    elif annotation is DeclaredFriction:
        yield CoulombFriction
        yield from _laws().values()
    elif isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    elif get_origin(annotation) is Annotated:
        yield from _models_in(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, types.UnionType, dict, tuple):
        for inner in get_args(annotation):
            yield from _models_in(inner)


# ------------------------------------------------------------------------------------------------------- short forms

JOINTS = ("revolutes", "slides")
"""Keys with a short form in which the first link on each axis carries the other links."""
_MARK = "~"
"""Separator of the two wheels in the short form of a gear pair."""


def has_short_forms(data: Mapping[str, Any]) -> bool:
    """Return True if plain data contain short forms, or bare lists in which pairs are expected."""
    listed = (data[key] for key in ("gears", *JOINTS) if isinstance(data.get(key), list | tuple))
    pairs = (each for parts in listed for each in parts)
    short = any(isinstance(data.get(key), Mapping) for key in JOINTS) or bool(data.get("belts"))
    return short or any(isinstance(each, str | list | tuple) for each in pairs)


def written_out(root: YamlNode) -> YamlNode:
    """Return the root of a declaration with expanded short forms; raise `DeclarationError` for invalid ones."""
    joints = {key: root.mapping[key] for key in JOINTS if key in root.mapping}
    gears = root.mapping.get("gears")
    short_joints = {key: each for key, each in joints.items() if isinstance(each.value, dict)}
    short_gears = [each for each in gears.items if isinstance(each.value, str)] if gears is not None else []
    _check_short_forms(joints, gears, short_joints, short_gears)
    root = _with_belts(root)
    changed = {key: YamlNode(list(_joints(each)), each.place) for key, each in short_joints.items()}
    if gears is not None and short_gears:
        pairs = [_pair(each) if isinstance(each.value, str) else each for each in gears.items]
        changed["gears"] = YamlNode(pairs, gears.place)
    return YamlNode({**root.mapping, **changed}, root.place, root.keys) if changed else root


def _with_belts(root: YamlNode) -> YamlNode:
    """Return the declaration with its `belts` as couplings; raise `DeclarationError` for a belt that is not `a ~ b`."""
    belts = root.mapping.get("belts")
    if belts is None or not belts.items:
        return root
    wrong = [each for each in belts.items if not isinstance(each.value, str) or len(_wheels(each.value)) != 2]
    if wrong:
        problems = (_invalid_pair(each, "belt", "p ~ q") for each in wrong)
        raise DeclarationError(first_problems(problems, len(wrong)))
    couplings = root.mapping.get("couplings", YamlNode([], belts.place))
    if not isinstance(couplings.value, list):
        return root  # validation reports it
    added = []
    for belt in belts.items:
        parts = {"kind": YamlNode("belt", belt.place), "around": _pair(belt).mapping["pair"]}
        added.append(YamlNode(parts, belt.place, dict.fromkeys(parts, belt.place)))
    rest = {key: node for key, node in root.mapping.items() if key != "belts"}
    merged = {**rest, "couplings": YamlNode([*couplings.items, *added], couplings.place)}
    return YamlNode(merged, root.place, {"couplings": belts.place, **root.keys})


def _check_short_forms(
    joints: Mapping[str, YamlNode],
    gears: YamlNode | None,
    short_joints: Mapping[str, YamlNode],
    short_gears: list[YamlNode],
) -> None:
    """Raise `DeclarationError` if a pair is a bare list, or if a short form has too few or too many elements."""
    lists = [*_lists("gears", gears, "{} ~ {}")]
    lists += [each for key, part in joints.items() for each in _lists(key, part, "{{pair: [{}, {}], axis: A}}")]
    wrong = [gear for gear in short_gears if len(names := _wheels(gear.value)) != 2 or not all(names)]
    for joint in short_joints.values():
        for axis in (axis for axis, links in joint.mapping.items() if len(links.items) < 2):
            why = "the first link of its list carries the other links"
            fix = f"for example, write `{axis}: [frame, arbor]`"
            place = joint.keys.get(axis, joint.place)
            lists.append(Problem(f"axis '{axis}' has fewer than two links", why, fix, place))
    if len(wrong) == 2 == len(short_gears) and all(_MARK not in gear.value for gear in wrong):  # gears: [a, b]
        raise DeclarationError(_invalid_pair(YamlNode(" ".join(gear.value for gear in wrong), wrong[0].place)))
    if lists or wrong:  # texts are composed only for the problems that are shown
        raise DeclarationError(first_problems(chain(lists, map(_invalid_pair, wrong)), len(lists) + len(wrong)))


def _lists(key: str, parts: YamlNode | None, form: str) -> Iterator[Problem]:
    """Yield one problem that covers all entries of a section that are written as bare lists."""
    listed = [part for part in parts.items if isinstance(part.value, list)] if parts is not None else []
    if listed:
        names = [*texts(listed[0]), "a", "b"][:2]
        several = len(listed) > 1
        what = f"{len(listed)} entries of `{key}` are lists" if several else f"an entry of `{key}` is a list"
        fix = f"write `{form.format(*names)}`" + (", and the other entries likewise" if several else "")
        yield Problem(what, f"each entry has the form `{form.format('a', 'b')}`", fix, listed[0].place)


def _joints(joints: YamlNode) -> Iterator[YamlNode]:
    for axis, links in joints.mapping.items():
        place = joints.keys.get(axis, joints.place)
        first, *others = links.items
        for other in others:
            parts = {"pair": YamlNode([first, other], other.place), "axis": YamlNode(axis, place)}
            yield YamlNode(parts, other.place, dict.fromkeys(parts, other.place))


def _wheels(text: str) -> list[str]:
    return [name.strip() for name in text.split(_MARK)]


def _invalid_pair(pair: YamlNode, noun: str = "gear pair", example: str = "sun ~ planet") -> Problem:
    text = pair.value if isinstance(pair.value, str) else " ".join(texts(pair))
    # separators that are written by mistake instead of a tilde
    names = re.split(r"\s*[-,/]\s*|\s+", text.strip())
    fix = f"write `{' ~ '.join(names)}`" if len(names) == 2 and all(names) else f"for example, write `{example}`"
    why = f"a {noun.removeprefix('gear ')} is written as two wheels separated by a tilde"
    return Problem(f"'{text}' is not a {noun}", why, fix, pair.place)


def _pair(gear: YamlNode) -> YamlNode:
    wheels = YamlNode([YamlNode(name, gear.place) for name in _wheels(gear.value)], gear.place)
    return YamlNode({"pair": wheels}, gear.place, {"pair": gear.place})
