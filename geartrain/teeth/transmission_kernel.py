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
_WANTED = 1e-15  # of a driven pitch, or of the speed: as finely as the law itself is known
_GOOD = 1e-12  # of the same: a law that no table follows so well is asked itself


class TransmissionTables(NamedTuple):
    """Laws by number; table 2 k is the error of law k, table 2 k + 1 its speed ratio.

    period, inverse   of each law: the driver's angle (rad), and 1 / it
    coarse, rest      the period as the sum of two floats, the first of 24 bits
    density           of each table: uniform cells of a period over it (1/rad)
    first, last       of each table: its first and last cell, cut at corners, by row of the two arrays below
    cuts, corners     of each law: `corners[cuts[k]:cuts[k + 1]]` (rad)
    middles           of each cell (rad)
    coefficients      (`DEGREE` + 1, cells), the highest power first
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
    middles: Floats
    coefficients: Floats


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
    tables = [table for law in laws for table in (law.error, law.speed)]
    counts = np.array([len(table.middles) for table in tables], dtype=np.int64)
    first = np.concatenate(([0], np.cumsum(counts)[:-1])).astype(np.int64)
    coefficients: Floats = np.zeros((DEGREE + 1, int(counts.sum())))
    for at, table in zip(first, tables, strict=True):
        # a lower degree begins with coefficients 0, which changes no bit
        coefficients[DEGREE - table.degree :, at : at + len(table.middles)] = table.coefficients[::-1]
    corners = [law.error.corners for law in laws]
    return TransmissionTables(
        period,
        1 / period,
        coarse,
        period - coarse,
        np.array([table.cells / table.period for table in tables]),
        first,
        first + counts - 1,
        np.concatenate(([0], np.cumsum([len(each) for each in corners]))).astype(np.int64),
        np.concatenate([np.zeros(0), *corners]),
        np.concatenate([np.zeros(0), *(table.middles for table in tables)]),
        coefficients,
    )


@kernel
def law_along(
    tables: TransmissionTables, law: int, S: Floats, error: Floats, speed: Floats, u: Floats, cell: NDArray[np.int32]
) -> None:
    """Transmission error (rad) and speed ratio of a law at its driver's angles S (rad); `u` and `cell` are scratch.

    `CellTable` operation by operation, in loops that a compiler turns into vector operations.
    """
    inverse, coarse, rest = tables.inverse[law], tables.coarse[law], tables.rest[law]
    corners = tables.corners[tables.cuts[law] : tables.cuts[law + 1]]
    for at in range(len(S)):
        periods = np.floor(S[at] * inverse)
        u[at] = (S[at] - periods * coarse) - periods * rest
    for part in range(2):
        table = 2 * law + part
        density, first, last = tables.density[table], tables.first[table], tables.last[table]
        if part == 0 or density != tables.density[table - 1]:
            for at in range(len(S)):
                cell[at] = np.int32(u[at] * density)
            for corner in corners:
                for at in range(len(S)):
                    cell[at] += np.int32(u[at] >= corner)
            for at in range(len(S)):
                # clipped: rounding may lead past either end
                cell[at] = min(max(cell[at], 0), last - first)
        found = error if part == 0 else speed
        for at in range(len(S)):
            chosen = np.uint32(first + cell[at])
            found[at] = _polynomial(tables.coefficients, chosen, u[at] - tables.middles[chosen])


@kernel
def _polynomial(coefficients: Floats, cell: np.uint32, x: float) -> float:
    """Horner's rule, written out: the compiler then needs no loop."""
    found = coefficients[0, cell]
    found = found * x + coefficients[1, cell]
    found = found * x + coefficients[2, cell]
    found = found * x + coefficients[3, cell]
    found = found * x + coefficients[4, cell]
    found = found * x + coefficients[5, cell]
    return found * x + coefficients[6, cell]  # type: ignore[no-any-return]
