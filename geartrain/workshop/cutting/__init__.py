"""Wheels with cutting errors: each tooth has its own pitch deviation, height and flank angles (docs/cut-by-hand.md).

declared_errors      errors that a train declares, and their overrides
cut_wheel            triangular wheels in one or many trials, and pairs of such wheels
displaced_pair       wheels of all other tooth forms, with displaced flanks
meshing_cycle        events of many pairs, computed together: jam, clash, dwell, loss of contact
trial_transmission   transmission functions of many pairs, computed together
wheel_estimate       eccentricity and pitch deviations of a measured wheel; `verb` prints them
measured_motion      motion of a train with its wheels as measured
file_strokes         filing of teeth until pairs turn without a jam
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.workshop.cutting.cut_wheel import CutGearPair as CutGearPair
    from geartrain.workshop.cutting.cut_wheel import CutWheel as CutWheel
    from geartrain.workshop.cutting.displaced_pair import DisplacedPair as DisplacedPair
    from geartrain.workshop.cutting.displaced_pair import DisplacedWheel as DisplacedWheel
    from geartrain.workshop.cutting.file_strokes import file_to_fit as file_to_fit
    from geartrain.workshop.cutting.meshing_cycle import batch_verdicts as batch_verdicts
    from geartrain.workshop.cutting.meshing_cycle import jamming_bound as jamming_bound
    from geartrain.workshop.cutting.meshing_cycle import nominal_backlash as nominal_backlash
    from geartrain.workshop.cutting.wheel_estimate import closed_steps as closed_steps
    from geartrain.workshop.cutting.wheel_estimate import stepped_covariance as stepped_covariance

__getattr__, __all__ = public_names(
    __name__,
    {
        "cut_wheel": "CutGearPair CutWheel",
        "displaced_pair": "DisplacedPair DisplacedWheel",
        "file_strokes": "file_to_fit",
        "meshing_cycle": "batch_verdicts jamming_bound nominal_backlash",
        "wheel_estimate": "closed_steps stepped_covariance",
    },
)
