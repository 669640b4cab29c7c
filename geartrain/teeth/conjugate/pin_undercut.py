"""What pins cut off the flanks of their mate on their way in: where a flank really begins.

Where the contact would stand still on the mate's flank, the envelope of the pins has a cusp and turns back. A pin that
comes in before that sweeps over the flank a little beyond the cusp too, often beyond the pitch point. That is no matter
of the contact's own speeds: the flank as drawn is regular there.
"""

from __future__ import annotations

from math import acos, inf, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.closed_form_sides import pin_angle

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Points = NDArray[np.complex128]

_SCAN, _NARROWED = 129, 6  # positions in a bracket, and how often it is narrowed, by 64 each time
_FARTHEST = 0.6  # of the way to the far side of the lantern


def flank_start(R: float, A: float, B: float, mate: float) -> float:
    """X, from the pitch point outwards, of the first contact that the pins leave of the mate's flank; -inf for all.

    R, A, B   pitch radius, distance from the axle and radius of the pins; `mate` the pitch radius of the mate, negative
    for a ring. Below 0 the flank reaches inside the pitch point.
    """
    first = pin_angle(R, A, B)
    far = first + _FARTHEST * (acos(-1.0) - first)
    found = _cusp(R, A, B, mate, far)
    cusp = found or 0.0

    def left(beta: float) -> float:
        point, spans = _flank(R, A, B, mate, beta), ((-far, -beta), (-beta, 0.0), (0.0, cusp))
        return min(_nearest(R, A, mate, point, *span) for span in spans) - B

    # the farther out the less is cut: from the cusp outwards in growing steps to where nothing is
    step, low, high = 0.05 * first, cusp, far
    while cusp + step < far:
        if left(cusp + step) > 0:
            high = cusp + step
            break
        low, step = cusp + step, 1.5 * step
    at_high = left(high)
    # at the cusp itself nothing is asked: a pin on its pitch circle may stand at the pitch point there
    if low == cusp or at_high <= 0 or (at_low := left(low)) >= 0:
        return R * ((cusp if at_high > 0 else far) - first) if found or at_high <= 0 else -inf
    return R * (root(left, low, high, at_low, at_high) - first)


def _cusp(R: float, A: float, B: float, mate: float, far: float) -> float | None:
    """The greatest angle of the pin at which its contact stands still on the mate; None where it never does."""

    def speed(beta: float) -> float:
        L = sqrt((A - R) ** 2 + 4 * A * R * float(np.sin(beta / 2)) ** 2)
        sine = (L + (R - A) * (R + A) / L) / (2 * R)
        rise = (1 - (R - A) * (R + A) / L**2) / (2 * R)
        return sine + (L - B) * (rise + 1 / mate)

    grid = np.linspace(0, far, _SCAN)[1:]
    speeds = np.array([speed(beta) for beta in grid])
    still = np.flatnonzero(speeds <= 0)
    if still.size == 0:
        # at 0 itself L is |A - R|, which may be 0: then the speed is not defined
        least = 1e-9 * far
        return root(speed, least, grid[0], speed(least), speeds[0]) if speed(least) < 0 else None
    at = int(still[-1])
    return far if at == len(grid) - 1 else root(speed, grid[at], grid[at + 1], speeds[at], speeds[at + 1])


def _flank(R: float, A: float, B: float, mate: float, beta: float) -> complex:
    """Point of the mate that a pin at the angle beta touches, from the mate's axle."""
    at = np.array([beta])
    G = _centre(R, A, at)
    return complex(_turned(R, mate, G * (1 - B / np.abs(G)) + 1j * mate, at)[0])


def _nearest(R: float, A: float, mate: float, point: complex, low: float, high: float) -> float:
    """Least distance from a point of the mate to the centres of pins between two angles."""
    distance = inf
    for _ in range(_NARROWED):
        t = np.linspace(low, high, _SCAN)
        found = np.abs(_turned(R, mate, _centre(R, A, t) + 1j * mate, t) - point)
        at = int(np.argmin(found))
        distance = min(distance, float(found[at]))
        low, high = float(t[max(at - 1, 0)]), float(t[min(at + 1, _SCAN - 1)])
    return distance


def _centre(R: float, A: float, beta: Floats) -> Points:
    """Centre of the pin from the pitch point, as x + iy."""
    found: Points = 1j * R - 1j * A * np.exp(1j * beta)
    return found


def _turned(R: float, mate: float, point: Points, beta: Floats) -> Points:
    """A point from the mate's axle as the mate bears it when the lantern has turned by beta."""
    found: Points = point * np.exp(1j * R / mate * beta)
    return found
