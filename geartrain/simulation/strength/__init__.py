"""Strength of gear pairs, arbors and pins under load, and their wear (docs/strength.md), in N, mm and MPa.

train_strength     entry point: `solve_strength`, for all pairs and arbors of a train
strength_results   the results
strength_report    the report and its data in JSON format; `verb` is the command
loaded_pair        one pair under its torque: pressures, root stresses, wear
tooth_forces       forces at pitch points
virtual_spurs      virtual spur wheels of bevels (Tredgold) and of wheels on crossed axes
pin_strength       contacts of lobes on pins and of pins in holes
contact_pressure   Hertzian line and point contact, Archard's wear
iso_6336           contact and root stress by ISO 6336 method B, root stress by Lewis
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.simulation.strength.contact_pressure import CrossedWheels as CrossedWheels
    from geartrain.simulation.strength.contact_pressure import contact_ellipse as contact_ellipse
    from geartrain.simulation.strength.contact_pressure import minimum_tooth_pairs as minimum_tooth_pairs
    from geartrain.simulation.strength.iso_6336 import HelixData as HelixData
    from geartrain.simulation.strength.iso_6336 import RackWheel as RackWheel
    from geartrain.simulation.strength.iso_6336 import root_stress as root_stress
    from geartrain.simulation.strength.train_strength import maximum_moment as maximum_moment

__getattr__, __all__ = public_names(
    __name__,
    {
        "contact_pressure": "CrossedWheels contact_ellipse minimum_tooth_pairs",
        "iso_6336": "HelixData RackWheel root_stress",
        "train_strength": "maximum_moment",
    },
)
