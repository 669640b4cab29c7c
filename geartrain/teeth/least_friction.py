"""Teeth of minimum friction loss for a given maximum pressure angle, and the extremal printed in W. D. Smith (1993)."""

from __future__ import annotations

from math import pi, sin
from typing import TYPE_CHECKING, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import Angle, Figure, Quantity, bad
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, arcs_of, check_angle, check_arcs
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.friction_law import FrictionLawOfText, PairFriction, PositiveVelocity
from geartrain.teeth.tooth_form import TwoFigures

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_HALF, _NONE, _WHOLE = Figure.parse("1/2"), Figure.parse("0"), Figure.parse("1")
_FIRST_ANGLE, _LAST_ANGLE = Quantity.parse("80 deg", "angle", False), Quantity.parse("50 deg", "angle", False)
_MAXIMUM_ANGLE, _MARGIN = Quantity.parse("25 deg", "angle", False), Figure.parse("0.15")


class LeastFriction(ConjugateToothForm):
    """Teeth of minimum friction loss: the pressure angle is constant near the pitch point, and the contact speed is the
    permitted minimum further out.

    `margin` is the minimum speed of the contact along the dedendum divided by the pitch-line speed. `literal` selects
    the extremal printed in the source instead: its pressure angles exceed 45 deg, it does not include the pitch point,
    and it cannot be used as a pair (docs/sources.md).

    See Also
    --------
    geartrain.teeth.UniformStress, geartrain.teeth.UniformTemperature : other optimal tooth forms of the same source.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> forms = LeastFriction(form="least_friction"), Involute(form="involute")
    >>> [round(form.transmission(24, 36, 0.1).efficiency_mean(), 4) for form in forms]
    [0.9895, 0.9847]
    """

    form: Literal["least_friction"] = Field(description="Name of the tooth form")
    pressure_angle: Angle | None = Field(
        None, description="Maximum pressure angle, which is at the pitch point, at most 45 deg; default 25 deg"
    )
    friction_law: FrictionLawOfText | None = Field(
        None, description="Friction law for which the loss is minimised; default a constant coefficient of any value"
    )
    pitch_line_speed: PositiveVelocity | None = Field(
        None, description="Pitch-line speed for which the teeth are designed, required with friction_law"
    )
    margin: Figure | None = Field(
        None, description="Minimum speed of the contact along a dedendum divided by the pitch-line speed; default 0.15"
    )
    literal: bool = Field(
        False, description="Use the extremal printed in the source, on one side only, with decreasing pressure_angles"
    )
    pressure_angles: tuple[Angle, Angle] | None = Field(
        None, description="First and last pressure angle of the literal shape; default [80 deg, 50 deg]"
    )
    arcs: TwoFigures | None = Field(
        None,
        description="Arcs of contact in pitches, one value, or a list of two (approach, recess); default 1/2 each, for "
        "the literal shape [0, 1]",
    )

    @model_validator(mode="after")
    def _check_parameters(self) -> LeastFriction:
        if self.arcs is not None:
            check_arcs(self.arcs)
        if (self.friction_law is None) != (self.pitch_line_speed is None):
            fix = "give both, or neither"
            raise bad("friction_law", "only one of friction_law and pitch_line_speed is given", fix)
        return self._check_literal() if self.literal else self._check_usual()

    def _check_usual(self) -> LeastFriction:
        if self.pressure_angles is not None:
            what = "pressure_angles apply only to the literal shape"
            raise bad("literal", what, "give `pressure_angle`, or `literal: true`")
        if self.pressure_angle is not None:
            check_angle("pressure_angle", self.pressure_angle, 0.125)
        if self.margin is not None and self.margin.value <= 0:
            what = f"with a margin of {self.margin.text} the contact would come to rest on the dedendum"
            raise bad("margin", what, "give a margin above 0")
        fastest = sin((self.pressure_angle or _MAXIMUM_ANGLE).si)
        # at the pitch point the contact moves with the sine of the pressure angle times the pitch-line speed
        if (margin := self.margin or _MARGIN).value >= fastest:
            what = f"a margin of {margin.text} is not below {fastest:.6g}, the speed at the pitch point"
            fix = "give a margin below the sine of the pressure angle, or a larger pressure_angle"
            raise bad("margin", what, fix)
        return self

    def _check_literal(self) -> LeastFriction:
        if self.friction_law is not None:
            raise bad("literal", "the literal shape does not depend on a friction_law", "remove `friction_law`")
        if self.pressure_angle is not None or self.margin is not None:
            what = "the literal shape has neither pressure_angle nor margin"
            raise bad("literal", what, "give `pressure_angles` instead")
        first, last = (angle.si for angle in self.pressure_angles or (_FIRST_ANGLE, _LAST_ANGLE))
        # at 45 deg the radius of curvature is 0, beyond it the flank would turn back
        if not pi / 4 <= last < first < pi / 2:
            what = "the pressure angles of the literal shape are not in descending order between 90 and 45 deg"
            fix = "give two angles from 45 to 90 deg, the larger one first: the flanks have a cusp at 45 deg"
            raise bad("pressure_angle", what, fix)
        if self.arcs is not None and min(arc.value for arc in self.arcs) > 0:
            raise bad("arcs", "the literal shape has contact on one side only", "give `arcs: [0, 1]` or `arcs: [1, 0]`")
        return self

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design centre distance."""
        pitch = wheels.pitch
        return self._standard(self._literal(pitch) if self.literal else self._usual(pitch), wheels)

    def _usual(self, pitch: PitchSurfaces) -> PathOfContact:
        from geartrain.teeth.conjugate.optimal_sides import involute, least_friction
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        psi, u = (self.pressure_angle or _MAXIMUM_ANGLE).si, float((self.margin or _MARGIN).value)
        approach, recess = (
            least_friction(pitch, b, X, psi, u, self._weight(pitch)) if X else involute(0.0, psi)
            for b, X in zip((pitch.A, pitch.B), arcs_of(self.arcs or (_HALF, _HALF), pitch), strict=True)
        )
        return PathOfContact(pitch, approach, recess)

    def _weight(self, pitch: PitchSurfaces) -> Callable[[Floats], Floats] | None:
        """Return the friction loss per distance from the pitch point, up to a factor, as a function of this distance d:
        mu S, where mu is the coefficient of friction and S is d, or sin d for bevel gears. Return None if mu is the
        same at all contacts.
        """
        if self.friction_law is None or self.pitch_line_speed is None or self.friction_law.of_pitch_line:
            return None
        by = PairFriction(self.friction_law, self.pitch_line_speed.si)

        def weight(d: Floats) -> Floats:
            S = pitch.S(d)
            # (A + B) |S| is the sliding speed divided by the pitch-line speed
            found: Floats = by((pitch.A + pitch.B) * abs(S)) * S
            return found

        return weight

    def _literal(self, pitch: PitchSurfaces) -> PathOfContact:
        from geartrain.teeth.conjugate.closed_form_sides import extremal
        from geartrain.teeth.conjugate.optimal_sides import involute
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        first, last = (angle.si for angle in self.pressure_angles or (_FIRST_ANGLE, _LAST_ANGLE))
        approach, recess = (
            extremal(pitch, X, first, last) if X else involute(0.0, 0.0)
            for X in arcs_of(self.arcs or (_NONE, _WHOLE), pitch)
        )
        return PathOfContact(pitch, approach, recess)
