"""What all conjugate tooth forms share: how a declaration gives a pair of wheels, and the pair its law."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from math import pi, tau
from typing import TYPE_CHECKING, Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.quantity import Angle, Figure, Length, Quantity

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair, ConjugateTransmission
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

FEWEST, MOST_TEETH = 3, 10**9
_LEAST_ANGLE = 1e-6  # rad: axes that meet under less are as good as parallel, and cones lost in rounding
_DESIGN = 1e-9  # of a centre distance: nearer to the design is at it


def _twice(raw: object) -> object:
    return raw if isinstance(raw, list | tuple) else (raw, raw)


def _schema(kind: str) -> WithJsonSchema:
    one = {"type": ["number", "string"]} if kind == "number" else {"type": ["string", "number"]}
    return WithJsonSchema({"anyOf": [one, {"type": "array", "items": one, "minItems": 2, "maxItems": 2}]})


TwoFigures = Annotated[tuple[Figure, Figure], BeforeValidator(_twice), _schema("number")]
"""One number for both, or a list of two."""

TwoLengths = Annotated[tuple[Length, Length], BeforeValidator(_twice), _schema("length")]
"""One length for both, or a list of two; plain numbers are modules."""


@dataclass(frozen=True, slots=True)
class WheelPair:
    """The two wheels that a form is asked about.

    z1, z2        tooth numbers; `internal`: the second is a ring
    shaft_angle   rad, for bevels; None for parallel axes
    module        m, or None where no length says it
    """

    z1: int
    z2: int
    internal: bool = False
    shaft_angle: float | None = None
    module: float | None = None

    @property
    def bevel(self) -> bool:
        """True if the axes meet."""
        return self.shaft_angle is not None

    @property
    def pitch(self) -> PitchSurfaces:
        """The pitch surfaces at the design distance. Raises `GearTrainError` where there are none."""
        from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

        self.check()
        if self.shaft_angle is None:
            return PitchSurfaces.spur(self.z1, self.z2, self.internal)
        return PitchSurfaces.cones(self.z1, self.z2, self.shaft_angle)

    @property
    def distance(self) -> float:
        """Design centre distance in modules."""
        return (self.z2 - self.z1 if self.internal else self.z1 + self.z2) / 2

    def check(self) -> None:
        """Raises `GearTrainError` for wheels that cannot be a pair."""
        for z in (self.z1, self.z2):
            if z < FEWEST:
                raise refused(
                    f"a wheel of {z} {'tooth' if z == 1 else 'teeth'} has no conjugate teeth",
                    "so few leave no arc on which one pair takes over from the last",
                    f"give at least {FEWEST} teeth, or another tooth_form",
                )
        if self.internal and self.z2 <= self.z1:
            raise refused(
                f"a ring of {self.z2} teeth does not hold a wheel of {self.z1}",
                "its pitch circle is not the larger one",
                "give the ring more teeth",
            )
        if self.internal and self.bevel:
            raise refused("a ring's axis is parallel to its pinion's", "", "give the pair no shaft angle")
        if max(self.z1, self.z2) > MOST_TEETH:
            raise refused(
                f"a wheel of {max(self.z1, self.z2)} teeth",
                "its teeth are lost in the rounding of its radius",
                f"give at most {MOST_TEETH:g} teeth",
            )
        if self.shaft_angle is not None and not _LEAST_ANGLE <= self.shaft_angle <= pi - _LEAST_ANGLE:
            raise refused(
                f"a shaft angle of {self.shaft_angle:.6g} rad is none",
                f"bevel axes meet between 0 and 180 deg, and {_LEAST_ANGLE:g} rad from either at least",
                "give parallel axes to a spur pair",
            )

    def modules(self, length: Quantity, name: str) -> float:
        """A declared length in modules; plain numbers are. Raises `GearTrainError` where no module is known."""
        if length.unit is None:
            return float(length.value)
        if self.module is None:
            raise refused(
                f"the {name} {length.text} has nothing to be compared with",
                "the wheels declare no module with a unit",
                f"give the `module` of both wheels, or the {name} as a plain number of modules",
            )
        return length.si / self.module


class ConjugateToothForm(BaseModel, ABC):
    """A conjugate tooth form: a path of contact for any two wheels, and the thickness of their teeth."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    backlash: Length = Field(
        "0",
        validate_default=True,
        description="Play on the pitch circle, in modules or with a unit; both teeth thinned",
    )
    centre_distance: Length | None = Field(
        None, description="Distance of the two axes, in modules or with a unit; default that of the design"
    )

    @model_validator(mode="after")
    def _lengths_are_lengths(self) -> ConjugateToothForm:
        if self.backlash.value < 0:
            raise bad("backlash", f"backlash {self.backlash.text} would jam the teeth", "write 0 or more")
        if self.centre_distance is not None and self.centre_distance.value <= 0:
            raise bad("length", f"centre_distance {self.centre_distance.text} is no length", "write it above 0")
        return self

    @abstractmethod
    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """The pair of wheels as designed, whatever their distance. Raises `GearTrainError` where there is none."""

    def path(
        self,
        z1: int,
        z2: int,
        *,
        internal: bool = False,
        shaft_angle: float | None = None,
        pitch_distance: float | None = None,
    ) -> PathOfContact:
        """The path of contact; `internal`: the second wheel is a ring; `shaft_angle` rad for bevels.

        pitch_distance   m: half the module of each wheel times its teeth, summed, for a ring too
        """
        return conjugate_pair_of(self, _wheels(z1, z2, internal, shaft_angle, pitch_distance)).path

    def law(
        self,
        z1: int,
        z2: int,
        friction: float = 0.0,
        driver: int = 1,
        direction: int = 1,
        pitch_distance: float | None = None,
        internal: bool = False,
        shaft_angle: float | None = None,
    ) -> ConjugateTransmission | OffDesignTransmission:
        """The transmission law of a pair. `driver` 2 lets the second wheel drive, `direction` -1 turns backwards.

        pitch_distance, internal, shaft_angle   as in `path`
        Raises `GearTrainError` where the form gives no such pair; the law's `verdict` says whether a pair can run.
        """
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission

        wheels = _wheels(z1, z2, internal, shaft_angle, pitch_distance)
        pair, distance = conjugate_pair_of(self, wheels), self.misplaced(wheels)
        if distance is None:
            return ConjugateTransmission(pair, friction, driver, direction)
        from geartrain.teeth.conjugate.off_design import OffDesignTransmission

        return OffDesignTransmission(pair, distance, friction, driver, direction)

    def misplaced(self, wheels: WheelPair) -> float | None:
        """The declared centre distance in modules, where it is not the design's; else None.

        Raises `GearTrainError` for bevel wheels, which have none.
        """
        if self.centre_distance is None:
            return None
        if wheels.bevel:
            raise refused("bevel wheels have no centre distance", "their axes meet", "leave out centre_distance")
        given, design = wheels.modules(self.centre_distance, "centre_distance"), wheels.distance
        return given if abs(given - design) > _DESIGN * design else None

    def standard(self, path: PathOfContact, wheels: WheelPair) -> ConjugatePair:
        """A pair whose teeth share the pitch equally, less half the backlash each."""
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

        half = path.pitch.p / 4 - self.play(path.pitch, wheels) / 4
        return ConjugatePair(path, (half, half))

    def play(self, pitch: PitchSurfaces, wheels: WheelPair) -> float:
        """The declared backlash as X: of a bevel pair a module is p / pi on the unit sphere."""
        return wheels.modules(self.backlash, "backlash") * pitch.p / pi


def _wheels(z1: int, z2: int, internal: bool, shaft_angle: float | None, pitch_distance: float | None) -> WheelPair:
    module = None if pitch_distance is None or z1 + z2 < 1 else 2 * pitch_distance / (z1 + z2)
    return WheelPair(z1, z2, internal, shaft_angle, module)


@lru_cache(maxsize=1024)
def conjugate_pair_of(form: ConjugateToothForm, wheels: WheelPair) -> ConjugatePair:
    """The pair of a form, made once."""
    return form.pair(wheels)


def arcs_of(figures: tuple[Figure, Figure], pitch: PitchSurfaces) -> tuple[float, float]:
    """Arcs declared in pitches, as X."""
    return float(figures[0].value) * pitch.p, float(figures[1].value) * pitch.p


def check_arcs(arcs: tuple[Figure, Figure]) -> None:
    """Raises pydantic's error for arcs that are none."""
    if min(arc.value for arc in arcs) < 0 or sum(arc.value for arc in arcs) <= 0:
        text = ", ".join(arc.text for arc in arcs)
        raise bad("arcs", f"arcs [{text}] are none", "give those of approach and recess in pitches, a pitch in all")


def check_angle(name: str, angle: Angle, below: float = 0.25) -> None:
    """Raises pydantic's error for a pressure angle outside 0 to `below` of a turn, an eighth or a quarter."""
    turns = angle.si / tau
    if not 0 < turns < below:
        raise bad(
            "pressure_angle",
            f"{name} {angle.text} is outside 0 to {360 * below:g} deg",
            f"a pressure angle of these teeth lies between 0 and {360 * below:g} deg; 20 deg is usual",
        )


def bad(kind: str, what: str, fix: str) -> PydanticCustomError:
    """An error of a declaration, with what to do."""
    return PydanticCustomError(kind, "{what}", {"what": what, "fix": fix})


def refused(what: str, why: str, fix: str) -> GearTrainError:
    """A pair that a form does not give."""
    return GearTrainError(Problem(what, why, fix))
