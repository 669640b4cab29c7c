"""Base class of tooth forms, whose method `mesh` returns the mesh of two wheels, and types of their fields."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.quantity import Angle, Figure, Length, PairDamping, PairStiffness, Quantity, bad
from geartrain.numerics.results import summary_line, values_summary

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.pair_results import PairFigures

IDEAL = "give this pair `tooth_form: {form: ideal}`"

ShaftAngle = Callable[[], float | None]
"""Function that returns the shaft angle of a pair [rad], or None for parallel axes."""


def twice(raw: object) -> object:
    """Return a pair of two equal values if `raw` is a single value. A pair is returned unchanged."""
    return raw if isinstance(raw, list | tuple) else (raw, raw)


def number_of_wheel(raw: object) -> object:
    """Convert `raw` from "1" or "2" to a number, because declarations name the two wheels of a pair by such texts."""
    return int(raw) if raw in ("1", "2") else raw


def _schema(kind: str) -> WithJsonSchema:
    one = {"type": ["number", "string"]} if kind == "number" else {"type": ["string", "number"]}
    return WithJsonSchema({"anyOf": [one, {"type": "array", "items": one, "minItems": 2, "maxItems": 2}]})


TwoFigures = Annotated[tuple[Figure, Figure], BeforeValidator(twice), _schema("number")]
"""Field type of one number for both wheels, or a list of two numbers."""

TwoLengths = Annotated[tuple[Length, Length], BeforeValidator(twice), _schema("length")]
"""Field type of one length for both wheels, or a list of two lengths. Numbers without a unit are in modules."""

TwoAngles = Annotated[tuple[Angle, Angle], BeforeValidator(twice), _schema("angle")]
"""Field type of one angle for both wheels, or a list of two angles."""


class ToothForm(BaseModel, ABC):
    """Declared tooth form of a gear pair. Its method `mesh` returns the gear mesh of two wheels.

    See Also
    --------
    geartrain.teeth.GearMesh : the mesh.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    has_shape: ClassVar[bool] = True
    """True if the tooth form defines the shape of the teeth; False if standard teeth are cut and drawn instead."""

    any_distance: ClassVar[bool] = False
    """True if the teeth run at any centre distance, False if they run only at the design distance."""

    conjugate: ClassVar[bool] = False
    """True if the teeth are designed from a path of contact, which is also possible for ring gears and bevel wheels.

    Such a tooth form does not prescribe the roots of the teeth.
    """

    more_contact: ClassVar[str] = "declare longer `arcs`"
    """Part of a message that states how to increase the contact ratio."""

    ringed: ClassVar[bool] = False
    """True if the second wheel must be a ring gear."""

    own_play: ClassVar[tuple[str, ...]] = ()
    """Names of the fields that, if declared, determine the backlash."""

    in_time: ClassVar[tuple[str, ...]] = ("stiffness", "damping")
    """Names of the fields that do not affect the shape of the teeth: stiffness and damping for dynamic simulations."""

    if TYPE_CHECKING:
        form: str

    stiffness: PairStiffness | None = Field(
        None,
        description="Mesh stiffness of pairs that declare none: torque on the driven wheel per radian of deflection, "
        "or force along the line of action per length",
    )
    damping: PairDamping | None = Field(
        None,
        description="Mesh damping of pairs that declare none: torque on the driven wheel per angular speed, or force "
        "along the line of action per speed",
    )

    def __repr__(self) -> str:
        given = (name for name in type(self).model_fields if name in self.model_fields_set and name != "form")
        return summary_line(type(self).__name__, values_summary(self, given))

    @classmethod
    def declared(cls, parameters: Mapping[str, object]) -> Self:
        """Return a tooth form with the given declared parameters.

        Parameters
        ----------
        parameters : mapping
            Parameters as a declaration writes them, without `form`.

        Raises
        ------
        GearTrainError
            If a parameter is invalid. The place of each problem is the name of the parameter, if only one is at fault.
        """
        (form,) = get_args(cls.model_fields["form"].annotation)
        try:
            return cls.model_validate({"form": form, **parameters})
        except ValidationError as error:
            # one invalid value given for both wheels is reported once
            raise GearTrainError(dict.fromkeys(map(cls._problem, error.errors(include_url=False)))) from None

    @classmethod
    def _problem(cls, item: Any) -> Problem:
        """Return the pydantic validation error `item` as a problem, with the remedy if the tooth form gives one."""
        context = item.get("ctx") or {}
        # errors of a whole model have no location; their type may be the name of the field
        place = item["loc"][0] if item["loc"] else item["type"] if item["type"] in cls.model_fields else ""
        what = item["msg"] if "fix" in context else f"'{item['input']}' is not a valid value"
        return Problem(what, "", str(context.get("fix", "")), str(place))

    @classmethod
    def with_defaults(cls, parameters: Mapping[str, Any]) -> dict[str, Any]:
        """Return the parameters, supplemented by a default for each missing parameter that the form requires.

        Parameters
        ----------
        parameters : mapping
            Parameters as a declaration writes them, without `form`.
        """
        return dict(parameters)

    @property
    def words(self) -> str:
        """Name of the tooth form as it is written in sentences."""
        return self.form.replace("_", " ")

    @abstractmethod
    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh | None:
        """Return the mesh of a gear pair. The first wheel of the pair drives.

        Parameters
        ----------
        wheels : MeshingWheels
            The two wheels as declared.
        shaft_angle : callable
            Function that returns the shaft angle [rad], or None for parallel axes. It is called only if it is needed.

        Returns
        -------
        GearMesh or None
            Mesh; None for teeth that are completely described by the ratio.

        Raises
        ------
        GearTrainError
            If these wheels cannot have such teeth. The error does not name the pair or its place.
        """

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """Return the class of the results of a mesh with this tooth form, from which the JSON schema is generated."""
        from geartrain.teeth.pair_results import PairFigures

        return PairFigures

    @property
    def has_lengths(self) -> bool:
        """True if the tooth form declares a length with a unit."""
        return False

    @property
    def rack_angle(self) -> float | None:
        """Pressure angle of the rack that generates these teeth [rad]; None if no rack does."""
        return None

    def own_backlash(self, pair: str) -> Problem | None:
        """Return the reason why the backlash given by the manufacturing options does not apply to this pair.

        Parameters
        ----------
        pair : str
            Name of the pair, for the message.

        Returns
        -------
        Problem or None
            None if the backlash can be applied.
        """
        for name in self.own_play:
            # a default value is not a declaration, and --backlash may replace it
            given = getattr(self, name) if name in self.model_fields_set else None
            if given is not None:
                text = " and ".join(each.text for each in given) if isinstance(given, tuple) else given.text
                why = f"its declared {name} {text} takes precedence over --backlash"
                fix = f"omit --backlash, or remove `{name}` from the file"
                return Problem(f"pair '{pair}' declares its own {name}", why, fix)
        return None

    def thinned(self, backlash: Quantity) -> Self:
        """Return a copy of the tooth form with the given backlash, or the tooth form itself if it has no parameter for
        backlash.

        Parameters
        ----------
        backlash : Quantity
            Backlash on the pitch circle, in modules or with a unit.

        Returns
        -------
        ToothForm
            Copy with this backlash, or this form unchanged.
        """
        return self.model_copy(update={"backlash": backlash}) if "backlash" in self.own_play else self


def check_above_0(form: BaseModel, kind: str, *names: str) -> None:
    """Raise a validation error if a named field has a value that is not above 0; `kind` is the type of this error."""
    for name in names:
        given = getattr(form, name)
        for value in given if isinstance(given, tuple) else (given,):
            if value is not None and value.value <= 0:
                raise bad(kind, f"{name} must be greater than 0, not {value.text}", "give a value above 0")


def check_one_of(form: BaseModel, kind: str, first: str, second: str) -> None:
    """Raise a validation error if both fields, `first` and `second`, are given; `kind` is the type of this error."""
    if all(name in form.model_fields_set and getattr(form, name) is not None for name in (first, second)):
        raise bad(
            kind, f"{first} and {second} are both given", f"remove `{first}` or `{second}`: each determines the other"
        )


def in_modules(length: Quantity, module: float | None, name: str) -> float:
    """Convert a declared length to modules. A number without a unit is already in modules.

    `name` is the name of the field in error messages. Raises `GearTrainError` if the length has a unit and the module
    [m] is unknown.
    """
    if length.unit is None or not length.value:
        return float(length.value)
    if module is None:
        raise refused(
            f"the {name} {length.text} cannot be converted to modules",
            "the wheels declare no module with a unit",
            f"give the `module` of both wheels (option --module), or the {name} as a number of modules",
        )
    return length.si / module


def refused(what: str, why: str, fix: str) -> GearTrainError:
    """Return the error that wheels cannot have teeth of a tooth form: the fault, its reason and its remedy."""
    return GearTrainError(Problem(what, why, fix))
