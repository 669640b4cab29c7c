"""A priori bounds on the rounding of sums of products and of their quotients in float64.

n roundings in a term change it by at most n u / (1 - n u) of itself (Higham, Accuracy and Stability of Numerical
Algorithms, section 3.1); the bounds are of first order in u, times `SLACK`. They hold where nothing nears the ends of
float64: that is for the caller to see to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

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
