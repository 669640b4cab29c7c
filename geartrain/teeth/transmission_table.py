"""Tables of periodic transmission functions: piecewise polynomials of low degree on uniform cells, divided at the
kinks.

A table is evaluated several times faster than the formula from which it was made. A table interpolates the function at
Chebyshev nodes strictly inside each cell. The polynomial on each side of a kink is therefore fitted to that side only.
Tables do not depend on teeth or pins.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.arrays import blocks, remainder

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction


# each degree costs 10 % more time per angle; below 4, tables of wheels with few teeth do not fit into the caches
DEGREE = 4
_FEWEST, _MOST = 32, 1 << 16  # minimum and maximum number of cells
_PATIENCE = 8  # an error not halved by this factor of cells is rounding error
_THIN = 1e-12  # periods: in narrower cells the table is constant
_SAFETY = 2.0  # stated uncertainty divided by the maximum error found
_FEW_KINKS = 32  # up to this number, comparing with every kink takes a quarter to a half of the time of a search


class CellTable:
    """Table of a periodic function of the driver angle. The period is divided into `cells` uniform cells, which are
    subdivided at the kinks of the function.

    `uncertainty` is the estimated maximum difference between table and function, in the unit of the function: twice the
    maximum difference found at points between the nodes and near the ends of the cells.
    """

    def __init__(
        self, function: Callable[[Floats], Floats], period: float, kinks: Floats, cells: int, degree: int = DEGREE
    ) -> None:
        self.period, self.kinks, self.cells, self.degree = period, kinks, cells, degree
        breaks = self.breaks
        self.middles, halves = (breaks[1:] + breaks[:-1]) / 2, (breaks[1:] - breaks[:-1]) / 2
        # Chebyshev nodes of the first kind lie strictly inside the cell, on one side of every kink
        nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
        values = function(self.middles[:, None] + halves[:, None] * nodes)
        wide = halves > _THIN * period
        # an infinite half width leaves the constant term only, which avoids overflow in thin cells
        powers = np.where(wide, halves, np.inf)[:, None] ** np.arange(degree + 1)
        # powers are evaluated fastest, by Horner's method; at this low degree the conversion loses few digits
        monomials = np.linalg.inv(np.vander(nodes, increasing=True))
        self.coefficients = np.ascontiguousarray((values @ monomials.T / powers).T)
        # the maximum error is between the nodes or at the ends of a cell; an end itself may be beyond a kink
        checks = np.cos(np.pi * np.arange(degree + 2) / (degree + 1)) * (1 - 1e-9)
        S = self.middles[wide, None] + halves[wide, None] * checks
        off = np.abs(self(S) - function(S))
        self.uncertainty = _SAFETY * float(np.max(off[~np.isnan(off)], initial=0.0))

    @property
    def breaks(self) -> Floats:
        """Boundaries of the cells [rad] in ascending order: multiples of the cell width, and the kinks."""
        uniform = np.arange(self.cells + 1) * (self.period / self.cells)
        return np.sort(np.concatenate((uniform, self.kinks)))

    def derivative(self) -> CellTable:
        """Return the table of the derivative of the function with respect to the driver angle on the same cells.

        The `uncertainty` of the returned table is not updated: it is the uncertainty of this table.
        """
        found = copy(self)
        found.degree = self.degree - 1
        found.coefficients = np.ascontiguousarray(self.coefficients[1:] * np.arange(1, self.degree + 1)[:, None])
        return found

    def __call__(self, S: ArrayLike) -> Floats:
        """Return the interpolated values of the function at driver angles S [rad] of any shape."""
        S = np.asarray(S, dtype=float)
        flat, found = S.ravel(), np.empty(S.size)
        with np.errstate(invalid="ignore"):
            for block in blocks(len(flat)):
                found[block] = self._block(flat[block])
        return found.reshape(S.shape)

    def _block(self, S: Floats) -> Floats:
        u = remainder(S, self.period)
        # every kink below the angle adds a cell to the count of uniform cells
        cell = (u * (self.cells / self.period)).astype(np.intp)
        if len(self.kinks) > _FEW_KINKS:
            cell += np.searchsorted(self.kinks, u, side="right")
        else:
            for kink in self.kinks:
                cell += u >= kink
        # clipped, since rounding may lead past the last cell and NaN anywhere
        u -= self.middles.take(cell, mode="clip")
        found: Floats = self.coefficients[-1].take(cell, mode="clip")
        # Horner's method
        for coefficients in self.coefficients[-2::-1]:
            found *= u
            found += coefficients.take(cell, mode="clip")
        return found


def folded_kinks(transmission: TransmissionFunction) -> Floats:
    """Return the different kinks of a transmission function, reduced to one period and sorted [rad]."""
    return np.unique(np.mod(np.asarray(transmission.kinks(), dtype=float), transmission.period))


def fit(
    function: Callable[[Floats], Floats], period: float, kinks: Floats, tolerance: float, degree: int = DEGREE
) -> CellTable:
    """Return a table of a periodic function with an uncertainty of at most `tolerance`. The number of cells is doubled,
    starting from 32, until this accuracy is reached. Cells are divided at `kinks`, and have polynomials of degree
    `degree`.

    If it cannot be reached because of rounding errors or the maximum number of cells, return the table after which
    doubling no longer halved the uncertainty.
    """
    best = table = CellTable(function, period, kinks, _FEWEST, degree)
    while best.uncertainty > tolerance and table.cells < min(_MOST, _PATIENCE * best.cells):
        table = CellTable(function, period, kinks, 2 * table.cells, degree)
        if table.uncertainty < best.uncertainty / 2:
            best = table
    return best
