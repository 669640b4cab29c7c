"""Figures: the law of a pair of triangular teeth, its wheels in contact, sweeps; motion of outputs; flow of power;
conjugate tooth forms side by side; gears on a sphere; pictures of a train: plan, stick, graph, lever, dials; wheels
cut by hand and counts in doubt: pointers that stray, maps of jams, sensitivities, likely counts, convergence.

The figures need the `plot` extra: asking for one of these names without it raises `MissingExtraError`. Nothing here
needs a display or touches the state of pyplot.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geartrain.plot.convergence import Settling, convergence_figure
    from geartrain.plot.corner import Likely, corner_figure
    from geartrain.plot.counts import counts_figure
    from geartrain.plot.jam_map import jam_map_figure
    from geartrain.plot.law import law_figure
    from geartrain.plot.motion import motion_figure
    from geartrain.plot.pictures import KINDS, picture
    from geartrain.plot.power import power_figure
    from geartrain.plot.rendering import render
    from geartrain.plot.shapes import shapes_figure
    from geartrain.plot.sphere import sphere_figure
    from geartrain.plot.straying import Bands, histogram_figure, straying_figure
    from geartrain.plot.sweep import sweep_figure
    from geartrain.plot.teeth import teeth_figure
    from geartrain.plot.tornado import Sway, tornado_figure
    from geartrain.plot.trials import findings_figure

__all__ = [
    "KINDS",
    "Bands",
    "Likely",
    "Settling",
    "Sway",
    "convergence_figure",
    "corner_figure",
    "counts_figure",
    "findings_figure",
    "histogram_figure",
    "jam_map_figure",
    "law_figure",
    "motion_figure",
    "picture",
    "power_figure",
    "render",
    "shapes_figure",
    "sphere_figure",
    "straying_figure",
    "sweep_figure",
    "teeth_figure",
    "tornado_figure",
]

_PLACES = {
    "KINDS": "pictures",
    "Bands": "straying",
    "Likely": "corner",
    "Settling": "convergence",
    "Sway": "tornado",
    "convergence_figure": "convergence",
    "corner_figure": "corner",
    "counts_figure": "counts",
    "findings_figure": "trials",
    "histogram_figure": "straying",
    "jam_map_figure": "jam_map",
    "law_figure": "law",
    "motion_figure": "motion",
    "picture": "pictures",
    "power_figure": "power",
    "render": "rendering",
    "shapes_figure": "shapes",
    "sphere_figure": "sphere",
    "straying_figure": "straying",
    "sweep_figure": "sweep",
    "teeth_figure": "teeth",
    "tornado_figure": "tornado",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
