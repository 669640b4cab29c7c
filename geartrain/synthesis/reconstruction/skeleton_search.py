"""Every skeleton that may explain the dials: paths are chosen for all of them, and put together to trees."""

from __future__ import annotations

from collections.abc import Iterator

from geartrain.synthesis.reconstruction.path_choice import PathChoice
from geartrain.synthesis.reconstruction.path_lists import PathList
from geartrain.synthesis.reconstruction.path_trees import PathTrees
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Skeleton


class SkeletonSearch:
    """All skeletons of a question with a given number of added wheels."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        keys = QuotientKeys(problem.additions.least, problem.additions.greatest)
        dials = sorted(problem.dials, key=lambda dial: dial.name)
        self.paths = {dial.name: PathList(dial, problem, keys) for dial in dials}
        self._choice = PathChoice(problem, self.paths, keys)
        self._trees = PathTrees(problem, self.paths)

    def skeletons(self, added: int, part: int = 0, parts: int = 1) -> Iterator[Skeleton]:
        """All skeletons with just so many added wheels; of several parts one."""
        for choice in self._choice.choices(added, part, parts):
            yield from self._trees.skeletons(choice, added)
