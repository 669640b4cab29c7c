"""Sorted tables of the quotients of few added tooth counts, in which millions of quotients are looked up at once.

Quotients are floats, and agree if they differ by less than their rounding error. Quotients that only seem to agree
let the search explore a branch without solutions. No result depends on them, because counts are exact.
"""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Bools, Floats

Bounds = tuple[Floats, Floats]
"""Arrays of the minimum and the maximum of each quotient, equal if the quotient is exact."""

_FEW = 2
"""Maximum number of added wheels whose quotients are all tabulated."""
_LONGEST = 12_000_000
"""Maximum number of quotients in a table. Larger tables are not built, and every number is then accepted."""
ROUNDING = 1e-12
"""Relative rounding error of a quotient."""


class QuotientTables:
    """Sorted tables of all quotients of products of tooth counts that added wheels can have.

    minimum, maximum   range of the tooth count of an added wheel
    """

    def __init__(self, minimum: int, maximum: int) -> None:
        self._counts = np.arange(minimum, maximum + 1, dtype=np.float64)

    def may_hold(self, bounds: Bounds, drivers: int, driven: int) -> Bools:
        """Return whether each range contains a product of `drivers` added counts divided by a product of `driven`
        added counts, without false negatives.
        """
        return _contain(self._table(drivers, driven), bounds)

    def fewest(self, bounds: Bounds) -> NDArray[np.int8]:
        """Return a lower bound, at most `_FEW` + 1, of the number of added wheels with a quotient in each range."""
        found = np.full(bounds[0].shape, _FEW + 1, dtype=np.int8)
        for wheels in range(_FEW, -1, -1):
            found[_contain(self._few(wheels), bounds)] = wheels
        return found

    @cache  # noqa: B019 -- lives as long as the search
    def _few(self, wheels: int) -> Floats | None:
        """Return all quotients of products of at most `wheels` added counts; None if there are too many."""
        tables = [self._table(drivers, n - drivers) for n in range(wheels + 1) for drivers in range(n + 1)]
        known = [table for table in tables if table is not None]
        return _distinct(np.concatenate(known)) if len(known) == len(tables) else None

    @cache  # noqa: B019 -- lives as long as the search
    def _table(self, drivers: int, driven: int) -> Floats | None:
        if driven:
            above, below = self._table(drivers, 0), self._table(driven, 0)
            if above is None or below is None or len(above) * len(below) > _LONGEST:
                return None
            # products below 2^53 are exact floats, so equal quotients are rounded to equal floats
            return _distinct(np.divide.outer(above, below))
        if not drivers:
            return np.ones(1)
        before = self._table(drivers - 1, 0)
        if before is None or len(before) * len(self._counts) > _LONGEST:
            return None
        return _distinct(np.multiply.outer(before, self._counts))


def _distinct(numbers: Floats) -> Floats:
    """Return the sorted distinct numbers. Sorting is ten times faster than the hash table of `numpy.unique`."""
    found = np.sort(numbers, axis=None)
    return np.asarray(found[np.append(True, found[1:] != found[:-1])])


def _contain(table: Floats | None, bounds: Bounds) -> Bools:
    """Return whether each range contains an entry of a table; True for all ranges if there is no table."""
    low, high = bounds
    if table is None:
        return np.ones(low.shape, dtype=bool)
    # if any entry is in the range, the first entry that is not below it is
    at = np.searchsorted(table, low * (1 - ROUNDING))
    at[at == len(table)] = 0  # the smallest entry is then below the range
    return np.asarray((table[at] >= low * (1 - ROUNDING)) & (table[at] <= high * (1 + ROUNDING)))


@lru_cache(maxsize=1 << 16)
def prime_powers(number: int) -> tuple[tuple[int, int], ...]:
    """Return the prime factorisation of a positive integer by trial division, as pairs (prime, power).

    A remainder without a prime factor below 10 000 is treated as prime.
    """
    found, prime = [], 2
    while prime * prime <= number and prime < 10_000:
        power = 0
        while number % prime == 0:
            number //= prime
            power += 1
        if power:
            found.append((prime, power))
        prime += 1
    if number > 1:
        found.append((number, 1))
    return tuple(found)
