"""Gears on a sphere: configurations on polyhedra and graphs, whether they turn, close, and fit."""

from geartrain.spherical.arranging import from_polyhedron
from geartrain.spherical.compromise import Suggestions, suggest
from geartrain.spherical.configuration import Configuration
from geartrain.spherical.declaring import to_train
from geartrain.spherical.families import icosahedral, idler_sphere, moved_antiprism, with_idlers
from geartrain.spherical.graphs import GraphSet, from_graph
from geartrain.spherical.polyhedra import Polyhedron, polyhedron
from geartrain.spherical.sizing import Sizing, one_pitch, size, windows
from geartrain.spherical.solids import solid, solid_names

__all__ = [
    "Configuration",
    "GraphSet",
    "Polyhedron",
    "Sizing",
    "Suggestions",
    "from_graph",
    "from_polyhedron",
    "icosahedral",
    "idler_sphere",
    "moved_antiprism",
    "one_pitch",
    "polyhedron",
    "size",
    "solid",
    "solid_names",
    "suggest",
    "to_train",
    "windows",
    "with_idlers",
]
