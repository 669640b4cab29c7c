"""A declaration with other inputs or other teeth, checked like one that was read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import TypeAdapter, ValidationError

from geartrain.errors import DeclarationError, Problem, check_choice, first_problems
from geartrain.numerics.quantity import Speed
from geartrain.train import Train
from geartrain.train.fields import ByName, tooth_forms
from geartrain.train.references import find_problems

_SPEEDS: TypeAdapter[Any] = TypeAdapter(ByName[Speed])


def with_inputs(declared: Train, inputs: Mapping[str, Any]) -> Train:
    """Driven at other speeds, or elsewhere; states that declare inputs keep theirs."""
    return _checked(declared.changed(inputs=_read(_SPEEDS, dict(inputs), "inputs")))


def with_tooth_form(declared: Train, form: str | Mapping[str, Any], pair: str | None) -> Train:
    """With another form of teeth, of all pairs that declare none, or of one pair."""
    read = _read(tooth_forms(), {"form": form} if isinstance(form, str) else dict(form), "tooth_form")
    if pair is None:
        return _checked(declared.changed(tooth_form=read))
    check_choice("pair", pair, [gear.name for gear in declared.gears])
    gears = (each.changed(tooth_form=read) if each.name == pair else each for each in declared.gears)
    return _checked(declared.changed(gears=tuple(gears)))


def _read(kind: TypeAdapter[Any], data: Any, where: str) -> Any:
    try:
        return kind.validate_python(data)
    except ValidationError as error:
        why = "; ".join(str(each["msg"]) for each in error.errors())
        raise DeclarationError(Problem(f"`{where}` cannot be {data}", why, "see docs/reference.md")) from None


def _checked(train: Train) -> Train:
    problems = first_problems(find_problems(train))
    if problems:
        raise DeclarationError(problems)
    return train
