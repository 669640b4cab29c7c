"""Near ties decided: sines to fifty digits, and comparisons that floats cannot settle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal, localcontext
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Ints


_DIGITS = 70  # fifty are meant: the others take up the rounding of sums and powers
_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803")
_NEAR = 1e-7  # of the terms: floats, with a root of a difference among the terms, are nearer than this
_EQUAL = Decimal("1e-25")  # of the terms: what agrees in so many digits is equal

Kernel = Callable[..., Sequence[Any]]
"""Terms of a margin: `kernel(root, *numbers)`, of arrays of floats or of decimals.

`root` is their square root, 0 of what is negative.
"""


def decimal(number: Fraction | int) -> Decimal:
    """A fraction to fifty digits."""
    with localcontext(prec=_DIGITS):
        return Decimal(Fraction(number).numerator) / Decimal(Fraction(number).denominator)


def sine(turns: Fraction) -> Decimal:
    """Sine of an angle from -1 to 1 turns, to fifty digits (its power series)."""
    with localcontext(prec=_DIGITS):
        x = 2 * _PI * decimal(turns)
        term = total = x
        order = 1
        while abs(term) > Decimal(10) ** -_DIGITS:
            order += 2
            term = -term * x * x / (order * (order - 1))
            total += term
        return total


def cosine(turns: Fraction) -> Decimal:
    """Cosine of an angle from -1 to 3/4 turns, to fifty digits."""
    return sine(turns + Fraction(1, 4))


def is_positive(kernel: Kernel, counts: Sequence[Ints], constants: Sequence[Decimal], strictly: bool) -> Bools:
    """Where the sum of the terms is above 0 (or 0, unless `strictly`), for each candidate.

    counts     whole numbers, arrays that numpy spreads to one shape, (candidates,)
    constants  numbers that are the same for all

    Floats decide what is clear, fifty digits the rest. Terms may hold roots of differences of products.
    """
    spread = np.broadcast_arrays(*counts)
    terms = kernel(_root, *(column.astype(float) for column in spread), *map(float, constants))
    margin, scale = _total(terms), _total([np.abs(term) for term in terms])
    found = np.broadcast_to(margin > 0, spread[0].shape).copy()
    for at in np.flatnonzero(np.broadcast_to(np.abs(margin) <= _NEAR * scale, found.shape)):
        found.flat[at] = _decide(kernel, [int(column.flat[at]) for column in spread], constants, strictly)
    return found


def _root(square: Any) -> NDArray[np.float64]:
    return np.asarray(np.sqrt(np.maximum(np.asarray(square, dtype=float), 0.0)))


def _decimal_root(square: Decimal) -> Decimal:
    return max(square, Decimal(0)).sqrt()


def _total(terms: Sequence[Any]) -> NDArray[np.float64]:
    return np.asarray(sum(terms), dtype=float)


def _decide(kernel: Kernel, counts: Sequence[int], constants: Sequence[Decimal], strictly: bool) -> bool:
    with localcontext(prec=_DIGITS):
        terms = kernel(_decimal_root, *map(Decimal, counts), *constants)
        total, scale = sum(terms, Decimal(0)), sum(map(abs, terms), Decimal(0))
        return bool(total > scale * _EQUAL if strictly else total >= -scale * _EQUAL)
