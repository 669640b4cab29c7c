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

from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutWheel
from geartrain.workshop.cutting.displaced_pair import DisplacedPair, DisplacedWheel
from geartrain.workshop.cutting.file_strokes import file_to_fit
from geartrain.workshop.cutting.meshing_cycle import batch_verdicts, jamming_bound, nominal_backlash
from geartrain.workshop.cutting.wheel_estimate import closed_steps, stepped_covariance

__all__ = [
    "CutGearPair",
    "CutWheel",
    "DisplacedPair",
    "DisplacedWheel",
    "batch_verdicts",
    "closed_steps",
    "file_to_fit",
    "jamming_bound",
    "nominal_backlash",
    "stepped_covariance",
]
