"""From a question to exact counts and to candidates: topologies are weighed, the best trains are listed or drawn."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from itertools import groupby, islice
from random import Random
from typing import TYPE_CHECKING, Literal, TypeVar

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import plural, whole_multiple
from geartrain.numerics.results import Key, Result
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts
from geartrain.search.reconstruct.arbor_orders import MeshFacts, arranged, rings_limit
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.search_tasks import CountedTopology, TopologyTrains, count_topologies
from geartrain.search.weighted_alternatives import draw_index

if TYPE_CHECKING:
    from geartrain.search.reconstruct.train_topology import Topology

_LISTED = 20_000
"""Candidates that are made at most; of more of one weight, the first that are found."""
_TOLD_APART = 300_000
"""Choices of counts up to which bags and classes are counted."""

_Weight = TypeVar("_Weight", Fraction, float)
_Wheel = tuple[str, int]
_Step = tuple[str, _Wheel, _Wheel]
"""An arbor on a path: its name, the wheel by which it is driven and the one by which the path goes on."""

_NONE: _Wheel = ("", 0)


@dataclass(frozen=True, slots=True)
class ExplanationCount(Result):
    """How many explanations there are with just so many added wheels.

    See Also
    --------
    find_reconstructions : gives it.
    """

    added: int
    """Added wheels."""
    mechanisms: int
    """Trains, all different."""
    bags: int | None
    """Trains that differ by more than the order of arbors on the path of a dial; None where they are too many."""
    classes: int | None
    """Trains that differ by more than which wheel drives which on the path of a dial; None likewise."""


def explanations_text(counts: Sequence[ExplanationCount]) -> str:
    """Return how many trains explain the evidence, by number of added wheels, in a line."""
    found = (f"{each.mechanisms:,} with {plural(each.added, 'added wheel')}" for each in counts if each.mechanisms)
    return f"explanations: {', '.join(found) or 'none'}"


@dataclass(frozen=True, slots=True)
class Candidate(Result):
    """One explanation.

    See Also
    --------
    find_reconstructions : finds it.
    """

    KEYS = ("added", Key("weight", to=float), "ranks")

    arbor: Arbor
    """The train from its input on."""
    added: int
    """Added wheels."""
    weight: float
    """Its share of the weight of all explanations."""
    ranks: tuple[int, int]
    """First and last rank by weight that it may have among all explanations, from 1 on; some may weigh the same."""


@dataclass(frozen=True, slots=True)
class WeightClass(Result):
    """Explanations of one weight."""

    added: int
    """Added wheels of each."""
    weight: Fraction
    """What each weighs before its dials are looked at, up to a factor that all share."""
    mechanisms: int
    """How many they are."""


@dataclass(frozen=True, slots=True)
class Reconstructions(Result):
    """All explanations of a question, counted, and the best of them.

    See Also
    --------
    find_reconstructions : gives it.
    """

    KEYS = ("counts", "complete", "candidates")

    counts: tuple[ExplanationCount, ...]
    """By number of added wheels, from 0 on."""
    complete: bool
    """Whether all were looked at."""
    candidates: tuple[Candidate, ...]
    """The best first."""
    topologies: tuple[CountedTopology, ...] = ()
    """All structures with the numbers of their trains, where each train weighs as its structure; else none."""
    weights: tuple[WeightClass, ...] = ()
    """All trains by number of added wheels and weight, the greatest first; none where each is weighed by itself."""

    def _summary(self) -> str:
        listed = f"{len(self.candidates)} listed" + ("" if self.complete else ", incomplete")
        return f"{explanations_text(self.counts)}, {listed}"


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
        The typed question.
    execution : Execution, optional
        How the parts of the search are done; default one after the other in this process.
    listed : int
        How many candidates are listed at least, where there are so many.
    per : {"mechanism", "class"}
        What has a weight of its own: every train, or every ratio class, whose trains then share it.

    Returns
    -------
    Reconstructions

    Raises
    ------
    QuestionError
        If more trains than can be listed would have to be, to share weights by class or to weigh measured sizes.

    Examples
    --------
    >>> from geartrain.search.reconstruct import evidence_question, read_evidence
    >>> found = find_reconstructions(evidence_question(read_evidence("metonic-l-m")).problem)
    >>> [count.mechanisms for count in found.counts], found.candidates[0].weight
    ([0, 2], 0.5)
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
    maximum = problem.additions.maximum
    told = [(each, not rings_limit(each.topology, problem.rings, maximum)) for each in topologies]
    if sum(each.choices if one_order else each.mechanisms for each, one_order in told) > _TOLD_APART:
        return ExplanationCount(added, mechanisms, None, None)
    some = [arbor for each, one_order in told for arbor in _trains(each, problem, one_order)]
    return ExplanationCount(added, mechanisms, len({*map(bag, some)}), len({*map(ratio_class, some)}))


def _trains(each: CountedTopology, problem: ReconstructionProblem, one_order: bool = False) -> Iterator[Arbor]:
    """All trains of a topology; or with each choice of counts one, its arbors in any order."""
    limits = problem.additions
    facts = MeshFacts() if one_order else MeshFacts.of(problem)
    topology = each.topology
    for counts, idle in AddedCounts(limits.minimum, limits.maximum).assignments(topology.added, topology.wanted):
        yield from islice(arranged(topology, counts, idle, facts), 1 if one_order else None)


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
    return sum(wheel.teeth for wheel in arbor.wheels() if wheel.name is None), _written_out(arbor)


def _written_out(value: object) -> str:
    """A candidate with all its parts as text, which orders candidates that are alike otherwise."""
    if isinstance(value, Arbor | PlacedWheel):
        parts = (f"{each.name}={_written_out(getattr(value, each.name))}" for each in fields(value))
        return f"{type(value).__name__}({', '.join(parts)})"
    if isinstance(value, tuple):
        return f"({', '.join(map(_written_out, value))}{',' * (len(value) == 1)})"
    return repr(value)


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


def draw_candidates(
    found: Reconstructions, problem: ReconstructionProblem, dials: Sequence[str], number: int, seed: int
) -> tuple[Candidate, ...]:
    """Draw candidates independently of each other; one may come several times.

    Parameters
    ----------
    found : Reconstructions
        All explanations of the question.
    problem : ReconstructionProblem
        The typed question.
    dials : sequence of str
        In the order of the evidence.
    number : int
        How many are drawn, from 0 on.
    seed : int
        The same seed draws the same trains.

    Returns
    -------
    tuple of Candidate

    Raises
    ------
    QuestionError
        If trains are weighed one by one, by measured sizes or by class.

    Examples
    --------
    >>> from geartrain.search.reconstruct import evidence_question, read_evidence
    >>> problem = evidence_question(read_evidence("metonic-l-m")).problem
    >>> [each.added for each in draw_candidates(find_reconstructions(problem), problem, ["metonic"], 3, seed=1)]
    [1, 1, 1]
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


def rank_of(arbor: Arbor, found: Reconstructions) -> tuple[int, int] | None:
    """First and last rank by weight that a candidate may have among all, for some weigh the same.

    None if it is not listed.
    """
    wanted = mechanism(arbor)
    return next((one.ranks for one in found.candidates if mechanism(one.arbor) == wanted), None)


def is_all_listed(found: Reconstructions) -> bool:
    """Whether every explanation that is counted is listed."""
    return found.complete and len(found.candidates) == sum(count.mechanisms for count in found.counts)


# ---------------------------------------------------------------------------------- prior weights, and ranks by weight


def topology_prior(topology: Topology, problem: ReconstructionProblem) -> Fraction:
    """Weight of each of a topology's trains before its dials are looked at, up to a factor that all share."""
    added = added_prior(problem, topology.added.number, topology.added_arbors)
    return added * survivors_prior(problem, topology.used)


def prior(arbor: Arbor, problem: ReconstructionProblem) -> Fraction:
    """Weight of a candidate before its dials are looked at, up to a factor that all candidates share."""
    used = [wheel for wheel in arbor.wheels() if wheel.name is not None]
    return added_prior(problem, arbor.added_wheels, arbor.added_arbors) * survivors_prior(problem, used)


def added_prior(problem: ReconstructionProblem, wheels: int, arbors: int) -> Fraction:
    """What so many added wheels and arbors weigh."""
    factors, limits = problem.factors, problem.additions
    return 1 / ((factors.wheel * (limits.maximum - limits.minimum + 1)) ** wheels * factors.arbor**arbors)


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


# ------------------------------------------ equality: of mechanisms, up to the order of arbors, up to what drives what


def mechanism(arbor: Arbor) -> tuple[object, ...]:
    """All of a candidate, in whatever order its parts were found."""
    passed = tuple(sorted(map(mechanism, arbor.passes)))
    drives = tuple(sorted((_wheel(wheel), tuple(sorted(map(mechanism, below)))) for wheel, below in arbor.drives))
    return arbor.name or "", _wheel(arbor.driven), arbor.dials, drives, passed


def bag(arbor: Arbor) -> tuple[object, ...]:
    """For every dial, which arbors are on its path and through which wheels, without their order."""
    return tuple(sorted((dial, tuple(sorted(path))) for dial, path in _paths(arbor)))


def ratio_class(arbor: Arbor) -> tuple[object, ...]:
    """For every dial, which wheels drive and which are driven on its path."""
    return tuple(
        sorted(
            (dial, tuple(sorted(step[2] for step in path[:-1])), tuple(sorted(step[1] for step in path[1:])))
            for dial, path in _paths(arbor)
        )
    )


def _paths(arbor: Arbor, before: tuple[_Step, ...] = ()) -> Iterator[tuple[str, tuple[_Step, ...]]]:
    name, driven = arbor.name or "", _wheel(arbor.driven)
    for dial in arbor.dials:
        yield dial, (*before, (name, driven, _NONE))
    for child in arbor.passes:
        yield from _paths(child, (*before, (name, driven, driven)))
    for wheel, children in arbor.drives:
        for child in children:
            yield from _paths(child, (*before, (name, driven, _wheel(wheel))))


def _wheel(wheel: PlacedWheel | None) -> _Wheel:
    return _NONE if wheel is None else (wheel.name or "", wheel.teeth)
