"""Integer rows of a Willis system as arrays: sparse matrix, and residuals in twice the working precision."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.kinematics.circuits.fundamental import WillisEquation
from geartrain.numerics.rounding_bounds import two_product, two_sum

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_ABREAST = 64  # right-hand sides solved together, which bounds memory


class PaddedRows:
    """Integer rows of a linear system as arrays, padded to a common number of terms."""

    def __init__(self, links: Sequence[str], rows: Sequence[WillisEquation]) -> None:
        self.at = {link: column for column, link in enumerate(links)}
        width = max((len(row.terms) for row in rows), default=0)
        # rows are padded with coefficient 0 in column 0
        self.columns = np.zeros((len(rows), width), dtype=np.intc)
        self.coefficients = np.zeros((len(rows), width))
        for at, row in enumerate(rows):
            for position, (link, coefficient) in enumerate(term for term in row.terms if term[0] in self.at):
                self.columns[at, position] = self.at[link]
                self.coefficients[at, position] = coefficient

    def matrix(self) -> Any:
        """Return the rows as a sparse matrix in compressed column format."""
        from scipy.sparse import csc_array

        size, width = self.columns.shape
        lines = np.repeat(np.arange(size, dtype=np.intc), width)
        used = self.coefficients.ravel() != 0
        entries = (self.coefficients.ravel()[used], (lines[used], self.columns.ravel()[used]))
        return csc_array(entries, shape=(size, len(self.at)))

    def factorise(self) -> Any:
        """Return the sparse LU factors of the matrix, computed by SuperLU; only the ordering COLAMD never takes
        quadratic time.
        """
        from scipy.sparse import linalg

        solver: Any = linalg
        return solver.splu(self.matrix(), permc_spec="COLAMD")

    def residual(self, x: Floats, right: Floats, remainder: Floats) -> Floats:
        """Return right + remainder - A x in twice the working precision, by compensated dot products (Dot2; Ogita, Rump
        and Oishi 2005).
        """
        total, low = right.copy(), remainder.copy()
        for position in range(self.columns.shape[1]):
            product, error = two_product(-self.coefficients[:, position, None], x[self.columns[:, position]])
            total, carry = two_sum(total, product)
            low = low + carry + error
        return total + low

    def prescribe(self, x: Floats, right: Floats) -> None:
        """Set prescribed speeds, which have rows with a single coefficient 1, to their exact values in `x`, in
        place.
        """
        single = np.flatnonzero((self.coefficients != 0).sum(axis=1) == 1)
        own = self.coefficients[single, 0] == 1
        x[self.columns[single[own], 0]] = right[single[own]]

    def size(self, x: Floats) -> Floats:
        """Return |A| |x|, one value for each row and case."""
        total: Floats = np.einsum("rt,rtc->rc", np.abs(self.coefficients), np.abs(x[self.columns]))
        return total

    @np.errstate(over="ignore", invalid="ignore", divide="ignore")  # a condition number beyond float64 is infinite
    def condition(self, lu: Any, links: Sequence[str], x: Floats) -> dict[str, float]:
        """Return the condition numbers cond(A, x) of some links, (25) of docs/theory.md: (|y|, |A||x|) / |x_link|.

        Each y is the solution of one transposed system. The number is infinite for a link at rest, whose relative error
        is not defined.
        """
        size = self.size(x[:, None])[:, 0]
        found = dict.fromkeys(links, float("inf"))
        turning = [link for link in links if link in self.at and x[self.at[link]]]  # the frame has no column
        for start in range(0, len(turning), _ABREAST):
            some = turning[start : start + _ABREAST]
            columns = [self.at[link] for link in some]
            units = np.zeros((len(x), len(some)))
            units[columns, np.arange(len(some))] = 1.0
            totals = size @ np.abs(lu.solve(units, trans="T")) / np.abs(x[columns])
            found |= dict(zip(some, totals.tolist(), strict=True))
        return found
