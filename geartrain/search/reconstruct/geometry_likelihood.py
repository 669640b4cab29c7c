"""Likelihood of a candidate by measured modules, radii and positions of axes: a float, 0 if it is impossible.

Every mesh of two measured wheels contributes exp(-(e/s)^2 / 2), where e is the logarithm of the ratio of their modules
and s its standard deviation. A wheel that was not measured has the module that fits the adjacent wheels best. Misfits
therefore combine like springs: a mesh with a wheel of known module has stiffness 1, and a mesh with a wheel that is
itself supported with stiffness k has stiffness k/(1 + k). A measured radius with an error also acts as a spring of
stiffness (s*radius/error)^2.

A mesh of two axes with known positions contributes exp(-(f/s')^2 / 2), where f is the logarithm of the sum of the pitch
radii divided by the distance between the axes. Misfits of modules and of distances are treated as independent.
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

# Feasibility of the positions of arbors without known position, between arbors with known positions. A chain of such
# arbors between two known ones is a polygon, whose sides are the distance between the two and the axis distances of the
# meshes, each within bounds. The polygon can be closed in the plane if and only if no side must be longer than the sum
# of the maxima of the others. Each chain is tested separately, so this condition is necessary but not sufficient where
# three chains meet.


Sides = tuple[tuple[float, float], ...]
"""Minimum and maximum axis distance of each mesh of a chain [mm]."""

_Chain = tuple[str, Sides]
"""Arbor with a known position at which a chain ends, and the axis distances of the meshes on the chain."""
_ROUNDING = 1e-9  # relative rounding error of a length


def chains_close(arbor: Arbor, geometry: SurvivingGeometry) -> bool:
    """Return whether every chain between arbors of known position can be closed; True if distances are not bounded."""
    return geometry.reach is None or _chains(arbor, geometry) is not None


def can_close(distance: float, sides: Sides) -> bool:
    """Return whether a polygon can be closed, with one side of length `distance` and further sides within bounds
    [mm].
    """
    slack = _ROUNDING * (distance + sum(low for low, _ in sides))
    lengths = ((distance, distance), *sides)
    return all(
        low <= sum(high for other, (_, high) in enumerate(lengths) if other != at) + slack
        for at, (low, _) in enumerate(lengths)
    )


def _chains(arbor: Arbor, geometry: SurvivingGeometry) -> list[_Chain] | None:
    """Return the chains from an arbor down to arbors of known position; None if the centre distances of one chain
    cannot connect its two known positions.
    """
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


# Dynamic programming over subsets (bit masks): can the wheels of a candidate be stacked in layers so that no wheel
# intersects an arbor? Wheels that mesh are in one layer. A wheel whose pitch circle contains the axis of another arbor
# must be above or below all wheels of that arbor, because the arbor extends between them. Layers are stacked from
# below. The permitted next layers depend only on the set of layers already stacked, not on their order, so each set is
# visited once. Bearings, extensions of arbors to dials, and arbors without a known position are ignored; arbors on one
# axis may be nested.


_MOST_LAYERS = 16
"""Maximum number of layers that are checked, because the number of subsets doubles with each layer."""
_Member = tuple[str | None, Fraction]
"""Arbor of a wheel, and the minimum pitch radius of the wheel [mm]."""
_Layer = tuple[_Member, ...]
"""Wheels that mesh with each other, the driving wheel first."""


def layers_exist(arbor: Arbor, geometry: SurvivingGeometry) -> bool:
    """Return whether the wheels can be stacked in layers without intersecting arbors; True if distances are not
    bounded.
    """
    if geometry.reach is None:
        return True
    layers = list(_layers(arbor, geometry))
    # wheels that mesh are tested elsewhere, and overlap only within the permitted misfit
    if any(_overlap(one, other, geometry) for layer in layers for one, other in combinations(layer, 2)):
        return False
    of_arbor = {name: _layers_of(name, layers) for layer in layers for name, _ in layer if name in geometry.places}
    blocked = [
        tuple(own for name, own in of_arbor.items() if any(_contains_axis(wheel, name, geometry) for wheel in layer))
        for layer in layers
    ]
    return len(layers) > _MOST_LAYERS or order_exists(blocked)


def order_exists(blocked: Sequence[Sequence[frozenset[int]]]) -> bool:
    """Return whether the layers can be stacked in some order.

    blocked for each layer, sets of layers; all layers of a set must be on the same side of the layer, below or
    above it
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
    """Yield the layers in the subtree of an arbor, without the layer of its driven wheel."""
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


def _contains_axis(wheel: _Member, name: str | None, geometry: SurvivingGeometry) -> bool:
    """Return whether the axis of an arbor is within the pitch circle of a wheel."""
    return _is_nearer(wheel[0], name, wheel[1], geometry)


def _overlap(one: _Member, other: _Member, geometry: SurvivingGeometry) -> bool:
    return _is_nearer(one[0], other[0], one[1] + other[1], geometry)


def _is_nearer(one: str | None, other: str | None, length: Fraction, geometry: SurvivingGeometry) -> bool:
    """Return whether two different axes are closer than a length [mm] minus the permitted misfit."""
    square = geometry.square_distance(one, other)
    assert geometry.reach is not None
    return square is not None and 0 < square < max(Fraction(0), length - geometry.reach) ** 2


def candidate_likelihood(arbor: Arbor, geometry: SurvivingGeometry) -> float:
    """Return the likelihood of the measurements for a candidate, up to a common factor; 0 if the candidate is
    impossible.

    arbor   input arbor of the candidate
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


_MINIMUM = -700.0  # exp(-700) is still positive; only an impossible candidate has likelihood 0
_End = tuple[str | None, tuple[str | None, int]]
"""Mesh partner: name of an arbor, and name and tooth count of a wheel on it."""


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
    """Return the squared logarithm of the sum of pitch radii divided by the axis distance; 0 if one of them is not
    known.
    """
    square = geometry.square_distance(mesh.driving[0], mesh.driven[0])
    whole = geometry.radii_sum(mesh.driving[1], mesh.driven[1])
    # log(a^2/b^2)^2 / 4 = log(a/b)^2, without the square root of the distance
    return 0.0 if square is None or whole is None else math.log(whole**2 / square) ** 2 / 4


class _Pull(NamedTuple):
    """Misfit of a part of a train, stiffness * (x - centre)^2 + misfit, where x is the logarithm of a module."""

    stiffness: float
    centre: float
    misfit: float


@dataclass(frozen=True)
class _Modules:
    """Minimum sum of squared misfits of modules, computed by elimination of the unknown modules from the leaves up."""

    geometry: SurvivingGeometry

    def misfit(self, arbor: Arbor) -> float:
        """Return the minimum misfit of all meshes in the subtree of an arbor."""
        # wheels driven by an idler share the mesh in which it is driven, and are counted there
        own = sum(self._misfit_of_wheel(wheel, children).misfit for wheel, children in arbor.drives)
        return own + sum(self.misfit(child) for _, child in arbor.driven_arbors())

    def _misfit_of_wheel(self, wheel: PlacedWheel, children: Iterable[Arbor]) -> _Pull:
        """Return the misfit as a function of the module of a wheel, from its measurement and the wheels that it
        drives.
        """
        pulls = [self._misfit_through_mesh(child) for child in children]
        module = self.geometry.module_of(_size(wheel))
        stiffness = 0.0 if module is None else self._stiffness(module * wheel.teeth / 2)
        if module is not None and stiffness < math.inf:
            pulls.append(_Pull(stiffness, math.log(module), 0.0))
        if stiffness < math.inf:
            stiffness = sum(pull.stiffness for pull in pulls)
            centre = sum(pull.stiffness * pull.centre for pull in pulls) / stiffness if stiffness else 0.0
        else:
            assert module is not None
            # a module measured without error cannot be adjusted
            centre = math.log(module)
        misfit = sum(pull.misfit + pull.stiffness * (centre - pull.centre) ** 2 for pull in pulls)
        return _Pull(stiffness, centre, misfit)

    def _stiffness(self, radius: Fraction) -> float:
        """Return the stiffness of a measured pitch radius [mm], relative to the stiffness of a mesh."""
        error = self.geometry.radius
        return math.inf if error is None else float(self.geometry.module * radius / error) ** 2

    def _misfit_through_mesh(self, child: Arbor) -> _Pull:
        """Return the misfit as a function of the module of a driving wheel, from its mesh with the arbor `child`."""
        assert child.driven is not None
        held = self._misfit_of_wheel(child.driven, child.passes)
        # springs in series: the mesh has stiffness 1
        stiffness = 1.0 if held.stiffness == math.inf else held.stiffness / (1 + held.stiffness)
        return _Pull(stiffness, held.centre, held.misfit)
