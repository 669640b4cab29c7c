"""The search of skeletons in independent parts: each finds and counts some of them, in whichever process."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
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
    """A part of the search with a given number of added wheels."""

    problem: ReconstructionProblem
    added: int
    part: int
    parts: int


class CountedPart(NamedTuple):
    """What a part of the search found.

    last        whether it is the last with so many added wheels
    skeletons   each with its trains
    """

    added: int
    last: bool
    skeletons: list[CountedSkeleton]


def skeleton_tasks(problem: ReconstructionProblem) -> list[SkeletonTask]:
    """All parts, those with few added wheels first."""
    return [
        SkeletonTask(problem, added, part, parts)
        for added in range(problem.additions.wheels + 1)
        for parts in [1 if added <= QUICK else _PARTS]
        for part in range(parts)
    ]


def count_skeletons(problem: ReconstructionProblem, execution: Execution | None = None) -> Iterator[CountedPart]:
    """What each part of the search finds."""
    tasks = skeleton_tasks(problem)
    answers = (execution or Execution()).run(_counted, tasks)
    for task, answer in zip(tasks, answers, strict=True):
        found = [CountedSkeleton(skeleton_of(plain), own, trains) for plain, own, trains in answer]
        yield CountedPart(task.added, task.part + 1 == task.parts, found)


def total_paths(problem: ReconstructionProblem) -> dict[str, int]:
    """By dial, how many paths to it are possible."""
    search, _ = _search(question_digest(problem), problem)
    return {dial.name: len(search.paths[dial.name]) for dial in problem.dials}


def timed_part(task: SkeletonTask, clock: Callable[[], float]) -> float:
    """How long a part of the search takes (s)."""
    start = clock()
    _counted(task)
    return clock() - start


def _counted(task: SkeletonTask) -> list[tuple[Any, int, int]]:
    """Skeletons as plain data, each with its choices and trains."""
    search, trains = _search(question_digest(task.problem), task.problem)
    skeletons = search.skeletons(task.added, task.part, task.parts)
    return [(plain_skeleton(each), choices, number) for each, choices in skeletons if (number := trains.count(each))]


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
