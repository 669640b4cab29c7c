"""Products of tooth counts over all multisets of a given size, generated in windows of value with bounded memory."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.exact import count_digits
from geartrain.search.integer_columns import distinct_quotients, spread
from geartrain.search.stern_brocot import farey_neighbours

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Places = NDArray[np.int64]
    Ints = NDArray[np.int64]


# Index ranges of products within windows of ratios, and relative errors of ratios.


def cuts(products: Ints, factors: Ints, low: Fraction, high: Fraction) -> tuple[Places, Places]:
    """Return, for each factor f, the half-open index range of the `products` with low f <= product <= high f, compared
    exactly.

    products   ascending, at least one
    factors    positive, below 2^52
    low, high  0 <= low <= high
    """
    # no ratio of these products has a denominator larger than the largest factor
    longest = int(factors.max()) if len(factors) else 1
    # above all products, with a margin for the estimate in `_floors`; larger values need no exact floor
    cap = int(products[-1]) + 8
    first, whole = _floors(factors, farey_neighbours(low, longest)[1], cap)
    # ceiling: one more than the floor if the product is not an integer
    first = first + ~whole
    last, _ = _floors(factors, farey_neighbours(high, longest)[0], cap)
    return np.searchsorted(products, first), np.searchsorted(products, last, side="right")


def _floors(factors: Ints, edge: Fraction, cap: int) -> tuple[Ints, NDArray[np.bool_]]:
    """Return floor(factor x edge), at most `cap`, and whether the product factor x edge is an integer.

    The remainder factor n - floor d, with edge = n/d, is computed modulo 2^64. With d below 2^52, and a
    float64 estimate of the floor that is within 3 of it, the remainder is less than 2^63 and therefore exact.
    """
    n, d = edge.numerator, edge.denominator
    near = factors * float(edge)
    found = np.minimum(near, cap).astype(np.int64)
    rest = factors * _wrapped(n) - found * d
    more = rest // d
    beyond = near > cap
    return np.where(beyond, cap, found + more), (rest == more * d) & ~beyond


def _wrapped(number: int) -> np.int64:
    """Return the integer modulo 2^64 as a signed int64."""
    return np.int64((number + (1 << 63)) % (1 << 64) - (1 << 63))


def error_places(tops: Ints, beneaths: Ints, value: Fraction) -> Places:
    """Return for each ratio of two products the rank of its absolute error, compared exactly. Equal errors have equal
    ranks.
    """
    ratios, which = distinct_quotients(tops, beneaths)
    misses = [abs(ratio / value - 1) for ratio in ratios]
    places = {miss: at for at, miss in enumerate(sorted(set(misses)))}
    return np.array([places[miss] for miss in misses], dtype=np.int64)[which]


def reach_of_errors(value: Fraction, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """Return the minimum and maximum absolute relative error with respect to `value` of all ratios from `low` to
    `high`.
    """
    first, last = low / value - 1, high / value - 1
    return max(first, -last, Fraction(0)), max(last, -first)


def rounded_up(bound: float | Fraction) -> Fraction:
    """Round a bound up to three or four significant digits, so that it can be printed as a tolerance."""
    exact = Fraction(bound)
    if exact <= 0:
        return Fraction(0)
    power = count_digits(exact.numerator) - count_digits(exact.denominator) - 3
    unit = Fraction(10) ** power
    return -(-exact // unit) * unit


MOST_STAGES = 5
_LARGEST = 1 << 52
"""Limit of products, which float64 represents exactly."""
_MOST_ROWS = 12 * 10**6  # maximum number of rows of the tables in memory


@dataclass(frozen=True, slots=True, eq=False)
class ProductWindows:
    """Products c_1 c_2 ... c_k of admissible counts c_1 <= ... <= c_k, each stored as (low part) x (high part).

    The sorted counts are split at their middle element m. A row holds m and the counts below it, and is combined with
    every high part whose counts are all at least m, so each multiset occurs once. Memory is O(n^3) for n counts, while
    the C(n+k-1, k) products are generated window by window.
    """

    counts: tuple[int, ...]
    """Admissible tooth counts, ascending."""
    size: int
    """Number k of counts in a product."""
    rows: Ints
    """Product of the counts of each low part, shape (rows,)."""
    lows: Ints
    """Counts of each low part, ascending, shape (rows, a)."""
    highs: Ints
    """Product of the counts of each high part, ascending within each table, shape (highs,)."""
    uppers: Ints
    """Counts of each high part, ascending, shape (highs, b)."""
    keys: Ints
    """Sum of `highs` and the offset of the table, which is ascending over all tables, shape (highs,)."""
    offsets: Ints
    """Offset of the table of high parts that each row is combined with, shape (rows,)."""
    starts: Places
    """Index of the first high part that each row is combined with, shape (rows,)."""
    step: int
    """Distance between the offsets, larger than any high part."""

    def below(self, bound: int) -> int:
        """Return the exact number of multisets with a product less than `bound`."""
        return int((_ends(self, bound) - self.starts).sum())

    def values(self, low: int, high: int) -> tuple[Ints, Places]:
        """Return the distinct products in [low, high) in ascending order, shape (n,), and the number of multisets of
        the window below each product and in total, shape (n + 1,).
        """
        row, column = spread(_ends(self, low), _ends(self, high))
        found = self.rows[row]
        # in place, because a window is the largest array of the search
        found *= self.highs[column]
        found.sort()
        starts = np.flatnonzero(np.append(True, found[1:] != found[:-1]))
        return found[starts], np.append(starts, len(found))

    def members(self, low: int, high: int, among: Ints) -> tuple[Ints, Ints]:
        """Return the products in [low, high) that are in `among` (ascending, not empty), ascending, shape (n,), and
        their counts, ascending in each row, shape (n, size).
        """
        row, column = spread(_ends(self, low), _ends(self, high))
        products = self.rows[row] * self.highs[column]
        # clipped, so that products above all of `among` have a valid index
        at = np.minimum(np.searchsorted(among, products), len(among) - 1)
        here = np.flatnonzero(among[at] == products)
        here = here[np.argsort(products[here])]
        counts = np.concatenate([self.lows[row[here]], self.uppers[column[here]]], axis=1)
        return products[here], counts.astype(np.int64)


@lru_cache(maxsize=4)
def _ends(products: ProductWindows, bound: int) -> Places:
    """Return for each row the index after the last high part whose product with the row is below `bound`, shape
    (rows,).
    """
    # one binary search for all tables: the offset of a row selects its table
    most = np.minimum((bound - 1) // products.rows, products.step - 1) + products.offsets
    return np.asarray(np.maximum(np.searchsorted(products.keys, most, side="right"), products.starts), dtype=np.int64)


def multisets(number: int, size: int) -> int:
    """Return the number of multisets of `size` elements from `number` counts: C(number + size - 1, size)."""
    return comb(number + size - 1, size)


@lru_cache(maxsize=4)
def products_of(counts: tuple[int, ...], size: int) -> ProductWindows:
    """Build the products of all multisets of `size` (1 to 5) of the counts, which must be ascending.

    Raise `RangeError` if the products are too large, or the tables would not fit in memory.
    """
    check_products(counts, size)
    numbers = np.array(counts, dtype=np.int64)
    # low and high parts of about equal size minimise the memory
    below = (size - 1) // 2
    rows, lows, table = _rows(numbers, below)
    if size - 1 - below < 2:
        # at most one count above: the counts themselves, from the middle one on, are the table
        uppers = _chosen(numbers, size - 1 - below)
        # the counts above begin at the middle count itself
        starts = table if size > 1 else np.zeros_like(table)
        highs = row_products(uppers)
        return ProductWindows(counts, size, rows, lows, highs, uppers, highs, 0 * rows, starts, counts[-1] + 1)
    # two counts above: a table of pairs for each middle count, and one ascending key for all tables
    tables = [_by_product(_chosen(numbers[at:], 2)) for at in range(len(counts))]
    sizes = np.array([len(part) for part in tables], dtype=np.int64)
    uppers = np.concatenate(tables)
    step = counts[-1] ** 2 + 1
    offsets = np.arange(len(counts)) * step
    highs = row_products(uppers)
    keys = highs + np.repeat(offsets, sizes)
    starts = (np.cumsum(sizes) - sizes)[table]
    return ProductWindows(counts, size, rows, lows, highs, uppers, keys, offsets[table], starts, step)


def _rows(numbers: Ints, below: int) -> tuple[Ints, Ints, Places]:
    """Return every combination of a number and a multiset of `below` numbers that do not exceed this number.

    The arrays contain the product, the counts, and the index of the number, with one row for each combination.
    """
    parts = [_by_product(_chosen(numbers[: at + 1], below)) for at in range(len(numbers))]
    table = np.repeat(np.arange(len(numbers)), [len(part) for part in parts])
    lows = np.concatenate([np.concatenate(parts), numbers[table][:, None]], axis=1)
    return row_products(lows), lows, table


def _by_product(chosen: Ints) -> Ints:
    return np.asarray(chosen[np.argsort(row_products(chosen), kind="stable")])


def _chosen(numbers: Ints, size: int) -> Ints:
    """Return all multisets of 0, 1 or 2 of the numbers, in ascending order within each, shape (multisets, size)."""
    if size == 0:
        return np.empty((1, 0), dtype=numbers.dtype)
    if size == 1:
        return numbers[:, None]
    i, j = np.triu_indices(len(numbers))
    return np.stack([numbers[i], numbers[j]], axis=1)


def row_products(chosen: Ints) -> Ints:
    """Return the product of the counts in each row, in the dtype of the counts."""
    found = np.ones(len(chosen), dtype=chosen.dtype)
    for column in chosen.T:
        found = found * column
    return found


def check_products(counts: tuple[int, ...], size: int) -> None:
    """Raise `RangeError` if the products of `products_of` are too large, or its tables would not fit in memory."""
    number, half = len(counts), (size + 1) // 2
    # length of the longest table; from four stages on it contains triples of counts
    rows = multisets(number, half) if size < 4 else multisets(number, 3)
    fix = "use a shorter range of counts, or fewer stages"
    if counts[-1] ** size >= _LARGEST:
        what = f"counts of up to {counts[-1]} teeth are too large for {size} stages"
        raise RangeError(Problem(what, "the products of the counts must be below 2^52", fix))
    if rows > _MOST_ROWS:
        what = f"{number} counts are too many for {size} stages"
        raise RangeError(Problem(what, "the tables would not fit in memory", fix))
