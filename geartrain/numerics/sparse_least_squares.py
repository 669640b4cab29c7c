"""Least squares with a sparse matrix that has a few entries per row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices


_REST = 1e-4  # reduction of the gradient at which conjugate gradients stop
_STEPS = 1000  # maximum number of conjugate gradient steps
_DENSE = 250_000  # entries up to which a dense matrix is used


@dataclass(frozen=True)
class SparseRows:
    """Matrix with a fixed small number of entries per row, given by their columns and coefficients."""

    columns: Indices
    factors: Floats
    width: int

    def small(self, height: int) -> bool:
        """Return whether a matrix with `height` rows is solved as a dense matrix."""
        return height * self.width <= _DENSE

    def least_squares(self, right: Floats) -> Floats:
        """Return x that minimises |A x - right|.

        Small systems are solved by singular value decomposition, others by conjugate gradients (CGLS).
        """
        # scale the columns: tooth counts from 8 to 10^6 would slow down conjugate gradients and distort `rcond`
        size = np.zeros(self.width)
        np.maximum.at(size, self.columns.ravel(), np.abs(self.factors).ravel())
        size[size == 0] = 1.0
        even = SparseRows(self.columns, self.factors / size[self.columns], self.width)
        return (even._dense(right) if self.small(len(right)) else even._gradients(right)) / size

    def times(self, x: Floats) -> Floats:
        """Return the product of the matrix and a vector x."""
        product: Floats = (self.factors * x[self.columns]).sum(axis=1)
        return product

    def _dense(self, right: Floats) -> Floats:
        matrix = np.zeros((len(right), self.width))
        # a row may contain a column twice: `add.at` adds both, an assignment would keep only one
        np.add.at(matrix, (np.arange(len(right))[:, None], self.columns), self.factors)
        # free motions make the matrix singular up to rounding: singular values below 1e-11 of the maximum count as 0
        return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-11)[0], float)

    def _gradients(self, right: Floats) -> Floats:
        x: Floats = np.zeros(self.width)
        rest, gradient = right.copy(), self._back(right)
        way, power = gradient.copy(), float(gradient @ gradient)
        minimum = _REST**2 * power
        for _ in range(_STEPS):
            if power <= minimum:  # also true of a zero right-hand side
                break
            along = self.times(way)
            # not 0: `way` is in the row space, where only the zero vector has the image 0
            step = power / float(along @ along)
            x += step * way
            rest -= step * along
            gradient = self._back(rest)
            power, last = float(gradient @ gradient), power
            way = gradient + power / last * way
        return x

    def _back(self, rows: Floats) -> Floats:
        return np.bincount(self.columns.ravel(), (self.factors * rows[:, None]).ravel(), self.width).astype(float)
