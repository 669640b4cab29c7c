"""Transmission functions of couplings that move by steps: Geneva drives, and engagements that move whole teeth."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate, pairwise
from math import pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.periodic_function import PeriodicPieces
from geartrain.numerics.roots import root
from geartrain.teeth.couplings.series_transmission import SeriesTransmission
from geartrain.teeth.couplings.table_transmission import TableTransmission
from geartrain.teeth.transmission import LosslessTransmission

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_EARLY = Fraction(
    1, 10**9
)  # of the angle between engagements: a step at once is complete if rounding leaves less than this to it


class GenevaTransmission(LosslessTransmission):
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
        self.ratio, self.period = Fraction(pins, slots), 2 * pi / pins
        side, phase = (1, pi) if internal else (-1, 0.0)
        self.step = SeriesTransmission(Fraction(0), -side, 1, sin(pi / slots), phase=phase)
        """Function of the driven angle while a pin is in its slot."""
        self.alpha = pi / 2 + side * pi / slots
        """Driver angle from the middle of a step to its end [rad]."""
        self.dwell = 1 - pins * (Fraction(1, 2) + Fraction(side, slots))

    def _from_middle(self, S: ArrayLike) -> Floats:
        """Return driver angles modulo the period, between plus and minus half a period [rad]."""
        S = np.asarray(S, dtype=float)
        return np.asarray(S - self.period * np.rint(S / self.period))

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S [rad]."""
        u = self._from_middle(S)
        # at rest the angle is the angle at the end of the step
        return np.asarray(self.step.error(np.clip(u, -self.alpha, self.alpha)) - float(self.ratio) * u)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad], which is 0 at rest."""
        u = self._from_middle(S)
        return np.where(np.abs(u) < self.alpha, self.step.speed(u), 0.0)

    def speed_range(self) -> tuple[float, float]:
        """Return 0 and the maximum speed ratio, in the middle of a step."""
        # pins that follow each other without a rest still have a speed of 0 between two steps
        return 0.0, self.step.speed_range()[1]

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad], at the driver angles of mean speed."""
        mean = float(self.ratio)
        S = root(lambda S: float(self.speed(S)) - mean, 0.0, self.alpha, self.speed_range()[1] - mean, -mean)
        most = float(self.error(S))
        return -most, most

    def kinks(self) -> list[float]:
        """Return the driver angles at which a step begins and ends [rad], where the acceleration jumps."""
        return [-self.alpha, self.alpha]

    def speed_leaps(self) -> tuple[()]:
        """Return no jumps, because a pin enters its slot along it, without impact."""
        return ()

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad]."""
        # the speed of an internal drive decreases most at the end of a step
        return self.step.steepest_fall() if self.alpha < pi / 2 else abs(float(self.step.speed_slope(self.alpha)))


class StepTransmission(TableTransmission):
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
    >>> transmission.ratio, [float(speed) for speed in transmission.speed([1, 3])], transmission.dwell
    (Fraction(1, 2), [1.25, 0.0], Fraction(3, 5))
    """

    def __init__(self, teeth: int, moves: Sequence[int], times: int = 1, over: Fraction = Fraction(0)) -> None:
        mean, spacing = Fraction(times * sum(moves), len(moves) * teeth), Fraction(1, times)
        # a driver that comes to rest where an engagement begins has begun it, despite rounding of its angle
        early = 0 if over else _EARLY * spacing
        starts, lines = [], []  # in revolutions: starts of the pieces, and slope and initial value of the deviation
        for at, (before, after) in enumerate(pairwise(accumulate(moves, initial=0))):
            start, end = at * spacing - early, (at + 1) * spacing - early
            for low, high, first, last in ((start, start + over, before, after), (start + over, end, after, after)):
                if high > low:
                    starts.append(low)
                    rise = Fraction(last - first, teeth) / (high - low)
                    lines.append((rise - mean, 2 * pi * (Fraction(first, teeth) - mean * low)))
        coefficients = np.vstack([np.zeros((2, len(lines))), np.array(lines, dtype=float).T])
        period = 2 * pi * float(len(moves) * spacing)
        super().__init__(mean, PeriodicPieces(2 * pi * np.array(starts, dtype=float), coefficients, period))
        self.dwell = 1 - over * times * Fraction(sum(1 for each in moves if each), len(moves))

    def mirrored(self) -> StepTransmission:
        """Return the function itself: an engagement begins at S = 0 in either sense of the driver."""
        return self
