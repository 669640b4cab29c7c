"""One pass of a search over a part of a train: its requirements as a join, divided into tasks, and run.

If there are very many assignments only the best are kept, by exact errors.
"""

from __future__ import annotations

import pickle
import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache, partial
from math import ceil, prod
from typing import Any, cast

import numpy as np

from geartrain.numerics.arrays import Ints
from geartrain.numerics.bounded_polynomials import WholeTerm
from geartrain.numerics.work import Journal, run
from geartrain.search.constraints.count_conditions import CountConstraint
from geartrain.search.integer_columns import distinct_quotients
from geartrain.search.join.exact_join import AssignmentColumns, BudgetSpentError, ExactJoin
from geartrain.search.join.join_plan import JoinProblem, PlanNode, SelectivitySample, find_join_problem
from geartrain.search.join.product_lists import Domains, Tallies
from geartrain.search.join.wheel_monomials import IntervalConstraint, quotients
from geartrain.search.train.output_requirements import OutputRequirement, SearchPart
from geartrain.search.train.train_findings import Assignment, By

_SMALL = 3e6
"""Number of steps below which a pass is one task; it takes about a second."""
_MOST_TASKS = 100_000  # maximum number of tasks of a pass
_SAMPLED = 16
"""Number of tasks of a random sample."""
_POOL = 20_000
"""Number of stored assignments above which all but the best are discarded."""

Task = dict[str, Any]
"""Argument of `do_task`, plain data."""


def cut(question: JoinProblem, limit: float) -> tuple[list[Task], float]:
    """Return the tasks of a pass, and the fraction of the pass that they cover, below 1 if the limit of steps is
    exceeded.

    Tasks are runs of the values of the first variable, and of its child in the plan if the first has few values. If the
    limit is exceeded, the tasks are a random sample with a fixed seed.
    """
    if question.steps <= _SMALL <= limit:
        return [{"parts": [[question.plan.item, 0, 1]], "budget": limit, "pieces": 1}], 1.0
    sampled = question.steps > limit
    wanted = question.steps * _SAMPLED / limit if sampled else question.steps / _SMALL
    chain = _chain(question, min(wanted, _MOST_TASKS))
    number = prod(of for _, of in chain)
    # twice the share of a task, because tasks are uneven
    budget = 2 * limit / _SAMPLED if sampled else limit
    chosen: Sequence[int] = range(number)
    if sampled and number > _SAMPLED:
        # fixed seed, so that results are deterministic
        chosen = sorted(random.Random(0).sample(range(number), _SAMPLED))
    tasks = [{"parts": _digits(at, chain), "budget": budget, "pieces": 16} for at in chosen]
    return tasks, len(tasks) / number if sampled else 1.0


def _chain(question: JoinProblem, wanted: float) -> list[tuple[int, int]]:
    """Return variables from the root downwards, each with the number of runs into which its values are divided.

    The product of these numbers is about `wanted`.
    """
    node: PlanNode | None = question.plan
    found: list[tuple[int, int]] = []
    while node is not None and (wanted > 1 or not found):
        recipe = question.recipes[node.item]
        runs = int(min(max(ceil(wanted), 1), quotients(recipe.top, recipe.bottom, question.domains)))
        found.append((node.item, runs))
        wanted /= runs
        node = node.children[0] if len(node.children) == 1 and len(found) < 2 else None
    return found


def _digits(number: int, chain: Sequence[tuple[int, int]]) -> list[list[int]]:
    parts = []
    for item, of in chain:
        number, at = divmod(number, of)
        parts.append([item, at, of])
    return parts


@dataclass(frozen=True, slots=True)
class PassWork:
    """Data that all tasks of one pass share: the join problem, the order of solutions, and the limit of the list."""

    question: JoinProblem
    """Join problem of the pass."""
    order: AssignmentOrder
    """Order of the list of the best."""
    most: int
    """Maximum number of assignments that one task may enumerate to list the best."""

    def packed(self) -> bytes:
        """Return the data pickled for a worker process."""
        return pickle.dumps(self)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[PassWork, ExactJoin]:
    # unpickled once per process and pass, not once per task
    work = pickle.loads(packed)
    assert isinstance(work, PassWork)
    return work, ExactJoin(work.question)


def do_task(packed: bytes, task: Mapping[str, Any]) -> dict[str, Any]:
    """Run one task of a search, which covers a part of the values of some variables.

    task   `parts`: [[item, number, of], ...], part `number` of `of` equal parts of the values of a variable; `budget`:
           maximum number of steps; `pieces`: number of pieces, so that the results of finished pieces remain if the
           budget is exceeded

    The result has the keys `count`, `removed` (one number for each constraint), `listed` (True if `best` is complete),
    `best` (counts in the order of the wheels), `steps`, and `cut` (True if the budget was exceeded).
    """
    work, join = _unpacked(packed)
    total: dict[str, Any] = {"count": 0, "removed": [0] * len(work.question.reasons), "listed": True, "cut": False}
    pool, spent = BestAssignments(work.order, work.question.wheels), 0
    for slices in _slices(join, task["parts"], task["pieces"]):
        join.cut(slices, task["budget"] - spent)
        try:
            found = _do_piece(work, join, pool, total["count"])
        except BudgetSpentError:
            total["cut"] = True
            break
        finally:
            spent += join.steps
        total["count"] += found["count"]
        total["removed"] = [a + b for a, b in zip(total["removed"], found["removed"], strict=True)]
        total["listed"] &= found["listed"]
    return total | {"best": pool.best() if total["listed"] else [], "steps": spent}


def _slices(join: ExactJoin, parts: Sequence[Sequence[int]], pieces: int) -> Iterator[dict[int, tuple[int, int]]]:
    """Yield the runs of values of a task, with the run of the first variable divided into pieces."""
    runs = {item: (len(join.items[item]) * at // of, len(join.items[item]) * (at + 1) // of) for item, at, of in parts}
    item = parts[0][0]
    first, last = runs[item]
    step = max(1, -(-(last - first) // pieces))
    if all(start < end for start, end in runs.values()):
        for start in range(first, last, step):
            yield runs | {item: (start, min(start + step, last))}


def _do_piece(work: PassWork, join: ExactJoin, pool: BestAssignments, before: int) -> dict[str, Any]:
    """Count the assignments of a piece. Enumerate them only if they are to be listed or tested by late constraints."""
    question = work.question
    counts, gone = join.count(question.plan, join.start())
    count = int(counts[0])
    removed = [int(gone[at][0]) if at in gone else 0 for at in range(len(question.reasons))]
    listed = before + count <= work.most
    # late constraints can be tested only on complete assignments
    if question.late or listed:
        count = 0
        for rows in join.stream((question.plan,), join.start()):
            for columns in join.wheels(rows):
                columns = _late(question, columns, removed)
                count += len(next(iter(columns.values())))
                pool.add(columns)
        listed = True
    return {"count": count, "removed": removed, "listed": listed}


def _late(question: JoinProblem, columns: AssignmentColumns, removed: list[int]) -> AssignmentColumns:
    """Return the assignments that satisfy the late constraints, which are not part of the join. The numbers of
    rejected assignments are added to `removed`.
    """
    number = len(question.reasons) - len(question.late)
    for at, rule in enumerate(question.late, number):
        met = rule.holds(columns)
        removed[at] += int((~met).sum())
        columns = {wheel: column[met] for wheel, column in columns.items()}
    return columns


@dataclass(frozen=True, slots=True)
class PassTally:
    """Sum of the results of the tasks of a pass."""

    count: int
    """Number of assignments that satisfy all requirements."""
    removed: tuple[int, ...]
    """Number of assignments that each constraint rejected."""
    best: tuple[Assignment, ...]
    """Best assignments, best first."""
    listed: bool
    """False if there were too many assignments to enumerate; `best` is then empty."""
    cut: bool
    """True if a task exceeded its budget."""
    stopped: bool
    """True if the run was interrupted; the other fields include only finished tasks."""


def merged(work: PassWork, results: Iterable[Mapping[str, Any]]) -> PassTally:
    """Return the sum of the results of tasks; after a keyboard interrupt, the sum so far."""
    count, listed, cut, stopped = 0, True, False, False
    removed = [0] * len(work.question.reasons)
    pool = BestAssignments(work.order, work.question.wheels)
    try:
        for result in results:
            count += result["count"]
            removed = [a + b for a, b in zip(removed, result["removed"], strict=True)]
            listed, cut = listed and result["listed"], cut or result["cut"]
            if result["best"]:
                pool.add(dict(zip(pool.wheels, np.array(result["best"], dtype=np.int64).T, strict=True)))
    except KeyboardInterrupt:
        stopped = True
    found = (dict(zip(pool.wheels, counts, strict=True)) for counts in (pool.best() if listed else ()))
    best = tuple(one for teeth in found if (one := work.order.assignment(teeth)) is not None)
    return PassTally(count, tuple(removed), best, listed, cut, stopped)


NOTHING = PassTally(0, (), (), True, False, True)
"""Result of a pass that was not started because the search was interrupted."""

Tell = Callable[[int, int], None]


@dataclass
class PassRunner:
    """Execution of the tasks of all passes: executor, journal of finished tasks, progress function.

    Several passes share a journal, in which their tasks are numbered consecutively.
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: Tell | None = None
    done: int = 0
    stopped: bool = False

    def run(self, work: PassWork, tasks: Sequence[Task]) -> PassTally:
        """Run the tasks of a pass and return the sum of their results; an empty result if an earlier pass was
        interrupted.
        """
        if self.stopped:
            return NOTHING
        journal = None if self.journal is None else cast(Journal, _Section(self.journal, self.done))
        before, tell = self.done, self.tell
        # tasks of later passes have higher numbers in the journal
        self.done += len(tasks)

        def told(done: int, total: int) -> None:
            if tell is not None:
                tell(before + done, before + total)

        tally = merged(work, run(partial(do_task, work.packed()), tasks, self.executor, journal, told))
        self.stopped = tally.stopped
        return tally

    def release(self) -> None:
        """Remove executor, journal and progress function, so that later computations run in this process."""
        self.executor = self.journal = self.tell = None
        self.stopped = False


class _Section:
    """View of a journal in which task numbers are shifted by an offset."""

    def __init__(self, journal: Journal, offset: int) -> None:
        self._journal, self._offset = journal, offset

    @property
    def closed(self) -> bool:
        return self._journal.closed

    def recall(self, task: int, mark: str = "") -> str | None:
        return self._journal.recall(task + self._offset, mark)

    def keep(self, task: int, mark: str, text: str) -> None:
        self._journal.keep(task + self._offset, mark, text)


@dataclass(frozen=True, slots=True)
class PassResult:
    """Result of one pass of a search: the counts, the best assignments, and the fraction of the assignments
    searched.
    """

    share: Fraction | None
    """Common relative tolerance of the pass; None without a common tolerance."""
    searched: float
    """Fraction of the assignments that the tasks cover: below 1 for a random sample, 0 if the pass was not
    started.
    """
    tally: PassTally
    """Counts and the best assignments."""
    reasons: tuple[str, ...] = ()
    """Names of the constraints that reject assignments, in the order of `tally.removed`."""
    order: tuple[int, ...] = ()
    """Indices of the reasons in the order in which they are evaluated."""
    steps: float = 0.0
    """Estimated number of partial assignments to examine."""

    @property
    def complete(self) -> bool:
        """True if every assignment was considered."""
        return self.searched == 1 and not self.tally.cut and not self.tally.stopped

    @property
    def removed(self) -> dict[str, int]:
        """Number of assignments rejected for each reason, in the order of evaluation."""
        found: dict[str, int] = {}
        for at in self.order:
            reason = self.reasons[at]
            found[reason] = found.get(reason, 0) + (self.tally.removed[at] if self.tally.removed else 0)
        return found


NOT_BEGUN = PassResult(None, 0.0, NOTHING)
"""Result of a pass that was not started because of an interrupt."""


@dataclass
class PartSearch:
    """Search of one part of a train in several passes."""

    part: SearchPart
    order: AssignmentOrder
    runner: PassRunner
    limit: float
    """Maximum number of partial assignments that one pass may examine."""
    removed_first: tuple[tuple[str, int], ...] = field(init=False)
    domains: Domains = field(init=False)
    rules: tuple[CountConstraint, ...] = field(init=False)
    _sample: SelectivitySample | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        """Apply the constraints on single wheels to their counts."""
        domains: Domains = self.part.domains
        alone = []
        for rule in self.part.rules:
            if len(rule.wheels) == 1:
                narrowed = narrow(domains, rule)
                alone.append((rule.name, size_of(domains) - size_of(narrowed)))
                domains = narrowed  # later constraints are counted on what is left
        self.removed_first, self.domains = tuple(alone), domains
        self.rules = tuple(rule for rule in self.part.rules if len(rule.wheels) > 1)

    @property
    def sample(self) -> SelectivitySample:
        """Random sample of assignments, used to estimate probabilities."""
        if self._sample is None:
            self._sample = SelectivitySample.of(self.domains)
        return self._sample

    def without(self, *, rule: str = "", requirement: OutputRequirement | None = None) -> PartSearch:
        """Return the search without the constraints of this name, or without this requirement on an output."""
        part = replace(
            self.part,
            rules=tuple(one for one in self.part.rules if one.name != rule),
            requirements=tuple(one for one in self.part.requirements if one is not requirement),
        )
        return PartSearch(part, self.order, self.runner, self.limit)

    def requested(self, share: Fraction | None, strict: bool = False) -> tuple[IntervalConstraint, ...]:
        """Return all interval constraints of a pass with relative tolerance `share`."""
        found = [requirement.requested(share, strict) for requirement in self.part.requirements]
        return (*self.part.conditions, *(one for one in found if one is not None))

    def probabilities(self, requested: Sequence[IntervalConstraint]) -> dict[str, float]:
        """Estimate the fraction of assignments that satisfies each constraint and each requirement."""
        probabilities = {rule.name: self.sample.of_rule(rule) for rule in self.rules}
        return probabilities | {one.name: self.sample.of_demand(one) for one in requested}

    def run(self, share: Fraction | None, most: float, *, strict: bool = False) -> PassResult:
        """Run one pass: count all solutions, and list the best if there are at most `most`.

        share    common relative tolerance of graded requirements
        strict   True to exclude the ends of intervals
        """
        if not size_of(self.domains):
            return PassResult(share, 1.0, PassTally(0, (), (), True, False, False))
        requested = self.requested(share, strict)
        question = find_join_problem(self.domains, requested, self.rules, self.probabilities(requested))
        tasks, searched = cut(question, self.limit)
        # `most` may be infinite
        work = PassWork(question, self.order, int(min(most, 1 << 62)))
        tally = self.runner.run(work, tasks)
        return PassResult(share, searched, tally, question.reasons, question.order, question.steps)


def size_of(domains: Domains) -> int:
    """Return the number of assignments, the product of the numbers of counts."""
    return prod(len(counts) for counts in domains.values())


def narrow(domains: Domains, rule: CountConstraint) -> Domains:
    """Return the domains with the counts of one wheel restricted by a constraint on this wheel."""
    (wheel,) = rule.wheels
    counts = domains[wheel]
    if not counts:
        return domains
    met = rule.holds({wheel: np.array(counts, dtype=np.int64)})
    return {**domains, wheel: tuple(count for count, good in zip(counts, met.tolist(), strict=True) if good)}


# --------------------------------------------------- the best of many assignments: bounds in floats, exact errors


@dataclass(frozen=True, slots=True)
class AssignmentOrder:
    """Total order of the assignments of tooth counts, by a criterion and then by error, total, largest count and
    counts.
    """

    by: By
    """Primary criterion; ties are broken by error, total, largest count, and the counts in the order of the wheels."""
    best: int
    """Number of assignments to keep."""
    requirements: tuple[OutputRequirement, ...]
    """Outputs whose errors are compared."""
    declared: Mapping[str, int]
    """Declared tooth count of each wheel that has one."""

    @property
    def level(self) -> bool:
        """True if all solutions have error 0, because every admissible interval of every output is a single speed."""
        return all(requirement.exact for requirement in self.requirements)

    def assignment(self, teeth: Mapping[str, int]) -> Assignment | None:
        """Return the assignment with the speeds of all outputs; None if an output has no speed."""
        outputs = {}
        for requirement in self.requirements:
            speed = requirement.function.value(teeth)
            if speed is None:
                return None
            outputs[requirement.name] = requirement.reached(speed)
        changed = tuple(wheel for wheel, count in teeth.items() if self.declared.get(wheel, count) != count)
        return Assignment(dict(teeth), outputs, changed)

    def first(self, columns: AssignmentColumns) -> Ints:
        """Return the primary criterion of each assignment (smaller is better), shape (n,); 0 for the error, which
        `ranks` compares.
        """
        table = np.stack(list(columns.values()))
        if self.by == "total":
            return np.asarray(table.sum(axis=0))
        if self.by == "largest":
            return np.asarray(table.max(axis=0))
        if self.by == "distinct":
            steps = np.diff(np.sort(table, axis=0), axis=0)
            return np.asarray(1 + (steps != 0).sum(axis=0))
        if self.by == "change":
            changes = [column != self.declared[wheel] for wheel, column in columns.items() if wheel in self.declared]
            return np.asarray(sum(changes, np.zeros(table.shape[1], dtype=np.int64)))
        return np.zeros(table.shape[1], dtype=np.int64)

    def ranks(self, columns: AssignmentColumns) -> Ints:
        """Return integer ranks by the maximum absolute error, compared exactly. Equal errors have equal ranks."""
        found = np.zeros(len(next(iter(columns.values()))), dtype=np.int64)
        if self.level:
            return found
        exact = [_exact_errors(requirement, columns) for requirement in self.requirements]
        rank = {error: at for at, error in enumerate(sorted({error for errors, _ in exact for error in errors}))}
        for errors, which in exact:
            found = np.maximum(found, np.array([rank[error] for error in errors], dtype=np.int64)[which])
        return found


def _exact_errors(requirement: OutputRequirement, columns: AssignmentColumns) -> tuple[list[Fraction], Ints]:
    """Return the exact absolute error at each distinct speed of an output, and the index of each assignment's speed."""
    function = requirement.function
    above, below = (_whole(function.wheels, terms, columns) for terms in (function.numerator, function.denominator))
    speeds, which = distinct_quotients(above, below)
    return [abs(requirement.reached(speed).error) for speed in speeds], which


def _whole(wheels: Sequence[str], terms: Sequence[WholeTerm], columns: AssignmentColumns) -> Tallies:
    """Return the exact sum of some terms, as int64 if it fits, otherwise as Python integers."""
    most = {wheel: int(columns[wheel].max()) for wheel in wheels}
    bound = sum(
        abs(coefficient) * prod(most[wheel] ** power for wheel, power in zip(wheels, powers, strict=True))
        for coefficient, powers in terms
    )
    # the bound covers all partial sums, so int64 cannot overflow below it
    dtype: Any = np.int64 if bound < 1 << 62 else object
    total = np.zeros(len(next(iter(columns.values()))), dtype=dtype)
    for coefficient, powers in terms:
        term = np.full(len(total), coefficient, dtype=dtype)
        for wheel, power in zip(wheels, powers, strict=True):
            for _ in range(power):
                term = term * columns[wheel].astype(dtype)
        total = total + term
    return total


class BestAssignments:
    """List of the best of all assignments that are added, in bounded memory."""

    def __init__(self, order: AssignmentOrder, wheels: Sequence[str]) -> None:
        self.order, self.wheels = order, tuple(wheels)
        self._table: Ints = np.zeros((len(wheels), 0), dtype=np.int64)
        self._new: list[Ints] = []

    def add(self, columns: AssignmentColumns) -> None:
        """Add candidate assignments to the list."""
        self._new.append(np.stack([columns[wheel] for wheel in self.wheels]))
        if sum(table.shape[1] for table in self._new) > _POOL:
            self._gather()

    def best(self) -> list[list[int]]:
        """Return the counts of the best assignments, best first."""
        self._gather()
        found: list[list[int]] = self._table.T.tolist()
        return found

    def _gather(self) -> None:
        """Sort all candidates exactly, and discard all but the best."""
        table = np.concatenate([self._table, *self._new], axis=1)
        self._new = []
        if table.shape[1] > self.order.best:
            # errors are compared only among those that the primary criterion does not exclude
            first = self.order.first(dict(zip(self.wheels, table, strict=True)))
            table = table[:, first <= np.partition(first, self.order.best - 1)[self.order.best - 1]]
        if table.shape[1]:
            columns = dict(zip(self.wheels, table, strict=True))
            sizes = table.max(axis=0), table.sum(axis=0)
            # lexsort takes its last key first
            keys = (*table[::-1], *sizes, self.order.ranks(columns), self.order.first(columns))
            table = table[:, np.lexsort(keys)[: self.order.best]]
        self._table = table
