"""Centre distance and transmission function of a non-circular wheel with its conjugate mate.

Wheels with the pitch radii r and C - r roll on each other with the speed ratio r/(C - r). Its integral over the angle
of the driver is the driven angle, by adaptive Chebyshev interpolation.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.periodic_function import PeriodicFunction, PeriodicTable
from geartrain.numerics.polynomial_pieces import fitted, value_alone
from geartrain.numerics.roots import root

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

_HALVINGS = 12  # of the distance between the pitch curve and the axis of its mate in the search for C


class PitchCurveDeviation(PeriodicFunction):
    """Deviation from uniform motion of the mate of a wheel with the radii r of its pitch curve, 0 at its first radius.

    radii      radii at equal angles over one lobe, joined by a periodic cubic spline
    distance   distance C between the axes
    period     angle of one lobe [rad]
    """

    def __init__(self, radii: tuple[float, ...], distance: float, period: float) -> None:
        self.curve, self.distance, self.period = pitch_curve(radii, period), distance, period
        ends = pairwise([*self.curve.breakpoints.tolist(), period])
        pieces = [piece for low, high in ends for piece in fitted(self._ratio, low, high)]
        self.breakpoints = np.array([piece.start for piece in pieces])
        self._halves = np.diff(self.breakpoints, append=period) / 2
        ratio = np.array([piece.coefficients[:, 0] for piece in pieces]).T
        # antiderivative on each piece, continued from piece to piece
        rising = np.polynomial.polynomial.polyint(ratio, lbnd=-1) * self._halves
        passed = np.cumsum(rising.sum(axis=0))
        rising[0, 1:] += passed[:-1]
        self._angle = rising
        self.mean = float(passed[-1]) / period
        """Mean speed ratio."""

    def _ratio(self, x: Floats) -> Floats:
        # one-sided limits are not needed: the spline is twice differentiable
        r = self.curve(x)
        return np.asarray((r / (self.distance - r))[None])

    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the derivative of an order from 0 (the deviation) to 3 at any positions."""
        x = np.asarray(np.mod(np.asarray(x, dtype=float), self.period), dtype=float)
        if order == 0:
            piece = np.searchsorted(self.breakpoints, x, side="right") - 1
            u = (x - self.breakpoints[piece]) / self._halves[piece] - 1
            return value_alone(self._angle, piece, u) - self.mean * x
        r, slope, bend = (self.curve.derivative(x, each) for each in range(3))
        C, rest = self.distance, self.distance - r
        if order == 1:
            return np.asarray(r / rest - self.mean)
        if order == 2:
            return np.asarray(C * slope / rest**2)
        return np.asarray(C * bend / rest**2 + 2 * C * slope**2 / rest**3)


def pitch_curve(radii: tuple[float, ...], period: float) -> PeriodicTable:
    """Return the radius of a pitch curve as a function of the angle [rad], a spline through radii at equal angles."""
    steps = (np.arange(len(radii)) * (period / len(radii))).tolist()
    return PeriodicTable(steps, radii, period, "cubic")


@lru_cache(maxsize=32)
def mate_distance(radii: tuple[float, ...], ratio: float) -> float:
    """Return the distance C between the axes for which the mean of r/(C - r) over a lobe is `ratio`.

    radii   radii at equal angles over one lobe of the driver

    Raises `RangeError` if the spline reaches radius 0, or if no mate closes.
    """
    low, high = pitch_curve(radii, 2 * pi).extremes()
    if low <= 0:
        what = "the pitch curve passes through its own axis"
        why = f"the spline through its radii has the minimum {low:g}"
        raise RangeError(Problem(what, why, "give more radii, or radii that vary less"))

    def excess(distance: float) -> float:
        return PitchCurveDeviation(radii, distance, 2 * pi).mean - ratio

    # the mean decreases with C, from no bound at the maximum radius
    far = high * (1 + 1 / ratio)
    for halving in range(_HALVINGS):
        near = high + (far - high) / 2 ** (halving + 1)
        if (at := excess(near)) >= 0:
            return root(excess, near, far, at, min(excess(far), 0.0))
        far = near
    what, why = "no mate of the pitch curve closes", "its axis would lie on the driver's pitch curve"
    raise RangeError(Problem(what, why, "give radii that vary less, or more lobes of the driven wheel"))
