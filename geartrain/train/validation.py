"""From raw data to a `Train`, with every problem in words a person can act on."""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import islice
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from geartrain.errors import (
    MOST_TOLD,
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
from geartrain.teeth.contact_coefficients import CoulombFriction
from geartrain.train.declaration import Train
from geartrain.train.fields import DeclaredFriction, DeclaredToothForm
from geartrain.train.references import find_problems
from geartrain.train.short_forms import has_short_forms, written_out
from geartrain.train.yaml_nodes import node_from_data


@collector_paused()
def declare(data: Mapping[str, Any], marks: Marks | None = None) -> Train:
    """A checked `Train` from plain data, the same keys as in YAML (docs/reference.md).

    Parameters
    ----------
    data : mapping of str
        The declaration. `extends` is kept as it stands; `geartrain.load` follows it.
    marks : callable, optional
        Turns the path of a value into the place it was written at; default the path itself, `gears[3].pair`.

    Returns
    -------
    Train
        Frozen; equal data give equal trains.

    Raises
    ------
    DeclarationError
        With the first problems that could be collected, each with its place.

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
    head = _head(data)
    if head is not None:  # a large file may be wrong a million times: its beginning tells
        _refuse_many(head, place)
    try:
        train = Train.model_validate(data)
    except ValidationError as error:
        raise DeclarationError(first_problems(_explained(error, place), error.error_count())) from None
    train._marks = marks
    problems = first_problems(find_problems(train))
    if problems:
        raise DeclarationError(problems)
    return train


_HEAD = 200
"""Entries of each collection that are looked at first in a large declaration."""
_LARGE = 20_000


def _head(data: Mapping[str, Any]) -> dict[str, Any] | None:
    """The first entries of each collection of a large declaration and of the collections in them; None of a small one.

    What belongs to a tooth count is kept whole: its lists are held against each other.
    """
    if sum(_size(part) for part in data.values()) < _LARGE:
        return None
    known = {key: data[key] for key in Train.model_fields if key in data}
    return {key: _first(part) for key, part in (known | dict(islice(data.items(), _HEAD))).items()}


def _size(part: Any) -> int:
    """About how many values a part holds, its longest lists counted to the second level."""
    if not isinstance(part, Mapping | list | tuple):
        return 1
    inner = part.values() if isinstance(part, Mapping) else part
    return len(part) + sum(len(value) for value in inner if isinstance(value, Mapping | list | tuple))


def _first(part: Any, key: str = "") -> Any:
    if key in ("teeth", "cutting"):
        return part
    if isinstance(part, Mapping):
        return {name: _first(value, name) for name, value in islice(part.items(), _HEAD)}
    if isinstance(part, list | tuple):
        return [_first(value) for value in islice(part, _HEAD)]
    return part


def _refuse_many(head: Mapping[str, Any], place: Marks) -> None:
    """Raise `DeclarationError` where the head of a declaration alone has more problems than are told."""
    try:
        Train.model_validate(head)
    except ValidationError as error:
        if error.error_count() > MOST_TOLD:
            raise DeclarationError(_explained(error, place)) from None


def _explained(error: ValidationError, place: Marks) -> Iterator[Problem]:
    """Every error in words; a misspelt key is one slip, though the key it should be is missing too."""
    errors = error.errors(include_url=False)
    incomplete = {item["loc"][:-1] for item in errors if item["type"] == "missing"}
    unknown = (item["loc"] for item in errors if item["type"] == "extra_forbidden" and item["loc"][:-1] in incomplete)
    misspelt = {
        (*loc[:-1], close[0])
        for loc in islice(unknown, _HEAD)
        if (close := nearest_names(str(loc[-1]), _keys_at(loc[:-1])))
    }
    return (_explain(item, place) for item in errors if item["type"] != "missing" or item["loc"] not in misspelt)


def _name(kind: Any) -> tuple[Any, ...]:
    """The names by which a union chooses a tooth form, a law or a coupling; nothing for other models."""
    field = next((kind.model_fields[key] for key in ("form", "law", "kind") if key in kind.model_fields), None)
    return get_args(field.annotation) if field else ()


@cache
def _forms() -> dict[str, type[BaseModel]]:
    """Every tooth form by the name that chooses it."""
    from geartrain.teeth.any_tooth_form import AnyToothForm

    return {name: form for form in get_args(get_args(AnyToothForm)[0]) for name in _name(form)}


@cache
def _laws() -> dict[str, type[BaseModel]]:
    """Every law of friction by the name that chooses it."""
    from geartrain.teeth.friction_law import AnyFrictionLaw

    return {name: law for law in get_args(get_args(AnyFrictionLaw)[0]) for name in _name(law)}


_SHAPES = {
    "dict_type": "a mapping of keys to values",
    "model_type": "a mapping of keys to values",
    "tuple_type": "a list in brackets",
    "list_type": "a list in brackets",
    "string_type": "a text or a number",
    "too_long": "a shorter list",
    "too_short": "a longer list",
}


def _explain(error: Mapping[str, Any], place: Marks) -> Problem:
    loc: Loc = error["loc"]
    kind, context = error["type"], error.get("ctx", {})
    key = str(loc[-1]) if loc else ""
    if kind == "extra_forbidden":
        allowed = tuple(_keys_at(loc[:-1]))
        return Problem(f"unknown key '{key}'", f"{_where(loc[:-1])} has no such key", suggest(key, allowed), place(loc))
    if kind == "missing" and isinstance(loc[-1], int):
        return Problem(
            f"{_where(loc[:-1])} is too short",
            f"entry {loc[-1] + 1} is missing",
            "write a longer list",
            place(loc[:-1]),
        )
    if kind == "missing":
        return Problem(f"key '{key}' is missing", f"{_where(loc[:-1])} needs it", f"add `{key}:`", place(loc[:-1]))
    if kind == "union_tag_invalid":
        tag, known = unknown_tag(error)
        what = f"`{tag}` is '{context['tag']}'"
        return Problem(what, f"{_where(loc)} comes in kinds", suggest(context["tag"], known), place(loc))
    if kind == "union_tag_not_found":
        tag = context["discriminator"].strip("'")
        return Problem(error["msg"], f"{_where(loc)} comes in kinds", f"add `{tag}:`", place(loc))
    what = f"{_where(loc)}: {error['msg'][0].lower()}{error['msg'][1:]}"
    if "fix" in context:
        return Problem(f"{_where(loc)}: {error['msg']}", context.get("why", ""), context["fix"], place(loc))
    shown = repr(error["input"])
    got = f"it is {shown if len(shown) <= 60 else shown[:57] + '...'}"
    if kind in _SHAPES:
        return Problem(f"{_where(loc)} is not {_SHAPES[kind]}", got, f"write {_SHAPES[kind]}", place(loc))
    if kind == "literal_error":
        return Problem(f"{_where(loc)} is none of the words known here", got, f"use {context['expected']}", place(loc))
    return Problem(what, got, "see `geartrain schema`", place(loc))


def unknown_tag(error: Mapping[str, Any]) -> tuple[str, tuple[str, ...]]:
    """The key by which a union chooses, and all that it may be, of an error that knows no such kind."""
    context = error["ctx"]
    return context["discriminator"].strip("'"), tuple(context["expected_tags"].replace("'", "").split(", "))


def _where(loc: Loc) -> str:
    return f"`{dotted(_real_steps(loc))}`" if loc else "the declaration"


def _real_steps(loc: Loc) -> Loc:
    """`loc` without the tags pydantic adds for unions, which are not in the file."""
    tags = {"count", "doubt", "pin_and_slot", "pin_follower", "pins_in_holes", "parallel", *_forms(), *_laws()}
    return tuple(
        step
        for at, step in enumerate(loc)
        if not (
            (step in tags and at > 0 and loc[at - 1] in ("teeth", "tooth_form", "friction"))
            or (step in tags and at > 1 and loc[at - 2] == "couplings")
        )
    )


def _keys_at(loc: Loc) -> Iterator[str]:
    """The keys a declaration may have at `loc`, found by walking the models."""
    kinds: list[Any] = [Train]
    for step in loc:
        named = [kind for kind in kinds if step in _name(kind)]
        kinds = named or [after for kind in kinds for after in _step(kind, step)]
    for kind in kinds:
        for name, field in kind.model_fields.items():
            yield field.alias or name


def _step(kind: Any, step: str | int) -> Iterator[Any]:
    """The models below `kind` after one step; a union's tag stays where it is."""
    if isinstance(step, str) and step in kind.model_fields:
        yield from _models_in(kind.model_fields[step].annotation)
    else:
        yield kind


def _models_in(annotation: Any) -> Iterator[Any]:
    if annotation is DeclaredToothForm:
        yield from _forms().values()
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
