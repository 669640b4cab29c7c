"""Crank and slider as a train declares them, and its transmission function.

The slider is at x = r cos S + sqrt(l^2 - r^2 sin^2 S) from the crank's axis, for crank radius r, rod length l and crank
angle S from the direction of the slide. Its travel is measured from the outer dead centre at S = 0, and its mean speed
is 0. One turn of a sliding link is a travel of 1 mm.
"""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin, sqrt
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import MeasuredLength, above_zero, bad, millimetres
from geartrain.numerics.roots import root
from geartrain.teeth.couplings.travel import TravelCoupling
from geartrain.teeth.transmission import LosslessTransmission

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


class CrankSlider(TravelCoupling):
    """Crank that moves a slide to and fro through a rod. The line of the slide passes through the crank's axis."""

    kind: Literal["crank_slider"] = Field(description="Crank, rod and slide: mean travel 0")
    radius: Annotated[MeasuredLength, above_zero("give a radius such as 20 mm")] = Field(
        description="Distance of the crank pin from the axis of the crank"
    )
    rod: Annotated[MeasuredLength, above_zero("give a length such as 60 mm")] = Field(description="Length of the rod")

    @model_validator(mode="after")
    def _passes(self) -> CrankSlider:
        if self.rod.base <= self.radius.base:
            what = f"a rod of {self.rod.text} is not longer than the crank of {self.radius.text}"
            raise bad("travel", what, "give a longer rod, so that the crank can turn fully")
        return self

    @property
    def mean(self) -> Fraction:
        """Mean ratio. It is 0, because the slide only moves to and fro."""
        return Fraction(0)

    @property
    def transmission(self) -> CrankSliderTransmission:
        """Transmission function if the crank drives."""
        return CrankSliderTransmission(float(millimetres(self.radius)), float(millimetres(self.rod)))


class CrankSliderTransmission(LosslessTransmission):
    """Transmission function of a crank that moves a slide through a rod.

    The driven angle is 2 pi times the travel of the slide from its outer dead centre, where the travel is in mm.
    Friction is not modelled.

    radius   crank radius r [mm], above 0
    rod      length l of the rod [mm], above r
    """

    ratio = Fraction(0)
    period = 2 * pi

    def __init__(self, radius: float, rod: float) -> None:
        self.r, self.l = radius, rod

    def error(self, S: ArrayLike) -> Floats:
        """Return the position of the slide relative to its outer dead centre at crank angles S [rad], 0 or less. A
        travel of 1 mm is returned as the angle 2 pi rad, as for all links that slide.
        """
        import numpy as np

        S = np.asarray(S, dtype=float)
        return np.asarray(self.period * (self.r * (np.cos(S) - 1) + self._along(S) - self.l))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at crank angles S [rad]: speed of the slide over speed of the crank [mm/turn]."""
        import numpy as np

        S = np.asarray(S, dtype=float)
        return np.asarray(-self.period * self.r * np.sin(S) * (1 + self.r * np.cos(S) / self._along(S)))

    def _along(self, S: Floats) -> Floats:
        """Return the component of the rod in the direction of the slide [mm] at crank angles S [rad]."""
        import numpy as np

        # l^2 - r^2 sin^2 S as a sum, which does not cancel for short rods
        return np.asarray(np.sqrt((self.l - self.r) * (self.l + self.r) + (self.r * np.cos(S)) ** 2))

    def peak(self) -> float:
        """Return the crank angle between the dead centres at which the speed of the slide is a maximum [rad]."""
        return root(self._acceleration, 0.0, pi / 2, self._acceleration(0.0), self._acceleration(pi / 2))

    def _acceleration(self, S: float) -> float:
        """Return the second derivative of the slide's position with respect to the crank angle [mm/rad^2]."""
        along = sqrt(self.l**2 - (self.r * sin(S)) ** 2)
        tilted = self.l**2 * cos(S) ** 2 - along**2 * sin(S) ** 2
        return -self.r * cos(S) - self.r**2 * tilted / along**3

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio, which differ only in sign."""
        most = abs(float(self.speed(self.peak())))
        return -most, most

    def error_range(self) -> tuple[float, float]:
        """Return the position of the slide at the inner and at the outer dead centre, relative to the outer one. A
        travel of 1 mm is returned as the angle 2 pi rad.
        """
        return -2 * self.period * self.r, 0.0

    def steepest_fall(self) -> float:
        """Return the maximum decrease of the speed ratio per crank angle [1/rad], at the outer dead centre."""
        return self.period * self.r * (1 + self.r / self.l)
