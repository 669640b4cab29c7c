"""Teeth that do not depend on a mate: of escape wheels and of strain waves. Lengths in modules.

The tooth of an escape wheel is pointed and leans forward, so that a pallet of the anchor touches only its tip.

The teeth of a strain wave have straight flanks. With a wave of n lobes whose ring has n teeth more, the middle line of
the thin wheel is moved outwards by w cos(u), w = n/2 modules, and does not stretch. A tooth then leaves its space of
the ring by n/2 (1 - cos u) while it moves along by (u - sin u)/2: flanks at the angle a from its middle pass each other
while n (1 - cos u) tan a > u - sin u (docs/reducers.md, (8)).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import asin, atan2, cos, hypot, pi, radians, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.tooth_outline import Vertex
from geartrain.teeth.outlines.wheel_requirement import FixedTooth

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

ESCAPEMENT = "escapement"
ESCAPE_WORDS = "of a dead-beat escapement, pointed, faces undercut by 6 degrees"
UNDERCUT = radians(6.0)
"""How far the leading face of a tooth lies behind the radius through its tip (rad): so much for a dead-beat anchor."""
_DEPTH = 0.7  # of a pitch
_DEEPEST = 0.5  # of the radius
_BASE = 0.45  # of a pitch: thickness of a tooth at its root
_LAND = 0.03  # of a pitch: width of a tip
WAVE = "strain wave"
WAVE_WORDS = "of a strain wave, straight flanks of 30 degrees, 0.7 modules out and 0.9 in"
FLANK = radians(30.0)
"""Of a flank from the middle of its tooth (rad)."""
ADDENDUM, DEDENDUM = 0.7, 0.9
"""In modules: a tooth must have left its space where the wheel is bent in, two modules from where it is bent out."""
WALL = 0.012
"""Of the pitch diameter: wall of the wheel under its teeth, thin enough to be bent."""
CUP = 0.25
"""Of the pitch diameter: length of the wall that joins the wheel to its cup; a short one hardly bends."""


# -------------------------------------------------------------------------------------------------------- escape wheels


def escape_tooth(z: int, sense: int) -> FixedTooth:
    """Of a wheel of z teeth, 3 or more, whose tips are on its pitch circle; the middle of its root on the x axis.

    Proportions of clockmakers, after G. Graham's anchor of about 1715: faces undercut by 6 degrees, backs straight.

    sense   1 if it turns counter-clockwise, -1 clockwise: it leans that way
    """
    radius, pitch = z / 2, 2 * pi / z
    depth = min(_DEPTH * pitch, _DEEPEST) * radius
    root = hypot(radius - depth, depth * tan(UNDERCUT))
    face = atan2(depth * tan(UNDERCUT), radius - depth)  # how far the tip is ahead of the foot of its face
    tooth = tuple(_vertices(pitch, radius, root, face))
    if sense < 0:  # in a mirror, and the other way round: an edge's bulge stands at its other end
        tooth = tuple((x, -y, tooth[at - 1][2]) for at, (x, y, _) in reversed([*enumerate(tooth)]))
    return FixedTooth(radius, root, tooth)


def _vertices(pitch: float, radius: float, root: float, face: float) -> Iterator[Vertex]:
    """Counter-clockwise: foot of the back, both ends of the tip, foot of the face; then along the root circle."""
    half = _BASE * pitch / 2
    for distance, angle, bulge in (
        (root, -half, 0.0),
        (radius, half + face - _LAND * pitch, tan(_LAND * pitch / 4)),
        (radius, half + face, 0.0),
        (root, half, tan((1 - _BASE) * pitch / 4)),
    ):
        yield distance * cos(angle), distance * sin(angle), bulge


# --------------------------------------------------------------------------------------------------------- strain waves


def wave_tooth(z: int, backlash: float, ring: bool = False) -> FixedTooth:
    """Of the wheel of z teeth, or of its ring, which has straight flanks too; play (modules) along the pitch circle."""
    radius, pitch = z / 2, 2 * pi / z
    side = -1 if ring else 1
    tip, root = radius + side * ADDENDUM, radius - side * DEDENDUM
    half = pi / 4 - backlash / 4  # of a tooth on the pitch circle
    ends = [(root, half + DEDENDUM * tan(FLANK)), (tip, half - ADDENDUM * tan(FLANK))]
    (foot, x), (top, tip_x) = ((asin(y / r), sqrt(r**2 - y**2)) for r, y in ends)
    low, high = ends[0][1], ends[1][1]
    tooth = (
        (x, -low, 0.0),
        (tip_x, -high, tan(top / 2)),
        (tip_x, high, 0.0),
        (x, low, tan((pitch - 2 * foot) / 4)),
    )
    return FixedTooth(tip, root, tooth, "ring" if ring else "external")


def wall(radius: float) -> float:
    """How thick a wheel that a wave bends is under its teeth, in the unit of its pitch radius."""
    return WALL * 2 * radius


def bent_line(line: Floats, middle: float, wave: tuple[float, int], turns: tuple[float, float] = (0.0, 0.0)) -> Floats:
    """Points of a thin wheel (n, 2) once a wave bends it, and it is turned; lengths in any one unit.

    The wheel is no rigid body. Its middle line keeps its length: what lies on it at the angle t moves outwards by
    w cos(n (t - s)), s the angle of the wave, and along by -w/n sin(n (t - s)); what lies beside stays on its normal.

    middle   radius of its middle line
    wave     how far it rises, and its lobes, the first of which is on the x axis
    turns    of the wheel and of the wave (rad)
    """
    (rise, lobes), (own, where) = wave, turns
    place = np.arctan2(line[:, 1], line[:, 0]) + own
    phase, off = lobes * (place - where), np.hypot(*line.T) - middle
    out, along = rise * np.cos(phase), -rise / lobes * np.sin(phase)
    at = place + along / middle
    leaning = at + (lobes * rise * np.sin(phase) + along) / middle
    points = (middle + out) * np.exp(1j * at) + off * np.exp(1j * leaning)
    return np.column_stack([points.real, points.imag])
