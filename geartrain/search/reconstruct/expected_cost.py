"""Estimate of the time of a search from a random sample of its tasks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from math import floor, log10
from time import perf_counter

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.search_tasks import (
    QUICK,
    TopologyTask,
    timed_part,
    topology_tasks,
    total_paths,
)

_SAMPLES = {4096: 3, 512: 4, 64: 5}
"""One part in so many is timed, so many of them; then one in fewer, until that is long enough to judge by."""
_ENOUGH = 0.3
"""Seconds that are long enough, for each number of added wheels."""
_MOST_CHOICES = 40
"""Decimal logarithm of the most choices of counts of added wheels; searches of hours have some 1e20."""
_YEAR = 3.2e7  # s
_LONGEST = 100 * _YEAR
"""Seconds in one process; what takes longer is refused."""
_GOLDEN = (5**0.5 - 1) / 2
"""Its multiples lie evenly between whole numbers: which parts are timed."""


def rough(seconds: float) -> float:
    """Seconds to one digit; 0 below one, which is not worth telling.

    >>> rough(27.4), rough(0.7)
    (30.0, 0.0)
    """
    return float(round(seconds, -floor(log10(seconds)))) if seconds >= 1 else 0.0


@dataclass(frozen=True, slots=True)
class ExpectedCost(Result):
    """What the search will cost.

    Attributes
    ----------
    paths : dict of str to int
        By dial, how many paths from the input to it are possible, with as many added wheels as may be.
    seconds : tuple of float
        How long the search is expected to take in one process, by number of added wheels (s), good to a factor of
        three or so. 0 up to two added wheels, where nothing is timed. What trains are listed and compared comes on top.
    parts : int
        One part in so many of the search was timed; 0 if none was.
    """

    KEYS = ("paths", Key("seconds", "whole", to=rough))

    paths: dict[str, int]
    seconds: tuple[float, ...]
    parts: int

    @property
    def whole(self) -> float:
        """Seconds in all, in one process."""
        return sum(self.seconds)


def expect_cost(problem: ReconstructionProblem, clock: Callable[[], float] = perf_counter) -> ExpectedCost:
    """What a question will cost; the lists of its paths are made, and kept for the search in this process.

    Raises `QuestionError` if there are too many paths, or the search would not end within a hundred years.
    """
    _refuse_absurd(problem)
    parted = dict.fromkeys(task.added for task in topology_tasks(problem) if task.parts > 1)
    timed: dict[int, tuple[int, float]] = {}
    for added in parted if all(total_paths(problem).values()) else ():
        timed[added] = _sampled(problem, added, clock)
        _refuse_endless(problem, [seconds for _, seconds in timed.values()])
    seconds = tuple(timed[added][1] if added in timed else 0.0 for added in range(problem.additions.wheels + 1))
    parts = max((parts for parts, _ in timed.values()), default=0)
    return ExpectedCost(total_paths(problem), seconds, parts)


def count_choices(problem: ReconstructionProblem) -> float:
    """Decimal logarithm of the number of choices of the counts of as many wheels as may be added."""
    added = problem.additions
    return added.wheels * log10(max(added.greatest - added.least + 1, 1))


def _refuse_absurd(problem: ReconstructionProblem) -> None:
    """Raise `QuestionError` for more choices of counts than any search could look through, before anything is done."""
    added, size = problem.additions, count_choices(problem)
    if size <= _MOST_CHOICES:
        return
    fits = int(added.wheels * _MOST_CHOICES / size)
    raise QuestionError(
        Problem(
            f"up to {added.wheels} added wheels of {added.least} to {added.greatest} teeth have 1e{size:.0f} choices",
            f"a search takes up to 1e{_MOST_CHOICES}",
            f"ask for at most {fits} with -k, or in `reconstruct: {{add: {{wheels: ...}}}}`, or for fewer counts",
        )
    )


def _refuse_endless(problem: ReconstructionProblem, seconds: Sequence[float]) -> None:
    """Raise `QuestionError` where times that go on growing as the last two end beyond `_LONGEST`.

    seconds   by number of added wheels, from the first number that is timed on
    """
    last, most = QUICK + len(seconds), problem.additions.wheels
    if len(seconds) < 2 or seconds[-1] < _ENOUGH or seconds[-2] <= 0:
        return
    growth = seconds[-1] / seconds[-2]
    if growth <= 1:
        return
    longest = log10(seconds[-1]) + (most - last) * log10(growth)
    if longest <= log10(_LONGEST):
        return
    fits = last + floor((log10(_LONGEST) - log10(seconds[-1])) / log10(growth))
    raise QuestionError(
        Problem(
            f"up to {most} added wheels are asked for, which would take about 1e{longest - log10(_YEAR):.0f} years",
            f"in one process {last} added wheels take about {rough(seconds[-1]) or 1:g} s, and each one more "
            f"{growth:.2g} times as long",
            f"ask for at most {max(fits, last)} with -k, or in `reconstruct: {{add: {{wheels: ...}}}}`",
        )
    )


def _sampled(problem: ReconstructionProblem, added: int, clock: Callable[[], float]) -> tuple[int, float]:
    """One part in how many was timed, and how long all of them would take (s)."""
    parts, whole = 0, 0.0
    for parts, samples in _SAMPLES.items():
        # a part that is none: what every part has to do before it comes to what is its own
        alone = timed_part(TopologyTask(problem, added, parts, parts), clock)
        chosen = (int(_GOLDEN * number % 1 * parts) for number in range(1, samples + 1))
        own = sum(timed_part(TopologyTask(problem, added, part, parts), clock) - alone for part in chosen)
        whole = alone + parts * max(0.0, own) / samples
        if own >= _ENOUGH:
            break
    return parts, whole


def done_shares(problem: ReconstructionProblem, expected: ExpectedCost) -> tuple[float, ...]:
    """By number of tasks that are done, from none on, the share of the whole time that they are expected to take."""
    done = list(accumulate(_weights(problem, expected), initial=0.0))
    return tuple(each / done[-1] for each in done)


def _weights(problem: ReconstructionProblem, expected: ExpectedCost) -> Iterator[float]:
    """What each task takes, none of them nothing."""
    least = 1e-3 * expected.whole + 1e-6
    yield from (least + expected.seconds[task.added] / task.parts for task in topology_tasks(problem))
