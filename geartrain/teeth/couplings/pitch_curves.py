"""Centre distance and transmission function of a non-circular wheel with its conjugate mate, by quadrature.

Wheels with the pitch radii r and C - r roll on each other with the speed ratio r/(C - r).
"""

from __future__ import annotations

from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.polynomial_pieces import extremes, fitted, value
from geartrain.numerics.roots import root
from geartrain.teeth.couplings.table_transmission import TableTransmission, spline_pieces

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.polynomial_pieces import PolynomialPiece

_NEAR = 1e-9  # relative: distance of the mate's axis from the pitch curve at which the search for C begins


@lru_cache(maxsize=32)
def mate_distance(radii: tuple[float, ...], ratio: float) -> float:
    """Return the distance C between the axes for which the mean of r/(C - r) over a lobe is `ratio`.

    radii   radii at equal angles over one lobe of the driver, joined by a periodic cubic spline

    Raises `RangeError` if the spline reaches radius 0, or if no mate closes.
    """
    low, high = extremes(spline_pieces(np.array(radii)))
    if low <= 0:
        what, why = (
            "the pitch curve passes through its own axis",
            f"the spline through its radii has the minimum {low:g}",
        )
        raise RangeError(Problem(what, why, "give more radii, or radii that vary less"))
    if high - low < _NEAR * high:
        return high * (1 + 1 / ratio)
    # the mean decreases with C, without bound towards the maximum radius
    start, end = max(low * (1 + 1 / ratio), high * (1 + _NEAR)), high * (1 + 1 / ratio)

    def excess(C: float) -> float:
        return sum(_mean(piece) * (piece.end - piece.start) for piece in _ratio(radii, C)) / len(radii) - ratio

    at = excess(start), excess(end)
    if at[0] < 0:
        what, why = "no mate of the pitch curve closes", "its pitch curve would reach the driver's longest radius"
        raise RangeError(Problem(what, why, "give radii that vary less, or more lobes of the driven wheel"))
    return root(excess, start, end, *at)


def pitch_curve_transmission(
    radii: tuple[float, ...], distance: float, ratio: Fraction, lobes: int, phase: float
) -> TableTransmission:
    """Return the transmission function of a wheel with a given pitch curve that drives its conjugate mate.

    The deviation from uniform motion is 0 at the first radius.

    radii      radii at equal angles over one of the `lobes` of the driver
    distance   distance between the axes
    phase      angle of the driver at S = 0 [rad]
    """
    step = 2 * pi / (lobes * len(radii))
    pieces = _ratio(radii, distance)
    edges = step * np.array([*(piece.start for piece in pieces), float(len(radii))])
    halves = np.diff(edges) / 2
    slopes = np.array([piece.coefficients[:, 0] for piece in pieces]).T
    slopes[0] -= float(ratio)
    # antiderivative on each piece, 0 at its start
    powers = np.arange(1, len(slopes) + 1)[:, None]
    rising = np.concatenate([np.zeros((1, len(halves))), slopes / powers]) * halves
    rising[0] = -(np.where(powers % 2, -1.0, 1.0) * rising[1:]).sum(axis=0)
    ends = np.cumsum(rising.sum(axis=0))
    rising[0] += np.concatenate([[0.0], ends[:-1]])
    return TableTransmission(ratio, edges, rising, phase)


def _ratio(radii: tuple[float, ...], distance: float) -> list[PolynomialPiece]:
    """Return the ratio r/(C - r) as pieces of a polynomial in the angle, in steps of the radii."""
    spline = spline_pieces(np.array(radii))

    def curve(x: Floats, at: int) -> Floats:
        r = value(spline, np.full(len(x), at), 2 * (x - at) - 1)[0]
        return np.asarray((r / (distance - r))[None])

    return [piece for at in range(len(radii)) for piece in fitted(lambda x, at=at: curve(x, at), at, at + 1)]


def _mean(piece: PolynomialPiece) -> float:
    """Return the mean of a piece."""
    powers = np.arange(len(piece.coefficients))
    return float((piece.coefficients[:, 0] * np.where(powers % 2, 0.0, 1 / (powers + 1.0))).sum())
