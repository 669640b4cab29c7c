"""Solutions judged one by one, many at once: conditions on the counts, and orders other than by error."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.integer_columns import spread_in_blocks
from geartrain.synthesis.ratio.distinct_ratios import distinct, weight
from geartrain.synthesis.ratio.ratio_windows import cuts, errors
from geartrain.synthesis.ratio.solution_order import BestStages, RankedStages, first_of, margin
from geartrain.synthesis.ratio.stage_pairs import suited

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools
    from geartrain.synthesis.ratio.product_windows import Range
    from geartrain.synthesis.ratio.stage_pairs import FeasiblePairings
    from geartrain.synthesis.ratio.stage_problem import StageProblem

    Ints = NDArray[Any]

CHUNK = 1 << 16
"""Pairs looked at together."""


class RowFinder:
    """Looks at every pair of sets within the tolerance."""

    def __init__(self, question: StageProblem, bound: tuple[int, Fraction, int] | None) -> None:
        self.question = question
        self.loose = question.loose
        self.judge = StageFilter(question, (bound[0], margin(float(bound[1]))) if bound else None)
        self.count = 0

    def result(self) -> dict[str, Any]:
        """Plain data: see `search_segments.search_segment`."""
        found = self.judge.result()
        return {**found, "count": self.count} if self.loose else found

    def look(self, beneath: Range, top: Range) -> None:
        """Consider all pairs of sets with products in two ranges."""
        question, (low, high) = self.question, self.question.edges
        below, above = distinct(question.under.values(*beneath)), distinct(question.over.values(*top))
        span = cuts(above[0], below[0], low, high)
        self.count += weight(below, above, span)
        used = span[1] > span[0]
        if not used.any():
            return
        # products on top that some window holds: windows opened less windows closed so far
        opened, closed = (np.bincount(ends, minlength=len(above[0]) + 1) for ends in span)
        needed = np.cumsum(opened - closed)[:-1] > 0
        under = self._useful(sets_of(*question.under.members(*beneath, below[0][used])), question.top[0])
        over = self._useful(sets_of(*question.over.members(*top, above[0][needed])), question.beneath[0])
        if len(over.products) and len(under.products):
            first, last = cuts(over.products, under.products, low, high)
            for i, j in spread_in_blocks(first, np.maximum(first, last), CHUNK):
                self.judge.see(over, under, j, i)

    def _useful(self, sets: CountSets, least: int) -> CountSets:
        """Without the sets that can be in no solution better than what is there; only where every pair is one."""
        bound, by = self.judge.best.bound, self.question.by
        if not self.loose or bound is None or by not in ("total", "largest"):
            return sets
        first = sets.sums + self.question.stages * least if by == "total" else sets.largest
        return sets.taken(np.flatnonzero(first <= bound[0]))


@dataclass(frozen=True, slots=True)
class CountSets:
    """Unordered sets of counts on one side: products, counts (n, k), sums and largest of these."""

    products: Ints
    counts: Ints
    sums: Ints
    largest: Ints

    def taken(self, at: Ints) -> CountSets:
        """Some of them."""
        return CountSets(self.products[at], self.counts[at], self.sums[at], self.largest[at])


def sets_of(products: Ints, counts: Ints) -> CountSets:
    """Sets with these products and counts (ascending in each row)."""
    counts = counts.astype(np.int64)
    return CountSets(products, counts, counts.sum(axis=1), counts[:, -1])


class StageFilter:
    """Sorts pairs of sets within the tolerance into solutions and others, and keeps the best."""

    def __init__(self, question: StageProblem, bound: tuple[int, float] | None = None) -> None:
        self.question, self.fit = question, question.fit
        self.quick = question.loose and question.by in ("error", "total", "largest")
        self.best = BestStages(question.best, question.value, bound)
        self.removed: dict[str, int] = {}
        self.count = 0

    def result(self) -> dict[str, Any]:
        """Plain data: see `search_segments.search_segment`."""
        rows = self.best.rows()
        plain = zip(rows.first.tolist(), rows.top.tolist(), rows.beneath.tolist(), strict=True) if rows else ()
        return {"count": self.count, "removed": self.removed, "rows": [list(row) for row in plain]}

    def see(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> None:
        """Judge the pairs of set j on top and set i beneath."""
        bound = self.best.bound
        if self.quick and bound:
            # what is certainly not among the best needs no look at its counts
            self.count += len(j)
            near = np.flatnonzero(self._first(over, under, j, i) <= bound[0])
            self._rank(over, under, j[near], i[near], None)
        else:
            good, found = self._suits(over, under, j, i)
            self.count += len(good)
            self._rank(over, under, j[good], i[good], found)

    def _first(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> Ints:
        """What the order asks for, from sums and largest counts alone."""
        if self.question.by == "total":
            return np.asarray(over.sums[j] + under.sums[i])
        if self.question.by == "largest":
            return np.maximum(over.largest[j], under.largest[i])
        return np.zeros(len(j), dtype=np.int64)

    def _rank(self, over: CountSets, under: CountSets, j: Ints, i: Ints, found: FeasiblePairings | None) -> None:
        """Keep the best of these solutions."""
        top, beneath = over.counts[j], under.counts[i]
        first = first_of(self.question.by, top, beneath, self.fit, found)
        p, q = over.products[j], under.products[i]
        rows = RankedStages(top, beneath, p, q, first, np.abs(errors(p, q, self.question.value)))
        if self.best.bound:
            most, error = self.best.bound
            rows = rows.taken(np.flatnonzero((first < most) | ((first == most) & (rows.error <= error))))
        if len(rows):
            self.best.add(rows)

    def _suits(self, over: CountSets, under: CountSets, j: Ints, i: Ints) -> tuple[Ints, FeasiblePairings | None]:
        """Which pairs satisfy the fit, and what their pairings have; the others are counted by reason."""
        fit, at = self.fit, np.arange(len(j))
        top, beneath = over.counts[j], under.counts[i]
        if fit.different:
            # equal counts stand beside each other once they are sorted
            both = np.sort(np.concatenate([top, beneath], axis=1), axis=1)
            at = self._left(at, (both[:, 1:] != both[:, :-1]).all(axis=1), "a count that is there twice")
        if fit.totals_matter:
            total, (least, most) = top[at].sum(axis=1) + beneath[at].sum(axis=1), fit.totals
            at = self._left(at, (total >= least) & (total <= most), "a sum of counts out of bounds")
        by = self.question.by
        if not fit.pairs_matter and by not in ("hunting", "centres"):
            return at, None
        found = suited(top[at], beneath[at], fit, coprime=by == "hunting", centres=by == "centres")
        good = np.flatnonzero(found.possible)
        at = self._left(at, found.possible, pairing_reason(self.question))
        return at, found.taken(good)

    def _left(self, at: Ints, good: Bools, reason: str) -> Ints:
        """Those that are good; the others are charged to the reason."""
        gone = len(at) - int(good.sum())
        if gone:
            self.removed[reason] = self.removed.get(reason, 0) + gone
        return at[good]


def pairing_reason(question: StageProblem) -> str:
    """What no pairing of the sets has."""
    fit = question.fit
    asked = [
        *(["coprime counts in every stage"] if fit.hunting else []),
        *(["one centre distance"] if fit.reverted else []),
        *([f"a larger ring in {fit.internal} of the stages"] if fit.internal else []),
    ]
    return f"no pairing with {' and '.join(asked)}"
