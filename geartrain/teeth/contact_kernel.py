"""What torques ask of a pair, as tables for kernels: its ratio, and what friction adds where its teeth touch.

One table of a flank has several functions of the driver's angle on the same cells: the speed ratio, then `into` and
`out` of each contact in turn (`ContactRubbing`), NaN where none is. An angle is looked up once for all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_kernel import DEGREE
from geartrain.teeth.transmission_table import CellTable, fit, folded_corners

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction

_WANTED = 1e-15  # of the ratio, or of power: as finely as the law itself is known
_GOOD = 1e-12  # of the same: what no table follows so well is asked itself
_CHECKED = 997  # angles of a period at which a table must have its gaps where the law has them


class ContactTable(NamedTuple):
    """Functions of one flank on the same cells."""

    functions: tuple[CellTable, ...]


class ContactTables(NamedTuple):
    """Flanks by number.

    period, inverse   of each: the driver's angle (rad), and 1 / it
    coarse, rest      the period as the sum of two floats, the first of 24 bits
    density           uniform cells of a period over it (1/rad)
    cells             how many cells it has, cut at corners; `first`, the row of the first one's first function
    cuts, corners     of each: `corners[cuts[k]:cuts[k + 1]]` (rad)
    contacts          how many of them may touch at once
    middles           of each cell, in the rows of the first function (rad)
    coefficients      (rows, `DEGREE` + 1), the highest power first; one function after another
    """

    period: Floats
    inverse: Floats
    coarse: Floats
    rest: Floats
    density: Floats
    cells: Ints
    first: Ints
    cuts: Ints
    corners: Floats
    contacts: Ints
    middles: Floats
    coefficients: Floats


def make_contact_table(law: TransmissionFunction, rubs: bool) -> ContactTable | None:
    """The table of one flank; None for a law that no table follows.

    rubs   with what friction adds, for a law that knows of it
    """
    asked: list[tuple[Callable[[Floats], Floats], float]] = [(law.speed, float(law.ratio) or 1.0)]
    if rubs:
        for contact in range(len(law.rubbing(np.zeros(1)).into)):
            asked += [(_part(law, 1, contact), 1.0), (_part(law, 2, contact), 1.0)]
    cuts = folded_corners(law)
    fitted = [fit(function, law.period, cuts, _WANTED * scale, DEGREE) for function, scale in asked]
    cells = max(table.cells for table in fitted)
    tables = tuple(
        table if table.cells == cells else CellTable(function, law.period, cuts, cells, DEGREE)
        for table, (function, _) in zip(fitted, asked, strict=True)
    )
    S = (np.arange(_CHECKED) + 0.5) / _CHECKED * law.period
    for table, (function, scale) in zip(tables, asked, strict=True):
        if not table.uncertainty <= _GOOD * scale or (np.isnan(table(S)) != np.isnan(function(S))).any():
            return None
    return ContactTable(tables)


def _part(law: TransmissionFunction, part: int, contact: int) -> Callable[[Floats], Floats]:
    def found(S: Floats) -> Floats:
        values: Floats = law.rubbing(S)[part][contact]
        return values

    return found


def join_contact_tables(flanks: Sequence[ContactTable]) -> ContactTables:
    """Tables of flanks by their numbers."""
    leads = [each.functions[0] for each in flanks]
    period = np.array([table.period for table in leads], dtype=float)
    coarse = period.astype(np.float32).astype(float)
    cells = np.array([len(table.middles) for table in leads], dtype=np.int64)
    functions = np.array([len(each.functions) for each in flanks], dtype=np.int64)
    first = np.concatenate(([0], np.cumsum(cells * functions)))[: len(flanks)].astype(np.int64)
    rows = [table.coefficients[::-1].T for each in flanks for table in each.functions]
    middles = [np.tile(table.middles, count) for table, count in zip(leads, functions, strict=True)]
    return ContactTables(
        period,
        1 / period,
        coarse,
        period - coarse,
        np.array([table.cells / table.period for table in leads]),
        cells,
        first,
        np.concatenate(([0], np.cumsum([len(table.corners) for table in leads]))).astype(np.int64),
        np.concatenate([np.zeros(0), *(table.corners for table in leads)]),
        (functions - 1) // 2,
        np.concatenate([np.zeros(0), *middles]),
        np.ascontiguousarray(np.concatenate([np.zeros((0, DEGREE + 1)), *rows])),
    )


@kernel
def contact_along(tables: ContactTables, flank: int, S: Floats, found: Floats, u: Floats, row: Ints) -> None:
    """All functions of a flank at its driver's angles S (rad), (functions, n); `u` and `row` are scratch."""
    inverse, coarse, rest, density = (
        tables.inverse[flank],
        tables.coarse[flank],
        tables.rest[flank],
        tables.density[flank],
    )
    first, cells = tables.first[flank], tables.cells[flank]
    for at in range(len(S)):
        periods = np.floor(S[at] * inverse)
        u[at] = (S[at] - periods * coarse) - periods * rest
        row[at] = int(u[at] * density)
    for corner in tables.corners[tables.cuts[flank] : tables.cuts[flank + 1]]:
        for at in range(len(S)):
            row[at] += int(u[at] >= corner)
    for at in range(len(S)):
        # clipped: rounding may lead past either end
        row[at] = first + min(max(row[at], 0), cells - 1)
        u[at] -= tables.middles[row[at]]
    for part in range(1 + 2 * tables.contacts[flank]):
        for at in range(len(S)):
            own, x = row[at] + part * cells, u[at]
            value = tables.coefficients[own, 0]
            for power in range(1, DEGREE + 1):
                value = value * x + tables.coefficients[own, power]
            found[part, at] = value
