"""Rounding in float64: error-free transformations of sums and products, and a priori bounds on longer ones.

n roundings in a term change it by at most n u / (1 - n u) of itself (Higham, Accuracy and Stability of Numerical
Algorithms, section 3.1); the bounds are of first order in u, times `SLACK`. They hold where nothing nears the ends of
float64, which the caller must ensure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

F = TypeVar("F", float, "Floats")

SPLITTER = 134217729.0  # 2^27 + 1: cuts a float64 into two halves of 26 bits, whose products are exact


def two_sum(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """a + b = s + e exactly (Knuth 1969)."""
    s = a + b
    part = s - a  # what of b arrived in s; without a branch on which of the two is larger
    return s, (a - (s - part)) + (b - part)


def two_product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """a b = p + e exactly, barring underflow and overflow (Dekker 1971)."""
    p = a * b
    a_high, a_low = split(a)
    b_high, b_low = split(b)
    # in this order every step is exact
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def split(a: F) -> tuple[F, F]:
    """A float as the sum of two of 26 bits (Dekker 1971; Veltkamp)."""
    big = SPLITTER * a
    high = big - (big - a)  # overflows beyond about 2^996
    return high, a - high


UNIT_ROUNDOFF = 2.0**-53
"""The most by which rounding to float64 changes a number, over its size."""

SLACK = 1 + 1e-6
"""Covers the roundings of the bounds themselves, and the squares that first-order bounds leave out."""


def sum_error(roundings: int, size: Floats) -> Floats:
    """Bound on the error of a sum.

    roundings   in one term, at most, and one for each term of the sum
    size        the same sum with all signs plus
    """
    return SLACK * roundings * UNIT_ROUNDOFF * size


def quotient_error(value: Floats, off: Floats, room: Floats, beside: Floats) -> Floats:
    """Bound on the error of a quotient as computed, `value`, whose parts have errors themselves.

    off, beside   bounds on the errors above and below
    room          size of what is below, less its bound: no digit is sure where it is not positive
    """
    return SLACK * ((off + abs(value) * beside) / room + 2 * UNIT_ROUNDOFF * abs(value))
