"""Quotients of few added wheels within bounds: what dials with a tolerance leave to be added, for many at once."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.count_products import quotient_table

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

    def __init__(self, least: int, greatest: int) -> None:
        self.counts = least, greatest

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
