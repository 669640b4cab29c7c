"""From a question to its counts and candidates: explanations are counted by skeletons, weighed, and the best listed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import groupby, islice
from typing import Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.work import Execution
from geartrain.synthesis.reconstruction.added_counts import AddedCounts
from geartrain.synthesis.reconstruction.arrangements import MeshFacts, arranged
from geartrain.synthesis.reconstruction.candidate_prior import prior, skeleton_prior, weight_ranks
from geartrain.synthesis.reconstruction.geometry_likelihood import candidate_likelihood
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import (
    Candidate,
    ExplanationCount,
    Reconstructions,
    WeightClass,
)
from geartrain.synthesis.reconstruction.ring_meshes import rings_limit
from geartrain.synthesis.reconstruction.sameness import bag, ratio_class
from geartrain.synthesis.reconstruction.skeleton_tasks import CountedSkeleton, count_skeletons

_LISTED = 20_000
"""Candidates that are made at most; of more of one weight, the first that are found."""
_TOLD_APART = 300_000
"""Choices of counts up to which bags and classes are counted."""


def find_reconstructions(
    problem: ReconstructionProblem,
    execution: Execution | None = None,
    listed: int = 1000,
    per: Literal["mechanism", "class"] = "mechanism",
) -> Reconstructions:
    """Count all explanations with at most as many added wheels as may be added, and list the best.

    Parameters
    ----------
    problem : ReconstructionProblem
    execution : Execution, optional
        How the parts of the search are done; default one after the other in this process.
    listed : int
        How many candidates are listed at least, where there are so many.
    per : {"mechanism", "class"}
        What has a weight of its own: every train, or every ratio class, whose trains then share it.

    Raises
    ------
    QuestionError
        If more trains than can be listed would have to be, to share weights by class or to weigh measured sizes.
    """
    found: dict[int, list[CountedSkeleton]] = {added: [] for added in range(problem.additions.wheels + 1)}
    whole: set[int] = set()
    geometry = problem.geometry
    one_by_one = per == "class" or bool(geometry.wheels or geometry.arbors)
    try:
        for part in count_skeletons(problem, execution):
            found[part.added] += part.skeletons
            if part.last:
                whole.add(part.added)
    except KeyboardInterrupt:
        found = {added: skeletons for added, skeletons in found.items() if added in whole}
    complete = len(whole) == problem.additions.wheels + 1
    if one_by_one:
        return _all_weighed(problem, found, complete, per)
    counts = tuple(_count(added, some, problem) for added, some in found.items())
    every = tuple(each for some in found.values() for each in some)
    weights = tuple(_weight_classes(problem, found))
    return Reconstructions(counts, complete, tuple(_best(problem, found, listed)), every, weights)


def _weight_classes(
    problem: ReconstructionProblem, found: Mapping[int, Sequence[CountedSkeleton]]
) -> Iterator[WeightClass]:
    """By number of added wheels, how many trains have each weight, the greatest first."""
    for added, skeletons in found.items():
        alike = Counter[Fraction]()
        for each in skeletons:
            alike[skeleton_prior(each.skeleton, problem)] += each.mechanisms
        yield from (WeightClass(added, weight, alike[weight]) for weight in sorted(alike, reverse=True))


def _count(added: int, skeletons: Sequence[CountedSkeleton], problem: ReconstructionProblem) -> ExplanationCount:
    mechanisms = sum(each.mechanisms for each in skeletons)
    # the order of arbors changes neither, but where a ring limits counts in some orders
    greatest = problem.additions.greatest
    told = [(each, not rings_limit(each.skeleton, problem.rings, greatest)) for each in skeletons]
    if sum(each.choices if one_order else each.mechanisms for each, one_order in told) > _TOLD_APART:
        return ExplanationCount(added, mechanisms, None, None)
    some = [arbor for each, one_order in told for arbor in _trains(each, problem, one_order)]
    return ExplanationCount(added, mechanisms, len({*map(bag, some)}), len({*map(ratio_class, some)}))


def _trains(each: CountedSkeleton, problem: ReconstructionProblem, one_order: bool = False) -> Iterator[Arbor]:
    """All trains of a skeleton; or with each choice of counts one, its arbors in any order."""
    limits = problem.additions
    facts = MeshFacts() if one_order else MeshFacts.of(problem)
    skeleton = each.skeleton
    for counts, idle in AddedCounts(limits.least, limits.greatest).assignments(skeleton.added, skeleton.wanted):
        yield from islice(arranged(skeleton, counts, idle, facts), 1 if one_order else None)


# the best


def _best(problem: ReconstructionProblem, found: dict[int, list[CountedSkeleton]], listed: int) -> Iterator[Candidate]:
    """The heaviest candidates, those of one weight by added wheels and their teeth."""
    weighed = [(skeleton_prior(each.skeleton, problem), added, each) for added, some in found.items() for each in some]
    whole = sum(weight * each.mechanisms for weight, _, each in weighed)
    ranks = weight_ranks((weight, each.mechanisms) for weight, _, each in weighed)
    weighed.sort(key=lambda one: (-one[0], one[1]))
    made, most = 0, max(listed, _LISTED)
    for (weight, added), equal in groupby(weighed, key=lambda one: one[:2]):
        if made >= listed:
            return
        arbors = list(islice((arbor for _, _, each in equal for arbor in _trains(each, problem)), most - made))
        made += len(arbors)
        arbors.sort(key=_order)
        yield from (Candidate(arbor, added, float(weight / whole), ranks[weight]) for arbor in arbors)


def _order(arbor: Arbor) -> tuple[int, str]:
    return sum(wheel.teeth for wheel in arbor.wheels() if wheel.name is None), repr(arbor)


def _all_weighed(
    problem: ReconstructionProblem, found: dict[int, list[CountedSkeleton]], complete: bool, per: str
) -> Reconstructions:
    """Every candidate, weighed by itself: by its misfits, or as a part of its class; impossible ones are dropped."""
    number = sum(each.mechanisms for some in found.values() for each in some)
    if number > _LISTED:
        what = f"{number} trains would have to be weighed one by one, and {_LISTED} can be"
        fix = "ask with fewer added wheels (-k), or with `--per mechanism` and without measured sizes"
        raise QuestionError(Problem(what, "weights by class, and of measured sizes, are of whole trains", fix))
    counts, weighed = [], []
    for added, skeletons in found.items():
        own = []
        for arbor in (arbor for each in skeletons for arbor in _trains(each, problem)):
            likelihood = candidate_likelihood(arbor, problem.geometry)
            if likelihood:
                own.append((float(prior(arbor, problem)) * likelihood, added, arbor))
        arbors = [arbor for _, _, arbor in own]
        counts.append(ExplanationCount(added, len(own), len({*map(bag, arbors)}), len({*map(ratio_class, arbors)})))
        weighed += own
    if per == "class":
        classes: dict[object, int] = {}
        for _, _, arbor in weighed:
            classes[ratio_class(arbor)] = classes.get(ratio_class(arbor), 0) + 1
        weighed = [(weight / classes[ratio_class(arbor)], added, arbor) for weight, added, arbor in weighed]
    weighed.sort(key=lambda one: (-one[0], one[1], _order(one[2])))
    whole = sum(weight for weight, _, _ in weighed)
    ranks = weight_ranks((weight, 1) for weight, _, _ in weighed)
    candidates = tuple(Candidate(arbor, added, weight / whole, ranks[weight]) for weight, added, arbor in weighed)
    return Reconstructions(tuple(counts), complete, candidates)
