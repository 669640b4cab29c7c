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


def bent_circle(middle: float, inwards: float, rise: float, lobes: int, number: int) -> Floats:
    """A circle of a thin ring once a wave bends it, as points (number, 2); in any one unit of length.

    middle    radius of the ring's middle line, which does not stretch
    inwards   how far within that the circle lies
    rise      of the wave, whose first lobe is on the x axis
    """
    turn = 2 * pi * np.arange(number) / number
    along = -rise / lobes * np.sin(lobes * turn)
    tilt = (lobes * rise * np.sin(lobes * turn) + along) / middle
    line = (middle + rise * np.cos(lobes * turn)) * np.exp(1j * (turn + along / middle))
    line -= inwards * np.exp(1j * (turn + along / middle + tilt))
    return np.column_stack([line.real, line.imag])
