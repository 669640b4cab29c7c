"""Parts of the mechanism as declared: sources, wheels, links, axes, gear pairs.

A tooth count may be uncertain; it then has a best value and a list of counts that the evidence allows. A pair has one
basic efficiency for each direction of power flow, and the bearing of a link has a sliding and a static friction torque.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from importlib.resources import files
from math import cos, hypot
from types import MappingProxyType
from typing import Annotated, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator, Discriminator, Field, Tag, model_validator

from geartrain.errors import suggest
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.plain_values import Boolean
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
    Torque,
    TorsionalDamping,
    above_zero,
    bad,
    below_right_angle,
    check_range,
    checked,
    millimetres,
    not_below_zero,
)
from geartrain.numerics.vectors import Vector, unit
from geartrain.teeth.contact_coefficients import DeclaredEfficiency, DeclaredRestitution
from geartrain.train.fields import (
    AlsoShort,
    ByName,
    Count,
    Declared,
    DeclaredFriction,
    DeclaredToothForm,
    Id,
    Status,
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
"""JSON Schema of the short form of `revolutes` and `slides`, a mapping from axis label to the links on the axis."""


FrictionTorque = Annotated[
    Torque,
    checked(
        lambda given: given.value >= 0,
        "a friction torque must not be negative",
        "give its magnitude: it is always opposed to the rotation",
    ),
]

_Coefficient = Annotated[Figure, not_below_zero("give a coefficient of friction such as 0.15")]
_Radius = Annotated[MeasuredLength, above_zero("give a length such as 1.5 mm")]


class BearingFriction(Declared):
    """Friction of a bearing: a torque that does not depend on the bearing load, plus a torque proportional to it. In a
    declaration, a single torque instead of a mapping sets `sliding`.
    """

    SHORT: ClassVar = {"type": ["string", "number"], "format": "torque"}

    sliding: FrictionTorque = Field(
        Quantity.parse(0, "torque", plain=True),
        description="Sliding friction torque that does not depend on the load, opposed to the rotation; default 0",
    )
    static: FrictionTorque | None = Field(
        None, description="Static friction torque that must be exceeded to start; at least `sliding`, default `sliding`"
    )
    coefficient: _Coefficient | None = Field(
        None,
        description="Coefficient of friction of the bearing; its friction torque grows with the forces of the gear "
        "pairs, whose `axes` need positions; default none",
    )
    radius: _Radius | None = Field(
        None, description="Radius of the pivot in the bearing, for `coefficient`; default half the `pivot` of the arbor"
    )
    range: tuple[_Coefficient, _Coefficient] | None = Field(
        None, description="Minimum and maximum of the uniform distribution of `coefficient` in Monte Carlo runs"
    )
    radii: tuple[_Radius, _Radius] | None = Field(
        None, description="Minimum and maximum of the uniform distribution of `radius` in Monte Carlo runs"
    )
    shared: tuple[Literal["coefficient", "radius"], ...] = Field(
        ("coefficient", "radius"),
        description="Quantities drawn once per trial for all bearings, in Monte Carlo runs; others are drawn for each",
    )
    at: tuple[MeasuredLength, MeasuredLength] | None = Field(
        None,
        description="Positions of two bearings along the axis, as `along` of the wheels; default one bearing in the "
        "plane of all forces",
    )

    shoulder: tuple[_Radius, _Radius] | None = Field(
        None,
        description="Inner and outer radius of a shoulder that carries the weight along the axis; it rubs "
        "with `coefficient`; default none",
    )

    @model_validator(mode="after")
    def _check_static(self) -> BearingFriction:
        check_range("bearing", self.coefficient, self.range)
        check_range("bearing", self.radius, self.radii)
        if self.shoulder is not None and self.shoulder[0].si >= self.shoulder[1].si:
            what = "the inner radius of the shoulder is not below its outer radius"
            raise bad("bearing", what, "give inner and outer radius, such as `shoulder: [1 mm, 3 mm]`")
        if self.at is not None and self.at[0].si == self.at[1].si:
            raise bad(
                "bearing", "two bearings have the same position", "give two positions, such as `at: [0 mm, 40 mm]`"
            )
        if not self.model_fields_set & {"sliding", "coefficient"}:
            raise bad("bearing", "the friction is missing", "give `sliding`, a torque, or `coefficient` and `radius`")
        if self.static is None:
            return self
        # a torque of 0 needs no unit
        sliding, static = self.sliding, self.static
        if (static.unit is None) != (sliding.unit is None) and static.value and sliding.value:
            what = f"sliding {sliding} and static {static} mix a number without a unit and a torque with a unit"
            raise bad("bearing", what, "give both with a unit, or both without")
        if static.base < sliding.base:
            what = f"the static friction torque {static} is below the sliding friction torque {sliding}"
            fix, why = f"give `static: {sliding}` or more", "static friction is never less than sliding friction"
            raise bad("bearing", what, fix, why)
        return self

    @property
    def at_rest(self) -> Quantity:
        """Static friction torque: `static`, or `sliding` if `static` is not declared."""
        return self.sliding if self.static is None else self.static


DeclaredBearing = Annotated[BearingFriction, short_for("sliding")]
"""Friction of a bearing; in a declaration, a single torque instead of a mapping sets `sliding`."""


# --------------------------------------------------------------------------------------------------------- tooth counts


@cache
def wheel_sets() -> Mapping[str, tuple[int, ...]]:
    """Return the tooth counts of each construction set in the shipped table, in ascending order, by set name."""
    text = files("geartrain.train").joinpath("wheel_sets.csv").read_text(encoding="utf-8")
    found: dict[str, list[int]] = {}
    for row in csv.DictReader(text.splitlines()):
        found.setdefault(row["set"], []).append(int(row["teeth"]))
    return MappingProxyType({name: tuple(sorted(counts)) for name, counts in found.items()})


def _known(name: str) -> str:
    if name not in wheel_sets():
        otherwise = f"use one of {', '.join(wheel_sets())}, or a list of tooth counts"
        raise bad("teeth", f"the set of wheels '{name}' is unknown", suggest(name, wheel_sets(), otherwise=otherwise))
    return name


class OwnedWheels(Declared):
    """Stock of wheels from which a wheel of the train is chosen."""

    of: Annotated[
        Annotated[str, AfterValidator(_known), Tag("name")]
        | Annotated[dict[Count, Count], Field(min_length=1), AfterValidator(FrozenDict), Tag("numbers")]
        | Annotated[tuple[Count, ...], Field(min_length=1), Tag("list")],
        Discriminator(
            lambda raw: "name" if isinstance(raw, str) else "numbers" if isinstance(raw, Mapping) else "list"
        ),
    ] = Field(
        description="Tooth counts: a list, a mapping from tooth count to the number of such wheels, or the name of a "
        "construction set (lego, meccano). Wheels with the same mapping share its wheels"
    )

    @property
    def counts(self) -> Sequence[int]:
        """Distinct tooth counts in ascending order."""
        return tuple(sorted(set(wheel_sets()[self.of] if isinstance(self.of, str) else self.of)))

    @property
    def numbers(self) -> tuple[tuple[int, int], ...]:
        """Pairs of a tooth count and the number of wheels that have it; empty if these numbers are not limited."""
        return tuple(sorted(self.of.items())) if isinstance(self.of, Mapping) else ()


class Teeth(Declared):
    """Uncertain tooth count: a best value, with a range or a list of possible counts.

    See Also
    --------
    Wheel : an example
    """

    value: Count | None = Field(None, description="Tooth count used in calculations")
    range: tuple[Count, Count] | None = Field(
        None, description="Minimum and maximum count that the evidence allows, inclusive"
    )
    choices: tuple[Count, ...] | None = Field(None, fail_fast=True, description="Tooth counts that the evidence allows")
    weights: tuple[Figure, ...] | None = Field(
        None, fail_fast=True, description="Relative probability of each count in `range` or `choices`; default equal"
    )
    source: str | None = Field(None, description="Key of the source in `sources`")
    search: (
        Annotated[
            Annotated[OwnedWheels, Tag("owned")]
            | Annotated[tuple[Count, ...], Field(min_length=2, fail_fast=True), Tag("counts")],
            Discriminator(lambda raw: "owned" if isinstance(raw, dict | OwnedWheels) else "counts"),
        ]
        | None
    ) = Field(
        None,
        description="Counts among which the tooth count is searched: two inclusive bounds, a list of three or more, or "
        "owned wheels such as `{of: [15, 57]}`",
    )

    def _brief(self) -> str:
        """Return the tooth count as it is printed in the one-line summary of a wheel."""
        return str(self.value)

    note: str | None = Field(None, description="Remark for readers")

    @model_validator(mode="after")
    def _check_counts(self) -> Teeth:
        bounds = self.range or self.search
        if isinstance(bounds, tuple) and len(bounds) == 2 and bounds[0] > bounds[1]:
            raise bad("teeth", f"the range {bounds[0]} to {bounds[1]} is empty", "write the smaller count first")
        if self.value is None and self.search is None:
            raise bad("teeth", "the tooth count has no value", "give `value`, such as `value: 20`, or `search`")
        counts = self.allowed
        if self.value is not None and counts and self.value not in counts:
            what = f"the value {self.value} is outside its range or choices"
            raise bad("teeth", what, "widen the range or choices, or correct the value")
        if self.weights is not None and len(self.weights) != len(counts):
            what = f"{len(self.weights)} weights are given for {len(counts)} counts"
            raise bad("teeth", what, "give one weight for each count")
        return self

    @property
    def allowed(self) -> tuple[int, ...]:
        """All tooth counts that the evidence allows; empty if the count is certain or `range` has over 10^6 counts."""
        if self.choices is not None:
            return self.choices
        # a wider range is not enumerated, because its tuple would need much memory
        if self.range is None or self.range[1] - self.range[0] > 10**6:
            return ()
        return tuple(range(self.range[0], self.range[1] + 1))

    @property
    def searched(self) -> Sequence[int]:
        """Tooth counts declared by `search`, in ascending order; empty if `search` is not declared."""
        if self.search is None:
            return ()
        if isinstance(self.search, OwnedWheels):
            return self.search.counts
        return range(self.search[0], self.search[1] + 1) if len(self.search) == 2 else sorted(set(self.search))

    @property
    def probabilities(self) -> dict[int, Fraction]:
        """Prior probability of each count from `weights`, in ascending order of counts; the sum is 1.

        Without weights, all counts of `range`, `choices` or `search` are equally probable. Counts with weight 0 are
        omitted. The mapping is empty if the tooth count is certain. It is undefined if `fault_of_weights` is not None.

        Examples
        --------
        >>> Teeth(value=64, range=(63, 65), weights=(1, 3, 0)).probabilities
        {63: Fraction(1, 4), 64: Fraction(3, 4)}
        """
        counts = self.allowed or self.searched
        weights = [Fraction(1)] * len(counts) if self.weights is None else [figure.value for figure in self.weights]
        whole, found = sum(weights), dict.fromkeys(sorted(counts), Fraction(0))
        for count, weight in zip(counts, weights, strict=True):  # a count may be listed twice
            found[count] += weight / whole
        return {count: probability for count, probability in found.items() if probability}

    @property
    def fault_of_weights(self) -> str | None:
        """Reason why the weights do not define probabilities; None if they do."""
        weights = [figure.value for figure in self.weights or ()]
        if any(weight < 0 for weight in weights):
            return "one weight is negative"
        return "all weights are 0" if weights and not any(weights) else None


# ------------------------------------------------------------------------------------------------------------ mechanism


MOST_COPIES = 360  # no carrier has space for more planets


class Source(Declared):
    """Bibliographic source, to which other parts of a declaration refer by its key.

    See Also
    --------
    Train : its field `sources`, by key
    """

    SHORT: ClassVar = {"type": "string"}

    cite: str = Field(description="Bibliographic citation")
    url: str | None = Field(None, description="Address (URL) of the source")
    note: str | None = Field(None, description="Remark on access to the source or its reliability")


HelixAngle = Annotated[
    Angle, not_below_zero("give its magnitude, and its `hand`"), below_right_angle("measure it from the axis")
]
Thickness = Annotated[MeasuredLength, above_zero("give a length such as 2 mm")]
Module = Annotated[Length, above_zero("give a length such as 0.5 mm")]
MaterialDensity = Annotated[Density, above_zero("give a density such as 8.7 g/cm3 (bronze)")]


class Wheel(Declared):
    """Gear wheel of a link. In a declaration, a single number may replace the mapping; it is the tooth count.

    Examples
    --------
    >>> Wheel(teeth=20).count
    20
    >>> doubtful = Wheel(teeth={"value": 64, "range": (64, 66)})
    >>> doubtful.count, doubtful.uncertainty.allowed
    (64, (64, 65, 66))
    """

    SHORT: ClassVar = {"type": "integer", "minimum": 1}

    teeth: Annotated[
        Annotated[Count, Tag("count")] | Annotated[Teeth, Tag("doubt")],
        Discriminator(lambda raw: "doubt" if isinstance(raw, dict | Teeth) else "count"),
    ] = Field(description="Tooth count, or an uncertain count with its range; for a worm, the number of starts")
    internal: Boolean = Field(
        False, description="True for a ring (internal teeth); a mesh with a ring preserves the sense of rotation"
    )
    flexible: Boolean = Field(
        False,
        description="True for the flexible wheel of a strain wave gear, bent radially into its ring by a generator",
    )
    kind: Literal["spur", "bevel", "contrate", "worm"] = Field("spur", description="Kind of wheel")
    facing: Annotated[Literal[1, -1], BeforeValidator(side)] = Field(
        1, description="Side of the axis to which the cone opens: 1 positive, -1 negative (bevel, contrate)"
    )
    helix_angle: HelixAngle | None = Field(
        None,
        description="Helix angle of helical teeth or of a worm's thread, measured from the axis; 0 to less than 90 deg",
    )
    hand: Literal["right", "left"] | None = Field(
        None, description="Hand of helical teeth or of a worm's thread; a worm is right-handed by default"
    )
    module: Module | None = Field(
        None, description="Module, pitch diameter divided by tooth count; for helical teeth the normal module"
    )
    thickness: Thickness | None = Field(
        None, description="Thickness of the wheel along its axis; default from the train"
    )
    density: MaterialDensity | None = Field(None, description="Density of the material; default from the train")
    face_width: FaceWidth | None = Field(
        None, description="Face width (width of the teeth along the axis); default from the train, or the thickness"
    )
    along: MeasuredLength | None = Field(
        None, description="Position of the middle of the teeth along the axis, for bearings with `at`; default 0"
    )
    material: Id | None = Field(
        None,
        description="Name of the material, in the table (docs/strength.md) or in `materials`; default from the train",
    )
    cutting: WheelManufacture | None = Field(
        None, description="Manufacturing errors of the teeth; default from the train"
    )
    status: Status | None = Field(None, description="Status of the wheel: surviving, reconstructed or hypothetical")
    source: str | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")

    @property
    def count(self) -> int | None:
        """Tooth count that is used in computations; None if it is to be determined by a search."""
        return self.teeth if isinstance(self.teeth, int) else self.teeth.value

    @property
    def uncertainty(self) -> Teeth | None:
        """Uncertain tooth count with its range or choices; None if the tooth count is certain."""
        return self.teeth if isinstance(self.teeth, Teeth) and len(self.teeth.allowed) > 1 else None

    @model_validator(mode="after")
    def _check_kind(self) -> Wheel:
        if self.helix_angle is not None and self.kind in ("bevel", "contrate"):
            why = "only spur wheels, rings and worms can have helical teeth"
            raise bad("helix_angle", f"a {self.kind} wheel cannot have a helix angle", "remove `helix_angle`", why)
        if self.flexible and (self.internal or self.kind != "spur"):
            kind = "ring" if self.internal else f"{self.kind} wheel"
            why = "the flexible wheel of a strain-wave gear (flexspline) is a spur wheel in a ring"
            raise bad("flexible", f"a {kind} cannot be flexible", "write `flexible: true` for the spur wheel", why)
        return self

    @property
    def is_helical(self) -> bool:
        """True for an external or internal cylindrical gear with helical teeth; False for worms."""
        return self.kind == "spur" and self.helix_angle is not None and self.helix_angle.value > 0

    @property
    def helix(self) -> float:
        """Helix angle [rad], positive for right-hand teeth; 0 for straight teeth, or if no angle is declared."""
        angle = 0.0 if self.helix_angle is None else self.helix_angle.si
        return -angle if self.hand == "left" else angle

    @property
    def slant(self) -> float:
        """Transverse module divided by normal module, 1 / cos(helix angle); 1 for a wheel without helical teeth."""
        return 1 / cos(self.helix) if self.is_helical else 1.0

    @property
    def transverse_module(self) -> float | None:
        """Pitch diameter divided by tooth count [m]; None if no module with a unit of length is declared."""
        # a module without a unit is only a ratio to other modules
        declared = self.module is not None and self.module.unit is not None
        return self.module.si * self.slant if self.module is not None and declared else None


class Link(Declared):
    """Rigid body of a train: an arbor with its wheels, a carrier, or the frame.

    See Also
    --------
    Train : its field `links`, by name
    """

    SHORT: ClassVar = {"type": "null"}

    wheels: ByName[Annotated[Wheel, short_for("teeth")]] = Field(
        {}, validate_default=True, description="Wheels fixed on this link, by id"
    )
    copies: Annotated[int, Field(le=MOST_COPIES), BeforeValidator(read_count)] = Field(
        1, description="Number of equal links, evenly spaced about the axis of the carrier of this link"
    )
    inertia: Annotated[Inertia, not_below_zero("give an inertia of 0 or more")] | None = Field(
        None,
        description="Moment of inertia about the axis of the link; default computed from "
        "its wheels, if their `density` is given",
    )
    mass: Annotated[Mass, above_zero("give a mass such as 20 g")] | None = Field(
        None,
        description="Mass of a link that slides, is on a moving carrier, or presses on its bearing by `gravity`; "
        "default computed from its wheels, as for `inertia`, and 0 for `gravity`",
    )
    bearing: DeclaredBearing | None = Field(
        None,
        description="Friction torque of the link's bearing, opposed to rotation, or `{sliding, static}`, or "
        "the friction of a loaded pivot, `{coefficient, radius}`; default none",
    )
    drag: (
        Annotated[TorsionalDamping, not_below_zero("give its magnitude: drag is always opposed to the rotation")] | None
    ) = Field(None, description="Coefficient of viscous drag: torque opposed to the rotation per rad/s; default none")
    arbor: ArborSizes | None = Field(
        None, description="Dimensions of the link's arbor between two bearings, for strength calculations"
    )
    angle: Angle | None = Field(None, description="Angle at the start; default follows from the meshes")
    note: str | None = Field(None, description="Remark for readers")

    @property
    def friction_radius(self) -> float:
        """Radius of the friction circle of the bearing [m]; 0 without a friction coefficient.

        It is r mu/sqrt(1 + mu^2) for a pivot of radius r and the friction coefficient mu.
        """
        if self.bearing is None or not self.bearing.coefficient or not self.bearing.coefficient.value:
            return 0.0
        mu, radius = float(self.bearing.coefficient.value), self.bearing.radius
        pivot = None if self.arbor is None else self.arbor.pivot or self.arbor.diameter
        return mu / hypot(1.0, mu) * (radius.si if radius is not None else pivot.si / 2 if pivot is not None else 0.0)

    @property
    def shoulder_friction(self) -> float:
        """Friction torque of the bearing's shoulder divided by the axial force [m]; 0 without a shoulder.

        For a uniform pressure, it is 2/3 mu (r_o^3 - r_i^3)/(r_o^2 - r_i^2), with the friction coefficient mu and the
        outer and inner radius r_o and r_i.
        """
        if self.bearing is None or self.bearing.shoulder is None or self.bearing.coefficient is None:
            return 0.0
        inner, outer = (radius.si for radius in self.bearing.shoulder)
        return 2 / 3 * float(self.bearing.coefficient.value) * (outer**3 - inner**3) / (outer**2 - inner**2)

    @model_validator(mode="after")
    def _check_pivot(self) -> Link:
        rubs = self.bearing is not None and self.bearing.coefficient is not None
        if rubs and self.bearing is not None and self.bearing.radius is None and self.arbor is None:
            fix = "give `radius`, such as `bearing: {coefficient: 0.15, radius: 1.5 mm}`, or the `arbor`"
            why = "the friction torque is proportional to the radius of the pivot"
            raise bad("bearing", "the coefficient of friction of the bearing has no radius", fix, why)
        return self


def _not_zero(direction: tuple[Figure, Figure, Figure]) -> tuple[Figure, Figure, Figure]:
    if not any(figure.value for figure in direction):
        raise bad("axis", "the direction is the zero vector", "give a direction such as [0, 0, 1]")
    return direction


Direction = Annotated[tuple[Figure, Figure, Figure], AfterValidator(_not_zero)]
"""Direction vector, which may have any length greater than 0."""


def unit_vector(direction: Direction) -> Vector:
    """Return a declared direction as a unit vector."""
    top = max(abs(part.value) for part in direction)  # scaled first, because a huge number would overflow as a float
    x, y, z = (float(part.value / top) for part in direction)
    return unit((x, y, z))


class Axis(Declared):
    """Direction and position of an axis. For a moving axis, they refer to the pose in which all angles are 0."""

    direction: Direction = Field(
        (Figure.parse(0), Figure.parse(0), Figure.parse(1)),
        description="Direction vector about which speeds are positive; default [0, 0, 1]",
    )
    position: tuple[Length, Length, Length] | None = Field(
        None, description="Point on the axis, as three lengths; default unknown"
    )
    note: str | None = Field(None, description="Remark for readers")

    @property
    def way(self) -> Vector:
        """Unit vector of the direction of the axis."""
        return unit_vector(self.direction)

    @property
    def point(self) -> Vector | None:
        """Point on the axis [mm]; None if no position is declared."""
        if self.position is None:
            return None
        x, y, z = (float(millimetres(part)) for part in self.position)
        return x, y, z


class Joint(Declared):
    """Turning or sliding pair of two links."""

    pair: tuple[Id, Id] = Field(description="Two links that move relative to each other")
    axis: Id = Field(description="Label of the axis")
    note: str | None = Field(None, description="Remark for readers")


class Revolute(Joint):
    """Turning pair of two links. Turning pairs with the same axis label are coaxial."""

    pair: tuple[Id, Id] = Field(description="Two links that turn about each other")
    axis: Id = Field(description="Label of the axis; equal labels mean coaxial joints")


Revolutes = Annotated[tuple[Revolute, ...], AlsoShort(_JOINT_SCHEMA)]


class Slide(Joint):
    """Sliding pair of two links. Sliding pairs with the same axis label move along the same line."""

    pair: tuple[Id, Id] = Field(description="Two links that slide along each other")
    axis: Id = Field(description="Label of the axis; equal labels mean travel along one line")


Slides = Annotated[tuple[Slide, ...], AlsoShort(_JOINT_SCHEMA)]


class GearPair(Declared):
    """Pair of wheels in mesh. The carrier is derived from the turning pairs, not declared.

    Examples
    --------
    >>> pair = GearPair(pair=("sun", "planet"), efficiency="98 %")
    >>> pair.name, pair.efficiency.backward.base
    ('sun~planet', Fraction(49, 50))
    """

    SHORT: ClassVar = {"type": "string"}

    id: str = Field("", description="Name of the pair; default `first~second`")
    pair: tuple[Id, Id] = Field(description="Ids of the two wheels")
    tooth_form: DeclaredToothForm | None = Field(None, description="Tooth form; default from the train")
    friction: DeclaredFriction | None = Field(
        None,
        description="Coefficient of friction between teeth, `{sliding, static, deviation}`, or a friction law; "
        "default from the train",
    )
    restitution: DeclaredRestitution | None = Field(
        None, description="Coefficient of restitution of tooth impacts, 0 to 1; default from the train"
    )
    stiffness: PairStiffness | None = Field(
        None,
        description="Mesh stiffness: torque on the driven wheel per radian of its deflection, or force along the "
        "line of action per length; default from the train",
    )
    damping: PairDamping | None = Field(
        None,
        description="Mesh damping: torque on the driven wheel per rad/s, or force along the line of action per speed; "
        "default from the train",
    )
    efficiency: DeclaredEfficiency | None = Field(
        None,
        description="Basic efficiency with the carrier fixed, at most 1: a number or a percentage, or "
        "`{forward, backward}`; default computed from friction and tooth form",
    )
    share: Annotated[Figure, above_zero("give a share above 0, or omit it if it is unknown", "a share")] | None = Field(
        None,
        description="Share of the torque of a wheel with several pairs, relative to its other pairs; above 0",
    )
    driver: Id | None = Field(None, description="Id of the driving wheel; default determined from the power flow")
    phase: Figure | None = Field(
        None,
        description="Number of pitches by which a tooth of the first wheel is past the line of centres at angle 0; "
        "default 0",
    )
    fitting: PairMounting | None = Field(None, description="Mounting errors of both axes; default from the train")
    source: str | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")

    @property
    def name(self) -> str:
        """Name of the pair: its declared id, or `first~second`."""
        return self.id or f"{self.pair[0]}~{self.pair[1]}"
