"""Whether arbors without a known place can stand where their meshes need them, between arbors that have one.

Between two placed arbors every chain of arbors without a place is a polygon: its sides are the distance of the two and
those of the meshes, each within bounds. It can be closed in the plane if and only if no side must be longer than all
others may be together. Each chain is looked at alone: where three meet, more may be impossible than is found here.
"""

from __future__ import annotations

import math
from itertools import combinations, product

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.synthesis.reconstruction.surviving_geometry import SurvivingGeometry

Sides = tuple[tuple[float, float], ...]
"""Bounds of the distances of a chain of meshes."""

_Chain = tuple[str, Sides]
"""The placed arbor where it ends, and its sides."""
_ROUNDING = 1e-9  # of a length: what floats may be off


def chains_close(arbor: Arbor, geometry: SurvivingGeometry) -> bool:
    """Whether every chain between placed arbors can be closed; True where distances are not bounded."""
    return geometry.reach is None or _chains(arbor, geometry) is not None


def can_close(distance: float, sides: Sides) -> bool:
    """Whether a polygon can be closed of one side of a length and others within bounds."""
    slack = _ROUNDING * (distance + sum(low for low, _ in sides))
    lengths = ((distance, distance), *sides)
    return all(
        low <= sum(high for other, (_, high) in enumerate(lengths) if other != at) + slack
        for at, (low, _) in enumerate(lengths)
    )


def _chains(arbor: Arbor, geometry: SurvivingGeometry) -> list[_Chain] | None:
    """Chains from an arbor down to placed ones; None if one between two placed arbors cannot be closed."""
    by_child: list[list[_Chain]] = []
    for wheel, child in arbor.driven_arbors():
        below = _chains(child, geometry)
        if below is None:
            return None
        side = _side(wheel, child, geometry)
        by_child.append([(end, (side, *sides)) for end, sides in below])
    if arbor.name is not None and arbor.name in geometry.places:
        closed = all(_closes(arbor.name, chain, geometry) for chains in by_child for chain in chains)
        return [(arbor.name, ())] if closed else None
    for some, others in combinations(by_child, 2):
        for (end, sides), (other, more) in product(some, others):
            if not _closes(end, (other, sides + more), geometry):
                return None
    return [chain for chains in by_child for chain in chains]


def _closes(start: str, chain: _Chain, geometry: SurvivingGeometry) -> bool:
    square = geometry.square_distance(start, chain[0])
    assert square is not None
    return can_close(math.sqrt(square), chain[1])


def _side(wheel: PlacedWheel, child: Arbor, geometry: SurvivingGeometry) -> tuple[float, float]:
    assert child.driven is not None
    bounds = geometry.distance_bounds((wheel.name, wheel.teeth), (child.driven.name, child.driven.teeth))
    return (0.0, math.inf) if bounds is None else (float(bounds[0]), float(bounds[1]))
