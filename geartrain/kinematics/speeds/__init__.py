"""From circuits to speeds, exact or in floats with their error; mobility and verdict never by a tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.kinematics.speeds.exact_speeds import EXACT_BUDGET, Solution, exact_verdict, solve
from geartrain.kinematics.speeds.mobility import Mobility, find_mobility

if TYPE_CHECKING:
    from geartrain.kinematics.speeds.float_speeds import FloatSpeeds, solve_floats

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


def __getattr__(name: str) -> Any:
    """The float path brings numpy and scipy, so it is imported when it is used."""
    if name in ("FloatSpeeds", "solve_floats"):
        from geartrain.kinematics.speeds import float_speeds as floats

        return getattr(floats, name)
    raise AttributeError(name)
