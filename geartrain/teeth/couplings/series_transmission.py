"""Transmission functions with the deviation A epsilon(n S) from uniform motion, which apply to several couplings.

epsilon(x) = atan2(rho sin x, 1 - rho cos x) is the sum of rho^k sin(k x) / k over k = 1, 2, ..., with 0 <= rho < 1. Pin
and slot, universal joints, and elliptical and lobed wheels differ only in the mean ratio m, the factor A, the order n
and rho; a Geneva drive follows the same function while it moves.
"""

from __future__ import annotations

from math import atan2, log, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.transmission import LosslessTransmission

if TYPE_CHECKING:
    from fractions import Fraction

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_TERMS = 54  # of the power series of the dilogarithm: its argument is at most 1/2


class SeriesTransmission(LosslessTransmission):
    """Transmission function q = m S + A epsilon(n (S + phase)), with epsilon(x) = atan2(rho sin x, 1 - rho cos x).

    At S = -phase the driven side passes its mean position with extreme speed: the maximum speed if A > 0, the minimum
    if A < 0.

    ratio    absolute value of the mean speed ratio m
    factor   factor A of the deviation from uniform motion; either sign
    order    number n of periods in one revolution of the driver
    rho      ratio of successive terms of the series, 0 or more and below 1
    rest     the difference 1 - rho, where it is known more accurately than by subtraction
    phase    angle of the driver at S = 0 [rad], default 0
    """

    def __init__(
        self, ratio: Fraction, factor: float, order: int, rho: float, rest: float | None = None, phase: float = 0.0
    ) -> None:
        if not 0 <= rho < 1:
            why = "the series of its deviation from uniform motion converges for 0 <= rho < 1"
            raise RangeError(Problem(f"rho = {rho:g} is out of range", why, "give a value of 0 or more and below 1"))
        self.ratio, self.factor, self.order, self.rho = ratio, factor, order, rho
        self.rest, self.phase, self.period = 1 - rho if rest is None else rest, phase, 2 * pi / order

    def mirrored(self) -> SeriesTransmission:
        """Return the transmission function for a driver with the opposite forward sense: the phase changes sign."""
        if not self.phase:
            return self
        return SeriesTransmission(self.ratio, self.factor, self.order, self.rho, self.rest, -self.phase)

    def _argument(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return the argument x = n (S + phase) of epsilon, and sin^2(x/2), at driver angles S [rad]."""
        x = self.order * (np.asarray(S, dtype=float) + self.phase)
        return x, np.sin(x / 2) ** 2

    def error(self, S: ArrayLike) -> Floats:
        """Return the deviation from uniform motion [rad of the driven side] at driver angles S [rad]."""
        x, half = self._argument(S)
        # 1 - rho cos x as a sum, which does not cancel near rho = 1
        return np.asarray(self.factor * np.arctan2(self.rho * np.sin(x), self.rest + 2 * self.rho * half))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio m + A n (rho cos x - rho^2) / (1 - 2 rho cos x + rho^2), where x = n (S + phase)."""
        _, half = self._argument(S)
        # numerator and denominator as sums without cancellation
        share = self.rho * (self.rest - 2 * half) / (self.rest**2 + 4 * self.rho * half)
        return np.asarray(float(self.ratio) + self.factor * self.order * share)

    def speed_slope(self, S: ArrayLike) -> Floats:
        """Return the derivative of the speed ratio with respect to the driver angle.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Derivative of the speed ratio [1/rad], of the shape of S.
        """
        x, half = self._argument(S)
        size = self.factor * self.order**2 * self.rho * self.rest * (1 + self.rho)
        return np.asarray(-size * np.sin(x) / (self.rest**2 + 4 * self.rho * half) ** 2)

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio, which occur at n (S + phase) = 0 and pi."""
        size = self.factor * self.order * self.rho
        ends = float(self.ratio) + size / self.rest, float(self.ratio) - size / (1 + self.rho)
        return min(ends), max(ends)

    @property
    def amplitude(self) -> float:
        """Maximum deviation from uniform motion, |A| arcsin(rho) [rad of the driven side]."""
        # asin would lose half its digits near rho = 1
        return abs(self.factor) * atan2(self.rho, sqrt(self.rest * (1 + self.rho)))

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum deviation from uniform motion [rad]: minus and plus the amplitude."""
        return -self.amplitude, self.amplitude

    def error_moments(self) -> tuple[float, float]:
        """Return the mean and the rms of the deviation from uniform motion [rad]. The mean is 0 and the rms is |A|
        sqrt(Li2(rho^2) / 2), where Li2 is the dilogarithm.
        """
        # Parseval's theorem for the sine series
        return 0.0, abs(self.factor) * sqrt(_dilogarithm(self.rho**2, self.rest * (1 + self.rho)) / 2)

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases with the driver angle [1/rad]."""
        square = 1 + self.rho**2
        # root of the derivative of `speed_slope`, in a form that does not cancel for small rho
        cosine = min(8 * self.rho / (square + sqrt(square**2 + 32 * self.rho**2)), 1.0)
        x = atan2(sqrt((1 - cosine) * (1 + cosine)), cosine)
        return abs(float(self.speed_slope(x / self.order - self.phase)))


def _dilogarithm(x: float, rest: float) -> float:
    """Return the dilogarithm Li2(x), the sum of x^k / k^2 over k = 1, 2, ..., for 0 <= x < 1, with `rest` = 1 - x."""
    if x > 0.5:
        # reflection formula of Euler
        return pi**2 / 6 - log(x) * log(rest) - _dilogarithm(rest, x)
    return sum(x**k / k**2 for k in range(_TERMS, 0, -1))
