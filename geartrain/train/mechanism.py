"""Parts of the mechanism as declared: sources, wheels, links, axes, pairs.

With tooth counts that are in doubt (a best value and what the evidence allows), the basic efficiency of a pair by the
wheel that drives, and the friction torque of a link's bearing, sliding and at rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import cos
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Discriminator,
    Field,
    GetJsonSchemaHandler,
    Tag,
    model_validator,
)
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import (
    Angle,
    Density,
    Figure,
    Inertia,
    Length,
    Mass,
    MeasuredLength,
    PairDamping,
    PairStiffness,
    Quantity,
    Share,
    Torque,
    TorsionalDamping,
    above_zero,
    below_right_angle,
    millimetres,
    not_below_zero,
)
from geartrain.numerics.vectors import Vector, unit
from geartrain.teeth.contact_coefficients import DeclaredRestitution
from geartrain.train.fields import (
    AlsoShort,
    Boolean,
    ByName,
    Count,
    Declared,
    DeclaredFriction,
    DeclaredToothForm,
    Id,
    Status,
    also,
    read_count,
    short_for,
    side,
)
from geartrain.train.manufacturing import ArborSizes, FaceWidth, PairMounting, WheelManufacture

# ----------------------------------------------------------------------------------------------------- bearing friction


_JOINT_SCHEMA = {
    "type": "object",
    "additionalProperties": {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 2},
}
"""JSON Schema of the short form of `revolutes`."""


def _not_negative(torque: Quantity) -> Quantity:
    if torque.value < 0:
        raise PydanticCustomError(
            "bearing", "a friction torque is not negative", {"fix": "give its magnitude: it acts against the turning"}
        )
    return torque


FrictionTorque = Annotated[Torque, AfterValidator(_not_negative)]


class BearingFriction(Declared):
    """Friction of a bearing, which does not depend on load or speed. A bare torque is `sliding`.

    See Also
    --------
    Link : holds it as `bearing`

    Examples
    --------
    >>> BearingFriction(sliding="0.5 N m").at_rest.si
    0.5
    """

    sliding: FrictionTorque = Field(description="Friction torque while it turns, against its turning")
    static: FrictionTorque | None = Field(
        None, description="Torque that a start has to overcome; `sliding` or more, default `sliding`"
    )

    @model_validator(mode="after")
    def _rests_no_easier(self) -> BearingFriction:
        if self.static is None:
            return self
        if (self.static.unit is None) != (self.sliding.unit is None) and self.static.value and self.sliding.value:
            what = "sliding {sliding} and static {static} mix a plain number and a torque with a unit"
            fix = "give both with a unit, or both without"
        elif self.static.base < self.sliding.base:
            what = "a static friction torque of {static} is below the sliding one of {sliding}"
            fix = "what turns is never harder to move than what rests: give `static` as `sliding` or more"
        else:
            return self
        raise PydanticCustomError(
            "bearing", what, {"static": self.static.text, "sliding": self.sliding.text, "fix": fix}
        )

    @property
    def at_rest(self) -> Quantity:
        """`static`, or `sliding` where that is not given."""
        return self.sliding if self.static is None else self.static

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["string", "number"]}, handler(schema))


def _sliding(raw: object) -> object:
    if isinstance(raw, dict | BearingFriction):
        return raw
    return {"sliding": _not_negative(Quantity.parse(raw, "torque", plain=True))}


DeclaredBearing = Annotated[BearingFriction, BeforeValidator(_sliding)]
"""The same, or a bare torque."""


# --------------------------------------------------------------------------------------------------------- efficiencies


def _no_more_than_all(efficiency: Quantity) -> Quantity:
    if efficiency.base > 1:
        meant = f"{efficiency.text} %" if efficiency.unit is None and efficiency.base <= 100 else "0.98"
        raise PydanticCustomError(
            "efficiency",
            "an efficiency of {text} makes power out of nothing",
            {"text": efficiency.text, "fix": f"an efficiency is at most 1: write for example 0.98 or {meant}"},
        )
    return efficiency


Efficiency = Annotated[Share, AfterValidator(_no_more_than_all)]


class Efficiencies(Declared):
    """Basic efficiency of a pair, carrier held, by the wheel that drives: above 0 and at most 1, or a percentage.

    A pair may lock in one direction, which 0 or less says, but not in both.
    """

    forward: Efficiency = Field(description="With the first wheel driving, at most 1; 0 or less locks")
    backward: Efficiency = Field(description="With the second wheel driving, at most 1; 0 or less locks")

    @model_validator(mode="after")
    def _passes_power_one_way(self) -> Efficiencies:
        if self.forward.base <= 0 and self.backward.base <= 0:
            raise PydanticCustomError(
                "efficiency",
                "an efficiency of {text} lets no power through in either direction",
                {"text": self.forward.text, "fix": "an efficiency is above 0 and at most 1, such as 0.98 or 98 %"},
            )
        return self

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["number", "string"]}, handler(schema))


def _efficiency(raw: object) -> object:
    return raw if isinstance(raw, dict | Efficiencies) else {"forward": raw, "backward": raw}


DeclaredEfficiency = Annotated[Efficiencies, BeforeValidator(_efficiency)]
"""The same, or one number for both directions."""


# --------------------------------------------------------------------------------------------------------- tooth counts


class Teeth(Declared):
    """A tooth count with its doubt: a best value, and a range or choices.

    See Also
    --------
    Wheel : an example
    """

    value: Count | None = Field(None, description="The count used")
    range: tuple[Count, Count] | None = Field(
        None, description="Least and greatest count the evidence allows, inclusive"
    )
    choices: tuple[Count, ...] | None = Field(None, fail_fast=True, description="The counts the evidence allows")
    weights: tuple[Figure, ...] | None = Field(
        None, fail_fast=True, description="Relative weight of each count in range or choices"
    )
    source: str | None = Field(None, description="Key of the source")
    search: tuple[Count, ...] | None = Field(
        None,
        min_length=2,
        fail_fast=True,
        description="The count is to be found: within two bounds, inclusive, or among three or more counts",
    )

    def _brief(self) -> str:
        """The count, in the line of a wheel."""
        return str(self.value)

    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _makes_sense(self) -> Teeth:
        bounds = self.range or self.search
        if bounds and len(bounds) == 2 and bounds[0] > bounds[1]:
            raise PydanticCustomError(
                "teeth",
                "the range {low} to {high} is empty",
                {"low": bounds[0], "high": bounds[1], "fix": "write the least count first"},
            )
        if self.value is None and self.search is None:
            raise PydanticCustomError("teeth", "the tooth count has no value", {"fix": "give `value`, or `search`"})
        counts = self.allowed
        if self.value is not None and counts and self.value not in counts:
            raise PydanticCustomError(
                "teeth",
                "the value {value} lies outside what its evidence allows",
                {"value": self.value, "fix": "widen the range or choices, or correct the value"},
            )
        if self.weights is not None and len(self.weights) != len(counts):
            raise PydanticCustomError(
                "teeth",
                "{given} weights for {count} counts",
                {"given": len(self.weights), "count": len(counts), "fix": "give one weight for each count"},
            )
        return self

    @property
    def allowed(self) -> tuple[int, ...]:
        """All counts the evidence allows; empty where no doubt is declared."""
        if self.choices is not None:
            return self.choices
        if self.range is None or self.range[1] - self.range[0] > 10**6:
            return ()
        return tuple(range(self.range[0], self.range[1] + 1))

    @property
    def searched(self) -> Sequence[int]:
        """The counts of `search`, ascending; empty without it."""
        if self.search is None:
            return ()
        return range(self.search[0], self.search[1] + 1) if len(self.search) == 2 else sorted(set(self.search))

    @property
    def chances(self) -> dict[int, Fraction]:
        """The chance of each count before anything else is known, as its `weights` say, ascending; the sum is 1.

        All counts are alike where no weights are declared, and those of `search`; counts of weight 0 are left out.
        Empty where no doubt is declared. Not to be asked where there is a `fault_of_weights`.

        Examples
        --------
        >>> Teeth(value=64, range=(63, 65), weights=(1, 3, 0)).chances
        {63: Fraction(1, 4), 64: Fraction(3, 4)}
        """
        counts = self.allowed
        if not counts:
            counts = tuple(self.searched)
        weights = [Fraction(1)] * len(counts) if self.weights is None else [figure.value for figure in self.weights]
        whole, found = sum(weights), dict.fromkeys(sorted(counts), Fraction(0))
        for count, weight in zip(counts, weights, strict=True):  # a count may be listed twice
            found[count] += weight / whole
        return {count: chance for count, chance in found.items() if chance}

    @property
    def fault_of_weights(self) -> str | None:
        """Why its weights are no chances; None where they are."""
        weights = [figure.value for figure in self.weights or ()]
        if any(weight < 0 for weight in weights):
            return "one is negative"
        return "all are 0" if weights and not any(weights) else None


# ------------------------------------------------------------------------------------------------------------ mechanism


MOST_COPIES = 360  # more planets have room on no carrier


class Source(Declared):
    """Where facts come from.

    See Also
    --------
    Train : holds them as `sources`, by key
    """

    cite: str = Field(description="The citation")
    url: str | None = Field(None, description="Where it can be read")
    note: str | None = Field(None, description="How it was reached, or how far it is trusted")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "string"}, handler(schema))


def _teeth_kind(raw: object) -> str:
    return "doubt" if isinstance(raw, dict | Teeth) else "count"


HelixAngle = Annotated[
    Angle, not_below_zero("give its magnitude, and its `hand`"), below_right_angle("give it from the axis")
]
Thickness = Annotated[MeasuredLength, above_zero("give a length such as 2 mm")]
MaterialDensity = Annotated[Density, above_zero("give for example 8.7 g/cm3, that of bronze")]


class Wheel(Declared):
    """A wheel on a link. A bare number is its tooth count.

    Examples
    --------
    >>> Wheel(teeth=20).count
    20
    >>> doubtful = Wheel(teeth={"value": 64, "range": (64, 66)})
    >>> doubtful.count, doubtful.doubt.allowed
    (64, (64, 65, 66))
    """

    teeth: Annotated[Annotated[Count, Tag("count")] | Annotated[Teeth, Tag("doubt")], Discriminator(_teeth_kind)] = (
        Field(description="Tooth count, or a count with its range; the starts of a worm")
    )
    internal: Boolean = Field(False, description="A ring: its teeth look inwards, and a mesh with it keeps the sense")
    flexible: Boolean = Field(
        False,
        description="Bent into its ring by a wave generator: its teeth go in and out radially, and clear the ring's",
    )
    kind: Literal["spur", "bevel", "contrate", "worm"] = Field("spur", description="How the teeth stand")
    facing: Annotated[Literal[1, -1], BeforeValidator(side)] = Field(
        1, description="Side of the axis to which the cone opens, -1 for the negative one (bevel, contrate)"
    )
    helix_angle: HelixAngle | None = Field(
        None, description="Of helical teeth, and of a worm's thread: between its direction and the axis"
    )
    hand: Literal["right", "left"] | None = Field(
        None, description="Hand of a worm's thread or of helical teeth; a worm's is right by default"
    )
    module: Length | None = Field(
        None, description="Pitch diameter over tooth count; of helical teeth across them, the normal module"
    )
    thickness: Thickness | None = Field(None, description="Of the wheel along its axis; default the train's")
    density: MaterialDensity | None = Field(None, description="Of what it is made of; default the train's")
    face_width: FaceWidth | None = Field(
        None, description="Width of its teeth along the axis; default the train's, or its thickness"
    )
    material: Id | None = Field(
        None, description="What it is made of: a name of the table (docs/strength.md) or of `materials`"
    )
    cutting: WheelManufacture | None = Field(None, description="How far its teeth are off; default the train's")
    status: Status | None = Field(None, description="surviving, reconstructed or hypothetical")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @property
    def count(self) -> int | None:
        """The tooth count used; None while it is still to be found."""
        return self.teeth if isinstance(self.teeth, int) else self.teeth.value

    @property
    def doubt(self) -> Teeth | None:
        """The declared range or choices, where the count is uncertain."""
        return self.teeth if isinstance(self.teeth, Teeth) and len(self.teeth.allowed) > 1 else None

    @model_validator(mode="after")
    def _leans_where_it_may(self) -> Wheel:
        if self.helix_angle is not None and self.kind in ("bevel", "contrate"):
            raise PydanticCustomError(
                "helix_angle",
                "a {kind} wheel has a helix angle",
                {"kind": self.kind, "fix": "leave it out: teeth that lean are known of spur wheels, rings and worms"},
            )
        return self

    @model_validator(mode="after")
    def _bends_where_it_may(self) -> Wheel:
        if self.flexible and (self.internal or self.kind != "spur"):
            raise PydanticCustomError(
                "flexible",
                "a {kind} is flexible",
                {
                    "kind": "ring" if self.internal else f"{self.kind} wheel",
                    "fix": "write it at the spur wheel that the wave bends into its ring",
                },
            )
        return self

    @property
    def is_helical(self) -> bool:
        """Whether its teeth lean; a worm's thread does too, and is no such tooth."""
        return self.kind == "spur" and self.helix_angle is not None and self.helix_angle.value > 0

    @property
    def helix(self) -> float:
        """Helix angle (rad), of a right hand above 0; 0 of straight teeth, and where it is not declared."""
        angle = 0.0 if self.helix_angle is None else self.helix_angle.si
        return -angle if self.hand == "left" else angle

    @property
    def slant(self) -> float:
        """Transverse module over normal module: 1 over the cosine of the helix angle."""
        return 1 / cos(self.helix) if self.is_helical else 1.0

    @property
    def transverse_module(self) -> float | None:
        """Pitch diameter over tooth count (m); None where no module is declared with a unit."""
        declared = self.module is not None and self.module.unit is not None
        return self.module.si * self.slant if self.module is not None and declared else None

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "integer", "minimum": 1}, handler(schema))


class Link(Declared):
    """A rigid body: an arbor with its wheels, a carrier, the frame.

    See Also
    --------
    Train : holds them as `links`, by name
    """

    wheels: ByName[Annotated[Wheel, short_for("teeth")]] = Field(
        {}, validate_default=True, description="The wheels fixed on this link, by id"
    )
    copies: Annotated[int, Field(le=MOST_COPIES), BeforeValidator(read_count)] = Field(
        1, description="So many equal links, evenly spaced about the axis of the carrier that bears this one"
    )
    inertia: Annotated[Inertia, not_below_zero("an inertia is 0 or more")] | None = Field(
        None, description="Moment of inertia about its axis; default from its wheels, where their `density` is given"
    )
    mass: Annotated[Mass, above_zero("give a mass such as 20 g")] | None = Field(
        None, description="Mass of a link that a carrier takes round; default from its wheels, as `inertia`"
    )
    bearing: DeclaredBearing | None = Field(
        None, description="Friction torque of its bearing, against its turning, or {sliding, static}"
    )
    drag: Annotated[TorsionalDamping, not_below_zero("it acts against the turning: give its magnitude")] | None = Field(
        None, description="Viscous drag: torque against its turning for each radian a second"
    )
    arbor: ArborSizes | None = Field(
        None, description="Its arbor between two bearings, where its strength is asked for"
    )
    angle: Angle | None = Field(None, description="Angle at the start")
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "null"}, handler(schema))


class Axis(Declared):
    """Where an axis lies; moving axes in the pose where all angles are zero.

    See Also
    --------
    Train : holds them as `axes`, by label
    """

    direction: tuple[Figure, Figure, Figure] = Field(
        (Figure.parse(0), Figure.parse(0), Figure.parse(1)),
        description="Direction vector, default z; speeds are positive about it",
    )
    position: tuple[Length, Length, Length] | None = Field(None, description="A point of the axis")
    note: str | None = Field(None, description="A remark for the reader")

    @property
    def way(self) -> Vector:
        """Its direction, of length 1."""
        top = max(abs(part.value) for part in self.direction)  # the float of a huge number would overflow
        x, y, z = (float(part.value / top) for part in self.direction)
        return unit((x, y, z))

    @property
    def point(self) -> Vector | None:
        """Where it lies [mm]; None where that is not declared."""
        if self.position is None:
            return None
        x, y, z = (float(millimetres(part)) for part in self.position)
        return x, y, z

    @model_validator(mode="after")
    def _points_somewhere(self) -> Axis:
        if not any(figure.value for figure in self.direction):
            raise PydanticCustomError(
                "axis", "the direction is the zero vector", {"fix": "give a direction such as [0, 0, 1]"}
            )
        return self


class Revolute(Declared):
    """A turning pair of two links; joints with one axis label are coaxial.

    See Also
    --------
    Train : holds them as `revolutes`
    """

    pair: tuple[Id, Id] = Field(description="The two links")
    axis: Id = Field(description="Label of the axis")
    note: str | None = Field(None, description="A remark for the reader")


Revolutes = Annotated[tuple[Revolute, ...], AlsoShort(_JOINT_SCHEMA)]


def _positive(figure: Figure) -> Figure:
    if figure.value <= 0:
        raise PydanticCustomError(
            "share",
            "a share of {text} carries nothing",
            {"text": figure.text, "fix": "a share is above 0; leave it out where it is not known"},
        )
    return figure


class GearPair(Declared):
    """Two wheels in mesh. The carrier is found, not declared.

    Examples
    --------
    >>> pair = GearPair(pair=("sun", "planet"), efficiency="98 %")
    >>> pair.name, pair.efficiency.backward.base
    ('sun~planet', Fraction(49, 50))
    """

    id: str = Field("", description="Name of the pair; default first~second")
    pair: tuple[Id, Id] = Field(description="The two wheels")
    tooth_form: DeclaredToothForm | None = Field(None, description="Form of the teeth; default the train's")
    friction: DeclaredFriction | None = Field(
        None, description="Coefficient of friction between teeth, or {sliding, static, deviation}, or a law of speed"
    )
    restitution: DeclaredRestitution | None = Field(
        None, description="Speed of parting over speed of meeting of teeth that strike, 0 to 1; default the train's"
    )
    stiffness: PairStiffness | None = Field(
        None,
        description="Of teeth in mesh: torque on the driven wheel for each radian that it yields, or force along the "
        "line of action for each length; default the train's",
    )
    damping: PairDamping | None = Field(
        None, description="Of teeth in mesh, by speed as `stiffness` is by angle or length; default the train's"
    )
    efficiency: DeclaredEfficiency | None = Field(
        None,
        description="Basic efficiency with the carrier held, at most 1: a number, a percentage, or {forward, backward}",
    )
    share: Annotated[Figure, AfterValidator(_positive)] | None = Field(
        None, description="Part of a torque it carries, among the pairs that have a wheel in common and a share"
    )
    driver: Id | None = Field(None, description="The wheel that drives; default by the flow of power")
    phase: Figure | None = Field(
        None,
        description="Pitches by which a tooth of the first wheel is past the line of centres at turn 0; default 0",
    )
    fitting: PairMounting | None = Field(None, description="How far its axes are off; default the train's")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "string"}, handler(schema))

    @property
    def name(self) -> str:
        """The declared id, or first~second."""
        return self.id or f"{self.pair[0]}~{self.pair[1]}"
