"""What all trains of a question say of single facts: weights and numbers, summed exactly without listing a train."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from geartrain.synthesis.reconstruction.explained_facts import (
    AN_ADDED_ARBOR,
    YES,
    Fact,
    FactTally,
    lost_pointers,
    wheels_in_doubt,
)
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeleton_orders import AddedPlace, NamedMesh
from geartrain.synthesis.reconstruction.skeleton_trains import OrderPart, SkeletonTrains
from geartrain.synthesis.reconstruction.skeletons import Skeleton

MOST_SUMMED = 20_000_000
"""Trains up to which sums over choices of counts are fast."""


def sum_facts(
    weighed: Iterable[tuple[Skeleton, Fraction]], problem: ReconstructionProblem, dials: Sequence[str]
) -> FactTally:
    """What the trains of skeletons say, each skeleton with the weight of one of its trains."""
    trains, sums = SkeletonTrains(problem, dials), FactTally(problem)
    lost, doubtful = lost_pointers(problem), wheels_in_doubt(problem)
    for skeleton, weight in weighed:
        parts = [part for part in trains.parts(skeleton) if part.choices and part.orders.total]
        number = sum(part.choices * part.orders.total for part in parts)
        sums.add_trains(weight, number)
        for fact, answer in _everywhere(skeleton, lost, doubtful):
            sums.add(fact, answer, weight, number)
        for part in parts:
            for fact, answer, own in _told(part, trains):
                sums.add(fact, answer, weight, own)
    return sums


def _everywhere(skeleton: Skeleton, lost: set[str], doubtful: set[str]) -> Iterator[tuple[Fact, str]]:
    """What holds in each train of a skeleton."""
    for joint in skeleton.joints:
        for dial in lost.intersection(joint.here):
            yield Fact("pointer", dial), joint.name or AN_ADDED_ARBOR
    for wheel in skeleton.used:
        assert wheel.name is not None
        yield Fact("used", wheel.name), YES
        if wheel.name in doubtful:
            yield Fact("count", wheel.name), str(wheel.teeth)


def _told(part: OrderPart, trains: SkeletonTrains) -> Iterator[tuple[Fact, str, int]]:
    """What holds in some trains of a part, and in how many."""
    for told, orders in part.orders.marginals.items():
        if isinstance(told, NamedMesh):
            for fact, answer in _of_mesh(told):
                yield fact, answer, int(orders) * part.choices
        elif isinstance(told, AddedPlace):
            for count, choices in trains.counts.of_kind(part.open, told.kind).items():
                yield Fact("added", told.name), str(count), int(orders) * choices
    for count, choices in trains.counts.with_any(part.open).items():
        yield Fact("needed", str(count)), YES, int(part.orders.total) * choices


def _of_mesh(mesh: NamedMesh) -> Iterator[tuple[Fact, str]]:
    driving, wheel, arbor = mesh
    assert arbor.driven is not None
    yield Fact("mesh", f"{wheel.name} > {arbor.driven.name}"), YES
    if wheel.placed.name is not None and arbor.driven.placed.name is not None:
        yield Fact("pair", " and ".join(sorted((wheel.name, arbor.driven.name)))), YES
    if not arbor.added:
        yield Fact("driver", arbor.name), AN_ADDED_ARBOR if driving.added else driving.name
