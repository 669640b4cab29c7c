"""The question that would take a candidate: with each rule that it breaks taken back."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from functools import reduce

from geartrain.synthesis.reconstruction.candidate_rules import BrokenRule
from geartrain.synthesis.reconstruction.reconstruction_problem import (
    NEW,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
)
from geartrain.synthesis.reconstruction.unreachable_wheels import find_unreachable


def admitting_question(problem: ReconstructionProblem, broken: Iterable[BrokenRule]) -> ReconstructionProblem:
    """The question with all that candidates break taken back, as `change` of each says."""
    return reduce(_admit, broken, problem)


def _admit(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    rule = broken.rule
    if rule in ("dial", "speed", "place"):
        dials = (_admitted_dial(dial, broken) if dial.name in broken.subject else dial for dial in problem.dials)
        return replace(problem, dials=tuple(dial for dial in dials if dial is not None))
    if rule in ("wheel", "arbor", "count", "driven"):
        return _without_parts(problem, broken)
    limits = problem.additions
    if rule == "teeth":
        least, greatest = map(int, broken.values)
        return replace(problem, additions=replace(limits, least=least, greatest=greatest))
    if rule == "arbors":
        return replace(problem, additions=replace(limits, arbors=int(broken.values[0])))
    if rule == "beside":
        return replace(problem, additions=replace(limits, on="any"))
    if rule == "idler":
        return replace(problem, idlers=True)
    return _without_pair(problem, broken)


def _without_pair(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    """Without what is known of a pair, or of all distances; the same where the rule takes nothing back."""
    pair = frozenset(broken.subject)
    if broken.rule == "seen":
        return replace(problem, meshes=problem.meshes - {pair})
    if broken.rule == "apart":
        return replace(problem, apart=problem.apart - {pair})
    if broken.rule == "coaxial":
        return replace(problem, coaxial=problem.coaxial - {pair})
    if broken.rule == "distance":
        measured = frozenset(find_unreachable((problem.input, *problem.arbors), problem.geometry))
        return replace(problem, apart=problem.apart - measured, geometry=replace(problem.geometry, reach=None))
    return problem


def _admitted_dial(dial: SearchedDial, broken: BrokenRule) -> SearchedDial | None:
    if broken.rule == "dial":
        return None
    if broken.rule == "place":
        return replace(dial, place=None)
    (speed,) = broken.values
    return replace(dial, least=speed, greatest=speed, signed=True)


def _without_parts(problem: ReconstructionProblem, broken: BrokenRule) -> ReconstructionProblem:
    """Without a wheel or an arbor, or with a count read otherwise."""
    (name,) = broken.subject

    def changed(arbor: SurvivingArbor) -> SurvivingArbor:
        if broken.rule == "count":
            wheels = tuple(_read(wheel, broken) if wheel.name == name else wheel for wheel in arbor.wheels)
        else:
            wheels = tuple(wheel for wheel in arbor.wheels if wheel.name != name)
        return replace(arbor, wheels=wheels)

    gone = {arbor.name for arbor in problem.arbors if arbor.name == name and broken.rule in ("arbor", "driven")}
    arbors = tuple(changed(arbor) for arbor in problem.arbors if arbor.name not in gone)
    dials = tuple(replace(dial, place=NEW) if dial.place in gone else dial for dial in problem.dials)
    left = {wheel.name for arbor in (problem.input, *arbors) for wheel in arbor.wheels}
    names = {arbor.name for arbor in (problem.input, *arbors)}
    return replace(
        problem,
        input=changed(problem.input),
        arbors=arbors,
        dials=dials,
        meshes=frozenset(pair for pair in problem.meshes if pair <= left),
        apart=frozenset(pair for pair in problem.apart if pair <= left),
        coaxial=frozenset(pair for pair in problem.coaxial if pair <= names),
    )


def _read(wheel: SurvivingWheel, broken: BrokenRule) -> SurvivingWheel:
    (teeth,) = broken.values
    return replace(wheel, counts=((int(teeth), Fraction(1)),))
