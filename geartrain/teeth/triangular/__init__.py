"""Triangular teeth of antiquity, after F. Sorge: straight flanks that meet in an apex.

pair_geometry             depth, radii, centre distance, range of contact
tooth_pair                contact of one tooth pair: driven angle, speed ratio, friction
real_path                 active tooth pair at every position; collisions, dwells, clashes
clearance_window          verdict, backlash of the coast flanks, clearance window
triangular_transmission   transmission function; a table of contact over one pitch
triangular_form           the form as declared, and its sizes
triangular_mesh           a pair of a train: figures and explanations
parameter_sweep           a pair as one or two parameters vary
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow, find_window
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth, pitch_true
    from geartrain.teeth.triangular.triangular_form import Triangular
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

__all__ = [
    "ClearanceWindow",
    "Triangular",
    "TriangularSizes",
    "TriangularTransmission",
    "equal_depth",
    "find_window",
    "pitch_true",
]

_PLACES = {
    "ClearanceWindow": "clearance_window",
    "Triangular": "triangular_form",
    "TriangularSizes": "pair_geometry",
    "TriangularTransmission": "triangular_transmission",
    "equal_depth": "pair_geometry",
    "find_window": "clearance_window",
    "pitch_true": "pair_geometry",
}

__getattr__ = lazy_names(__name__, _PLACES)
