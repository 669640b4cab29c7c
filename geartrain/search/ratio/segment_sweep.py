"""Search of all segments, serial or parallel, and the tolerance that proves the list of the best solutions."""

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


# Reverted trains: all stages have the same sum of counts, so each sum is an independent small search. The same problem
# as an exact join (equal sums as equations, order of the stages as conditions) took 0.6 times as long for two stages
# of 15 to 120 teeth, but 1.3 times for 12 to 400 teeth, and 1.5 to 4.3 times for three and four stages.


_SLACK = 1e-12  # relative margin: floats select candidates with it, integers decide

APART = "no pairing with equal centre distances"
SHARED = "no such pairing with coprime counts in every stage"
TOTAL = "sum of counts out of bounds"


def sums_of(question: StageProblem) -> range:
    """Return the range of possible sums of the two counts of a stage."""
    return range(question.top[0] + question.beneath[0], question.top[-1] + question.beneath[-1] + 1)


def stages_of(question: StageProblem, total: int) -> list[tuple[int, int]]:
    """Return all stages (numerator count, denominator count) with a given sum of counts."""
    beneath = set(question.beneath)
    return [(count, total - count) for count in question.top if total - count in beneath]


def tally(question: StageProblem) -> dict[str, int]:
    """Count the pairs of multisets that are not reverted trains, by reason, exactly.

    They lack a common centre distance, a coprime pairing, or an admissible sum of counts.
    """
    size, fit = question.stages, question.fit
    minimum, most = fit.totals
    sums = {APART: question.considered, SHARED: 0, TOTAL: 0}
    for total in sums_of(question):
        stages = stages_of(question, total)
        # multisets of stages with this sum, before and after the test for common divisors
        whole = multisets(len(stages), size) if stages else 0
        good = sum(gcd(*stage) == 1 for stage in stages) if fit.hunting else len(stages)
        left = multisets(good, size) if good else 0
        sums[APART] -= whole
        sums[SHARED] += whole - left
        sums[TOTAL] += 0 if minimum <= size * total <= most else left
    return {reason: number for reason, number in sums.items() if number}


def search_sums(task: Mapping[str, Any]) -> dict[str, Any]:
    """Search all reverted trains whose stages have a sum of counts in [low, high), with the same result as
    `search_segment`.

    Every multiset of stages is generated once, from a lower and an upper half, by a meet in the middle on the products
    of ratios.
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
    """Send all multisets of these stages whose ratio is within the tolerance to the filter `judge`."""
    size = question.stages
    counts = np.array(stages, dtype=np.int64 if question.plain_integers else object)
    lower, upper = _halves(len(stages), size // 2), _halves(len(stages), size - size // 2)
    ratios = (counts[:, 0] / counts[:, 1]).astype(np.float64)
    low_ratios, high_ratios = ratios[lower].prod(axis=1), ratios[upper].prod(axis=1)
    order = np.argsort(high_ratios, kind="stable")
    upper, high_ratios = upper[order], high_ratios[order]
    # floats select slightly too many candidates; `_judge` decides in integers
    low, high = question.edges
    first = np.searchsorted(high_ratios, float(low) * (1 - _SLACK) / low_ratios)
    last = np.searchsorted(high_ratios, float(high) * (1 + _SLACK) / low_ratios, side="right")
    for i, j in spread_in_blocks(first, np.maximum(first, last), CHUNK):
        # only halves in ascending order, so that each multiset occurs once
        once = np.flatnonzero(lower[i, -1] <= upper[j, 0]) if size > 1 else np.arange(len(i))
        # indices of the stages of each candidate
        chosen = np.concatenate([lower[i[once]], upper[j[once]]], axis=1)
        _judge(question, counts, chosen, judge)


def _judge(question: StageProblem, counts: Ints, chosen: Ints, judge: StageFilter) -> None:
    """Select the candidates within the tolerance by exact arithmetic, and pass them to the filter `judge`."""
    tops, beneaths = np.sort(counts[chosen, 0], axis=1), np.sort(counts[chosen, 1], axis=1)
    over, under = row_products(tops), row_products(beneaths)
    inside = np.flatnonzero(_are_within(over, under, question))
    each = np.arange(len(inside))
    judge.see(sets_of(over[inside], tops[inside]), sets_of(under[inside], beneaths[inside]), each, each)


def _are_within(over: Ints, under: Ints, question: StageProblem) -> NDArray[np.bool_]:
    """Return whether each ratio over / under is within the tolerance, by exact arithmetic."""
    if not len(over):
        return np.zeros(0, dtype=bool)
    # `cuts` requires ascending products
    values = np.unique(over)
    first, last = cuts(values, under, *question.edges)
    at = np.searchsorted(values, over)
    return np.asarray((first <= at) & (at < last))


def _halves(number: int, size: int) -> Ints:
    """Return the multisets of `size` of the integers 0 to `number` - 1, ascending in each row, shape
    (multisets, size).
    """
    found = np.zeros((1, 0), dtype=np.int64)
    for _ in range(size):
        minimum = found[:, -1] if found.shape[1] else np.zeros(1, dtype=np.int64)
        row, last = spread(minimum, np.full(len(minimum), number))
        found = np.concatenate([found[row], last[:, None]], axis=1)
    return found


Bound = tuple[int, Fraction, int]
_WIDER = 16  # factor between tolerances; all passes before the last then cost little
_ENOUGH = 2 * 10**9
"""Number of tested pairs of multisets at which a search without a tolerance stops to widen its tolerance."""
_MOST = 1e11
"""Maximum number of pairs of multisets that may be tested one by one."""
_PILOT = Fraction(1, 100)  # absolute error beyond which the first segment is not widened


@dataclass(frozen=True, slots=True)
class SweepOutcome:
    """Solutions of all segments within `tolerance`."""

    tolerance: Fraction
    count: int = 0
    removed: Mapping[str, int] = field(default_factory=dict)
    keys: Sequence[StageRank] = ()
    complete: bool = True
    """True if every segment was searched."""
    note: str = ""
    """Reason why fewer solutions were found than may exist; "" otherwise."""

    @property
    def inside(self) -> int:
        """Number of pairs of multisets within the tolerance, including those that are not solutions."""
        return self.count + sum(self.removed.values())


def within(question: StageProblem, means: Execution) -> SweepOutcome:
    """Count all solutions within the tolerance of the problem, and keep the best."""
    search = _search_for(question)
    search.check(question.tolerance)
    return search.sweep(question.tolerance, search.pilot(question.tolerance), means)


def nearest(question: StageProblem, means: Execution) -> SweepOutcome:
    """Find the best solutions by absolute error, with proof.

    The tolerance is increased until it includes enough solutions, so all other solutions have larger errors. The
    tolerance of the problem is ignored.
    """
    search = _search_for(question)
    minimum, most = reach_of_errors(question.value, *question.reach)
    # the pilot finds some good solutions, whose error limits the search
    start, bound = search.start(), search.widened_pilot()
    if bound:
        start = rounded_up(bound[1])
    while True:
        # the nearest possible ratio may be far away; the tolerance starts there
        tolerance = min(minimum + start, most)
        found = search.sweep(tolerance, bound, means)
        means = replace(means, journal=None)  # the journal belongs to the first tolerance only
        if found.count >= question.best or tolerance >= most or not found.complete:
            return found
        if _WIDER * found.inside > _ENOUGH and not question.loose:
            return replace(found, note=_given_up(found))
        start *= _WIDER


def _given_up(found: SweepOutcome) -> str:
    return (
        f"only {found.count} solutions are within {float(found.tolerance):.3g}, among {found.inside} candidates; "
        "give a tolerance to search further"
    )


class _ByProducts:
    """Division of a search into segments of the denominator products."""

    def __init__(self, question: StageProblem) -> None:
        self.question = question
        self.plan: SegmentPlan = lay_out(question)
        self.many = len(self.plan.segments) > 1

    def start(self) -> Fraction:
        """Return a tolerance within which about four times the requested number of pairs is expected."""
        return rounded_up(self.plan.tolerance_for(4 * self.question.best))

    def check(self, tolerance: Fraction) -> None:
        """Raise `RangeError` if too many pairs of multisets must be tested one by one."""
        pairs = float(tolerance) * self.plan.density
        if pairs > _MOST and not listed_by_value(self.question):
            raise RangeError(
                Problem(
                    f"about {pairs:.1g} candidates are within the tolerance",
                    f"constraints, order or list length require a test of each, and at most {_MOST:.0g} are tested",
                    f"reduce the tolerance to {float(tolerance) * _MOST / pairs:.1g} or less",
                )
            )

    def _task(self, tolerance: Fraction, segment: tuple[int, int], bound: Bound | None) -> dict[str, Any]:
        return task_of(replace(self.question, tolerance=tolerance), *segment, self.start(), bound)

    def pilot(self, tolerance: Fraction) -> Bound | None:
        """Return a bound on the best solutions, from the densest segment and the segment with the smallest counts."""
        if not self.many:
            return None
        bound = None
        # the first segment has the smallest counts, the densest one the smallest errors
        for number in (0, self.plan.densest):
            reached = self._segment_bound(tolerance, number, bound)[0]
            bound = min((each for each in (bound, reached) if each), default=None)
        return bound

    def widened_pilot(self) -> Bound | None:
        """Return an initial bound on the error of the best solutions, increased until enough solutions satisfy it."""
        found = []
        for number in {0, self.plan.densest} if self.many else ():
            at = self.start()
            bound, inside = self._segment_bound(at, number)
            while bound is None and at < _PILOT and (self.question.loose or _WIDER * inside < _ENOUGH):
                at *= _WIDER
                bound, inside = self._segment_bound(at, number)
            found.append(bound)
        return min((bound for bound in found if bound), default=None)

    def _segment_bound(self, tolerance: Fraction, number: int, known: Bound | None = None) -> tuple[Bound | None, int]:
        """Return the rank of the last solution kept from one segment (None if too few), and the number of pairs
        tested.
        """
        question = self.question
        result = search_segment(self._task(tolerance, self.plan.segments[number], known))
        keys = _keys(result, question)
        inside = result["count"] + sum(result["removed"].values())
        return (keys[-1][:3] if len(keys) == question.best else None), inside

    def sweep(self, tolerance: Fraction, bound: Bound | None, means: Execution) -> SweepOutcome:
        tasks = [self._task(tolerance, segment, bound) for segment in self.plan.segments]
        return _run_tasks(search_segment, tasks, self.question, tolerance, means)


class _BySums:
    """Division of a search for reverted trains by the sum of the counts of a stage, which is equal in all stages."""

    many = False

    def __init__(self, question: StageProblem) -> None:
        self.question = question

    def start(self) -> Fraction:
        """Return a tolerance within which about four times the requested number of reverted trains is expected."""
        question = self.question
        stages = (len(stages_of(question, total)) for total in sums_of(question))
        number = sum(multisets(count, question.stages) for count in stages if count)
        # width of the range of the logarithm of the ratio
        span = question.stages * log(question.top[-1] * question.beneath[-1] / question.top[0] / question.beneath[0])
        return rounded_up(min(4 * question.best * max(span, 1e-3) / max(number, 1), 1.0))

    def check(self, tolerance: Fraction) -> None:
        """Accept every tolerance, because there are few reverted trains."""

    def pilot(self, tolerance: Fraction) -> Bound | None:
        """Return None, because the segments are small and need no initial bound."""
        del tolerance
        return None

    def widened_pilot(self) -> Bound | None:
        """Return None, because the segments are small."""
        return None

    def sweep(self, tolerance: Fraction, bound: Bound | None, means: Execution) -> SweepOutcome:
        del bound
        question = replace(self.question, tolerance=tolerance)
        # four and more stages are slow, so eight sums are one task; fewer stages are one task in all
        sums, step = sums_of(question), 8 if question.stages > 3 else 1 << 40
        plain = question.plain()
        tasks = [
            {"question": plain, "low": low, "high": min(low + step, sums.stop)}
            for low in range(sums.start, sums.stop, min(step, len(sums)))
        ]
        return _run_tasks(search_sums, tasks, question, tolerance, means)


def _search_for(question: StageProblem) -> _ByProducts | _BySums:
    return _BySums(question) if question.fit.reverted and not question.fit.internal else _ByProducts(question)


def _run_tasks(
    work: Callable[[Any], dict[str, Any]],
    tasks: list[Any],
    question: StageProblem,
    tolerance: Fraction,
    means: Execution,
) -> SweepOutcome:
    """Search all segments and merge their results. After a keyboard interrupt return the results obtained so far."""
    # a single task runs in this process, without the overhead of an executor
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
