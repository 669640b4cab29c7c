"""Whether the wheels of a candidate can be stacked in layers so that no wheel goes through an arbor.

Wheels that mesh are in one layer. A wheel whose pitch circle holds the axis of another arbor must lie above or below
all wheels of that arbor: the stretch between them is the arbor itself. Layers are put on each other from below; what
may come next depends on which are there already, not on their order, so every set of layers is looked at once. Bearings
and what runs out to a dial are not looked at, nor arbors without a place; arbors on one axis pass through each other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.synthesis.reconstruction.surviving_geometry import SurvivingGeometry

_MOST_LAYERS = 16
"""Beyond them nothing is said: the number of sets doubles with each."""
_Member = tuple[str | None, Fraction]
"""Arbor of a wheel, and the least pitch radius that it may have."""
_Layer = tuple[_Member, ...]
"""Wheels that mesh, the driving one first."""


def layers_exist(arbor: Arbor, geometry: SurvivingGeometry) -> bool:
    """Whether an order of layers exists; True where nothing bounds distances."""
    if geometry.reach is None:
        return True
    layers = list(_layers(arbor, geometry))
    # wheels that mesh reach each other, which is looked at elsewhere, and so overlap no more than may be misfit
    if any(_overlap(one, other, geometry) for layer in layers for one, other in combinations(layer, 2)):
        return False
    of_arbor = {name: _layers_of(name, layers) for layer in layers for name, _ in layer if name in geometry.places}
    blocked = [
        tuple(own for name, own in of_arbor.items() if any(_holds(wheel, name, geometry) for wheel in layer))
        for layer in layers
    ]
    return len(layers) > _MOST_LAYERS or order_exists(blocked)


def order_exists(blocked: Sequence[Sequence[frozenset[int]]]) -> bool:
    """Whether layers can be put on each other.

    blocked   for every layer, sets of layers of which none is below it or all are, itself left out
    """
    every = frozenset(range(len(blocked)))

    @cache
    def may_end(below: frozenset[int]) -> bool:
        return below == every or any(
            may_end(below | {layer})
            for layer in every - below
            if all(others <= below or not others & below for others in blocked[layer])
        )

    return may_end(frozenset())


def _layers(arbor: Arbor, geometry: SurvivingGeometry) -> Iterator[_Layer]:
    for wheel, children in arbor.drives:
        yield tuple(_layer(arbor.name, wheel, children, geometry))
        for child in children:
            yield from _layers_below(child, geometry)


def _layers_below(arbor: Arbor, geometry: SurvivingGeometry) -> Iterator[_Layer]:
    """Layers of what an arbor drives, but for those of its driven wheel itself."""
    yield from _layers(arbor, geometry)
    for child in arbor.passes:
        yield from _layers_below(child, geometry)


def _layer(
    name: str | None, wheel: PlacedWheel, children: Sequence[Arbor], geometry: SurvivingGeometry
) -> Iterator[_Member]:
    mates = [child.driven for child in children if child.driven is not None]
    yield name, max(_least_radius(wheel, mate, geometry) for mate in mates)
    for child, mate in zip(children, mates, strict=True):
        yield child.name, _least_radius(mate, wheel, geometry)
        if child.passes:
            yield from list(_layer(child.name, mate, child.passes, geometry))[1:]


def _least_radius(wheel: PlacedWheel, mate: PlacedWheel, geometry: SurvivingGeometry) -> Fraction:
    bounds = geometry.module_bounds((wheel.name, wheel.teeth), (mate.name, mate.teeth))
    return Fraction(0) if bounds is None else max(Fraction(0), bounds[0] * wheel.teeth / 2)


def _layers_of(name: str | None, layers: Sequence[_Layer]) -> frozenset[int]:
    return frozenset(at for at, layer in enumerate(layers) if any(arbor == name for arbor, _ in layer))


def _holds(wheel: _Member, name: str | None, geometry: SurvivingGeometry) -> bool:
    """Whether the axis of an arbor goes through a wheel."""
    return _nearer(wheel[0], name, wheel[1], geometry)


def _overlap(one: _Member, other: _Member, geometry: SurvivingGeometry) -> bool:
    return _nearer(one[0], other[0], one[1] + other[1], geometry)


def _nearer(one: str | None, other: str | None, length: Fraction, geometry: SurvivingGeometry) -> bool:
    """Whether two axes are nearer than a length, beyond what may be misfit, and not the same."""
    square = geometry.square_distance(one, other)
    assert geometry.reach is not None
    return square is not None and 0 < square < max(Fraction(0), length - geometry.reach) ** 2
