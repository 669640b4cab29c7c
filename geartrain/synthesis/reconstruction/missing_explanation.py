"""Why nothing explains the evidence: dials that fail alone, and the single things whose doubt would mend it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.errors import QuestionError
from geartrain.numerics.plain_data import Result
from geartrain.numerics.work import Execution
from geartrain.synthesis.reconstruction.dropped_facts import (
    ChangedCount,
    ChangedQuestion,
    Search,
    count_changed,
    without_each_dial,
    without_each_fact,
)
from geartrain.synthesis.reconstruction.reconstruction_problem import (
    ReconstructionProblem,
    SurvivingArbor,
    SurvivingWheel,
)
from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions

MISREAD = 3
"""By how many teeth a count is taken to be read wrongly, either way."""


@dataclass(frozen=True, slots=True)
class LoneDial(Result):
    """A dial that is explained alone, by any of the surviving arbors.

    Attributes
    ----------
    dial : str
        Its name.
    fewest : int or None
        The fewest added wheels that explain it; None if none up to the most that may be added.
    refused : str or None
        Why it could not be asked.
    """

    dial: str
    fewest: int | None
    refused: str | None = None


@dataclass(frozen=True, slots=True)
class MissingExplanation(Result):
    """Why there is no explanation.

    Attributes
    ----------
    dials : tuple of LoneDial
        Each dial alone.
    doubts : tuple of ChangedCount
        Single things that would leave an explanation if they were otherwise, the cheapest first.
    asked : int
        How many were tried.
    refused : tuple of str
        Those that could not be asked.
    """

    dials: tuple[LoneDial, ...]
    doubts: tuple[ChangedCount, ...]
    asked: int
    refused: tuple[str, ...]


def explain_missing(
    problem: ReconstructionProblem, execution: Execution | None = None, search: Search = find_reconstructions
) -> MissingExplanation:
    """Why a question has no answer; `search` stands at the top of a module."""
    dials = tuple(_alone(problem, at, search) for at in range(len(problem.dials)))
    changed = [*without_each_fact(problem), *without_each_dial(problem), *_misread(problem)]
    counts = count_changed(changed, execution, search)
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
