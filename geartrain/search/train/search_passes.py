"""One pass of a search over a part: its requirements as a join, planned, cut into tasks, and run.

Of very many assignments the best are kept: bounds in floats drop most others, exact errors order the rest.
"""

from __future__ import annotations

import pickle
import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache, partial
from math import ceil, inf, prod
from typing import Any, cast

import numpy as np

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.bounded_polynomials import BoundedQuotient, WholeTerm, products_of
from geartrain.numerics.exact import as_float
from geartrain.numerics.work import Journal, run
from geartrain.search.constraints.count_conditions import CountConstraint
from geartrain.search.integer_columns import distinct_quotients
from geartrain.search.join.exact_join import AssignmentColumns, BudgetSpentError, ExactJoin
from geartrain.search.join.join_plan import JoinProblem, PlanNode, SelectivitySample, find_join_problem
from geartrain.search.join.polynomial_constraints import ROUNDING
from geartrain.search.join.product_lists import Domains, Tallies
from geartrain.search.join.wheel_monomials import IntervalConstraint, quotients
from geartrain.search.train.output_requirements import OutputRequirement, SearchPart
from geartrain.search.train.train_findings import Assignment, By

_SMALL = 3e6
"""Steps below which a pass is one task: about a second."""
_MOST_TASKS = 100_000
_SAMPLED = 16
"""Tasks of a sample."""
_POOL = 20_000
"""Assignments that a pool holds before it is sorted out."""

Task = dict[str, Any]
"""What `do_task` takes."""


def cut(question: JoinProblem, limit: float) -> tuple[list[Task], float]:
    """A pass cut into tasks, and the part of it they are: less than 1 where all would pass the limit.

    Tasks are runs of the values of the first item, and of the next one below where the first has few. A sample is
    drawn always alike.
    """
    if question.steps <= _SMALL <= limit:
        return [{"parts": [[question.plan.item, 0, 1]], "budget": limit, "pieces": 1}], 1.0
    sampled = question.steps > limit
    wanted = question.steps * _SAMPLED / limit if sampled else question.steps / _SMALL
    chain = _chain(question, min(wanted, _MOST_TASKS))
    number = prod(of for _, of in chain)
    # twice its share, for tasks are uneven
    budget = 2 * limit / _SAMPLED if sampled else limit
    chosen: Sequence[int] = range(number)
    if sampled and number > _SAMPLED:
        # always the same sample, so that a question has one answer
        chosen = sorted(random.Random(0).sample(range(number), _SAMPLED))
    tasks = [{"parts": _digits(at, chain), "budget": budget, "pieces": 16} for at in chosen]
    return tasks, len(tasks) / number if sampled else 1.0


def _chain(question: JoinProblem, wanted: float) -> list[tuple[int, int]]:
    """Items from the root down, each with the number of runs its values are cut into; about `wanted` together."""
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
    """What all tasks of one pass share."""

    question: JoinProblem
    """To be answered."""
    order: AssignmentOrder
    """Of what is listed."""
    most: int
    """Assignments that one task may bring out to list the best of them."""

    def packed(self) -> bytes:
        """As a worker takes it."""
        return pickle.dumps(self)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[PassWork, ExactJoin]:
    work = pickle.loads(packed)
    assert isinstance(work, PassWork)
    return work, ExactJoin(work.question)


def do_task(packed: bytes, task: Mapping[str, Any]) -> dict[str, Any]:
    """One piece of a search: a part of the values of some items.

    task   `parts`: [[item, number, of], ...], the part with this number of so many; `budget`: steps it may take;
           `pieces`: into how many it is cut, so that not all is lost when the budget ends
    Returns `count`, `removed` (one number for each constraint), `listed` (whether `best` holds the best), `best`
    (counts in the order of the wheels), `steps`, and `cut` (whether the budget ended it).
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
    """The runs of values that some parts are, the first of them cut into pieces."""
    runs = {item: (len(join.items[item]) * at // of, len(join.items[item]) * (at + 1) // of) for item, at, of in parts}
    item = parts[0][0]
    first, last = runs[item]
    step = max(1, -(-(last - first) // pieces))
    if all(start < end for start, end in runs.values()):
        for start in range(first, last, step):
            yield runs | {item: (start, min(start + step, last))}


def _do_piece(work: PassWork, join: ExactJoin, pool: BestAssignments, before: int) -> dict[str, Any]:
    """Count; then bring out what is to be listed, or what late rules must see."""
    question = work.question
    counts, gone = join.count(question.plan, join.start())
    count = int(counts[0])
    removed = [int(gone[at][0]) if at in gone else 0 for at in range(len(question.reasons))]
    listed = before + count <= work.most
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
    """The assignments that the late rules let pass."""
    number = len(question.reasons) - len(question.late)
    for at, rule in enumerate(question.late, number):
        met = rule.holds(columns)
        removed[at] += int((~met).sum())
        columns = {wheel: column[met] for wheel, column in columns.items()}
    return columns


@dataclass(frozen=True, slots=True)
class PassTally:
    """What the tasks of a pass came to."""

    count: int
    """Assignments that meet everything."""
    removed: tuple[int, ...]
    """For each constraint, how many it refused."""
    best: tuple[Assignment, ...]
    """The best, best first."""
    listed: bool
    """False if there were too many to bring out: `best` is then empty."""
    cut: bool
    """True if a task spent its budget."""
    stopped: bool
    """True if the run was interrupted: the rest is of the tasks that were done."""


def merged(work: PassWork, results: Iterable[Mapping[str, Any]]) -> PassTally:
    """Add up the results of tasks; an interrupt ends the sum, not the search."""
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
"""What a pass comes to that was not begun, because the search was interrupted."""

Tell = Callable[[int, int], None]


@dataclass
class PassRunner:
    """How the tasks of all passes are run: executor, journal of finished tasks, report of progress.

    Several passes share a journal: each begins where the last one ended.
    """

    executor: Executor | None = None
    journal: Journal | None = None
    tell: Tell | None = None
    done: int = 0
    stopped: bool = False

    def run(self, work: PassWork, tasks: Sequence[Task]) -> PassTally:
        """Do the tasks of a pass. After an interrupt nothing more is done."""
        if self.stopped:
            return NOTHING
        journal = None if self.journal is None else cast(Journal, _Section(self.journal, self.done))
        before, tell = self.done, self.tell
        self.done += len(tasks)

        def told(done: int, total: int) -> None:
            if tell is not None:
                tell(before + done, before + total)

        tally = merged(work, run(partial(do_task, work.packed()), tasks, self.executor, journal, told))
        self.stopped = tally.stopped
        return tally

    def release(self) -> None:
        """The search is over: further questions are answered in this process, without journal or report."""
        self.executor = self.journal = self.tell = None
        self.stopped = False


class _Section:
    """A journal whose tasks are numbered from somewhere on."""

    def __init__(self, journal: Journal, offset: int) -> None:
        self._journal, self._offset = journal, offset

    @property
    def closed(self) -> bool:
        """As of the journal."""
        return self._journal.closed

    def recall(self, task: int, mark: str = "") -> str | None:
        """As of the journal."""
        return self._journal.recall(task + self._offset, mark)

    def keep(self, task: int, mark: str, text: str) -> None:
        """As of the journal."""
        self._journal.keep(task + self._offset, mark, text)


@dataclass(frozen=True, slots=True)
class PassResult:
    """What a pass came to."""

    share: Fraction | None
    """The common tolerance it was run with, if any."""
    searched: float
    """Part of the assignments that it looked at; 1 where it is complete."""
    tally: PassTally
    """Counts and the best."""
    reasons: tuple[str, ...] = ()
    """What refused assignments, parallel to the tally's numbers."""
    order: tuple[int, ...] = ()
    """Indices of the reasons in the order in which they are decided."""
    steps: float = 0.0
    """About how many it was forecast to take."""

    @property
    def complete(self) -> bool:
        """True if every assignment was looked at."""
        return self.searched == 1 and not self.tally.cut and not self.tally.stopped

    @property
    def removed(self) -> dict[str, int]:
        """Reason -> assignments it refused, in the order asked; rules of one name together."""
        found: dict[str, int] = {}
        for at in self.order:
            reason = self.reasons[at]
            found[reason] = found.get(reason, 0) + (self.tally.removed[at] if self.tally.removed else 0)
        return found


NOT_BEGUN = PassResult(None, 0.0, NOTHING)
"""A pass that an interrupt kept from beginning."""


@dataclass
class PartSearch:
    """The passes over one part."""

    part: SearchPart
    order: AssignmentOrder
    runner: PassRunner
    limit: float
    """Steps that one pass may take."""
    alone: tuple[tuple[str, int], ...] = field(init=False)
    domains: Domains = field(init=False)
    rules: tuple[CountConstraint, ...] = field(init=False)
    _sample: SelectivitySample | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        """Rules on one wheel narrow its counts, and are done with."""
        domains: Domains = self.part.domains
        alone = []
        for rule in self.part.rules:
            if len(rule.wheels) == 1:
                narrowed = narrow(domains, rule)
                alone.append((rule.name, size_of(domains) - size_of(narrowed)))
                domains = narrowed
        self.alone, self.domains = tuple(alone), domains
        self.rules = tuple(rule for rule in self.part.rules if len(rule.wheels) > 1)

    @property
    def sample(self) -> SelectivitySample:
        """Some assignments."""
        if self._sample is None:
            self._sample = SelectivitySample.of(self.domains)
        return self._sample

    def without(self, *, rule: str = "", asking: OutputRequirement | None = None) -> PartSearch:
        """The same search without the rules of one name, or one output less."""
        part = replace(
            self.part,
            rules=tuple(one for one in self.part.rules if one.name != rule),
            askings=tuple(one for one in self.part.askings if one is not asking),
        )
        return PartSearch(part, self.order, self.runner, self.limit)

    def requested(self, share: Fraction | None, strict: bool = False) -> tuple[IntervalConstraint, ...]:
        """Every demand of a pass."""
        found = [asking.requested(share, strict) for asking in self.part.askings]
        return (*self.part.conditions, *(one for one in found if one is not None))

    def chances(self, requested: Sequence[IntervalConstraint]) -> dict[str, float]:
        """About which part of the assignments meets each rule and demand."""
        chances = {rule.name: self.sample.of_rule(rule) for rule in self.rules}
        return chances | {one.name: self.sample.of_demand(one) for one in requested}

    def run(self, share: Fraction | None, most: float, *, strict: bool = False) -> PassResult:
        """One pass: all counted, and the best brought out if there are at most `most`.

        share    graded demands are narrowed to this common tolerance
        strict   leave out what lies on the ends of intervals
        """
        if not size_of(self.domains):
            return PassResult(share, 1.0, PassTally(0, (), (), True, False, False))
        requested = self.requested(share, strict)
        question = find_join_problem(self.domains, requested, self.rules, self.chances(requested))
        tasks, searched = cut(question, self.limit)
        work = PassWork(question, self.order, int(min(most, 1 << 62)))
        tally = self.runner.run(work, tasks)
        return PassResult(share, searched, tally, question.reasons, question.order, question.steps)


def size_of(domains: Domains) -> int:
    """Assignments there are."""
    return prod(len(counts) for counts in domains.values())


def narrow(domains: Domains, rule: CountConstraint) -> Domains:
    """The counts that a rule on one wheel leaves."""
    (wheel,) = rule.wheels
    counts = domains[wheel]
    if not counts:
        return domains
    met = rule.holds({wheel: np.array(counts, dtype=np.int64)})
    return {**domains, wheel: tuple(count for count, good in zip(counts, met.tolist(), strict=True) if good)}


# --------------------------------------------------- the best of very many assignments: bounds in floats, exact errors


@dataclass(frozen=True, slots=True)
class AssignmentOrder:
    """What makes an assignment better than another."""

    by: By
    """What comes first; then error, total, largest, and the counts in the order of the wheels."""
    best: int
    """How many are wanted."""
    askings: tuple[OutputRequirement, ...]
    """The outputs their errors are of."""
    declared: Mapping[str, int]
    """Wheel -> declared count, where it has one."""

    @property
    def level(self) -> bool:
        """True if all solutions have one error, because every output is asked for one exact speed."""
        return all(asking.exact for asking in self.askings)

    def assignment(self, teeth: Mapping[str, int]) -> Assignment | None:
        """What the outputs do with some counts; None where one has no speed."""
        outputs = {}
        for asking in self.askings:
            speed = asking.function.value(teeth)
            if speed is None:
                return None
            outputs[asking.name] = asking.reached(speed)
        changed = tuple(wheel for wheel, count in teeth.items() if self.declared.get(wheel, count) != count)
        return Assignment(dict(teeth), outputs, changed)

    def first(self, columns: AssignmentColumns) -> Ints:
        """What comes first, of many assignments; 0 for the error, which `errors` bounds."""
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

    def errors(self, columns: AssignmentColumns) -> tuple[Floats, Floats]:
        """Bounds on the largest |error|, least and greatest."""
        size = len(next(iter(columns.values())))
        minimum, maximum = np.zeros(size), np.zeros(size)
        if not self.level:
            for asking in self.askings:
                low, high = _errors(asking, columns)
                minimum, maximum = np.maximum(minimum, low), np.maximum(maximum, high)
        return minimum, maximum

    def ranks(self, columns: AssignmentColumns) -> Ints:
        """Whole numbers in the order of the largest |error|, exactly; equal errors have equal numbers."""
        found = np.zeros(len(next(iter(columns.values()))), dtype=np.int64)
        if self.level:
            return found
        exact = [_exact_errors(asking, columns) for asking in self.askings]
        rank = {error: at for at, error in enumerate(sorted({error for errors, _ in exact for error in errors}))}
        for errors, which in exact:
            found = np.maximum(found, np.array([rank[error] for error in errors], dtype=np.int64)[which])
        return found


def _errors(asking: OutputRequirement, columns: AssignmentColumns) -> tuple[Floats, Floats]:
    """Bounds on the largest |error| of one output."""
    function = asking.function
    # a count is rounded once at most, where it is beyond 2^53
    quotient = BoundedQuotient.of(function.numerator, function.denominator, [1] * len(function.wheels))
    speed, off = quotient.bounded(products_of([columns[wheel].astype(np.float64) for wheel in function.wheels]))
    size = len(next(iter(columns.values())))
    minimum, maximum = np.zeros(size), np.zeros(size)
    for demand in (demand for demand in asking.demands if demand.graded):
        wanted = as_float(demand.wanted)
        if wanted is None:
            return np.zeros(size), np.full(size, inf)
        if wanted:
            error = np.abs((speed if demand.signed else np.abs(speed)) / wanted - 1)
            slack = off / abs(wanted) + 4 * ROUNDING * (1 + error)
        else:
            error, slack = np.abs(speed), off
        slack = np.where(np.isfinite(error), slack, inf)
        error = np.where(np.isfinite(error), error, 0.0)
        minimum, maximum = np.maximum(minimum, error - slack), np.maximum(maximum, error + slack)
    return minimum, maximum


def _exact_errors(asking: OutputRequirement, columns: AssignmentColumns) -> tuple[list[Fraction], Ints]:
    """The exact |error| of each distinct speed of an output, and for each assignment which of them is its own."""
    function = asking.function
    above, below = (_whole(function.wheels, terms, columns) for terms in (function.numerator, function.denominator))
    speeds, which = distinct_quotients(above, below)
    return [abs(asking.reached(speed).error) for speed in speeds], which


def _whole(wheels: Sequence[str], terms: Sequence[WholeTerm], columns: AssignmentColumns) -> Tallies:
    """The sum of some terms, exact: int64 where it fits, Python integers otherwise."""
    most = {wheel: int(columns[wheel].max()) for wheel in wheels}
    bound = sum(
        abs(coefficient) * prod(most[wheel] ** power for wheel, power in zip(wheels, powers, strict=True))
        for coefficient, powers in terms
    )
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
    """Keeps the best of all assignments it is given, a bounded number at a time."""

    def __init__(self, order: AssignmentOrder, wheels: Sequence[str]) -> None:
        self.order, self.wheels = order, tuple(wheels)
        self._table: Ints = np.zeros((len(wheels), 0), dtype=np.int64)
        self._new: list[Ints] = []

    def add(self, columns: AssignmentColumns) -> None:
        """Offer some assignments."""
        self._new.append(np.stack([columns[wheel] for wheel in self.wheels]))
        if sum(table.shape[1] for table in self._new) > _POOL:
            self._gather()
            self._drop()
            if self._table.shape[1] > max(4 * self.order.best, _POOL // 4):
                self._sort()

    def best(self) -> list[list[int]]:
        """The counts of the best, best first."""
        self._gather()
        self._drop()
        self._sort()
        found: list[list[int]] = self._table.T.tolist()
        return found

    def _gather(self) -> None:
        self._table = np.concatenate([self._table, *self._new], axis=1)
        self._new = []

    def _columns(self) -> AssignmentColumns:
        return dict(zip(self.wheels, self._table, strict=True))

    def _drop(self) -> None:
        """Drop what bounds on the errors show to be none of the best."""
        best = self.order.best
        if self._table.shape[1] <= best or self.order.level:
            return
        first = self.order.first(self._columns())
        minimum, maximum = self.order.errors(self._columns())
        # the n-th least upper bound: what lies surely above it is none of the best n
        last = np.lexsort((maximum, first))[best - 1]
        kept: Bools = (first < first[last]) | ((first == first[last]) & (minimum <= maximum[last]))
        self._table = self._table[:, kept]

    def _sort(self) -> None:
        """Sort exactly, and keep the best."""
        if self._table.shape[1]:
            columns = self._columns()
            sizes = self._table.max(axis=0), self._table.sum(axis=0)
            # lexsort takes its last key first
            keys = (*self._table[::-1], *sizes, self.order.ranks(columns), self.order.first(columns))
            self._table = self._table[:, np.lexsort(keys)[: self.order.best]]
