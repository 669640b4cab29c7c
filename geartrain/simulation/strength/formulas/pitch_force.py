"""The force at the pitch point by its parts: along the pitch circles, along the axes, and pushing these apart.

Docs: (18) and (19) of docs/strength.md.
"""

from __future__ import annotations

from math import atan, cos, sin, tan
from typing import NamedTuple


class PitchForce(NamedTuple):
    """What a wheel bears from its mate at the pitch point, in the unit of the tangential force.

    tangential   of the torque: that of a torque above 0 is above 0
    axial        above 0 along the direction of the wheel's axis
    radial       towards its axis; below 0 of a ring, which is pushed outwards
    """

    tangential: float
    axial: float
    radial: float


def helical_force(tangential: float, helix: float, pressure_angle: float, friction_angle: float = 0.0) -> PitchForce:
    """Of a wheel with a helix angle, 0 of spur wheels: docs/strength.md (18).

    Parameters
    ----------
    tangential : float
        Torque over pitch radius.
    helix : float
        Helix angle (rad), of a right hand above 0; of a worm near a quarter turn.
    pressure_angle : float
        Across the teeth (rad).
    friction_angle : float
        Of the friction along the teeth (rad), atan(mu / cos(pressure angle)); below 0 of the driver, above 0 of the
        driven wheel, the other way round where the helix angles make the teeth slide so. 0 on parallel axes.

    Examples
    --------
    A driver of a right hand with 10 N along its pitch circle, turning about its axis, so that the torque is against it:
    the thrust is along the axis, as the thumb of the right hand shows.

    >>> from math import radians
    >>> force = helical_force(-10.0, radians(30), radians(20))
    >>> round(force.axial, 4), round(force.radial, 4)
    (5.7735, 4.2028)
    """
    lean = helix + friction_angle
    # N cos(alpha), the part of the force across the teeth that lies in the pitch plane, over the tangential one
    across = cos(friction_angle) / cos(lean)
    return PitchForce(tangential, 0.0 - tangential * tan(lean), abs(tangential * across) * tan(pressure_angle))


def bevel_force(tangential: float, cone: float, pressure_angle: float, facing: int = 1) -> PitchForce:
    """Of a straight bevel with a half-angle of its pitch cone (rad): docs/strength.md (19).

    `facing` is 1 where the wheel lies from the apex along its axis' direction, -1 against it: it is pushed away from
    the apex.
    """
    apart = abs(tangential) * tan(pressure_angle)
    return PitchForce(tangential, facing * apart * sin(cone), apart * cos(cone))


def friction_angle(friction: float, pressure_angle: float) -> float:
    """Of friction along teeth (rad): atan(mu / cos(pressure angle))."""
    return atan(friction / cos(pressure_angle))
