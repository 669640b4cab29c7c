"""All trains of a skeleton as orders times choices of counts: what holds in how many of them, and trains drawn.

Orders and counts are independent but where rings limit counts in some orders. Then orders are parted by the limits, and
are independent of the counts in each part.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from random import Random
from typing import NamedTuple

from geartrain.numerics.weighted_alternatives import Alternative, WeightedAlternatives, draw_index
from geartrain.synthesis.reconstruction.added_count_sums import AddedCountSums, AddedKind, OpenCounts
from geartrain.synthesis.reconstruction.added_counts import AddedCounts
from geartrain.synthesis.reconstruction.arrangements import MeshFacts, arranged, in_order
from geartrain.synthesis.reconstruction.named_skeleton import SkeletonArbor, SkeletonWheel, name_skeleton
from geartrain.synthesis.reconstruction.named_train import NamedArbor, NamedWheel, name_train
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.ring_meshes import CountTokens, rings_limit
from geartrain.synthesis.reconstruction.skeleton_orders import AddedPlace, LimbStep, NamedMesh, skeleton_orders
from geartrain.synthesis.reconstruction.skeletons import Skeleton


class OrderPart(NamedTuple):
    """Orders of one skeleton in all of which the added counts have the same choices.

    A train is one of the orders and one of the choices. The orders tell `NamedMesh` and `AddedPlace`.
    """

    open: OpenCounts
    choices: int
    orders: WeightedAlternatives[Hashable]


class SkeletonTrains:
    """Sums over the trains of a question's skeletons, and draws from them.

    Parameters
    ----------
    problem : ReconstructionProblem
    dials : sequence of str
        In the order of the evidence.
    """

    def __init__(self, problem: ReconstructionProblem, dials: Sequence[str]) -> None:
        limits, arbors = problem.additions, (problem.input, *problem.arbors)
        self.counts = AddedCountSums(AddedCounts(limits.least, limits.greatest))
        self._facts, self._greatest = MeshFacts.of(problem), limits.greatest
        links, wheels = {arbor.name for arbor in arbors}, {wheel.name for arbor in arbors for wheel in arbor.wheels}
        self._names = tuple(dials), links, wheels

    def count(self, skeleton: Skeleton) -> int:
        """How many trains it is."""
        if not self._facts.are_any:
            return skeleton.orders * self.counts.total(OpenCounts(skeleton.added, skeleton.wanted))
        return sum(part.choices * part.orders.total for part in self.parts(skeleton))

    def parts(self, skeleton: Skeleton) -> list[OrderPart]:
        """All trains of a skeleton, every one in one part."""
        if not rings_limit(skeleton, self._facts.rings, self._greatest):
            orders = skeleton_orders(name_skeleton(skeleton, *self._names), self._facts)
            return [self._part(OpenCounts(skeleton.added, skeleton.wanted), orders)]
        tokens = CountTokens(skeleton.added)
        by_limits: dict[OpenCounts, list[Arbor]] = defaultdict(list)
        for arbor in arranged(skeleton, tokens.counts, tokens.idle, self._facts):
            limits = tokens.limits(arbor, self._facts.rings, self._greatest)
            by_limits[OpenCounts(skeleton.added, skeleton.wanted, limits)].append(arbor)
        return [self._part(asked, self._listed(tokens, arbors)) for asked, arbors in by_limits.items()]

    def _part(self, asked: OpenCounts, orders: WeightedAlternatives[Hashable]) -> OrderPart:
        return OrderPart(asked, self.counts.total(asked), orders)

    def _listed(self, tokens: CountTokens, arbors: list[Arbor]) -> WeightedAlternatives[Hashable]:
        """Orders one by one, as trains with tokens for counts."""

        def each(_: Hashable) -> Iterator[Alternative[Hashable]]:
            for arbor in arbors:
                named = name_train(arbor, *self._names)
                yield Alternative(1, (*_meshes(named), *self._places(tokens, arbor, named), arbor))

        return WeightedAlternatives((), each)

    def _places(self, tokens: CountTokens, arbor: Arbor, named: NamedArbor) -> Iterator[AddedPlace]:
        kinds = self._kinds(tokens, arbor)
        for wheel in (wheel for each in named.arbors() for wheel in each.wheels() if wheel.added):
            yield AddedPlace(wheel.name, kinds(wheel.teeth))

    def _kinds(self, tokens: CountTokens, arbor: Arbor) -> Callable[[int], AddedKind]:
        most = tokens.most(arbor, self._facts.rings, self._greatest)
        return lambda token: AddedKind(*tokens.owner(token), most.get(token))

    def draw(self, skeleton: Skeleton, chance: Random) -> Arbor:
        """One of the trains of a skeleton, each with the same chance."""
        parts = self.parts(skeleton)
        part = parts[draw_index([part.choices * part.orders.total for part in parts], chance)]
        told, tokens = part.orders.draw(chance), CountTokens(skeleton.added)
        arbor = next((one for one in told if isinstance(one, Arbor)), None)
        if arbor is None:
            steps = sorted((one for one in told if isinstance(one, LimbStep)), key=lambda one: one.place)
            orders: dict[int, list[int]] = {id(limb): [] for limb in skeleton.limbs}
            for step in steps:
                orders[id(step.limb.limb)].append(step.which)
            arbor = in_order(skeleton, orders, tokens.counts, tokens.idle)
        kinds, asked, counts = self._kinds(tokens, arbor), part.open, dict[int, int]()
        for token in _tokens(arbor):
            counts[token], asked = self.counts.draw(asked, kinds(token), chance)
        return _with_counts(arbor, counts)


def _meshes(named: NamedArbor) -> Iterator[NamedMesh]:
    for driving, wheel, driven in named.meshes():
        assert driven.driven is not None
        yield NamedMesh(_arbor(driving, None), _wheel(wheel), _arbor(driven, _wheel(driven.driven)))


def _arbor(named: NamedArbor, driven: SkeletonWheel | None) -> SkeletonArbor:
    return SkeletonArbor(named.name, named.added, driven, None)


def _wheel(named: NamedWheel) -> SkeletonWheel:
    return SkeletonWheel(named.name, PlacedWheel(None if named.added else named.name, named.teeth), None)


def _tokens(arbor: Arbor) -> Iterator[int]:
    own = [wheel for wheel, _ in arbor.drives] + ([] if arbor.driven is None else [arbor.driven])
    yield from (wheel.teeth for wheel in own if wheel.name is None)
    for _, child in arbor.driven_arbors():
        yield from _tokens(child)


def _with_counts(arbor: Arbor, counts: Mapping[int, int]) -> Arbor:
    """A train with counts for its tokens."""

    def counted(wheel: PlacedWheel) -> PlacedWheel:
        return wheel if wheel.name is not None else PlacedWheel(None, counts[wheel.teeth])

    drives = ((counted(wheel), tuple(_with_counts(one, counts) for one in below)) for wheel, below in arbor.drives)
    passes = tuple(_with_counts(one, counts) for one in arbor.passes)
    driven = None if arbor.driven is None else counted(arbor.driven)
    return Arbor(arbor.name, driven, arbor.dials, tuple(drives), passes)
