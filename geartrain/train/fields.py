"""What the declared parts share: strictness, names, short forms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    TypeAdapter,
    ValidationError,
    WithJsonSchema,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from geartrain.errors import DeclarationError, Problem, dotted, nearest_names
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.results import summary_line, values_summary
from geartrain.teeth.any_tooth_form import TOOTH_FORMS, tooth_form
from geartrain.teeth.contact_coefficients import CoulombFriction, DeclaredCoulombFriction

MOST_TEETH = 10**12

Status = Literal["surviving", "reconstructed", "hypothetical"]


ExpectedVerdict = Literal["determined", "free", "locked"]


class Declared(BaseModel):
    """What all declared parts share: frozen, no unknown keys, numbers welcome as names."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", coerce_numbers_to_str=True, populate_by_name=True, defer_build=True
    )

    def __repr__(self) -> str:
        given = (name for name in type(self).model_fields if name in self.model_fields_set)
        return summary_line(type(self).__name__, values_summary(self, given))

    def changed(self, **update: Any) -> Self:
        """A copy with other fields, which remembers nothing that was derived from the old ones.

        Parameters
        ----------
        **update : object
            Values by name of field, as a declaration has them or as they were read.

        Raises
        ------
        DeclarationError
            For what the part cannot be. References to other parts are not checked: `GearTrain.with_changes` does that.
        """
        given = {name: getattr(self, name) for name in self.model_fields_set}
        try:
            copy = type(self).model_validate(given | update)
        except ValidationError as error:
            raise DeclarationError(map(_refused, error.errors(include_url=False))) from None
        if self.__pydantic_private__ is not None:  # where it was written
            copy.__pydantic_private__ = dict(self.__pydantic_private__)
        return copy


def _refused(error: Mapping[str, Any]) -> Problem:
    """What is wrong about a value that was to replace another."""
    if error["type"] == "missing":
        *parent, key = error["loc"]
        return Problem(f"key '{key}' is missing", f"`{dotted(tuple(parent))}` needs it", f"add `{key}:`")
    fix = error.get("ctx", {}).get("fix", "see docs/reference.md")
    return Problem(f"`{dotted(error['loc'])}`: {error['msg']}", f"it is {str(error['input'])[:60]!r}", fix)


def read_count(raw: object) -> int:
    """A tooth count: a positive integer up to 10^12."""
    try:
        # True is an int of Python's; a text of thousands of digits would take minutes to read
        number = raw if type(raw) is int else int(raw) if isinstance(raw, str) and len(raw) <= 30 else None
    except ValueError:
        number = None
    if number is not None and 0 < number <= MOST_TEETH and str(raw).isascii():
        return number
    shown = str(raw) if len(str(raw)) <= 30 else str(raw)[:27] + "..."
    raise PydanticCustomError(
        "teeth",
        "{shown} is not a tooth count",
        {"shown": shown, "fix": "a tooth count is a whole number from 1 to 10^12"},
    )


def _boolean(raw: object) -> bool:
    """true or false, as YAML 1.2 writes them; `yes` and `no` are names there."""
    if isinstance(raw, bool):
        return raw
    if isinstance(raw, str) and raw.lower() in ("true", "false"):
        return raw.lower() == "true"
    raise PydanticCustomError(
        "boolean", "'{raw}' is neither true nor false", {"raw": str(raw), "fix": "write true or false"}
    )


def side(raw: object) -> object:
    """1 or -1, also from text."""
    return int(raw) if raw in ("1", "+1", "-1") else raw


def short_for(key: str) -> BeforeValidator:
    """A bare value stands for `{key: value}`; nothing stands for `{}`."""

    def expand(raw: object) -> object:
        if raw is None:
            return {}
        return raw if isinstance(raw, dict | BaseModel) else {key: raw}

    return BeforeValidator(expand)


def _empty_for_nothing(raw: object) -> object:
    return {} if raw is None else raw


def also(kind: Any, schema: dict[str, Any]) -> dict[str, Any]:
    """A JSON schema that accepts a short form too."""
    return {"anyOf": [kind, schema]}


@dataclass(frozen=True)
class AlsoShort:
    """A field whose short form is written out before it is read; for its JSON schema."""

    schema: Mapping[str, Any]

    def __get_pydantic_json_schema__(self, kind: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Either form."""
        return also(handler(kind), dict(self.schema))


Id = Annotated[str, WithJsonSchema({"type": ["string", "number"]})]
"""A name, as written: numbers are names too."""
Part = TypeVar("Part")
ByName = Annotated[dict[Id, Part], AfterValidator(FrozenDict)]
"""Parts by name, frozen."""
Count = Annotated[int, BeforeValidator(read_count)]
Boolean = Annotated[bool, BeforeValidator(_boolean)]
Nothing = BeforeValidator(_empty_for_nothing)


@cache
def _form_reader(*names: str) -> TypeAdapter[Any]:
    """Return the reader of the union of these tooth forms, which imports no other form."""

    class Forms:
        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
            forms = {name: handler.generate_schema(tooth_form(name)) for name in names}
            return core_schema.tagged_union_schema(forms, "form")

    return TypeAdapter(Forms)


@cache
def friction_laws() -> TypeAdapter[Any]:
    """The reader of all laws of friction; most trains have numbers, and import none."""
    from geartrain.teeth.friction_law import AnyFrictionLaw

    return TypeAdapter(AnyFrictionLaw)


def read_friction(raw: object) -> Any:
    """Coulomb's friction from a coefficient or its keys, or a law of speed where there are keys of one."""
    law = isinstance(raw, Mapping) and _names_a_law(raw)
    return (friction_laws() if law else _coulomb_friction()).validate_python(raw)


def _names_a_law(keys: Mapping[Any, Any]) -> bool:
    """True for `law`, and where `law` is forgotten or misspelt beside more keys of laws than of Coulomb's friction."""
    if any(key == "law" or nearest_names(str(key), ("law",)) for key in keys):
        return True
    if all(key in CoulombFriction.model_fields for key in keys):
        return False
    from geartrain.teeth.friction_law import law_keys

    return sum(key in law_keys() for key in keys) > sum(key in CoulombFriction.model_fields for key in keys)


def _tell_friction(friction: Any) -> Any:
    """As it was declared."""
    return friction.model_dump(mode="json") if isinstance(friction, BaseModel) else str(friction)


def _read_tooth_form(raw: Any) -> Any:
    """Return a tooth form from its keys, or from its name only, with default values.

    An unknown name is validated by all forms, whose error lists their names.
    """
    keys = {"form": raw} if isinstance(raw, str) else raw
    name = keys.get("form") if isinstance(keys, dict) else getattr(keys, "form", None)
    known = isinstance(name, str) and name in TOOTH_FORMS
    form = _form_reader(*([name] if known else TOOTH_FORMS)).validate_python(keys)
    # of a union, pydantic builds the members' validators only; writing a form needs its serializer
    type(form).model_rebuild()
    return form


@cache
def _coulomb_friction() -> TypeAdapter[Any]:
    return TypeAdapter(DeclaredCoulombFriction)


if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw
    from geartrain.teeth.tooth_form import ToothForm

    DeclaredToothForm = ToothForm
    DeclaredFriction = CoulombFriction | FrictionLaw
else:

    class DeclaredFriction:
        """Friction as a field of a model: Coulomb's, or a law of speed, imported when the first is read."""

        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> CoreSchema:
            told = core_schema.plain_serializer_function_ser_schema(_tell_friction)
            return core_schema.no_info_plain_validator_function(read_friction, serialization=told)

        @classmethod
        def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
            return {"anyOf": [handler(_coulomb_friction().core_schema), handler(friction_laws().core_schema)]}

    class DeclaredToothForm:
        """A tooth form, or its name, as a field of a model. A form is imported when a declaration names it."""

        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> CoreSchema:
            return core_schema.no_info_plain_validator_function(_read_tooth_form)

        @classmethod
        def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
            return {"anyOf": [{"enum": [*TOOTH_FORMS]}, handler(_form_reader(*TOOTH_FORMS).core_schema)]}
