"""Willis system as a sparse matrix, for the float solver of this package and for other solvers, and residuals in twice
the working precision.

The entries are tooth counts and their sums, which are integers far below 2**53. A float64 matrix represents them
exactly, so the error of a float solution is due only to the solver.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csc_array

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.circuits.fundamental import WillisEquation
from geartrain.numerics.elimination import PRIME, eliminate, residues
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Shown
from geartrain.numerics.rounding_bounds import two_product, two_sum

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_GIVEN = -1  # column of prescribed speeds


class PaddedRows:
    """Integer rows of a linear system as arrays. The rows are padded to a common number of terms."""

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
        size, width = self.columns.shape
        lines = np.repeat(np.arange(size, dtype=np.intc), width)
        used = self.coefficients.ravel() != 0
        entries = (self.coefficients.ravel()[used], (lines[used], self.columns.ravel()[used]))
        return csc_array(entries, shape=(size, len(self.at)))

    def factorise(self) -> Any:
        """Return the sparse LU factors of the matrix, computed by SuperLU with the column ordering COLAMD, the only
        ordering that never takes quadratic time.
        """
        from scipy.sparse import linalg

        solver: Any = linalg
        return solver.splu(self.matrix(), permc_spec="COLAMD")

    def residual(self, x: Floats, right: Floats, remainder: Floats) -> Floats:
        """Return right + remainder - A x in twice the working precision, by compensated dot products (Dot2; Ogita, Rump
        and Oishi 2005). `remainder` contains the digits of the right-hand side that float64 cannot represent in
        `right`.
        """
        total, low = right.copy(), remainder.copy()
        for position in range(self.columns.shape[1]):
            product, error = two_product(-self.coefficients[:, position, None], x[self.columns[:, position]])
            total, carry = two_sum(total, product)
            low = low + carry + error
        return total + low

    def prescribe(self, x: Floats, right: Floats) -> None:
        """Set prescribed speeds in `x` to their exact values, in place. The row of a prescribed speed has a single
        coefficient, which is 1.
        """
        single = np.flatnonzero((self.coefficients != 0).sum(axis=1) == 1)
        own = self.coefficients[single, 0] == 1
        x[self.columns[single[own], 0]] = right[single[own]]

    def size(self, x: Floats) -> Floats:
        """Return |A| |x|, shape (rows, cases), which is the sum of the magnitudes of the terms of each row."""
        total: Floats = np.einsum("rt,rtc->rc", np.abs(self.coefficients), np.abs(x[self.columns]))
        return total


@dataclass(frozen=True, eq=False, slots=True)
class WillisMatrix(Shown):
    """Willis system A w = b as arrays: `matrix @ speeds == right` for speeds in the order of `links`.

    The same matrix determines speeds (A w = b), the effect of small tooth errors (A dw = e), and, transposed, torques
    without losses. `GearTrain.solve(method="sparse")` factorises this matrix.

    See Also
    --------
    WillisSystem.matrix : method that returns it

    Examples
    --------
    >>> import geartrain
    >>> found = geartrain.load("planetary-24-18-60").equations().matrix()
    >>> found.labels, found.links
    (('s~p', 'p~ring', 'input sun'), ('sun', 'planet', 'carrier'))
    >>> found.matrix.toarray().tolist(), found.right.tolist()
    ([[24.0, 18.0, -42.0], [0.0, 18.0, 42.0], [1.0, 0.0, 0.0]], [0.0, 0.0, 1.0])
    >>> from scipy.sparse.linalg import spsolve
    >>> spsolve(found.matrix, found.right).round(12).tolist()
    [1.0, -0.666666666667, 0.285714285714]
    """

    matrix: csc_array
    """Matrix A, axes (row, link), in compressed sparse column format, with integers as float64 numbers."""
    right: Floats
    """Right-hand side b of each row [the train's unit of speed], rounded to float64."""
    rows: tuple[WillisEquation, ...]
    """Equations of the rows, each with its label, kind and exact right-hand side."""
    links: tuple[str, ...]
    """Links of the columns: all links except the frame, which is included if the whole system is requested."""
    omitted: tuple[str, ...]
    """Labels of omitted rows: the row of the frame, and rows that follow from other rows."""

    def _summary(self) -> str:
        rows, columns = self.matrix.shape
        return f"{rows} equations in the speeds of {columns} links, {self.matrix.nnz} entries"

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of the rows, which are the names of pairs and of prescribed speeds."""
        return tuple(row.label for row in self.rows)

    @property
    def exact_right(self) -> tuple[Fraction, ...]:
        """Right-hand side of each row before rounding to float64 [the train's unit of speed]."""
        return tuple(row.right for row in self.rows)


def build_matrix(
    links: Sequence[str], equations: Sequence[WillisEquation], redundant: Sequence[str], whole: bool = False
) -> WillisMatrix:
    """Build the arrays of a Willis system.

    redundant   labels of rows that are known to follow from other rows
    whole       True to include the frame, and rows that follow from other rows

    Raises `RangeError` if a prescribed speed is beyond the range of float64.
    """
    columns, rows = (links, equations) if whole else independent_rows(links, equations, redundant)
    kept = {row.label for row in rows}
    right = [as_float(row.right) for row in rows]
    if None in right:
        what = f"the right-hand side of '{rows[right.index(None)].label}' is beyond the range of float64"
        fix = "use `train.equations().equations`, whose numbers are fractions"
        raise RangeError(Problem(what, "float64 covers 1e-308 to 1e308", fix))
    return WillisMatrix(
        PaddedRows(columns, rows).matrix(),
        np.array(right),
        tuple(rows),
        tuple(columns),
        tuple(row.label for row in equations if row.label not in kept),
    )


def independent_rows(
    links: Sequence[str], equations: Sequence[WillisEquation], redundant: Sequence[str]
) -> tuple[list[str], list[WillisEquation]]:
    """Return the moving links, and all rows except the row of the frame and redundant rows.

    If the speeds are determined, there are as many rows as moving links. If rows contradict each other, there are more
    rows, because all contradictory rows are kept. Redundant rows are found by Gaussian elimination modulo a prime if
    there are too many rows.
    """
    frame = next(row.terms[0][0] for row in equations if row.kind == "frame")
    links, idle = [link for link in links if link != frame], set(redundant)
    rows = [
        row
        for row in equations
        if row.kind in ("input", "fixed", "lock") or (row.kind != "frame" and row.label not in idle)
    ]
    if len(rows) > len(links):
        at = {link: column for column, link in enumerate(links)}
        # the right-hand side is a column too, so that contradicting rows are not redundant
        forms = [
            residues({at[link]: Fraction(c) for link, c in row.terms if link in at} | {_GIVEN: -row.right})
            for row in rows
        ]
        follow = set(eliminate(forms, modulus=PRIME).redundant)
        rows = [row for position, row in enumerate(rows) if position not in follow]
    return links, rows
