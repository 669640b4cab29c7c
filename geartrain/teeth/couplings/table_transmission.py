"""Transmission functions whose deviation from uniform motion is a periodic function given by points, harmonics or
formulas.

Let S be the forward angle of the side to which the deviation d refers, and m the mean speed ratio. The other side is
then at q = m S + d(S). If this other side drives, its angle q is given, and S is the root of this equation. The error
is then S - q/m = -d(S)/m, and the speed ratio is 1/(m + d'(S)).
"""

from __future__ import annotations

from functools import cached_property
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.roots import roots_by_false_position
from geartrain.teeth.transmission import LosslessTransmission, SpeedLeap, TransmissionFunction

if TYPE_CHECKING:
    from fractions import Fraction

    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.periodic_function import PeriodicFunction

_CLOSE = 4e-16  # periods: distance at which the search for the driving angle ends
_SLIGHT = 1e-9  # of the range of a quantity: smaller jumps are rounding error


class DeviationTransmission(TransmissionFunction):
    """Transmission function with a periodic deviation from uniform motion, or its inverse function.

    mean        absolute value of the mean speed ratio m of the function
    deviation   deviation d [rad of the other side] as a function of the angle [rad] of the side to which it refers
    phase       angle in the deviation at S = 0 [rad]
    way         -1 if the driver turns in the negative sense of its declared angle; the deviation is then -d(phase - S)
    inverse     True if the other side drives
    direction   direction of rotation
    lag         constant that is added to the transmission error [rad of the driven side]
    """

    def __init__(
        self,
        mean: Fraction,
        deviation: PeriodicFunction,
        phase: float = 0.0,
        way: int = 1,
        inverse: bool = False,
        direction: int = 1,
        lag: float = 0.0,
    ) -> None:
        self.deviation, self.inverse, self.phase, self.way, self.direction = deviation, inverse, phase, way, direction
        self._mean, self._lag = float(mean), lag
        self.ratio = 1 / mean if inverse else mean
        self.period = deviation.period * (self._mean if inverse else 1.0)
        self.waves = max(1, ceil(deviation.waves))
        # errors of the driven side per deviation
        self._scale = -1 / self._mean if inverse else float(way)

    def _own_angle(self, S: ArrayLike) -> Floats:
        """Return the arguments of the deviation function [rad], modulo its period, at driver angles S [rad]."""
        S = np.asarray(S, dtype=float)
        if not self.inverse:
            return np.asarray(self.way * S + self.phase)
        q, (low, high) = np.mod(S, self.period).ravel(), self._extremes

        def beyond(x: Floats, which: NDArray[np.intp]) -> Floats:
            return np.asarray(self._mean * x + self.deviation(x) - q[which])

        first, last = (q - high) / self._mean, (q - low) / self._mean
        every = np.arange(len(q))
        close = _CLOSE * self.deviation.period
        found = roots_by_false_position(beyond, first, last, beyond(first, every), beyond(last, every), close)
        return found.reshape(S.shape)

    @cached_property
    def _extremes(self) -> tuple[float, float]:
        return self.deviation.extremes()

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S [rad]."""
        return self._scale * self.deviation(self._own_angle(S)) + self._lag

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad]."""
        return self._speed(self.deviation.derivative(self._own_angle(S)))

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return the transmission error [rad of the driven side] and the speed ratio at driver angles S [rad]."""
        at = self._own_angle(S)
        return self._scale * self.deviation(at) + self._lag, self._speed(self.deviation.derivative(at))

    def _speed(self, slope: ArrayLike) -> Floats:
        """Return the speed ratios at which the deviation function has the derivatives `slope`."""
        own = self._mean + np.asarray(slope)
        return np.asarray(1 / own if self.inverse else own)

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio over a period. Jumps of the driven angle are disregarded."""
        low, high = sorted(self._speed(self.deviation.extremes(1)).tolist())
        return low, high

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error over a period [rad of the driven side]."""
        low, high = sorted(self._scale * each + self._lag for each in self._extremes)
        return low, high

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error and its rms deviation from the mean [rad of the driven side]."""
        # the means of d and d^2 over S and over q are equal, because those of d d' and d^2 d' are 0
        mean, rms = self.deviation.moments()
        return self._scale * mean + self._lag, abs(self._scale) * rms

    @property
    def _breakpoints(self) -> Floats:
        """Arguments of the deviation function [rad] at which it or one of its derivatives is discontinuous."""
        return self.deviation.breakpoints

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] at which the function or one of its derivatives is discontinuous."""
        at = self._breakpoints
        driver = self._mean * at + self.deviation(at) if self.inverse else self.way * (at - self.phase)
        found: list[float] = driver.tolist()
        return found

    def _jumps(self, order: int) -> Floats:
        """Return the jumps of the deviation's derivative of this order at its breakpoints; 0 for rounding errors."""
        before, after = self.deviation.sides(order)
        low, high = self.deviation.extremes(order)
        return np.where(np.abs(after - before) > _SLIGHT * (high - low), after - before, 0.0)

    @cached_property
    def at_once(self) -> bool:  # type: ignore[override]
        """True if the driven side moves in jumps, so that the transmission error is discontinuous."""
        return bool(self._jumps(0).any())

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio within one period."""
        sides = [self._speed(each[self._jumps(1) != 0]) for each in self.deviation.sides(1)]
        pairs = zip(*(each.tolist() for each in sides[:: self.way * self.direction]), strict=True)
        return tuple(SpeedLeap(before, after) for before, after in pairs if after > before)

    def steepest_fall(self) -> float | None:
        """Return the maximum rate at which the speed ratio decreases with the driver angle S [1/rad]; None for the
        inverse function, for a driver that turns backwards, or if the speed ratio decreases abruptly.
        """
        if self.inverse or self.direction < 0 or self.at_once or (self.way * self._jumps(1) < 0).any():
            return None
        low, high = self.deviation.extremes(2)
        return max(0.0, -low if self.way > 0 else high)


class TableTransmission(DeviationTransmission, LosslessTransmission):
    """Transmission function of a coupling with a periodic deviation from uniform motion."""

    def mirrored(self) -> TableTransmission:
        """Return the transmission function for a driver whose forward sense is reversed."""
        return TableTransmission(self.ratio, self.deviation, self.phase, -self.way)
