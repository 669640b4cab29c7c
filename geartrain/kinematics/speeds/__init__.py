"""Speeds from circuits, exact or in floats with error estimates; mobility and verdict, decided without tolerances."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.kinematics.speeds.exact_speeds import (
    EXACT_BUDGET,
    Solution,
    exact_verdict,
    solve,
)
from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.kinematics.speeds.float_speeds import FloatSpeeds, solve_floats
    from geartrain.kinematics.speeds.mobility import Mobility, find_mobility

__all__ = [
    "EXACT_BUDGET",
    "FloatSpeeds",
    "Mobility",
    "Solution",
    "exact_verdict",
    "find_mobility",
    "solve",
    "solve_floats",
]

# imported on first use: floats need numpy and scipy
__getattr__ = lazy_names(
    __name__,
    {
        **dict.fromkeys(("FloatSpeeds", "solve_floats"), "float_speeds"),
        **dict.fromkeys(("Mobility", "find_mobility"), "mobility"),
    },
)
