"""Tooth numbers in a train: every assignment of its free wheels with which all outputs meet their requirements."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.work import Execution, Journal
from geartrain.synthesis.constraints.assembly_constraints import find_constraints
from geartrain.synthesis.constraints.constraint_options import ConstraintOptions
from geartrain.synthesis.constraints.count_conditions import CountConstraint
from geartrain.synthesis.search_outcome import Shortfall
from geartrain.synthesis.train.best_assignments import AssignmentOrder
from geartrain.synthesis.train.independent_parts import SearchPart, find_domains, find_parts, find_requirements
from geartrain.synthesis.train.search_passes import NOT_BEGUN, PartSearch, PassResult, PassRunner
from geartrain.synthesis.train.tolerance_expansion import solve
from geartrain.synthesis.train.train_findings import ORDERS, Assignment, By, PartFindings, Standing, TrainFindings
from geartrain.synthesis.train.train_infeasibility import find_shortfall, tallied
from geartrain.train import Train

LIMIT = 10**9
"""Steps (partial assignments looked at) that a pass may take by default: a few minutes."""


@dataclass(frozen=True, slots=True)
class TrainSearchRequest:
    """What is requested of a search for tooth numbers in a train; see `search_train`.

    Attributes
    ----------
    train : Train
    state : str, optional
    free : str or tuple of str
    rules : ConstraintOptions
    tolerance : Fraction, optional
    best : int
    by : {"error", "total", "largest", "distinct", "change"}
    where : tuple of mapping of str to int
        Assignments whose place among all is requested besides.
    """

    train: Train
    state: str | None = None
    free: str | tuple[str, ...] = "search"
    rules: ConstraintOptions = field(default_factory=ConstraintOptions)
    tolerance: Fraction | None = None
    best: int = 20
    by: By = "error"
    where: tuple[Mapping[str, int], ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data: equal for two requests that need the same work."""
        return {
            "train": self.train.model_dump(mode="json"),
            "state": self.state,
            "free": self.free,
            "rules": self.rules.to_dict(),
            "tolerance": str(self.tolerance),
            "best": self.best,
            "by": self.by,
        }


def answer_search(request: TrainSearchRequest, execution: Execution | None = None) -> TrainFindings:
    """Answer a request: the solutions of `search_train`, and where the requested assignments are among them.

    Parameters
    ----------
    request : TrainSearchRequest
    execution : Execution, optional
        How the tasks are done; default in this process.
    """
    run = execution or Execution()
    found = search_train(
        request.train,
        request.state,
        free=request.free,
        rules=request.rules,
        tolerance=request.tolerance,
        best=request.best,
        by=request.by,
        executor=run.executor,
        journal=run.journal,
        tell=run.tell,
    )
    return replace(found, where=tuple(place for teeth in request.where for place in found.standing(teeth)))


def search_train(
    train: Train,
    state: str | None = None,
    *,
    free: str | Sequence[str] = "search",
    rules: ConstraintOptions | Sequence[CountConstraint] | None = None,
    tolerance: Fraction | None = None,
    best: int = 20,
    by: By = "error",
    limit: int = LIMIT,
    executor: Executor | None = None,
    journal: Journal | None = None,
    tell: Callable[[int, int], None] | None = None,
) -> TrainFindings:
    """All tooth counts of a train's free wheels that meet every requirement, counted, and the best: an exact join.

    Lists of products of counts are joined along what the outputs share, so that far more assignments are counted than
    could be listed; integers decide. What is required of an output: its `expect` and `published`, at their digits and
    in their sense; every target that has a tolerance; with `tolerance`, the first target where none has. An output with
    targets and none of all these is approached: the best `best` by error are found, proved by widening a common
    tolerance.

    Parameters
    ----------
    train : Train
        The declaration, such as `geartrain.load(name).declaration`.
    state : str, optional
        In which state of a train with states; default in all of them at once.
    free : str or sequence of str
        "search": wheels with `teeth: {search: [15, 80]}`. "uncertain": those and all wheels whose count has a `range`
        or `choices`. Or wheels by name, which must have one of the three. Wheels without any count are free anyway.
    rules : ConstraintOptions or sequence of constraints, optional
        What else must hold of the counts; default what holds without being asked for, `ConstraintOptions()`.
    tolerance : Fraction, optional
        Relative, for targets that have none: the first target of an output none of whose targets has one.
    best : int
        How many solutions to list.
    by : {"error", "total", "largest", "distinct", "change"}
        Their order: largest error of an output, total teeth, largest wheel, distinct counts, or wheels changed from
        their declared count; ties by error, total, largest, and the counts.
    limit : int
        Steps (partial assignments looked at) that a pass may take; beyond them a sample is searched, and `complete` is
        False.
    executor : concurrent.futures.Executor, optional
        Where tasks run; default in this process. The answer does not depend on it.
    journal : Journal, optional
        Where finished work is kept, for a run that may be cut.
    tell : callable, optional
        Called with (tasks done, tasks in all).

    Returns
    -------
    TrainFindings
        Part by part. Interrupted from the keyboard, it holds what is known, with `complete` False.

    Raises
    ------
    QuestionError
        If no wheel is free, nothing is required of them, or there is no such order or state.
    RangeError
        For a range of counts that is too wide to be listed.

    References
    ----------
    Counting over a tree of joins is bucket elimination (R. Dechter, Artificial Intelligence 113, 1999).

    Examples
    --------
    The lost wheels of the planets' trains (Pennestri, Valentini and Petti 2002, Table 6), within a quarter per cent;
    of 35,937 assignments for Jupiter 15 will do:

    >>> import geartrain
    >>> found = search_train(geartrain.load("pennestri-2002-missing").declaration, best=1)
    >>> jupiter = found.parts[2]
    >>> jupiter.wheels, jupiter.considered, jupiter.count
    (('JO1', 'JO2', 'JX'), 35937, 15)
    >>> dict(jupiter.solutions[0].teeth)
    {'JO1': 31, 'JO2': 55, 'JX': 31}
    """
    if by not in ORDERS:
        raise QuestionError(Problem(f"there is no order '{by}'", "solutions have others", suggest(by, ORDERS)))
    domains = find_domains(train, free)
    demands = find_requirements(train, state, domains, tolerance)
    if rules is None or isinstance(rules, ConstraintOptions):
        rules = find_constraints(train, domains, rules or ConstraintOptions())
    if not demands.askings and not rules:
        fix = "declare `targets`, or an `expect`, at an output that the wheels move"
        raise QuestionError(Problem("nothing is asked of the free wheels", "no output depends on them", fix))
    declared = {wheel: count for wheel in domains if (count := train.wheels[wheel][1].count) is not None}
    runner = PassRunner(executor, journal, tell)
    searches = [
        PartSearch(part, AssignmentOrder(by, max(best, 1), part.askings, declared), runner, float(limit))
        for part in find_parts(demands, domains, rules)
    ]
    parts = tuple(_found(one) for one in searches)
    runner.release()
    links = {wheel: train.wheels[wheel][0] for wheel in domains}
    return TrainFindings(train.name, by, best, parts, links, demands.remarks, (), _Standings(tuple(searches)).find)


def _found(search: PartSearch) -> PartFindings:
    """All that is said of a part."""
    try:
        passed, solutions, ranked = solve(search)
    except KeyboardInterrupt:
        search.runner.stopped = True
        passed, solutions, ranked = NOT_BEGUN, (), False
    part = search.part
    return PartFindings(
        tuple(part.domains),
        tuple(asking.name for asking in part.askings),
        tuple(asking.text for asking in part.askings),
        tuple(dict.fromkeys(rule.name for rule in part.rules)),
        part.considered,
        passed.tally.count,
        passed.share,
        passed.complete,
        ranked,
        _reason(search, passed, ranked),
        solutions,
        _shortfall(search, passed),
    )


def _shortfall(search: PartSearch, passed: PassResult) -> Shortfall:
    try:
        return find_shortfall(search, passed)
    except KeyboardInterrupt:
        search.runner.stopped = True
        return tallied(search, passed)


def _reason(search: PartSearch, passed: PassResult, ranked: bool) -> str:
    """Why a part is not complete or not ranked, in words."""
    if passed.tally.stopped:
        return "interrupted: the count is of what had been searched"
    if passed.searched < 1:
        share = decimal(Fraction(passed.searched), 2)
        return f"about {passed.steps:.1e} steps and a limit of {search.limit:.1e}: a random part, {share}, was searched"
    if passed.tally.cut:
        return f"the limit of {search.limit:.1e} steps was reached"
    if not ranked and search.runner.stopped:
        return "interrupted: all are counted, the best are not listed"
    return "" if ranked else f"too many to bring them all out within {search.limit:.1e} steps"


@dataclass(frozen=True, slots=True)
class _Standings:
    """Answers where an assignment stands, by counting what comes before it."""

    searches: tuple[PartSearch, ...]

    def find(self, part: int, teeth: Mapping[str, int]) -> Standing:
        """For one part, all of whose wheels are in `teeth`."""
        search = self.searches[part]
        own = {wheel: teeth[wheel] for wheel in search.part.domains}
        assignment = search.order.assignment(own)
        refused = tuple(_refusals(search.part, own, assignment))
        rank = None if refused or assignment is None else _rank(search, assignment)
        return Standing(tuple(own), assignment, rank, refused)


def _refusals(part: SearchPart, teeth: Mapping[str, int], assignment: Assignment | None) -> list[str]:
    """All that refuses an assignment, in words."""
    import numpy as np

    columns = {wheel: np.array([count], dtype=np.int64) for wheel, count in teeth.items()}
    found = [
        f"'{wheel}' is not to have {count} teeth" for wheel, count in teeth.items() if count not in part.domains[wheel]
    ]
    found += [rule.name for rule in part.rules if not rule.holds(columns).all()]
    for asked in part.conditions:
        value = asked.function.value(teeth)
        if value is None or (value != 0) != asked.strict:
            found.append(asked.name)
    if assignment is None:
        return [*found, "the train is locked or free"]
    askings = {asking.name: asking for asking in part.askings}
    for name, reached in assignment.outputs.items():
        if not reached.met:
            found.append(f"{askings[name].text}: {decimal(reached.error, 3)} off")
    return found


def _rank(search: PartSearch, assignment: Assignment) -> int | None:
    """One more than the number of assignments with a smaller error."""
    if not assignment.error or not search.part.askings:
        return 1
    passed = search.run(assignment.error, 0, strict=True)
    return passed.tally.count + 1 if passed.complete else None
