"""Chebyshev series on an interval: interpolation, differentiation and integration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import chebyshev as cheb

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class ChebyshevSeries:
    """Chebyshev series on the interval [start, end], which can be differentiated and integrated."""

    coefficients: Floats
    start: float
    end: float

    @classmethod
    def of(cls, f: Callable[[Floats], Floats], start: float, end: float, nodes: int) -> ChebyshevSeries:
        """Return the series that interpolates the function f at `nodes` Chebyshev points of the interval."""
        d = np.asarray(start + (end - start) * (points(nodes)[0] + 1) / 2, dtype=np.float64)
        return cls.through(f(d), start, end)

    @classmethod
    def through(cls, values: Floats, start: float, end: float) -> ChebyshevSeries:
        """Return the series that interpolates values at the Chebyshev points of `points`, in ascending order."""
        _, inverse = points(len(values))
        return cls(np.asarray(inverse @ values, dtype=np.float64), start, end)

    def __call__(self, d: Floats) -> Floats:
        return np.asarray(cheb.chebval(self._scaled(d), self.coefficients), dtype=np.float64)

    def _scaled(self, d: Floats) -> Floats:
        width = self.end - self.start
        if not width:  # a series on a point is a constant
            return np.zeros(np.shape(d))
        # 2 (d - start) first: it is exact at both ends, so that these are mapped to -1 and 1
        found: Floats = (2 * (np.asarray(d) - self.start) - width) / width
        return found

    def derivative(self) -> ChebyshevSeries:
        """Return the derivative of the series."""
        width = self.end - self.start
        return ChebyshevSeries(
            np.asarray(cheb.chebder(self.coefficients) * 2 / width, dtype=np.float64), self.start, self.end
        )

    def integral(self) -> ChebyshevSeries:
        """Return the antiderivative that is 0 at `start`."""
        width = self.end - self.start
        raised = np.asarray(cheb.chebint(self.coefficients, lbnd=-1) * width / 2, dtype=np.float64)
        return ChebyshevSeries(raised, self.start, self.end)

    @property
    def tail(self) -> float:
        """Maximum magnitude of the last four coefficients divided by the maximum magnitude of all coefficients, a
        measure of convergence.
        """
        size = np.abs(self.coefficients)
        return float(size[-4:].max() / max(size.max(), 1e-300))  # the last coefficient only may be 0 by symmetry


@lru_cache(maxsize=32)
def points(count: int) -> tuple[Floats, Floats]:
    """Return the Chebyshev points of the second kind on [-1, 1], and the matrix from values to coefficients."""
    x = np.asarray(-np.cos(np.pi * np.arange(count) / (count - 1)), dtype=np.float64)
    # at these points the matrix is as well conditioned as a cosine transform, so that inverting it is accurate
    return x, np.asarray(np.linalg.inv(cheb.chebvander(x, count - 1)), dtype=np.float64)


@lru_cache(maxsize=32)
def differentiation(count: int) -> Floats:
    """Return the differentiation matrix at the Chebyshev points of `points` (barycentric form, rows summing to 0)."""
    x, _ = points(count)
    weights = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    # barycentric weights of these points (Berrut and Trefethen 2004)
    weights[[0, -1]] /= 2
    gap = x[:, None] - x[None, :]
    np.fill_diagonal(gap, 1.0)
    matrix = weights[None, :] / weights[:, None] / gap
    np.fill_diagonal(matrix, 0.0)
    # the derivative of a constant is exactly 0: this condition gives smaller rounding errors than the formula
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix
