"""Search for numerator products that match denominator products, segment by segment.

Segments are independent, and their results are plain JSON data. The division into segments does not influence the
result.
"""

from __future__ import annotations

import pickle
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import combinations_with_replacement
from math import ceil, comb, factorial, floor, isqrt, log
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.work import Execution
from geartrain.search.integer_columns import spread_in_blocks
from geartrain.search.ratio.product_windows import (
    ProductWindows,
    cuts,
    error_ranks,
    multisets,
    rounded_up,
    row_products,
)
from geartrain.search.ratio.stage_problem import (
    StageProblem,
    StageRank,
    first_of,
    key_of,
    pairings,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Ints = NDArray[Any]

BLOCK = 1 << 21
"""Maximum number of denominator products, and of numerator products, in a segment, which limits the memory."""
PER_ROW = 3
"""Minimum number of products in a segment per row of the tables. Each row requires a binary search, whatever the number
of products.
"""
CHUNK = 1 << 19
"""Number of pairings that are processed in one vectorised step."""
_WIDER = 16  # factor between tolerances; all passes before the last then cost little
_ENOUGH = 2 * 10**9
"""Number of tested pairs of multisets at which a search without a given tolerance stops increasing its tolerance."""
_SLACK = 1e-12  # relative margin of float comparisons
_MARGIN = 1e-14  # relative bound of the rounding error of a ratio
_MOST = 1e11
"""Maximum number of pairs of multisets that may be tested one by one."""

Range = tuple[int, int]


def search_segment(packed: bytes, segment: Sequence[int]) -> dict[str, Any]:
    """Count the solutions of a segment exactly, and return the count and the best solutions.

    packed    pickled search problem, and the tolerance within which solutions are listed
    segment   half-open ranges of the denominator products and of the numerator products (four numbers), or, if all
              stages have equal sums of tooth counts, the half-open range of these sums (two numbers)

    The result has the keys `count`; `listed`, the number of solutions within the tolerance of the list; `removed`, the
    number of pairs of multisets within the tolerance that were rejected for each reason; and `rows`, the best solutions
    as [primary criterion, numerator counts, denominator counts].
    """
    question, tolerance = pickle.loads(packed)
    if question.of_equal_sums:
        return _search_sums(question, *segment)
    beneath, top = segment[:2], segment[2:]
    near = replace(question, tolerance=tolerance)
    judge = StageFilter(question)
    (q, q_starts), (p, p_starts) = question.under.values(*beneath), question.over.values(*top)
    first, last = cuts(p, q, *question.ratio_bounds)
    # several multisets may have the same product
    count = int(((p_starts[last] - p_starts[first]) * np.diff(q_starts)).sum())
    if near.tolerance < question.tolerance:
        first, last = cuts(p, q, *near.ratio_bounds) if near.reachable else (first, first)
    used = last > first
    if used.any():
        # products within some window: number of windows that begin, minus number of windows that end, up to a product
        opened, closed = (np.bincount(ends, minlength=len(p) + 1) for ends in (first, last))
        q, beneaths = question.under.members(*beneath, q[used])
        p, tops = question.over.members(*top, p[np.cumsum(opened - closed)[:-1] > 0])
        # every pair of multisets is expanded to all of its pairings
        chunk = max(CHUNK // (factorial(question.stages) * comb(question.stages, question.fit.internal)), 1)
        for i, j in spread_in_blocks(*cuts(p, q, *near.ratio_bounds), chunk):
            judge.add(tops[j], beneaths[i], p[j], q[i])
    return judge.outcome() | ({"count": count} if question.accepts_all else {})


def _search_sums(question: StageProblem, low: int, high: int) -> dict[str, Any]:
    """Search the reverted trains in which the sum of the tooth counts of a stage is in [low, high). The result has the
    keys described in `search_segment`.
    """
    # meet in the middle on the ratios: for each sum, every multiset of stages is generated once, from a lower and an
    # upper half. Candidates near the tolerance are compared as Fractions, all others as floats
    judge, size, limit = StageFilter(question), question.stages, float(question.tolerance)
    first, last = map(float, question.ratio_bounds)
    for total in range(low, high):
        pairs = [(count, total - count) for count in question.top if total - count in question.beneath]
        stages = np.array(pairs, dtype=np.int64).reshape(-1, 2)
        ratios = stages[:, 0] / stages[:, 1]
        lower, upper = (_multisets(len(stages), part) for part in (size // 2, size - size // 2))
        below = ratios[lower].prod(axis=1)
        upper = upper[np.argsort(ratios[upper].prod(axis=1))]
        above = ratios[upper].prod(axis=1)
        starts = np.searchsorted(above, first * (1 - _SLACK) / below)
        ends = np.searchsorted(above, last * (1 + _SLACK) / below, side="right")
        for i, j in spread_in_blocks(starts, ends, CHUNK):
            # only halves in ascending order, so that each multiset occurs once
            once = lower[i, -1] <= upper[j, 0] if size > 1 else np.full(len(i), True)
            chosen = stages[np.concatenate([lower[i[once]], upper[j[once]]], axis=1)]
            tops, beneaths = np.sort(chosen[:, :, 0], axis=1), np.sort(chosen[:, :, 1], axis=1)
            p, q = row_products(tops), row_products(beneaths)
            errors = np.abs(p / q / float(question.value) - 1)
            inside = errors <= limit
            for at in np.flatnonzero(np.abs(errors - limit) <= _SLACK * (1 + limit)):
                exact = abs(Fraction(int(p[at]), int(q[at])) / question.value - 1)
                inside[at] = exact <= question.tolerance
            judge.add(tops[inside], beneaths[inside], p[inside], q[inside])
    return judge.outcome()


def _multisets(number: int, size: int) -> Ints:
    """Return all multisets of `size` integers from 0 to `number` - 1, each row in ascending order, shape (n, size),
    where n is the number of multisets.
    """
    found = list(combinations_with_replacement(range(number), size))
    return np.array(found, dtype=np.int64).reshape(len(found), size)


def pieces(products: ProductWindows, low: int, high: int, most: int) -> Iterator[Range]:
    """Divide the half-open range from `low` to `high` into ascending ranges, each of which contains at most `most` of
    the given products. Ranges without products are omitted.
    """
    number = products.below(high) - products.below(low) if low < high else 0
    if number > most and high - low > 1:
        # the geometric mean, because the logarithms of products are about uniform
        middle = min(max(isqrt(low * high), low + 1), high - 1)
        yield from pieces(products, low, middle, most)
        yield from pieces(products, middle, high, most)
    elif number:
        yield low, high


class StageFilter:
    """Filter that tests pairs of multisets of tooth counts against the constraints, counts the solutions, and keeps the
    best solutions in bounded memory.
    """

    def __init__(self, question: StageProblem) -> None:
        self.question = question
        self.removed: dict[str, int] = {}
        self.count = 0
        # rows: primary criterion, products of numerator and denominator, tooth counts of numerator and denominator
        self._rows: list[Ints] = []

    def add(self, tops: Ints, beneaths: Ints, over: Ints, under: Ints) -> None:
        """Test n pairs of multisets of tooth counts against the constraints; count and store those that satisfy them.

        tops, beneaths   tooth counts of numerators and denominators, shape (n, k) each, where k is the number of stages
        over, under      products of these tooth counts, shape (n,) each
        """
        fit, at = self.question.fit, np.arange(len(over))
        if fit.different:
            # equal counts are neighbours after sorting
            both = np.sort(np.concatenate([tops, beneaths], axis=1), axis=1)
            at = self._filter(at, np.asarray((both[:, 1:] != both[:, :-1]).all(axis=1)), "repeated count")
        if fit.maximum_total is not None:
            total = tops[at].sum(axis=1) + beneaths[at].sum(axis=1)
            at = self._filter(at, total <= fit.maximum_total, "sum of counts out of bounds")
        if fit.pairs_matter:
            possible, _, _ = pairings(tops[at], beneaths[at], fit)
            at = self._filter(at, np.asarray(possible.any(axis=1)), pairing_reason(self.question))
        self.count += len(at)
        if len(at):
            first = first_of(self.question.by, tops[at], beneaths[at], fit)
            self._rows.append(np.column_stack([first, over[at], under[at], tops[at], beneaths[at]]))
            # several times the list length is stored between two sorts, which amortises their cost
            if sum(map(len, self._rows)) > max(4 * self.question.best, 1 << 17):
                self._rows = [self._best_rows()]

    def outcome(self) -> dict[str, Any]:
        """Return the number of solutions, the number of rejected pairs of multisets for each reason, and the best
        solutions, as plain data with the keys that are described in `search_segment`.
        """
        rows, stages = self._best_rows().tolist() if self._rows else [], self.question.stages
        best = [[row[0], row[3 : 3 + stages], row[3 + stages :]] for row in rows]
        return {"count": self.count, "listed": self.count, "removed": self.removed, "rows": best}

    def _best_rows(self) -> Ints:
        """Sort all stored rows exactly, and return the requested number of best rows."""
        rows, best, value = np.concatenate(self._rows), self.question.best, self.question.value
        if len(rows) > best:
            # errors in floats select slightly too many rows, which are then compared as Fractions
            first, over, under = rows[:, 0], rows[:, 1], rows[:, 2]
            error = np.abs(over.astype(np.float64) / under.astype(np.float64) / float(value) - 1)
            last = np.lexsort((error, first))[best - 1]
            near = error <= error[last] + _MARGIN * (1 + error[last])
            rows = rows[(first < first[last]) | ((first == first[last]) & near)]
        first, over, under, *counts = rows.T
        sizes = np.max(counts, axis=0), np.sum(counts, axis=0)
        # lexsort takes its last key first
        order = np.lexsort((*counts[::-1], *sizes, error_ranks(over, under, value), first))
        return rows[order[:best]]

    def _filter(self, at: Ints, good: NDArray[np.bool_], reason: str) -> Ints:
        """Return the elements of `at`, which are indices of pairs of multisets, for which `good` is True. The elements
        for which it is False are counted as rejected for `reason`.
        """
        if not good.all():
            self.removed[reason] = self.removed.get(reason, 0) + int((~good).sum())
        return at[good]


def pairing_reason(question: StageProblem) -> str:
    """Return the reason for the rejection of multisets of tooth counts that cannot be paired to stages in accordance
    with the constraints.
    """
    fit = question.fit
    requested = [
        *(["coprime counts in every stage"] if fit.hunting else []),
        *(["equal centre distances"] if fit.reverted else []),
        *([f"a ring larger than its pinion in {fit.internal} of the stages"] if fit.internal else []),
    ]
    return f"no pairing with {' and '.join(requested)}"


@dataclass(frozen=True, slots=True)
class SweepOutcome:
    """Merged result of a search for stages: the number of solutions and of rejected candidates within a tolerance, and
    the best solutions.
    """

    tolerance: Fraction
    count: int = 0
    listed: int = 0
    """Number of solutions from which the best solutions were selected."""
    removed: Mapping[str, int] = field(default_factory=dict)
    keys: Sequence[StageRank] = ()
    complete: bool = True
    """True if every segment of the search was completed."""
    note: str = ""
    """Reason why the search may have found fewer solutions than exist; empty if there is no such reason."""


def solve(question: StageProblem, tolerance: Fraction | None, means: Execution) -> SweepOutcome:
    """Count all solutions of a search problem within a tolerance, and keep the best solutions. If `tolerance` is None,
    find the solutions with the smallest absolute errors.

    `question.tolerance` is ignored. If there are many solutions, all are counted, but only those within a smaller
    tolerance are listed and sorted. This tolerance is increased until enough solutions are listed, so the other
    solutions have larger errors.
    """
    # minimum and maximum absolute relative error of the possible ratios
    first, last = (ratio / question.value - 1 for ratio in question.reach)
    minimum, most = max(first, -last, Fraction(0)), max(last, -first)
    if tolerance is not None:
        most = tolerance
        if not (question.by == "error" and replace(question, tolerance=tolerance).accepts_all):
            pairs = float(tolerance) * _density(question)
            if pairs > _MOST:
                raise RangeError(
                    Problem(
                        f"about {pairs:.1g} candidates are within the tolerance",
                        f"with these constraints or this order, each is tested, and at most {_MOST:.0g} can be tested",
                        f"reduce the tolerance to {float(tolerance) * _MOST / pairs:.1g} or less",
                    )
                )
            minimum = tolerance
    # about 16 times the requested number of solutions are expected within the first tolerance
    step = rounded_up(max(min(16 * question.best / _density(question), 1.0), 1e-18))
    while True:
        # the nearest possible ratio may be far away; the tolerance starts there
        near = min(minimum + step, most)
        found = _sweep(replace(question, tolerance=near if tolerance is None else tolerance), near, means)
        means = replace(means, journal=None)  # the journal belongs to the first tolerance only
        if found.listed >= question.best or near >= most or not found.complete:
            return found
        inside = found.listed + sum(found.removed.values())
        if _WIDER * inside > _ENOUGH:
            note = f"only {found.count} solutions are within {float(near):.3g}, among {inside} candidates; "
            return replace(found, note=note + "give a tolerance to search further")
        step *= _WIDER


def _density(question: StageProblem) -> float:
    """Return an estimate of the number of candidates per unit of absolute relative error near the requested ratio."""
    span = log(question.top[-1] / question.top[0]) + log(question.beneath[-1] / question.beneath[0])
    # factor 2: errors of both signs; logarithms of ratios spread over about `stages` times the span
    return 2 * question.candidates / max(question.stages * span, 1e-3)


def _sweep(question: StageProblem, near: Fraction, means: Execution) -> SweepOutcome:
    """Search all segments and return their merged results. Solutions are counted within `question.tolerance`, and
    listed within the tolerance `near`. After a keyboard interrupt, the results obtained until then are returned.
    """
    work, tasks = partial(search_segment, pickle.dumps((question, near))), _segments(question)
    # a single task runs in this process, without the overhead of an executor
    results = map(work, tasks) if len(tasks) < 2 else means.run(work, tasks)
    count, listed, keys, complete = 0, 0, list[StageRank](), True
    removed = Counter[str]()
    try:
        for result in results:
            count += result["count"]
            listed += result["listed"]
            removed.update(result["removed"])
            keys += [key_of(first, top, beneath, question.value) for first, top, beneath in result["rows"]]
            keys = sorted(keys)[: question.best]
    except KeyboardInterrupt:
        complete = False
    return SweepOutcome(question.tolerance, count, listed, removed, keys, complete)


def _segments(question: StageProblem) -> list[Sequence[int]]:
    """Return the segments into which the search is divided. Every pair of products within the tolerance is in exactly
    one segment.
    """
    size = question.stages
    if question.of_equal_sums:
        # eight sums a segment for four or more stages, because this search is slow
        low, high = question.top[0] + question.beneath[0], question.top[-1] + question.beneath[-1] + 1
        return [(at, min(at + 8, high)) for at in range(low, high, 8)] if size > 3 else [(low, high)]
    if not question.reachable:
        return []
    # more products if the tables have many rows
    most = max(BLOCK, PER_ROW * multisets(max(len(question.top), len(question.beneath)), (size + 1) // 2))
    smallest, largest = question.ratio_bounds
    minimum, maximum = question.top[0] ** size, question.top[-1] ** size
    # denominators for which a numerator may exist
    first = max(question.beneath[0] ** size, ceil(minimum / largest))
    last = min(question.beneath[-1] ** size, floor(maximum / smallest))
    found: list[Sequence[int]] = []
    for low, high in pieces(question.under, first, last + 1, most):
        # numerators that may match these denominators
        tops = max(ceil(low * smallest), minimum), min(floor((high - 1) * largest), maximum) + 1
        found += [(low, high, *top) for top in pieces(question.over, *tops, most)]
    return found
