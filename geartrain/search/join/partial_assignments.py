"""Partial assignments of a join: for some items, which of their values each row has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Floats, Ints
from geartrain.search.join.product_lists import Item, Tallies

BLOCK = 1 << 18
"""Rows worked on at a time: bounds the memory of a join to some tens of megabytes, beside its lists."""


ItemMonomial = tuple[tuple[int, int], ...]
"""(item, power) pairs; powers of either sign, never 0."""


class PartialAssignments:
    """Rows over some items.

    columns   item -> index of its value, (size,)
    """

    __slots__ = ("_x", "columns", "items", "size")

    def __init__(self, items: Sequence[Item], columns: Mapping[int, Ints], size: int) -> None:
        self.items, self.columns, self.size = items, columns, size
        self._x: dict[int, Floats] = {}

    def x(self, item: int) -> Floats:
        """Values of an item, float64."""
        if item not in self._x:
            self._x[item] = self.items[item].x[self.columns[item]]
        return self._x[item]

    def top(self, item: int) -> Ints:
        """Numerators of an item's values."""
        return self.items[item].tops[self.columns[item]]

    def bottom(self, item: int) -> Ints | None:
        """Denominators of an item's values; None for 1."""
        bottoms = self.items[item].bottoms
        return None if bottoms is None else bottoms[self.columns[item]]

    def pick(self, where: NDArray[Any]) -> PartialAssignments:
        """Some rows, by mask or by index."""
        columns = {item: column[where] for item, column in self.columns.items()}
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return PartialAssignments(self.items, columns, size)

    def plus(self, parents: Ints, item: int, indices: Ints) -> PartialAssignments:
        """Rows grown out of these: `parents` says which, `indices` the value of one more item."""
        columns = {known: column[parents] for known, column in self.columns.items()}
        return PartialAssignments(self.items, {**columns, item: indices}, len(parents))

    def distinct(self, items: Sequence[int], seen: Sequence[ItemMonomial]) -> tuple[PartialAssignments, Ints | None]:
        """The distinct rows on some items, and for each row which of them it is; None for itself.

        seen   monomials of these items through which alone they are looked at: rows with the same values of all of
               them are one
        """
        if len(seen) == len(items) == len(self.columns):
            return self, None
        key, most = np.zeros(self.size, dtype=np.int64), 1
        for code, codes in (pair for monomial in seen for pair in self._codes(monomial)):
            if most * codes >= 1 << 62:  # renumbered, so that it never overflows
                _, key = np.unique(key, return_inverse=True)
                most = self.size
            key = key * codes + code
            most *= codes
        _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
        return PartialAssignments(self.items, {item: self.columns[item][first] for item in items}, len(first)), inverse

    def _codes(self, monomial: ItemMonomial) -> Iterator[tuple[Ints, int]]:
        """Whole numbers that tell the values of a monomial apart, and a bound on each of them."""
        if len(monomial) == 1:
            ((item, _),) = monomial
            yield self.columns[item], len(self.items[item])
            return
        above, below = np.ones(self.size, dtype=np.int64), np.ones(self.size, dtype=np.int64)
        for item, power in monomial:
            bottom = self.bottom(item)
            for _ in range(abs(power)):
                top, under = (above, below) if power > 0 else (below, above)
                top *= self.top(item)
                if bottom is not None:
                    under *= bottom
        # in lowest terms, so that 2/4 and 3/6 are one; with both sides in int64 that is exact
        common = np.gcd(above, below)
        for side in (above, below):
            values, code = np.unique(side // common, return_inverse=True)
            yield code, max(len(values), 1)

    def blocks(self, sizes: Tallies) -> Iterator[tuple[int, int]]:
        """Runs of rows whose `sizes` add up to about `BLOCK`; a row of more stands alone."""
        ends = np.cumsum(sizes)
        at = 0
        while at < self.size:
            done = ends[at - 1] if at else 0
            upto = max(int(np.searchsorted(ends, done + BLOCK, side="right")), at + 1)
            yield at, upto
            at = upto
