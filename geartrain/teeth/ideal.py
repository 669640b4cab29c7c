"""Ideal teeth: the speed ratio equals the ratio of tooth counts at every instant, without loss."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, ClassVar, Literal

from pydantic import Field

from geartrain.teeth.tooth_form import ShaftAngle, ToothForm
from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from geartrain.teeth.meshing_wheels import MeshingWheels


class Ideal(ToothForm):
    """Ideal teeth with a constant speed ratio, without transmission error, backlash or losses.

    No tooth shapes are computed for a pair with this form.

    See Also
    --------
    geartrain.teeth.Involute : real teeth with a constant ratio.

    Examples
    --------
    >>> transmission = Ideal(form="ideal").transmission(20, 40)
    >>> transmission.ratio, transmission.error_range(), transmission.efficiency_mean()
    (Fraction(1, 2), (0.0, 0.0), 1.0)
    """

    has_shape: ClassVar[bool] = False

    form: Literal["ideal"] = Field(description="Name of the tooth form")

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> None:
        """Return None, because ideal teeth are completely described by the ratio of tooth counts."""

    def transmission(self, z1: int, z2: int, driver: int = 1) -> ExactRatio:
        """Return the transmission function of a pair, which has a constant speed ratio.

        Parameters
        ----------
        z1, z2 : int
            Numbers of teeth of the first and of the second wheel, 1 or more.
        driver : {1, 2}
            Number of the driving wheel.

        Returns
        -------
        ExactRatio
            Transmission function: driven angle = ratio times driver angle.
        """
        first, second = (z1, z2) if driver == 1 else (z2, z1)
        return ExactRatio(Fraction(first, second), 2 * pi / first)
