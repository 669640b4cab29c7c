"""Transmission functions whose deviation from uniform motion is a periodic function, by a table or by harmonics."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.transmission import LosslessTransmission, SpeedLeap

if TYPE_CHECKING:
    from fractions import Fraction

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.periodic_function import PeriodicFunction

_SLIGHT = 1e-9  # of the range of a quantity: smaller jumps are rounding error


class TableTransmission(LosslessTransmission):
    """Transmission function q = m S + d(S + phase) with a periodic deviation d from uniform motion.

    Parameters
    ----------
    ratio : Fraction
        Mean speed ratio m, without sign.
    deviation : PeriodicFunction
        Deviation d [rad of the driven side] as a function of the driver's angle [rad].
    phase : float, optional
        Angle of the driver at S = 0 [rad], default 0.
    way : int, optional
        -1 for a driver whose forward sense is against its angle; the deviation is then -d(phase - S). Default 1.
    """

    def __init__(self, ratio: Fraction, deviation: PeriodicFunction, phase: float = 0.0, way: int = 1) -> None:
        self.ratio, self.deviation, self.phase, self.way = ratio, deviation, phase, way
        self.period = deviation.period
        self.waves = max(1, ceil(deviation.waves))
        self.at_once = bool(self._leaps(0).any())

    def mirrored(self) -> TableTransmission:
        """Return the function for a driver whose forward sense is reversed."""
        return TableTransmission(self.ratio, self.deviation, self.phase, -self.way)

    def _angle(self, S: ArrayLike) -> Floats:
        return np.asarray(self.way * np.asarray(S, dtype=float) + self.phase)

    def error(self, S: ArrayLike) -> Floats:
        """Return the deviation from uniform motion at driver angles S [rad of the driven side]."""
        return self.way * self.deviation(self._angle(S))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S."""
        return float(self.ratio) + self.deviation.derivative(self._angle(S))

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio; jumps of the driven angle are not included."""
        low, high = self.deviation.extremes(1)
        return float(self.ratio) + low, float(self.ratio) + high

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum deviation from uniform motion [rad of the driven side]."""
        low, high = sorted(self.way * each for each in self.deviation.extremes())
        return low, high

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the deviation from uniform motion, and its rms value about the mean [rad]."""
        mean, rms = self.deviation.moments()
        return self.way * mean, rms

    def kinks(self) -> list[float]:
        """Return the driver angles at which the deviation or one of its derivatives is discontinuous [rad]."""
        return [self.way * (float(each) - self.phase) for each in self.deviation.breakpoints]

    def _leaps(self, order: int) -> Floats:
        """Return the jumps of a derivative of the deviation at its breakpoints, 0 if they are rounding error."""
        before, after = self.deviation.sides(order)
        low, high = self.deviation.extremes(order)
        return np.where(np.abs(after - before) > _SLIGHT * (high - low), after - before, 0.0)

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio."""
        # the speed ratio follows the angle or, backwards, is passed in the opposite order
        rises = self.way * self._leaps(1) > 0
        before, after = self.deviation.sides(1)[:: self.way]
        mean = float(self.ratio)
        return tuple(
            SpeedLeap(mean + float(low), mean + float(high))
            for low, high in zip(before[rises], after[rises], strict=True)
        )

    def steepest_fall(self) -> float | None:
        """Return the maximum rate at which the speed ratio decreases [1/rad]; None if it decreases abruptly."""
        if self.at_once or (self.way * self._leaps(1) < 0).any():
            return None
        low, high = self.deviation.extremes(2)
        return max(0.0, -low if self.way > 0 else high)
