"""Conjugate tooth forms as options give them: the options of each, the pair of wheels, and what is wrong with them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args, get_origin

from geartrain.cli.option_values import at_option, quantity
from geartrain.errors import GearTrainError, Problem, suggest
from geartrain.teeth.any_tooth_form import conjugate_forms, tooth_forms

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

    from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.wheel_pair import WheelPair
    from geartrain.teeth.tooth_form import ToothForm

FormOptions = dict[str, str | bool | None]


def _readings(form: str) -> Iterator[str]:
    """The names under which each reading of a form can be compared, for forms that have several."""
    field = tooth_forms()[form].model_fields.get("reading")
    return (f"{form}_{reading}" for reading in (get_args(field.annotation) if field else ()))


CONJUGATE = conjugate_forms()
"""Forms with a path of contact, whose pages show its costs; others are told of by what their mesh says of itself."""

NAMES = tuple(name for form in CONJUGATE for name in (form, *_readings(form)))
"""Forms that can be compared; the readings of uniform temperature stand on their own."""

_MIXED = "a ring's axis is parallel to its pinion's"


@dataclass(frozen=True)
class ConjugateOptions:
    """The wheels that all forms are asked about; angles in rad, the module in m, backlash as written."""

    z1: int
    z2: int
    internal: bool = False
    shaft_angle: float | None = None
    module: float | None = None
    backlash: str | None = None

    @property
    def wheels(self) -> WheelPair:
        """As the forms take them. Raises `GearTrainError` where they are no pair."""
        from geartrain.teeth.conjugate.wheel_pair import WheelPair

        found = WheelPair(self.z1, self.z2, self.internal, self.shaft_angle, self.module)
        try:
            found.check()
        except GearTrainError as error:
            raise at_option(error, "--teeth") from None
        return found


def read_module(module: str | None) -> float | None:
    """The module (m), None if not given. Raises `GearTrainError`."""
    size = None if module is None else quantity("--module", module, "length")
    if size is not None and size <= 0:
        raise GearTrainError(Problem(f"a module of {module} is no size", "", "give a module above 0", "--module"))
    return size


def read_wheels(
    teeth: tuple[int, int],
    internal: bool = False,
    bevel: str | None = None,
    module: str | None = None,
    backlash: str | None = None,
) -> ConjugateOptions:
    """From the options. Raises `GearTrainError`."""
    if internal and bevel is not None:
        raise GearTrainError(Problem("a ring is no bevel wheel", _MIXED, "give --internal or --bevel", "--bevel"))
    angle = None if bevel is None else quantity("--bevel", bevel, "angle")
    size = read_module(module)
    if backlash is not None and quantity("--backlash", backlash, "length", plain=True) and size is None:
        _plain(backlash)
    asked = ConjugateOptions(*teeth, internal, angle, size, backlash)
    _ = asked.wheels
    return asked


def _plain(backlash: str) -> None:
    from geartrain.numerics.quantity import Quantity

    if Quantity.parse(backlash, "length", True).unit is not None:
        why = "forms are in modules, and nothing says how long one is"
        fix = "give for example --module 2mm, or the backlash as a plain number of modules"
        raise GearTrainError(Problem(f"a backlash of {backlash} has nothing to be compared with", why, fix, "--module"))


def own_options(form: str) -> dict[str, tuple[type, str]]:
    """The options of a form by the names of its fields: of which type, and what the field says of itself.

    Of forms that keep their design at any distance there is none for the distance; play is an option of all.
    """
    fields = form_model(form).model_fields
    common = {"form", "backlash"} | (set() if form_model(form).any_distance else {"centre_distance"})
    return {name: _option(field) for name, field in fields.items() if name not in common}


def _option(field: FieldInfo) -> tuple[type, str]:
    text = field.description or ""
    if isinstance(field.default, bool):
        return bool, f"{text}."
    if field.default is not None and not field.is_required():
        text += f"; default {field.default}"
    if _is_pair(field.annotation) and "two" not in text:
        text += "; two with a comma"
    return str, f"{text}."


def _is_pair(annotation: Any) -> bool:
    return get_origin(annotation) is tuple or any(map(_is_pair, get_args(annotation)))


def read_form(form: str, given: FormOptions, backlash: str | None = None) -> ConjugateToothForm:
    """The conjugate form with the options given. Raises `GearTrainError` for options it cannot have."""
    from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm

    found = read_any_form(form, given, backlash)
    assert isinstance(found, ConjugateToothForm)
    return found


def read_any_form(form: str, given: FormOptions, backlash: str | None = None) -> ToothForm:
    """The tooth form with the options given. Raises `GearTrainError` for options it cannot have."""
    from pydantic import ValidationError

    fields = form_model(form).model_fields
    data = {name: _value(fields[name], value) for name, value in given.items() if value is not None}
    if backlash is not None:
        data["backlash"] = backlash
    try:
        return form_model(form).model_validate({"form": form, **data})
    except ValidationError as error:
        problems = (_problem(item, form) for item in error.errors(include_url=False))
        raise GearTrainError(dict.fromkeys(problems)) from None


def pair(form: ConjugateToothForm, asked: ConjugateOptions) -> ConjugatePair:
    """The pair of wheels with this form. Raises `GearTrainError` where the form gives none."""
    from geartrain.teeth.conjugate.conjugate_form import conjugate_pair_of

    try:
        return conjugate_pair_of(form, asked.wheels)
    except GearTrainError as error:
        raise at_option(error, "--teeth") from None


def _value(field: FieldInfo, given: str | bool) -> Any:
    """What an option says, as a declaration would: a list where there is a comma, a number where one can be chosen."""
    if isinstance(given, bool):
        return given
    if given.isdigit() and int(given) in get_args(field.annotation):
        return int(given)
    return [part.strip() for part in given.split(",")] if "," in given else given


def form_model(form: str) -> type[ToothForm]:
    """The tooth form of this name."""
    return tooth_forms()[form]


def form_names() -> tuple[str, ...]:
    """Forms that `geartrain mesh` has no command of its own for, as the union lists them."""
    return tuple(name for name in tooth_forms() if name not in ("ideal", "triangular"))


def _problem(item: Any, form: str) -> Problem:
    context = item.get("ctx") or {}
    loc = [str(step) for step in item["loc"]]
    name = loc[0] if loc else item["type"] if item["type"] in own_options(form) else ""
    fix = str(context.get("fix") or f"see geartrain mesh {form} --help")
    what = item["msg"] if "fix" in context else f"'{item['input']}' does not fit here"
    place = f"--{name.replace('_', '-')}" if name else f"mesh {form}"
    return Problem(what, "", fix, place)


def unknown_form(name: str) -> GearTrainError:
    """A form nobody has heard of."""
    fix = suggest(name, NAMES, otherwise=f"use some of: {', '.join(NAMES)}", wide=True)
    return GearTrainError(Problem(f"there is no tooth form '{name}' to compare", "", fix, "--forms"))
