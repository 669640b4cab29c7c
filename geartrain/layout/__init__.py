"""Where axes and wheels stand: positions as declared, or placed so that meshing wheels touch and nothing collides."""

from __future__ import annotations

from geartrain.layout.finding import lay_out
from geartrain.layout.result import AxisPlace, Layout, WheelPlace

__all__ = ["AxisPlace", "Layout", "WheelPlace", "lay_out"]
