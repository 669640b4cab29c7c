"""Where axes and wheels stand: positions as declared, or placed so that meshing wheels touch and nothing collides."""

from __future__ import annotations

from geartrain.scene.layout.axis_places import AxisPlace, Layout, WheelPlace
from geartrain.scene.layout.train_layout import lay_out

__all__ = ["AxisPlace", "Layout", "WheelPlace", "lay_out"]
