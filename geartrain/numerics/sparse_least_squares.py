"""Least squares with a sparse matrix that has a few entries per row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices


_DENSE = 250_000  # entries of a matrix up to which it counts as small


@dataclass(frozen=True)
class SparseRows:
    """Matrix with a fixed small number of entries per row, given by their columns and coefficients."""

    columns: Indices
    factors: Floats
    width: int

    def small(self, height: int) -> bool:
        """Return True if a matrix with `height` rows is small enough for a fast solution."""
        return height * self.width <= _DENSE

    def least_squares(self, right: Floats) -> Floats:
        """Return the x of minimum norm that minimises |A x - right|, by LSMR (Fong and Saunders 2011)."""
        from scipy.sparse import csr_array
        from scipy.sparse.linalg import lsmr

        # scale the columns: tooth counts from 8 to 10^6 would slow down the iteration
        size = np.zeros(self.width)
        np.maximum.at(size, self.columns.ravel(), np.abs(self.factors).ravel())
        size[size == 0] = 1.0
        rows = np.repeat(np.arange(len(right)), self.columns.shape[1])
        entries = (self.factors / size[self.columns]).ravel(), (rows, self.columns.ravel())
        accuracy = 1e-13 if self.small(len(right)) else 1e-6
        found = lsmr(csr_array(entries, shape=(len(right), self.width)), right, atol=accuracy, btol=accuracy, conlim=0)
        return np.asarray(found[0] / size, float)

    def times(self, x: Floats) -> Floats:
        """Return the product of the matrix and a vector x."""
        product: Floats = (self.factors * x[self.columns]).sum(axis=1)
        return product
