"""Search for all topologies, in independent tasks: paths to all dials, their trees, and the trains of each tree.

`PathChoice` chooses one path for each dial, `PathTrees` combines them to topologies, and `TopologyTrains` counts the
trains of a topology.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache, reduce
from itertools import cycle
from math import log10
from operator import or_
from typing import Any, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.arrays import Bools
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts, OpenCounts, QuotientTables
from geartrain.search.reconstruct.arbor_orders import CountTokens, arranged
from geartrain.search.reconstruct.path_lists import PathList, Rows
from geartrain.search.reconstruct.path_trees import PathTrees
from geartrain.search.reconstruct.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.search.reconstruct.train_topology import TOPOLOGIES, AddedKind, Topology

_QUICK = 2
"""Maximum number of added wheels for which the search is not divided into parts."""
_PARTS = 24  # divides evenly over 2, 3, 4, 6, 8 and 12 processes
_MOST_CHOICES = 24
"""Maximum decimal logarithm of the number of choices of tooth counts for added wheels. For searches that take hours,
this logarithm is about 20.
"""
_MOST_ADDED = 100  # numbers of added wheels are stored in 8 bits

# Backtracking search for one path to every dial, such that all of them are paths of one train.
#
# Bit masks represent shared arbors and wheels. After each choice only paths of the other dials remain that are
# compatible with all chosen ones, and the dial with the fewest paths is next.
#
# The distance between two dials is the number of added wheels on exactly one of their paths. A table of quotients gives
# a lower bound of it, and thus of the number of added wheels on two paths.


class PathColumns:
    """Paths to one dial as arrays, so that many of them can be compared with one path to another dial in one step.

    A pass is the pair of a driven and a driving wheel by which a path passes through an arbor. A row is a path.

    codes          number of the pass; 0 if the path avoids the arbor; shape (arbors, rows)
    driven         number that identifies the driven wheel and its tooth count; 0 if the path avoids the arbor; shape
                   (arbors, rows)
    driver         number that identifies the surviving driving wheel; 0 if there is none; shape (arbors, rows)
    used           bit mask for each row: bits of the surviving arbors on the path, followed by bits of the surviving
                   wheels that the path uses
    """

    def __init__(self, paths: PathList, problem: ReconstructionProblem) -> None:
        self.paths = paths
        names = [wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels]
        number = {None: 0} | {name: at for at, name in enumerate(names, 1)}  # an added wheel has no name
        bits = [0, *(1 << (len(problem.arbors) + at) for at in range(len(names)))]
        # one row per arbor, because an arbor is compared for many paths at once
        self.codes = np.ascontiguousarray(paths.codes.T)
        self.driven = np.zeros(self.codes.shape, dtype=np.int16)
        self.driver = np.zeros(self.codes.shape, dtype=np.int16)
        self.used = paths.arbors.copy()
        for at, passes in enumerate(paths.passes):
            taken = self.codes[at]
            # the numbers of driven wheels are the same in the lists of all dials
            kinds = sorted({each.driven for each in passes}, key=repr)
            self.driven[at] = np.array([0, *(1 + kinds.index(each.driven) for each in passes)], dtype=np.int16)[taken]
            pairs = [
                [0 if wheel is None else number[wheel.name] for wheel in (each.driven, each.driver)] for each in passes
            ]
            self.driver[at] = np.array([0, *(driver for _, driver in pairs)], dtype=np.int16)[taken]
            used = [0, *(bits[driven] | bits[driver] for driven, driver in pairs)]
            self.used |= np.array(used, dtype=np.int64)[taken]

    def fit(self, rows: Rows, other: PathColumns, row: int) -> Bools:
        """Return whether each path can be in the same tree as a given path to another dial.

        Two paths must enter every common arbor by the same wheel with the same tooth count. They may leave only one
        common arbor by different wheels, the arbor at which they separate. Paths that separate at the input arbor have
        no other common arbor.
        """
        both: Rows = np.asarray(self.paths.arbors[rows] & other.paths.arbors[row])
        good = np.ones(len(rows), dtype=bool)
        parted = np.zeros(len(rows), dtype=np.int8)
        for at in np.flatnonzero(other.codes[:, row]).tolist():
            codes = self.codes[at][rows]
            left = (codes > 0) & (codes != other.codes[at, row])
            parted += left
            good &= (codes == 0) | (self.driven[at][rows] == other.driven[at, row])
            driver = other.driver[at, row]
            if driver:
                good &= ~(left & (self.driver[at][rows] == driver))
            if not at:
                good &= ~left | (both == 0)
        return good & (parted <= 1)


Choice = dict[str, int]
"""Chosen path for each dial, given as a row of the path list of the dial."""

_EVEN_SHARES = 50
"""Minimum number of paths to a dial for which these paths are distributed cyclically over the parts of a search."""


class PathChoice:
    """Enumeration of all compatible choices of one path for each dial.

    lists   list of the possible paths to each dial
    """

    def __init__(self, problem: ReconstructionProblem, lists: Mapping[str, PathList], tables: QuotientTables) -> None:
        self.problem, self.lists, self.tables = problem, lists, tables
        # surviving arbors and wheels that must be used, as a bit mask like `PathColumns.used`
        wheels = sum(len(each.wheels) for each in (problem.input, *problem.arbors))
        required = {"some": 0, "arbors": len(problem.arbors), "wheels": len(problem.arbors) + wheels}
        self._must = (1 << required[problem.use]) - 1
        self._columns = {dial: PathColumns(paths, problem) for dial, paths in lists.items()}

    def choices(self, added: int, part: int = 0, parts: int = 1) -> Iterator[Choice]:
        """Yield all choices of one path for each dial that give trains with exactly `added` added wheels. If the search
        is divided into `parts` parts, only the choices of the part with index `part` are yielded.
        """
        self._added = added
        lists = {dial: np.flatnonzero(paths.wheels <= added) for dial, paths in self.lists.items()}
        yield from self._extended({}, lists, cycle(at == part for at in range(parts)))

    def _extended(self, chosen: Choice, lists: dict[str, Rows], share: Iterator[bool] | None) -> Iterator[Choice]:
        """Yield all choices that consist of the chosen paths and of paths to the remaining dials.

        share   iterator that yields, for each path, whether it belongs to this part of the search; None if the paths to
                an earlier dial were distributed over the parts
        """
        dial = min(lists, key=lambda each: len(lists[each]))  # most constrained dial first
        rows = lists[dial]
        others = {other: some for other, some in lists.items() if other != dial}
        if not others:
            used = reduce(or_, (int(self._columns[each].used[at]) for each, at in chosen.items()), 0)
            rows = rows[np.int64(self._must & ~used) & ~self._columns[dial].used[rows] == 0]
        # few paths are not distributed evenly; the paths to the next dial are distributed then
        own = share if not others or len(rows) >= _EVEN_SHARES else None
        for row in rows.tolist():
            if own is not None and not next(own):
                continue
            if not others:
                yield {**chosen, dial: row}
            elif (kept := self._fitting(dial, row, others, chosen)) is not None:
                yield from self._extended({**chosen, dial: row}, kept, None if own else share)

    def _fitting(self, dial: str, row: int, lists: Mapping[str, Rows], chosen: Choice) -> dict[str, Rows] | None:
        """Return the paths to each remaining dial that are compatible with the additional path `row` to `dial`; None if
        there is no such path to one of these dials.
        """
        kept = {}
        for other, rows in sorted(lists.items(), key=lambda each: len(each[1])):
            rows = rows[self._columns[other].fit(rows, self._columns[dial], row)]
            for path in chosen.items():
                rows = rows[self._fork(path, (dial, row), other, rows)]
            far = self._distances(dial, row, other, rows)
            near = self.lists[dial].wheels[row] + self.lists[other].wheels[rows] + far <= 2 * self._added
            kept[other] = rows[near]
            if not len(kept[other]):
                return None
        return kept

    def _fork(self, one: tuple[str, int], other: tuple[str, int], dial: str, rows: Rows) -> Bools:
        """Return, for each path in `rows`, whether one tree can contain it together with two chosen paths. This
        requires that two of the three paths separate from the third at the same arbor.
        """
        first, second = (np.int64(self.lists[end].arbors[row]) for end, row in (one, other))
        third = self.lists[dial].arbors[rows]
        in_all = first & second & third
        on_first, on_second, apart = (first & third) == in_all, (second & third) == in_all, (first & second) == in_all
        return np.asarray((on_first & on_second) | (on_first & apart) | (on_second & apart))

    def _distances(self, end: str, row: int, dial: str, rows: Rows) -> Rows:
        """Return, for each path in `rows`, a lower bound of the number of added wheels that belong to only one of two
        paths: this path and the chosen path to the dial `end`.
        """
        first, second = self.lists[end], self.lists[dial]
        (low, high), (minimum, maximum) = first.bounds, second.bounds
        with np.errstate(divide="ignore", invalid="ignore"):  # the speed of a dial may be 0
            fewest = self.tables.fewest((minimum[rows] / high[row], maximum[rows] / low[row]))
        if self.problem.idlers:  # the count of an added idler at which paths separate affects only one of them
            return np.maximum(fewest.astype(np.int64) - 1, 0)
        # shared wheels are on both paths, so the distance has the parity of the sum
        return np.asarray(fewest + (first.wheels[row] + second.wheels[rows] - fewest) % 2, dtype=np.int64)


# The trains of a topology as products of orders of arbors and choices of tooth counts. Orders and counts are
# independent unless rings limit the counts in some orders. The orders are therefore partitioned by these limits.


class OrderPart(NamedTuple):
    """Orders of the arbors of one topology that all permit the same choices of added tooth counts.

    Each combination of an order and a choice is one train.
    """

    open: OpenCounts
    choices: int
    orders: list[tuple[Arbor, dict[int, AddedKind]]]
    """One train for each order, in which negative numbers (tokens) replace the tooth counts of added wheels; with the
    kind of each added wheel, keyed by token.
    """

    @property
    def trains(self) -> int:
        """Number of trains: number of choices times number of orders."""
        return self.choices * len(self.orders)


class TopologyTrains:
    """Counter of the trains of each topology of a reconstruction problem. A train is a topology with an order of its
    arbors and with tooth counts of its added wheels.
    """

    def __init__(self, problem: ReconstructionProblem) -> None:
        limits = problem.additions
        self.counts = AddedCounts(limits.minimum, limits.maximum)
        self._problem = problem

    def parts(self, topology: Topology) -> list[OrderPart]:
        """Return the orders of the arbors of a topology, grouped by the tooth-count limits that rings impose."""
        tokens = CountTokens(topology.added)
        by_limits: dict[OpenCounts, list[tuple[Arbor, dict[int, AddedKind]]]] = defaultdict(list)
        for arbor in arranged(topology, tokens.counts, tokens.idle, self._problem):
            kinds = tokens.kinds(arbor, self._problem.rings, self._problem.additions.maximum)
            limits = sorted(kind for kind in kinds.values() if kind.most is not None)
            by_limits[OpenCounts(topology.added, topology.wanted, tuple(limits))].append((arbor, kinds))
        return [OrderPart(requested, self.counts.total(requested), orders) for requested, orders in by_limits.items()]


# All topologies that can explain the dials, with their numbers of choices of added counts. Paths are chosen for all
# dials and combined to trees.


class TopologySearch:
    """Enumeration of all topologies of a problem, with the number of trains of each topology.

    paths   list of the possible paths to each dial
    """

    def __init__(self, problem: ReconstructionProblem) -> None:
        tables = QuotientTables(problem.additions.minimum, problem.additions.maximum)
        dials = sorted(problem.dials, key=lambda dial: dial.name)
        self.paths = {dial.name: PathList(dial, problem, tables) for dial in dials}
        self._choice, self._trees = PathChoice(problem, self.paths, tables), PathTrees(problem, self.paths)
        self._trains = TopologyTrains(problem)

    def counted(self, task: TopologyTask) -> Iterator[CountedTopology]:
        """Yield the topologies of one task that have at least one train, with their numbers of choices and trains."""
        for chosen in self._choice.choices(task.added, task.part, task.parts):
            for topology in self._trees.topologies(chosen, task.added):
                choices = self._trains.counts.total(OpenCounts(topology.added, topology.wanted))
                if choices and (trains := sum(part.trains for part in self._trains.parts(topology))):
                    yield CountedTopology(topology, choices, trains)


# Independent parts of the search for topologies, which any process can run.


@dataclass(frozen=True)
class CountedTopology:
    """Topology with its number of choices of added tooth counts and its number of trains. Both numbers are positive."""

    topology: Topology
    choices: int
    solutions: int


class TopologyTask(NamedTuple):
    """Task of a search: one of several parts of the search for the topologies that have a given number of added
    wheels.
    """

    problem: ReconstructionProblem
    added: int
    part: int
    parts: int


_search = lru_cache(maxsize=2)(TopologySearch)  # the path lists of a problem are built once per process


def count_topologies(
    problem: ReconstructionProblem, execution: Execution | None = None
) -> Iterator[tuple[TopologyTask, list[CountedTopology]]]:
    """Yield each part of the search with its topologies, in ascending order of the number of added wheels.

    `QuestionError` is raised if there are more choices of tooth counts than a search can cover.
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
    """Return the topologies of one task as plain data, each with its number of choices of tooth counts and its number
    of trains.
    """
    counted = _search(task.problem).counted(task)
    return [(TOPOLOGIES.dump_python(each.topology, mode="json"), each.choices, each.solutions) for each in counted]


def log_choices(problem: ReconstructionProblem) -> float:
    """Return the decimal logarithm of the number of choices of tooth counts, for the maximum number of added wheels."""
    added = problem.additions
    return added.wheels * log10(max(added.maximum - added.minimum + 1, 1))


def _refuse_absurd(problem: ReconstructionProblem) -> None:
    added, size = problem.additions, log_choices(problem)
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
