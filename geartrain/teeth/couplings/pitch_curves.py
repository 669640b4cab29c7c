"""Centre distance and transmission function of a non-circular wheel with its conjugate mate.

Wheels with the pitch radii r and C - r roll on each other with the speed ratio r/(C - r). The driven angle is the
integral of this ratio over the angle of the driver, computed by adaptive Chebyshev interpolation.
"""

from __future__ import annotations

from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.periodic_function import PeriodicFunction, PeriodicTable, periodic_integral
from geartrain.numerics.roots import root

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_HALVINGS = 12  # of the distance between the pitch curve and the axis of its mate in the search for C


def mate_deviation(radii: tuple[float, ...], distance: float, period: float) -> tuple[PeriodicFunction, float]:
    """Return the deviation of a wheel's mate from uniform motion, which is 0 at the first radius of the wheel, and the
    mate's mean speed ratio.

    radii      radii of the pitch curve at equal angles over one lobe, joined by a periodic cubic spline
    distance   distance C between the axes
    period     angle of one lobe [rad]
    """
    curve = pitch_curve(radii, period)

    def ratio(x: Floats) -> Floats:
        r = curve(x)
        return r / (distance - r)

    return periodic_integral(ratio, period, curve.breakpoints)


def pitch_curve(radii: tuple[float, ...], period: float) -> PeriodicTable:
    """Return the radius of a pitch curve as a periodic spline of the angle [rad], through equally spaced `radii`."""
    steps = (np.arange(len(radii)) * (period / len(radii))).tolist()
    return PeriodicTable(steps, radii, period, "cubic")


@lru_cache(maxsize=32)
def mate_distance(radii: tuple[float, ...], ratio: float) -> float:
    """Return the distance C between the axes for which the mean of r/(C - r) over a lobe equals `ratio`, where r is the
    radius of the driver.

    radii   radii at equal angles over one lobe of the driver

    Raises `RangeError` if the spline reaches radius 0, or if no mate has a closed pitch curve.
    """
    low, high = pitch_curve(radii, 2 * pi).extremes()
    if low <= 0:
        what = "the pitch curve passes through its own axis"
        why = f"the spline through its radii has the minimum {low:g}"
        raise RangeError(Problem(what, why, "give more radii, or radii that vary less"))

    def excess(distance: float) -> float:
        return mate_deviation(radii, distance, 2 * pi)[1] - ratio

    # the mean decreases with C, from no bound at the maximum radius
    far = high * (1 + 1 / ratio)
    for halving in range(_HALVINGS):
        near = high + (far - high) / 2 ** (halving + 1)
        if (at := excess(near)) >= 0:
            return root(excess, near, far, at, min(excess(far), 0.0))
        far = near
    what, why = "no mate of the pitch curve closes", "its axis would lie on the driver's pitch curve"
    raise RangeError(Problem(what, why, "give radii that vary less, or more lobes of the driven wheel"))
