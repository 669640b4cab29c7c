"""Gears on a sphere: configurations on polyhedra and graphs, whether they turn, close, and fit."""

from geartrain.spherical.arranging import from_polyhedron
from geartrain.spherical.configuration import Configuration
from geartrain.spherical.declaring import to_train
from geartrain.spherical.polyhedra import Polyhedron, polyhedron
from geartrain.spherical.solids import solid, solid_names

__all__ = ["Configuration", "Polyhedron", "from_polyhedron", "polyhedron", "solid", "solid_names", "to_train"]
