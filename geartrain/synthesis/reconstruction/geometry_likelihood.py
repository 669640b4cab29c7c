"""How well a candidate agrees with measured modules, radii and places of axes: a weight in floats, 0 if impossible.

Every mesh of two measured wheels weighs exp(-(e/s)^2 / 2), e the logarithm of the quotient of their modules. A wheel
that was not measured has the module that suits those around it best. So misfits add up like springs: from a wheel whose
module is known a mesh pulls with stiffness 1, from one that is itself held by stiffness k it pulls with k/(1 + k). A
measured radius with an error is such a spring, too: it holds its wheel with stiffness (s*radius/error)^2.
A mesh of two axes with places weighs exp(-(f/s')^2 / 2), f the logarithm of the sum of pitch radii over their distance.
Misfits of modules and of distances count as independent.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from geartrain.synthesis.reconstruction.arbor_chains import chains_close
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.synthesis.reconstruction.surviving_geometry import SurvivingGeometry
from geartrain.synthesis.reconstruction.wheel_layers import layers_exist


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
    return math.exp(max(-(modules + distances) / 2, _LEAST))


_LEAST = -700.0  # its exponential is still above 0, which alone says impossible
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
