"""What the figures take from matplotlib, in one place: importing this module without it names the extra."""

from __future__ import annotations

from geartrain.errors import MissingExtraError

try:
    from matplotlib import rc_context
    from matplotlib.axes import Axes
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle, FancyArrowPatch, Patch, PathPatch, Polygon, Rectangle
    from matplotlib.path import Path
    from matplotlib.patheffects import Stroke, withStroke
    from matplotlib.text import Text
except ImportError:
    raise MissingExtraError("matplotlib", "plot", "a plot") from None

__all__ = [
    "Axes",
    "Circle",
    "FancyArrowPatch",
    "Figure",
    "Line2D",
    "Patch",
    "Path",
    "PathPatch",
    "PolyCollection",
    "Polygon",
    "Rectangle",
    "Stroke",
    "Text",
    "rc_context",
    "withStroke",
]
