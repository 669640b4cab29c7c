"""Base class and field types of all declared parts."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, TypeVar

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
from pydantic_core import CoreSchema, core_schema

from geartrain.errors import DeclarationError, Problem, dotted, nearest_names
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.plain_values import whole_number
from geartrain.numerics.quantity import bad
from geartrain.numerics.results import summary_line, values_summary
from geartrain.teeth.any_tooth_form import form_names, tooth_form
from geartrain.teeth.contact_coefficients import CoulombFriction, DeclaredCoulombFriction
from geartrain.teeth.coupling import COUPLINGS, coupling_model

MOST_TEETH = 10**12

Status = Literal["surviving", "reconstructed", "hypothetical"]


ExpectedVerdict = Literal["determined", "free", "locked"]


class Declared(BaseModel):
    """Base class of all declared parts. Parts are immutable and reject unknown keys; numbers are accepted as names."""

    SHORT: ClassVar[Mapping[str, Any] | None] = None
    """JSON schema of the short form; None if the part has no short form."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", coerce_numbers_to_str=True, populate_by_name=True, defer_build=True
    )

    def __repr__(self) -> str:
        given = (name for name in type(self).model_fields if name in self.model_fields_set)
        return summary_line(type(self).__name__, values_summary(self, given))

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Return the JSON schema of the class, which also accepts the short form if the class has one."""
        return handler(schema) if cls.SHORT is None else also(dict(cls.SHORT), handler(schema))

    def changed(self, **update: Any) -> Self:
        """Return a copy of the part with changed fields; cached values are not copied.

        Parameters
        ----------
        **update : object
            New values by field name: plain values as in a declaration, or validated objects.

        Raises
        ------
        DeclarationError
            If a value is not valid. References to other parts are not checked; `GearTrain.with_changes` checks them.
        """
        given = {name: getattr(self, name) for name in self.model_fields_set}
        try:
            copy = type(self).model_validate(given | update)
        except ValidationError as error:
            raise DeclarationError(map(_replacement_problem, error.errors(include_url=False))) from None
        if self.__pydantic_private__ is not None:  # line numbers
            copy.__pydantic_private__ = dict(self.__pydantic_private__)
        return copy


DeclaredPart = TypeVar("DeclaredPart", bound=Declared)


def exactly_one(part: DeclaredPart, what: str, keys: Sequence[str], noun: str = "of its keys") -> DeclaredPart:
    """Return the part unchanged if exactly one of the keys is given; otherwise raise `PydanticCustomError`."""
    given = [key for key in keys if getattr(part, key) is not None]
    if len(given) != 1:
        found = " and ".join(given) or "nothing"
        fix = f"give exactly one of {', '.join(keys)}"
        raise bad("keys", f"{what} needs exactly one {noun}; found: {found}", fix)
    return part


def _replacement_problem(error: Mapping[str, Any]) -> Problem:
    """Return the problem to report for an invalid replacement value of a field."""
    if error["type"] == "missing":
        *parent, key = error["loc"]
        return Problem(f"key '{key}' is missing", f"`{dotted(tuple(parent))}` requires it", f"add `{key}:`")
    fix = error.get("ctx", {}).get("fix", "see docs/reference.md")
    return Problem(f"`{dotted(error['loc'])}`: {error['msg']}", f"the given value is {str(error['input'])[:60]!r}", fix)


def read_count(raw: object) -> int:
    """Read a tooth count: an integer from 1 to 10^12."""
    number = whole_number(raw, 1, MOST_TEETH)
    if number is not None:
        return number
    shown = str(raw) if len(str(raw)) <= 30 else str(raw)[:27] + "..."
    digits = re.fullmatch(r"(\d{1,12}) *[a-zA-Z]+", shown)
    fix = f"write the number only: {digits[1]}" if digits else "write a whole number from 1 to 10^12, such as 20"
    raise bad("teeth", f"'{shown}' is not a tooth count", fix)


def side(raw: object) -> object:
    """Convert the strings "1", "+1" and "-1" to integers; return other values unchanged."""
    return int(raw) if raw in ("1", "+1", "-1") else raw


def short_for(key: str) -> BeforeValidator:
    """Return a validator that replaces a value that is not a mapping by `{key: value}`, and null by `{}`."""

    def expand(raw: object) -> object:
        if raw is None:
            return {}
        return raw if isinstance(raw, dict | BaseModel) else {key: raw}

    return BeforeValidator(expand)


def also(kind: Any, schema: dict[str, Any]) -> dict[str, Any]:
    """Return a JSON schema that accepts a short form in addition to the form that the given schema describes."""
    return {"anyOf": [kind, schema]}


@dataclass(frozen=True)
class AlsoShort:
    """Annotation that adds a short form to a field and its JSON schema; the form is expanded before validation."""

    schema: Mapping[str, Any]

    def __get_pydantic_json_schema__(self, kind: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Return the JSON schema of the field in its long and its short form."""
        return also(handler(kind), dict(self.schema))


Id = Annotated[str, WithJsonSchema({"type": ["string", "number"]})]
"""Name of a part, as written. Numbers are accepted as names."""
Part = TypeVar("Part")
ByName = Annotated[dict[Id, Part], AfterValidator(FrozenDict)]
"""Immutable mapping from names to parts."""
Count = Annotated[int, BeforeValidator(read_count)]
Nothing = BeforeValidator(lambda raw: {} if raw is None else raw)
"""Validator that reads null as an empty mapping."""


@cache
def _union_reader(key: str, *names: str) -> TypeAdapter[Any]:
    """Return the validator of the named tooth forms (key `form`) or couplings (key `kind`), importing only these."""
    model = tooth_form if key == "form" else coupling_model

    class Models:
        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
            return core_schema.tagged_union_schema({name: handler.generate_schema(model(name)) for name in names}, key)

    return TypeAdapter(Models)


@cache
def friction_laws() -> TypeAdapter[Any]:
    """Return the validator of friction laws; it is imported on first use, because most trains declare numbers."""
    from geartrain.teeth.friction_law import AnyFrictionLaw

    return TypeAdapter(AnyFrictionLaw)


def read_friction(raw: object) -> Any:
    """Read Coulomb friction, given as a number or a mapping, or a friction law, given as a mapping with its keys."""
    law = isinstance(raw, Mapping) and _has_law_keys(raw)
    return (friction_laws() if law else _coulomb_friction()).validate_python(raw)


def _has_law_keys(keys: Mapping[Any, Any]) -> bool:
    """Return True if a mapping has a key like `law`, or more keys of friction laws than of Coulomb friction."""
    if any(key == "law" or nearest_names(str(key), ("law",)) for key in keys):
        return True
    if all(key in CoulombFriction.model_fields for key in keys):
        return False
    from geartrain.teeth.friction_law import law_keys

    return sum(key in law_keys() for key in keys) > sum(key in CoulombFriction.model_fields for key in keys)


def _serialize_friction(friction: Any) -> Any:
    """Return friction in the form in which it was declared, for serialization."""
    return friction.model_dump(mode="json") if isinstance(friction, BaseModel) else str(friction)


def _read_tooth_form(raw: Any) -> Any:
    """Read a tooth form from its keys or its name; an unknown name is validated against all forms, to list them."""
    keys = {"form": raw} if isinstance(raw, str) else raw
    return _read_model(keys, "form", form_names)


def _read_coupling(raw: Any) -> Any:
    """Read a coupling from its keys; a coupling with `ratio` and without `kind` is of the kind `ratio`."""
    if isinstance(raw, dict) and "ratio" in raw and "kind" not in raw:
        raw = {"kind": "ratio", **raw}
    return _read_model(raw, "kind", lambda _: COUPLINGS)


def _read_model(keys: Any, key: str, names: Callable[[Any], Iterable[str]]) -> Any:
    """Read a tooth form or coupling whose class the value of `key` selects. `names` returns the valid values."""
    name = keys.get(key) if isinstance(keys, dict) else getattr(keys, key, None)
    known = tuple(names(name))
    read = _union_reader(key, *([name] if isinstance(name, str) and name in known else known)).validate_python(keys)
    # pydantic builds only the validators of a union's members; writing a model needs its serializer
    type(read).model_rebuild()
    return read


@cache
def _coulomb_friction() -> TypeAdapter[Any]:
    return TypeAdapter(DeclaredCoulombFriction)


if TYPE_CHECKING:
    from geartrain.teeth.coupling import Coupling
    from geartrain.teeth.friction_law import FrictionLaw
    from geartrain.teeth.tooth_form import ToothForm

    DeclaredToothForm = ToothForm
    DeclaredCoupling = Coupling
    DeclaredFriction = CoulombFriction | FrictionLaw
else:

    class DeclaredFriction:
        """Friction as a field of a model: Coulomb's, or a law of speed, imported when the first is read."""

        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> CoreSchema:
            as_declared = core_schema.plain_serializer_function_ser_schema(_serialize_friction)
            return core_schema.no_info_plain_validator_function(read_friction, serialization=as_declared)

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
            names = form_names()
            return {"anyOf": [{"enum": [*names]}, handler(_union_reader("form", *names).core_schema)]}

    class DeclaredCoupling:
        """A coupling as an entry of a model. Its kind is imported when a declaration names it."""

        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> CoreSchema:
            return core_schema.no_info_plain_validator_function(_read_coupling)

        @classmethod
        def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
            return handler(_union_reader("kind", *COUPLINGS).core_schema)
