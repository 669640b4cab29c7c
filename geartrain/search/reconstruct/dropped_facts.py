"""Sensitivity of the number of trains that explain the evidence to each of its hard constraints. The search is repeated
without each of the constraints.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from geartrain.errors import QuestionError
from geartrain.numerics.results import Result
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    find_unreachable,
    magnitude_bounds,
)
from geartrain.search.reconstruct.reconstruction_search import find_reconstructions

_MINIMUM_TEETH = 3  # lower end of the widened range of added tooth counts


ChangedProblem = tuple[str, ReconstructionProblem]
"""Description of one change of the evidence, and the reconstruction problem after this change."""


@dataclass(frozen=True, slots=True)
class ChangedCount(Result):
    """Number of trains that explain the evidence after one change of the evidence."""

    change: str
    """Description of the change."""
    solutions: tuple[int, ...]
    """Number of trains by number of added wheels: entry n is the number of trains with exactly n added wheels."""
    complete: bool = True
    """True if the search covered all candidates of the changed problem."""
    refused: str | None = None
    """Reason why the changed problem could not be searched; None if it could be searched."""

    @property
    def total(self) -> int:
        """Total number of trains that explain the changed evidence."""
        return sum(self.solutions)

    @property
    def fewest(self) -> int | None:
        """Minimum number of added wheels in a train; None if no train explains the changed evidence."""
        return next((added for added, count in enumerate(self.solutions) if count), None)


def changed_counts(changed: list[ChangedProblem], execution: Execution) -> Iterator[ChangedCount]:
    """Yield the number of trains for each changed problem, in the order of `changed`, as soon as it is known.

    `KeyboardInterrupt` is raised if a search is interrupted, so that no journal stores a partial result.
    """
    answers = execution.run(_count, [problem for _, problem in changed])
    for (change, _), (solutions, complete, refused) in zip(changed, answers, strict=True):
        yield ChangedCount(change, tuple(solutions), complete, refused)


def _count(problem: ReconstructionProblem) -> tuple[list[int], bool, str | None]:
    try:
        found = find_reconstructions(problem)
    except QuestionError as error:
        return [], False, error.problems[0].what
    if not found.complete:  # an interrupted search returns a partial result
        raise KeyboardInterrupt
    return [count.solutions for count in found.counts], True, None


def without_each_fact(problem: ReconstructionProblem) -> list[ChangedProblem]:
    """Return the problems that result if one hard constraint of the evidence is removed, one problem for each
    constraint.
    """
    changes = (*_facts(problem), *_dials(problem), *_rules(problem))
    # a change without effect on the problem needs no search
    return [(change, changed) for change, changed in changes if changed != problem]


def _facts(problem: ReconstructionProblem) -> Iterator[ChangedProblem]:
    """Yield one problem for each known fact about two wheels or two arbors, in which this fact is omitted, and one
    problem without the limits of axis distances.
    """
    measured = frozenset(find_unreachable((problem.input, *problem.arbors), problem.geometry))
    for key, pairs, what in (
        ("meshes", problem.meshes, "that {} mesh"),
        ("apart", problem.apart - measured, "that {} do not mesh"),
        ("coaxial", problem.coaxial, "that {} are coaxial"),
    ):
        for pair in sorted(map(sorted, pairs)):
            left: Any = {key: getattr(problem, key) - {frozenset(pair)}}
            yield f"without the fact {what.format(' and '.join(pair))}", replace(problem, **left)
    if measured:
        free = replace(problem.geometry, reach=None)
        changed = replace(problem, apart=problem.apart - measured, geometry=free)
        yield "if the distances between axes exclude no meshes", changed


def _dials(problem: ReconstructionProblem) -> Iterator[ChangedProblem]:
    """Yield one problem for each dial without its sense of rotation, one problem without all senses of rotation, and
    one problem for each dial whose arbor is then unknown.
    """

    def with_dials(changed: Mapping[str, SearchedDial]) -> ReconstructionProblem:
        return replace(problem, dials=tuple(changed.get(dial.name, dial) for dial in problem.dials))

    unsigned = {}
    for dial in (dial for dial in problem.dials if dial.signed):
        minimum, maximum = magnitude_bounds(dial.minimum, dial.maximum)
        unsigned[dial.name] = replace(dial, minimum=minimum, maximum=maximum, signed=False)
        yield f"without the sense of {dial.name}", with_dials({dial.name: unsigned[dial.name]})
    if len(unsigned) > 1:
        yield "without the sense of any dial", with_dials(unsigned)
    for dial in problem.dials:
        where = "is lost" if dial.place == NEW else f"is {dial.place}"
        change = f"without the fact that the arbor of {dial.name} {where}"
        yield change, with_dials({dial.name: replace(dial, place=None)})


def _rules(problem: ReconstructionProblem) -> Iterator[ChangedProblem]:
    """Yield one problem for each rule on the use of surviving parts or on added parts, with this rule relaxed."""
    limits = problem.additions
    if problem.use == "wheels":
        yield "if every surviving arbor is used, but not every wheel", replace(problem, use="arbors")
    yield "if surviving arbors need not be used", replace(problem, use="some")
    if not problem.idlers:
        yield "if a driven wheel may drive", replace(problem, idlers=True)
    if not limits.wheels:
        return
    wider = {
        replace(limits, minimum=max(_MINIMUM_TEETH, limits.minimum // 2)),
        replace(limits, maximum=2 * limits.maximum),
    }
    for wide in sorted((wide for wide in wider if wide.minimum <= limits.minimum), key=lambda wide: wide.maximum):
        said = f"{wide.minimum} to {wide.maximum}"
        yield f"if added wheels may have {said} teeth", replace(problem, additions=wide)
    if limits.arbors is not None:
        yield "if any number of arbors may be added", replace(problem, additions=replace(limits, arbors=None))
    if limits.on == "new":
        yield "if wheels may be added on surviving arbors", replace(problem, additions=replace(limits, on="any"))


# Reasons why nothing explains the evidence: dials that fail without the others, and single changes that would help.


MISREAD = 3
"""Maximum difference between a tooth count as read and the true tooth count."""


@dataclass(frozen=True, slots=True)
class LoneDial(Result):
    """Minimum number of added wheels with which one dial can be explained if the other dials are ignored."""

    dial: str
    """Name of the dial."""
    fewest: int | None
    """Minimum number of added wheels with which the dial can be explained; None if the permitted number of added wheels
    is not sufficient.
    """
    refused: str | None = None
    """Reason why the problem of this dial could not be searched; None if it could be searched."""


@dataclass(frozen=True, slots=True)
class MissingExplanation(Result):
    """Reasons why a problem has no solution: results for each single dial, and changes of the evidence that would
    permit a solution.
    """

    dials: tuple[LoneDial, ...]
    """Minimum number of added wheels with which each dial can be explained if the other dials are ignored."""
    uncertainties: tuple[ChangedCount, ...]
    """Single changes of the evidence after which at least one train explains it, ordered by the number of added
    wheels.
    """
    requested: int
    """Number of changes of the evidence that were tried."""
    refused: tuple[str, ...]
    """Descriptions of the changes for which the search was rejected."""


def explain_missing(problem: ReconstructionProblem, execution: Execution) -> MissingExplanation:
    """Return the reasons why a reconstruction problem has no solution."""
    dials = tuple(_lone_dial(problem, dial) for dial in problem.dials)
    changed = without_each_fact(problem)
    for dial in problem.dials if len(problem.dials) > 1 else ():
        left = tuple(each for each in problem.dials if each is not dial)
        changed.append((f"without the dial {dial.name}", replace(problem, dials=left)))
    changed += _misread_counts(problem)
    counts = tuple(changed_counts(changed, execution))
    cheap = sorted((one for one in counts if one.total), key=lambda one: one.fewest or 0)
    refused = tuple(one.change for one in counts if one.refused is not None)
    return MissingExplanation(dials, tuple(cheap), len(changed), refused)


def _lone_dial(problem: ReconstructionProblem, dial: SearchedDial) -> LoneDial:
    """Return the minimum number of added wheels with which a dial can be explained if the other dials are ignored.
    Surviving arbors that are not on the path to this dial may be unused.
    """
    # known meshes may belong to arbors of other dials
    lone = replace(problem, dials=(dial,), use="some", meshes=frozenset())
    for wheels in range(problem.additions.wheels + 1):
        try:
            found = find_reconstructions(replace(lone, additions=replace(problem.additions, wheels=wheels)))
        except QuestionError as error:
            return LoneDial(dial.name, None, error.problems[0].what)
        if any(count.solutions for count in found.counts):
            return LoneDial(dial.name, wheels)
    return LoneDial(dial.name, None)


def _misread_counts(problem: ReconstructionProblem) -> Iterator[ChangedProblem]:
    """Yield problems in which one surviving wheel has a different tooth count, one problem for each tooth count that
    differs by at most `MISREAD` from a possible one. The problems are in ascending order of this difference.
    """
    for arbor in (problem.input, *problem.arbors):
        for wheel in arbor.wheels:
            counts = {count for count, _ in wheel.counts}
            near = {count + step for count in counts for step in range(-MISREAD, MISREAD + 1)}
            for count in sorted(near - counts, key=lambda one: (min(abs(one - old) for old in counts), one)):
                if count > 0:
                    yield f"if {wheel.name} has {count} teeth", _with_count(problem, wheel.name, count)


def _with_count(problem: ReconstructionProblem, name: str, count: int) -> ReconstructionProblem:
    def changed(arbor: SurvivingArbor) -> SurvivingArbor:
        counts = ((count, Fraction(1)),)
        wheels = (replace(wheel, counts=counts) if wheel.name == name else wheel for wheel in arbor.wheels)
        return replace(arbor, wheels=tuple(wheels))

    return replace(problem, input=changed(problem.input), arbors=tuple(map(changed, problem.arbors)))
