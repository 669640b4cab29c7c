"""Every skeleton that may explain the dials, with its number of choices of added counts.

Paths are chosen for all dials, and put together to trees.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from geartrain.synthesis.reconstruction.added_count_sums import AddedCountSums, OpenCounts
from geartrain.synthesis.reconstruction.path_choice import PathChoice
from geartrain.synthesis.reconstruction.path_lists import PathList
from geartrain.synthesis.reconstruction.path_trees import PathTrees
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Skeleton


class SkeletonSearch:
    """All skeletons of a question with a given number of added wheels.

    Parameters
    ----------
    counts : AddedCountSums
        By which choices of counts are counted.
    """

    def __init__(self, problem: ReconstructionProblem, counts: AddedCountSums) -> None:
        self.problem, self._counts = problem, counts
        self._keys = QuotientKeys(problem.additions.least, problem.additions.greatest)

    @cached_property
    def paths(self) -> dict[str, PathList]:
        """By dial, the list of its paths."""
        dials = sorted(self.problem.dials, key=lambda dial: dial.name)
        return {dial.name: PathList(dial, self.problem, self._keys) for dial in dials}

    @cached_property
    def _by_paths(self) -> tuple[PathChoice, PathTrees]:
        return PathChoice(self.problem, self.paths, self._keys), PathTrees(self.problem, self.paths)

    def skeletons(self, added: int, part: int = 0, parts: int = 1) -> Iterator[tuple[Skeleton, int]]:
        """All skeletons with just so many added wheels that have choices, and how many; of several parts one."""
        choice, trees = self._by_paths
        for chosen in choice.choices(added, part, parts):
            for skeleton in trees.skeletons(chosen, added):
                choices = self._counts.total(OpenCounts(skeleton.added, skeleton.wanted))
                if choices:
                    yield skeleton, choices
