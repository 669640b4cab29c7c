"""Transmission functions of couplings that move in steps: Geneva drives, and engagements that move whole teeth."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate, pairwise
from math import copysign, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.periodic_function import PeriodicFunction, PeriodicPieces
from geartrain.teeth.couplings.table_transmission import TableTransmission

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


# of the angle between engagements: a step at once is complete if rounding leaves less than this to it
_EARLY = Fraction(1, 10**9)


class GenevaTransmission(TableTransmission):
    """Transmission function of a Geneva drive. At S = 0 the drive is in the middle of a step.

    At S = 0 a pin is on the line of centres, nearest to the driven axis in an external drive and farthest from the
    driven axis in an internal drive. With rho = sin(pi/n), the driven angle of an external drive is atan2(rho sin S, 1
    - rho cos S) while |S| <= pi/2 - pi/n, and pi/n during the rest. The driven angle of an internal drive is atan2(rho
    sin S, 1 + rho cos S) while |S| <= pi/2 + pi/n.

    slots      number of slots n, 3 or more
    pins       number of pins of the driver, evenly spaced
    internal   True if the pins are inside the driven wheel, which then turns in the sense of the driver
    """

    def __init__(self, slots: int, pins: int = 1, internal: bool = False) -> None:
        side = -1 if internal else 1
        self.alpha = pi / 2 - side * pi / slots
        """Driver angle between the middle of a step and its end [rad]."""
        self.dwell = 1 - pins * (Fraction(1, 2) - Fraction(side, slots))
        period = 2 * pi / pins
        # pins that follow each other without a rest end one step where the next one begins
        kinks = [self.alpha, period - self.alpha] if self.dwell else [self.alpha]
        deviation = _GenevaDeviation(side * sin(pi / slots), self.alpha, pins / slots, period, kinks)
        super().__init__(Fraction(pins, slots), deviation)

    def mirrored(self) -> GenevaTransmission:
        """Return this function itself, because its deviation is an odd function of the driver angle."""
        return self


class _GenevaDeviation(PeriodicFunction):
    """Deviation of a Geneva drive from uniform motion. During a step it is -Im log(1 - rho exp(i S)) - mean S, where S
    is the driver angle.

    rho     pin radius divided by the axis distance, negative for an internal drive
    alpha   driver angle from the middle of a step to its end [rad]
    mean    mean speed ratio
    """

    def __init__(self, rho: float, alpha: float, mean: float, period: float, kinks: list[float]) -> None:
        self.rho, self.alpha, self.mean, self.period = rho, alpha, mean, period
        self.breakpoints, self.resolution = np.array(kinks), period / 32

    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the deviation (`order` 0) or its derivative of order 1 to 3 at driver angles `x` [rad]."""
        x = np.asarray(x, dtype=float)
        u = x - self.period * np.rint(x / self.period)
        # at rest the angle is the angle at the end of the step
        w = self.rho * np.exp(1j * np.clip(u, -self.alpha, self.alpha))
        side = copysign(1, self.rho)
        if order == 0:
            return np.asarray(side * np.arctan2(w.imag, 1 - w.real) - self.mean * u)
        share = w / (1 - w)
        slope = (1j * share, -share / (1 - w), -1j * share * (1 + w) / (1 - w) ** 2)[order - 1].imag
        return np.where(np.abs(u) < self.alpha, side * slope, 0.0) - (self.mean if order == 1 else 0.0)


class StepTransmission(TableTransmission):
    """Transmission function of engagements that move whole teeth, either instantaneously or uniformly over a driver
    angle.

    The first engagement begins at S = 0. The driven angle is measured from the position of the driven link before this
    engagement.

    teeth   number of teeth of the driven wheel
    moves   teeth moved by successive engagements
    times   engagements in one revolution of the driver
    over    angle of the driver during which an engagement moves the teeth [turn]; 0 for instantaneous steps
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
        """Return this function itself. It also applies to a driver with the opposite forward sense, because an
        engagement begins at S = 0 in either sense.
        """
        return self
