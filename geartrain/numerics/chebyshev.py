"""Chebyshev series on an interval: interpolation, a measure of convergence, and differentiation at nodes."""

from __future__ import annotations

from functools import lru_cache
from math import inf, nextafter
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.polynomial import chebyshev as cheb

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


def series_through(values: Floats, start: float, end: float) -> Chebyshev:
    """Return the series on [start, end] that interpolates the values at the Chebyshev points (see `points`)."""
    _, inverse = points(len(values))
    # a series on a point is a constant: numpy needs an interval
    return Chebyshev(inverse @ values, domain=[start, end if end != start else nextafter(start, inf)])


def tail(series: Chebyshev) -> float:
    """Return the maximum magnitude of the last four coefficients of a series divided by the maximum of all."""
    size = np.abs(series.coef)
    return float(size[-4:].max() / max(size.max(), 1e-300))  # the last coefficient only may be 0 by symmetry


@lru_cache(maxsize=32)
def points(count: int) -> tuple[Floats, Floats]:
    """Return the Chebyshev points of the second kind on [-1, 1], and the matrix that maps values to coefficients."""
    x = np.asarray(-np.cos(np.pi * np.arange(count) / (count - 1)), dtype=np.float64)
    # at these points the matrix is as well conditioned as a cosine transform, so that inverting it is accurate
    return x, np.asarray(np.linalg.inv(cheb.chebvander(x, count - 1)), dtype=np.float64)


@lru_cache(maxsize=32)
def differentiation(count: int) -> Floats:
    """Return the differentiation matrix at the Chebyshev points, in barycentric form with row sums of 0."""
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
