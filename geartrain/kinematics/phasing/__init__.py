"""Phase closure: check whether the teeth of the last mesh in every loop fit, so that the train can be assembled."""

from __future__ import annotations

from geartrain.kinematics.phasing.azimuths import UnplacedPair
from geartrain.kinematics.phasing.mesh_phasing import (
    DivisibilityRule,
    LoopPhase,
    MeshPhasing,
    find_divisibility_rule,
    find_phasing,
)

__all__ = ["DivisibilityRule", "LoopPhase", "MeshPhasing", "UnplacedPair", "find_divisibility_rule", "find_phasing"]
