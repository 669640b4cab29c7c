"""What a candidate weighs before its dials are looked at, and the ranks of candidates by weight."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, TypeVar

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem

if TYPE_CHECKING:
    from geartrain.synthesis.reconstruction.skeletons import Skeleton

_Weight = TypeVar("_Weight", Fraction, float)


def skeleton_prior(skeleton: Skeleton, problem: ReconstructionProblem) -> Fraction:
    """Weight of each of a skeleton's trains before its dials are looked at, up to a factor that all share."""
    added = added_prior(problem, skeleton.added.number, skeleton.added_arbors)
    return added * survivors_prior(problem, skeleton.used)


def prior(arbor: Arbor, problem: ReconstructionProblem) -> Fraction:
    """Weight of a candidate before its dials are looked at, up to a factor that all candidates share."""
    used = [wheel for wheel in arbor.wheels() if wheel.name is not None]
    return added_prior(problem, arbor.added_wheels, arbor.added_arbors) * survivors_prior(problem, used)


def added_prior(problem: ReconstructionProblem, wheels: int, arbors: int) -> Fraction:
    """What so many added wheels and arbors weigh."""
    factors, limits = problem.factors, problem.additions
    return 1 / ((factors.wheel * (limits.greatest - limits.least + 1)) ** wheels * factors.arbor**arbors)


def survivors_prior(problem: ReconstructionProblem, used: Iterable[PlacedWheel]) -> Fraction:
    """What the surviving wheels weigh of which some are used, with their counts."""
    counts = {wheel.name: dict(wheel.counts) for each in (problem.input, *problem.arbors) for wheel in each.wheels}
    weight, unused = Fraction(1), len(counts)
    for wheel in used:
        weight *= counts[wheel.name or ""][wheel.teeth]
        unused -= 1
    return weight / problem.factors.unused**unused


def weight_ranks(weighed: Iterable[tuple[_Weight, int]]) -> dict[_Weight, tuple[int, int]]:
    """First and last rank of candidates of each weight, from weights and how many candidates have them."""
    alike = Counter[_Weight]()
    for weight, number in weighed:
        alike[weight] += number
    found, before = {}, 0
    for weight in sorted(alike, reverse=True):
        found[weight] = before + 1, before + alike[weight]
        before += alike[weight]
    return found
