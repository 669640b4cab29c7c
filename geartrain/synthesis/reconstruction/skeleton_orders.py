"""What holds in how many of a skeleton's trains, by the orders of arbors on its limbs, and orders drawn.

From the driving wheel on, a limb goes on with one of the arbors that are left. What follows depends on which those are
and on the wheel that drives alone, not on how it came to that, so that orders are summed and not listed.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

from geartrain.numerics.weighted_alternatives import Alternative, WeightedAlternatives
from geartrain.synthesis.reconstruction.added_count_sums import AddedKind
from geartrain.synthesis.reconstruction.arrangements import COMPOUND, IDLER, MeshFacts
from geartrain.synthesis.reconstruction.named_skeleton import (
    NamedJoint,
    NamedLimb,
    SkeletonArbor,
    SkeletonWheel,
)

_Pairs = frozenset[frozenset[str]]
_Driving = tuple[SkeletonArbor, SkeletonWheel]


class NamedMesh(NamedTuple):
    """That a wheel of one arbor drives one of another."""

    arbor: SkeletonArbor
    wheel: SkeletonWheel
    driven: SkeletonArbor


class AddedPlace(NamedTuple):
    """That an added wheel of some name is of some kind."""

    name: str
    kind: AddedKind


class LimbStep(NamedTuple):
    """Which arbor stands at a place on a limb: the number of a surviving one, -1 with two added wheels, -2 an idler."""

    limb: NamedLimb
    place: int
    which: int


@dataclass(frozen=True)
class _Ahead:
    """What is left to be put on a limb, what drives it, and pairs that must mesh there or below."""

    limb: NamedLimb
    through: frozenset[int]
    compounds: int
    idlers: int
    driving: _Driving
    pairs: _Pairs


class _Start(NamedTuple):
    """An arbor at which paths end or part, and pairs that must mesh below it."""

    joint: NamedJoint
    pairs: _Pairs


def skeleton_orders(root: NamedJoint, facts: MeshFacts) -> WeightedAlternatives[Hashable]:
    """The orders of a skeleton that agree with what is known of meshes, each of weight 1."""
    return WeightedAlternatives(_Start(root, facts.meshes), _Orders(facts).alternatives)


@dataclass(frozen=True)
class _Orders:
    facts: MeshFacts

    def alternatives(self, node: Hashable) -> Iterator[Alternative[Hashable]]:
        """What may come next."""
        if not isinstance(node, _Ahead):
            assert isinstance(node, _Start)
            joint, pairs = node
            places = tuple(_place(wheel) for wheel in joint.wheels() if wheel.kind is not None)
            yield from self._onward(joint, pairs, places)
            return
        for at in node.through:
            yield from self._step(node, node.limb.through[at], at, node.through - {at}, node.compounds, node.idlers)
        added = node.limb.added[len(node.limb.added) - node.compounds - node.idlers :]
        if node.compounds:
            yield from self._step(node, added[0][0], COMPOUND, node.through, node.compounds - 1, node.idlers)
        if node.idlers:
            yield from self._step(node, added[0][1], IDLER, node.through, node.compounds, node.idlers - 1)
        if not node.through and not added:
            yield from self._end(node)

    def _step(
        self, node: _Ahead, arbor: SkeletonArbor, which: int, through: frozenset[int], compounds: int, idlers: int
    ) -> Iterator[Alternative[Hashable]]:
        """The arbor that stands next."""
        left = self._left(node, arbor)
        if left is None:
            return
        assert arbor.driver is not None
        place = node.limb.limb.arbors - len(through) - compounds - idlers - 1
        wheels = dict.fromkeys([arbor.driven, arbor.driver])
        places = tuple(_place(wheel) for wheel in wheels if wheel is not None and wheel.kind is not None)
        ahead = _Ahead(node.limb, through, compounds, idlers, (arbor, arbor.driver), left)
        tells = (NamedMesh(*node.driving, arbor), LimbStep(node.limb, place, which), *places)
        yield Alternative(1, tells, (ahead,))

    def _end(self, node: _Ahead) -> Iterator[Alternative[Hashable]]:
        """What a limb ends with."""
        end = node.limb.end
        if not isinstance(end, NamedJoint):
            yield from self._hung([(node.driving, limb) for limb in end], node.pairs, ())
            return
        left = self._left(node, end.arbor)
        if left is not None:
            yield Alternative(1, (NamedMesh(*node.driving, end.arbor),), (_Start(end, left),))

    def _left(self, node: _Ahead, arbor: SkeletonArbor) -> _Pairs | None:
        """Pairs that must mesh still after an arbor is driven; None if it must not be driven so."""
        source, wheel = node.driving
        met = self.facts.met((source.survivor, wheel.placed), arbor.survivor, arbor.driven and arbor.driven.placed)
        return None if met is None or not met <= node.pairs else node.pairs - met

    def _onward(self, joint: NamedJoint, pairs: _Pairs, tells: tuple[Hashable, ...]) -> Iterator[Alternative[Hashable]]:
        hung = [((joint.arbor, wheel), limb) for wheel, limbs in joint.hanging for limb in limbs]
        yield from self._hung(hung, pairs, tells)

    def _hung(
        self, hung: list[tuple[_Driving, NamedLimb]], pairs: _Pairs, tells: tuple[Hashable, ...]
    ) -> Iterator[Alternative[Hashable]]:
        """Limbs that hang side by side, with each way in which the pairs may be shared out among them."""
        known = sorted(pairs, key=sorted)
        # a pair may mesh only where both of its wheels are: on a limb, below it, or driving it
        inside = [limb.surviving_wheels | {driving[1].name} for driving, limb in hung]
        able = [[at for at, wheels in enumerate(inside) if pair <= wheels] for pair in known]
        for owners in product(*able):
            parts = tuple(
                _Ahead(
                    limb,
                    frozenset(range(len(limb.through))),
                    limb.limb.compounds,
                    limb.limb.idlers,
                    driving,
                    frozenset(pair for pair, owner in zip(known, owners, strict=True) if owner == at),
                )
                for at, (driving, limb) in enumerate(hung)
            )
            yield Alternative(1, tells, parts)


def _place(wheel: SkeletonWheel) -> AddedPlace:
    assert wheel.kind is not None
    return AddedPlace(wheel.name, wheel.kind)
