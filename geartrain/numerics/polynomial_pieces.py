"""Smooth curves as piecewise polynomials of one degree: fitting and evaluation, vectorised.

Each piece is a polynomial in u, which increases from -1 to 1 along the piece. Coefficients have the shape (COUNT,
pieces), in ascending order of powers of u.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev as cheb
from numpy.polynomial import polynomial as poly

from geartrain.errors import Problem, RangeError
from geartrain.numerics.chebyshev import points

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

COUNT = 16  # coefficients of a piece
FINE = 2e-15  # relative size of negligible coefficients
_NOISE = 1e-10  # relative size below which coefficients may be noise, if bisection does not reduce them
_DEEPEST = 40  # bisections: a piece is then 1e-12 of the curve
_TAIL = 3  # last coefficients, by which convergence is judged
_NODES, _SERIES = points(COUNT)
# points between the nodes, where the error is largest
_BETWEEN = -np.cos(np.pi * (np.arange(COUNT - 1) + 0.5) / (COUNT - 1))
# Chebyshev polynomials as powers, for Horner's rule: coefficients of T_k grow by a factor of 2.4 per degree, and those
# of a converged series fall by about 10, so that cancellation is harmless
POWERS = np.array([np.pad(cheb.cheb2poly(row[: at + 1]), (0, COUNT - 1 - at)) for at, row in enumerate(np.eye(COUNT))])


class PolynomialPiece(NamedTuple):
    """Piece of a curve with k coordinates: the parameter at both ends, the coefficients of the powers of u in [-1, 1],
    shape (COUNT, k), and the maximum error of each coordinate, shape (k,).
    """

    start: float
    end: float
    coefficients: Floats
    error: Floats


def fitted(curve: Callable[[Floats], Floats], start: float, end: float, depth: int = 0) -> list[PolynomialPiece]:
    """Return the pieces of a curve with k coordinates, which are fitted by adaptive Chebyshev interpolation to rounding
    error. `curve` maps parameters of shape (n,) to points of shape (k, n).

    Pieces are bisected until their last coefficients are negligible. Raises `RangeError` if the curve is not smooth.
    """
    piece, tail = _piece(curve, start, end)
    if tail <= FINE:
        return [piece]
    middle = start + (end - start) / 2
    halves = [_piece(curve, *ends) for ends in ((start, middle), (middle, end))]
    if tail <= _NOISE and min(half[1] for half in halves) > tail / 4:
        return [piece]  # bisecting a smooth curve reduces the tail far more: the rest is noise
    if depth == _DEEPEST or not np.isfinite(tail):
        what = f"a curve cannot be interpolated near parameter {start:.6g}"
        why = "the curve is not smooth or not finite there"
        raise RangeError(Problem(what, why, "split it into curves at its kinks, or use another parameter"))
    return fitted(curve, start, middle, depth + 1) + fitted(curve, middle, end, depth + 1)


def _piece(curve: Callable[[Floats], Floats], start: float, end: float) -> tuple[PolynomialPiece, float]:
    """Return the Chebyshev interpolant of a curve, and its last coefficients relative to the values of the curve."""
    half, middle = (end - start) / 2, start + (end - start) / 2
    t = middle + half * np.concatenate([_NODES, _BETWEEN])
    t[0], t[COUNT - 1] = start, end  # rounding must not move a node outside, where the curve may be undefined
    with np.errstate(all="ignore"):
        values = np.asarray(curve(t), dtype=float).T
        series = _SERIES @ values[:COUNT]
        coefficients = POWERS.T @ series
        error = np.abs(poly.polyval(_BETWEEN, coefficients).T - values[COUNT:]).max(axis=0)
        size = np.maximum(np.abs(values).max(axis=0), 0.1)  # angles are accurate to the rounding of a tenth of a radian
        tail = float((np.abs(series[-_TAIL:]).max(axis=0) / size).max())
    return PolynomialPiece(start, end, coefficients, error), tail


def value(coefficients: Floats, piece: Indices, u: Floats) -> tuple[Floats, Floats]:
    """Return values and derivatives at `u` of pieces with indices `piece`; `coefficients` has shape (COUNT, pieces)."""
    single = coefficients.shape[1] == 1
    found, slope = np.zeros(u.shape), np.zeros(u.shape)
    for row in coefficients[::-1]:  # Horner's rule in place for value and derivative
        slope *= u
        slope += found
        found *= u
        found += row[0] if single else row.take(piece)
    return found, slope


def ends(coefficients: Floats) -> Floats:
    """Return the values of the pieces at both ends, shape (2, pieces)."""
    # all powers of u are 1 or -1 there, so that sums are sufficient
    signs = np.where(np.arange(len(coefficients)) % 2, -1.0, 1.0)
    return np.stack([signs @ coefficients, coefficients.sum(axis=0)])
