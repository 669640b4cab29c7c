"""From a question to its counts and candidates: every explanation is listed, weighed and put in order."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from geartrain.synthesis.reconstruction.added_counts import AddedCounts
from geartrain.synthesis.reconstruction.arrangements import MeshFacts, arranged, count_orders
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import Candidate, ExplanationCount, Reconstructions
from geartrain.synthesis.reconstruction.sameness import bag, ratio_class
from geartrain.synthesis.reconstruction.skeleton_search import SkeletonSearch


def find_reconstructions(problem: ReconstructionProblem) -> Reconstructions:
    """All explanations with at most as many added wheels as may be added."""
    counts: list[ExplanationCount] = []
    found: list[tuple[Fraction, int, Arbor]] = []
    search, facts = SkeletonSearch(problem), MeshFacts.of(problem)
    choices = AddedCounts(problem.additions.least, problem.additions.greatest)
    for added in range(problem.additions.wheels + 1):
        arbors = []
        for skeleton in search.skeletons(added):
            if not count_orders(skeleton, facts):
                continue
            for assigned, idle in choices.assignments(skeleton.added, skeleton.wanted):
                arbors += arranged(skeleton, assigned, idle, facts)
        kinds = len({bag(arbor) for arbor in arbors}), len({ratio_class(arbor) for arbor in arbors})
        counts.append(ExplanationCount(added, len(arbors), *kinds))
        found += [(prior(arbor, problem), added, arbor) for arbor in arbors]
    whole = sum(weight for weight, _, _ in found)
    found.sort(key=lambda one: (-one[0], one[1], sum(_added_teeth(one[2])), repr(one[2])))
    return Reconstructions(
        tuple(counts), True, tuple(Candidate(arbor, added, float(weight / whole)) for weight, added, arbor in found)
    )


def prior(arbor: Arbor, problem: ReconstructionProblem) -> Fraction:
    """Weight of a candidate before its dials are looked at, up to a factor that all candidates share."""
    factors, limits = problem.factors, problem.additions
    counts = {wheel.name: dict(wheel.counts) for each in (problem.input, *problem.arbors) for wheel in each.wheels}
    wheels = list(_wheels(arbor))
    used = {wheel.name: wheel.teeth for wheel in wheels if wheel.name is not None}
    weight = Fraction(1)
    for name, teeth in used.items():
        weight *= counts[name][teeth]
    weight /= (factors.wheel * (limits.greatest - limits.least + 1)) ** sum(wheel.name is None for wheel in wheels)
    weight /= factors.arbor ** sum(each.name is None for each in _arbors(arbor))
    return weight / factors.unused ** (len(counts) - len(used))


def _arbors(arbor: Arbor) -> Iterator[Arbor]:
    yield arbor
    for child in _children(arbor):
        yield from _arbors(child)


def _children(arbor: Arbor) -> Iterator[Arbor]:
    for _, children in arbor.drives:
        yield from children
    yield from arbor.passes


def _wheels(arbor: Arbor) -> Iterator[PlacedWheel]:
    """Every wheel of a train once."""
    for each in _arbors(arbor):
        if each.driven is not None:
            yield each.driven
        yield from (wheel for wheel, _ in each.drives if wheel.name is None or wheel != each.driven)


def _added_teeth(arbor: Arbor) -> list[int]:
    return [wheel.teeth for wheel in _wheels(arbor) if wheel.name is None]


def _meshes(arbor: Arbor) -> Iterator[tuple[str | None, str | None]]:
    for each in _arbors(arbor):
        for wheel, children in (*each.drives, (each.driven, each.passes)):
            for child in children:
                assert wheel is not None
                assert child.driven is not None
                yield wheel.name, child.driven.name
