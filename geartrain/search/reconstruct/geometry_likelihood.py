"""Likelihood of a candidate by measured modules, radii and places of axes: a float, 0 if it is impossible.

Every mesh of two measured wheels weighs exp(-(e/s)^2 / 2), e the logarithm of the quotient of their modules. A wheel
that was not measured has the module that suits those around it best. So misfits add up like springs: from a wheel whose
module is known a mesh pulls with stiffness 1, from one that is itself held by stiffness k it pulls with k/(1 + k). A
measured radius with an error is such a spring, too: it holds its wheel with stiffness (s*radius/error)^2.
A mesh of two axes with places weighs exp(-(f/s')^2 / 2), f the logarithm of the sum of pitch radii over their distance.
Misfits of modules and of distances count as independent.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from typing import NamedTuple

from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, SurvivingGeometry

# Whether arbors without a known place can stand where their meshes need them, between arbors that have one. Between
# two placed arbors every chain of arbors without a place is a polygon: its sides are the distance of the two and
# those of the meshes, each within bounds. It can be closed in the plane if and only if no side must be longer than
# all others may be together. Each chain is looked at alone: where three meet, more may be impossible than is found
# here.


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


# Dynamic programming over bit masks: whether the wheels of a candidate can be stacked in layers so that no wheel
# goes through an arbor. Wheels that mesh are in one layer. A wheel whose pitch circle holds the axis of another
# arbor must lie above or below all wheels of that arbor: the stretch between them is the arbor itself. Layers are
# put on each other from below; what may come next depends on which are there already, not on their order, so every
# set of layers is looked at once. Bearings and what runs out to a dial are not looked at, nor arbors without a
# place; arbors on one axis pass through each other.


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
    yield name, max(_minimum_radius(wheel, mate, geometry) for mate in mates)
    for child, mate in zip(children, mates, strict=True):
        yield child.name, _minimum_radius(mate, wheel, geometry)
        if child.passes:
            yield from list(_layer(child.name, mate, child.passes, geometry))[1:]


def _minimum_radius(wheel: PlacedWheel, mate: PlacedWheel, geometry: SurvivingGeometry) -> Fraction:
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


def candidate_likelihood(arbor: Arbor, geometry: SurvivingGeometry) -> float:
    """Weight of what was measured, up to a factor that all candidates share; 0 if the candidate is impossible.

    arbor   the candidate from its input on
    """
    if not (geometry.wheels or geometry.arbors):
        return 1.0
    meshes = tuple(_meshes(arbor))
    if not all(geometry.may_mesh(*one.driving, *one.driven) for one in meshes):
        return 0.0
    if not (chains_close(arbor, geometry) and layers_exist(arbor, geometry)):
        return 0.0
    modules = _Modules(geometry).misfit(arbor) / float(geometry.module) ** 2
    distances = sum(_distance_misfit(one, geometry) for one in meshes) / float(geometry.distance) ** 2
    return math.exp(max(-(modules + distances) / 2, _MINIMUM))


_MINIMUM = -700.0  # its exponential is still above 0, which alone says impossible
_End = tuple[str | None, tuple[str | None, int]]
"""Arbor, and name and count of a wheel on it."""


class _Mesh(NamedTuple):
    driving: _End
    driven: _End


def _meshes(arbor: Arbor) -> Iterator[_Mesh]:
    for wheel, child in arbor.driven_arbors():
        assert child.driven is not None
        yield _Mesh((arbor.name, _size(wheel)), (child.name, _size(child.driven)))
        yield from _meshes(child)


def _size(wheel: PlacedWheel) -> tuple[str | None, int]:
    return wheel.name, wheel.teeth


def _distance_misfit(mesh: _Mesh, geometry: SurvivingGeometry) -> float:
    """Square of the logarithm of the sum of pitch radii over the distance; 0 where one of them is not known."""
    square = geometry.square_distance(mesh.driving[0], mesh.driven[0])
    whole = geometry.radii_sum(mesh.driving[1], mesh.driven[1])
    return 0.0 if square is None or whole is None else math.log(whole**2 / square) ** 2 / 4


class _Pull(NamedTuple):
    """How a part of the train holds the logarithm of a module: stiffness * (x - centre)^2 + misfit at least."""

    stiffness: float
    centre: float
    misfit: float


@dataclass(frozen=True)
class _Modules:
    """Least sum of squared misfits of modules."""

    geometry: SurvivingGeometry

    def misfit(self, arbor: Arbor) -> float:
        """Of all meshes from an arbor on."""
        # wheels that a driven wheel drives belong to the mesh in which it is driven, and are counted there
        own = sum(self._around(wheel, children).misfit for wheel, children in arbor.drives)
        return own + sum(self.misfit(child) for _, child in arbor.driven_arbors())

    def _around(self, wheel: PlacedWheel, children: Iterable[Arbor]) -> _Pull:
        """What a wheel is held by: its own measure, else the wheels that it drives."""
        pulls = [self._through_mesh(child) for child in children]
        module = self.geometry.module_of(_size(wheel))
        stiffness = 0.0 if module is None else self._stiffness(module * wheel.teeth / 2)
        if module is not None and stiffness < math.inf:
            pulls.append(_Pull(stiffness, math.log(module), 0.0))
        if stiffness < math.inf:
            stiffness = sum(pull.stiffness for pull in pulls)
            centre = sum(pull.stiffness * pull.centre for pull in pulls) / stiffness if stiffness else 0.0
        else:
            assert module is not None
            centre = math.log(module)
        misfit = sum(pull.misfit + pull.stiffness * (centre - pull.centre) ** 2 for pull in pulls)
        return _Pull(stiffness, centre, misfit)

    def _stiffness(self, radius: Fraction) -> float:
        """How a measured pitch radius holds its module, beside a mesh."""
        error = self.geometry.radius
        return math.inf if error is None else float(self.geometry.module * radius / error) ** 2

    def _through_mesh(self, child: Arbor) -> _Pull:
        """What a wheel is held by through its mesh with a wheel that it drives."""
        assert child.driven is not None
        held = self._around(child.driven, child.passes)
        stiffness = 1.0 if held.stiffness == math.inf else held.stiffness / (1 + held.stiffness)
        return _Pull(stiffness, held.centre, held.misfit)
