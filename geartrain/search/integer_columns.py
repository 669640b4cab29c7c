"""Ranges of integers as arrays, at once or in blocks, distinct quotients of two arrays, and sums by owner."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Ints

Integers = NDArray[Any]
"""Array of int64, or of Python integers (dtype object) if values may exceed the range of int64."""


def spread(starts: Ints, ends: Ints) -> tuple[Ints, Ints]:
    """Return all integers of several half-open ranges [start, end) as two arrays: the index of the range of each
    integer, and the integers themselves. No end may be below its start.
    """
    sizes = ends - starts
    owner = np.repeat(np.arange(len(sizes)), sizes)
    # position in the output at which each range begins
    before = np.cumsum(sizes) - sizes
    return owner, np.arange(len(owner)) - np.repeat(before - starts, sizes)


def spread_in_blocks(starts: Ints, ends: Ints, most: int) -> Iterator[tuple[Ints, Ints]]:
    """Yield all integers of several half-open ranges, in blocks of at most `most` integers. Each block consists of the
    two arrays that `spread` returns.
    """
    upto = np.cumsum(ends - starts)
    total = int(upto[-1]) if len(upto) else 0
    for begin in range(0, total, most):
        stop = min(begin + most, total)
        # the ranges that include `begin` and `stop` - 1; empty ranges before them are skipped
        first, last = np.searchsorted(upto, begin, side="right"), np.searchsorted(upto, stop, side="left") + 1
        low, high = starts[first:last].copy(), ends[first:last].copy()
        # the block may include only a part of its first and last range
        low[0] = high[0] - (upto[first] - begin)
        high[-1] -= upto[last - 1] - stop
        owner, numbers = spread(low, high)
        yield owner + first, numbers


def distinct_quotients(above: Integers, below: Integers) -> tuple[list[Fraction], Ints]:
    """Return the list of the distinct values of the quotients above / below, and for each quotient the index of its
    value in this list. No element of `below` may be 0.
    """
    # numpy would convert a mixture of int64 and Python integers to float64
    if above.dtype != below.dtype:
        above, below = above.astype(object), below.astype(object)
    # in lowest terms with positive denominators, equal quotients are equal pairs
    common = np.gcd(above, below) * np.where(below < 0, -1, 1)
    above, below = above // common, below // common
    if above.dtype == object:  # lexsort does not support Python integers
        pairs = list(zip(above.tolist(), below.tolist(), strict=True))
        order = np.array(sorted(range(len(pairs)), key=pairs.__getitem__), dtype=np.int64)
    else:
        order = np.lexsort((below, above))
    above, below = above[order], below[order]
    fresh = np.ones(len(order), dtype=np.bool_)
    fresh[1:] = (above[1:] != above[:-1]) | (below[1:] != below[:-1])
    which = np.empty(len(order), dtype=np.int64)
    which[order] = np.cumsum(fresh) - 1
    return [Fraction(int(n), int(d)) for n, d in zip(above[fresh], below[fresh], strict=True)], which


def sums_by(owners: Ints, values: NDArray[Any], size: int) -> NDArray[Any]:
    """Return an array of shape (size,), whose entry i is the sum of all `values` for which the corresponding entry of
    `owners` is i. Python integers are added exactly.
    """
    found: NDArray[Any] = np.zeros(size, dtype=values.dtype)
    np.add.at(found, owners, values)
    return found
