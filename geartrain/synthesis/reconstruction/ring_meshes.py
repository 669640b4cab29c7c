"""What meshes with a ring: wheels with fewer teeth that are no rings. So an order of arbors may limit added counts."""

from __future__ import annotations

from collections.abc import Iterator

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.synthesis.reconstruction.skeletons import AddedWheels, CountLimit, Dials, Skeleton

Rings = frozenset[str]
"""Names of rings."""


def may_mesh(wheel: PlacedWheel, mate: PlacedWheel, rings: Rings) -> bool:
    """Whether no ring keeps two wheels apart; an added one whose count is open may still be small enough."""
    internal, mate_internal = wheel.name in rings, mate.name in rings
    if internal == mate_internal:
        return not internal
    ring, inside = (wheel, mate) if internal else (mate, wheel)
    return inside.teeth < ring.teeth


def rings_mesh(arbor: Arbor, rings: Rings) -> bool:
    """Whether all rings from an arbor on mesh with wheels that fit into them."""
    return all(may_mesh(wheel, mate, rings) for wheel, mate in _meshes(arbor))


def rings_limit(skeleton: Skeleton, rings: Rings, greatest: int) -> bool:
    """Whether an order may limit counts below the greatest: whether a ring is so small."""
    return any(wheel.name in rings and wheel.teeth <= greatest for wheel in skeleton.used)


class CountTokens:
    """Added wheels by numbers below 0 instead of counts, so that their mates in an order can be told."""

    def __init__(self, added: AddedWheels) -> None:
        self._owners: list[tuple[Dials, bool]] = []
        self.counts = {
            dials: (self._tokens(dials, True, drivers), self._tokens(dials, False, driven))
            for dials, drivers, driven in added.groups
        }
        self.idle = self._tokens((), False, added.idle)

    def _tokens(self, dials: Dials, drives: bool, wheels: int) -> tuple[int, ...]:
        first = len(self._owners)
        self._owners += [(dials, drives)] * wheels
        return tuple(-at - 1 for at in range(first, first + wheels))

    def limits(self, arbor: Arbor, rings: Rings, greatest: int) -> tuple[CountLimit, ...]:
        """The limits below the greatest count that rings set in a train whose added wheels have tokens, sorted."""
        most = self.most(arbor, rings, greatest)
        return tuple(sorted(CountLimit(*self.owner(token), count) for token, count in most.items()))

    def owner(self, token: int) -> tuple[Dials, bool]:
        """The dials whose speed a wheel changes, and whether it drives on the way to them."""
        return self._owners[-token - 1]

    def most(self, arbor: Arbor, rings: Rings, greatest: int) -> dict[int, int]:
        """The same limits by token."""
        least: dict[int, int] = {}
        for pair in _meshes(arbor):
            for ring, inside in (pair, pair[::-1]):
                if ring.name in rings and inside.teeth < 0:
                    least[inside.teeth] = min(least.get(inside.teeth, greatest), ring.teeth - 1)
        return {token: count for token, count in least.items() if count < greatest}


def _meshes(arbor: Arbor) -> Iterator[tuple[PlacedWheel, PlacedWheel]]:
    for wheel, child in arbor.driven_arbors():
        assert child.driven is not None
        yield wheel, child.driven
        yield from _meshes(child)
