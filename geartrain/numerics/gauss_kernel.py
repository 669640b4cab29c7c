"""Gaussian elimination with row pivots as a kernel: small dense systems inside compiled loops."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.kernels import kernel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@kernel
def solve_in_place(matrix: Floats, right: Floats) -> float:
    """Solve `matrix` x = `right`; x stands in `right` then, and `matrix` is spent.

    Returns the determinant: 0 where no pivot is left, or none that is a number, and nothing is solved.
    """
    size = len(right)
    determinant: float = 1.0
    for column in range(size):
        best = column
        for row in range(column + 1, size):
            if abs(matrix[row, column]) > abs(matrix[best, column]):
                best = row
        if not abs(matrix[best, column]) > 0:
            return 0.0
        if best != column:
            determinant = -determinant
            for at in range(size):
                matrix[column, at], matrix[best, at] = matrix[best, at], matrix[column, at]
            right[column], right[best] = right[best], right[column]
        determinant *= matrix[column, column]
        for row in range(column + 1, size):
            factor = matrix[row, column] / matrix[column, column]
            for at in range(column + 1, size):
                matrix[row, at] -= factor * matrix[column, at]
            right[row] -= factor * right[column]
    for row in range(size - 1, -1, -1):
        for at in range(row + 1, size):
            right[row] -= matrix[row, at] * right[at]
        right[row] /= matrix[row, row]
    return determinant
