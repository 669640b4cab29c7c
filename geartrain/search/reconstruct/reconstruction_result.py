"""Results of a search: exact counts, and candidates in the order of their prior weight."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, TypeVar

from geartrain.numerics.results import Key, Result
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.search_tasks import CountedTopology

if TYPE_CHECKING:
    from geartrain.search.reconstruct.train_topology import Topology


# What a candidate weighs before its dials are looked at, and the ranks of candidates by weight.


_Weight = TypeVar("_Weight", Fraction, float)


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


# When two candidates are the same: altogether, but for the order of arbors on a path, or but for what drives what.


_Wheel = tuple[str, int]
_Step = tuple[str, _Wheel, _Wheel]
"""An arbor on a path: its name, the wheel by which it is driven and the one by which the path goes on."""

_NONE: _Wheel = ("", 0)


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


@dataclass(frozen=True, slots=True)
class ExplanationCount(Result):
    """How many explanations there are with just so many added wheels.

    Attributes
    ----------
    added : int
        Added wheels.
    mechanisms : int
        Trains, all different.
    bags : int or None
        Trains that differ by more than the order of arbors on the path of a dial; None where they are too many.
    classes : int or None
        Trains that differ by more than which wheel drives which on the path of a dial; None likewise.
    """

    added: int
    mechanisms: int
    bags: int | None
    classes: int | None


@dataclass(frozen=True, slots=True)
class Candidate(Result):
    """One explanation.

    Attributes
    ----------
    arbor : Arbor
        The train from its input on.
    added : int
        Added wheels.
    weight : float
        Its share of the weight of all explanations.
    ranks : tuple of int
        First and last rank by weight that it may have among all explanations, from 1 on; some may weigh the same.
    """

    KEYS = ("added", Key("weight", to=float), "ranks")

    arbor: Arbor
    added: int
    weight: float
    ranks: tuple[int, int]


@dataclass(frozen=True, slots=True)
class WeightClass(Result):
    """Explanations of one weight.

    Attributes
    ----------
    added : int
        Added wheels of each.
    weight : Fraction
        What each weighs before its dials are looked at, up to a factor that all share.
    mechanisms : int
        How many they are.
    """

    added: int
    weight: Fraction
    mechanisms: int


@dataclass(frozen=True, slots=True)
class Reconstructions(Result):
    """All explanations of a question, counted, and the best of them.

    Attributes
    ----------
    counts : tuple of ExplanationCount
        By number of added wheels, from 0 on.
    complete : bool
        Whether all were looked at.
    candidates : tuple of Candidate
        The best first.
    topologies : tuple of CountedTopology
        All structures with the numbers of their trains, where each train weighs as its structure; else none.
    weights : tuple of WeightClass
        All trains by number of added wheels and weight, the greatest first; none where each is weighed by itself.
    """

    KEYS = ("counts", "complete", "candidates")

    counts: tuple[ExplanationCount, ...]
    complete: bool
    candidates: tuple[Candidate, ...]
    topologies: tuple[CountedTopology, ...] = ()
    weights: tuple[WeightClass, ...] = ()
