"""Wheels cut by hand: each tooth with its own place, height and flanks; their law, where they jam, and how often."""

from geartrain.uncertainty.manufacturing_errors.cut_transmission import (
    CutTransmissionFunction,
    cut_transmission_function,
)
from geartrain.uncertainty.manufacturing_errors.cut_wheel import CuttingErrorModel, CutWheel, ErrorDistribution
from geartrain.uncertainty.manufacturing_errors.least_backlash import jamming_bound, nominal_backlash
from geartrain.uncertainty.manufacturing_errors.meshing_cycle import MeshingVerdicts
from geartrain.uncertainty.manufacturing_errors.meshing_events import MeshingEvent, MeshingEvents
from geartrain.uncertainty.manufacturing_errors.meshing_verdicts import batch_verdicts

__all__ = [
    "CutTransmissionFunction",
    "CutWheel",
    "CuttingErrorModel",
    "ErrorDistribution",
    "MeshingEvent",
    "MeshingEvents",
    "MeshingVerdicts",
    "batch_verdicts",
    "cut_transmission_function",
    "jamming_bound",
    "nominal_backlash",
]
