"""How far a wheel's body reaches along its axis: half its thickness to either side, or as its pitch cone lies.

Teeth of a bevel or crown wheel are cut on its back cone, which stands at a right angle to its pitch cone at the pitch
circle, and run from there towards the apex, `thickness` along the cone; a back lies behind them. The viewer builds
the same bodies (`tooth.js`, `blanks.js`).
"""

from __future__ import annotations

from math import pi, sin, tan

from geartrain.teeth.standard_teeth import ADDENDUM, DEDENDUM

LAND = 0.01  # of the pitch radius: metal under the roots
CROWN = pi / 2 - 1e-6
"""rad: a wider cone is taken for a plane, that of a crown wheel, whose apex lies in it."""
_BACK = 0.35  # of the thickness: metal behind the teeth
_MOST_FACE = 0.45  # of the cone's length, whatever the thickness


def taper(cone: float, radius: float, thickness: float) -> float:
    """Size of the narrow end of a bevel wheel's teeth over that of the wide end.

    Parameters
    ----------
    cone : float
        Half angle of its pitch cone [rad], above 0; a right angle of a crown wheel.
    radius, thickness : float
        Of its pitch circle, and of its rim along the cone [mm].

    Returns
    -------
    float
        1 of teeth without length.
    """
    return 1 - min(_MOST_FACE, thickness * sin(cone) / radius)


def height_on_cone(cone: float, radius: float, depth: float, scale: float) -> float:
    """How far (mm) a point of a tooth lies from the plane of the pitch circle, towards the apex.

    depth   over the pitch cone, along the back cone at the wide end (mm); `scale`, 1 there, `taper` at the narrow end
    """
    apex = radius / tan(cone)
    return apex + (depth * sin(cone) - apex) * scale


def back_of_cone(cone: float, radius: float, thickness: float, root: float) -> float:
    """Where the back of its body lies, as `height_on_cone`; `root` as `depth`, of its roots (mm)."""
    ends = 1.0, taper(cone, radius, thickness)
    return min(height_on_cone(cone, radius, root - LAND * radius, scale) for scale in ends) - _BACK * thickness


def bare_reach(cone: float, radius: float, thickness: float, module: float) -> tuple[float, float]:
    """As `reach`, of a wheel whose teeth are not known: of usual depth for its module (mm)."""
    return reach(cone, radius, thickness, -DEDENDUM * module, ADDENDUM * module)


def reach(cone: float, radius: float, thickness: float, root: float, tip: float) -> tuple[float, float]:
    """How far (mm) a wheel's body reaches along its axis from its pitch circle, away from its apex and towards it.

    cone      half angle of its pitch cone (rad), 0 of a cylinder
    root, tip heights over the pitch cone (mm)
    """
    if not cone:
        return thickness / 2, thickness / 2
    ends = [height_on_cone(cone, radius, at, s) for at in (root, tip) for s in (1.0, taper(cone, radius, thickness))]
    return -back_of_cone(cone, radius, thickness, root), max(ends)


def web(cone: float, radius: float, thickness: float, root: float) -> tuple[float, float]:
    """As `reach`, of the disc within its teeth."""
    if not cone:
        return thickness / 2, thickness / 2
    front = height_on_cone(cone, radius, root - LAND * radius, taper(cone, radius, thickness))
    return -back_of_cone(cone, radius, thickness, root), front


def span(facing: int, away: float, towards: float) -> tuple[float, float]:
    """The same as places along the axis' direction, from the pitch circle: the lower and the upper; `facing`, of it."""
    return (-towards, away) if facing > 0 else (-away, towards)
