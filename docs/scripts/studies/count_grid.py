"""All combinations of tooth counts in order, in runs that share what the outer wheels multiply."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import cached_property
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Floats, Ints
from geartrain.search.posterior.sampled_posterior import (
    BLOCK,
    CombinationColumns,
    LikelihoodBatch,
    MonomialColumns,
    Powers,
)


class ScaledColumns(MonomialColumns):
    """Rows that are others, every item multiplied by a number of its own.

    rows   the others
    by     one row with the numbers
    """

    __slots__ = ("_by", "_rows")

    def __init__(self, rows: MonomialColumns, by: MonomialColumns) -> None:
        super().__init__((), (), rows.size)
        self._rows, self._by = rows, by

    def x(self, item: int) -> Floats:
        """Values of an item: the roundings of both, and one."""
        if item not in self._x:
            self._x[item] = self._rows.x(item) * self._by.x(item)
        return self._x[item]

    def top(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._rows.top(item) * self._by.top(item)

    def bottom(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._rows.bottom(item) * self._by.bottom(item)

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """As of `MonomialColumns`."""
        return ScaledColumns(self._rows.pick(where), self._by)


class CombinationGrid:
    """All combinations of a batch, numbered: the first wheels turn slowest, as digits of a number.

    A run of neighbours shares the counts of the outer wheels, so only the inner ones are multiplied out, once.
    """

    def __init__(self, batch: LikelihoodBatch) -> None:
        self.batch = batch
        sizes = [len(batch.domains[wheel]) for wheel in batch.wheels]
        split, inner = len(sizes), 1
        while split and inner * sizes[split - 1] <= BLOCK:
            split -= 1
            inner *= sizes[split]
        self.outer, self.inner = batch.wheels[:split], batch.wheels[split:]
        self.block = inner
        self.runs = prod(sizes[:split])

    @cached_property
    def digits(self) -> dict[str, Ints]:
        """Inner wheel -> index of its count, for one run."""
        return _digits(np.arange(self.block), self._sizes(self.inner))

    @cached_property
    def _table(self) -> MonomialColumns:
        counts = {wheel: np.array(self.batch.domains[wheel])[at] for wheel, at in self.digits.items()}
        return CombinationColumns(self._parts(self.inner), counts, self.block)

    def _parts(self, wheels: Collection[str]) -> list[Powers]:
        """The monomials as far as some wheels go."""
        return [{w: p for w, p in powers.items() if w in wheels} for powers in self.batch.monomials]

    def runs_from(self, start: int, stop: int) -> Iterator[tuple[dict[str, int], MonomialColumns]]:
        """Runs by number: the indices of the outer wheels' counts, and the rows."""
        parts, sizes = self._parts(self.outer), self._sizes(self.outer)
        for run in range(start, stop):
            at = _digits(run, sizes)
            counts = {wheel: np.array([self.batch.domains[wheel][int(index)]]) for wheel, index in at.items()}
            yield (
                {wheel: int(index) for wheel, index in at.items()},
                ScaledColumns(self._table, CombinationColumns(parts, counts, 1)),
            )

    def _sizes(self, wheels: tuple[str, ...]) -> dict[str, int]:
        return {wheel: len(self.batch.domains[wheel]) for wheel in wheels}


def _digits(number: Any, sizes: Mapping[str, int]) -> dict[str, Any]:
    """The digits of a number, or of an array of them, whose places have these sizes, the last one least."""
    found: dict[str, Any] = {}
    rest = number
    for wheel in reversed(tuple(sizes)):
        rest, found[wheel] = divmod(rest, sizes[wheel])
    return {wheel: found[wheel] for wheel in sizes}
