"""Gears on a sphere: axes through one point, on the faces, vertices and edges of polyhedra or on planar graphs.

Inputs are a solid, by name or by its vertices, or a graph of meshing gears, and the tooth number of each kind of gear.
The result is a `Configuration` of axes, meshes and kinds. Functions check whether the set turns and whether its teeth
mesh around every loop, compute sizes, search for tooth numbers with nearly one pitch, and convert the set to a gear
train.

Two meshing gears with z_i and z_j teeth, whose axes are at the angle S, have pitch cones with the half-angles rho_i =
atan2(sin S, cos S + z_j/z_i) and the pitch lambda = sin rho_i / z_i (docs/sphere.md, equation 1). Their speeds w about
outward axes satisfy z_i w_i = -z_j w_j. The teeth of a loop mesh if its phases close (docs/closure.md).

polyhedra                                    solids from vertices and by name, with their symmetries
polyhedron_gears                             sets of gears on a solid (axes, kinds, names); a survey of solids
circle_packing, graph_set                    sets of gears from any planar graph
configuration, assembly                      axes, meshes and kinds of gear of a set; its assembly conditions
gear_sphere, gear_sizes                      mobility and assembly of a set; sizes of its gears
pitch_cones                                  pitch and base cones of a pair
tooth_count_search                           tooth numbers that nearly share one pitch (exhaustive search)
axis_adjustment                              axes adjusted until all meshes have one pitch, or loops close (Newton)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.spherical.assembly import spherical_divisibility_rule, spherical_phasing
    from geartrain.spherical.configuration import Configuration, to_train
    from geartrain.spherical.gear_sizes import SphereSizing, one_pitch, size_gears
    from geartrain.spherical.gear_sphere import GearSphere
    from geartrain.spherical.graph_set import GraphSet, from_graph
    from geartrain.spherical.polyhedra import Polyhedron, polyhedron, solid, solid_names
    from geartrain.spherical.polyhedron_gears import SurveyRow, from_polyhedron, survey
    from geartrain.spherical.tooth_count_search import (
        NeighbourRatioWindow,
        ToothCountCompromise,
        ToothCountSuggestions,
        ratio_windows,
        suggest_tooth_counts,
    )

__all__ = [
    "Configuration",
    "GearSphere",
    "GraphSet",
    "NeighbourRatioWindow",
    "Polyhedron",
    "SphereSizing",
    "SurveyRow",
    "ToothCountCompromise",
    "ToothCountSuggestions",
    "from_graph",
    "from_polyhedron",
    "one_pitch",
    "polyhedron",
    "ratio_windows",
    "size_gears",
    "solid",
    "solid_names",
    "spherical_divisibility_rule",
    "spherical_phasing",
    "suggest_tooth_counts",
    "survey",
    "to_train",
]

_PLACES = {
    **dict.fromkeys(("spherical_divisibility_rule", "spherical_phasing"), "assembly"),
    **dict.fromkeys(("Configuration", "to_train"), "configuration"),
    **dict.fromkeys(("SphereSizing", "one_pitch", "size_gears"), "gear_sizes"),
    "GearSphere": "gear_sphere",
    **dict.fromkeys(("GraphSet", "from_graph"), "graph_set"),
    **dict.fromkeys(("Polyhedron", "polyhedron", "solid", "solid_names"), "polyhedra"),
    **dict.fromkeys(("SurveyRow", "from_polyhedron", "survey"), "polyhedron_gears"),
    **dict.fromkeys(("NeighbourRatioWindow", "ratio_windows"), "tooth_count_search"),
    **dict.fromkeys(("ToothCountCompromise", "ToothCountSuggestions", "suggest_tooth_counts"), "tooth_count_search"),
}

__getattr__ = lazy_names(__name__, _PLACES)
