"""Rounding in float64: error-free transformations of sums and products, and constants of a priori error bounds.

The relative error of a term after n roundings is at most n u / (1 - n u) with the unit roundoff u (Higham, Accuracy and
Stability of Numerical Algorithms, section 3.1). Bounds are of first order in u, times `SLACK`. They are valid if no
underflow or overflow occurs, which the caller must ensure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

F = TypeVar("F", float, "Floats")

SPLITTER = 134217729.0  # 2^27 + 1: splits a float64 into two halves of 26 bits, whose products are exact


def two_sum(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return the floats s and e for which a + b = s + e exactly (Knuth 1969)."""
    s = a + b
    part = s - a  # part of b that is in s; no comparison of a and b is needed
    return s, (a - (s - part)) + (b - part)


def two_product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return the floats p and e for which a b = p + e exactly, unless underflow or overflow occurs (Dekker 1971)."""
    p = a * b
    a_high, a_low = split(a)
    b_high, b_low = split(b)
    # in this order every step is exact
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def split(a: F) -> tuple[F, F]:
    """Return two floats with 26 significant bits, the sum of which is exactly `a` (Dekker 1971; Veltkamp)."""
    big = SPLITTER * a
    high = big - (big - a)  # overflows beyond about 2^996
    return high, a - high


UNIT_ROUNDOFF = 2.0**-53
"""Maximum relative error of rounding to float64."""

SLACK = 1 + 1e-6
"""Safety factor for the roundings in the bounds themselves and for terms of second order."""
