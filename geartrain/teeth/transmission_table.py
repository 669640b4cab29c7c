"""Tables of periodic transmission functions: piecewise polynomials of low degree on uniform cells, divided at the
kinks.

A table is evaluated several times faster than the formula from which it was made. It interpolates the function at
Chebyshev nodes strictly inside each cell, so that on either side of a kink it follows that side only. Tables do not
depend on teeth or pins.

`join_transmission_tables` packs the tables of error and speed of many functions into one set of arrays. The compiled
kernel `transmission_along` evaluates them at many angles. A table either agrees with its function to rounding error, or
is the table from which the function is evaluated anyway.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission import DerivedTransmission, TransmissionFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats, Ints


# each degree costs 10 % more time per angle; below 4, tables of wheels with few teeth do not fit into the caches
DEGREE = 4
_FEWEST, _MOST = 32, 1 << 16  # minimum and maximum number of cells
_PATIENCE = 8  # an error not halved by this factor of cells is rounding error
_MANY = 16  # kinks: a search takes less time than that many comparisons
_MOST_KINKS = 512  # of a table of the kernel, which compares an angle with each of them
_THIN = 1e-12  # periods: in narrower cells the table is constant
_SAFETY = 2.0  # stated uncertainty divided by the maximum error found
# degree 6 follows a function to rounding error in 32 to 512 cells: with a higher degree the fit itself has larger
# rounding errors, with a lower degree the tables do not fit into the cache
KERNEL_DEGREE = 6
# numbers of a cell are adjacent and fill two cache lines; in columns each number would load a cache line
CELL = 2 * (KERNEL_DEGREE + 2)
_WANTED = 1e-15  # driven pitches, or of the mean speed: rounding error of the function itself
_GOOD = 1e-12  # in the same units: if no table is as accurate, the function itself is evaluated


class PeriodicTransmission(Protocol):
    """Periodic function with known kinks, such as a transmission function."""

    @property
    def period(self) -> float:
        """Period [rad of the driver]."""

    @property
    def ratio(self) -> Fraction:
        """Mean speed ratio."""

    def kinks(self) -> list[float]:
        """Return the driver angles at which the function or a derivative is discontinuous [rad]."""

    def error(self, S: Floats) -> Floats:
        """Return the transmission error [rad] at driver angles S [rad]."""

    def speed(self, S: Floats) -> Floats:
        """Return the speed ratio at driver angles S [rad]."""


class CellTable:
    """Table of a periodic function of the driver angle, on `cells` uniform cells that are divided at the kinks.

    `uncertainty` is the estimated maximum difference from the function, in its unit: twice the maximum difference found
    at points between the nodes and near the ends of the cells.
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
        """Boundaries of the cells in ascending order [rad]: multiples of the uniform cell width, and the kinks of the
        function.
        """
        uniform = np.arange(self.cells + 1) * (self.period / self.cells)
        return np.sort(np.concatenate((uniform, self.kinks)))

    def derivative(self) -> CellTable:
        """Return the table of the derivative of the function with respect to the driver angle on the same cells.

        Its `uncertainty` is not updated and remains the uncertainty of the function.
        """
        found = copy(self)
        found.degree = self.degree - 1
        found.coefficients = np.ascontiguousarray(self.coefficients[1:] * np.arange(1, self.degree + 1)[:, None])
        return found

    @property
    def nbytes(self) -> int:
        """Memory of the table [byte]."""
        return int(self.coefficients.nbytes + self.middles.nbytes)

    def __call__(self, S: ArrayLike) -> Floats:
        """Return the interpolated function at driver angles S [rad] of any shape."""
        S = np.asarray(S, dtype=float)
        with np.errstate(invalid="ignore"):
            u = np.mod(S, self.period)
            # every kink below the angle adds a cell to the count of uniform cells
            cell = np.asarray(u * (self.cells / self.period)).astype(np.intp)
            if len(self.kinks) > _MANY:
                cell = cell + np.searchsorted(self.kinks, u, side="right")
            else:
                for kink in self.kinks:
                    cell = cell + (u >= kink)
            # clipped, since rounding may lead past the last cell and NaN anywhere
            u = u - self.middles.take(cell, mode="clip")
            found = self.coefficients[-1].take(cell, mode="clip")
            # Horner's method
            for coefficients in self.coefficients[-2::-1]:
                found = found * u + coefficients.take(cell, mode="clip")
        return np.asarray(found)


def folded_kinks(transmission: PeriodicTransmission) -> Floats:
    """Return the distinct kinks of a function modulo its period in ascending order [rad]."""
    return np.unique(np.mod(np.asarray(transmission.kinks(), dtype=float), transmission.period))


def fit(
    function: Callable[[Floats], Floats], period: float, kinks: Floats, tolerance: float, degree: int = DEGREE
) -> CellTable:
    """Return the table with the fewest cells, doubled from 32, whose uncertainty is at most `tolerance`.

    If rounding error or the maximum number of cells prevents that, return the last table that halved the uncertainty.
    """
    best = table = CellTable(function, period, kinks, _FEWEST, degree)
    while best.uncertainty > tolerance and table.cells < min(_MOST, _PATIENCE * best.cells):
        table = CellTable(function, period, kinks, 2 * table.cells, degree)
        if table.uncertainty < best.uncertainty / 2:
            best = table
    return best


class TabulatedTransmission(DerivedTransmission):
    """Transmission function evaluated from tables, each made on first use.

    Results over a whole period, such as the mean efficiency, are those of the underlying function. `tolerance` is the
    maximum error of the transmission error in driven pitches (or periods of a coupling), of the speed ratio relative to
    its mean, and of the efficiency; `degree` is the degree of the polynomials.
    """

    def __init__(self, transmission: TransmissionFunction, tolerance: float = 1e-12, degree: int = DEGREE) -> None:
        super().__init__(transmission)
        self.friction, self.tolerance, self.degree = transmission.friction, tolerance, degree
        self.cuts = folded_kinks(transmission)

    def _fit(self, function: Callable[[Floats], Floats], scale: float) -> CellTable:
        return fit(function, self.period, self.cuts, self.tolerance * scale, self.degree)

    @cached_property
    def error_table(self) -> CellTable:
        """Table of the transmission error [rad of the driven side]."""
        return self._fit(self.transmission.error, (float(self.ratio) or 1.0) * self.pitch)

    @cached_property
    def speed_table(self) -> CellTable:
        """Table of the speed ratio."""
        return self._fit(self.transmission.speed, float(self.ratio) or 1.0)

    @cached_property
    def efficiency_table(self) -> CellTable:
        """Table of the efficiency."""
        return self._fit(self.transmission.efficiency, 1.0)

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven side] at driver angles S [rad]."""
        return self.error_table(S)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad]."""
        return self.speed_table(S)

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad]; NaN where the underlying function is NaN."""
        return self.efficiency_table(S)

    def efficiency_mean(self) -> float:
        """Return the mean efficiency of the underlying function at constant driver torque."""
        return self.transmission.efficiency_mean()

    def efficiency_at_constant_load(self) -> float:
        """Return the efficiency of the underlying function at constant load torque."""
        return self.transmission.efficiency_at_constant_load()

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency of the underlying function."""
        return self.transmission.efficiency_minimum()

    def reversed_motion(self) -> TabulatedTransmission:
        """Return the tabulated transmission function for a driver that turns backwards."""
        back = self.transmission.reversed_motion()
        return self if back is self.transmission else TabulatedTransmission(back, self.tolerance, self.degree)


# --------------------------------------------------------------------- many transmission functions in one set of arrays


class TransmissionTables(NamedTuple):
    """Tables of many transmission functions, packed into arrays indexed by the number of the function."""

    period: Floats
    """Period of each function [rad of the driver]."""
    inverse: Floats
    """Reciprocal of the period of each function [1/rad]."""
    coarse: Floats
    """Period rounded to 24 bits [rad]; the exact period is `coarse` + `rest`."""
    rest: Floats
    """Period minus `coarse` [rad]."""
    density: Floats
    """Number of uniform cells divided by the period, for each function [1/rad]."""
    first: Ints
    """Index of the first cell of each function in `cells`."""
    last: Ints
    """Index of the last cell of each function in `cells`."""
    cuts: Ints
    """Indices into `kinks`: function k has the kinks `kinks[cuts[k]:cuts[k + 1]]`."""
    kinks: Floats
    """Kinks of all functions, one function after another [rad]."""
    cells: Floats
    """Cells of all functions, `CELL` numbers each: midpoint [rad], and polynomial coefficients from the highest
    power.

    The numbers of the transmission error and of the speed ratio alternate.
    """


class TransmissionTable(NamedTuple):
    """Tables of the transmission error and the speed ratio of one transmission function over its period [rad]."""

    period: float
    error: CellTable
    speed: CellTable


def make_transmission_table(transmission: PeriodicTransmission) -> TransmissionTable | None:
    """Return tables of the transmission error and the speed ratio of a transmission function that agree with it
    to rounding error.

    The tables of a `TabulatedTransmission` are used as they are. Return None if no table follows the function: if it
    has gaps or too many kinks, or if each column of angles has a transmission function of its own.
    """
    if isinstance(transmission, TransmissionFunction) and type(transmission).picked is not TransmissionFunction.picked:
        return None
    if len(folded_kinks(transmission)) > _MOST_KINKS:
        return None
    if isinstance(transmission, TabulatedTransmission):
        found = TransmissionTable(transmission.period, transmission.error_table, transmission.speed_table)
        good = transmission.degree <= KERNEL_DEGREE
    else:
        ratio = float(transmission.ratio) or 1.0
        cuts = folded_kinks(transmission)
        error = fit(transmission.error, transmission.period, cuts, _WANTED * ratio * transmission.period, KERNEL_DEGREE)
        speed = fit(transmission.speed, transmission.period, cuts, _WANTED * ratio, KERNEL_DEGREE)
        # with both tables on the same cells, the kernel looks up an angle once
        cells = max(error.cells, speed.cells)
        error, speed = (
            table if table.cells == cells else CellTable(function, transmission.period, cuts, cells, KERNEL_DEGREE)
            for table, function in ((error, transmission.error), (speed, transmission.speed))
        )
        found = TransmissionTable(transmission.period, error, speed)
        good = (
            found.error.uncertainty <= _GOOD * ratio * transmission.period and found.speed.uncertainty <= _GOOD * ratio
        )
    # the boundary of a gap depends on rounding, so that functions with gaps are not tabulated
    whole = all(np.isfinite(table.coefficients).all() for table in (found.error, found.speed))
    return found if good and whole else None


def join_transmission_tables(transmissions: Sequence[TransmissionTable]) -> TransmissionTables:
    """Return the tables of several transmission functions packed into one set of arrays."""
    period = np.array([transmission.period for transmission in transmissions])
    # the period is the sum of two parts, so that products of the coarse part with counts up to 2^29 are exact
    coarse = period.astype(np.float32).astype(float)
    kinks = [transmission.error.kinks for transmission in transmissions]
    cells = [_cells(transmission) for transmission in transmissions]
    ends = np.cumsum([0, *(len(each) for each in cells)], dtype=np.int64)
    return TransmissionTables(
        period,
        1 / period,
        coarse,
        period - coarse,
        np.array([max(each.error.cells, each.speed.cells) / each.period for each in transmissions]),
        ends[:-1],
        ends[1:] - 1,
        np.concatenate(([0], np.cumsum([len(each) for each in kinks]))).astype(np.int64),
        np.concatenate([np.zeros(0), *kinks]),
        np.concatenate([np.zeros(0), *(each.ravel() for each in cells)]),
    )


def _cells(transmission: TransmissionTable) -> Floats:
    """Return the cells of a function, shape (n, `CELL`).

    Each cell of the finer of the two tables is combined with the cell of the other table that contains it.
    """
    finer = max(transmission.error, transmission.speed, key=lambda table: table.cells)
    found = np.zeros((len(finer.middles), CELL))
    for part, table in enumerate((transmission.error, transmission.speed)):
        at = np.arange(len(finer.middles))
        if table.cells < finer.cells:
            at = np.clip(np.searchsorted(table.breaks, finer.middles, side="right") - 1, 0, len(table.middles) - 1)
        found[:, part] = table.middles[at]
        # leading zero coefficients of a lower degree do not change a bit of the result
        found[:, part + 2 * (KERNEL_DEGREE + 1 - table.degree) :: 2] = table.coefficients[::-1, at].T
    return found


@kernel
def transmission_along(
    tables: TransmissionTables,
    transmission: int,
    angle: Floats,
    error: Floats,
    speed: Floats,
    u: Floats,
    cell: NDArray[np.int32],
) -> None:
    """Compute transmission error [rad] and speed ratio of one function at driver angles [rad].

    The results are written into `error` and `speed`; `u` and `cell` are scratch. The operations are the
    same as in `CellTable`, in loops most of which the compiler vectorizes.
    """
    inverse, coarse, rest = tables.inverse[transmission], tables.coarse[transmission], tables.rest[transmission]
    density, first, last = tables.density[transmission], tables.first[transmission], tables.last[transmission]
    for at in range(len(angle)):
        S = angle[at]
        periods = np.floor(S * inverse)
        # in this order, as in `behind`: S minus the product with the coarse part is exact
        u[at] = (S - periods * coarse) - periods * rest
    for at in range(len(angle)):
        cell[at] = np.int32(u[at] * density)
    for kink in tables.kinks[tables.cuts[transmission] : tables.cuts[transmission + 1]]:
        for at in range(len(angle)):
            cell[at] += np.int32(u[at] >= kink)
    for at in range(len(angle)):
        # clipped, since rounding may lead past either end
        cell[at] = min(max(cell[at], 0), last - first)
    for at in range(len(angle)):
        error[at], speed[at] = _polynomials(tables.cells, np.uint64(CELL) * np.uint64(first + cell[at]), u[at])


@kernel
def _polynomials(cells: Floats, begin: np.uint64, u: float) -> tuple[float, float]:
    """Return transmission error and speed ratio from the coefficients of one cell, by Horner's method."""
    x, y = u - cells[begin], u - cells[begin + np.uint64(1)]
    at, one, two = begin + np.uint64(2), np.uint64(1), np.uint64(2)
    error, speed = cells[at], cells[at + one]
    for _ in range(KERNEL_DEGREE):
        at += two
        error, speed = error * x + cells[at], speed * y + cells[at + one]
    return error, speed
