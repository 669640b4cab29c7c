"""Products of tooth counts over all multisets of a given size, generated for intervals (windows) of their value with
bounded memory.
"""

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
    from geartrain.numerics.arrays import Bools, Ints

MOST_STAGES = 5
_LARGEST = 1 << 52
"""Upper limit of products. Integers below this limit are represented exactly in float64."""
_MOST_ROWS = 12 * 10**6  # maximum number of rows of the tables in memory


def cuts(products: Ints, factors: Ints, low: Fraction, high: Fraction) -> tuple[Ints, Ints]:
    """Return, for each factor f, the half-open index range of the `products` with low f <= product <= high f, by exact
    comparison.

    products   integers in ascending order, at least one
    factors    positive integers below 2^52
    low, high  bounds with 0 <= low <= high
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


def _floors(factors: Ints, edge: Fraction, cap: int) -> tuple[Ints, Bools]:
    """Return, for each factor, floor(factor x edge), limited to `cap`, and whether factor x edge is an integer.

    The remainder factor n - floor d, with edge = n/d, is computed modulo 2^64. Since d is below 2^52, and the float64
    estimate of the floor differs from it by at most 3, the remainder is less than 2^63 and therefore exact.
    """
    n, d = edge.numerator, edge.denominator
    near = factors * float(edge)
    found = np.minimum(near, cap).astype(np.int64)
    # n modulo 2^64, as a signed int64
    wrapped = np.int64((n + (1 << 63)) % (1 << 64) - (1 << 63))
    rest = factors * wrapped - found * d
    more = rest // d
    beyond = near > cap
    return np.where(beyond, cap, found + more), (rest == more * d) & ~beyond


def error_ranks(tops: Ints, beneaths: Ints, value: Fraction) -> Ints:
    """Return, for each ratio tops / beneaths, the rank of its absolute error with respect to `value`, by exact
    comparison. The smallest error has the rank 0, and equal errors have equal ranks.
    """
    ratios, which = distinct_quotients(tops, beneaths)
    misses = [abs(ratio / value - 1) for ratio in ratios]
    places = {miss: at for at, miss in enumerate(sorted(set(misses)))}
    return np.array([places[miss] for miss in misses], dtype=np.int64)[which]


def rounded_up(bound: float | Fraction) -> Fraction:
    """Round a bound up to three or four significant digits, so that it can be printed as a tolerance."""
    exact = Fraction(bound)
    if exact <= 0:
        return Fraction(0)
    power = count_digits(exact.numerator) - count_digits(exact.denominator) - 3
    unit = Fraction(10) ** power
    return -(-exact // unit) * unit


@dataclass(frozen=True, slots=True, eq=False)
class ProductWindows:
    """Products c_1 c_2 ... c_k of admissible tooth counts c_1 <= ... <= c_k, each stored as a lower partial product
    times an upper partial product.

    The sorted tooth counts are split at their middle element m. A lower partial product contains m and the tooth counts
    before it. It is combined with every upper partial product whose tooth counts are all at least m, so each multiset
    occurs once. Memory is O(n^3) for n admissible counts. The C(n+k-1, k) products are generated only for requested
    intervals of their value.
    """

    counts: tuple[int, ...]
    """Admissible tooth counts, in ascending order."""
    size: int
    """Number k of tooth counts in a product."""
    rows: Ints
    """Lower partial products, shape (rows,)."""
    lows: Ints
    """Tooth counts of each lower partial product, in ascending order, shape (rows, a), where a is the number of tooth
    counts in a lower partial product.
    """
    highs: Ints
    """Partial products of the upper part of the tooth counts, in ascending order within each table, shape (highs,)."""
    uppers: Ints
    """Tooth counts of each upper partial product, in ascending order, shape (highs, b), where b is the number of tooth
    counts in an upper partial product.
    """
    keys: Ints
    """Sum of each upper partial product and the offset of its table, shape (highs,). The sums are in ascending order
    over all tables.
    """
    offsets: Ints
    """Offset of the table of upper partial products with which each lower partial product is combined, shape
    (rows,).
    """
    starts: Ints
    """Index of the first upper partial product with which each lower partial product is combined, shape (rows,)."""
    step: int
    """Difference between consecutive offsets, larger than every upper partial product."""

    def below(self, bound: int) -> int:
        """Return the exact number of multisets of tooth counts with a product less than `bound`."""
        return int((_ends(self, bound) - self.starts).sum())

    def values(self, low: int, high: int) -> tuple[Ints, Ints]:
        """Return the n distinct products in [low, high) in ascending order, shape (n,), and cumulative numbers of
        multisets, shape (n + 1,). Entry i is the number of multisets in this interval with a product below product i,
        and the last entry is their total number.
        """
        row, column = spread(_ends(self, low), _ends(self, high))
        found = self.rows[row]
        # in place, because a window is the largest array of the search
        found *= self.highs[column]
        found.sort()
        starts = np.flatnonzero(np.append(True, found[1:] != found[:-1]))
        return found[starts], np.append(starts, len(found))

    def members(self, low: int, high: int, among: Ints) -> tuple[Ints, Ints]:
        """Return the products in [low, high) that occur in `among`, and their tooth counts. There is one row for each
        of n multisets, in ascending order of the product: arrays of shape (n,) and (n, size). `among` must be ascending
        and not empty.
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
def _ends(products: ProductWindows, bound: int) -> Ints:
    """Return, for each lower partial product in `products.rows`, the number of upper partial products in
    `products.highs` up to the last one whose product with it is below `bound`, shape (rows,).
    """
    # one binary search for all tables: the offset of a row selects its table
    most = np.minimum((bound - 1) // products.rows, products.step - 1) + products.offsets
    return np.asarray(np.maximum(np.searchsorted(products.keys, most, side="right"), products.starts), dtype=np.int64)


def multisets(number: int, size: int) -> int:
    """Return the number of multisets of `size` elements chosen from `number` different tooth counts: C(number + size -
    1, size).
    """
    return comb(number + size - 1, size)


@lru_cache(maxsize=4)
def products_of(counts: tuple[int, ...], size: int) -> ProductWindows:
    """Return the products of all multisets of `size` tooth counts. `counts` must be ascending, and `size` must be from
    1 to 5.

    `RangeError` is raised if the products are too large, or if the tables would not fit in memory.
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


def _rows(numbers: Ints, below: int) -> tuple[Ints, Ints, Ints]:
    """Return every combination of one number, the largest, with `below` further numbers that do not exceed it. Numbers
    may be repeated.

    The three arrays have one row for each combination. They contain the product of all numbers, the numbers in
    ascending order, and the index of the largest number.
    """
    parts = [_by_product(_chosen(numbers[: at + 1], below)) for at in range(len(numbers))]
    table = np.repeat(np.arange(len(numbers)), [len(part) for part in parts])
    lows = np.concatenate([np.concatenate(parts), numbers[table][:, None]], axis=1)
    return row_products(lows), lows, table


def _by_product(chosen: Ints) -> Ints:
    return np.asarray(chosen[np.argsort(row_products(chosen), kind="stable")])


def _chosen(numbers: Ints, size: int) -> Ints:
    """Return all multisets of `size` numbers, where `size` is 0, 1 or 2; each row is in ascending order, shape
    (multisets, size).
    """
    if size == 0:
        return np.empty((1, 0), dtype=numbers.dtype)
    if size == 1:
        return numbers[:, None]
    i, j = np.triu_indices(len(numbers))
    return np.stack([numbers[i], numbers[j]], axis=1)


def row_products(chosen: Ints) -> Ints:
    """Return the product of the tooth counts in each row, in the dtype of the tooth counts."""
    found = np.ones(len(chosen), dtype=chosen.dtype)
    for column in chosen.T:
        found = found * column
    return found


def check_products(counts: tuple[int, ...], size: int) -> None:
    """Raise `RangeError` if the products of `products_of` would be too large, or if its tables would not fit in
    memory.
    """
    number, half = len(counts), (size + 1) // 2
    # length of the longest table; from four stages on it contains triples of counts
    rows = multisets(number, half) if size < 4 else multisets(number, 3)
    fix = "use a shorter range of counts, or fewer stages"
    if counts[-1] ** size >= _LARGEST:
        what = f"counts of up to {counts[-1]} teeth are too large for {size} stages"
        raise RangeError(Problem(what, "the products of the counts must be below 2^52", fix))
    if rows > _MOST_ROWS:
        what = f"{number} counts are too many for {size} stages"
        raise RangeError(Problem(what, "the tables of products of counts would not fit in memory", fix))
