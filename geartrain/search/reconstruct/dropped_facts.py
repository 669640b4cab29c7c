"""Sensitivity of the counts to each hard fact: the question is asked again without it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
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
    SurvivingWheel,
    find_unreachable,
)
from geartrain.search.reconstruct.reconstruction_search import Reconstructions, find_reconstructions

Search = Callable[[ReconstructionProblem], Reconstructions]
"""What finds all explanations of a question."""

_MINIMUM_TEETH = 3


@dataclass(frozen=True)
class ChangedQuestion:
    """A question in which one thing is otherwise, and the words for it."""

    change: str
    problem: ReconstructionProblem


@dataclass(frozen=True, slots=True)
class ChangedCount(Result):
    """How many trains explain what one thing otherwise would leave."""

    KEYS = ("change", "mechanisms", "complete", "refused")

    change: str
    """What is otherwise."""
    mechanisms: tuple[int, ...]
    """Trains with just 0, 1, 2, ... added wheels."""
    complete: bool = True
    """Whether all were looked at."""
    refused: str | None = None
    """Why it could not be asked."""

    @property
    def total(self) -> int:
        """Trains in all."""
        return sum(self.mechanisms)

    @property
    def fewest(self) -> int | None:
        """The fewest added wheels with which there is a train; None where there is none."""
        return next((added for added, count in enumerate(self.mechanisms) if count), None)


def changed_counts(
    questions: list[ChangedQuestion], execution: Execution | None = None, search: Search = find_reconstructions
) -> Iterator[ChangedCount]:
    """The counts of questions in their order, each as it comes; `search` is a function at the top of a module.

    An interrupted one is left out, so that no journal keeps half of it.
    """
    answers = (execution or Execution()).run(_count, [(question.problem, search) for question in questions])
    for question, (mechanisms, complete, refused) in zip(questions, answers, strict=True):
        yield ChangedCount(question.change, tuple(mechanisms), complete, refused)


def _count(task: tuple[ReconstructionProblem, Search]) -> tuple[list[int], bool, str | None]:
    problem, search = task
    try:
        found = search(problem)
    except QuestionError as error:
        return [], False, error.problems[0].what
    if not found.complete:  # the search tells what it has when it is stopped
        raise KeyboardInterrupt
    return [count.mechanisms for count in found.counts], True, None


def without_each_fact(problem: ReconstructionProblem) -> list[ChangedQuestion]:
    """The question without each of its hard facts in turn."""
    return [ChangedQuestion(change, changed) for change, changed in _changes(problem) if changed != problem]


def without_each_dial(problem: ReconstructionProblem) -> list[ChangedQuestion]:
    """The question without what each of its dials shows, where there are several."""
    if len(problem.dials) < 2:
        return []
    return [
        ChangedQuestion(f"without the dial {dial.name}", replace(problem, dials=_but(problem.dials, dial)))
        for dial in problem.dials
    ]


def _changes(problem: ReconstructionProblem) -> Iterator[tuple[str, ReconstructionProblem]]:
    left: dict[str, Any]
    measured = frozenset(find_unreachable((problem.input, *problem.arbors), problem.geometry))
    for name, what in (
        ("meshes", "that {} mesh"),
        ("apart", "that {} do not mesh"),
        ("coaxial", "that {} are coaxial"),
    ):
        pairs: frozenset[frozenset[str]] = getattr(problem, name)
        for pair in sorted(pairs if name == "coaxial" else pairs - measured, key=sorted):
            said = what.format(" and ".join(sorted(pair)))
            left = {name: pairs - {pair}}
            yield f"without the fact {said}", replace(problem, **left)
    if measured:
        left = {"apart": problem.apart - measured, "geometry": replace(problem.geometry, reach=None)}
        yield "if the distances of axes keep no wheels apart", replace(problem, **left)
    yield from _senses(problem)
    for at, dial in enumerate(problem.dials):
        where = "is lost" if dial.place == NEW else f"is {dial.place}"
        changed = _with_dial(problem, at, replace(dial, place=None))
        yield f"without the fact that the arbor of {dial.name} {where}", changed
    yield from _rules(problem)


def _senses(problem: ReconstructionProblem) -> Iterator[tuple[str, ReconstructionProblem]]:
    signed = [at for at, dial in enumerate(problem.dials) if dial.signed]
    for at in signed:
        dial = problem.dials[at]
        yield f"without the sense of {dial.name}", _with_dial(problem, at, _unsigned(dial))
    if len(signed) > 1:
        free = tuple(_unsigned(dial) if dial.signed else dial for dial in problem.dials)
        yield "without any sense", replace(problem, dials=free)


def _rules(problem: ReconstructionProblem) -> Iterator[tuple[str, ReconstructionProblem]]:
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


def _unsigned(dial: SearchedDial) -> SearchedDial:
    """The dial in either sense."""
    ends = sorted(map(abs, (dial.minimum, dial.maximum)))
    minimum = Fraction(0) if dial.minimum < 0 < dial.maximum else ends[0]
    return replace(dial, minimum=minimum, maximum=ends[1], signed=False)


def _with_dial(problem: ReconstructionProblem, at: int, dial: SearchedDial) -> ReconstructionProblem:
    return replace(problem, dials=(*problem.dials[:at], dial, *problem.dials[at + 1 :]))


def _but(dials: tuple[SearchedDial, ...], left_out: SearchedDial) -> tuple[SearchedDial, ...]:
    return tuple(dial for dial in dials if dial != left_out)


# Why nothing explains the evidence: dials that fail alone, and the single things whose doubt would mend it.


MISREAD = 3
"""By how many teeth a count is taken to be read wrongly, either way."""


@dataclass(frozen=True, slots=True)
class LoneDial(Result):
    """A dial that is explained alone, by any of the surviving arbors."""

    dial: str
    """Its name."""
    fewest: int | None
    """The fewest added wheels that explain it; None if none up to the most that may be added."""
    refused: str | None = None
    """Why it could not be asked."""


@dataclass(frozen=True, slots=True)
class MissingExplanation(Result):
    """Why there is no explanation."""

    dials: tuple[LoneDial, ...]
    """Each dial alone."""
    doubts: tuple[ChangedCount, ...]
    """Single things that would leave an explanation if they were otherwise, the cheapest first."""
    requested: int
    """How many were tried."""
    refused: tuple[str, ...]
    """Those that could not be asked."""


def explain_missing(
    problem: ReconstructionProblem, execution: Execution | None = None, search: Search = find_reconstructions
) -> MissingExplanation:
    """Why a question has no answer; `search` stands at the top of a module."""
    dials = tuple(_alone(problem, at, search) for at in range(len(problem.dials)))
    changed = [*without_each_fact(problem), *without_each_dial(problem), *_misread(problem)]
    counts = tuple(changed_counts(changed, execution, search))
    cheap = sorted((one for one in counts if one.total), key=lambda one: one.fewest or 0)
    refused = tuple(one.change for one in counts if one.refused is not None)
    return MissingExplanation(dials, tuple(cheap), len(changed), refused)


def _alone(problem: ReconstructionProblem, at: int, search: Search) -> LoneDial:
    """One dial without the others; survivors that do not lead to it are left out."""
    dial = problem.dials[at]
    lone = replace(problem, dials=(dial,), use="some", meshes=frozenset())
    for wheels in range(problem.additions.wheels + 1):
        try:
            found = search(replace(lone, additions=replace(problem.additions, wheels=wheels)))
        except QuestionError as error:
            return LoneDial(dial.name, None, error.problems[0].what)
        if any(count.mechanisms for count in found.counts):
            return LoneDial(dial.name, wheels)
    return LoneDial(dial.name, None)


def _misread(problem: ReconstructionProblem) -> Iterator[ChangedQuestion]:
    """Every count of a surviving wheel read otherwise, small changes before great ones."""
    for arbor in (problem.input, *problem.arbors):
        for wheel in arbor.wheels:
            counts = {count for count, _ in wheel.counts}
            near = {count + step for count in counts for step in range(-MISREAD, MISREAD + 1)}
            for count in sorted(near - counts, key=lambda one: (min(abs(one - old) for old in counts), one)):
                if count > 0:
                    changed = replace(arbor, wheels=tuple(_read(each, wheel, count) for each in arbor.wheels))
                    yield ChangedQuestion(f"if {wheel.name} has {count} teeth", _with_arbor(problem, arbor, changed))


def _read(wheel: SurvivingWheel, changed: SurvivingWheel, count: int) -> SurvivingWheel:
    return replace(wheel, counts=((count, Fraction(1)),)) if wheel is changed else wheel


def _with_arbor(problem: ReconstructionProblem, old: SurvivingArbor, new: SurvivingArbor) -> ReconstructionProblem:
    if old is problem.input:
        return replace(problem, input=new)
    return replace(problem, arbors=tuple(new if arbor is old else arbor for arbor in problem.arbors))
