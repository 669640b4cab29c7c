"""Search of one segment of the denominator products for the numerator products that match them.

`lay_out` divides a search into segments of about equal work. Segments are independent, their problems and results are
plain JSON data, and the division has no influence on the result.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, exp, isqrt, log
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.search.integer_columns import spread, spread_in_blocks
from geartrain.search.ratio.product_windows import ProductWindows, cuts, error_places, errors, expand, multisets
from geartrain.search.ratio.stage_problem import (
    BestStages,
    RankedStages,
    StageProblem,
    StageRank,
    first_of,
    key_of,
    margin,
    merged,
    stage_problem_of,
    suited,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.search.ratio.stage_problem import FeasiblePairings

    Ints = NDArray[Any]
    Span = tuple[Ints, Ints]


_BINS = 256  # number of bins of the histogram of logarithms of counts


@dataclass(frozen=True, slots=True)
class SegmentPlan:
    """Division of the denominator products into segments, and the density of pairs of multisets."""

    bounds: tuple[int, ...]
    """Bounds of the denominator products, ascending. Segment n is [bounds[n], bounds[n + 1])."""
    densest: int
    """Index of the segment with the most pairs near the requested ratio."""
    density: float
    """Estimated number of pairs of multisets per unit of absolute relative error, over all segments."""

    @property
    def segments(self) -> tuple[tuple[int, int], ...]:
        """First product and end (exclusive) of each segment."""
        return tuple(zip(self.bounds, self.bounds[1:], strict=False))

    def tolerance_for(self, number: float) -> Fraction:
        """Return an absolute relative error within which about `number` pairs of multisets are expected."""
        # without a density the search starts with a narrow tolerance, which is then widened
        return Fraction(number / self.density) if self.density * 1e18 > number else Fraction(1, 10**18)


def lay_out(question: StageProblem) -> SegmentPlan:
    """Divide the search into segments of about two blocks of products each, counting numerators and denominators."""
    size, value = question.stages, question.value
    spans = [log(counts[-1] / counts[0]) for counts in (question.top, question.beneath)]
    # a single count has a span of 0
    width = max(*spans, 1e-6) / _BINS
    over, under = (_spread(counts, size, width) for counts in (question.top, question.beneath))
    start = size * log(question.beneath[0])
    # offset between the bins of numerators and denominators with the requested ratio
    shift = (size * log(question.beneath[0] / question.top[0]) + log(value.numerator) - log(value.denominator)) / width
    at = np.arange(len(under))
    beside = np.interp(at + shift, np.arange(len(over)), over, left=0.0, right=0.0)
    used = np.flatnonzero((at + shift > -1) & (at + shift < len(over)))
    minimum, most = question.beneath[0] ** size, question.beneath[-1] ** size
    if not len(used):
        return SegmentPlan((minimum, most + 1), 0, 0.0)
    # the cost of a segment is the number of its products on both sides
    work = np.cumsum((under + beside)[used])
    number = max(ceil(work[-1] / (2 * block_of(question))), 1)
    places = np.searchsorted(work, work[-1] * np.arange(1, number) / number) + used[0] + 1
    middle = {min(max(ceil(exp(start + place * width)), minimum + 1), most) for place in places.tolist()}
    bounds = (minimum, *sorted(middle - {minimum}), most + 1)
    both = under * beside
    peak = ceil(exp(start + (int(both.argmax()) + 0.5) * width))
    densest = int(np.searchsorted(np.array(bounds[1:-1], dtype=np.float64), float(peak), side="right"))
    # factor 2: an absolute error includes both sides of the ratio
    return SegmentPlan(bounds, densest, float(2 * both.sum() / width))


def _spread(counts: tuple[int, ...], size: int, width: float) -> Floats:
    """Return a histogram of the multisets by the logarithm of their product, in bins of `width` from the minimum."""
    places = np.array([log(count / counts[0]) / width for count in counts])
    one = np.bincount(places.astype(np.int64)).astype(np.float64)
    found = np.ones(1)
    for _ in range(size):
        found = np.convolve(found, one)
    # the convolution counts sequences; scaled to the number of multisets
    return np.asarray(found * (multisets(len(counts), size) / found.sum()))


BLOCK = 1 << 21
"""Maximum number of products of one side in memory."""
PER_ROW = 3
"""Minimum number of products per row of the tables in a block, because each row costs a binary search."""
_FEW = 1000  # solutions that may be factored individually from their products

Range = tuple[int, int]


def task_of(
    question: StageProblem, low: int, high: int, hint: Fraction, bound: tuple[int, Fraction, int] | None = None
) -> dict[str, Any]:
    """Return the plain data of the search of one segment.

    low, high  range of the denominator products, half-open
    hint       a tolerance within which some of the best solutions are expected
    bound      rank value, absolute error and sum of a solution that is not better than the last one kept
    """
    plain = [bound[0], str(bound[1]), bound[2]] if bound else None
    return {"question": question.plain(), "low": low, "high": high, "hint": str(hint), "bound": plain}


def search_segment(task: Mapping[str, Any]) -> dict[str, Any]:
    """Count the solutions of a segment exactly, and return the best of them.

    The result has the keys `count`; `removed`, the number of pairs of multisets within the tolerance that are not
    solutions, by reason; and `rows`, the best as [rank value, numerator counts, denominator counts].
    """
    question = stage_problem_of(task["question"])
    plain = task["bound"]
    bound = (plain[0], Fraction(plain[1]), plain[2]) if plain else None
    by_value = listed_by_value(question)
    finder = ValueFinder(question, Fraction(task["hint"]), bound) if by_value else RowFinder(question, bound)
    for beneath, top in blocks(question, task["low"], task["high"]):
        finder.look(beneath, top)
    return finder.result()


def listed_by_value(question: StageProblem) -> bool:
    """Return whether solutions can be ranked by their products, without a test of each solution."""
    return question.by == "error" and question.loose and question.best <= _FEW


def block_of(question: StageProblem) -> int:
    """Return the maximum number of products of one side in a block: `BLOCK`, or more if the tables have many rows."""
    numbers = max(len(question.top), len(question.beneath))
    return max(BLOCK, PER_ROW * multisets(numbers, (question.stages + 1) // 2))


def blocks(question: StageProblem, low: int, high: int) -> Iterator[tuple[Range, Range]]:
    """Yield ranges of denominator and numerator products that cover every pair within the tolerance once."""
    if not question.reachable:
        return
    most = block_of(question)
    for beneath in pieces(question.under, *question.beneath_within(low, high), most):
        for top in pieces(question.over, *question.tops_for(*beneath), most):
            yield beneath, top


def pieces(products: ProductWindows, low: int, high: int, most: int) -> Iterator[Range]:
    """Split [low, high) into ascending ranges of at most `most` products each; empty ranges are omitted."""
    low, high = max(low, products.minimum), min(high, products.most + 1)
    number = products.below(high) - products.below(low) if low < high else 0
    if number > most and high - low > 1:
        # the geometric mean, because the logarithms of products are about uniform
        middle = min(max(isqrt(low * high), low + 1), high - 1)
        yield from pieces(products, low, middle, most)
        yield from pieces(products, middle, high, most)
    elif number:
        yield low, high


# The best ratios by error only: compared as values, and factored into counts only if listed.


_MANY = 1 << 20  # pairs of products in one vectorised step
_CLOSE = Fraction(1, 10**40)  # at this distance only pairs with the same ratio remain


class ValueFinder:
    """Search that counts solutions by runs of equal products and lists the best by error, sum and largest count."""

    def __init__(self, question: StageProblem, hint: Fraction, bound: tuple[int, Fraction, int] | None) -> None:
        self.question, self.hint = question, hint
        self.most = (bound[1], bound[2]) if bound else None
        self.count = 0
        self.keys: list[StageRank] = []

    def result(self) -> dict[str, Any]:
        """Return the result as plain data, in the format of `search_segment`."""
        rows = [[0, list(key[4]), list(key[5])] for key in self.keys]
        return {"count": self.count, "removed": {}, "rows": rows}

    def look(self, beneath: Range, top: Range) -> None:
        """Count and rank all pairs of denominator and numerator products in two ranges."""
        under, over = distinct(self.question.under.values(*beneath)), distinct(self.question.over.values(*top))
        low, high = self.question.edges
        whole = cuts(over[0], under[0], low, high)
        found = weight(under, over, whole)
        self.count += found
        if found:
            self._keep(*self._nearest(under, over, whole))

    def _nearest(self, under: Span, over: Span, whole: Span) -> tuple[Ints, Ints, Ints]:
        """Return pairs of products that include the best of the block.

        The arrays are numerator products, denominator products, and the number of pairs of multisets with these
        products.
        """
        best, limit = self.question.best, self.question.tolerance
        if self.most:
            limit = min(limit, self.most[0])
        tolerance = min(self.hint, limit)
        span = self._span(under, over, whole, tolerance)
        # widened until the best of the block are certainly within
        while weight(under, over, span) < best and tolerance < limit:
            tolerance = min(8 * tolerance, limit)
            span = self._span(under, over, whole, tolerance)
        fewer = Fraction(0)
        while _pairs(span) > _MANY and tolerance - fewer > _CLOSE:
            # the start was too wide: bisect between enough and too few
            middle = (tolerance + fewer) / 2
            inner = self._span(under, over, whole, middle)
            if weight(under, over, inner) < best:
                fewer = middle
            else:
                tolerance, span = middle, inner
        i, j = spread(*span)
        # multisets with these two products
        sets = (under[1][i + 1] - under[1][i]) * (over[1][j + 1] - over[1][j])
        return over[0][j], under[0][i], sets

    def _span(self, under: Span, over: Span, whole: Span, tolerance: Fraction) -> Span:
        """Return for each denominator product the index range of the numerator products within a narrower tolerance."""
        value, (low, high) = self.question.value, self.question.edges
        if tolerance >= self.question.tolerance:
            return whole
        low, high = max(low, value * (1 - tolerance)), min(high, value * (1 + tolerance))
        return cuts(over[0], under[0], low, high) if low <= high else (whole[0], whole[0])

    def _keep(self, over: Ints, under: Ints, sets: Ints) -> None:
        """Merge the best of these pairs of products into the list of solutions."""
        value, size, best = self.question.value, self.question.stages, self.question.best
        error = np.abs(errors(over, under, value))
        order = np.argsort(error, kind="stable")
        last = int(np.searchsorted(np.cumsum(sets[order]), best))
        if last < len(order):
            order = np.flatnonzero(error <= margin(float(error[order[last]])))
        over, under = over[order], under[order]
        minimum = _minimum_sums(over, under, size)
        misses, place = error_places(over, under, value)
        fresh: list[StageRank] = []
        # by error, then by the minimum possible sum: all after the first that is too late are too late
        for at in np.lexsort((minimum, place)).tolist():
            miss, total = misses[place[at]], float(minimum[at])
            if self._too_late(miss, total):
                break
            # as far away as the known bound, but with a larger sum
            if self.most and miss == self.most[0] and total > self.most[1]:
                continue
            beneaths = expand(int(under[at]), self.question.beneath, size)
            tops = expand(int(over[at]), self.question.top, size)
            fresh += [key_of(0, top, beneath, value) for top in tops for beneath in beneaths]
            # merged in batches, which limits the cost of sorting
            if len(fresh) >= best:
                self.keys, fresh = merged([*self.keys, *fresh], best), []
        self.keys = merged([*self.keys, *fresh], best)

    def _too_late(self, miss: Fraction, total: float) -> bool:
        """Return whether neither this pair nor any later one can be among the best."""
        if self.most and miss > self.most[0]:
            return True
        if len(self.keys) < self.question.best:
            return False
        return (miss, total) > (self.keys[-1][1], self.keys[-1][2])


def distinct(values: Ints) -> Span:
    """Return the distinct values of an ascending array, shape (n,), and the index of the first of each, shape (n + 1,).

    The last index is the length of the array.
    """
    fresh = np.ones(len(values), dtype=bool)
    fresh[1:] = values[1:] != values[:-1]
    at = np.flatnonzero(fresh)
    return values[at], np.append(at, len(values))


def weight(under: Span, over: Span, span: Span) -> int:
    """Count the pairs of multisets in which the numerator product is in the range of the denominator product."""
    return int(((over[1][span[1]] - over[1][span[0]]) * (under[1][1:] - under[1][:-1])).sum())


def _pairs(span: Span) -> int:
    return int((span[1] - span[0]).sum())


def _minimum_sums(over: Ints, under: Ints, size: int) -> Floats:
    """Return a lower bound of the sum of all counts from their products, by the AM-GM inequality."""
    root = 1.0 / size
    sums = size * (over.astype(np.float64) ** root + under.astype(np.float64) ** root)
    # reduced by the rounding error of the roots, because a lower bound must not be too large
    return np.asarray(sums * (1 - 1e-12))


# Individual tests of solutions, vectorised: constraints on the counts, and orders other than by error.


CHUNK = 1 << 16
"""Number of pairs processed in one vectorised step."""


class RowFinder:
    """Search that tests every pair of multisets within the tolerance."""

    def __init__(self, question: StageProblem, bound: tuple[int, Fraction, int] | None) -> None:
        self.question = question
        self.loose = question.loose
        self.judge = StageFilter(question, (bound[0], margin(float(bound[1]))) if bound else None)
        self.count = 0

    def result(self) -> dict[str, Any]:
        """Return the result as plain data, in the format of `search_segment`."""
        found = self.judge.result()
        return {**found, "count": self.count} if self.loose else found

    def look(self, beneath: Range, top: Range) -> None:
        """Test and rank all pairs of multisets with denominator and numerator products in two ranges."""
        question, (low, high) = self.question, self.question.edges
        below, above = distinct(question.under.values(*beneath)), distinct(question.over.values(*top))
        span = cuts(above[0], below[0], low, high)
        self.count += weight(below, above, span)
        # denominators with at least one numerator within the tolerance
        used = span[1] > span[0]
        if not used.any():
            return
        # numerator products within some window: number of windows opened minus number closed so far
        opened, closed = (np.bincount(ends, minlength=len(above[0]) + 1) for ends in span)
        needed = np.cumsum(opened - closed)[:-1] > 0
        under = self._prune(sets_of(*question.under.members(*beneath, below[0][used])), question.top[0])
        over = self._prune(sets_of(*question.over.members(*top, above[0][needed])), question.beneath[0])
        if len(over.products) and len(under.products):
            first, last = cuts(over.products, under.products, low, high)
            for i, j in spread_in_blocks(first, np.maximum(first, last), CHUNK):
                self.judge.see(over, under, j, i)

    def _prune(self, sets: CountSets, minimum: int) -> CountSets:
        """Remove multisets that cannot be part of a better solution than those listed, if every pair is a solution."""
        bound, by = self.judge.best.bound, self.question.by
        if not self.loose or bound is None or by not in ("total", "largest"):
            return sets
        first = sets.sums + self.question.stages * minimum if by == "total" else sets.largest
        return sets.taken(np.flatnonzero(first <= bound[0]))


@dataclass(frozen=True, slots=True)
class CountSets:
    """Multisets of counts of one side: products, shape (n,), counts, shape (n, k), sums and largest counts,
    shape (n,).
    """

    products: Ints
    counts: Ints
    sums: Ints
    largest: Ints

    def taken(self, at: Ints) -> CountSets:
        """Return the multisets at the given indices."""
        return CountSets(self.products[at], self.counts[at], self.sums[at], self.largest[at])


def sets_of(products: Ints, counts: Ints) -> CountSets:
    """Build multisets from their products and counts, which must be ascending in each row."""
    counts = counts.astype(np.int64)
    return CountSets(products, counts, counts.sum(axis=1), counts[:, -1])


class StageFilter:
    """Filter of pairs of multisets by the constraints. It counts the solutions and keeps the best."""

    def __init__(self, question: StageProblem, bound: tuple[int, float] | None = None) -> None:
        self.question, self.fit = question, question.fit
        self.quick = question.loose and question.by in ("error", "total", "largest")
        self.best = BestStages(question.best, question.value, bound)
        self.removed: dict[str, int] = {}
        self.count = 0

    def result(self) -> dict[str, Any]:
        """Return the result as plain data, in the format of `search_segment`."""
        rows = self.best.rows()
        plain = zip(rows.first.tolist(), rows.top.tolist(), rows.beneath.tolist(), strict=True) if rows else ()
        return {"count": self.count, "removed": self.removed, "rows": [list(row) for row in plain]}

    def see(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> None:
        """Test and rank the pairs of the numerator multisets with indices j and the denominator multisets with indices
        i.
        """
        bound = self.best.bound
        if self.quick and bound:
            # solutions that are certainly not among the best need no test of their counts
            self.count += len(j)
            near = np.flatnonzero(self._first(over, under, j, i) <= bound[0])
            self._rank(over, under, j[near], i[near], None)
        else:
            good, found = self._feasible(over, under, j, i)
            self.count += len(good)
            self._rank(over, under, j[good], i[good], found)

    def _first(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> Ints:
        """Return the primary sort criterion of each pair, computed only from sums and largest counts."""
        if self.question.by == "total":
            return np.asarray(over.sums[j] + under.sums[i])
        if self.question.by == "largest":
            return np.maximum(over.largest[j], under.largest[i])
        return np.zeros(len(j), dtype=np.int64)

    def _rank(self, over: CountSets, under: CountSets, j: Ints, i: Ints, found: FeasiblePairings | None) -> None:
        top, beneath = over.counts[j], under.counts[i]
        first = first_of(self.question.by, top, beneath, self.fit, found)
        p, q = over.products[j], under.products[i]
        rows = RankedStages(top, beneath, p, q, first, np.abs(errors(p, q, self.question.value)))
        if self.best.bound:
            most, error = self.best.bound
            rows = rows.taken(np.flatnonzero((first < most) | ((first == most) & (rows.error <= error))))
        if len(rows):
            self.best.add(rows)

    def _feasible(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> tuple[Ints, FeasiblePairings | None]:
        """Return the indices of the pairs that satisfy the constraints, and their pairings; count the others by
        reason.
        """
        fit, at = self.fit, np.arange(len(j))
        top, beneath = over.counts[j], under.counts[i]
        if fit.different:
            # equal counts are neighbours after sorting
            both = np.sort(np.concatenate([top, beneath], axis=1), axis=1)
            at = self._filter(at, (both[:, 1:] != both[:, :-1]).all(axis=1), "repeated count")
        if fit.totals_matter:
            total, (minimum, most) = top[at].sum(axis=1) + beneath[at].sum(axis=1), fit.totals
            at = self._filter(at, (total >= minimum) & (total <= most), "sum of counts out of bounds")
        by = self.question.by
        if not fit.pairs_matter and by not in ("hunting", "centres"):
            return at, None
        found = suited(top[at], beneath[at], fit, coprime=by == "hunting", centres=by == "centres")
        good = np.flatnonzero(found.possible)
        at = self._filter(at, found.possible, pairing_reason(self.question))
        return at, found.taken(good)

    def _filter(self, at: Ints, good: Bools, reason: str) -> Ints:
        """Return the indices for which `good` is true, and count the others under the reason."""
        gone = len(at) - int(good.sum())
        if gone:
            self.removed[reason] = self.removed.get(reason, 0) + gone
        return at[good]


def pairing_reason(question: StageProblem) -> str:
    """Return as text why pairs of multisets without a feasible pairing to stages are rejected."""
    fit = question.fit
    requested = [
        *(["coprime counts in every stage"] if fit.hunting else []),
        *(["equal centre distances"] if fit.reverted else []),
        *([f"a ring larger than its pinion in {fit.internal} of the stages"] if fit.internal else []),
    ]
    return f"no pairing with {' and '.join(requested)}"
