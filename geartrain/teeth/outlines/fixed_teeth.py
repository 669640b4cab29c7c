"""Teeth that do not depend on a mate: teeth of escape wheels and of strain waves. Lengths are in modules.

The tooth of an escape wheel is pointed and leans forward, so that a pallet of the anchor touches only its tip.

The teeth of a strain wave have straight flanks. With a wave of n lobes, whose ring gear has n teeth more, the middle
line of the thin wheel is displaced outwards by w cos(u), without stretching. Here w = n/2 modules, and u is n times the
angle from a crest of the wave. A tooth then leaves its space of the ring by n/2 (1 - cos u) while it moves along the
circumference by (u - sin u)/2. Flanks at the angle a from the middle of the tooth clear each other while n (1 - cos u)
tan a > u - sin u (docs/reducers.md, (8)).
"""

from __future__ import annotations

from math import asin, atan2, cos, hypot, pi, radians, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.wheel_requirement import FixedTooth

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

ESCAPEMENT = "escapement"
ESCAPE_WORDS = "of a dead-beat escapement, pointed, faces undercut by 6 degrees"
UNDERCUT = radians(6.0)
"""Angle [rad] of an escape tooth's leading face backwards from the radius through its tip (dead-beat anchor)."""
_DEPTH = 0.7  # fraction of a pitch: depth of a tooth
_DEEPEST = 0.5  # fraction of the radius: maximum depth of a tooth
_BASE = 0.45  # fraction of a pitch: thickness of a tooth at its root
_LAND = 0.03  # fraction of a pitch: width of a tip
WAVE = "strain wave"
WAVE_WORDS = "of a strain wave, straight flanks of 30 degrees, 0.7 modules out and 0.9 in"
FLANK = radians(30.0)
"""Angle of a flank of a strain wave tooth from the centre line of the tooth [rad]."""
ADDENDUM, DEDENDUM = 0.7, 0.9
"""Addendum and dedendum of strain wave teeth [module].

Their sum is below 2 modules: where a wheel with two lobes is bent inwards, its teeth are 2 modules further in than
where they are fully engaged, and must be out of the tooth spaces.
"""
WALL = 0.012
"""Wall thickness of the flexible wheel under its teeth, divided by its pitch diameter."""
CUP = 0.25
"""Length of the wall between flexible wheel and cup divided by the pitch diameter; a shorter wall is too stiff."""


# -------------------------------------------------------------------------------------------------------- escape wheels


def escape_tooth(z: int, sense: int) -> FixedTooth:
    """Return the tooth of an escape wheel with z teeth, 3 or more. The tip is on the pitch circle.

    The middle of the tooth's root is on the x axis. The proportions follow clockmakers' practice, after G. Graham's
    anchor of about 1715: the faces are undercut by 6 degrees, and the backs are straight.

    sense   direction of rotation and of lean: 1 counter-clockwise, -1 clockwise
    """
    radius, pitch = z / 2, 2 * pi / z
    # with few teeth, 0.7 of a pitch would exceed half the radius
    depth = min(_DEPTH * pitch, _DEEPEST) * radius
    root = hypot(radius - depth, depth * tan(UNDERCUT))
    face = atan2(depth * tan(UNDERCUT), radius - depth)  # angle of the tip ahead of the foot of its face
    half = _BASE * pitch / 2
    # counter-clockwise: foot of the back, both ends of the tip, foot of the face; the last edge is on the root circle
    polar = (
        (root, -half, 0.0),
        (radius, half + face - _LAND * pitch, tan(_LAND * pitch / 4)),
        (radius, half + face, 0.0),
        (root, half, tan((1 - _BASE) * pitch / 4)),
    )
    tooth = tuple((distance * cos(angle), distance * sin(angle), bulge) for distance, angle, bulge in polar)
    if sense < 0:  # mirrored and in reverse order, so the bulge of an edge belongs to its other end
        tooth = tuple((x, -y, tooth[at - 1][2]) for at, (x, y, _) in reversed([*enumerate(tooth)]))
    return FixedTooth("external", radius, root, tooth)


# --------------------------------------------------------------------------------------------------------- strain waves


def wave_tooth(z: int, backlash: float, ring: bool = False) -> FixedTooth:
    """Return the straight-sided tooth of the flexible wheel of a strain wave, or of its ring gear if `ring` is True,
    with z teeth.

    `backlash` is an arc on the pitch circle [module].
    """
    radius, pitch = z / 2, 2 * pi / z
    side = -1 if ring else 1
    tip, root = radius + side * ADDENDUM, radius - side * DEDENDUM
    half = pi / 4 - backlash / 4  # half thickness of a tooth on the pitch circle
    ends = [(root, half + DEDENDUM * tan(FLANK)), (tip, half - ADDENDUM * tan(FLANK))]
    (foot, x), (top, tip_x) = ((asin(y / r), sqrt(r**2 - y**2)) for r, y in ends)
    low, high = ends[0][1], ends[1][1]
    tooth = ((x, -low, 0.0), (tip_x, -high, tan(top / 2)), (tip_x, high, 0.0), (x, low, tan((pitch - 2 * foot) / 4)))
    return FixedTooth("ring" if ring else "external", tip, root, tooth)


def wall(radius: float) -> float:
    """Return the wall thickness under the teeth of a flexible wheel, in the unit of its pitch radius `radius`."""
    return WALL * 2 * radius


def bent_line(line: Floats, middle: float, wave: tuple[float, int], turns: tuple[float, float] = (0.0, 0.0)) -> Floats:
    """Return the points of a thin wheel, shape (n, 2), after it is bent by a wave and rotated. The length unit is that
    of the input.

    The wheel is flexible, but its middle line keeps its length. A point on it at the angle t moves outwards by w cos(n
    (t - s)), where s is the angle of the wave, and along the circumference by -w/n sin(n (t - s)), for the amplitude w
    and n lobes. Points off the middle line stay on its normal.

    middle   radius of the middle line
    wave     amplitude, and number of lobes, the first of which is on the x axis
    turns    rotation angles of the wheel and of the wave [rad]
    """
    (rise, lobes), (own, where) = wave, turns
    place = np.arctan2(line[:, 1], line[:, 0]) + own
    phase, off = lobes * (place - where), np.hypot(*line.T) - middle
    out, along = rise * np.cos(phase), -rise / lobes * np.sin(phase)
    at = place + along / middle
    leaning = at + (lobes * rise * np.sin(phase) + along) / middle
    points = (middle + out) * np.exp(1j * at) + off * np.exp(1j * leaning)
    return np.column_stack([points.real, points.imag])
