"""Reverted trains: all stages have the same sum of counts, so each sum is a search of its own, and a small one.

As an exact join (equal sums as equations, stages in order as conditions) the same took 0.6 times as long for two stages
of 15 to 120 teeth, 1.3 times for 12 to 400, and 1.5 to 4.3 times for three and four stages: so it stays.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import gcd
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.integer_columns import spread, spread_in_blocks
from geartrain.synthesis.ratio.candidate_stages import CHUNK, StageFilter, sets_of
from geartrain.synthesis.ratio.product_windows import multisets
from geartrain.synthesis.ratio.ratio_windows import cuts
from geartrain.synthesis.ratio.stage_problem import StageProblem, stage_problem_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Ints = NDArray[Any]

_SLACK = 1e-12  # relative: floats find candidates with it, integers decide

APART = "no pairing on one centre distance"
SHARED = "no such pairing with coprime counts in every stage"
TOTAL = "a sum of counts out of bounds"


def sums_of(question: StageProblem) -> range:
    """Sums that a stage may have, whatever the bounds of the total."""
    return range(question.top[0] + question.beneath[0], question.top[-1] + question.beneath[-1] + 1)


def stages_of(question: StageProblem, total: int) -> list[tuple[int, int]]:
    """All stages (count on top, count beneath) with a sum of counts."""
    beneath = set(question.beneath)
    return [(count, total - count) for count in question.top if total - count in beneath]


def tally(question: StageProblem) -> dict[str, int]:
    """How many pairs of sets have no one centre distance, no coprime pairing, or a total out of bounds: exact."""
    size, fit = question.stages, question.fit
    least, most = fit.totals
    sums = {APART: question.considered, SHARED: 0, TOTAL: 0}
    for total in sums_of(question):
        stages = stages_of(question, total)
        whole = multisets(len(stages), size) if stages else 0
        good = sum(gcd(*stage) == 1 for stage in stages) if fit.hunting else len(stages)
        left = multisets(good, size) if good else 0
        sums[APART] -= whole
        sums[SHARED] += whole - left
        sums[TOTAL] += 0 if least <= size * total <= most else left
    return {reason: number for reason, number in sums.items() if number}


def search_sums(task: Mapping[str, Any]) -> dict[str, Any]:
    """Solutions whose stages have a sum in [low, high): counted, and the best of them, as `search_segment` gives them.

    Every unordered set of stages is looked at once, as a lower and an upper half, by the products of their ratios.
    """
    question = stage_problem_of(task["question"])
    judge = StageFilter(question)
    least, most = question.fit.totals
    for total in range(task["low"], task["high"]):
        stages = stages_of(question, total)
        if question.fit.hunting:
            stages = [stage for stage in stages if gcd(*stage) == 1]
        if stages and least <= question.stages * total <= most:
            _search(question, stages, judge)
    return judge.result()


def _search(question: StageProblem, stages: list[tuple[int, int]], judge: StageFilter) -> None:
    """All unordered sets of these stages with a ratio within the tolerance."""
    size = question.stages
    counts = np.array(stages, dtype=np.int64 if question.plain_integers else object)
    lower, upper = _halves(len(stages), size // 2), _halves(len(stages), size - size // 2)
    ratios = (counts[:, 0] / counts[:, 1]).astype(np.float64)
    low_ratios, high_ratios = ratios[lower].prod(axis=1), ratios[upper].prod(axis=1)
    order = np.argsort(high_ratios, kind="stable")
    upper, high_ratios = upper[order], high_ratios[order]
    # floats find candidates, a little too many; `_judge` decides in integers
    low, high = question.edges
    first = np.searchsorted(high_ratios, float(low) * (1 - _SLACK) / low_ratios)
    last = np.searchsorted(high_ratios, float(high) * (1 + _SLACK) / low_ratios, side="right")
    for i, j in spread_in_blocks(first, np.maximum(first, last), CHUNK):
        # halves that ascend across the cut: each unordered set is met in one way only
        once = np.flatnonzero(lower[i, -1] <= upper[j, 0]) if size > 1 else np.arange(len(i))
        chosen = np.concatenate([lower[i[once]], upper[j[once]]], axis=1)
        _judge(question, counts, chosen, judge)


def _judge(question: StageProblem, counts: Ints, chosen: Ints, judge: StageFilter) -> None:
    """Exact windows, then the other conditions."""
    tops, beneaths = np.sort(counts[chosen, 0], axis=1), np.sort(counts[chosen, 1], axis=1)
    over, under = _products(tops), _products(beneaths)
    inside = np.flatnonzero(within(over, under, question))
    each = np.arange(len(inside))
    judge.see(sets_of(over[inside], tops[inside]), sets_of(under[inside], beneaths[inside]), each, each)


def within(over: Ints, under: Ints, question: StageProblem) -> NDArray[np.bool_]:
    """Whether over / under is within the tolerance, exactly, one by one."""
    if not len(over):
        return np.zeros(0, dtype=bool)
    values = np.unique(over)
    first, last = cuts(values, under, *question.edges)
    at = np.searchsorted(values, over)
    return np.asarray((first <= at) & (at < last))


def _products(counts: Ints) -> Ints:
    found = np.ones(len(counts), dtype=counts.dtype)
    for column in counts.T:
        found = found * column
    return found


def _halves(number: int, size: int) -> Ints:
    """Unordered sets of `size` of so many stages, ascending in each, (sets, size)."""
    found = np.zeros((1, 0), dtype=np.int64)
    for _ in range(size):
        least = found[:, -1] if found.shape[1] else np.zeros(1, dtype=np.int64)
        row, last = spread(least, np.full(len(least), number))
        found = np.concatenate([found[row], last[:, None]], axis=1)
    return found
