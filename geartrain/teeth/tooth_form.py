"""The base class of tooth forms, which makes a gear mesh of two wheels; and the field types that forms declare."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, WithJsonSchema
from pydantic_core import PydanticCustomError

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.quantity import Figure, Length, PairDamping, PairStiffness, Quantity
from geartrain.numerics.results import summary_line, values_summary

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.pair_results import PairFigures

IDEAL = "give this pair `tooth_form: {form: ideal}`"

ShaftAngle = Callable[[], float | None]
"""The angle (rad) under which the axes of a pair meet; None where they are parallel."""


def twice(raw: object) -> object:
    """One value for both wheels, or the two as they are."""
    return raw if isinstance(raw, list | tuple) else (raw, raw)


def _schema(kind: str) -> WithJsonSchema:
    one = {"type": ["number", "string"]} if kind == "number" else {"type": ["string", "number"]}
    return WithJsonSchema({"anyOf": [one, {"type": "array", "items": one, "minItems": 2, "maxItems": 2}]})


TwoFigures = Annotated[tuple[Figure, Figure], BeforeValidator(twice), _schema("number")]
"""One number for both, or a list of two."""

TwoLengths = Annotated[tuple[Length, Length], BeforeValidator(twice), _schema("length")]
"""One length for both, or a list of two; plain numbers are modules."""


class ToothForm(BaseModel, ABC):
    """The teeth of a gear pair as declared: what makes a mesh of two wheels, whatever the form.

    See Also
    --------
    geartrain.teeth.GearMesh : what it makes.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    any_distance: ClassVar[bool] = False
    """True for teeth that run at any centre distance, not at that of their design only."""

    conjugate: ClassVar[bool] = False
    """True for teeth designed by a path of contact: for rings and cones too, their roots left to who cuts them."""

    more_contact: ClassVar[str] = "declare longer `arcs`"
    """What raises the contact ratio of conjugate teeth, as a fix."""

    ringed: ClassVar[bool] = False
    """True for teeth whose second wheel is a ring."""

    in_time: ClassVar[tuple[str, ...]] = ("stiffness", "damping")
    """Fields that say nothing of a shape: how teeth of this form yield in trains that move in time."""

    if TYPE_CHECKING:
        form: str

    stiffness: PairStiffness | None = Field(
        None,
        description="Of teeth in mesh, where their pair has none of its own: torque on the driven wheel for each "
        "radian that it yields, or force along the line of action for each length",
    )
    damping: PairDamping | None = Field(
        None, description="Of teeth in mesh, by speed as `stiffness` is by angle or length"
    )

    def __repr__(self) -> str:
        given = (name for name in type(self).model_fields if name in self.model_fields_set and name != "form")
        return summary_line(type(self).__name__, values_summary(self, given))

    @classmethod
    def declared(cls, parameters: Mapping[str, object]) -> Self:
        """The form with these parameters.

        Parameters
        ----------
        parameters : mapping
            As a declaration writes them, without `form`.

        Raises
        ------
        GearTrainError
            For parameters that make no form, its place the name of the one at fault where it is one alone.
        """
        (form,) = get_args(cls.model_fields["form"].annotation)
        try:
            return cls.model_validate({"form": form, **parameters})
        except ValidationError as error:
            # one value given for both wheels would be complained of twice
            raise GearTrainError(dict.fromkeys(map(cls._problem, error.errors(include_url=False)))) from None

    @classmethod
    def _problem(cls, item: Any) -> Problem:
        """What pydantic complains of, with what to do where the form says so."""
        context = item.get("ctx") or {}
        place = item["loc"][0] if item["loc"] else item["type"] if item["type"] in cls.model_fields else ""
        what = item["msg"] if "fix" in context else f"'{item['input']}' does not fit here"
        return Problem(what, "", str(context.get("fix", "")), str(place))

    @classmethod
    def with_defaults(cls, parameters: Mapping[str, Any]) -> dict[str, Any]:
        """Return parameters with defaults for those that a declaration of the form must have.

        Parameters
        ----------
        parameters : mapping
            As a declaration writes them, without `form`.
        """
        return dict(parameters)

    @property
    def words(self) -> str:
        """The name of the form as prose has it."""
        return self.form.replace("_", " ")

    @abstractmethod
    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh | None:
        """The mesh of a gear pair, its first wheel driving.

        Parameters
        ----------
        wheels : MeshingWheels
            The two wheels as declared.
        shaft_angle : callable
            Gives the angle of the axes [rad], None where they are parallel; called only where the form needs it.

        Returns
        -------
        GearMesh or None
            None for teeth that add nothing to the ratio.

        Raises
        ------
        GearTrainError
            Where these wheels cannot have such teeth, without naming pair or place.
        """

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """The class of what a mesh of this form tells of itself, from which the schema of answers is read."""
        from geartrain.teeth.pair_results import PairFigures

        return PairFigures

    @property
    def has_lengths(self) -> bool:
        """True for teeth declared in units of length, where others are so many modules."""
        return False

    @property
    def rack_angle(self) -> float | None:
        """Pressure angle (rad) of the rack that cuts these teeth; None where no rack does."""
        return None

    def own_backlash(self, pair: str) -> Problem | None:
        """Why a maker's play does not hold for this pair.

        Parameters
        ----------
        pair : str
            Name of the pair, for the message.

        Returns
        -------
        Problem or None
            None where it does hold.
        """
        del pair
        return None

    def thinned(self, backlash: Quantity) -> Self:
        """The form with this much play; itself where it has no play to declare.

        Parameters
        ----------
        backlash : Quantity
            On the pitch circle, in modules or with a unit.

        Returns
        -------
        ToothForm
            A copy.
        """
        del backlash
        return self


def bad(kind: str, what: str, fix: str) -> PydanticCustomError:
    """An error of a declaration, with what to do."""
    return PydanticCustomError(kind, "{what}", {"what": what, "fix": fix})


def refused(what: str, why: str, fix: str) -> GearTrainError:
    """A pair that a form does not give."""
    return GearTrainError(Problem(what, why, fix))
