"""One pass of a search over a part of a train. The pass is formulated as a join, which is divided into tasks and
executed.

If there are very many assignments, only the best assignments are kept. Their errors are compared exactly.
"""

from __future__ import annotations

import pickle
import random
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
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
from geartrain.search.join.join_plan import JoinProblem, PlanNode, find_join_problem
from geartrain.search.join.product_lists import Domains, Tallies, forecast
from geartrain.search.train.output_requirements import OutputRequirement, SearchPart
from geartrain.search.train.train_findings import Assignment, By

_SMALL = 3e6
"""Number of steps up to which a pass is not divided into tasks. This number of steps takes about a second."""
_MOST_TASKS = 100_000  # maximum number of tasks of a pass
_SAMPLED = 16
"""Number of tasks in a random sample of the tasks of a pass."""
_POOL = 20_000
"""Number of stored assignments above which all but the best assignments are discarded."""

Task = dict[str, Any]
"""One task of a pass as plain data. It is the argument of `do_task`."""


def cut(question: JoinProblem, limit: float) -> tuple[list[Task], float]:
    """Divide a join into tasks. Return the tasks, and the fraction of all assignments that they cover, which is below 1
    if the join needs more than `limit` steps (examined partial assignments).

    A task covers an interval of the values of the first variable and, if this variable has few values, of the next
    variable in the plan. If the limit is exceeded, the tasks are a random sample with a fixed seed.
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
    """Return the first one or two variables that the join assigns, each with the number of intervals into which its
    values are divided. The product of these numbers is about `wanted`.
    """
    node: PlanNode | None = question.plan
    found: list[tuple[int, int]] = []
    while node is not None and (wanted > 1 or not found):
        runs = min(max(ceil(wanted), 1), forecast(question.recipes[node.item], question.domains)[0])
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


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[ExactJoin, AssignmentOrder, int]:
    # unpickled once per process and pass, not once per task
    question, order, most = pickle.loads(packed)
    return ExactJoin(question), order, most


def do_task(packed: bytes, task: Mapping[str, Any]) -> dict[str, Any]:
    """Run one task of a pass. A task covers a part of the values of one or two variables.

    packed   pickled join problem, order of the solutions, and maximum number of assignments that are enumerated for the
             list
    task     mapping with three keys. `parts`: list of [item, number, of], which selects part `number` of `of` equal
             parts of the values of variable `item`; `budget`: maximum number of steps; `pieces`: number of pieces into
             which the task is divided, so that results of finished pieces are kept if the budget is exceeded

    The result has the keys `count` (number of solutions), `removed` (number of rejected assignments for each
    constraint), `listed` (True if `best` is complete), `best` (tooth counts in the order of the wheels), `steps`, and
    `cut` (True if the budget was exceeded).
    """
    join, order, most = _unpacked(packed)
    count, spent, listed, cut = 0, 0, True, False
    removed: Counter[str] = Counter()
    pool = BestAssignments(order, join.question.wheels)
    for slices in _slices(join, task["parts"], task["pieces"]):
        join.cut(slices, task["budget"] - spent)
        try:
            number, gone, enumerated = _do_piece(join, pool, most - count)
        except BudgetSpentError:
            cut = True
            break
        finally:
            spent += join.steps
        count += number
        removed.update(gone)
        listed &= enumerated
    best = pool.best() if listed else []
    return {"count": count, "removed": removed, "listed": listed, "best": best, "steps": spent, "cut": cut}


def _slices(join: ExactJoin, parts: Sequence[Sequence[int]], pieces: int) -> Iterator[dict[int, tuple[int, int]]]:
    """Yield the half-open index ranges of the values of all variables in `parts`, for each of about `pieces` pieces
    into which a task is divided. Only the range of the first variable differs between pieces.
    """
    runs = {item: (len(join.items[item]) * at // of, len(join.items[item]) * (at + 1) // of) for item, at, of in parts}
    item = parts[0][0]
    first, last = runs[item]
    step = max(1, -(-(last - first) // pieces))
    if all(start < end for start, end in runs.values()):
        for start in range(first, last, step):
            yield runs | {item: (start, min(start + step, last))}


def _do_piece(join: ExactJoin, pool: BestAssignments, most: int) -> tuple[int, Counter[str], bool]:
    """Count the assignments of tooth counts in one piece of a task that satisfy all constraints, and add them to the
    list `pool` of the best assignments. Return their number, the number of assignments that each constraint rejects,
    and whether the assignments were added.

    They are enumerated and added only if there are at most `most`, or if the join has constraints that are evaluated
    last.
    """
    question = join.question
    counts, gone = join.count(question.plan, join.start())
    count, removed = int(counts[0]), Counter[str]()
    for at, numbers in gone.items():
        removed[question.constraint_names[at]] += int(numbers[0])
    if not question.late and count > most:
        return count, removed, False
    count = 0
    for rows in join.stream((question.plan,), join.start()):
        for columns in join.wheels(rows):
            # late constraints are not part of the join, because their wheels would have to be separate variables
            for rule in question.late:
                met = rule.holds(columns)
                removed[rule.name] += int((~met).sum())
                columns = {wheel: column[met] for wheel, column in columns.items()}
            count += len(next(iter(columns.values())))
            pool.add(columns)
    return count, removed, True


@dataclass
class PassRunner:
    """Execution of the tasks of all passes, with an executor, a journal of finished tasks, and a progress function.

    Several passes share a journal, in which their tasks are numbered consecutively.
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: Callable[[int, int], None] | None = None
    done: int = 0
    stopped: bool = False

    def run(self, work: Callable[[Task], Any], tasks: Sequence[Task]) -> Iterator[Any]:
        """Yield the results of the tasks of a pass. After a keyboard interrupt, `stopped` is True and no further
        results are yielded.
        """
        if self.stopped:
            return
        journal = None if self.journal is None else cast(Journal, _Section(self.journal, self.done))
        before, tell = self.done, self.tell
        # tasks of later passes have higher numbers in the journal
        self.done += len(tasks)

        def report_progress(done: int, total: int) -> None:
            if tell is not None:
                tell(before + done, before + total)

        try:
            yield from run(work, tasks, self.executor, journal, report_progress)
        except KeyboardInterrupt:
            self.stopped = True


class _Section:
    """Adapter for a journal, which adds a constant offset to the numbers of all tasks."""

    def __init__(self, journal: Journal, offset: int) -> None:
        self._journal, self._offset = journal, offset

    @property
    def closed(self) -> bool:
        return self._journal.closed

    def recall(self, task: int, mark: str = "") -> str | None:
        return self._journal.recall(task + self._offset, mark)

    def keep(self, task: int, mark: str, text: str) -> None:
        self._journal.keep(task + self._offset, mark, text)


@dataclass(slots=True)
class PassResult:
    """Result of one pass, which searches a part of a train with a fixed tolerance: sums over its tasks, and the best
    assignments of tooth counts.
    """

    share: Fraction | None = None
    """Common relative tolerance of the outputs in this pass; None if there is no common tolerance."""
    searched: float = 1.0
    """Fraction of the assignments covered by the tasks. It is below 1 for a random sample of tasks."""
    steps: float = 0.0
    """Estimated number of partial assignments that are examined."""
    count: int = 0
    """Number of assignments that satisfy all requirements."""
    removed: dict[str, int] = field(default_factory=dict)
    """Number of assignments rejected by each constraint, keyed by the name of the constraint in the order of
    evaluation.
    """
    best: tuple[Assignment, ...] = ()
    """Best assignments in the order of the search criterion."""
    listed: bool = True
    """True if the assignments were enumerated; False if there were too many assignments, in which case `best` is
    empty.
    """
    cut: bool = False
    """True if a task exceeded its maximum number of steps."""
    stopped: bool = False
    """True if the pass was interrupted, so that the sums include only finished tasks."""

    @property
    def complete(self) -> bool:
        """True if every assignment was examined."""
        return self.searched == 1 and not self.cut and not self.stopped


@dataclass
class PartSearch:
    """Search of one part of a train in several passes with different tolerances. A part consists of varied wheels that
    are connected by outputs or constraints.
    """

    part: SearchPart
    order: AssignmentOrder
    runner: PassRunner
    limit: float
    """Maximum number of partial assignments that one pass may examine."""
    removed_first: tuple[tuple[str, int], ...] = field(init=False)
    domains: Domains = field(init=False)
    rules: tuple[CountConstraint, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Apply the constraints on single wheels to the admissible tooth counts of these wheels."""
        domains: Domains = self.part.domains
        alone = []
        for rule in self.part.rules:
            if len(rule.wheels) == 1:
                (wheel,) = rule.wheels
                counts = np.array(domains[wheel], dtype=np.int64)
                narrowed = {**domains, wheel: tuple(counts[rule.holds({wheel: counts})].tolist())}
                alone.append((rule.name, size_of(domains) - size_of(narrowed)))
                domains = narrowed  # later constraints are counted on what is left
        self.removed_first, self.domains = tuple(alone), domains
        self.rules = tuple(rule for rule in self.part.rules if len(rule.wheels) > 1)

    def without(self, *, rule: str = "", requirement: OutputRequirement | None = None) -> PartSearch:
        """Return the search without the constraints that have the name `rule`, or without the given requirement on an
        output.
        """
        part = replace(
            self.part,
            rules=tuple(one for one in self.part.rules if one.name != rule),
            requirements=tuple(one for one in self.part.requirements if one is not requirement),
        )
        return replace(self, part=part)

    def run(self, share: Fraction | None, most: float, *, strict: bool = False) -> PassResult:
        """Run one pass. All solutions are counted, and the best solutions are listed if there are at most `most`
        solutions.

        share    common relative tolerance of the outputs; None if there is no common tolerance
        strict   True to exclude the end points of the admissible intervals of speeds
        """
        if not size_of(self.domains):
            return PassResult(share)
        constraints = (requirement.requested(share, strict) for requirement in self.part.requirements)
        requested = (*self.part.conditions, *(one for one in constraints if one is not None))
        question = find_join_problem(self.domains, requested, self.rules)
        tasks, searched = cut(question, self.limit)
        # `most` may be infinite
        packed = pickle.dumps((question, self.order, int(min(most, 1 << 62))))
        removed = dict.fromkeys((question.constraint_names[at] for at in question.order), 0)
        found = PassResult(share, searched, question.steps, removed=removed)
        pool = BestAssignments(self.order, question.wheels)
        for result in self.runner.run(partial(do_task, packed), tasks):
            found.count += result["count"]
            for reason, number in result["removed"].items():
                removed[reason] += number
            found.listed, found.cut = found.listed and result["listed"], found.cut or result["cut"]
            if result["best"]:
                pool.add(dict(zip(pool.wheels, np.array(result["best"], dtype=np.int64).T, strict=True)))
        found.stopped = self.runner.stopped
        best = (self.order.assignment(dict(zip(pool.wheels, counts, strict=True))) for counts in pool.best())
        found.best = tuple(one for one in best if one is not None) if found.listed else ()
        return found


def size_of(domains: Domains) -> int:
    """Return the number of assignments of tooth counts, which is the product of the numbers of admissible tooth counts
    of all wheels.
    """
    return prod(len(counts) for counts in domains.values())


# --------------------------------------------------- the best of many assignments: bounds in floats, exact errors


@dataclass(frozen=True, slots=True)
class AssignmentOrder:
    """Total order of assignments of tooth counts: by a primary criterion, then by error, sum of tooth counts, largest
    tooth count and tooth counts.
    """

    by: By
    """Name of the primary criterion."""
    best: int
    """Number of assignments to be kept."""
    requirements: tuple[OutputRequirement, ...]
    """Outputs whose errors are compared."""
    declared: Mapping[str, int]
    """Declared tooth count of each wheel for which a tooth count is declared."""

    @property
    def only_exact(self) -> bool:
        """True if all solutions have the error 0, because the requirements of each output admit only single speeds."""
        return all(requirement.exact for requirement in self.requirements)

    def assignment(self, teeth: Mapping[str, int]) -> Assignment | None:
        """Return the assignment with the speeds of all outputs; None if the speed of an output is undetermined."""
        outputs = {}
        for requirement in self.requirements:
            speed = requirement.function.value(teeth)
            if speed is None:
                return None
            outputs[requirement.name] = requirement.reached(speed)
        changed = tuple(wheel for wheel, count in teeth.items() if self.declared.get(wheel, count) != count)
        return Assignment(dict(teeth), outputs, changed)

    def first(self, columns: AssignmentColumns) -> Ints:
        """Return the primary criterion of n assignments (smaller is better), shape (n,). It is 0 if the criterion is
        the error, which the method `ranks` compares.
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
        """Return integer ranks of assignments by their maximum absolute error, by exact comparison. Equal errors have
        equal ranks.
        """
        found = np.zeros(len(next(iter(columns.values()))), dtype=np.int64)
        if self.only_exact:
            return found
        exact = []
        for requirement in self.requirements:
            function = requirement.function
            terms = (_whole(function.wheels, each, columns) for each in (function.numerator, function.denominator))
            # the error of each distinct speed, and the index of the speed of each assignment
            speeds, which = distinct_quotients(*terms)
            exact.append(([abs(requirement.reached(speed).error) for speed in speeds], which))
        rank = {error: at for at, error in enumerate(sorted({error for errors, _ in exact for error in errors}))}
        for errors, which in exact:
            found = np.maximum(found, np.array([rank[error] for error in errors], dtype=np.int64)[which])
        return found


def _whole(wheels: Sequence[str], terms: Sequence[WholeTerm], columns: AssignmentColumns) -> Tallies:
    """Return the value of a polynomial in tooth counts for each assignment, as int64 if all values fit, or as Python
    integers if they do not.

    terms   terms of the polynomial: an integer coefficient, and the power of each wheel in the order of `wheels`
    """
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
    """List of the best assignments among all assignments that are added, in bounded memory."""

    def __init__(self, order: AssignmentOrder, wheels: Sequence[str]) -> None:
        self.order, self.wheels = order, tuple(wheels)
        self._table: Ints = np.zeros((len(wheels), 0), dtype=np.int64)
        self._new: list[Ints] = []

    def add(self, columns: AssignmentColumns) -> None:
        """Add candidate assignments of tooth counts to the list."""
        self._new.append(np.stack([columns[wheel] for wheel in self.wheels]))
        if sum(table.shape[1] for table in self._new) > _POOL:
            self._gather()

    def best(self) -> list[list[int]]:
        """Return the tooth counts of the best assignments, with the best assignment first."""
        self._gather()
        found: list[list[int]] = self._table.T.tolist()
        return found

    def _gather(self) -> None:
        """Sort all stored assignments exactly, and discard all but the best."""
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
