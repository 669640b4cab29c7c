"""Additive hashing of positive rationals, so that millions of quotients are looked up at once in sorted tables.

The key of a number is the sum of fixed random 64-bit words, one for each of its prime factors, modulo 2^64. Equal
numbers have equal keys. Different numbers have equal keys with probability 2^-64. Such a collision only lets the search
explore a branch without solutions, so no result depends on it.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache, cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from geartrain.search.reconstruct.added_counts import quotient_table

Keys = NDArray[np.uint64]

_WHOLE = 1 << 64  # keys are added modulo 2^64
_LONGEST = 3_000_000
"""Maximum number of quotients in a table. Larger tables are not built, and every number is then accepted."""


_SCARCE = 500
"""Number of keys below which a table of quotients of three wheels costs more than a direct test."""
_FEW = 2
"""Maximum number of added wheels whose quotients are all tabulated."""


class QuotientKeys:
    """Hash keys of numbers, and lookup tables of the keys of all quotients of products of added tooth counts.

    minimum, maximum   range of the tooth count of an added wheel
    """

    def __init__(self, minimum: int, maximum: int) -> None:
        self.minimum, self.maximum = minimum, maximum
        self._words: dict[int, int] = {}
        # fixed seed, so that a search is reproducible
        self._random = np.random.default_rng(0x6EA7)
        self._fewer: dict[int, Keys | None] = {}
        self._tables: dict[tuple[int, int], Keys | None] = {(0, 0): np.zeros(1, dtype=np.uint64)}

    def key(self, number: Fraction | int) -> int:
        """Return the hash key of a positive number."""
        ratio = Fraction(number)
        found = 0
        for part, sign in ((ratio.numerator, 1), (ratio.denominator, -1)):
            found += sign * sum(self._word(prime) * power for prime, power in prime_powers(part))
        return found % _WHOLE

    def _word(self, prime: int) -> int:
        if prime not in self._words:
            self._words[prime] = int(self._random.integers(1, _WHOLE, dtype=np.uint64))
        return self._words[prime]

    def may_be_quotients(self, keys: Keys, drivers: int, driven: int) -> NDArray[np.bool_]:
        """Return whether each key belongs to a product of `drivers` added counts divided by a product of `driven`
        added counts, without false negatives.
        """
        if drivers + driven == 3 and (drivers, driven) not in self._tables and len(keys) < _SCARCE:
            return self._one_by_one(keys, drivers, driven)
        table = self._table(drivers, driven)
        return np.ones(keys.shape, dtype=bool) if table is None else _are_in(table, keys)

    def _one_by_one(self, keys: Keys, drivers: int, driven: int) -> NDArray[np.bool_]:
        """Return the result of `may_be_quotients` by trying each count of one wheel, which is faster if there are few
        keys.
        """
        fewer = self._table(drivers - (drivers > driven), driven - (driven >= drivers))
        if fewer is None:
            return np.ones(keys.shape, dtype=bool)
        # the negative key, modulo 2^64, is the key of the reciprocal
        counts = self._counts if drivers > driven else -self._counts
        return np.asarray(_are_in(fewer, np.subtract.outer(keys, counts)).any(axis=-1))

    def need_few(self, keys: Keys, wheels: int) -> NDArray[np.bool_]:
        """Return whether each key belongs to a quotient of at most `wheels` added counts, without false negatives."""
        few = self.few(wheels) if wheels <= _FEW else None
        return np.ones(keys.shape, dtype=bool) if few is None else _are_in(few, keys)

    def fewest(self, keys: Keys, most: int) -> NDArray[np.int8]:
        """Return a lower bound, at most `most` + 1, of the number of added wheels for each quotient."""
        found = np.full(keys.shape, most + 1, dtype=np.int8)
        for wheels in range(most, -1, -1):
            found[self.need_few(keys, wheels)] = wheels
        return found

    def agreeing(self, keys: Keys, others: Keys, wheels: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Return for each key of each array whether it differs from a key of the other array by a quotient of at most
        `wheels` added counts, without false negatives.
        """
        if wheels < 0 or not len(keys) or not len(others):
            return np.zeros(keys.shape, dtype=bool), np.zeros(others.shape, dtype=bool)
        few = self.few(wheels) if wheels <= _FEW else None
        short, long = sorted((len(keys), len(others)))
        if few is None or short * min(len(few), long) > 2 * _LONGEST:
            return np.ones(keys.shape, dtype=bool), np.ones(others.shape, dtype=bool)
        if long <= len(few):
            pairs = _are_in(few, np.subtract.outer(keys, others))
            return np.asarray(pairs.any(axis=1)), np.asarray(pairs.any(axis=0))
        if len(keys) > len(others):
            more, some = self.agreeing(others, keys, wheels)
            return some, more
        reached = np.add.outer(keys, few)  # the set of quotients is closed under inversion
        return np.asarray(_are_in(_unique(others), reached).any(axis=1)), _are_in(_unique(reached), others)

    def few(self, wheels: int) -> Keys | None:
        """Return the sorted keys of all quotients of at most `wheels` added counts; None if there are too many."""
        if wheels not in self._fewer:
            tables = [self._table(drivers, n - drivers) for n in range(wheels + 1) for drivers in range(n + 1)]
            known = [table for table in tables if table is not None]
            self._fewer[wheels] = _unique(np.concatenate(known)) if len(known) == len(tables) else None
        return self._fewer[wheels]

    def _table(self, drivers: int, driven: int) -> Keys | None:
        key = drivers, driven
        if key not in self._tables:
            before = (drivers, driven - 1) if driven >= drivers else (drivers - 1, driven)
            known = self._table(*before)
            counts = self._counts if driven < drivers else -self._counts
            self._tables[key] = (
                None
                if known is None or len(known) * len(counts) > 4 * _LONGEST
                else _unique(np.add.outer(known, counts))
            )
        return self._tables[key]

    @cached_property
    def _counts(self) -> Keys:
        return np.array([self.key(count) for count in range(self.minimum, self.maximum + 1)], dtype=np.uint64)


def _unique(keys: Keys) -> Keys:
    """Return the sorted distinct keys. Sorting is ten times faster than the hash table of `numpy.unique`."""
    found = np.sort(keys, axis=None)
    return np.asarray(found[np.append(True, found[1:] != found[:-1])]) if len(found) else found


def _are_in(table: Keys, keys: Keys) -> NDArray[np.bool_]:
    if not len(table):
        return np.zeros(keys.shape, dtype=bool)
    at = np.searchsorted(table, keys)
    # any valid index will do, because a key beyond the table differs from all entries
    at[at == len(table)] = 0
    return np.asarray(table[at] == keys)


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


# Quotients of few added wheels within bounds, for many paths to dials with a tolerance at once.


Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Arrays of the minimum and the maximum of each quotient."""

_LISTED = 2
"""Maximum number of added wheels whose quotients are all tabulated."""
_WIDEST = 2000
"""Maximum number of possible tooth counts for which the quotients of two wheels are tabulated."""
_ROUNDING = 1e-12  # relative rounding error of a quotient


class QuotientRanges:
    """Sorted lookup tables, as floats, of all ratios of products of tooth counts that added wheels can have.

    minimum, maximum   range of the tooth count of an added wheel
    """

    def __init__(self, minimum: int, maximum: int) -> None:
        self.counts = minimum, maximum

    def may_hold(self, bounds: Bounds, drivers: int, driven: int) -> NDArray[np.bool_]:
        """Return whether each range contains a product of `drivers` added counts divided by a product of `driven`
        added counts, without false negatives.
        """
        if not self._is_listed(drivers + driven):
            return np.ones(bounds[0].shape, dtype=bool)
        return _contain_quotient(quotient_table(drivers, driven, self.counts).values, bounds)

    def fewest(self, bounds: Bounds) -> NDArray[np.int8]:
        """Return a lower bound, at most 3, of the number of added wheels with a quotient in each range."""
        found = np.full(bounds[0].shape, _LISTED + 1, dtype=np.int8)
        for wheels in range(_LISTED, -1, -1):
            held = _contain_quotient(self._few(wheels), bounds) if self._is_listed(wheels) else np.True_
            found = np.where(held, np.int8(wheels), found)
        return found

    def _is_listed(self, wheels: int) -> bool:
        return wheels <= 1 or (wheels <= _LISTED and self.counts[1] - self.counts[0] < _WIDEST)

    @cache  # noqa: B019 -- lives as long as the search
    def _few(self, wheels: int) -> NDArray[np.float64]:
        kinds = [(drivers, n - drivers) for n in range(wheels + 1) for drivers in range(n + 1)]
        return np.unique(np.concatenate([quotient_table(*kind, self.counts).values for kind in kinds]))


def _contain_quotient(table: NDArray[np.float64], bounds: Bounds) -> NDArray[np.bool_]:
    low, high = bounds
    first = np.searchsorted(table, low * (1 - _ROUNDING))
    return np.asarray(np.searchsorted(table, high * (1 + _ROUNDING), side="right") > first)
