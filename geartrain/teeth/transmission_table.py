"""A periodic transmission law as a table: polynomials of low degree on uniform cells, cut where the law has corners.

A table answers several times faster than the formula it was made from. It is made from the law's own answers at
Chebyshev nodes strictly inside each cell, so that on either side of a corner it follows that side alone; it knows
nothing of teeth or pins.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

from geartrain.teeth.derived_transmission import DerivedTransmission
from geartrain.teeth.transmission import TransmissionFunction, behind

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats, Indices

    Flags = NDArray[np.bool_]

DEGREE = 4  # each degree costs a tenth more time an angle; below 4 tables of few teeth outgrow the caches
_BLOCK = 8192  # angles worked on at once: their arrays and the table stay in a cache
_FEWEST, _MOST = 32, 1 << 16  # cells
_PATIENCE = 8  # times as many cells without half the error: it is rounding
_THIN = 1e-12  # of a period: a narrower cell is a constant
_SAFETY = 2.0  # stated error over the greatest found


class HasCorners(Protocol):
    """A law of some period (rad)."""

    @property
    def period(self) -> float:
        """Driver's angle (rad)."""

    def corners(self) -> list[float]:
        """Driver's angles (rad) where the law or a slope of it is not smooth."""


class CellTable:
    """A function of the driver's angle with period `period` (rad), on `cells` cells cut at `corners` (rad).

    uncertainty   bound on the difference from the function, in its own unit: twice the greatest found between nodes
    """

    def __init__(
        self, function: Callable[[Floats], Floats], period: float, corners: Floats, cells: int, degree: int = DEGREE
    ) -> None:
        self.period, self.corners, self.cells, self.degree = period, corners, cells, degree
        breaks = self.breaks
        self.middles, halves = (breaks[1:] + breaks[:-1]) / 2, (breaks[1:] - breaks[:-1]) / 2
        nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
        values = function(self.middles[:, None] + halves[:, None] * nodes)
        wide = halves > _THIN * period
        # over an infinite half width only the constant term is left: thin cells are constants
        powers = np.where(wide, halves, np.inf)[:, None] ** np.arange(degree + 1)
        monomials = np.linalg.inv(np.vander(nodes, increasing=True))
        self.coefficients = np.ascontiguousarray((values @ monomials.T / powers).T)
        # the error is greatest between the nodes and at the ends of a cell; an end itself may be beyond a corner
        checks = np.cos(np.pi * np.arange(degree + 2) / (degree + 1)) * (1 - 1e-9)
        S = self.middles[wide, None] + halves[wide, None] * checks
        off = np.abs(self(S) - function(S))
        self.uncertainty = _SAFETY * float(np.max(off[~np.isnan(off)], initial=0.0))

    @property
    def breaks(self) -> Floats:
        """Where cells begin and end (rad): at uniform steps, and at corners."""
        uniform = np.arange(self.cells + 1) * (self.period / self.cells)
        return np.sort(np.concatenate((uniform, self.corners)))

    def derivative(self) -> CellTable:
        """Its derivative by the driver's angle, on the same cells; `uncertainty` stays that of the function."""
        found = copy(self)
        found.degree = self.degree - 1
        found.coefficients = np.ascontiguousarray(self.coefficients[1:] * np.arange(1, self.degree + 1)[:, None])
        return found

    @property
    def nbytes(self) -> int:
        """Memory of the table (bytes)."""
        return int(self.coefficients.nbytes + self.middles.nbytes)

    def __call__(self, S: ArrayLike) -> Floats:
        """The function at driver angles S (rad), any shape."""
        S = np.asarray(S, dtype=float)
        flat = S.ravel()
        found = np.empty_like(flat)
        size = min(_BLOCK, len(flat))
        scratch = np.empty(size), np.empty(size), np.empty(size, np.intp), np.empty(size, bool)
        with np.errstate(invalid="ignore"):
            for start in range(0, len(flat), _BLOCK):
                self._block(flat[start : start + _BLOCK], found[start : start + _BLOCK], *scratch)
        return found.reshape(S.shape)

    def _block(self, S: Floats, found: Floats, u: Floats, other: Floats, cell: Indices, passed: Flags) -> None:
        """`found` at S; the other arrays are scratch."""
        u, other, cell, passed = u[: len(S)], other[: len(S)], cell[: len(S)], passed[: len(S)]
        behind(S, self.period, u, other)
        np.multiply(u, self.cells / self.period, out=other)
        np.copyto(cell, other, casting="unsafe")
        for corner in self.corners:
            np.greater_equal(u, corner, out=passed)
            np.add(cell, passed, out=cell)
        # clipped: rounding may lead past the last cell, NaN anywhere; in mode `raise` numpy fills `out` through a copy
        np.take(self.middles, cell, out=other, mode="clip")
        np.subtract(u, other, out=u)
        np.take(self.coefficients[-1], cell, out=found, mode="clip")
        for coefficients in self.coefficients[-2::-1]:
            np.multiply(found, u, out=found)
            np.take(coefficients, cell, out=other, mode="clip")
            np.add(found, other, out=found)


def folded_corners(law: HasCorners) -> Floats:
    """The corners of a law (rad) within its first period, each once, in order."""
    return np.unique(np.mod(np.asarray(law.corners(), dtype=float), law.period))


def fit(
    function: Callable[[Floats], Floats], period: float, corners: Floats, tolerance: float, degree: int = DEGREE
) -> CellTable:
    """The coarsest table within `tolerance`, or the last to gain where rounding keeps it from that."""
    best = table = CellTable(function, period, corners, _FEWEST, degree)
    while best.uncertainty > tolerance and table.cells < min(_MOST, _PATIENCE * best.cells):
        table = CellTable(function, period, corners, 2 * table.cells, degree)
        if table.uncertainty < best.uncertainty / 2:
            best = table
    return best


class TabulatedTransmission(DerivedTransmission):
    """A law read from tables, each made when first asked for.

    law         the law itself, which still answers what is asked of a whole period
    tolerance   of the error in driven pitches (or periods), of the speed over its mean, of the efficiency
    """

    def __init__(self, law: TransmissionFunction, tolerance: float = 1e-12, degree: int = DEGREE) -> None:
        super().__init__(law)
        self.friction, self.tolerance, self.degree = law.friction, tolerance, degree
        self.cuts = folded_corners(law)

    def _fit(self, function: Callable[[Floats], Floats], scale: float) -> CellTable:
        return fit(function, self.period, self.cuts, self.tolerance * scale, self.degree)

    @cached_property
    def error_table(self) -> CellTable:
        """Table of the transmission error, whose `uncertainty` is in rad of the driven side."""
        return self._fit(self.law.error, (float(self.ratio) or 1.0) * self.period)

    @cached_property
    def speed_table(self) -> CellTable:
        """Table of the speed ratio."""
        return self._fit(self.law.speed, float(self.ratio) or 1.0)

    @cached_property
    def efficiency_table(self) -> CellTable:
        """Table of the efficiency."""
        return self._fit(self.law.efficiency, 1.0)

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error (rad of the driven side) at driver angles S (rad)."""
        return self.error_table(S)

    def speed(self, S: ArrayLike) -> Floats:
        """Speed ratio at driver angles S (rad)."""
        return self.speed_table(S)

    def efficiency(self, S: ArrayLike) -> Floats:
        """Efficiency at driver angles S (rad); NaN where the law has none."""
        return self.efficiency_table(S)

    def efficiency_mean(self) -> float:
        """The law's own."""
        return self.law.efficiency_mean()

    def efficiency_at_constant_load(self) -> float:
        """The law's own."""
        return self.law.efficiency_at_constant_load()

    def efficiency_least(self) -> float:
        """The law's own."""
        return self.law.efficiency_least()

    def turned_back(self) -> TabulatedTransmission:
        """Tables of the law turned back."""
        back = self.law.turned_back()
        return self if back is self.law else TabulatedTransmission(back, self.tolerance, self.degree)
