"""Additive hashing of positive rationals: sets of millions of quotients are looked up at once in sorted tables.

The key of a number is the sum of fixed random 64-bit words, one for each of its primes, modulo 2^64. Equal numbers have
equal keys. Two different ones have the same key with a chance of 2^-64; then a part of a train is looked into that
explains nothing, so that no answer depends on it.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache, cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from geartrain.search.reconstruct.added_counts import quotient_table

Keys = NDArray[np.uint64]

_WHOLE = 1 << 64
_LONGEST = 3_000_000
"""Quotients in a table; where there would be more, every number is taken for one."""


_SCARCE = 500
"""Keys for which a table of quotients of three wheels is not worth being made."""
_FEW = 2
"""Added wheels whose quotients are all listed."""


class QuotientKeys:
    """Keys of numbers, and of all quotients of products of added wheels' counts.

    least, greatest   counts of an added wheel
    """

    def __init__(self, minimum: int, maximum: int) -> None:
        self.minimum, self.maximum = minimum, maximum
        self._words: dict[int, int] = {}
        self._random = np.random.default_rng(0x6EA7)
        self._fewer: dict[int, Keys | None] = {}
        self._tables: dict[tuple[int, int], Keys | None] = {(0, 0): np.zeros(1, dtype=np.uint64)}

    def key(self, number: Fraction | int) -> int:
        """The key of a positive number."""
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
        """Which keys are those of quotients of so many drivers over so many driven wheels; never wrongly False."""
        if drivers + driven == 3 and (drivers, driven) not in self._tables and len(keys) < _SCARCE:
            return self._one_by_one(keys, drivers, driven)
        table = self._table(drivers, driven)
        return np.ones(keys.shape, dtype=bool) if table is None else _are_in(table, keys)

    def _one_by_one(self, keys: Keys, drivers: int, driven: int) -> NDArray[np.bool_]:
        """The same, by trying each count of one wheel: quicker for few keys than a long table."""
        fewer = self._table(drivers - (drivers > driven), driven - (driven >= drivers))
        if fewer is None:
            return np.ones(keys.shape, dtype=bool)
        counts = self._counts if drivers > driven else -self._counts
        return np.asarray(_are_in(fewer, np.subtract.outer(keys, counts)).any(axis=-1))

    def need_few(self, keys: Keys, wheels: int) -> NDArray[np.bool_]:
        """Which keys are those of quotients that so many added wheels or fewer make; never wrongly False."""
        few = self.few(wheels) if wheels <= _FEW else None
        return np.ones(keys.shape, dtype=bool) if few is None else _are_in(few, keys)

    def fewest(self, keys: Keys, most: int) -> NDArray[np.int8]:
        """How few added wheels make each quotient: `most` + 1 where more are needed; never too many."""
        found = np.full(keys.shape, most + 1, dtype=np.int8)
        for wheels in range(most, -1, -1):
            found[self.need_few(keys, wheels)] = wheels
        return found

    def agreeing(self, keys: Keys, others: Keys, wheels: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which keys have a partner among others to which their quotient needs so many added wheels or fewer."""
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
        reached = np.add.outer(keys, few)  # with a quotient its inverse is one
        return np.asarray(_are_in(_unique(others), reached).any(axis=1)), _are_in(_unique(reached), others)

    def few(self, wheels: int) -> Keys | None:
        """Keys of all quotients of so many wheels or fewer; None where there are too many."""
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
    """Each key once, sorted: by hashes, as NumPy does, it takes ten times as long."""
    found = np.sort(keys, axis=None)
    return np.asarray(found[np.append(True, found[1:] != found[:-1])]) if len(found) else found


def _are_in(table: Keys, keys: Keys) -> NDArray[np.bool_]:
    if not len(table):
        return np.zeros(keys.shape, dtype=bool)
    at = np.searchsorted(table, keys)
    at[at == len(table)] = 0
    return np.asarray(table[at] == keys)


@lru_cache(maxsize=1 << 16)
def prime_powers(number: int) -> tuple[tuple[int, int], ...]:
    """Primes of a number from 1 on with their powers; what no prime below 10 000 divides is taken for one prime."""
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


# Quotients of few added wheels within bounds: what dials with a tolerance leave to be added, for many at once.


Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Least and greatest of quotients, an entry each."""

_LISTED = 2
"""Added wheels up to which all quotients are listed."""
_WIDEST = 2000
"""Counts of an added wheel up to which quotients of two are."""
_ROUNDING = 1e-12  # of a quotient: what floats may be off


class QuotientRanges:
    """All quotients of products of added wheels' counts, as floats.

    least, greatest   counts of an added wheel
    """

    def __init__(self, minimum: int, maximum: int) -> None:
        self.counts = minimum, maximum

    def may_hold(self, bounds: Bounds, drivers: int, driven: int) -> NDArray[np.bool_]:
        """Which bounds hold a quotient of so many drivers over so many driven wheels; never wrongly False."""
        if not self._is_listed(drivers + driven):
            return np.ones(bounds[0].shape, dtype=bool)
        return _are_held(quotient_table(drivers, driven, self.counts).values, bounds)

    def fewest(self, bounds: Bounds) -> NDArray[np.int8]:
        """How few added wheels make a quotient within each bounds: 3 where more than 2 are needed; never too many."""
        found = np.full(bounds[0].shape, _LISTED + 1, dtype=np.int8)
        for wheels in range(_LISTED, -1, -1):
            held = _are_held(self._few(wheels), bounds) if self._is_listed(wheels) else np.True_
            found = np.where(held, np.int8(wheels), found)
        return found

    def _is_listed(self, wheels: int) -> bool:
        return wheels <= 1 or (wheels <= _LISTED and self.counts[1] - self.counts[0] < _WIDEST)

    @cache  # noqa: B019 -- lives as long as the search
    def _few(self, wheels: int) -> NDArray[np.float64]:
        kinds = [(drivers, n - drivers) for n in range(wheels + 1) for drivers in range(n + 1)]
        return np.unique(np.concatenate([quotient_table(*kind, self.counts).values for kind in kinds]))


def _are_held(table: NDArray[np.float64], bounds: Bounds) -> NDArray[np.bool_]:
    low, high = bounds
    first = np.searchsorted(table, low * (1 - _ROUNDING))
    return np.asarray(np.searchsorted(table, high * (1 + _ROUNDING), side="right") > first)
