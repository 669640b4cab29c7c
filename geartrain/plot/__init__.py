"""Figures: the law of a pair of triangular teeth, its wheels in contact, sweeps; motion of outputs; flow of power;
conjugate tooth forms side by side; gears on a sphere.

The figures need the `plot` extra: asking for one of these names without it raises `MissingExtraError`. Nothing here
needs a display or touches the state of pyplot.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geartrain.plot.law import law_figure
    from geartrain.plot.motion import motion_figure
    from geartrain.plot.power import power_figure
    from geartrain.plot.rendering import render
    from geartrain.plot.shapes import shapes_figure
    from geartrain.plot.sphere import sphere_figure
    from geartrain.plot.sweep import sweep_figure
    from geartrain.plot.teeth import teeth_figure

__all__ = [
    "law_figure",
    "motion_figure",
    "power_figure",
    "render",
    "shapes_figure",
    "sphere_figure",
    "sweep_figure",
    "teeth_figure",
]

_PLACES = {
    "law_figure": "law",
    "motion_figure": "motion",
    "power_figure": "power",
    "render": "rendering",
    "shapes_figure": "shapes",
    "sphere_figure": "sphere",
    "sweep_figure": "sweep",
    "teeth_figure": "teeth",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
