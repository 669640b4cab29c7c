"""Transmission functions as tables that a kernel reads: polynomials on cells, cut where the law has corners.

A blow is a jump of the speed ratio, and a table read across one makes it many small blows that lose less. So cells end
at `transmission.kinks()`, and each side of a corner follows that side alone. Angle and speed ratio come from one
polynomial
and its derivative: what holds the gap of two flanks closed is then the gradient of that gap to the last digit.

Motion, which asks one law at many angles at once, reads error and speed from a table each
(`teeth.transmission_table`); here one angle is asked of many laws in turn.
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

TOLERANCE = 1e-10  # of a driven pitch: the rounding of angles after a thousand turns
_SAME = 1e-6  # of the mean ratio: a smaller jump is a kink


class PairTables(NamedTuple):
    """Periodic functions of a driver's angle, one after another."""

    period: Floats
    """Of each function: it is slope S + a periodic part (slope 0 where it is no angle)."""
    slope: Floats
    """Of each function: it is slope S + a periodic part (slope 0 where it is no angle)."""
    cells: Ints
    """Uniform cells in a period; `start`, the first of them in `first`."""
    start: Ints
    first: Ints
    """The piece in which each uniform cell begins; pieces lie in order."""
    ends: Floats
    """Of the pieces (rad behind the start of the period); the last end of a function is infinite."""
    middles: Floats
    """Of the pieces (rad behind the start of the period); the last end of a function is infinite."""
    coefficients: Floats
    """Of the pieces about their middles, (pieces, DEGREE + 1)."""
    jump: Floats
    """Least jump of the derivative at a corner; infinite where there is none."""


class TabledFunction(NamedTuple):
    """One function for `PairTables`."""

    slope: float
    table: CellTable
    jump: float

    def __call__(self, S: Floats) -> Floats:
        """The function at driver's angles (rad)."""
        found: Floats = self.slope * S + self.table(S)
        return found


def tabled_angle(transmission: TransmissionFunction, tolerance: float = TOLERANCE) -> TabledFunction:
    """The driven angle q(S) of a law, whose derivative is its speed ratio."""
    ratio = float(transmission.ratio)
    cuts = folded_kinks(transmission)
    table = fit(transmission.error, transmission.period, cuts, tolerance * (ratio or 1.0) * transmission.period)
    away = 1e-9 * transmission.period
    jumps = np.abs(transmission.speed(cuts + away) - transmission.speed(cuts - away))
    minimum = np.min(jumps[jumps > _SAME * (ratio or 1.0)], initial=inf)
    return TabledFunction(ratio, table, float(minimum))


def tabled_function(
    function: Callable[[Floats], Floats], transmission: TransmissionFunction, tolerance: float = 1e-8
) -> TabledFunction:
    """A function of the driver's angle that has the corners of a law, such as what its friction adds to an arm."""
    return TabledFunction(0.0, fit(function, transmission.period, folded_kinks(transmission), tolerance), inf)


def join_tables(functions: Sequence[TabledFunction]) -> PairTables:
    """Functions in the arrays that kernels read; a function's number is its place in the sequence."""
    first, ends, middles, coefficients, start = [], [], [], [], []
    pieces = cells = 0
    for each in functions:
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
    """A function and its derivative at a driver's angle (rad)."""
    period = transmissions.period[which]
    u = S - floor(S / period) * period
    if not 0.0 <= u < period:  # rounded up to it, or so far that no digit is left, or no number
        u = 0.0
    cell = int(u * transmissions.cells[which] / period)
    cell = min(cell, transmissions.cells[which] - 1)
    piece = transmissions.first[transmissions.start[which] + cell]
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
