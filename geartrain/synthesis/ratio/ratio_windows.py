"""Where a window of ratios cuts a list of products, exactly; and how far a ratio is from the wanted one."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.decimal_text import count_digits
from geartrain.numerics.error_free import split
from geartrain.numerics.integer_columns import distinct_quotients
from geartrain.synthesis.stern_brocot import farey_neighbours

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Ints = NDArray[Any]
    Places = NDArray[np.int64]

ROUNDING = 1e-28
"""Errors from `errors` differ from the exact ones by less than this, or by 1e-12 of themselves."""


def cuts(products: Ints, factors: Ints, low: Fraction, high: Fraction) -> tuple[Places, Places]:
    """For each factor f, the half-open range of `products` with low f <= product <= high f, decided exactly.

    products   ascending, at least one
    factors    positive, in the same dtype: int64 below 2^52, or Python integers
    low, high  0 <= low <= high
    """
    # no ratio of these products has a longer denominator than the largest factor
    longest = int(factors.max()) if len(factors) else 1
    # past all products, with room for the guess in `_floors`: what lies beyond needs no exact floor
    cap = int(products[-1]) + 8
    first, whole = _floors(factors, farey_neighbours(low, longest)[1], cap)
    # the ceiling: one more where the product is not whole
    first = first + ~whole
    last, _ = _floors(factors, farey_neighbours(high, longest)[0], cap)
    return np.searchsorted(products, first), np.searchsorted(products, last, side="right")


def _floors(factors: Ints, edge: Fraction, cap: int) -> tuple[Ints, NDArray[np.bool_]]:
    """floor(factor x edge), no more than `cap`; and whether the product is whole.

    In int64 the remainder factor n - floor d is worked out modulo 2^64: with d below 2^52 and a floor guessed in
    float64 within 3 it is less than 2^63, hence right.
    """
    n, d = edge.numerator, edge.denominator
    if factors.dtype == object:
        exact = factors * n
        found = np.minimum(exact // d, cap)
        return found, np.asarray(exact % d == 0, dtype=bool)
    near = factors * float(edge)
    found = np.minimum(near, cap).astype(np.int64)
    rest = factors * _wrapped(n) - found * d
    more = rest // d
    beyond = near > cap
    return np.where(beyond, cap, found + more), (rest == more * d) & ~beyond


def _wrapped(number: int) -> np.int64:
    """The integer modulo 2^64 as a signed one."""
    return np.int64((number + (1 << 63)) % (1 << 64) - (1 << 63))


def errors(tops: Ints, beneaths: Ints, value: Fraction) -> Floats:
    """top / (beneath value) - 1 of each pair, to about 1e-30: in twice float64's digits (Dekker's products)."""
    # the value and all products of its halves then stay within float64
    short = abs(value.numerator.bit_length() - value.denominator.bit_length()) < 300
    if tops.dtype == object or beneaths.dtype == object or not short:
        n, d = value.numerator, value.denominator
        exact = [Fraction(int(p) * d, int(q) * n) - 1 for p, q in zip(tops, beneaths, strict=True)]
        return np.array([float(error) for error in exact], dtype=np.float64)
    head = float(value)
    tail = float(value - Fraction(head))
    q = beneaths.astype(np.float64)
    product = q * head
    q_high, q_low = split(q)
    head_high, head_low = split(np.float64(head))
    # largest first: in this order no sum rounds
    lost = ((q_high * head_high - product) + q_high * head_low + q_low * head_high) + q_low * head_low
    return np.asarray(((tops - product) - (lost + q * tail)) / product)


def error_places(tops: Ints, beneaths: Ints, value: Fraction) -> tuple[list[Fraction], Places]:
    """The different exact |errors| of some pairs, ascending, and the place of each pair's among them."""
    ratios, which = distinct_quotients(tops, beneaths)
    misses = [abs(ratio / value - 1) for ratio in ratios]
    ascending = sorted(set(misses))
    places = {miss: at for at, miss in enumerate(ascending)}
    return ascending, np.array([places[miss] for miss in misses], dtype=np.int64)[which]


def reach_of_errors(value: Fraction, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """The least and the greatest |error| of ratios from `low` to `high`."""
    first, last = low / value - 1, high / value - 1
    return max(first, -last, Fraction(0)), max(last, -first)


def rounded_up(bound: float | Fraction) -> Fraction:
    """Never less than the bound, in few digits: a tolerance that may be written down."""
    exact = Fraction(bound)
    if exact <= 0:
        return Fraction(0)
    power = count_digits(exact.numerator) - count_digits(exact.denominator) - 3
    unit = Fraction(10) ** power
    return -(-exact // unit) * unit
