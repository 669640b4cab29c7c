"""Teeth of uniform Hertz stress, the shortest teeth for a given maximum contact pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import Angle
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, arcs_of, check_angle, check_arcs
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import TwoFigures

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair


class UniformStress(ConjugateToothForm):
    """Teeth of uniform Hertz stress: the shortest teeth for a given maximum contact pressure.

    The contact pressure is constant while one tooth pair carries the load (docs/shapes.md).

    See Also
    --------
    geartrain.teeth.LeastFriction, geartrain.teeth.UniformTemperature : other optimal tooth forms of the same source.

    Examples
    --------
    >>> from geartrain.teeth.conjugate import measure
    >>> stress = measure(UniformStress(form="uniform_stress").path(24, 36)).one_pair
    >>> round(stress.stress / stress.off_pitch, 6)
    1.0
    """

    form: Literal["uniform_stress"] = Field(description="Name of the tooth form")
    pressure_angle: Angle = Field(
        "20 deg", validate_default=True, description="Pressure angle at the pitch point, below 45 deg"
    )
    arcs: TwoFigures = Field(
        "1/2",
        validate_default=True,
        description="Arcs of contact in pitches, one value, or a list of two (approach, recess)",
    )

    @model_validator(mode="after")
    def _check_parameters(self) -> UniformStress:
        check_angle("pressure_angle", self.pressure_angle, 0.125)
        check_arcs(self.arcs)
        return self

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design centre distance."""
        from geartrain.teeth.conjugate.optimal_sides import involute, uniform_stress
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        pitch, psi = wheels.pitch, self.pressure_angle.si
        A, B = pitch.A, pitch.B
        approach, recess = (
            uniform_stress(pitch, a, b, X, psi) if X else involute(0.0, psi)
            for a, b, X in zip((B, A), (A, B), arcs_of(self.arcs, pitch), strict=True)
        )
        return self._standard(PathOfContact(pitch, approach, recess), wheels)
