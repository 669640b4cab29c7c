"""All pieces of a search, here or by many, and the tolerance that proves the best found are the best there are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import log
from typing import Any

from geartrain.errors import Problem, RangeError
from geartrain.numerics.work import Execution
from geartrain.synthesis.ratio.product_windows import multisets
from geartrain.synthesis.ratio.ratio_windows import reach_of_errors, rounded_up
from geartrain.synthesis.ratio.reverted_stages import search_sums, stages_of, sums_of
from geartrain.synthesis.ratio.search_segments import SegmentPlan, lay_out, listed_by_value, search_segment, task_of
from geartrain.synthesis.ratio.solution_order import Key, key_of, merged
from geartrain.synthesis.ratio.stage_problem import StageProblem

Bound = tuple[int, Fraction, int]
_WIDER = 16  # times, from one tolerance to the next: all before the last cost little beside it
_ENOUGH = 2 * 10**9
"""Pairs of sets looked at one by one, after which a search without a tolerance is not widened any more."""
_MOST = 1e11
"""Pairs of sets that may have to be looked at one by one."""
_PILOT = Fraction(1, 100)  # |error| past which a first piece is not widened


@dataclass(frozen=True, slots=True)
class SweepOutcome:
    """What a sweep over all pieces found within `tolerance`.

    complete  every piece was searched
    note      why fewer were found than there may be
    """

    tolerance: Fraction
    count: int = 0
    removed: Mapping[str, int] = field(default_factory=dict)
    keys: Sequence[Key] = ()
    complete: bool = True
    note: str = ""

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
    least, most = reach_of_errors(question.value, *question.reach)
    start, bound = search.start(), search.widened_pilot()
    if bound:
        start = rounded_up(bound[1])
    while True:
        # the nearest ratio of all may be far away: the tolerance begins there
        tolerance = min(least + start, most)
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
    count, keys, complete = 0, list[Key](), True
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


def _keys(result: Mapping[str, Any], question: StageProblem) -> list[Key]:
    return [key_of(first, top, beneath, question.value) for first, top, beneath in result["rows"]]
