"""Cycloidal teeth: epicycloids outside and hypocycloids inside the pitch circles, by two rolling circles."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, ClassVar, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import Figure, bad
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, arcs_of, check_arcs
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import TwoFigures, TwoLengths, check_above_0, check_one_of, refused

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_HALF = Figure.parse("1/2")


class Cycloidal(ConjugateToothForm):
    """Cycloidal teeth, as in clocks, by default with a radial dedendum.

    The profile is an epicycloid outside the pitch circle and a hypocycloid inside. One rolling circle generates the
    addendum of one wheel and the dedendum of the other (docs/shapes.md).

    See Also
    --------
    geartrain.teeth.Lantern : pins instead of the teeth of one wheel.

    Examples
    --------
    >>> transmission = Cycloidal(form="cycloidal").transmission(8, 60)
    >>> transmission.verdict.text, transmission.ratio, transmission.path.contact_ratio
    ('the teeth run', Fraction(2, 15), 1.0)
    """

    own_play: ClassVar[tuple[str, ...]] = ("thickness", "backlash")

    form: Literal["cycloidal"] = Field(description="Name of the tooth form")
    rolling: TwoLengths | None = Field(
        None,
        description="Radius of the rolling circle in modules or with a unit, one value, or a list of two (approach, "
        "recess); default from rolling_fraction",
    )
    rolling_fraction: TwoFigures | None = Field(
        None,
        description="Radius of the rolling circle divided by the pitch radius of the wheel whose dedendum it generates "
        "(with a ring, of the pinion), one value, or a list of two (approach, recess); default 1/2, radial flanks",
    )
    arcs: TwoFigures | None = Field(
        None, description="Arcs of contact in pitches, one value, or a list of two (approach, recess); default 1/2 each"
    )
    addendum: TwoFigures | None = Field(
        None,
        description="Addendum in modules, instead of arcs, one value, or a list of two (first, second wheel); 0 for "
        "none",
    )
    thickness: TwoFigures | None = Field(
        None,
        description="Tooth thickness on the pitch circle in modules, instead of backlash, one value, or a list of two "
        "(first, second wheel); BS 978 has pi/2 for wheels and 1.05 for leaves",
    )

    @model_validator(mode="after")
    def _check_parameters(self) -> Cycloidal:
        check_one_of(self, "rolling", "rolling", "rolling_fraction")
        check_above_0(self, "rolling", "rolling", "rolling_fraction")
        if any(figure.value >= 1 for figure in self.rolling_fraction or ()):
            what = "a rolling circle as large as the pitch circle or larger generates no dedendum"
            fix = "give a fraction below 1 (1/2 makes radial flanks, and a larger fraction undercut flanks)"
            raise bad("rolling", what, fix)
        if self.thickness is not None:
            check_one_of(self, "backlash", "thickness", "backlash")
            check_above_0(self, "length", "thickness")
            if (both := sum(float(each.value) for each in self.thickness)) > pi:
                fix = f"give thicknesses with a sum of at most {pi:.6g} modules"
                raise bad("length", f"thicknesses of {both:.6g} modules in total exceed the pitch", fix)
        check_one_of(self, "arcs", "arcs", "addendum")
        if self.arcs is not None:
            check_arcs(self.arcs)
        heights = [height.value for height in self.addendum or ()]
        if heights and (min(heights) < 0 or not any(heights)):
            fix = "give addenda of 0 or more modules, not 0 for both wheels"
            raise bad("height", "an addendum is negative, or both are 0", fix)
        return self

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design centre distance."""
        from geartrain.teeth.conjugate.closed_form_sides import cycloid
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        pitch = wheels.pitch
        circles = self._circles(pitch, wheels)
        arcs = self._arcs(pitch, circles)
        approach, recess = (cycloid(pitch, X, rho) for X, rho in zip(arcs, circles, strict=True))
        path = PathOfContact(pitch, approach, recess)
        if self.thickness is None:
            return self._standard(path, wheels)
        first, second = (float(each.value) / 2 * pitch.p / pi for each in self.thickness)
        return ConjugatePair(path, (first, second))

    def _circles(self, pitch: PitchSurfaces, wheels: WheelPair) -> tuple[float, float]:
        """Return the radii of both rolling circles [module]; for bevel gears, half-angles of rolling cones [rad]."""
        if self.rolling is not None:
            if wheels.bevel:
                what, why = "`rolling` does not apply to bevel pairs", "their rolling circles are cones"
                raise refused(what, why, "give `rolling_fraction` instead")
            first, second = (wheels.modules(length, "rolling circle") for length in self.rolling)
            return first, second
        first, second = (float(figure.value) for figure in self.rolling_fraction or (_HALF, _HALF))
        # the dedendum of gear 1 works in approach, of gear 2 in recess; with a ring, both circles refer to the pinion
        return first * pitch.R1, second * (pitch.R1 if wheels.internal else pitch.R2)

    def _arcs(self, pitch: PitchSurfaces, circles: tuple[float, float]) -> tuple[float, float]:
        if self.addendum is None:
            return arcs_of(self.arcs or (_HALF, _HALF), pitch)
        # contact begins at the tip of the driven wheel and ends at the tip of the driver
        heights = tuple(figure.value for figure in reversed(self.addendum))
        found = [
            _arc_of_addendum(pitch, R, z, rho, height)
            for R, z, rho, height in zip((pitch.R2, pitch.R1), (pitch.z2, pitch.z1), circles, heights, strict=True)
        ]
        return found[0], found[1]


def _arc_of_addendum(pitch: PitchSurfaces, R: float, z: float, rho: float, height: Fraction) -> float:
    """Return the arc of contact on the pitch surfaces [module; rad for bevel gears] that ends at the tip of an
    addendum. `R` and `rho` are radii of pitch circle and rolling circle, or half-angles of their cones; `height` is the
    addendum in modules.
    """
    from math import asin, sin

    from geartrain.teeth.conjugate.closed_form_sides import circle_reach, cone_reach
    from geartrain.teeth.conjugate.involute_geometry import cone_height

    if pitch.bevel:
        d, size = cone_reach(R, rho, R + cone_height(R, z, float(height))), sin(rho)
        # arcs of a small circle on the sphere follow the formulas of a plane circle of radius sin(rho)
        chord = sin(d / 2)
    else:
        size = rho
        # a ring's tips are inside its pitch circle
        chord = circle_reach(R, rho, abs(R) + (float(height) if R > 0 else -float(height))) / 2
    if chord >= size:
        what = f"an addendum of {float(height):g} modules exceeds the height of these cycloids"
        why = "a cycloid reaches its maximum height after half a turn of the rolling circle"
        raise refused(what, why, "give a lower addendum or a larger rolling circle")
    return 2 * size * asin(chord / size)
