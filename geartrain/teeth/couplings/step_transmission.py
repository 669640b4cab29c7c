"""Transmission functions of couplings that move by steps: Geneva drives, and engagements that move whole teeth."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate
from math import acos, inf, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.transmission import SpeedLeap, TransmissionFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_EARLY = 1e-9  # of the angle between engagements: a step at once is complete if rounding leaves less than this to it


class SteppingTransmission(TransmissionFunction):
    """Transmission function without losses whose driven side rests during a part of each period."""

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad], which is 1."""
        return np.ones(np.shape(S))

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error and its rms deviation from the mean [rad], by Gauss-Legendre
        quadrature over the smooth pieces.
        """
        S, weights = self.graded_nodes(lambda S: self.error(S) ** 2)
        error = self.error(S)
        mean = float(weights @ error)
        return mean, sqrt(float(weights @ (error - mean) ** 2))


class GenevaTransmission(SteppingTransmission):
    """Transmission function of a Geneva drive, from S = 0 in the middle of a step.

    There a pin is on the line of centres: nearest to the other axis for an external drive, farthest for an internal
    one. With rho = sin(pi/n), the driven angle is atan2(rho sin S, 1 - rho cos S) while |S| <= pi/2 - pi/n, and pi/n
    during the rest; for an internal drive atan2(rho sin S, 1 + rho cos S) while |S| <= pi/2 + pi/n.

    Parameters
    ----------
    slots : int
        Number of slots n, 3 or more.
    pins : int
        Number of pins of the driver, evenly spaced.
    internal : bool
        True if the pins are inside the driven wheel, which then turns in the sense of the driver.

    Examples
    --------
    >>> transmission = GenevaTransmission(4)
    >>> transmission.ratio, round(transmission.speed_range()[1], 6), transmission.dwell
    (Fraction(1, 4), 2.414214, Fraction(3, 4))
    """

    def __init__(self, slots: int, pins: int = 1, internal: bool = False) -> None:
        self.slots, self.pins, self.internal = slots, pins, internal
        self.ratio, self.period = Fraction(pins, slots), 2 * pi / pins
        self.rho = (-1 if internal else 1) * sin(pi / slots)
        """Pin radius divided by the distance of the axes, negative for an internal drive."""
        self.alpha = pi / 2 + (1 if internal else -1) * pi / slots
        """Driver angle from the middle of a step to its end [rad]."""
        self.dwell = 1 - pins * (Fraction(1, 2) + Fraction(1 if internal else -1, slots))

    def _from_middle(self, S: ArrayLike) -> Floats:
        """Return driver angles modulo the period, between plus and minus half a period [rad]."""
        S = np.asarray(S, dtype=float)
        return np.asarray(S - self.period * np.rint(S / self.period))

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S [rad]."""
        u = self._from_middle(S)
        # at rest the angle is the angle at the end of the step
        v = np.clip(u, -self.alpha, self.alpha)
        angle = np.arctan2(abs(self.rho) * np.sin(v), 1 - self.rho * np.cos(v))
        return np.asarray(angle - float(self.ratio) * u)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad], which is 0 at rest."""
        u = self._from_middle(S)
        cos = np.cos(u)
        speed = abs(self.rho) * (cos - self.rho) / (1 - 2 * self.rho * cos + self.rho**2)
        return np.where(np.abs(u) < self.alpha, speed, 0.0)

    def speed_range(self) -> tuple[float, float]:
        """Return 0 and the maximum speed ratio, in the middle of a step."""
        # pins that follow each other without a rest still have a speed of 0 between two steps
        return 0.0, abs(self.rho) / (1 - self.rho)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad], at the driver angles of mean speed."""
        m, square = float(self.ratio), self.rho**2
        side = -1 if self.internal else 1
        S = acos((m * (1 + square) + side * square) / (abs(self.rho) * (1 + 2 * side * m)))
        most = float(self.error(S))
        return -most, most

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error, which is 0 by symmetry, and its rms value [rad]."""
        return 0.0, super().error_moments()[1]

    def kinks(self) -> list[float]:
        """Return the driver angles at which a step begins and ends [rad], where the acceleration jumps."""
        return [-self.alpha, self.alpha]

    def speed_leaps(self) -> tuple[()]:
        """Return no jumps, because a pin enters its slot along it, without impact."""
        return ()

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad]."""
        if self.internal:
            return tan(pi / self.slots)  # at the end of the step
        square = self.rho**2
        cos = (sqrt((1 + square) ** 2 + 32 * square) - (1 + square)) / (4 * self.rho)
        return self.rho * (1 - square) * sqrt(1 - cos**2) / (1 - 2 * self.rho * cos + square) ** 2


class StepTransmission(SteppingTransmission):
    """Transmission function of engagements that move whole teeth, at once or evenly over an angle of the driver.

    The first engagement begins at S = 0. The driven angle counts from its position before this engagement.

    Parameters
    ----------
    teeth : int
        Number of teeth of the driven wheel.
    moves : sequence of int
        Teeth moved by successive engagements.
    times : int
        Engagements in one revolution of the driver.
    over : Fraction
        Angle of the driver during which an engagement moves the teeth [turn]; 0 for steps at once.

    Examples
    --------
    >>> transmission = StepTransmission(24, [12], 1, Fraction(2, 5))
    >>> transmission.ratio, transmission.speed_range(), transmission.dwell
    (Fraction(1, 2), (0.0, 1.25), Fraction(3, 5))
    """

    def __init__(self, teeth: int, moves: Sequence[int], times: int = 1, over: Fraction = Fraction(0)) -> None:
        self.teeth, self.moves, self.times, self.over = teeth, tuple(moves), times, over
        self.ratio = Fraction(times * sum(moves), len(moves) * teeth)
        self.period = 2 * pi * len(moves) / times
        self.jumps = not over
        self.dwell = 1 - over * times * Fraction(sum(1 for each in moves if each), len(moves))
        self._starts = np.arange(len(moves)) * (2 * pi / times)
        # a driver that comes to rest where an engagement begins, as a star on a star does, has begun it despite rounding
        self._early = _EARLY * 2 * pi / times if self.jumps else 0.0
        self._pitch = 2 * pi / teeth
        self._moved = np.array([*accumulate(moves, initial=0)])

    def _engagement(self, S: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return, at driver angles S [rad], the index of the last engagement, the angle modulo the period [rad], and the
        completed fraction of the engagement, 0 to 1.
        """
        u = np.mod(np.asarray(S, dtype=float) + self._early, self.period)
        at = np.searchsorted(self._starts, u, side="right") - 1
        if self.jumps:
            return at, u - self._early, np.ones_like(u)
        return at, u, np.minimum((u - self._starts[at]) / (2 * pi * float(self.over)), 1.0)

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S [rad]."""
        at, u, done = self._engagement(S)
        teeth = self._moved[at] + np.asarray(self.moves)[at] * done
        return np.asarray(teeth * self._pitch - float(self.ratio) * u)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad]: 0 at rest, and 0 at the instants of steps at once."""
        at, u, done = self._engagement(S)
        if self.jumps:
            return np.zeros_like(u)
        return np.where(done < 1, np.asarray(self._ratios)[at], 0.0)

    @property
    def _ratios(self) -> list[float]:
        """Speed ratio during each engagement; infinite for steps at once."""
        return [each / self.teeth / float(self.over) if self.over else inf if each else 0.0 for each in self.moves]

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio; the maximum is infinite for steps at once."""
        return min(self._ratios) if self.over * self.times == 1 else 0.0, max(self._ratios)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad], before and after an engagement."""
        teeth = list(accumulate(self.moves, initial=0))
        # exact, in revolutions
        starts = [Fraction(at, self.times) for at in range(len(self.moves))]
        before = (Fraction(moved, self.teeth) - self.ratio * at for moved, at in zip(teeth[:-1], starts, strict=True))
        after = [
            Fraction(moved, self.teeth) - self.ratio * (at + self.over)
            for moved, at in zip(teeth[1:], starts, strict=True)
        ]
        errors = [*before, *after]
        return 2 * pi * float(min(errors)), 2 * pi * float(max(errors))

    def kinks(self) -> list[float]:
        """Return the driver angles at which an engagement begins, and at which it ends [rad]."""
        starts = (self._starts - self._early).tolist()
        # without rests an engagement ends where the next one begins
        rests = 0 < self.over * self.times < 1
        return [*starts, *(self._starts + 2 * pi * float(self.over)).tolist()] if rests else starts

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """Return the upward steps of the speed ratio at the beginnings of engagements; None for steps at once."""
        if self.jumps:
            return None
        rests = self.over * self.times < 1
        earlier = [0.0] * len(self.moves) if rests else [self._ratios[-1], *self._ratios[:-1]]
        return tuple(SpeedLeap(*each) for each in zip(earlier, self._ratios, strict=True) if each[1] > each[0])

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad]: infinite, because it drops at once,
        unless the speed ratio is constant.
        """
        low, high = self.speed_range()
        return inf if high > low else 0.0
