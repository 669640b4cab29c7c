"""Independent tasks of the search, which enumerate topologies and count their trains."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import log10
from typing import Any, NamedTuple

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts, OpenCounts
from geartrain.search.reconstruct.arbor_orders import CountTokens, MeshFacts, arranged
from geartrain.search.reconstruct.path_choice import PathChoice
from geartrain.search.reconstruct.path_lists import PathList
from geartrain.search.reconstruct.path_trees import PathTrees
from geartrain.search.reconstruct.quotient_tables import QuotientTables
from geartrain.search.reconstruct.reconstruction_problem import (
    Arbor,
    ReconstructionProblem,
)
from geartrain.search.reconstruct.train_topology import TOPOLOGIES, AddedKind, Topology

_QUICK = 2
"""Maximum number of added wheels for which a search is not divided into parts."""
_PARTS = 24  # divides evenly over 2, 3, 4, 6, 8 and 12 processes
_MOST_CHOICES = 24
"""Maximum decimal logarithm of the number of choices of added tooth counts; searches of hours have about 20."""
_MOST_ADDED = 100  # numbers of added wheels are stored in 8 bits

# The trains of a topology as products of orders of arbors and choices of tooth counts. Orders and counts are
# independent unless rings limit the counts in some orders. The orders are therefore partitioned by these limits.


class OrderPart(NamedTuple):
    """Orders of the arbors of a topology that have the same choices of added tooth counts.

    Each order with each choice is one train.
    """

    open: OpenCounts
    choices: int
    orders: list[Arbor]
    """Trains with tokens instead of the tooth counts of added wheels, one for each order."""

    @property
    def trains(self) -> int:
        """Number of trains."""
        return self.choices * len(self.orders)


class TopologyTrains:
    """Sums over the trains of the topologies of a problem."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        limits = problem.additions
        self.counts = AddedCounts(limits.minimum, limits.maximum)
        self._facts, self._maximum = MeshFacts.of(problem), limits.maximum

    def count(self, topology: Topology) -> int:
        """Count the trains of a topology."""
        return sum(part.trains for part in self.parts(topology))

    def parts(self, topology: Topology) -> list[OrderPart]:
        """Partition the trains of a topology by the tooth-count limits that rings impose."""
        tokens = CountTokens(topology.added)
        by_limits: dict[OpenCounts, list[Arbor]] = defaultdict(list)
        for arbor in arranged(topology, tokens.counts, tokens.idle, self._facts):
            limits = (kind for kind in self.kinds(topology, arbor).values() if kind.most is not None)
            by_limits[OpenCounts(topology.added, topology.wanted, tuple(sorted(limits)))].append(arbor)
        return [OrderPart(requested, self.counts.total(requested), arbors) for requested, arbors in by_limits.items()]

    def kinds(self, topology: Topology, arbor: Arbor) -> dict[int, AddedKind]:
        """Return the kind of each added wheel in one order of the arbors, by the token that replaces its tooth
        count.
        """
        return CountTokens(topology.added).kinds(arbor, self._facts.rings, self._maximum)


# All topologies that can explain the dials, with their numbers of choices of added counts. Paths are chosen for all
# dials and combined to trees.


class TopologySearch:
    """Enumeration of all topologies of a problem, with the numbers of their trains.

    paths   list of the paths to each dial
    """

    def __init__(self, problem: ReconstructionProblem) -> None:
        tables = QuotientTables(problem.additions.minimum, problem.additions.maximum)
        dials = sorted(problem.dials, key=lambda dial: dial.name)
        self.paths = {dial.name: PathList(dial, problem, tables) for dial in dials}
        self._choice, self._trees = PathChoice(problem, self.paths, tables), PathTrees(problem, self.paths)
        self._trains = TopologyTrains(problem)

    def counted(self, task: TopologyTask) -> Iterator[CountedTopology]:
        """Yield the topologies of one part of the search that have trains."""
        for chosen in self._choice.choices(task.added, task.part, task.parts):
            for topology in self._trees.topologies(chosen, task.added):
                choices = self._trains.counts.total(OpenCounts(topology.added, topology.wanted))
                if choices and (trains := self._trains.count(topology)):
                    yield CountedTopology(topology, choices, trains)


# Independent parts of the search for topologies, which any process can run.


@dataclass(frozen=True)
class CountedTopology:
    """Topology with its number of choices of added tooth counts and its number of trains, both positive."""

    topology: Topology
    choices: int
    solutions: int


class TopologyTask(NamedTuple):
    """One part of the search with a given number of added wheels."""

    problem: ReconstructionProblem
    added: int
    part: int
    parts: int


def count_topologies(
    problem: ReconstructionProblem, execution: Execution | None = None
) -> Iterator[tuple[TopologyTask, list[CountedTopology]]]:
    """Yield each part of the search with its topologies, in ascending order of the number of added wheels.

    Raise `QuestionError` if there are more choices of tooth counts than any search can cover.
    """
    _refuse_absurd(problem)
    _search(problem)  # built before the tasks, which may seem long enough for further processes otherwise
    tasks = [
        TopologyTask(problem, added, part, parts)
        for added in range(problem.additions.wheels + 1)
        for parts in [1 if added <= _QUICK else _PARTS]
        for part in range(parts)
    ]
    answers = (execution or Execution()).run(_counted, tasks)
    for task, answer in zip(tasks, answers, strict=True):
        yield task, [CountedTopology(TOPOLOGIES.validate_python(plain), own, trains) for plain, own, trains in answer]


def _counted(task: TopologyTask) -> list[tuple[Any, int, int]]:
    """Return the topologies of one part of the search as plain data, each with its numbers of choices and of trains."""
    counted = _search(task.problem).counted(task)
    return [(TOPOLOGIES.dump_python(each.topology, mode="json"), each.choices, each.solutions) for each in counted]


@lru_cache(maxsize=2)
def _search(problem: ReconstructionProblem) -> TopologySearch:
    """Return the search of a problem. Its path lists are built once per process."""
    return TopologySearch(problem)


def count_choices(problem: ReconstructionProblem) -> float:
    """Return the decimal logarithm of the number of choices of tooth counts for the maximum number of added wheels."""
    added = problem.additions
    return added.wheels * log10(max(added.maximum - added.minimum + 1, 1))


def _refuse_absurd(problem: ReconstructionProblem) -> None:
    added, size = problem.additions, count_choices(problem)
    fits = min(_MOST_ADDED, int(added.wheels * _MOST_CHOICES / size) if size else _MOST_ADDED)
    if added.wheels <= fits:
        return
    what = f"up to {added.wheels} added wheels of {added.minimum} to {added.maximum} teeth"
    why = f"a search supports up to {_MOST_ADDED} added wheels"
    fix = f"add at most {fits} wheels: `-k {fits}` or `reconstruct: {{add: {{wheels: {fits}}}}}`"
    if size > _MOST_CHOICES:
        what = f"{what} have 1e{size:.0f} combinations"
        why = f"a search supports up to 1e{_MOST_CHOICES} combinations"
        fix = f"{fix}; or narrow `teeth`"
    raise QuestionError(Problem(what, why, fix))
