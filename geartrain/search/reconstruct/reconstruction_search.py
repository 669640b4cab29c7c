"""Exact number of trains that solve a reconstruction problem, and list of the most probable ones. Topologies are
weighted, and the most probable trains are listed or sampled.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple, dataclass
from fractions import Fraction
from itertools import groupby, islice
from typing import TYPE_CHECKING, Literal, TypeVar

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import plural
from geartrain.numerics.results import Key, Result
from geartrain.numerics.work import Execution
from geartrain.search.reconstruct.added_counts import AddedCounts
from geartrain.search.reconstruct.arbor_orders import arranged
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.search_tasks import CountedTopology, count_topologies

if TYPE_CHECKING:
    from geartrain.search.reconstruct.train_topology import Topology

_LISTED = 20_000
"""Maximum number of candidates that are constructed, unless a larger number is to be listed. Further candidates of the
same weight are omitted.
"""
_MOST_CLASSIFIED = 300_000
"""Maximum number of choices of tooth counts for which multisets of arbors and ratio classes are counted."""

_Weight = TypeVar("_Weight", Fraction, float)
_Wheel = tuple[str, int]
_Step = tuple[str, _Wheel, _Wheel]
"""Arbor on a path: its name, its driven wheel and its driving wheel."""

_NONE: _Wheel = ("", 0)


@dataclass(frozen=True, slots=True)
class ExplanationCount(Result):
    """Number of trains, and of equivalence classes of trains, that explain the evidence with a given number of added
    wheels.

    See Also
    --------
    find_reconstructions : Find the trains that solve a problem.
    """

    added: int
    """Number of added wheels in each of these trains."""
    solutions: int
    """Number of different trains that explain the evidence."""
    multisets: int | None
    """Number of classes of trains, where trains that differ only in the order of the arbors along a path are counted
    once; None if there are too many trains.
    """
    classes: int | None
    """Number of classes of trains, where trains with the same driving wheels and the same driven wheels on each path,
    and therefore equal ratios, are counted once; None if there are too many trains.
    """


def explanations_text(counts: Sequence[ExplanationCount]) -> str:
    """Return one line of text with the number of trains that explain the evidence for each number of added wheels."""
    found = (f"{each.solutions:,} with {plural(each.added, 'added wheel')}" for each in counts if each.solutions)
    return f"explanations: {', '.join(found) or 'none'}"


@dataclass(frozen=True, slots=True)
class Candidate(Result):
    """Candidate reconstruction: a train that explains the evidence of a problem.

    See Also
    --------
    find_reconstructions : Find the trains that solve a problem.
    """

    KEYS = ("added", Key("weight", to=float), "ranks")

    arbor: Arbor
    """Input arbor of the train, with the subtree that it drives."""
    added: int
    """Number of added wheels in the train."""
    weight: float
    """Posterior probability of the train, 0 to 1."""
    ranks: tuple[int, int]
    """First and last rank of the train by probability, starting with 1. They differ if several trains are equally
    probable.
    """


@dataclass(frozen=True, slots=True)
class WeightClass(Result):
    """Class of reconstructed trains with the same number of added wheels and the same weight."""

    added: int
    """Number of added wheels in each train of the class."""
    weight: Fraction
    """Weight of each train of the class, up to a factor common to all trains. Weights are proportional to
    probabilities.
    """
    solutions: int
    """Number of trains in the class."""


@dataclass(frozen=True, slots=True)
class Reconstructions(Result):
    """Number of all trains that solve a reconstruction problem, and the most probable of these trains.

    See Also
    --------
    find_reconstructions : Find the trains that solve a problem.
    """

    KEYS = ("counts", "complete", "candidates")

    counts: tuple[ExplanationCount, ...]
    """Number of trains that solve the problem, for each number of added wheels, starting with 0."""
    complete: bool
    """True if the search covered all candidates."""
    candidates: tuple[Candidate, ...]
    """Candidates in descending order of probability."""
    topologies: tuple[CountedTopology, ...] = ()
    """All topologies, each with the number of its trains; empty if trains are weighted individually."""
    weights: tuple[WeightClass, ...] = ()
    """Number of trains for each weight, in ascending order of the number of added wheels, then in descending order of
    weight.
    """

    def _summary(self) -> str:
        listed = f"{len(self.candidates)} listed" + ("" if self.complete else ", incomplete")
        return f"{explanations_text(self.counts)}, {listed}"


def find_reconstructions(
    problem: ReconstructionProblem,
    execution: Execution | None = None,
    listed: int = 1000,
    prior_of: Literal["solution", "class"] = "solution",
) -> Reconstructions:
    """Count all trains that solve a reconstruction problem with at most the permitted number of added wheels, and list
    the most probable trains.

    Parameters
    ----------
    problem : ReconstructionProblem
        Reconstruction problem.
    execution : Execution, optional
        Executor of the parts of the search. By default the parts are executed one after the other in this process.
    listed : int
        Minimum number of candidates to list. If there are fewer candidates, all are listed.
    prior_of : {"solution", "class"}
        Unit of the prior: one weight for every train, or one weight for every class of trains with equal driving wheels
        and equal driven wheels on each path, divided among these trains.

    Returns
    -------
    Reconstructions

    Raises
    ------
    QuestionError
        If too many trains would have to be weighted individually, because weights depend on ratio classes or measured
        sizes.

    Examples
    --------
    >>> from geartrain.search.reconstruct import evidence_question, read_evidence
    >>> found = find_reconstructions(evidence_question(read_evidence("metonic-l-m")).problem)
    >>> [count.solutions for count in found.counts], found.candidates[0].weight
    ([0, 2], 0.5)
    """
    found: dict[int, list[CountedTopology]] = {added: [] for added in range(problem.additions.wheels + 1)}
    whole: set[int] = set()
    geometry = problem.geometry
    one_by_one = prior_of == "class" or bool(geometry.wheels or geometry.arbors)
    try:
        for task, topologies in count_topologies(problem, execution):
            found[task.added] += topologies
            if task.part + 1 == task.parts:
                whole.add(task.added)
    except KeyboardInterrupt:
        # a number of added wheels that was searched only in part has no exact count
        found = {added: topologies for added, topologies in found.items() if added in whole}
    complete = len(whole) == problem.additions.wheels + 1
    if one_by_one:
        return _weighed_one_by_one(problem, found, complete, prior_of)
    counts = tuple(_count(added, some, problem) for added, some in found.items())
    every = tuple(each for some in found.values() for each in some)
    weighed = ((each.topology.added.number, topology_prior(each.topology, problem), each.solutions) for each in every)
    return Reconstructions(
        counts, complete, tuple(_best(problem, found, listed)), every, tuple(_weight_classes(weighed))
    )


def _weight_classes(weighed: Iterable[tuple[int, Fraction, int]]) -> Iterator[WeightClass]:
    """Yield the classes of trains with equal weight, computed from triples (number of added wheels, weight, number of
    trains).
    """
    alike = Counter[tuple[int, Fraction]]()
    for added, weight, number in weighed:
        alike[added, weight] += number
    for added, weight in sorted(alike, key=lambda one: (one[0], -one[1])):
        yield WeightClass(added, weight, alike[added, weight])


def _count(added: int, topologies: Sequence[CountedTopology], problem: ReconstructionProblem) -> ExplanationCount:
    solutions = sum(each.solutions for each in topologies)
    # the order of arbors changes neither key, unless a ring limits the counts of added wheels in some orders
    rings, maximum = problem.rings, problem.additions.maximum
    marked = [
        (each, not any(wheel.name in rings and wheel.teeth <= maximum for wheel in each.topology.used))
        for each in topologies
    ]
    if sum(each.choices if one_order else each.solutions for each, one_order in marked) > _MOST_CLASSIFIED:
        return ExplanationCount(added, solutions, None, None)
    some = [arbor for each, one_order in marked for arbor in _trains(each, problem, one_order)]
    return ExplanationCount(added, solutions, len({*map(arbor_multiset, some)}), len({*map(ratio_class, some)}))


def _trains(each: CountedTopology, problem: ReconstructionProblem, one_order: bool = False) -> Iterator[Arbor]:
    """Yield all trains of a topology. If `one_order` is True, yield only one order of arbors for each choice of tooth
    counts.
    """
    limits = problem.additions
    topology = each.topology
    for counts, idle in AddedCounts(limits.minimum, limits.maximum).assignments(topology.added, topology.wanted):
        yield from islice(arranged(topology, counts, idle, None if one_order else problem), 1 if one_order else None)


def _best(problem: ReconstructionProblem, found: dict[int, list[CountedTopology]], listed: int) -> Iterator[Candidate]:
    """Yield candidates in descending order of probability. Equally probable candidates are ordered by the number of
    added wheels, then by the sum of the tooth counts of these wheels.
    """
    weighed = [(topology_prior(each.topology, problem), added, each) for added, some in found.items() for each in some]
    whole = sum(weight * each.solutions for weight, _, each in weighed)
    # ranks cover all trains, listed or not
    ranks = weight_ranks((weight, each.solutions) for weight, _, each in weighed)
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
    """Return the sort key for candidates of equal weight: the sum of the tooth counts of added wheels, then the
    candidate as text.
    """
    return sum(wheel.teeth for wheel in arbor.wheels() if wheel.name is None), repr(astuple(arbor))


def _weighed_one_by_one(
    problem: ReconstructionProblem, found: dict[int, list[CountedTopology]], complete: bool, prior_of: str
) -> Reconstructions:
    """Return all trains that solve the problem, each with a weight computed from its likelihood. If `prior_of` is
    "class", the weight also depends on the size of the ratio class. Candidates with likelihood 0 are omitted.
    """
    number = sum(each.solutions for some in found.values() for each in some)
    if number > _LISTED:
        what = f"{number} trains would have to be weighted individually; the limit is {_LISTED}"
        why = "weights by class or by measured sizes are computed for each train"
        fix = "add fewer wheels (--max-added), or use `--prior solution` without `geometry`"
        raise QuestionError(Problem(what, why, fix))
    counts, weighed = [], []
    for added, topologies in found.items():
        own = []
        for arbor in (arbor for each in topologies for arbor in _trains(each, problem)):
            likelihood = candidate_likelihood(arbor, problem.geometry)
            if likelihood:
                own.append((float(train_prior(arbor, problem)) * likelihood, added, arbor))
        arbors = [arbor for _, _, arbor in own]
        counts.append(
            ExplanationCount(added, len(own), len({*map(arbor_multiset, arbors)}), len({*map(ratio_class, arbors)}))
        )
        weighed += own
    if prior_of == "class":
        classes: dict[object, int] = {}
        for _, _, arbor in weighed:
            classes[ratio_class(arbor)] = classes.get(ratio_class(arbor), 0) + 1
        # the trains of a class share its weight
        weighed = [(weight / classes[ratio_class(arbor)], added, arbor) for weight, added, arbor in weighed]
    weighed.sort(key=lambda one: (-one[0], one[1], _order(one[2])))
    whole = sum(weight for weight, _, _ in weighed)
    ranks = weight_ranks((weight, 1) for weight, _, _ in weighed)
    candidates = tuple(Candidate(arbor, added, weight / whole, ranks[weight]) for weight, added, arbor in weighed)
    weights = _weight_classes((one.added, Fraction(one.weight), 1) for one in candidates)
    return Reconstructions(tuple(counts), complete, candidates, weights=tuple(weights))


def rank_of(arbor: Arbor, found: Reconstructions) -> tuple[int, int] | None:
    """Return the first and last rank by probability of a candidate; None if the candidate is not listed."""
    wanted = train_key(arbor)
    return next((one.ranks for one in found.candidates if train_key(one.arbor) == wanted), None)


def is_all_listed(found: Reconstructions) -> bool:
    """Return whether the list contains all trains that were counted."""
    return found.complete and len(found.candidates) == sum(count.solutions for count in found.counts)


# ---------------------------------------------------------------------------------- prior weights, and ranks by weight


def topology_prior(topology: Topology, problem: ReconstructionProblem) -> Fraction:
    """Return the prior weight of each train of a topology, up to a factor common to all trains."""
    return _prior(problem, topology.added.number, topology.added_arbors, topology.used)


def train_prior(arbor: Arbor, problem: ReconstructionProblem) -> Fraction:
    """Return the prior weight of a candidate, up to a factor common to all candidates."""
    used = [wheel for wheel in arbor.wheels() if wheel.name is not None]
    return _prior(problem, arbor.added_wheels, arbor.added_arbors, used)


def _prior(problem: ReconstructionProblem, wheels: int, arbors: int, used: Iterable[PlacedWheel]) -> Fraction:
    """Return the prior weight of a train with given numbers of added wheels and added arbors, and with the surviving
    wheels `used`.
    """
    factors, limits = problem.factors, problem.additions
    counts = {wheel.name: dict(wheel.counts) for each in (problem.input, *problem.arbors) for wheel in each.wheels}
    weight, unused = Fraction(1), len(counts)
    for wheel in used:
        weight *= counts[wheel.name or ""][wheel.teeth]
        unused -= 1
    # the tooth count of an added wheel has a uniform prior
    added = (factors.wheel * (limits.maximum - limits.minimum + 1)) ** wheels * factors.arbor**arbors
    return weight / (added * factors.unused**unused)


def weight_ranks(weighed: Iterable[tuple[_Weight, int]]) -> dict[_Weight, tuple[int, int]]:
    """Rank candidates by weight, and return the first and the last rank of the candidates with each weight. The input
    consists of pairs of a weight and a number of candidates with this weight.
    """
    alike = Counter[_Weight]()
    for weight, number in weighed:
        alike[weight] += number
    found, before = {}, 0
    for weight in sorted(alike, reverse=True):
        found[weight] = before + 1, before + alike[weight]
        before += alike[weight]
    return found


# -------------------------------------- equality: of trains, up to the order of arbors, up to driving and driven wheels


def train_key(arbor: Arbor) -> tuple[object, ...]:
    """Return a hashable key of a complete candidate. The key does not depend on the order of its parts."""
    passed = tuple(sorted(map(train_key, arbor.passes)))
    drives = tuple(sorted((_wheel(wheel), tuple(sorted(map(train_key, below)))) for wheel, below in arbor.drives))
    return arbor.name or "", _wheel(arbor.driven), arbor.dials, drives, passed


def arbor_multiset(arbor: Arbor) -> tuple[object, ...]:
    """Return, for the path to each dial, the multiset of the arbors on this path with their wheels."""
    return tuple(sorted((dial, tuple(sorted(path))) for dial, path in _paths(arbor)))


def ratio_class(arbor: Arbor) -> tuple[object, ...]:
    """Return, for the path to each dial, the multiset of driving wheels and the multiset of driven wheels."""
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
