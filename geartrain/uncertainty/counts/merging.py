"""Rows of a decomposition: states that differ in nothing a later output can see are one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.trains.bundles import Asked
from geartrain.synthesis.trains.items import Ints
from geartrain.uncertainty.counts.columns import Columns, Powers, find_monomials, product

_GOLDEN = 0x9E3779B97F4A7C15


@dataclass(frozen=True)
class State:
    """What is known after some wheels have their counts: the monomials that matter later, each row once.

    monomials       wheel -> power of each
    tops, bottoms   their values in lowest terms, (size,) each
    """

    monomials: tuple[Powers, ...]
    tops: tuple[Ints, ...]
    bottoms: tuple[Ints, ...]
    size: int

    @property
    def columns(self) -> Columns:
        """As a judge takes it."""
        return Columns(self.tops, self.bottoms, self.size)

    def grown(self, wheel: str, counts: Sequence[int], most: int) -> tuple[State, Ints, Ints]:
        """Every row with every count of one more wheel: the state, whose row, which count; at most so many rows."""
        if self.size * len(counts) > most:
            raise TooManyError
        parents = np.repeat(np.arange(self.size), len(counts))
        choices = np.tile(np.arange(len(counts)), self.size)
        tops = (*(top[parents] for top in self.tops), np.array(counts, dtype=np.int64)[choices])
        bottoms = (*(bottom[parents] for bottom in self.bottoms), np.ones(len(parents), dtype=np.int64))
        return State((*self.monomials, {wheel: 1}), tops, bottoms, len(parents)), parents, choices

    def merged(self, asked: Sequence[Asked], domains: Mapping[str, tuple[int, ...]]) -> tuple[State, Ints]:
        """The state seen through what is still asked, and for each row of this one its row there."""
        known = {wheel for powers in self.monomials for wheel in powers}
        kept = {wheel: counts for wheel, counts in domains.items() if wheel in known}
        monomials = find_monomials(asked, kept, self.monomials)
        made = [self._monomial(powers) for powers in monomials]
        first, rows = distinct([column for pair in made for column in pair], self.size)
        state = State(monomials, tuple(top[first] for top, _ in made), tuple(low[first] for _, low in made), len(first))
        return state, rows

    def kept(self, where: NDArray[np.bool_]) -> State:
        """Some of the rows."""
        tops, bottoms = (tuple(column[where] for column in each) for each in (self.tops, self.bottoms))
        return State(self.monomials, tops, bottoms, int(where.sum()))

    def _monomial(self, powers: Powers) -> tuple[Ints, Ints]:
        parts = []
        for at, own in enumerate(self.monomials):
            wheel, power = next(iter(own.items()))
            if wheel in powers:
                parts.append((self.tops[at], self.bottoms[at], powers[wheel] // power))
        top, bottom = product(parts, self.size)
        common = np.gcd(top, bottom)
        return top // common, bottom // common


EMPTY = State((), (), (), 1)


class TooManyError(Exception):
    """A decomposition passed its limit of rows."""


def distinct(columns: Sequence[Ints], size: int) -> tuple[Ints, Ints]:
    """Index of one row of each kind, and for each row its kind. Sorted by a hash, which is then checked to be one."""
    if not columns:
        return np.zeros(min(size, 1), dtype=np.int64), np.zeros(size, dtype=np.int64)
    seed = _GOLDEN
    while True:
        key = np.zeros(size, dtype=np.uint64)
        for column in columns:
            key = (key ^ (key >> np.uint64(29)) ^ column.view(np.uint64)) * np.uint64(seed)
        _, first, kinds = np.unique(key, return_index=True, return_inverse=True)
        if all(np.array_equal(column, column[first][kinds]) for column in columns):
            return first, kinds
        seed = (seed * _GOLDEN + 2) & (1 << 64) - 1 | 1
