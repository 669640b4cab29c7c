"""What the train is made of: sources, wheels, links, axes, pairs."""

from __future__ import annotations

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
    TorsionalDamping,
    millimetres,
)
from geartrain.numerics.quantity_bounds import (
    PairDamping,
    PairStiffness,
    above_zero,
    below_right_angle,
    not_below_zero,
)
from geartrain.numerics.vectors import Vector, unit
from geartrain.teeth.restitution import DeclaredRestitution
from geartrain.train.bearing_friction import DeclaredBearing
from geartrain.train.efficiencies import DeclaredEfficiency
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
from geartrain.train.manufacturing import PairMounting, WheelManufacture
from geartrain.train.materials import ArborSizes, FaceWidth
from geartrain.train.short_forms import JOINT_SCHEMA
from geartrain.train.tooth_counts import Teeth

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


Revolutes = Annotated[tuple[Revolute, ...], AlsoShort(JOINT_SCHEMA)]


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
