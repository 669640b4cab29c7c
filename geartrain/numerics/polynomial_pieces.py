"""Smooth curves as polynomials of one degree on short pieces, evaluated for many pieces at once.

Named arrays whose last axis counts the same things: some of them, or several sets in one row.

Roots of many functions at once, each kept inside its bracket.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.polynomial import chebyshev as cheb

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Indices

    Flags = NDArray[np.bool_]

COUNT = 16  # coefficients of a piece
FINE = 2e-15  # of the size: as good as given
_NOISE = 1e-10  # of the size: less may be the rounding of what is given, if halving does not lessen it
_DEEPEST = 40
_TAIL = 3  # coefficients that tell whether a piece is short enough
_NODES = -np.cos(np.pi * np.arange(COUNT) / (COUNT - 1))
_BETWEEN = -np.cos(np.pi * (np.arange(COUNT - 1) + 0.5) / (COUNT - 1))
_SERIES = np.linalg.inv(cheb.chebvander(_NODES, COUNT - 1))
POWERS = np.array([np.pad(cheb.cheb2poly(row[: at + 1]), (0, COUNT - 1 - at)) for at, row in enumerate(np.eye(COUNT))])


class PolynomialPiece(NamedTuple):
    """A piece of a curve: parameters of its ends, coefficients of u in [-1, 1] (COUNT, k), greatest error found (k)."""

    start: float
    end: float
    coefficients: Floats
    error: Floats


def fitted(curve: Callable[[Floats], Floats], start: float, end: float, depth: int = 0) -> list[PolynomialPiece]:
    """Pieces of a curve of k coordinates, t (n,) -> (k, n), halved until they are as good as rounding lets them be.

    Raises `RangeError` where the curve is not smooth.
    """
    piece, tail = _piece(curve, start, end)
    if tail <= FINE:
        return [piece]
    middle = start + (end - start) / 2
    halves = [_piece(curve, *ends) for ends in ((start, middle), (middle, end))]
    if tail <= _NOISE and min(half[1] for half in halves) > tail / 4:
        return [piece]
    if depth == _DEEPEST or not np.isfinite(tail):
        raise RangeError(
            Problem(
                f"a curve cannot be followed near parameter {start:.6g}",
                "it is not smooth there, or not finite",
                "cut it into curves at its corners, or give it another parameter",
            )
        )
    return fitted(curve, start, middle, depth + 1) + fitted(curve, middle, end, depth + 1)


def _piece(curve: Callable[[Floats], Floats], start: float, end: float) -> tuple[PolynomialPiece, float]:
    """The piece through the curve's points at Chebyshev nodes, and how far its last coefficients have fallen."""
    half, middle = (end - start) / 2, start + (end - start) / 2
    t = middle + half * np.concatenate([_NODES, _BETWEEN])
    t[0], t[COUNT - 1] = start, end
    with np.errstate(all="ignore"):
        values = np.asarray(curve(t), dtype=float).T
        series = _SERIES @ values[:COUNT]
        coefficients = POWERS.T @ series
        error = np.abs(np.polynomial.polynomial.polyval(_BETWEEN, coefficients).T - values[COUNT:]).max(axis=0)
        size = np.maximum(np.abs(values).max(axis=0), 0.1)  # an azimuth is known to rounding of a tenth of a radian
        tail = float((np.abs(series[-_TAIL:]).max(axis=0) / size).max())
    return PolynomialPiece(start, end, coefficients, error), tail


def value(coefficients: Floats, piece: Indices, u: Floats) -> tuple[Floats, Floats]:
    """Value and derivative at u of the given pieces; coefficients (COUNT, pieces)."""
    single = coefficients.shape[1] == 1
    found, slope = np.zeros(u.shape), np.zeros(u.shape)
    for row in coefficients[::-1]:
        slope *= u
        slope += found
        found *= u
        found += row[0] if single else row.take(piece)
    return found, slope


NamedArrays = TypeVar("NamedArrays", bound=tuple[Any, ...])


def some(columns: NamedArrays, which: Indices | Flags) -> NamedArrays:
    """Those that are numbered, or flagged, in `which`."""
    kind: Any = type(columns)
    found: NamedArrays = kind(*(each[..., which] for each in columns))
    return found


def joined(sets: Sequence[NamedArrays]) -> NamedArrays:
    """Several sets, one after another."""
    kind: Any = type(sets[0])
    found: NamedArrays = kind(*(np.concatenate(each, axis=-1) for each in zip(*sets, strict=True)))
    return found


_MOST = 100
_PATIENCE = 4  # steps without half the bracket: halve it


def roots(
    value: Callable[[Floats, Indices], Floats],
    low: Floats,
    high: Floats,
    at_low: Floats,
    at_high: Floats,
    fine: float = 1e-15,
) -> Floats:
    """Where `value` changes its sign between low and high; steps end when they are below `fine`.

    value(x, which)   the functions numbered `which` at x
    The method is Anderson's and Bjorck's false position; where an end is stuck, halving. A bracket without a change of
    sign gives its end with the lesser value.
    """
    found = np.where(np.abs(at_low) < np.abs(at_high), low, high)
    which = np.flatnonzero(np.sign(at_low) * np.sign(at_high) < 0)
    a, b, f, g = low[which], high[which], at_low[which], at_high[which]
    width, stuck = np.abs(b - a), np.zeros(len(which), int)
    for _ in range(_MOST):
        if not len(which):
            break
        with np.errstate(invalid="ignore", divide="ignore"):
            x = b - g * (b - a) / (g - f)
        inside = (x - a) * (x - b) < 0
        x = np.where(inside & (stuck < _PATIENCE), x, a + (b - a) / 2)
        at = value(x, which)
        step = np.abs(x - b)
        crossed = np.sign(at) != np.sign(g)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = 1 - at / g
        f = np.where(crossed, g, f * np.where(share > 0, share, 0.5))
        a = np.where(crossed, b, a)
        b, g = x, at
        found[which] = x
        now = np.abs(b - a)
        shrunk = now < width / 2
        width, stuck = np.where(shrunk, now, width), np.where(shrunk | (stuck >= _PATIENCE), 0, stuck + 1)
        left = (at != 0) & (step > fine) & (now > fine)
        which, a, b, f, g, width, stuck = (each[left] for each in (which, a, b, f, g, width, stuck))
    return found
