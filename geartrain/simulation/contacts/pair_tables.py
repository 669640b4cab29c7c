"""Tables of transmission functions for the kernels: piecewise polynomials whose cells end at the kinks of the function.

An impact is a jump of the speed ratio, which interpolation across a kink would replace by many small impacts that lose
less energy. The speed ratio is the derivative of the tabulated angle, so that it is the exact gradient of the gap.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import floor, inf
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_table import DEGREE, CellTable, fit, folded_kinks

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction

TOLERANCE = 1e-10  # driven pitches; the rounding of angles after a thousand revolutions
_SAME = 1e-6  # relative to the mean ratio: a smaller jump of the speed ratio does not cause an impact


class PairTables(NamedTuple):
    """Concatenated tables of many functions of a driver angle, each with a periodic part."""

    period: Floats
    """Period of each function in the driver angle [rad]."""
    slope: Floats
    """Mean slope of each function (factor of the driver angle); 0 if the function is not an angle."""
    cells: Ints
    """Number of uniform cells in the period of each function. `start` contains the index in `first` of its
    first cell.
    """
    start: Ints
    first: Ints
    """Index of the piece in which each uniform cell begins. Pieces are in ascending order of driver angle."""
    ends: Floats
    """Upper limits of the pieces [rad from the start of the period]. The last limit of each function is infinite."""
    middles: Floats
    """Midpoints of the pieces [rad from the start of the period]."""
    coefficients: Floats
    """Coefficients of the polynomial of each piece about its midpoint, shape (pieces, DEGREE + 1)."""
    jump: Floats
    """Minimum jump of the derivative of each function at its kinks; infinite if there are no jumps."""


class TabledFunction(NamedTuple):
    """Function of a driver angle S [rad]: the sum of `slope` S and a periodic function, which is given by a table.
    `jump` is the minimum size of the jumps of its derivative.
    """

    slope: float
    table: CellTable
    jump: float

    def __call__(self, S: Floats) -> Floats:
        """Return the values of the function at driver angles S [rad]."""
        found: Floats = self.slope * S + self.table(S)
        return found


def tabled_angle(transmission: TransmissionFunction) -> TabledFunction:
    """Return a table of the driven angle q(S) of a transmission function. The derivative of q is the speed ratio."""
    ratio = float(transmission.ratio)
    cuts = folded_kinks(transmission)
    table = fit(transmission.error, transmission.period, cuts, TOLERANCE * (ratio or 1.0) * transmission.period)
    # both sides of a kink, beyond the rounding of its position
    away = 1e-9 * transmission.period
    jumps = np.abs(transmission.speed(cuts + away) - transmission.speed(cuts - away))
    minimum = np.min(jumps[jumps > _SAME * (ratio or 1.0)], initial=inf)
    return TabledFunction(ratio, table, float(minimum))


def tabled_function(
    function: Callable[[Floats], Floats], transmission: TransmissionFunction, tolerance: float = 1e-8
) -> TabledFunction:
    """Return a table of a function of the driver angle, such as a friction term, with pieces that end at the kinks of a
    transmission function.
    """
    return TabledFunction(0.0, fit(function, transmission.period, folded_kinks(transmission), tolerance), inf)


def join_tables(functions: Sequence[TabledFunction]) -> PairTables:
    """Return the tables of several functions, concatenated in the given order into the arrays that the kernels need."""
    first, ends, middles, coefficients, start = [], [], [], [], []
    pieces = cells = 0
    for each in functions:
        # pieces are found by the uniform cell that contains their start, without a search
        table = each.table
        breaks = table.breaks
        uniform = np.arange(table.cells) * (table.period / table.cells)
        own = np.searchsorted(breaks[1:-1], uniform, side="right")
        first.append(own + pieces)
        ends.append(np.append(breaks[1:-1], inf))
        middles.append(table.middles)
        coefficients.append(table.coefficients.T)
        start.append(cells)
        cells += table.cells
        pieces += len(table.middles)
    return PairTables(
        np.array([each.table.period for each in functions], dtype=np.float64),
        np.array([each.slope for each in functions], dtype=np.float64),
        np.array([each.table.cells for each in functions], dtype=np.int64),
        np.array(start, dtype=np.int64),
        _joined(first, np.int64),
        _joined(ends, np.float64),
        _joined(middles, np.float64),
        np.ascontiguousarray(np.concatenate(coefficients)) if coefficients else np.zeros((0, DEGREE + 1)),
        np.array([each.jump for each in functions], dtype=np.float64),
    )


@kernel
def value_and_slope(transmissions: PairTables, which: int, S: float) -> tuple[float, float]:
    """Return the value and derivative of transmission function number `which` at the driver angle S [rad]."""
    period = transmissions.period[which]
    u = S - floor(S / period) * period
    if not 0.0 <= u < period:  # rounded up to the period, beyond the resolution of floats, or NaN
        u = 0.0
    cell = int(u * transmissions.cells[which] / period)
    # rounding of the quotient may reach the number of cells
    cell = min(cell, transmissions.cells[which] - 1)
    piece = transmissions.first[transmissions.start[which] + cell]
    # a uniform cell may contain several pieces, because kinks cut it
    while u >= transmissions.ends[piece]:
        piece += 1
    x = u - transmissions.middles[piece]
    # Horner's scheme for the polynomial and its derivative, DEGREE = 4
    value = transmissions.coefficients[piece, 4]
    slope = value
    value = value * x + transmissions.coefficients[piece, 3]
    slope = slope * x + value
    value = value * x + transmissions.coefficients[piece, 2]
    slope = slope * x + value
    value = value * x + transmissions.coefficients[piece, 1]
    slope = slope * x + value
    value = value * x + transmissions.coefficients[piece, 0]
    return value + transmissions.slope[which] * S, slope + transmissions.slope[which]


def _joined(parts: Sequence[Floats | Ints], kind: type) -> Any:
    return np.concatenate(parts).astype(kind) if parts else np.zeros(0, kind)
