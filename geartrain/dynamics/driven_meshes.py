"""The gear pairs with real teeth as they are driven, in one state or over all of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from geartrain.teeth.gear_mesh import GearMesh

DrivenWays = Mapping[str, Sequence[tuple[GearMesh, tuple[str, ...]]]]
"""By pair, the ways it is driven, each with the names of its states."""


def find_driven_ways(teeth: Iterable[GearMesh], driven: Iterable[tuple[str | None, Sequence[GearMesh]]]) -> DrivenWays:
    """The ways in which pairs are driven; one whose driver is open counts both.

    driven   by state, the pairs as they are driven in it; None for a train without states
    """
    found: dict[str, list[tuple[GearMesh, tuple[str, ...]]]] = {mesh.name: [] for mesh in teeth}
    for state, meshes in driven:
        for mesh in meshes:
            for way in mesh.ways:
                _count(found[mesh.name], way, state)
    return found


def likeliest_ways(ways: DrivenWays) -> tuple[GearMesh, ...]:
    """Each pair as in the first state that tells who drives it."""
    return tuple(next((way for way, _ in each if way.who.known), each[0][0]) for each in ways.values())


def _count(ways: list[tuple[GearMesh, tuple[str, ...]]], mesh: GearMesh, state: str | None) -> None:
    """Count a state for one way in which a pair is driven; a way that is certain somewhere is so in the list."""
    own = () if state is None else (state,)
    for at, (known, states) in enumerate(ways):
        if known.driver == mesh.driver:
            ways[at] = (known if known.who.known else mesh), states + own
            return
    ways.append((mesh, own))
