"""From a question to its counts and candidates: topologies are weighed, and the best trains listed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import groupby, islice
from random import Random
from typing import Literal

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts
from geartrain.search.reconstruct.arbor_orders import MeshFacts, arranged, rings_limit
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import Arbor, ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_result import (
    Candidate,
    ExplanationCount,
    Reconstructions,
    WeightClass,
    bag,
    prior,
    ratio_class,
    topology_prior,
    weight_ranks,
)
from geartrain.search.reconstruct.search_tasks import CountedTopology, TopologyTrains, count_topologies
from geartrain.search.weighted_alternatives import draw_index

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
    found: dict[int, list[CountedTopology]] = {added: [] for added in range(problem.additions.wheels + 1)}
    whole: set[int] = set()
    geometry = problem.geometry
    one_by_one = per == "class" or bool(geometry.wheels or geometry.arbors)
    try:
        for part in count_topologies(problem, execution):
            found[part.added] += part.topologies
            if part.last:
                whole.add(part.added)
    except KeyboardInterrupt:
        found = {added: topologies for added, topologies in found.items() if added in whole}
    complete = len(whole) == problem.additions.wheels + 1
    if one_by_one:
        return _all_weighed(problem, found, complete, per)
    counts = tuple(_count(added, some, problem) for added, some in found.items())
    every = tuple(each for some in found.values() for each in some)
    weights = tuple(_weight_classes(problem, found))
    return Reconstructions(counts, complete, tuple(_best(problem, found, listed)), every, weights)


def _weight_classes(
    problem: ReconstructionProblem, found: Mapping[int, Sequence[CountedTopology]]
) -> Iterator[WeightClass]:
    """By number of added wheels, how many trains have each weight, the greatest first."""
    for added, topologies in found.items():
        alike = Counter[Fraction]()
        for each in topologies:
            alike[topology_prior(each.topology, problem)] += each.mechanisms
        yield from (WeightClass(added, weight, alike[weight]) for weight in sorted(alike, reverse=True))


def _count(added: int, topologies: Sequence[CountedTopology], problem: ReconstructionProblem) -> ExplanationCount:
    mechanisms = sum(each.mechanisms for each in topologies)
    # the order of arbors changes neither, but where a ring limits counts in some orders
    greatest = problem.additions.greatest
    told = [(each, not rings_limit(each.topology, problem.rings, greatest)) for each in topologies]
    if sum(each.choices if one_order else each.mechanisms for each, one_order in told) > _TOLD_APART:
        return ExplanationCount(added, mechanisms, None, None)
    some = [arbor for each, one_order in told for arbor in _trains(each, problem, one_order)]
    return ExplanationCount(added, mechanisms, len({*map(bag, some)}), len({*map(ratio_class, some)}))


def _trains(each: CountedTopology, problem: ReconstructionProblem, one_order: bool = False) -> Iterator[Arbor]:
    """All trains of a topology; or with each choice of counts one, its arbors in any order."""
    limits = problem.additions
    facts = MeshFacts() if one_order else MeshFacts.of(problem)
    topology = each.topology
    for counts, idle in AddedCounts(limits.least, limits.greatest).assignments(topology.added, topology.wanted):
        yield from islice(arranged(topology, counts, idle, facts), 1 if one_order else None)


# the best


def _best(problem: ReconstructionProblem, found: dict[int, list[CountedTopology]], listed: int) -> Iterator[Candidate]:
    """The heaviest candidates, those of one weight by added wheels and their teeth."""
    weighed = [(topology_prior(each.topology, problem), added, each) for added, some in found.items() for each in some]
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
    problem: ReconstructionProblem, found: dict[int, list[CountedTopology]], complete: bool, per: str
) -> Reconstructions:
    """Every candidate, weighed by itself: by its misfits, or as a part of its class; impossible ones are dropped."""
    number = sum(each.mechanisms for some in found.values() for each in some)
    if number > _LISTED:
        what = f"{number} trains would have to be weighed one by one, and {_LISTED} can be"
        fix = "ask with fewer added wheels (-k), or with `--per mechanism` and without measured sizes"
        raise QuestionError(Problem(what, "weights by class, and of measured sizes, are of whole trains", fix))
    counts, weighed = [], []
    for added, topologies in found.items():
        own = []
        for arbor in (arbor for each in topologies for arbor in _trains(each, problem)):
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


# Trains drawn at random, each with the chance of its weight among all explanations.


def draw_candidates(
    found: Reconstructions, problem: ReconstructionProblem, dials: Sequence[str], number: int, seed: int
) -> tuple[Candidate, ...]:
    """Draw candidates independently of each other; one may come several times.

    Parameters
    ----------
    found : Reconstructions
        All explanations of the question.
    problem : ReconstructionProblem
    dials : sequence of str
        In the order of the evidence.
    number : int
        How many are drawn, from 0 on.
    seed : int
        The same seed draws the same trains.

    Raises
    ------
    QuestionError
        If trains are weighed one by one, by measured sizes or by class.
    """
    if not found.topologies:
        if not sum(each.mechanisms for each in found.counts):
            return ()
        what = "no trains can be drawn where each is weighed by itself"
        fix = "list them instead (--all), or ask without measured sizes and with `--per mechanism`"
        raise QuestionError(Problem(what, "they are drawn from sums over trains that weigh the same", fix))
    weights = [topology_prior(each.topology, problem) for each in found.topologies]
    whole = whole_multiple(weights)
    shares = [weight * each.mechanisms for weight, each in zip(whole, found.topologies, strict=True)]
    ranks = weight_ranks((weight, each.mechanisms) for weight, each in zip(weights, found.topologies, strict=True))
    trains, chance = TopologyTrains(problem, dials), Random(seed)
    drawn = []
    for _ in range(number):
        at = draw_index(shares, chance)
        topology, weight = found.topologies[at].topology, weights[at]
        share = float(Fraction(whole[at], sum(shares)))
        drawn.append(Candidate(trains.draw(topology, chance), topology.added.number, share, ranks[weight]))
    return tuple(drawn)
