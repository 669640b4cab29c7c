"""Declaration of triangular teeth, and the sizes computed from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from geartrain.errors import Problem
from geartrain.numerics.quantity import RADIANS_PER_TURN, Angle, Figure, Length, bad
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, refused, twice

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.pair_results import PairFigures
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

CLEARANCES = ("clearance_factor", "excess", "backlash", "centre_distance", "window")
"""Parameters of which exactly one must be given to define the clearance."""
_ONE_OR_TWO = {
    "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}]
}
FEWEST = 3
_MAXIMUM_QUOTIENT = 10  # maximum factor between the ratio of radii and the ratio of tooth numbers
_THINNEST = 0.001 / 360  # turn: the valleys of thinner teeth vanish in rounding
TRIANGULAR_SCOPE = (
    "the model covers pairs of spur wheels, and a spur wheel in a ring; a contrate wheel is treated as a spur wheel"
)


class Triangular(ToothForm):
    """Triangular teeth, as in ancient gearing: straight flanks that meet in an apex.

    The speed ratio varies within each pitch, and impacts occur at the changeover between tooth pairs (docs/teeth.md; F.
    Sorge, "A note on the mechanics of ancient gear systems"). The centre distance is given by exactly one of five
    parameters: `clearance_factor`, `excess`, `backlash`, `centre_distance` or `window`.

    See Also
    --------
    geartrain.teeth.Involute : Teeth with a constant speed ratio.

    Examples
    --------
    >>> transmission = Triangular(form="triangular", half_angle="30 deg", window="0.5").transmission(48, 96, 0.2)
    >>> transmission.verdict.text, transmission.ratio, [round(speed, 4) for speed in transmission.speed_range()]
    ('the wheels turn', Fraction(1, 2), [0.457, 0.5392])
    >>> round(transmission.efficiency_mean(), 4)
    0.9681
    """

    any_distance: ClassVar[bool] = True

    form: Literal["triangular"] = Field(description="Name of the tooth form")
    half_angle: Annotated[tuple[Angle, Angle], BeforeValidator(twice), WithJsonSchema(_ONE_OR_TWO)] = Field(
        description="Half aperture angle of a tooth, between 0 and 90 deg; a list of two gives one for each wheel"
    )
    clearance_factor: Figure | None = Field(
        None,
        description="Centre distance divided by the distance at which a tip touches the bottom of a space: above 1, or "
        "below 1 with a ring",
    )
    excess: Figure | None = Field(
        None, description="Excess of the clearance factor over 1, above 0; in a ring, 1 minus the clearance factor"
    )
    backlash: Length | None = Field(
        None, description="Minimum backlash over a pitch, as an arc of the second wheel's pitch circle"
    )
    centre_distance: Length | None = Field(None, description="Centre distance of the pair")
    window: Figure | None = Field(
        None, description="Position in the clearance window, from jamming (0) to loss of contact (1)"
    )
    radii: Literal["equal_depth", "pitch_true"] | tuple[Length, Length] | Figure | None = Field(
        None,
        description="Rule for the tip radii, the two radii themselves, or one number: the ratio of the second radius "
        "to the first divided by the ratio of their tooth numbers (1 is pitch_true). Default equal_depth, or "
        "pitch_true with a ring",
    )

    @model_validator(mode="after")
    def _parameters_make_sense(self) -> Triangular:
        for angle in self.half_angle:
            turns = angle.si / RADIANS_PER_TURN
            if not _THINNEST <= turns < 0.25:
                within = "outside 0 to 90 deg" if not 0 < turns < 0.25 else "too small for a tooth to be cut"
                fix = "give a half aperture angle between 0 and 90 deg, at least 0.001 deg"
                raise bad("half_angle", f"half_angle {angle.text} is {within}", fix)
        given = [name for name in CLEARANCES if getattr(self, name) is not None]
        if len(given) != 1:
            fix = f"give exactly one of: {', '.join(CLEARANCES)}"
            raise bad("clearance", f"the clearance is given {len(given)} times", fix)
        self._check_clearance()
        self._check_lengths()
        return self

    def _check_clearance(self) -> None:
        bounds = (
            ("clearance_factor", inf, "give a clearance factor above 1, or between 0 and 1 with a ring"),
            ("excess", inf, "give an excess above 0; at 0 a tip touches the bottom of a space"),
            ("window", 1, "give a fraction between 0 (jamming) and 1 (loss of contact)"),
        )
        for name, most, fix in bounds:
            figure = getattr(self, name)
            # a position in the window may be 0
            if figure is not None and not (0 <= figure.value <= most and (figure.value or name == "window")):
                raise bad("clearance", f"{name} {figure.text} is out of range", fix)

    def _check_lengths(self) -> None:
        if isinstance(self.radii, Figure) and not 1 / _MAXIMUM_QUOTIENT <= self.radii.value <= _MAXIMUM_QUOTIENT:
            fix = "give the ratio of the radii divided by the ratio of the tooth numbers, near 1"
            raise bad("radii", f"a ratio of radii of {self.radii.text} is out of range", fix)
        lengths = {"backlash": self.backlash, "centre_distance": self.centre_distance}
        lengths |= dict(zip(("first radius", "second radius"), self._given_radii, strict=False))
        given = {name: length for name, length in lengths.items() if length is not None}
        for name, length in given.items():
            if length.value < 0 or (name != "backlash" and length.value == 0):
                raise bad("length", f"{name} {length.text} is out of range", "give a length above 0")
        if len({length.unit is None for length in given.values()}) > 1:
            what = f"{', '.join(given)} mix numbers without a unit and lengths with a unit"
            raise bad("length", what, "give all lengths with a unit, or all without one")

    @classmethod
    def with_defaults(cls, parameters: Mapping[str, Any]) -> dict[str, Any]:
        """Return the parameters, supplemented by defaults: equilateral teeth in the middle of the clearance window."""
        placed = {} if any(name in parameters for name in CLEARANCES) else {"window": "0.5"}
        return {"half_angle": "30 deg", **placed, **parameters}

    @property
    def has_lengths(self) -> bool:
        """True if a length of the form is declared with a unit."""
        lengths = (self.centre_distance, self.backlash, *self._given_radii)
        return any(length is not None and length.unit for length in lengths)

    @property
    def _given_radii(self) -> tuple[Length, ...]:
        """Tip radii if they are given as lengths; an empty tuple if they are not."""
        return self.radii if isinstance(self.radii, tuple) else ()

    def in_metres(self, module: float | None) -> bool:
        """Return True if the lengths of `sizes` are in metres.

        Parameters
        ----------
        module : float or None
            Module of both wheels [m].

        Returns
        -------
        bool
            True if lengths with a unit are declared, or radii follow from a module.
        """
        return self.has_lengths or (module is not None and not isinstance(self.radii, Figure | tuple))

    # ------------------------------------------------------------------------------------------------------- a pair

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """Return the class of the results of this tooth form, which include clearance, path of contact and impacts."""
        from geartrain.teeth.triangular.triangular_mesh import TriangularFigures

        return TriangularFigures

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """Return the mesh of a pair, with its first wheel driving.

        A contrate wheel is treated as a spur wheel. Raises `GearTrainError` for all other kinds of wheels, and for a
        contrate wheel with a ring gear.
        """
        from geartrain.teeth.triangular.triangular_mesh import TriangularMesh

        del shaft_angle
        ring = any(wheels.internal)
        if odd := [kind for kind in wheels.kinds if kind not in (("spur",) if ring else ("spur", "contrate"))]:
            how = "with a ring as a spur wheel does" if ring else "as two spur wheels do"
            why = f"a {odd[0]} wheel does not mesh {how}; {TRIANGULAR_SCOPE}"
            raise refused("these wheels cannot have triangular teeth", why, IDEAL)
        transmission = self.transmission(
            *wheels.counts, wheels.friction or 0.0, pitch_distance=wheels.pitch_distance, ring=wheels.ring
        )
        return TriangularMesh(wheels, self, wheels.driver, transmission)

    def own_backlash(self, pair: str) -> Problem:
        """Return the reason why `--backlash` does not apply: clearance determines the backlash of triangular teeth."""
        return Problem(
            f"--backlash cannot thin the triangular teeth of pair '{pair}'",
            "the clearance factor sets their backlash, and thinner teeth have another transmission function",
            "omit --backlash, or declare a larger clearance factor in the file",
        )

    def sizes(
        self, z1: int, z2: int, pitch_distance: float | None = None, ring: Literal[0, 1, 2] = 0
    ) -> TriangularSizes:
        """Return tip radii, half angles of the teeth and clearance of a pair.

        Parameters
        ----------
        z1, z2 : int
            Tooth numbers of the first and of the second wheel, 3 or more. The first wheel drives.
        pitch_distance : float, optional
            Half the module times the sum of the tooth numbers, or times the difference for a ring gear [m]. It becomes
            the centre distance at which a tip touches the bottom of a space.
        ring : {0, 1, 2}
            Number of the wheel that is a ring gear; 0 for an external pair.

        Returns
        -------
        TriangularSizes
            Sizes with lengths in m. If no length with a unit is given, they are in the unit of the declared radii, or
            relative to the tip radius.

        Raises
        ------
        GearTrainError
            If the declaration does not define a pair that can be built.
        """
        for z in (z1, z2):
            if z < FEWEST:
                what = f"a wheel of {z} {'tooth' if z == 1 else 'teeth'} cannot have triangular teeth"
                why, fix = "flanks of fewer teeth do not meet in valleys", f"give at least {FEWEST} teeth"
                raise refused(what, why, f"{fix}, or another tooth_form")
        outer, inner = (z1, z2) if ring == 1 else (z2, z1)
        if ring and outer <= inner:
            what = f"a ring of {outer} teeth cannot contain a wheel of {inner} teeth"
            raise refused(what, "it needs at least one tooth more than its pinion", "give the ring more teeth")
        sizes = self._sizes_at_deepest(z1, z2, ring)
        # less distance only makes an overlap worse, and the backlash of such teeth is undefined
        sizes = sizes if sizes.surrounds else self._sizes_at_clearance(sizes, pitch_distance)
        # the clearance reduces the centre distance of an internal pair, which may make the circles overlap
        if sizes.surrounds:
            at = f"at the centre distance {sizes.D:.6g}"
            why = f"the tip circle of the ring is inside the tip circle of its wheel {at}"
            fix = "use a larger radius of the ring, such as `radii: pitch_true`, or less clearance"
            raise refused("the teeth overlap at every angle", why, fix)
        return sizes

    def _sizes_at_deepest(self, z1: int, z2: int, ring: Literal[0, 1, 2]) -> TriangularSizes:
        """Return the sizes of the wheels at the centre distance at which a tip touches the bottom of a tooth space."""
        from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth, pitch_true

        beta1, beta2 = (angle.si for angle in self.half_angle)
        radii = self.radii or ("pitch_true" if ring else "equal_depth")
        if radii == "pitch_true":
            R1, R2 = pitch_true(z1, z2)
        elif radii == "equal_depth":
            R1, R2 = equal_depth(z1, z2, beta1, beta2, ring)
        elif isinstance(radii, Figure):
            R1, R2 = 1.0, float(radii.value) * z2 / z1
        else:
            R1, R2 = (radius.si for radius in radii)
        return TriangularSizes(z1, z2, R1, R2, beta1, beta2, 0.0, ring)

    def _sizes_at_clearance(self, sizes: TriangularSizes, pitch_distance: float | None) -> TriangularSizes:
        """Return the sizes of the wheels at the declared clearance. Lengths are in m if a pitch distance is given."""
        from geartrain.teeth.triangular.clearance_window import excess_of_backlash

        if not sizes.has_valleys:
            return sizes.at(self._declared_excess(sizes))
        if not self._given_radii and pitch_distance is not None:
            scale = pitch_distance / sizes.deepest_distance
            sizes = replace(sizes, R1=sizes.R1 * scale, R2=sizes.R2 * scale)
        if self.clearance_factor is not None or self.excess is not None:
            return sizes.at(self._declared_excess(sizes))
        if self.window is not None:
            window = sizes_window(sizes)
            return sizes.at(window.at(float(self.window.value)))
        length = self.centre_distance or self.backlash
        assert length is not None
        if not self._given_radii and (pitch_distance is None or length.unit is None):
            what = f"the length {length.text} cannot be related to the size of these wheels"
            fix = "give `radii: [first, second]` or the `module` of both wheels, or the clearance as a factor"
            raise refused(what, "neither radii nor modules with a unit are declared", fix)
        if self.centre_distance is not None:
            return sizes.at(sizes.side * (self.centre_distance.si / sizes.deepest_distance - 1))
        return sizes.at(excess_of_backlash(sizes, length.si, length.text))

    def _declared_excess(self, sizes: TriangularSizes) -> float:
        """Return the declared excess, computed exactly, then rounded. Raise `GearTrainError` if it is not positive."""
        if self.excess is not None or self.clearance_factor is None:
            return 0.0 if self.excess is None else float(self.excess.value)
        # a fraction minus 1 is exact, so that a factor close to 1 loses no digits
        excess = sizes.side * (self.clearance_factor.value - 1)
        if excess <= 0:
            deepest = "maximum, in a ring" if sizes.ring else "minimum"
            what = f"a clearance factor of {self.clearance_factor.text} presses a tip into the bottom of a space"
            why = f"the centre distance at which a tip touches the bottom is the {deepest}"
            raise refused(what, why, f"give a factor {'below' if sizes.ring else 'above'} 1, or `excess`")
        return float(excess)

    def transmission(
        self,
        z1: int,
        z2: int,
        friction: float = 0.0,
        driver: int = 1,
        direction: int = 1,
        pitch_distance: float | None = None,
        ring: Literal[0, 1, 2] = 0,
    ) -> TriangularTransmission:
        """Return the transmission function of a pair.

        Parameters
        ----------
        z1, z2 : int
            Tooth numbers of the first and of the second wheel, 3 or more.
        friction : float
            Coefficient of friction, 0 or more.
        driver : {1, 2}
            Number of the driving wheel.
        direction : {1, -1}
            Direction of rotation; with -1 the coast flanks are in contact.
        pitch_distance : float, optional
            Same as in `sizes` [m].
        ring : {0, 1, 2}
            Number of the wheel that is a ring gear; 0 for an external pair.

        Returns
        -------
        TriangularTransmission
            Transmission function. Its `verdict` reports whether the pair can turn.

        Raises
        ------
        GearTrainError
            If the declaration does not define a pair that can be built.
        """
        from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

        sizes = self.sizes(z1, z2, pitch_distance, ring)
        return TriangularTransmission(sizes if driver == 1 else sizes.swapped(), friction, direction)


def sizes_window(sizes: TriangularSizes) -> ClearanceWindow:
    """Return the clearance window of a pair. Raises `GearTrainError` if the pair does not turn at any clearance."""
    from geartrain.teeth.triangular.clearance_window import find_window
    from geartrain.teeth.triangular.triangular_mesh import OTHER_SHAPES

    window = find_window(sizes)
    if not window:
        what = f"no clearance lets wheels of {sizes.z1} and {sizes.z2} triangular teeth turn"
        below = f"up to a clearance factor of {window.jam_factor:.6g} the verdict is {window.jam_kind}"
        why = f"{below}, and from {window.run_factor:.6g} on it is {window.run_kind}"
        raise refused(what, why, OTHER_SHAPES[bool(sizes.ring)])
    return window
