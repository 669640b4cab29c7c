"""Axial extent of the body of a wheel, computed from its thickness or its pitch cone.

Teeth of a bevel or crown wheel are cut on its back cone, which is perpendicular to its pitch cone at the pitch circle,
and extend from there along the cone towards the apex by `thickness`, with solid metal behind them. The viewer builds
the same bodies (`tooth.js`, `blanks.js`).
"""

from __future__ import annotations

from math import pi, sin, tan

from geartrain.teeth.standard_teeth import ADDENDUM, DEDENDUM

LAND = 0.01  # metal under the roots, divided by the pitch radius
CROWN = pi / 2 - 1e-6
"""Half angle of the pitch cone [rad] above which a wheel is treated as a crown wheel, whose pitch plane contains the
apex.
"""
_BACK = 0.35  # metal behind the teeth, divided by the thickness
_MOST_FACE = 0.45  # maximum face width divided by the cone distance


def taper(cone: float, radius: float, thickness: float) -> float:
    """Return the tooth size at the small end of a bevel wheel divided by that at its large end, 0.55 or more.

    cone        half angle of the wheel's pitch cone [rad], above 0; a right angle for a crown wheel
    radius      pitch radius at the large end [mm]
    thickness   face width along the cone [mm]
    """
    # the cone distance is radius / sin(cone)
    return 1 - min(_MOST_FACE, thickness * sin(cone) / radius)


def height_on_cone(cone: float, radius: float, depth: float, scale: float) -> float:
    """Return the axial distance of a point of a tooth from the pitch circle's plane [mm], positive towards the apex.

    depth   distance of the point from the pitch cone, along the back cone, at the large end [mm]
    scale   tooth size at the point: 1 at the large end, `taper` at the small end
    """
    apex = radius / tan(cone)
    return apex + (depth * sin(cone) - apex) * scale


def back_of_cone(cone: float, radius: float, thickness: float, root: float) -> float:
    """Return the position of the back of a bevel wheel along its axis, measured as in `height_on_cone` [mm].

    root   height of the tooth roots above the pitch cone [mm]
    """
    ends = 1.0, taper(cone, radius, thickness)
    return min(height_on_cone(cone, radius, root - LAND * radius, scale) for scale in ends) - _BACK * thickness


def bare_reach(cone: float, radius: float, thickness: float, module: float) -> tuple[float, float]:
    """Return the extents of a wheel [mm] as defined by `reach`, with standard tooth heights for unknown teeth."""
    return reach(cone, radius, thickness, -DEDENDUM * module, ADDENDUM * module)


def reach(cone: float, radius: float, thickness: float, root: float, tip: float) -> tuple[float, float]:
    """Return the axial extents of a wheel's body from its pitch circle, away from the apex and towards it [mm].

    cone        half angle of the wheel's pitch cone [rad], 0 for a cylinder
    root, tip   heights of the tooth roots and tips above the pitch cone [mm]
    """
    if not cone:
        return thickness / 2, thickness / 2
    ends = [height_on_cone(cone, radius, at, s) for at in (root, tip) for s in (1.0, taper(cone, radius, thickness))]
    return -back_of_cone(cone, radius, thickness, root), max(ends)


def web(cone: float, radius: float, thickness: float, root: float) -> tuple[float, float]:
    """Return the axial extents of the disc inside the toothed rim, measured as in `reach` [mm]."""
    if not cone:
        return thickness / 2, thickness / 2
    front = height_on_cone(cone, radius, root - LAND * radius, taper(cone, radius, thickness))
    return -back_of_cone(cone, radius, thickness, root), front


def span(facing: int, away: float, towards: float) -> tuple[float, float]:
    """Return the extents of `reach` as positions of both ends along the axis [mm]. `facing` is 1 if the apex is below,
    and -1 if it is above.
    """
    return (-towards, away) if facing > 0 else (-away, towards)
