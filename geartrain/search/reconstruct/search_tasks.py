"""Independent tasks of the search, which enumerate topologies and count their trains, and an estimate of their time."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate
from math import floor, log10
from random import Random
from time import perf_counter
from typing import Any, NamedTuple

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts, AddedCountSums, OpenCounts
from geartrain.search.reconstruct.arbor_orders import CountTokens, MeshFacts, arranged
from geartrain.search.reconstruct.path_choice import PathChoice
from geartrain.search.reconstruct.path_lists import PathList
from geartrain.search.reconstruct.path_trees import PathTrees
from geartrain.search.reconstruct.quotient_tables import QuotientTables
from geartrain.search.reconstruct.reconstruction_problem import (
    Arbor,
    PlacedWheel,
    ReconstructionProblem,
)
from geartrain.search.reconstruct.train_topology import TOPOLOGIES, AddedKind, Topology
from geartrain.search.weighted_alternatives import draw_index

QUICK = 2
"""Maximum number of added wheels for which a search is not divided into parts."""
_PARTS = 24  # divides evenly over 2, 3, 4, 6, 8 and 12 processes
_SAMPLES = {4096: 3, 512: 4, 64: 5}
"""Number of parts to time, by the number of parts of the search. Fewer, larger parts are timed until the time is
measurable.
"""
_ENOUGH = 0.3
"""Minimum total time of a sample for each number of added wheels [s]."""
_MOST_CHOICES = 40
"""Maximum decimal logarithm of the number of choices of added tooth counts; searches of hours have about 20."""
_MOST_ADDED = 100  # numbers of added wheels are stored in 8 bits
_YEAR = 3.2e7  # s
_LONGEST = 100 * _YEAR
"""Maximum expected time in one process [s]. Longer searches are refused."""
_GOLDEN = (5**0.5 - 1) / 2
"""Golden ratio conjugate. The fractional parts of its multiples are evenly distributed, and select the timed parts."""

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
    """Sums over the trains of the topologies of a problem, and random draws from them."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        limits = problem.additions
        self.counts = AddedCountSums(AddedCounts(limits.minimum, limits.maximum))
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

    def draw(self, topology: Topology, probability: Random) -> Arbor:
        """Draw one of the trains of a topology with equal probability."""
        parts = self.parts(topology)
        part = parts[draw_index([part.trains for part in parts], probability)]
        arbor = probability.choice(part.orders)
        kinds, requested, counts = self.kinds(topology, arbor), part.open, dict[int, int]()
        for token in _tokens(arbor):
            counts[token], requested = self.counts.draw(requested, kinds[token], probability)
        return _with_counts(arbor, counts)


def _tokens(arbor: Arbor) -> Iterator[int]:
    own = [wheel for wheel, _ in arbor.drives] + ([] if arbor.driven is None else [arbor.driven])
    yield from (wheel.teeth for wheel in own if wheel.name is None)
    for _, child in arbor.driven_arbors():
        yield from _tokens(child)


def _with_counts(arbor: Arbor, counts: Mapping[int, int]) -> Arbor:
    def counted(wheel: PlacedWheel) -> PlacedWheel:
        return wheel if wheel.name is not None else PlacedWheel(None, counts[wheel.teeth])

    drives = ((counted(wheel), tuple(_with_counts(one, counts) for one in below)) for wheel, below in arbor.drives)
    passes = tuple(_with_counts(one, counts) for one in arbor.passes)
    driven = None if arbor.driven is None else counted(arbor.driven)
    return Arbor(arbor.name, driven, arbor.dials, tuple(drives), passes)


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


def topology_tasks(problem: ReconstructionProblem) -> list[TopologyTask]:
    """Return all parts of the search, in ascending order of the number of added wheels."""
    return [
        TopologyTask(problem, added, part, parts)
        for added in range(problem.additions.wheels + 1)
        for parts in [1 if added <= QUICK else _PARTS]
        for part in range(parts)
    ]


def count_topologies(
    problem: ReconstructionProblem, execution: Execution | None = None
) -> Iterator[tuple[TopologyTask, list[CountedTopology]]]:
    """Yield each part of the search with its topologies."""
    tasks = topology_tasks(problem)
    answers = (execution or Execution()).run(_counted, tasks)
    for task, answer in zip(tasks, answers, strict=True):
        yield task, [CountedTopology(TOPOLOGIES.validate_python(plain), own, trains) for plain, own, trains in answer]


def total_paths(problem: ReconstructionProblem) -> dict[str, int]:
    """Return the number of possible paths to each dial."""
    paths = _search(problem).paths
    return {dial.name: len(paths[dial.name]) for dial in problem.dials}


def timed_part(task: TopologyTask) -> float:
    """Run one part of the search and return its time [s]."""
    start = perf_counter()
    _counted(task)
    return perf_counter() - start


def _counted(task: TopologyTask) -> list[tuple[Any, int, int]]:
    """Return the topologies of one part of the search as plain data, each with its numbers of choices and of trains."""
    counted = _search(task.problem).counted(task)
    return [(TOPOLOGIES.dump_python(each.topology, mode="json"), each.choices, each.solutions) for each in counted]


@lru_cache(maxsize=2)
def _search(problem: ReconstructionProblem) -> TopologySearch:
    """Return the search of a problem. Its path lists are built once per process."""
    return TopologySearch(problem)


# ------------------------------------------------------- the time of a search, extrapolated from a sample of its tasks


def rough(seconds: float) -> float:
    """Round a time to one digit; return 0 for less than one second, which is not reported.

    >>> rough(27.4), rough(0.7)
    (30.0, 0.0)
    """
    return float(round(seconds, -floor(log10(seconds)))) if seconds >= 1 else 0.0


@dataclass(frozen=True, slots=True)
class ExpectedCost(Result):
    """Expected cost of a search, estimated from a sample of its parts."""

    KEYS = ("paths", Key("seconds", "whole", to=rough))

    paths: dict[str, int]
    """Number of possible paths from the input to each dial, with the maximum number of added wheels."""
    seconds: tuple[float, ...]
    """Expected time in one process for each number of added wheels [s], accurate to a factor of about three.

    It is 0 up to two added wheels, where nothing is timed. It excludes the comparison of the listed trains.
    """
    parts: int
    """Number of parts into which the search was divided for timing, the maximum over all numbers of added wheels; 0 if
    nothing was timed.
    """

    @property
    def whole(self) -> float:
        """Total expected time in one process [s]."""
        return sum(self.seconds)


def expect_cost(problem: ReconstructionProblem) -> ExpectedCost:
    """Estimate the cost of a problem. Its path lists are cached for the search in this process.

    Raise `QuestionError` if there are too many paths, or if the search would take more than a hundred years.
    """
    _refuse_absurd(problem)
    parted = dict.fromkeys(task.added for task in topology_tasks(problem) if task.parts > 1)
    timed: dict[int, tuple[int, float]] = {}
    for added in parted if all(total_paths(problem).values()) else ():
        timed[added] = _sampled(problem, added)
        _refuse_endless(problem, [seconds for _, seconds in timed.values()])
    seconds = tuple(timed[added][1] if added in timed else 0.0 for added in range(problem.additions.wheels + 1))
    parts = max((parts for parts, _ in timed.values()), default=0)
    return ExpectedCost(total_paths(problem), seconds, parts)


def count_choices(problem: ReconstructionProblem) -> float:
    """Return the decimal logarithm of the number of choices of tooth counts for the maximum number of added wheels."""
    added = problem.additions
    return added.wheels * log10(max(added.maximum - added.minimum + 1, 1))


def _refuse_absurd(problem: ReconstructionProblem) -> None:
    """Raise `QuestionError` before the search if there are more choices of tooth counts than any search can cover."""
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


def _refuse_endless(problem: ReconstructionProblem, seconds: Sequence[float]) -> None:
    """Raise `QuestionError` if the expected time, extrapolated by the ratio of the last two times, exceeds `_LONGEST`.

    seconds   times [s] for increasing numbers of added wheels, from the first number that is timed
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
            f"a search with up to {most} added wheels would take about 1e{longest - log10(_YEAR):.0f} years",
            f"in one process {last} added wheels take about {rough(seconds[-1]) or 1:g} s, and each further "
            f"wheel takes {growth:.2g} times as long",
            f"add at most {max(fits, last)} wheels, with -k or in `reconstruct: {{add: {{wheels: ...}}}}`",
        )
    )


def _sampled(problem: ReconstructionProblem, added: int) -> tuple[int, float]:
    """Return the number of parts into which the search was divided for timing, and the extrapolated total time [s]."""
    parts, whole = 0, 0.0
    for parts, samples in _SAMPLES.items():
        # an index outside the range gives an empty part, which measures the fixed cost of every part
        alone = timed_part(TopologyTask(problem, added, parts, parts))
        chosen = (int(_GOLDEN * number % 1 * parts) for number in range(1, samples + 1))
        own = sum(timed_part(TopologyTask(problem, added, part, parts)) - alone for part in chosen)
        whole = alone + parts * max(0.0, own) / samples
        if own >= _ENOUGH:
            break
    return parts, whole


def done_shares(problem: ReconstructionProblem, expected: ExpectedCost) -> tuple[float, ...]:
    """Return the expected fraction of the total time after 0, 1, 2, ... completed tasks."""
    done = list(accumulate(_weights(problem, expected), initial=0.0))
    return tuple(each / done[-1] for each in done)


def _weights(problem: ReconstructionProblem, expected: ExpectedCost) -> Iterator[float]:
    """Yield the expected time of each task [s], which is always positive."""
    # parts that were not timed advance the progress a little
    minimum = 1e-3 * expected.whole + 1e-6
    yield from (minimum + expected.seconds[task.added] / task.parts for task in topology_tasks(problem))
