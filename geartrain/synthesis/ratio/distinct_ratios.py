"""The best ratios by their error alone: compared as values, made into counts only where they are shown."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.integer_columns import spread
from geartrain.synthesis.ratio.product_windows import expand
from geartrain.synthesis.ratio.ratio_windows import cuts, error_places, errors
from geartrain.synthesis.ratio.solution_order import Key, key_of, margin, merged

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.synthesis.ratio.product_windows import Range
    from geartrain.synthesis.ratio.stage_problem import StageProblem

    Ints = NDArray[Any]
    Span = tuple[Ints, Ints]

_MANY = 1 << 20  # pairs of products looked at together
_CLOSE = Fraction(1, 10**40)  # so near, only pairs of one and the same ratio are left


class ValueFinder:
    """Counts every solution by runs of equal products, and keeps the best by |error|, sum, largest and counts."""

    def __init__(self, question: StageProblem, hint: Fraction, bound: tuple[int, Fraction, int] | None) -> None:
        self.question, self.hint = question, hint
        self.most = (bound[1], bound[2]) if bound else None
        self.count = 0
        self.keys: list[Key] = []

    def result(self) -> dict[str, Any]:
        """Plain data: see `search_segments.search_segment`."""
        rows = [[0, list(key[4]), list(key[5])] for key in self.keys]
        return {"count": self.count, "removed": {}, "rows": rows}

    def look(self, beneath: Range, top: Range) -> None:
        """Consider all pairs of products of two ranges."""
        under, over = distinct(self.question.under.values(*beneath)), distinct(self.question.over.values(*top))
        low, high = self.question.edges
        whole = cuts(over[0], under[0], low, high)
        found = weight(under, over, whole)
        self.count += found
        if found:
            self._keep(*self._nearest(under, over, whole))

    def _nearest(self, under: Span, over: Span, whole: Span) -> tuple[Ints, Ints, Ints]:
        """Products on top, beneath, and sets that make them, of pairs among which the block's best are."""
        best, limit = self.question.best, self.question.tolerance
        if self.most:
            limit = min(limit, self.most[0])
        tolerance = min(self.hint, limit)
        span = self._span(under, over, whole, tolerance)
        # widened until the block's best are surely within
        while weight(under, over, span) < best and tolerance < limit:
            tolerance = min(8 * tolerance, limit)
            span = self._span(under, over, whole, tolerance)
        fewer = Fraction(0)
        while _pairs(span) > _MANY and tolerance - fewer > _CLOSE:
            # too wide a start: halve what lies between enough and too few
            middle = (tolerance + fewer) / 2
            inner = self._span(under, over, whole, middle)
            if weight(under, over, inner) < best:
                fewer = middle
            else:
                tolerance, span = middle, inner
        i, j = spread(*span)
        sets = (under[1][i + 1] - under[1][i]) * (over[1][j + 1] - over[1][j])
        return over[0][j], under[0][i], sets

    def _span(self, under: Span, over: Span, whole: Span, tolerance: Fraction) -> Span:
        """For each product beneath, the products on top within a narrower tolerance."""
        value, (low, high) = self.question.value, self.question.edges
        if tolerance >= self.question.tolerance:
            return whole
        low, high = max(low, value * (1 - tolerance)), min(high, value * (1 + tolerance))
        return cuts(over[0], under[0], low, high) if low <= high else (whole[0], whole[0])

    def _keep(self, over: Ints, under: Ints, sets: Ints) -> None:
        """Take the best of these pairs of products into the list."""
        value, size, best = self.question.value, self.question.stages, self.question.best
        error = np.abs(errors(over, under, value))
        order = np.argsort(error, kind="stable")
        last = int(np.searchsorted(np.cumsum(sets[order]), best))
        if last < len(order):
            order = np.flatnonzero(error <= margin(float(error[order[last]])))
        over, under = over[order], under[order]
        least = _least_sums(over, under, size)
        misses, place = error_places(over, under, value)
        fresh: list[Key] = []
        # nearest first, then by the least sum that is possible: from the first that is too late on, all are
        for at in np.lexsort((least, place)).tolist():
            miss, total = misses[place[at]], float(least[at])
            if self._too_late(miss, total):
                break
            if self.most and miss == self.most[0] and total > self.most[1]:
                continue
            beneaths = expand(int(under[at]), self.question.beneath, size)
            tops = expand(int(over[at]), self.question.top, size)
            fresh += [key_of(0, top, beneath, value) for top in tops for beneath in beneaths]
            if len(fresh) >= best:
                self.keys, fresh = merged([*self.keys, *fresh], best), []
        self.keys = merged([*self.keys, *fresh], best)

    def _too_late(self, miss: Fraction, total: float) -> bool:
        """True if neither this pair nor any after it can be among the best."""
        if self.most and miss > self.most[0]:
            return True
        if len(self.keys) < self.question.best:
            return False
        return (miss, total) > (self.keys[-1][1], self.keys[-1][2])


def distinct(values: Ints) -> Span:
    """The different ones of ascending values, (n,), and how many values stand before each and after all, (n + 1,)."""
    fresh = np.ones(len(values), dtype=bool)
    fresh[1:] = values[1:] != values[:-1]
    at = np.flatnonzero(fresh)
    return values[at], np.append(at, len(values))


def weight(under: Span, over: Span, span: Span) -> int:
    """Number of pairs of sets: for each product beneath, the sets of those on top in its span."""
    return int(((over[1][span[1]] - over[1][span[0]]) * (under[1][1:] - under[1][:-1])).sum())


def _pairs(span: Span) -> int:
    """Number of pairs of products."""
    return int((span[1] - span[0]).sum())


def _least_sums(over: Ints, under: Ints, size: int) -> Floats:
    """A lower bound of the sum of all counts: no sum is less than with equal counts."""
    root = 1.0 / size
    sums = size * (over.astype(np.float64) ** root + under.astype(np.float64) ** root)
    # less what roots are rounded by: a lower bound must not be too great
    return np.asarray(sums * (1 - 1e-12))
