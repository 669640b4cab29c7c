"""Transmission functions as tables that a kernel reads: polynomials on cells, cut where the law has corners.

A blow is a jump of the speed ratio, and a table read across one makes it many small blows that lose less. So cells end
at `law.corners()`, and each side of a corner follows that side alone. Angle and speed ratio come from one polynomial
and its derivative: what holds the gap of two flanks closed is then the gradient of that gap to the last digit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import floor, inf
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_table import DEGREE, CellTable, fit

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction

TOLERANCE = 1e-10  # of a driven pitch: the rounding of angles after a thousand turns
_SAME = 1e-6  # of the mean ratio: a smaller jump is a kink


class LawTables(NamedTuple):
    """Periodic functions of a driver's angle, one after another.

    period, slope   of each function: it is slope S + a periodic part (slope 0 where it is no angle)
    cells           uniform cells in a period; `start`, the first of them in `first`
    first           the piece in which each uniform cell begins; pieces lie in order
    ends, middles   of the pieces (rad behind the start of the period); the last end of a function is infinite
    coefficients    of the pieces about their middles, (pieces, DEGREE + 1)
    jump            least jump of the derivative at a corner; infinite where there is none
    """

    period: Floats
    slope: Floats
    cells: Ints
    start: Ints
    first: Ints
    ends: Floats
    middles: Floats
    coefficients: Floats
    jump: Floats


class TabledFunction(NamedTuple):
    """One function for `LawTables`, with the greatest differences of value and derivative found between nodes."""

    slope: float
    table: CellTable
    jump: float
    uncertainty: float
    slope_uncertainty: float

    def __call__(self, S: Floats) -> Floats:
        """The function at driver's angles (rad)."""
        found: Floats = self.slope * S + self.table(S)
        return found


def tabled_angle(law: TransmissionFunction, tolerance: float = TOLERANCE) -> TabledFunction:
    """The driven angle q(S) of a law, whose derivative is its speed ratio."""
    ratio = float(law.ratio)
    cuts = _cuts(law)
    table = fit(law.error, law.period, cuts, tolerance * (ratio or 1.0) * law.period)
    breaks = _breaks(table)
    inside = (breaks[:-1, None] + np.diff(breaks)[:, None] * np.array([0.03, 0.25, 0.5, 0.75, 0.97])).ravel()
    pieces = np.repeat(np.arange(len(breaks) - 1), 5)
    x = inside - table.middles[pieces]
    slopes = sum(at * table.coefficients[at][pieces] * x ** (at - 1) for at in range(1, DEGREE + 1))
    off = np.abs(slopes + ratio - law.speed(inside))
    away = 1e-9 * law.period
    jumps = [abs(float(law.speed(cut + away) - law.speed(cut - away))) for cut in cuts]
    real = [jump for jump in jumps if jump > _SAME * (ratio or 1.0)]
    return TabledFunction(ratio, table, min(real, default=inf), table.uncertainty, float(np.nanmax(off)))


def tabled_function(
    function: Callable[[Floats], Floats], law: TransmissionFunction, tolerance: float = 1e-8
) -> TabledFunction:
    """A function of the driver's angle that has the corners of a law, such as what its friction adds to an arm."""
    table = fit(function, law.period, _cuts(law), tolerance)
    return TabledFunction(0.0, table, inf, table.uncertainty, inf)


def join_tables(functions: Sequence[TabledFunction]) -> LawTables:
    """Functions in the arrays that kernels read; a function's number is its place in the sequence."""
    first, ends, middles, coefficients, start = [], [], [], [], []
    pieces = cells = 0
    for each in functions:
        table = each.table
        breaks = _breaks(table)
        uniform = np.arange(table.cells) * (table.period / table.cells)
        own = np.searchsorted(breaks[1:-1], uniform, side="right")
        first.append(own + pieces)
        ends.append(np.append(breaks[1:-1], inf))
        middles.append(table.middles)
        coefficients.append(table.coefficients.T)
        start.append(cells)
        cells += table.cells
        pieces += len(table.middles)
    return LawTables(
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
def value_and_slope(laws: LawTables, which: int, S: float) -> tuple[float, float]:
    """A function and its derivative at a driver's angle (rad)."""
    period = laws.period[which]
    u = S - floor(S / period) * period
    cell = int(u * laws.cells[which] / period)
    if cell >= laws.cells[which]:
        cell = laws.cells[which] - 1
    piece = laws.first[laws.start[which] + cell]
    while u >= laws.ends[piece]:
        piece += 1
    x = u - laws.middles[piece]
    # Horner's scheme for the polynomial and its derivative, DEGREE = 4
    value = laws.coefficients[piece, 4]
    slope = value
    value = value * x + laws.coefficients[piece, 3]
    slope = slope * x + value
    value = value * x + laws.coefficients[piece, 2]
    slope = slope * x + value
    value = value * x + laws.coefficients[piece, 1]
    slope = slope * x + value
    value = value * x + laws.coefficients[piece, 0]
    return value + laws.slope[which] * S, slope + laws.slope[which]


def _cuts(law: TransmissionFunction) -> Floats:
    return np.unique(np.mod(np.asarray(law.corners(), dtype=float), law.period))


def _breaks(table: CellTable) -> Floats:
    uniform = np.arange(table.cells + 1) * (table.period / table.cells)
    return np.sort(np.concatenate((uniform, table.corners)))


def _joined(parts: Sequence[Floats | Ints], kind: type) -> Any:
    return np.concatenate(parts).astype(kind) if parts else np.zeros(0, kind)
