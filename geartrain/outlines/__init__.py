"""Outlines of whole wheels, closed and to scale: from a path of contact to what a laser or a mill follows.

Teeth are spur teeth, outside or (a ring) inside; a bevel tooth lies on a sphere and has no flat outline. `outline` is
one wheel of a pair, `find_toothing` those of a train, each cut for all its mates.
"""

from __future__ import annotations

from geartrain.outlines.contour import Contour
from geartrain.outlines.cut import Cut
from geartrain.outlines.demand import Pins
from geartrain.outlines.toothing import STANDARD, Play, Toothed, Toothing, find_toothing
from geartrain.outlines.wheel import Wheel, outline

__all__ = [
    "STANDARD",
    "Contour",
    "Cut",
    "Pins",
    "Play",
    "Toothed",
    "Toothing",
    "Wheel",
    "find_toothing",
    "outline",
]
