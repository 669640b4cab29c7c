"""Gears on a sphere: their axes pass through one point. They are placed on polyhedra, or determined by a planar graph.

Inputs are a solid (by name or by its vertices) or a graph of meshing gears, and the tooth number of each kind of gear.
The result is a `Configuration` of axes, meshes and kinds. Functions check whether the set can turn and whether its
teeth mesh around every loop, compute sizes, search for tooth numbers for which all pitches are nearly equal, and
convert the set to a gear train.

Two meshing gears with z_i and z_j teeth, whose axes are at the angle S, have pitch cones with the half-angles rho_i =
atan2(sin S, cos S + z_j/z_i) and the pitch lambda = sin rho_i / z_i (docs/sphere.md, equation 1). Their speeds w about
outward axes satisfy z_i w_i = -z_j w_j. The teeth of a loop mesh if its phases close (docs/closure.md).

polyhedra                                    solids by name or from vertices, with their symmetries
polyhedron_gears                             sets of gears on a solid (axes, kinds, names); survey of solids
circle_packing, graph_set                    sets of gears from any planar graph
configuration, assembly                      axes, meshes and kinds of gear of a set; its assembly conditions
gear_sphere, gear_sizes                      mobility and assembly of a set; sizes of its gears
pitch_cones                                  pitch and base cones of a pair
tooth_count_search                           tooth numbers with nearly equal pitches (exhaustive search)
axis_adjustment                              axes adjusted until all meshes have one pitch, or loops close (Newton)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.spherical.assembly import spherical_divisibility_rule as spherical_divisibility_rule
    from geartrain.spherical.assembly import spherical_phasing as spherical_phasing
    from geartrain.spherical.configuration import Configuration as Configuration
    from geartrain.spherical.configuration import to_train as to_train
    from geartrain.spherical.gear_sizes import SphereSizing as SphereSizing
    from geartrain.spherical.gear_sizes import size_gears as size_gears
    from geartrain.spherical.gear_sphere import GearSphere as GearSphere
    from geartrain.spherical.graph_set import GraphSet as GraphSet
    from geartrain.spherical.graph_set import from_graph as from_graph
    from geartrain.spherical.polyhedra import polyhedron as polyhedron
    from geartrain.spherical.polyhedra import solid as solid
    from geartrain.spherical.polyhedra import solid_names as solid_names
    from geartrain.spherical.polyhedron_gears import from_polyhedron as from_polyhedron
    from geartrain.spherical.polyhedron_gears import survey as survey
    from geartrain.spherical.tooth_count_search import ratio_windows as ratio_windows
    from geartrain.spherical.tooth_count_search import suggest_tooth_counts as suggest_tooth_counts

__getattr__, __all__ = public_names(
    __name__,
    {
        "assembly": "spherical_divisibility_rule spherical_phasing",
        "configuration": "Configuration to_train",
        "gear_sizes": "SphereSizing size_gears",
        "gear_sphere": "GearSphere",
        "graph_set": "GraphSet from_graph",
        "polyhedra": "polyhedron solid solid_names",
        "polyhedron_gears": "from_polyhedron survey",
        "tooth_count_search": "ratio_windows suggest_tooth_counts",
    },
)
