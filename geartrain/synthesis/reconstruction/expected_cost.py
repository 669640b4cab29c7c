"""What a search will cost, found by doing a little of it: a part in so many is timed, and multiplied."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import accumulate
from math import floor, log10
from time import perf_counter

from geartrain.numerics.plain_data import Key, Result
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeleton_tasks import (
    SkeletonTask,
    skeleton_tasks,
    timed_part,
    total_paths,
    total_placements,
)

_SAMPLES = {4096: 3, 512: 4, 64: 5}
"""One part in so many is timed, so many of them; then one in fewer, until that is long enough to judge by."""
_ENOUGH = 0.3
"""Seconds that are long enough, for each number of added wheels."""
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
        By dial, how many paths from the input to it are possible, with as many added wheels as may be. Empty where
        trains are searched as wholes, and not by paths.
    placements : int or None
        In how many ways as many wheels as may be added may be shared out among the paths to dials; None where paths are
        searched.
    seconds : tuple of float
        How long the search is expected to take in one process, by number of added wheels (s), good to a factor of
        three or so. 0 up to two added wheels, where nothing is timed. What trains are listed and compared comes on top.
    parts : int
        One part in so many of the search was timed; 0 if none was.
    """

    KEYS = ("paths", "placements", Key("seconds", "whole", to=rough))

    paths: dict[str, int]
    placements: int | None
    seconds: tuple[float, ...]
    parts: int

    @property
    def whole(self) -> float:
        """Seconds in all, in one process."""
        return sum(self.seconds)


def expect_cost(problem: ReconstructionProblem, clock: Callable[[], float] = perf_counter) -> ExpectedCost:
    """What a question will cost; the lists of its paths are made, and kept for the search in this process.

    Raises `QuestionError` if there are too many paths.
    """
    paths = total_paths(problem)
    parted = dict.fromkeys(task.added for task in skeleton_tasks(problem) if task.parts > 1 and all(paths.values()))
    timed = {added: _sampled(problem, added, clock) for added in parted}
    seconds = tuple(timed[added][1] if added in timed else 0.0 for added in range(problem.additions.wheels + 1))
    return ExpectedCost(
        paths, total_placements(problem), seconds, max((parts for parts, _ in timed.values()), default=0)
    )


def _sampled(problem: ReconstructionProblem, added: int, clock: Callable[[], float]) -> tuple[int, float]:
    """One part in how many was timed, and how long all of them would take (s)."""
    parts, whole = 0, 0.0
    for parts, samples in _SAMPLES.items():
        # a part that is none: what every part has to do before it comes to what is its own
        alone = timed_part(SkeletonTask(problem, added, parts, parts), clock)
        chosen = (int(_GOLDEN * number % 1 * parts) for number in range(1, samples + 1))
        own = sum(timed_part(SkeletonTask(problem, added, part, parts), clock) - alone for part in chosen)
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
    yield from (least + expected.seconds[task.added] / task.parts for task in skeleton_tasks(problem))
