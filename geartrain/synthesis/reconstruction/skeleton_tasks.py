"""The search of skeletons in independent parts: each finds and counts some of them, in whichever process."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

from geartrain.numerics.work import Execution
from geartrain.synthesis.reconstruction.question_digest import question_digest
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeleton_search import SkeletonSearch
from geartrain.synthesis.reconstruction.skeleton_trains import SkeletonTrains
from geartrain.synthesis.reconstruction.skeletons import Skeleton, plain_skeleton, skeleton_of

QUICK = 2
"""Added wheels up to which a search is not worth parting."""
_PARTS = 24


@dataclass(frozen=True)
class CountedSkeleton:
    """A skeleton with its number of choices of the added wheels' counts, and how many trains it is; neither is 0."""

    skeleton: Skeleton
    choices: int
    mechanisms: int


class SkeletonTask(NamedTuple):
    """A part of the search with a given number of added wheels.

    most   choices of counts up to which skeletons are told; of more, only sums. None for no limit
    """

    problem: ReconstructionProblem
    added: int
    part: int
    parts: int
    most: int | None = None


class CountedPart(NamedTuple):
    """What a part of the search found.

    last        whether it is the last with so many added wheels
    skeletons   each with its trains
    weights     of trains of those that are not told, with their numbers
    """

    added: int
    last: bool
    skeletons: list[CountedSkeleton]
    weights: Counter[Fraction]


def skeleton_tasks(problem: ReconstructionProblem, most: int | None = None) -> list[SkeletonTask]:
    """All parts, those with few added wheels first."""
    return [
        SkeletonTask(problem, added, part, parts, most)
        for added in range(problem.additions.wheels + 1)
        for parts in [1 if added <= QUICK else _PARTS]
        for part in range(parts)
    ]


def count_skeletons(
    problem: ReconstructionProblem, execution: Execution | None = None, most: int | None = None
) -> Iterator[CountedPart]:
    """What each part of the search finds; with `most`, a part with more choices of counts than that only sums them."""
    tasks = skeleton_tasks(problem, most)
    answers = (execution or Execution()).run(_counted, tasks)
    for task, (answer, summed) in zip(tasks, answers, strict=True):
        found = [CountedSkeleton(skeleton_of(plain), own, trains) for plain, own, trains in answer]
        weights = Counter({Fraction(weight): mechanisms for weight, mechanisms in summed})
        yield CountedPart(task.added, task.part + 1 == task.parts, found, weights)


def total_paths(problem: ReconstructionProblem) -> dict[str, int]:
    """By dial, how many paths to it are possible; none where whole trees are searched."""
    search, _ = _search(question_digest(problem), problem)
    if search.whole_trees is not None:
        return {}
    return {dial.name: len(search.paths[dial.name]) for dial in problem.dials}


def total_placements(problem: ReconstructionProblem) -> int | None:
    """In how many ways the most wheels may be added to some dials, as paths to them; None where paths are searched."""
    search, _ = _search(question_digest(problem), problem)
    trees = search.whole_trees
    return None if trees is None else len(trees.trees.structures.of(problem.additions.wheels))


def timed_part(task: SkeletonTask, clock: Callable[[], float]) -> float:
    """How long a part of the search takes (s)."""
    start = clock()
    _counted(task)
    return clock() - start


def _counted(task: SkeletonTask) -> tuple[list[tuple[Any, int, int]], list[tuple[str, int]]]:
    """Skeletons as plain data, each with its choices and trains; or of many the weights, with numbers of trains."""
    search, trains = _search(question_digest(task.problem), task.problem)
    if task.most is not None and search.whole_trees is not None and trains.may_be_summed:
        solved = list(search.whole_trees.solved(task.added, task.part, task.parts))
        if sum(one.all_choices for one in solved) > task.most:
            weights = search.whole_trees.weights(solved)
            return [], [(str(weight), mechanisms) for weight, mechanisms in weights.items()]
        skeletons = [each for one in solved for each in search.whole_trees.skeletons(one)]
    else:
        skeletons = list(search.skeletons(task.added, task.part, task.parts))
    found = [(plain_skeleton(each), choices, number) for each, choices in skeletons if (number := trains.count(each))]
    return found, []


class _Known:
    """A question that is told from others by its digest alone, for it need not be hashable."""

    def __init__(self, digest: str, problem: ReconstructionProblem) -> None:
        self.digest, self.problem = digest, problem

    def __hash__(self) -> int:
        return hash(self.digest)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Known) and other.digest == self.digest


def _search(digest: str, problem: ReconstructionProblem) -> tuple[SkeletonSearch, SkeletonTrains]:
    return _made_search(_Known(digest, problem))


@lru_cache(maxsize=2)
def _made_search(known: _Known) -> tuple[SkeletonSearch, SkeletonTrains]:
    """Lists of paths are made once a process."""
    trains = SkeletonTrains(known.problem, [dial.name for dial in known.problem.dials])
    return SkeletonSearch(known.problem, trains.counts), trains
