"""Speeds from circuits, exact or in floats with error estimates, and exact mobility and verdict of a train."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.kinematics.speeds.exact_speeds import EXACT_BUDGET as EXACT_BUDGET
    from geartrain.kinematics.speeds.exact_speeds import Solution as Solution
    from geartrain.kinematics.speeds.exact_speeds import exact_verdict as exact_verdict
    from geartrain.kinematics.speeds.exact_speeds import solve as solve
    from geartrain.kinematics.speeds.float_speeds import FloatSpeeds as FloatSpeeds
    from geartrain.kinematics.speeds.float_speeds import solve_floats as solve_floats
    from geartrain.kinematics.speeds.mobility import Mobility as Mobility
    from geartrain.kinematics.speeds.mobility import find_mobility as find_mobility

__getattr__, __all__ = public_names(
    __name__,
    {
        "exact_speeds": "EXACT_BUDGET Solution exact_verdict solve",
        "float_speeds": "FloatSpeeds solve_floats",
        "mobility": "Mobility find_mobility",
    },
)
