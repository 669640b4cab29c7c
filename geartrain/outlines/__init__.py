"""Outlines of whole wheels, closed and to scale: from a path of contact to what a laser or a mill follows.

Teeth are spur teeth, outside or (a ring) inside; a bevel tooth lies on a sphere and has no flat outline.
"""

from __future__ import annotations

from geartrain.outlines.contour import Contour
from geartrain.outlines.cut import Cut
from geartrain.outlines.wheel import Pins, Wheel, outline

__all__ = ["Contour", "Cut", "Pins", "Wheel", "outline"]
