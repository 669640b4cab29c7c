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
from typing import NamedTuple

from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, SurvivingGeometry

_MINIMUM = -700.0  # exp(-700) is still positive; only an impossible candidate has likelihood 0


def candidate_likelihood(arbor: Arbor, geometry: SurvivingGeometry) -> float:
    """Return the likelihood of the measurements for a candidate, up to a factor common to all candidates; 0 if the
    candidate is impossible.

    arbor   input arbor of the candidate
    """
    if not (geometry.wheels or geometry.arbors):
        return 1.0
    distances = 0.0
    for parent, wheel, child in arbor.meshes():
        assert child.driven is not None
        if not geometry.may_mesh(parent.name, wheel, child.name, child.driven):
            return 0.0
        square, radii = geometry.square_distance(parent.name, child.name), geometry.radii_sum(wheel, child.driven)
        if square is not None and radii is not None:
            # log(a^2/b^2)^2 / 4 = log(a/b)^2, without the square root of the distance
            distances += math.log(radii**2 / square) ** 2 / 4
    # wheels driven by an idler share the mesh in which it is driven, and are counted there; the exact sum does not
    # depend on the order of the arbors, so that equal trains have equal weights
    drives = (drive for each in arbor.arbors() for drive in each.drives)
    modules = math.fsum(_module_misfit(wheel, children, geometry).misfit for wheel, children in drives)
    misfit = modules / float(geometry.module) ** 2 + distances / float(geometry.distance) ** 2
    return math.exp(max(-misfit / 2, _MINIMUM))


class _Misfit(NamedTuple):
    """Misfit of a part of a train as a function of x, the natural logarithm of the module of a wheel: stiffness * (x -
    centre)^2 + misfit.
    """

    stiffness: float
    centre: float
    misfit: float


def _module_misfit(wheel: PlacedWheel, children: tuple[Arbor, ...], geometry: SurvivingGeometry) -> _Misfit:
    """Return the misfit as a function of the module of a wheel: the misfit of its measurement plus the misfits of the
    arbors that it drives. The unknown modules of these arbors are eliminated, from the leaves to the wheel.
    """
    terms = []
    for child in children:
        assert child.driven is not None
        below = _module_misfit(child.driven, child.passes, geometry)
        # springs in series: the mesh has stiffness 1
        stiffness = 1.0 if below.stiffness == math.inf else below.stiffness / (1 + below.stiffness)
        terms.append(below._replace(stiffness=stiffness))
    module, error = geometry.module_of(wheel), geometry.radius
    if module is not None and error is None:
        # a module measured without error cannot be adjusted
        total, centre = math.inf, math.log(module)
    else:
        if module is not None and error is not None:
            radius = module * wheel.teeth / 2
            terms.append(_Misfit(float(geometry.module * radius / error) ** 2, math.log(module), 0.0))
        total = sum(term.stiffness for term in terms)
        centre = sum(term.stiffness * term.centre for term in terms) / total if total else 0.0
    return _Misfit(total, centre, sum(term.misfit + term.stiffness * (centre - term.centre) ** 2 for term in terms))
