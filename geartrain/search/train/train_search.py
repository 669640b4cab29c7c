"""Search for tooth counts of a train: find all tooth counts of its varied wheels that satisfy all requirements."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import ceil, floor
from typing import get_args

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.numerics.exact import decimal, log10
from geartrain.numerics.work import Journal
from geartrain.search.constraints.assembly_constraints import find_constraints
from geartrain.search.constraints.constraint_options import ConstraintOptions
from geartrain.search.constraints.count_conditions import CountConstraint
from geartrain.search.search_outcome import Shortfall
from geartrain.search.train.output_requirements import (
    OutputRequirement,
    SearchPart,
    find_domains,
    find_parts,
)
from geartrain.search.train.search_passes import AssignmentOrder, PartSearch, PassResult, PassRunner, size_of
from geartrain.search.train.train_findings import Assignment, By, PartFindings, Standing, TrainFindings
from geartrain.train import Train

# Choice of a tolerance that includes the requested number of assignments, and not too many to list.


_LISTED = 100_000
"""Maximum number of assignments that are enumerated to find the assignments with the smallest errors. If there are more
assignments, the tolerance is reduced.
"""
_FIRST = Fraction(1, 10**6)  # first tolerance, which is changed by factors of ten
_MINIMUM = Fraction(1, 10**40)  # smaller tolerances include nothing, tolerances above `_WIDEST` include everything
_WIDEST = Fraction(10**6)


def solve(search: PartSearch) -> tuple[PassResult, tuple[Assignment, ...], bool]:
    """Search one part of a train. Return a result with the number of its solutions, its best assignments, and whether
    these are proved to be the best.
    """
    if any(requirement.approached for requirement in search.part.requirements):
        passed = widened(search)
        return passed, passed.best, passed.listed and passed.complete
    # only the order by error can be narrowed by a tolerance if there are too many solutions to list
    by_error = search.order.by == "error" and not search.order.only_exact
    # an assignment that is listed costs several times as much as a step of the count
    passed = search.run(None, _list_limit(search) if by_error else search.limit / 8)
    if passed.listed or not passed.complete:
        return passed, passed.best, passed.listed and passed.complete
    narrowed = widened(search)
    return passed, narrowed.best, by_error and narrowed.listed and narrowed.complete


def widened(search: PartSearch) -> PassResult:
    """Return the result of a pass that lists all assignments within its tolerance. The tolerance includes at least the
    requested number of assignments or, if there are fewer, all assignments.

    If no tolerance is suitable, because too many assignments have the same error, the pass lists the assignments that
    it can enumerate within its limit of steps.
    """
    share, short = _FIRST, Fraction(0)
    long: Fraction | None = None  # a tolerance that includes too many to list
    while _MINIMUM <= share <= _WIDEST and (long is None or short < share < long):
        passed = search.run(share, _list_limit(search))
        enough = passed.count >= search.order.best
        if not passed.complete or (enough and passed.listed):
            return passed
        if enough:
            long = share
        else:
            short = share
        if short and long is not None:
            # bisection of the logarithm, between too few and too many; two digits are easy to print
            share = Fraction(f"{10 ** ((log10(short) + log10(long)) / 2):.1e}")
        else:
            share = share / 10 if enough else share * 10
    # there are fewer assignments than requested
    if long is None:
        return search.run(None, search.limit / 8)
    # too many assignments have equal errors
    return search.run(long if short else Fraction(0), search.limit / 8)


def _list_limit(search: PartSearch) -> int:
    return max(_LISTED, 4 * search.order.best)


# Explanation of short results: rejected assignments, closest rejected candidate, constraints to relax.


def find_shortfall(search: PartSearch, passed: PassResult) -> Shortfall:
    """Return the number of assignments rejected by each constraint and requirement, in the order of evaluation. If
    there is no solution, the result also contains the closest rejected candidate and suggestions.
    """
    removed = dict(search.removed_first)
    for reason, number in passed.removed.items():
        removed[reason] = removed.get(reason, 0) + number
    found = Shortfall(search.part.considered, removed)
    if passed.count or not passed.complete:
        return found
    try:
        # the explanation must not cost more than the search
        nearest, advice = _explain(replace(search, limit=search.limit / 4))
    except KeyboardInterrupt:
        search.runner.stopped = True
    return found if search.runner.stopped else replace(found, nearest=nearest, advice=advice)


def _explain(search: PartSearch) -> tuple[str, str]:
    """Return a description of the rejected candidate with the smallest error, and a suggestion of which constraints to
    relax. Either text may be empty.
    """
    wrong = [requirement for requirement in search.part.requirements if _has_wrong_sense(search, requirement)]
    if wrong:
        names = ", ".join(f"'{requirement.name}'" for requirement in wrong)
        return f"{names} turn in the opposite sense for all counts", "change the required sign, or add an idler"
    best = _nearest(search)
    others = "; ".join(_relaxations(search))
    if best is None:
        return "", others or "no single requirement is the cause: widen the ranges of the wheels"
    counts = ", ".join(f"{wheel} {count}" for wheel, count in best.teeth.items())
    errors = ", ".join(
        f"{name} {'meets' if reached.met else 'misses'} {reached.label} by {decimal(reached.error, 3)}"
        for name, reached in best.outputs.items()
    )
    # with one output it would repeat the closest candidate
    alone = "; ".join(_individual_errors(search)) if len(search.part.requirements) > 1 else ""
    nearest = f"{counts}: {errors}" + (f" (individually, {alone})" if alone else "")
    advice = f"a relative tolerance of {_rounded_up(best.error)} includes it"
    return nearest, advice + (f"; {others}" if others else "")


def _has_wrong_sense(search: PartSearch, requirement: OutputRequirement) -> bool:
    """Return whether the required sense of rotation of an output is impossible with all admissible tooth counts."""
    loose = replace(requirement, demands=tuple(demand.loosened() for demand in requirement.demands))
    part = replace(search.part, requirements=(loose,), conditions=(), rules=())
    passed = replace(search, part=part, order=replace(search.order, requirements=(loose,))).run(None, 0)
    return passed.complete and not passed.count


def _nearest(search: PartSearch) -> Assignment | None:
    """Return the assignment with the minimum error among the assignments that satisfy all constraints on tooth counts;
    None if no such assignment was found within the limit of steps.
    """
    if not search.part.requirements or not size_of(search.domains):
        return None
    requirements = tuple(
        replace(requirement, demands=tuple(one.loosened() if one.graded else one for one in requirement.demands))
        for requirement in search.part.requirements
    )
    order = replace(search.order, by="error", best=1, requirements=requirements)
    relaxed = replace(search, part=replace(search.part, requirements=requirements), order=order)
    best = widened(relaxed).best
    return search.order.assignment(best[0].teeth) if best else None


def _individual_errors(search: PartSearch) -> Iterator[str]:
    """Yield a description of the minimum error of each output without the requirements on the other outputs."""
    for requirement in search.part.requirements:
        part = replace(search.part, requirements=(requirement,))
        order = replace(search.order, requirements=(requirement,))
        best = _nearest(replace(search, part=part, order=order))
        if best is not None:
            yield f"{requirement.name} has an error of {decimal(best.error, 3)}"


def _relaxations(search: PartSearch) -> Iterator[str]:
    """Yield descriptions of the number of solutions without each constraint, and without the requirement on each
    output. Nothing is yielded if there is only one constraint or requirement.
    """
    names = dict.fromkeys(rule.name for rule in search.part.rules)
    if len(names) + len(search.part.requirements) < 2:
        return
    relaxed = [(f'the constraint "{name}"', search.without(rule=name)) for name in names]
    relaxed += [
        (f"the requirement on '{requirement.name}'", search.without(requirement=requirement))
        for requirement in search.part.requirements
    ]
    for what, other in relaxed:
        # 0: the solutions are counted, not listed
        passed = other.run(None, 0)
        minimum = "" if passed.complete else "at least "
        if passed.count == 1:
            yield f"without {what} there is {minimum}1 solution"
        elif passed.count:
            yield f"without {what} there are {minimum}{passed.count} solutions"


def _rounded_up(error: Fraction) -> str:
    """Round a positive number up to two significant digits, and return it as text."""
    if not error:
        return "0"
    unit = Fraction(10) ** (floor(log10(error)) - 1)
    return decimal(ceil(error / unit) * unit, 2)


LIMIT = 10**9
"""Default maximum number of steps of a pass, where a step is a partial assignment that is examined. A pass with this
number of steps takes a few minutes.
"""


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
    """Find, count and rank all tooth counts of the varied wheels of a train that satisfy all requirements.

    The algorithm lists the products of tooth counts for each output, and joins the lists on the factors that several
    outputs have in common (bucket elimination). The join is exact, because all comparisons use integers. It can count
    many more assignments than it can list.

    The requirements on an output are its `expect` and `published` values and every target with a tolerance. Values are
    signed and are compared to the number of digits written. If no target has a tolerance and `tolerance` is given, the
    first target is a requirement. If an output has targets but no requirement, its error is minimised. The `best`
    assignments with the smallest errors are found by increasing a common tolerance, which proves that they are the
    best.

    Parameters
    ----------
    train : Train
        Declaration of the train, such as `geartrain.load(name).declaration`.
    state : str, optional
        State of a train with states; by default the requirements of all states apply.
    free : str or sequence of str
        Wheels to vary. "search" selects wheels with `teeth: {search: [15, 80]}`, and "uncertain" selects these wheels
        and all wheels whose tooth count has a `range` or `choices`. A sequence contains names of wheels, each with a
        `search`, `range` or `choices`. Wheels without a tooth count are always varied.
    rules : ConstraintOptions or sequence of constraints, optional
        Further constraints on the tooth counts; by default `ConstraintOptions()`.
    tolerance : Fraction, optional
        Relative tolerance for the first target of an output if none of its targets has a tolerance.
    best : int
        Maximum number of solutions to list.
    by : {"error", "total", "largest", "distinct", "change"}
        Primary criterion of the order: maximum error of an output, sum of tooth counts, largest tooth count, number of
        distinct tooth counts, or number of wheels whose tooth count differs from the declared one. Ties are broken by
        error, sum of tooth counts, largest tooth count, and the tooth counts.
    limit : int
        Maximum number of steps (examined partial assignments) of one pass. If it is exceeded, only a random sample is
        searched, and `complete` is False.
    executor : concurrent.futures.Executor, optional
        Executor of the tasks; by default they run in this process. The executor does not change the result.
    journal : Journal, optional
        Journal of finished tasks, with which an interrupted run can be resumed.
    tell : callable, optional
        Progress function, called with (tasks done, total tasks).

    Returns
    -------
    TrainFindings
        Results for each independent part. After a keyboard interrupt, the results are based on the finished tasks, and
        `complete` is False.

    Raises
    ------
    QuestionError
        If no wheel is varied, if no requirement depends on the varied wheels, or if the order or state does not exist.
    RangeError
        If a range of tooth counts is too large to list.

    References
    ----------
    Counting over a tree of joins is bucket elimination (R. Dechter, Artificial Intelligence 113, 1999).

    Examples
    --------
    The lost wheels of the planets' trains (Pennestri, Valentini and Petti 2002, Table 6), within a quarter per cent;
    15 of 35,937 assignments for Jupiter are solutions:

    >>> import geartrain
    >>> found = search_train(geartrain.load("pennestri-2002-missing").declaration, best=1)
    >>> jupiter = found.parts[2]
    >>> jupiter.wheels, jupiter.considered, jupiter.count
    (('JO1', 'JO2', 'JX'), 35937, 15)
    >>> dict(jupiter.solutions[0].teeth)
    {'JO1': 31, 'JO2': 55, 'JX': 31}
    """
    if by not in get_args(By):
        what = f"solutions cannot be sorted by '{by}'"
        raise QuestionError(Problem(what, "no such criterion is computed for a solution", suggest(by, get_args(By))))
    domains = find_domains(train, free)
    train.check_state(state)
    if rules is None or isinstance(rules, ConstraintOptions):
        rules = find_constraints(train, domains, rules or ConstraintOptions())
    parts, remarks = find_parts(train, state, domains, rules, tolerance)
    if not rules and not any(part.requirements for part in parts):
        raise QuestionError(
            Problem(
                "no requirement restricts the tooth counts that are varied",
                "no output with a requirement depends on the varied wheels, and no constraint applies",
                "declare `targets`, or an `expect`, at an output that the wheels influence",
            )
        )
    declared = {wheel: count for wheel in domains if (count := train.wheels[wheel][1].count) is not None}
    runner = PassRunner(executor, journal, tell)
    searches = [
        PartSearch(part, AssignmentOrder(by, max(best, 1), part.requirements, declared), runner, float(limit))
        for part in parts
    ]
    findings = tuple(_found(one) for one in searches)
    # later computations of ranks are executed in this process
    searches = [replace(search, runner=PassRunner()) for search in searches]
    links = {wheel: train.wheels[wheel][0] for wheel in domains}
    return TrainFindings(train.name, by, best, findings, links, remarks, (), partial(_standing, searches))


def _found(search: PartSearch) -> PartFindings:
    try:
        passed, solutions, ranked = solve(search)
    except KeyboardInterrupt:
        search.runner.stopped = True
        passed, solutions, ranked = PassResult(stopped=True), (), False
    part = search.part
    return PartFindings(
        tuple(part.domains),
        tuple(requirement.name for requirement in part.requirements),
        tuple(requirement.text for requirement in part.requirements),
        tuple(dict.fromkeys(rule.name for rule in part.rules)),
        part.considered,
        passed.count,
        passed.share,
        passed.complete,
        ranked,
        _reason(search, passed, ranked),
        solutions,
        find_shortfall(search, passed),
    )


def _reason(search: PartSearch, passed: PassResult, ranked: bool) -> str:
    """Return the reason why a search is incomplete or its listed solutions are not proved to be the best; empty if the
    search is complete and the solutions are proved to be the best.
    """
    if passed.stopped:
        return "interrupted: the count covers only the finished part"
    if passed.searched < 1:
        share = decimal(Fraction(passed.searched), 2)
        limit = f"{search.limit:.1e}"
        return f"about {passed.steps:.1e} steps, above the limit of {limit}: a random share of {share} was searched"
    if passed.cut:
        return f"the limit of {search.limit:.1e} steps was reached"
    if not ranked and search.runner.stopped:
        return "interrupted: all solutions are counted, the best are not listed"
    return "" if ranked else f"too many solutions to list them all within {search.limit:.1e} steps"


def _standing(searches: Sequence[PartSearch], part: int, teeth: Mapping[str, int]) -> Standing:
    """Return the rank of an assignment in the part with index `part`. `teeth` must include all wheels of this part."""
    search = searches[part]
    own = {wheel: teeth[wheel] for wheel in search.part.domains}
    assignment = search.order.assignment(own)
    refused = tuple(_refusals(search.part, own, assignment))
    rank = None
    if assignment is not None and not refused:
        rank = 1
        if assignment.error and search.part.requirements:
            # strict: assignments with an equal error are not counted
            better = search.run(assignment.error, 0, strict=True)
            rank = better.count + 1 if better.complete else None
    return Standing(tuple(own), assignment, rank, refused)


def _refusals(part: SearchPart, teeth: Mapping[str, int], assignment: Assignment | None) -> list[str]:
    """Return the descriptions of all constraints and requirements that the tooth counts `teeth` violate. `assignment`
    contains the resulting speeds; it is None if the train is locked or free.
    """
    import numpy as np

    columns = {wheel: np.array([count], dtype=np.int64) for wheel, count in teeth.items()}
    found = [
        f"{count} teeth are not admissible for '{wheel}'"
        for wheel, count in teeth.items()
        if count not in part.domains[wheel]
    ]
    found += [rule.name for rule in part.rules if not rule.holds(columns).all()]
    for requested in part.conditions:
        value = requested.function.value(teeth)
        if value is None or (value != 0) != requested.strict:
            found.append(requested.name)
    if assignment is None:
        return [*found, "the train is locked or free"]
    requirements = {requirement.name: requirement for requirement in part.requirements}
    for name, reached in assignment.outputs.items():
        if not reached.met:
            found.append(f"{requirements[name].text}: error {decimal(reached.error, 3)}")
    return found
