"""All pieces of a search, here or by many, and the tolerance that proves the best found are the best there are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import gcd, log
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.work import Execution
from geartrain.search.integer_columns import spread, spread_in_blocks
from geartrain.search.ratio.product_windows import cuts, multisets, reach_of_errors, rounded_up, row_products
from geartrain.search.ratio.search_segments import (
    CHUNK,
    SegmentPlan,
    StageFilter,
    lay_out,
    listed_by_value,
    search_segment,
    sets_of,
    task_of,
)
from geartrain.search.ratio.stage_problem import StageProblem, StageRank, key_of, merged, stage_problem_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Ints = NDArray[Any]


# Reverted trains: all stages have the same sum of counts, so each sum is a search of its own, and a small one. As
# an exact join (equal sums as equations, stages in order as conditions) the same took 0.6 times as long for two
# stages of 15 to 120 teeth, 1.3 times for 12 to 400, and 1.5 to 4.3 times for three and four stages: so it stays.


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
    minimum, most = fit.totals
    sums = {APART: question.considered, SHARED: 0, TOTAL: 0}
    for total in sums_of(question):
        stages = stages_of(question, total)
        whole = multisets(len(stages), size) if stages else 0
        good = sum(gcd(*stage) == 1 for stage in stages) if fit.hunting else len(stages)
        left = multisets(good, size) if good else 0
        sums[APART] -= whole
        sums[SHARED] += whole - left
        sums[TOTAL] += 0 if minimum <= size * total <= most else left
    return {reason: number for reason, number in sums.items() if number}


def search_sums(task: Mapping[str, Any]) -> dict[str, Any]:
    """Solutions whose stages have a sum in [low, high): counted, and the best of them, as `search_segment` gives them.

    Every unordered set of stages is looked at once, as a lower and an upper half, by the products of their ratios.
    """
    question = stage_problem_of(task["question"])
    judge = StageFilter(question)
    minimum, most = question.fit.totals
    for total in range(task["low"], task["high"]):
        stages = stages_of(question, total)
        if question.fit.hunting:
            stages = [stage for stage in stages if gcd(*stage) == 1]
        if stages and minimum <= question.stages * total <= most:
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
    over, under = row_products(tops), row_products(beneaths)
    inside = np.flatnonzero(_are_within(over, under, question))
    each = np.arange(len(inside))
    judge.see(sets_of(over[inside], tops[inside]), sets_of(under[inside], beneaths[inside]), each, each)


def _are_within(over: Ints, under: Ints, question: StageProblem) -> NDArray[np.bool_]:
    """Whether over / under is within the tolerance, exactly, one by one."""
    if not len(over):
        return np.zeros(0, dtype=bool)
    values = np.unique(over)
    first, last = cuts(values, under, *question.edges)
    at = np.searchsorted(values, over)
    return np.asarray((first <= at) & (at < last))


def _halves(number: int, size: int) -> Ints:
    """Unordered sets of `size` of so many stages, ascending in each, (sets, size)."""
    found = np.zeros((1, 0), dtype=np.int64)
    for _ in range(size):
        minimum = found[:, -1] if found.shape[1] else np.zeros(1, dtype=np.int64)
        row, last = spread(minimum, np.full(len(minimum), number))
        found = np.concatenate([found[row], last[:, None]], axis=1)
    return found


Bound = tuple[int, Fraction, int]
_WIDER = 16  # times, from one tolerance to the next: all before the last cost little beside it
_ENOUGH = 2 * 10**9
"""Pairs of sets looked at one by one, after which a search without a tolerance is not widened any more."""
_MOST = 1e11
"""Pairs of sets that may have to be looked at one by one."""
_PILOT = Fraction(1, 100)  # |error| past which a first piece is not widened


@dataclass(frozen=True, slots=True)
class SweepOutcome:
    """What a sweep over all pieces found within `tolerance`."""

    tolerance: Fraction
    count: int = 0
    removed: Mapping[str, int] = field(default_factory=dict)
    keys: Sequence[StageRank] = ()
    complete: bool = True
    """Every piece was searched."""
    note: str = ""
    """Why fewer were found than there may be."""

    @property
    def inside(self) -> int:
        """Pairs of sets within the tolerance, those that are no solutions included."""
        return self.count + sum(self.removed.values())


def within(question: StageProblem, means: Execution) -> SweepOutcome:
    """All within the question's tolerance: counted, the best kept."""
    search = _search_for(question)
    search.check(question.tolerance)
    return search.sweep(question.tolerance, search.pilot(question.tolerance), means)


def nearest(question: StageProblem, means: Execution) -> SweepOutcome:
    """The best by |error|, proved: the tolerance is widened until enough are within it, so that none is nearer.

    The question's own tolerance is not looked at.
    """
    search = _search_for(question)
    minimum, most = reach_of_errors(question.value, *question.reach)
    start, bound = search.start(), search.widened_pilot()
    if bound:
        start = rounded_up(bound[1])
    while True:
        # the nearest ratio of all may be far away: the tolerance begins there
        tolerance = min(minimum + start, most)
        found = search.sweep(tolerance, bound, means)
        means = replace(means, journal=None)  # its pieces are those of the first tolerance
        if found.count >= question.best or tolerance >= most or not found.complete:
            return found
        if _WIDER * found.inside > _ENOUGH and not question.loose:
            return replace(found, note=_given_up(found))
        start *= _WIDER


def _given_up(found: SweepOutcome) -> str:
    return (
        f"only {found.count} solutions are within {float(found.tolerance):.3g}, where {found.inside} pairs of "
        "sets were looked at; give a tolerance to search farther"
    )


class _ByProducts:
    """Pieces are segments of the products beneath."""

    def __init__(self, question: StageProblem) -> None:
        self.question = question
        self.plan: SegmentPlan = lay_out(question)
        self.many = len(self.plan.segments) > 1

    def start(self) -> Fraction:
        """An |error| within which a few times as many pairs lie as are wanted."""
        return rounded_up(self.plan.tolerance_for(4 * self.question.best))

    def check(self, tolerance: Fraction) -> None:
        """`RangeError` if more pairs of sets must be looked at one by one than can be."""
        pairs = float(tolerance) * self.plan.density
        if pairs > _MOST and not listed_by_value(self.question):
            raise RangeError(
                Problem(
                    f"about {pairs:.1g} pairs of sets are within the tolerance",
                    "these conditions, this order or so long a list need a look at each of them",
                    f"narrow the tolerance to {float(tolerance) * _MOST / pairs:.1g} or less",
                )
            )

    def _task(self, tolerance: Fraction, segment: tuple[int, int], bound: Bound | None) -> dict[str, Any]:
        return task_of(replace(self.question, tolerance=tolerance), *segment, self.start(), bound)

    def pilot(self, tolerance: Fraction) -> Bound | None:
        """How good the best are at least, from the densest piece and the one with the smallest counts."""
        if not self.many:
            return None
        bound = None
        for number in (0, self.plan.densest):
            reached = self._reached(tolerance, number, bound)[0]
            bound = min((each for each in (bound, reached) if each), default=None)
        return bound

    def widened_pilot(self) -> Bound | None:
        """The same where the tolerance is still open: widened until the pieces hold enough."""
        found = []
        for number in {0, self.plan.densest} if self.many else ():
            at = self.start()
            bound, inside = self._reached(at, number)
            while bound is None and at < _PILOT and (self.question.loose or _WIDER * inside < _ENOUGH):
                at *= _WIDER
                bound, inside = self._reached(at, number)
            found.append(bound)
        return min((bound for bound in found if bound), default=None)

    def _reached(self, tolerance: Fraction, number: int, known: Bound | None = None) -> tuple[Bound | None, int]:
        """First, |error| and sum of the last that would be kept of one piece; and how many pairs were looked at."""
        question = self.question
        result = search_segment(self._task(tolerance, self.plan.segments[number], known))
        keys = _keys(result, question)
        inside = result["count"] + sum(result["removed"].values())
        return (keys[-1][:3] if len(keys) == question.best else None), inside

    def sweep(self, tolerance: Fraction, bound: Bound | None, means: Execution) -> SweepOutcome:
        """All pieces."""
        tasks = [self._task(tolerance, segment, bound) for segment in self.plan.segments]
        return _swept(search_segment, tasks, self.question, tolerance, means)


class _BySums:
    """Pieces are sums of the counts of a stage, all stages of a reverted train having the same."""

    many = False

    def __init__(self, question: StageProblem) -> None:
        self.question = question

    def start(self) -> Fraction:
        """An |error| within which a few times as many reverted trains lie as are wanted."""
        question = self.question
        stages = (len(stages_of(question, total)) for total in sums_of(question))
        number = sum(multisets(count, question.stages) for count in stages if count)
        span = question.stages * log(question.top[-1] * question.beneath[-1] / question.top[0] / question.beneath[0])
        return rounded_up(min(4 * question.best * max(span, 1e-3) / max(number, 1), 1.0))

    def check(self, tolerance: Fraction) -> None:
        """Nothing to refuse: reverted trains are few."""

    def pilot(self, tolerance: Fraction) -> Bound | None:
        """None: the pieces are small."""
        del tolerance
        return None

    def widened_pilot(self) -> Bound | None:
        """None: the pieces are small."""
        return None

    def sweep(self, tolerance: Fraction, bound: Bound | None, means: Execution) -> SweepOutcome:
        """All pieces."""
        del bound
        question = replace(self.question, tolerance=tolerance)
        # four stages and more take long: in pieces of eight sums; fewer in one piece
        sums, step = sums_of(question), 8 if question.stages > 3 else 1 << 40
        plain = question.plain()
        tasks = [
            {"question": plain, "low": low, "high": min(low + step, sums.stop)}
            for low in range(sums.start, sums.stop, min(step, len(sums)))
        ]
        return _swept(search_sums, tasks, question, tolerance, means)


def _search_for(question: StageProblem) -> _ByProducts | _BySums:
    return _BySums(question) if question.fit.reverted and not question.fit.internal else _ByProducts(question)


def _swept(
    work: Callable[[Any], dict[str, Any]],
    tasks: list[Any],
    question: StageProblem,
    tolerance: Fraction,
    means: Execution,
) -> SweepOutcome:
    """The results of all pieces as one; what is there so far if the user interrupts."""
    alone = len(tasks) == 1
    results = iter([work(tasks[0])]) if alone else means.run(work, tasks)
    count, keys, complete = 0, list[StageRank](), True
    removed: dict[str, int] = {}
    try:
        for result in results:
            count += result["count"]
            for reason, number in result["removed"].items():
                removed[reason] = removed.get(reason, 0) + number
            keys = merged([*keys, *_keys(result, question)], question.best)
    except KeyboardInterrupt:
        complete = False
    return SweepOutcome(tolerance, count, removed, keys, complete)


def _keys(result: Mapping[str, Any], question: StageProblem) -> list[StageRank]:
    return [key_of(first, top, beneath, question.value) for first, top, beneath in result["rows"]]
