"""The teeth of a strain wave: straight flanks, as a wheel that a wave bends into its ring needs them.

With a wave of n lobes whose ring has n teeth more, the middle line of the thin wheel is moved outwards by w cos(u),
w = n/2 modules, and does not stretch. A tooth then leaves its space of the ring by n/2 (1 - cos u) while it moves along
by (u - sin u)/2: flanks at the angle a from its middle pass each other while n (1 - cos u) tan a > u - sin u
(docs/reducers.md, (8)). Lengths in modules.
"""

from __future__ import annotations

from math import asin, pi, radians, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.wheel_requirement import FixedTooth

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

WAVE = "strain wave"
WORDS = "of a strain wave, straight flanks of 30 degrees, 0.7 modules out and 0.9 in"
FLANK = radians(30.0)
"""Of a flank from the middle of its tooth (rad)."""
ADDENDUM, DEDENDUM = 0.7, 0.9
"""In modules: a tooth must have left its space where the wheel is bent in, two modules from where it is bent out."""
WALL = 0.012
"""Of the pitch diameter: wall of the wheel under its teeth, thin enough to be bent."""
CUP = 0.25
"""Of the pitch diameter: length of the wall that joins the wheel to its cup; a short one hardly bends."""


def wave_tooth(z: int, play: float, ring: bool = False) -> FixedTooth:
    """Of the wheel of z teeth, or of its ring, which has straight flanks too; play (modules) along the pitch circle."""
    radius, pitch = z / 2, 2 * pi / z
    side = -1 if ring else 1
    tip, root = radius + side * ADDENDUM, radius - side * DEDENDUM
    half = pi / 4 - play / 4  # of a tooth on the pitch circle
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
