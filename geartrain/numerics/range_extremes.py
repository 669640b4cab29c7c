"""Least and greatest entry of any run of a row that repeats itself: a sparse table, two look-ups a question.

Each level holds the extremes of runs of twice the length of those of the level before; any run is covered by two of
one level (Bender and Farach-Colton, "The LCA problem revisited", 2000).
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


class RangeExtremes:
    """Extremes of runs of cells, each with a least and a greatest value, (n,), the first following the last."""

    def __init__(self, least: Floats, most: Floats) -> None:
        self.count = len(least)
        self._first = least, most

    @cached_property
    def _levels(self) -> tuple[Floats, Floats]:
        """Extremes of the 2^k cells from each one on, (levels, n)."""
        least, most = [self._first[0]], [self._first[1]]
        length = 1
        while 2 * length <= self.count:
            least.append(np.minimum(least[-1], np.roll(least[-1], -length)))
            most.append(np.maximum(most[-1], np.roll(most[-1], -length)))
            length *= 2
        return np.stack(least), np.stack(most)

    def over(self, first: Ints, last: Ints) -> tuple[Floats, Floats]:
        """Least and greatest value over cells `first` to `last`, any whole numbers, first <= last."""
        length = np.clip(last - first + 1, 1, self.count)
        level = np.frexp(length)[1] - 1
        one, other = first % self.count, (first + length - (1 << level)) % self.count
        least, most = self._levels
        return (
            np.minimum(least[level, one], least[level, other]),
            np.maximum(most[level, one], most[level, other]),
        )
