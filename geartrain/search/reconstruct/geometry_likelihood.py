"""Likelihood of a candidate, given measured modules, radii and positions of axes; 0 if the candidate is impossible.

Every mesh of two measured wheels contributes the factor exp(-(e/s)^2 / 2), where e is the natural logarithm of the
ratio of their modules and s is the standard deviation of e. A wheel that was not measured has the module that fits its
mates best. Misfits therefore combine like springs. A mesh with a wheel whose module is known has stiffness 1, and a
mesh with a wheel that is itself supported with stiffness k has stiffness k/(1 + k). A measured radius with a stated
error acts as a spring with the stiffness (s*radius/error)^2.

A mesh between two axes with known positions contributes the factor exp(-(f/s')^2 / 2), where f is the natural logarithm
of the sum of the pitch radii divided by the distance between the axes, and s' is the standard deviation of f. Misfits
of modules and of distances are treated as independent.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, SurvivingGeometry


def candidate_likelihood(arbor: Arbor, geometry: SurvivingGeometry) -> float:
    """Return the likelihood of the measurements for a candidate, up to a factor common to all candidates; 0 if the
    candidate is impossible.

    arbor   input arbor of the candidate
    """
    if not (geometry.wheels or geometry.arbors):
        return 1.0
    meshes = tuple(_meshes(arbor))
    if not all(geometry.may_mesh(*one.driving, *one.driven) for one in meshes):
        return 0.0
    modules = _Modules(geometry).misfit(arbor) / float(geometry.module) ** 2
    distances = sum(_distance_misfit(one, geometry) for one in meshes) / float(geometry.distance) ** 2
    return math.exp(max(-(modules + distances) / 2, _MINIMUM))


_MINIMUM = -700.0  # exp(-700) is still positive; only an impossible candidate has likelihood 0
_End = tuple[str | None, tuple[str | None, int]]
"""Wheel of a mesh: name of its arbor, and the name and the tooth count of the wheel."""


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
    """Return the squared natural logarithm of the sum of the pitch radii divided by the axis distance; 0 if a pitch
    radius or the axis distance is not known.
    """
    square = geometry.square_distance(mesh.driving[0], mesh.driven[0])
    whole = geometry.radii_sum(mesh.driving[1], mesh.driven[1])
    # log(a^2/b^2)^2 / 4 = log(a/b)^2, without the square root of the distance
    return 0.0 if square is None or whole is None else math.log(whole**2 / square) ** 2 / 4


class _Pull(NamedTuple):
    """Misfit of a part of a train as the function stiffness * (x - centre)^2 + misfit of x, the natural logarithm of a
    module.
    """

    stiffness: float
    centre: float
    misfit: float


@dataclass(frozen=True)
class _Modules:
    """Least-squares fit of the modules of a train. The unknown modules are eliminated one by one, from the leaves of
    the train to its root.
    """

    geometry: SurvivingGeometry

    def misfit(self, arbor: Arbor) -> float:
        """Return the minimum total misfit of the meshes in the subtree of an arbor."""
        # wheels driven by an idler share the mesh in which it is driven, and are counted there
        own = sum(self._misfit_of_wheel(wheel, children).misfit for wheel, children in arbor.drives)
        return own + sum(self.misfit(child) for _, child in arbor.driven_arbors())

    def _misfit_of_wheel(self, wheel: PlacedWheel, children: Iterable[Arbor]) -> _Pull:
        """Return the misfit as a function of the module of a wheel: the misfit of the measurement of the wheel plus the
        misfits of the arbors that it drives.
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
        """Return the stiffness of a measured pitch radius [mm], divided by the stiffness of a mesh."""
        error = self.geometry.radius
        return math.inf if error is None else float(self.geometry.module * radius / error) ** 2

    def _misfit_through_mesh(self, child: Arbor) -> _Pull:
        """Return the misfit of the arbor `child` and its subtree as a function of the module of the wheel that drives
        `child`.
        """
        assert child.driven is not None
        held = self._misfit_of_wheel(child.driven, child.passes)
        # springs in series: the mesh has stiffness 1
        stiffness = 1.0 if held.stiffness == math.inf else held.stiffness / (1 + held.stiffness)
        return _Pull(stiffness, held.centre, held.misfit)
