"""Teeth of uniform temperature: uniform frictional heat per unit area of the profile, which is removed locally by the
lubricant.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, ClassVar, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import Angle, Figure, Quantity, bad
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, arcs_of, check_angle, check_arcs
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import TwoFigures, check_above_0, check_one_of, refused

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.path_of_contact import PathSide
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_USUAL = Quantity.parse("12 deg", "angle", False)
_INVOLUTE = pi / 9  # 20 deg: the working depth of this involute is the default


class UniformTemperature(ConjugateToothForm):
    """Teeth of uniform temperature: the frictional heat per unit area of the profile is constant.

    The publication that proposed this form can be interpreted in three ways (docs/shapes.md). In interpretation a, the
    heat is uniform on the profile of the first wheel. In interpretation b, it is uniform on the hotter of the two
    profiles, which is always the dedendum. Interpretation c differs from b near the pitch point: there the pressure
    angle is constant, up to the point where the heat reaches the uniform value, so that the stress at the pitch point
    is finite.

    See Also
    --------
    geartrain.teeth.UniformStress, geartrain.teeth.LeastFriction : other optimal tooth forms of the same source.

    Examples
    --------
    >>> form = UniformTemperature(form="uniform_temperature", heat="1.5", arcs="1/2")
    >>> form.transmission(24, 36).verdict.text
    'the teeth run'
    """

    matched: ClassVar[str] = "for uniform temperature the working depth too"

    form: Literal["uniform_temperature"] = Field(description="Name of the tooth form")
    reading: Literal["a", "b", "c"] = Field(
        "b",
        description="Interpretation of the source: a (uniform heat on the first wheel), b (on the hotter dedendum) or "
        "c (as b, with a minimum pressure angle)",
    )
    heat: Figure | None = Field(
        None,
        description="Heat per unit area divided by friction coefficient times tangential force; a smaller value makes "
        "taller teeth",
    )
    depth: Figure | None = Field(
        None, description="Working depth in modules, instead of heat; default as for the 20 deg involute"
    )
    minimum_angle: Angle | None = Field(
        None, description="Minimum pressure angle, which is at the pitch point, in interpretation c; default 12 deg"
    )
    arcs: TwoFigures = Field(
        "1/2",
        validate_default=True,
        description="Arcs of contact in pitches, one value, or a list of two (approach, recess)",
    )

    @model_validator(mode="after")
    def _check_parameters(self) -> UniformTemperature:
        check_one_of(self, "heat", "heat", "depth")
        for name in ("heat", "depth"):
            check_above_0(self, name, name)
        if self.minimum_angle is not None:
            if self.reading != "c":
                fix = "give `reading: c`, or remove `minimum_angle`"
                raise bad("pressure_angle", "minimum_angle applies only to reading c", fix)
            check_angle("minimum_angle", self.minimum_angle)
        check_arcs(self.arcs)
        return self

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design centre distance."""
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        pitch = wheels.pitch
        if self.heat is not None:
            approach, recess = self._sides(pitch, (pitch.A + pitch.B) / float(self.heat.value))
        else:
            approach, recess = self._sides_of_depth(pitch)
        return self._standard(PathOfContact(pitch, approach, recess), wheels)

    def _sides(self, pitch: PitchSurfaces, gamma: float) -> tuple[PathSide, PathSide]:
        """Return the approach and recess sides for gamma, the sum A + B of the pitch curvatures divided by the heat."""
        from geartrain.teeth.conjugate.optimal_sides import bounded_heat, involute, uniform_heat

        psi = (self.minimum_angle or _USUAL).si
        arcs = arcs_of(self.arcs, pitch)
        found = []
        # the contact speed is w + A S on gear 1 and w - B S on gear 2, so that reading a has b = -A in recess
        for X, b in zip(arcs, (pitch.A, -pitch.A if self.reading == "a" else pitch.B), strict=True):
            if not X:
                found.append(involute(0.0, 0.0))
            elif self.reading == "c":
                found.append(bounded_heat(pitch, b, gamma, X, psi))
            elif b + gamma <= 0:
                what = f"a heat of {(pitch.A + pitch.B) / gamma:.6g} exceeds the maximum of these teeth"
                why = "near the pitch point, the contact would come to rest on the profile"
                raise refused(what, why, "give a smaller heat or a larger depth")
            else:
                found.append(uniform_heat(pitch, b, gamma, X))
        return found[0], found[1]

    def _sides_of_depth(self, pitch: PitchSurfaces) -> tuple[PathSide, PathSide]:
        """Return the approach side and the recess side with the heat that gives the requested working depth."""
        from geartrain.teeth.conjugate.optimal_sides import involute
        from geartrain.teeth.conjugate.path_losses import depth, to_depth
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        arcs = arcs_of(self.arcs, pitch)
        if self.depth is not None:
            wanted = float(self.depth.value) * pitch.p / pi
        else:
            wanted = depth(PathOfContact(pitch, involute(arcs[0], _INVOLUTE), involute(arcs[1], _INVOLUTE)))
        # near the pitch point a side is a cycloid of rolling radius 1 / (b + gamma) and height X^2 (b + gamma) / 2
        half = (pitch.A + pitch.B) / 2
        start = max(2 * wanted / (arcs[0] * arcs[0] + arcs[1] * arcs[1]) - half, half)
        gamma = to_depth(lambda g: depth(PathOfContact(pitch, *self._sides(pitch, g))), wanted, start, sum(arcs))
        return self._sides(pitch, gamma)
