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

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.teeth.triangular.clearance_window import find_window as find_window
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes as TriangularSizes
    from geartrain.teeth.triangular.pair_geometry import equal_depth as equal_depth
    from geartrain.teeth.triangular.pair_geometry import pitch_true as pitch_true
    from geartrain.teeth.triangular.triangular_form import Triangular as Triangular
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission as TriangularTransmission

__getattr__, __all__ = public_names(
    __name__,
    {
        "clearance_window": "find_window",
        "pair_geometry": "TriangularSizes equal_depth pitch_true",
        "triangular_form": "Triangular",
        "triangular_transmission": "TriangularTransmission",
    },
)
