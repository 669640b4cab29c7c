"""Gears on a sphere: configurations on polyhedra and graphs, whether they turn, close, and fit."""

from geartrain.spherical.configuration import Configuration, to_train
from geartrain.spherical.gear_sizes import SphereSizing, one_pitch, ratio_windows, size_gears
from geartrain.spherical.graph_set import GraphSet, from_graph
from geartrain.spherical.named_solids import solid, solid_names
from geartrain.spherical.polyhedra import Polyhedron, polyhedron
from geartrain.spherical.polyhedron_gears import from_polyhedron
from geartrain.spherical.tooth_count_search import ToothCountSuggestions, suggest_tooth_counts

__all__ = [
    "Configuration",
    "GraphSet",
    "Polyhedron",
    "SphereSizing",
    "ToothCountSuggestions",
    "from_graph",
    "from_polyhedron",
    "one_pitch",
    "polyhedron",
    "ratio_windows",
    "size_gears",
    "solid",
    "solid_names",
    "suggest_tooth_counts",
    "to_train",
]
