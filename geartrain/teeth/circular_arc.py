"""Circular-arc clock teeth after British Standard 978, Part 2: radial flanks under tips that consist of circular arcs.

The wheel's addendum f is derived from the epicycloid that the arc replaces. A circle with half the diameter of the
pinion's pitch circle rolls on the wheel's pitch circle. The epicycloid and its mirror image over a tooth half a pitch
thick intersect f_a modules above the pitch circle. For z leaves and ratio u, in units of the rolling circle's radius,
with k = 1 + 2 u,

    t = pi / z + 2 u b,   tan b = sin t / (k - cos t),   f_a = z / 4 (sqrt(1 + k^2 - 2 k cos t) - 2 u).

The tip is 0.95 f_a modules above the pitch circle, and the arc has a radius of 1.40 f_a modules. The arc passes through
the end of the tooth's thickness on the pitch circle and through the tip on the centre line of the tooth. The flank
below is the tangent to the arc from the axis of the wheel. The leaves of a pinion are thinner than half a pitch; the
teeth of a wheel are exactly half a pitch thick.

Sources: the iteration is H. Sparks's, "Designing Cycloidal Gears" (2013), who found it to agree with the standard's
tables. The tables of f = 0.95 f_a and of the radius for the wheel, the three profiles of leaves and the tangent flank
are as M. Robinson's OpenSCAD library (2016) transcribes them from the standard; the standard itself was not at hand.
The depth of the leaves, which is the wheel's addendum and 0.4 modules, is Sparks's.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import asin, atan2, cos, hypot, pi, sin, sqrt, tan
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field, model_validator

from geartrain.numerics.quantity import Length, bad
from geartrain.teeth.outlines.wheel_requirement import FixedTooth
from geartrain.teeth.tooth_form import (
    IDEAL,
    ShaftAngle,
    ToothForm,
    TwoFigures,
    check_above_0,
    check_one_of,
    in_modules,
    number_of_wheel,
    refused,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact.gear_outline import GearOutline
    from geartrain.teeth.contact.outline_transmission import OutlineGears, OutlineTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.outlines.tooth_outline import Vertex

_PRACTICAL, _ARC = 0.95, 1.40  # addendum of a wheel and radius of its arc, divided by f_a
_BOTTOM = 0.4  # modules: bottom clearance, depth of a space less addendum of the mate
_FEWEST, _MOST_TEETH = 5, 10_000
_THIN = {False: 1.05, True: 1.25}  # modules: thickness of leaves, up to and above ten leaves
_LEAVES = {  # addendum and radius of the arc (modules) by profile, up to and above ten leaves
    "A": {False: (0.525, 0.525), True: (0.625, 0.625)},
    "B": {False: (0.67, 0.70), True: (0.805, 0.84)},
    "C": {False: (0.855, 1.05), True: (1.05, 1.25)},
}
_SCOPE = "circular-arc teeth are for external pairs of spur wheels; a contrate wheel is treated as a spur wheel"


def addendum_factor(z: int, ratio: float) -> float:
    """Return the factor f_a of a wheel's addendum [module]: the height above the pitch circle at which the epicycloid
    intersects its mirror image.

    The wheel drives a pinion of `z` leaves; `ratio` is the wheel's tooth count divided by the pinion's. The equations
    in the module's docstring are solved by fixed-point iteration, which converges for all tooth counts.
    """
    k, b, t = 1 + 2 * ratio, 0.0, 0.0
    # the count is only an upper limit, since the loop ends when t no longer changes
    for _ in range(200):
        last, t = t, pi / z + 2 * ratio * b
        b = atan2(sin(t), k - cos(t))
        # t is below pi, so a step this small is rounding error
        if abs(t - last) <= 1e-16:
            break
    return z / 4 * (sqrt(1 + k * k - 2 * k * cos(t)) - 2 * ratio)


class CircularArc(ToothForm):
    """Circular-arc clock teeth of BS 978 Part 2: radial flanks, ogival tips and thin leaves.

    The teeth are not conjugate. Transmission error, backlash and efficiency are computed from the contact of the
    outlines (docs/shapes.md).

    See Also
    --------
    geartrain.teeth.Cycloidal : the teeth that the arcs approximate.

    Examples
    --------
    A wheel of 60 teeth and a pinion of 8 leaves: thickness, addendum and radius of the arcs, in modules.

    >>> wheel, pinion = CircularArc(form="circular_arc").teeth(60, 8)
    >>> round(wheel.thickness, 3), round(wheel.addendum, 3), round(wheel.radius, 3)
    (1.571, 1.471, 2.168)
    >>> pinion.thickness, pinion.addendum, pinion.radius
    (1.05, 0.67, 0.7)
    """

    any_distance: ClassVar[bool] = True
    own_play: ClassVar[tuple[str, ...]] = ("backlash", "thickness")

    form: Literal["circular_arc"] = Field(description="Name of the tooth form")
    pinion: Annotated[Literal[1, 2], BeforeValidator(number_of_wheel)] | None = Field(
        None,
        description="Number of the wheel that is the pinion, 1 or 2; default the wheel with fewer teeth, "
        "or the second wheel if the tooth counts are equal",
    )
    leaf: Literal["A", "B", "C"] | None = Field(
        None,
        description="Tip profile of the leaves: A round, B and C pointed; default C up to 7 leaves, B for 8 and 9, A "
        "from 10",
    )
    addendum: TwoFigures | None = Field(
        None,
        description="Addendum in modules, one value, or a list of two (first, second wheel); default as in the "
        "standard",
    )
    radius: TwoFigures | None = Field(
        None,
        description="Radius of the tip arcs in modules, one value, or a list of two (first, second wheel); default "
        "as in the standard",
    )
    thickness: TwoFigures | None = Field(
        None,
        description="Tooth thickness on the pitch circle in modules, one value, or a list of two (first, second "
        "wheel); default as in the standard",
    )
    backlash: Length | None = Field(
        None,
        description="Minimum backlash on the pitch circle, in modules or with a unit; "
        "the leaves are thinned if their backlash is smaller; default as in the standard",
    )
    centre_distance: Length | None = Field(
        None, description="Centre distance, in modules or with a unit; default half the sum of the tooth numbers"
    )

    @model_validator(mode="after")
    def _check_parameters(self) -> CircularArc:
        check_above_0(self, "length", "addendum", "radius", "thickness", "centre_distance")
        check_one_of(self, "backlash", "thickness", "backlash")
        if self.backlash is not None and not self.backlash.value >= 0:
            raise bad("backlash", f"a backlash of {self.backlash.text} would jam the teeth", "give 0 or more")
        return self

    # ----------------------------------------------------------------------------------------------- teeth of a pair

    def teeth(self, z1: int, z2: int, module: float | None = None) -> tuple[ArcTooth, ArcTooth]:
        """Return the tooth shapes of both wheels.

        Parameters
        ----------
        z1, z2 : int
            Numbers of teeth of the first and of the second wheel, 5 to 10000.
        module : float, optional
            Module [m], required for lengths that are declared with a unit.

        Returns
        -------
        tuple of ArcTooth
            Tooth shapes of the first and of the second wheel; lengths in modules.

        Raises
        ------
        GearTrainError
            If no tooth with these sizes exists.
        """
        for z in (z1, z2):
            if not _FEWEST <= z <= _MOST_TEETH:
                why = f"the model covers {_FEWEST} to {_MOST_TEETH} circular-arc teeth (BS 978 begins at 6 leaves)"
                raise refused(f"a wheel of {z} teeth cannot have circular-arc teeth", why, IDEAL)
        pinion = self.pinion or (1 if z1 < z2 else 2)
        zp, zw = (z1, z2) if pinion == 1 else (z2, z1)
        factor, many = addendum_factor(zp, zw / zp), zp > 10
        profile = self.leaf or ("C" if zp <= 7 else "B" if zp <= 9 else "A")
        sizes: list[tuple[float, ...]] = [
            (pi / 2, _PRACTICAL * factor, _ARC * factor),
            (_THIN[many], *_LEAVES[profile][many]),
        ]
        if self.backlash is not None:
            # a thinner leaf keeps the shape of its tip; the two thicknesses of the standard do so within a few percent
            thickness = min(_THIN[many], pi / 2 - in_modules(self.backlash, module, "backlash"))
            sizes[1] = tuple(size * thickness / _THIN[many] for size in sizes[1])
        declared = (self.thickness, self.addendum, self.radius)
        found = [
            tuple(own if both is None else float(both[at].value) for own, both in zip(usual, declared, strict=True))
            for at, usual in enumerate(sizes if pinion == 2 else sizes[::-1])
        ]
        made = []
        for at, z in enumerate((z1, z2)):
            thickness, addendum, radius = found[at]
            # a wheel is cut half a pitch deep, or deeper if the tips of its mate need it
            deep = found[1 - at][1] + _BOTTOM
            tooth = ArcTooth(z, thickness, addendum, radius, deep if at + 1 == pinion else max(deep, pi / 2))
            if not tooth.fits:
                sizes_text = f"{thickness:.4g} modules thick and {addendum:.4g} high with arcs of radius {radius:.4g}"
                why = "the arc must rise from the pitch circle to the tip and leave a flank below it"
                fix = "remove `addendum`, `radius` and `thickness`, or give a larger radius or a smaller thickness"
                raise refused(f"circular-arc teeth of a wheel of {z} cannot be {sizes_text}", why, fix)
            made.append(tooth)
        return made[0], made[1]

    def distance(self, z1: int, z2: int, module: float | None = None) -> float:
        """Return the centre distance of a pair.

        Parameters
        ----------
        z1, z2 : int
            Numbers of teeth of both wheels.
        module : float, optional
            Module [m], required for a distance that is declared with a unit.

        Returns
        -------
        float
            Declared centre distance, by default half the sum of the tooth numbers [module].
        """
        if self.centre_distance is None:
            return (z1 + z2) / 2
        return in_modules(self.centre_distance, module, "centre_distance")

    def transmission(
        self, z1: int, z2: int, friction: float = 0.0, driver: int = 1, direction: int = 1, module: float | None = None
    ) -> OutlineTransmission:
        """Return the transmission function of a pair, computed from the contact of the outlines.

        Parameters
        ----------
        z1, z2 : int
            Numbers of teeth of the first and of the second wheel.
        friction : float
            Coefficient of friction, 0 or more.
        driver : {1, 2}
            Number of the driving wheel.
        direction : {1, -1}
            Direction of rotation; with -1 the coast flanks are in contact.
        module : float, optional
            Module [m], required for lengths that are declared with a unit.

        Returns
        -------
        OutlineTransmission
            Transmission function. Its `verdict` reports whether the pair can turn.

        Raises
        ------
        GearTrainError
            If no tooth with these sizes exists.
        """
        from geartrain.teeth.contact.outline_transmission import OutlineTransmission

        gears = _gears(*self.teeth(z1, z2, module), self.distance(z1, z2, module))
        return OutlineTransmission(gears, friction, driver, direction)

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """Return the mesh of a pair on parallel axes, with the first wheel driving.

        Raises `GearTrainError` for ring gears, and for wheels that are neither spur nor contrate.
        """
        from geartrain.teeth.contact.outline_mesh import OutlineMesh

        del shaft_angle
        odd = [kind for kind in wheels.kinds if kind not in ("spur", "contrate")]
        if odd or any(wheels.internal):
            raise refused(f"a {f'{odd[0]} wheel' if odd else 'ring'} cannot have circular-arc teeth", _SCOPE, IDEAL)
        transmission = self.transmission(*wheels.counts, wheels.friction or 0.0, module=wheels.module)
        teeth = self.teeth(*wheels.counts, wheels.module)
        cut = [FixedTooth("external", each.tip, each.root, tuple(each.vertices())) for each in teeth]
        return OutlineMesh(wheels, self, wheels.driver, transmission, (cut[0], cut[1]))


@lru_cache(maxsize=256)
def _gears(first: ArcTooth, second: ArcTooth, distance: float) -> OutlineGears:
    """Return the outlines of both wheels at a centre distance [module]. Equal pairs of a train share one result."""
    from geartrain.teeth.contact.outline_transmission import OutlineGears

    # sum of half the thicknesses of both wheels; what remains of a pitch of pi modules is the backlash
    mean = (first.thickness + second.thickness) / 2
    return OutlineGears(first.outline(), second.outline(), distance, mean, pi - 2 * mean)


# ---------------------------------------------------------------------------------------------------------------- tooth


@dataclass(frozen=True, slots=True)
class ArcTooth:
    """Sizes of one circular-arc tooth [module] with radial flanks and a tip that consists of two equal arcs."""

    z: int
    """Number of teeth of the wheel."""
    thickness: float
    """Thickness of a tooth along the pitch circle [module]."""
    addendum: float
    """Height of the tip above the pitch circle [module]."""
    radius: float
    """Radius of the two arcs of the tip [module]."""
    dedendum: float
    """Depth of the root below the pitch circle [module]."""

    @property
    def tip(self) -> float:
        """Radius of the tip circle of the wheel [module]."""
        return self.z / 2 + self.addendum

    @property
    def root(self) -> float:
        """Radius of the root circle of the wheel [module]."""
        return self.z / 2 - self.dedendum

    @property
    def centre(self) -> tuple[float, float]:
        """Centre (x, y) of the arc on the half of the tooth with positive x [module].

        The centre line of the tooth is the y axis. For a pointed tip the centre has a negative x.
        """
        half = self.thickness / self.z
        x, y = self.z / 2 * sin(half), self.z / 2 * cos(half)
        chord = hypot(x, self.tip - y)
        # on the perpendicular bisector of the chord; `far` is its distance from the chord divided by the chord's length
        far = sqrt(self.radius**2 - chord**2 / 4) / chord
        return x / 2 - far * (self.tip - y), (self.tip + y) / 2 - far * x

    @property
    def fits(self) -> bool:
        """True if a tooth with these sizes exists.

        The arc must extend from the pitch circle to the tip, rise monotonically, and leave a flank between the arc and
        the root circle.
        """
        half = self.thickness / self.z
        chord = hypot(self.z / 2 * sin(half), self.tip - self.z / 2 * cos(half))
        if 2 * self.radius < chord or not 0 < half < pi / self.z:
            return False
        x, y = self.centre
        start, lean = self.flank
        # the centre of a round tip is on the centre line of the tooth, within the three digits of printed sizes
        return x <= 1e-3 * self.radius and hypot(x, y) > self.radius and self.root < start and 0 < lean < pi / self.z

    @property
    def flank(self) -> tuple[float, float]:
        """Radius at which the radial flank ends [module], and angle of the flank from the tooth's centre line [rad]."""
        x, y = self.centre
        far = hypot(x, y)
        # length and direction of the tangent from the axis of the wheel to the arc
        return sqrt(far**2 - self.radius**2), atan2(x, y) + asin(self.radius / far)

    def outline(self) -> GearOutline:
        """Return the outline of the whole wheel that is used to compute contact."""
        import numpy as np

        from geartrain.teeth.contact.gear_outline import GearOutline, OutlineCurve, ToothFlanks

        (start, lean), (cx, cy), radius = self.flank, self.centre, self.radius
        way = np.array([sin(lean), cos(lean)])
        # angles on the arc, measured from the x axis towards the y axis
        low, high = atan2(start * way[1] - cy, start * way[0] - cx), atan2(self.tip - cy, -cx)

        def arc(turn: Floats) -> Floats:
            return np.stack([cx + radius * np.cos(turn), cy + radius * np.sin(turn)], axis=1)

        side = (OutlineCurve(lambda r: r[:, None] * way, self.root, start), OutlineCurve(arc, low, high))
        return GearOutline((ToothFlanks.symmetric(side),), self.z)

    def vertices(self) -> Iterator[Vertex]:
        """Yield the vertices (x, y, bulge) of one tooth from root to root [module]. The tooth's centre line is the x
        axis.

        The bulge of an edge is the tangent of a quarter of the angle of its arc, so that circular arcs are exact.
        """
        (start, lean), (cx, cy) = self.flank, self.centre
        sweep = atan2(self.tip - cy, -cx) - atan2(start * cos(lean) - cy, start * sin(lean) - cx)
        along, across = cos(lean), sin(lean)
        yield self.root * along, -self.root * across, 0.0
        yield start * along, -start * across, tan(sweep / 4)
        yield self.tip, 0.0, tan(sweep / 4)
        yield start * along, start * across, 0.0
        # the last edge is the bottom land, an arc about the axis up to the flank of the next tooth
        yield self.root * along, self.root * across, tan((pi / self.z - lean) / 2)
