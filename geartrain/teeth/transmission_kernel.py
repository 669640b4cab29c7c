"""Transmission laws as one set of arrays, and the kernel that reads them: error and speed of a law at many angles.

Each law stands as two tables of polynomials (`transmission_table`), one of its error and one of its speed, which follow
it to rounding, or are those from which it is read anyway.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.transmission_table import CellTable, HasCorners, TabulatedTransmission, fit, folded_corners

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints

DEGREE = 6  # a law to rounding in 32 to 512 cells: above, the fit itself rounds more; below, tables leave the cache
CELL = 2 * (DEGREE + 2)  # numbers of a cell, side by side: two lines of a cache, where columns would take one a number
_WANTED = 1e-15  # of a driven pitch, or of the speed: as finely as the law itself is known
_GOOD = 1e-12  # of the same: a law that no table follows so well is asked itself


class TransmissionTables(NamedTuple):
    """Laws by number.

    period, inverse   of each law: the driver's angle (rad), and 1 / it
    coarse, rest      the period as the sum of two floats, the first of 24 bits
    density           of each law: uniform cells of a period over it (1/rad)
    first, last       of each law: its first and last cell, cut at corners
    cuts, corners     of each law: `corners[cuts[k]:cuts[k + 1]]` (rad)
    cells             `CELL` numbers a cell, error and speed in turns: middle (rad), then the highest power first
    """

    period: Floats
    inverse: Floats
    coarse: Floats
    rest: Floats
    density: Floats
    first: Ints
    last: Ints
    cuts: Ints
    corners: Floats
    cells: Floats


class PeriodicLaw(HasCorners, Protocol):
    """What a table is made from: a transmission function is one."""

    @property
    def ratio(self) -> Fraction:
        """Mean speed ratio."""

    def error(self, S: Floats) -> Floats:
        """Transmission error (rad) at the driver's angles (rad)."""

    def speed(self, S: Floats) -> Floats:
        """Speed ratio there."""


class TransmissionTable(NamedTuple):
    """Error and speed of one law over its period (rad)."""

    period: float
    error: CellTable
    speed: CellTable


def make_transmission_table(law: PeriodicLaw) -> TransmissionTable | None:
    """Tables of a law: those from which it is read anyway, or else such as follow it to rounding.

    None where there are none: for a law with gaps, or one that changes from angle to angle.
    """
    if isinstance(law, TransmissionFunction) and type(law).picked is not TransmissionFunction.picked:
        return None
    if isinstance(law, TabulatedTransmission):
        found = TransmissionTable(law.period, law.error_table, law.speed_table)
        good = law.degree <= DEGREE
    else:
        ratio = float(law.ratio) or 1.0
        cuts = folded_corners(law)
        error = fit(law.error, law.period, cuts, _WANTED * ratio * law.period, DEGREE)
        speed = fit(law.speed, law.period, cuts, _WANTED * ratio, DEGREE)
        # of both in the same cells an angle is looked up once
        if error.cells < speed.cells:
            error = CellTable(law.error, law.period, cuts, speed.cells, DEGREE)
        elif speed.cells < error.cells:
            speed = CellTable(law.speed, law.period, cuts, error.cells, DEGREE)
        found = TransmissionTable(law.period, error, speed)
        good = found.error.uncertainty <= _GOOD * ratio * law.period and found.speed.uncertainty <= _GOOD * ratio
    # where a gap begins depends on which side of it rounding falls
    whole = all(np.isfinite(table.coefficients).all() for table in (found.error, found.speed))
    return found if good and whole else None


def join_transmission_tables(laws: Sequence[TransmissionTable]) -> TransmissionTables:
    """Tables of laws by their numbers."""
    period = np.array([law.period for law in laws])
    coarse = period.astype(np.float32).astype(float)
    corners = [law.error.corners for law in laws]
    cells = [_cells(law) for law in laws]
    ends = np.cumsum([0, *(len(each) for each in cells)], dtype=np.int64)
    return TransmissionTables(
        period,
        1 / period,
        coarse,
        period - coarse,
        np.array([max(law.error.cells, law.speed.cells) / law.period for law in laws]),
        ends[:-1],
        ends[1:] - 1,
        np.concatenate(([0], np.cumsum([len(each) for each in corners]))).astype(np.int64),
        np.concatenate([np.zeros(0), *corners]),
        np.concatenate([np.zeros(0), *(each.ravel() for each in cells)]),
    )


def _cells(law: TransmissionTable) -> Floats:
    """Cells of a law, (n, `CELL`): those of the finer of its two tables, each with the cell of the other it lies in."""
    finer = max(law.error, law.speed, key=lambda table: table.cells)
    found = np.zeros((len(finer.middles), CELL))
    for part, table in enumerate((law.error, law.speed)):
        at = np.arange(len(finer.middles))
        if table.cells < finer.cells:
            at = np.clip(np.searchsorted(table.breaks, finer.middles, side="right") - 1, 0, len(table.middles) - 1)
        found[:, part] = table.middles[at]
        # a lower degree begins with coefficients 0, which changes no bit
        found[:, part + 2 * (DEGREE + 1 - table.degree) :: 2] = table.coefficients[::-1, at].T
    return found


@kernel
def law_along(
    tables: TransmissionTables,
    law: int,
    angle: Floats,
    error: Floats,
    speed: Floats,
    u: Floats,
    cell: NDArray[np.int32],
) -> None:
    """Transmission error (rad) and speed ratio of a law at its driver's angles (rad).

    `u` and `cell` are scratch. `CellTable` operation by operation, in loops most of which become vector operations.
    """
    inverse, coarse, rest = tables.inverse[law], tables.coarse[law], tables.rest[law]
    density, first, last = tables.density[law], tables.first[law], tables.last[law]
    for at in range(len(angle)):
        S = angle[at]
        periods = np.floor(S * inverse)
        u[at] = (S - periods * coarse) - periods * rest
    for at in range(len(angle)):
        cell[at] = np.int32(u[at] * density)
    for corner in tables.corners[tables.cuts[law] : tables.cuts[law + 1]]:
        for at in range(len(angle)):
            cell[at] += np.int32(u[at] >= corner)
    for at in range(len(angle)):
        # clipped: rounding may lead past either end
        cell[at] = min(max(cell[at], 0), last - first)
    for at in range(len(angle)):
        error[at], speed[at] = _polynomials(tables.cells, np.uint64(CELL) * np.uint64(first + cell[at]), u[at])


@kernel
def _polynomials(cells: Floats, begin: np.uint64, u: float) -> tuple[float, float]:
    """Error and speed from the numbers of a cell by Horner's rule, side by side."""
    x, y = u - cells[begin], u - cells[begin + np.uint64(1)]
    at, one, two = begin + np.uint64(2), np.uint64(1), np.uint64(2)
    error, speed = cells[at], cells[at + one]
    for _ in range(DEGREE):
        at += two
        error, speed = error * x + cells[at], speed * y + cells[at + one]
    return error, speed
