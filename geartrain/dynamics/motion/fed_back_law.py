"""The law of a pair that moves its own driver, as around a differential, over the angle its driver has without that.

With gain g and sense sigma its error is delta = sigma error(S + g delta): docs/motion.md (5) for one pair. While the
driver goes on, delta is a function of S alone, with the law's period; a law like any other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.coupled_errors import CoupledErrors, solve_coupled_errors

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True)
class FedBackLaw:
    """Error and speed of a pair whose driver gains `gain` radians a radian of its error; `sense` of its driven side."""

    law: TransmissionFunction
    sense: int
    gain: float

    @property
    def ratio(self) -> Fraction:
        """The law's own."""
        return self.law.ratio

    @property
    def period(self) -> float:
        """The law's own."""
        return self.law.period

    @cached_property
    def goes_on(self) -> bool:
        """True where no place of the law is a dead centre."""
        ratio = float(self.law.ratio)
        return all(1 - self.sense * (tau - ratio) * self.gain > 0 for tau in self.law.speed_range())

    def corners(self) -> list[float]:
        """Where the driver would stand (rad) at the corners of the law itself."""
        corners = np.array(self.law.corners(), dtype=float)
        found: list[float] = (corners - self.gain * self.sense * self.law.error(corners)).tolist()
        return found

    def error(self, S: Floats) -> Floats:
        """Transmission error (rad) where the driver would stand at S (rad)."""
        return self._solved(S)[0]

    def speed(self, S: Floats) -> Floats:
        """Its rate over the driver's, and the mean ratio."""
        return self._solved(S)[1]

    def _solved(self, S: Floats) -> tuple[Floats, Floats]:
        pair = CoupledErrors(("",), (self.law,), np.array([float(self.sense)]), np.array([[self.gain]]))
        delta, rate, _ = solve_coupled_errors(pair, S.reshape(1, -1), [1.0])
        return self.sense * delta.reshape(S.shape), self.sense * rate.reshape(S.shape) + float(self.ratio)
