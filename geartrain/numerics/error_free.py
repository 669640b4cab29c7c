"""Sums and products of floats together with their rounding error: error-free transformations, element by element."""

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
