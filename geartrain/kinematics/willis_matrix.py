"""The Willis system as a sparse matrix: what float solvers factorise, and what a solver of one's own may have.

The entries are tooth counts and their sums, whole numbers far below 2**53: a float64 matrix holds each of them exactly,
so that all error of a float solution is the solver's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.speeds.padded_rows import PaddedRows
from geartrain.kinematics.willis_equation import WillisEquation
from geartrain.numerics.elimination import PRIME, eliminate, residues
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_GIVEN = -1  # the column of what is prescribed


@dataclass(frozen=True, eq=False, slots=True)
class WillisMatrix(Shown):
    """A Willis system as arrays, A w = b: `matrix @ speeds == right` for speeds in the order of `links`.

    One matrix serves three right-hand sides: speeds (A w = b), small errors of teeth (A dw = e), and, transposed,
    torques without losses. `GearTrain.solve(method="sparse")` factorises this one.

    See Also
    --------
    WillisSystem.matrix : what gives it

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
    """A, (row, link), float64, column compressed; every entry is a whole number, held exactly."""
    right: Floats
    """B, (row,), float64: the floats nearest to what is prescribed [the train's unit]."""
    rows: tuple[WillisEquation, ...]
    """The equations of the rows, each with its label, kind and exact right-hand side."""
    links: tuple[str, ...]
    """The columns: all links that move, or with the frame where the whole system was asked for."""
    left_out: tuple[str, ...]
    """Labels of declared rows that are not in it: the frame's, and those that follow from others."""

    def _summary(self) -> str:
        rows, columns = self.matrix.shape
        return f"{rows} equations in the speeds of {columns} links, {self.matrix.nnz} entries"

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels of the rows: pairs, and what is prescribed."""
        return tuple(row.label for row in self.rows)

    @property
    def exact_right(self) -> tuple[Fraction, ...]:
        """The right-hand side as prescribed, before it was rounded to floats [the train's unit]."""
        return tuple(row.right for row in self.rows)


def build_matrix(
    links: Sequence[str], equations: Sequence[WillisEquation], redundant: Sequence[str], whole: bool = False
) -> WillisMatrix:
    """The arrays of a system.

    redundant   labels of rows known to follow from others
    whole       with the frame, and with rows that follow from others

    Raises `RangeError` where a prescribed speed is no float.
    """
    columns, rows = (links, equations) if whole else independent_rows(links, equations, redundant)
    kept = {row.label for row in rows}
    return WillisMatrix(
        PaddedRows(columns, rows).matrix(),
        np.array([_nearest(row) for row in rows]),
        tuple(rows),
        tuple(columns),
        tuple(row.label for row in equations if row.label not in kept),
    )


def independent_rows(
    links: Sequence[str], equations: Sequence[WillisEquation], redundant: Sequence[str]
) -> tuple[list[str], list[WillisEquation]]:
    """The moving links, and the rows without the frame's and without those that follow from others.

    As many as there are moving links if the speeds are determined; more if rows contradict each other, none of which is
    left out. Only where rows are too many it is looked which do: modulo a prime, as ranks are.
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
        forms = [
            residues({at[link]: Fraction(c) for link, c in row.terms if link in at} | {_GIVEN: -row.right})
            for row in rows
        ]
        follow = set(eliminate(forms, modulus=PRIME).redundant)
        rows = [row for position, row in enumerate(rows) if position not in follow]
    return links, rows


def _nearest(row: WillisEquation) -> float:
    value = as_float(row.right)
    if value is None:
        what = f"the right-hand side of '{row.label}' is no float"
        raise RangeError(Problem(what, "a float holds 1e-308 to 1e308", "read `equations().equations`, in fractions"))
    return value
