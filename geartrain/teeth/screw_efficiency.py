"""Efficiency of helical wheels on skew axes, and of worms: their teeth slide along each other."""

from __future__ import annotations

from math import cos, radians, tan

NORMAL_ANGLE = radians(20)
"""Pressure angle (rad) across the teeth where no form says it."""


def screw_efficiency(driving: float, driven: float, friction: float, pressure_angle: float = NORMAL_ANGLE) -> float:
    """Share of the power that arrives, equation (12c) of docs/theory.md; 0 or less locks.

    Only sliding along the teeth counts, at the pitch point; what they slide up and down each other is small beside it.

    Parameters
    ----------
    driving, driven : float
        Helix angles of the driver and of the driven wheel (rad), of right hands above 0; their sum is the shaft angle.
    friction : float
        Coefficient of friction, 0 or more.
    pressure_angle : float
        Across the teeth (rad).

    Examples
    --------
    A worm with a lead angle of 5 degrees and friction of 0.1: tan(lead) / tan(lead + angle of friction), and backwards.

    >>> round(screw_efficiency(radians(85), radians(5), 0.1 * cos(NORMAL_ANGLE)), 6)
    0.462552
    >>> screw_efficiency(radians(5), radians(85), 0.1 * cos(NORMAL_ANGLE)) < 0
    True
    """
    slide = tan(driving) + tan(driven)
    rough = friction / cos(pressure_angle) * (1 if slide >= 0 else -1)
    return (1 - rough * tan(driven)) / (1 + rough * tan(driving))
