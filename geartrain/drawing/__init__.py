"""Still pictures: a train as plan, stick diagram, graph, lever and dials.

And what it does: the law of a pair, its teeth in contact, tooth forms side by side, motion of outputs, flow of power,
gears on a sphere; wheels cut by hand and counts in doubt: pointers that stray, maps of jams, sensitivities, likely
counts, convergence.

The figures need the `plot` extra: asking for one of these names without it raises `MissingExtraError`. Nothing here
needs a display or touches the state of pyplot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.drawing.backend import render
    from geartrain.drawing.corner_plot import CountProbabilities, corner_figure, counts_figure
    from geartrain.drawing.form_comparison import shapes_figure
    from geartrain.drawing.jam_map import jam_map_figure
    from geartrain.drawing.monte_carlo_plots import ConvergenceTrace, convergence_figure, monte_carlo_figure
    from geartrain.drawing.output_error_plots import motion_figure
    from geartrain.drawing.pair_transmission import transmission_figure
    from geartrain.drawing.parameter_sweep_plot import sweep_figure
    from geartrain.drawing.pointer_error_plots import ErrorBands, histogram_figure, pointer_error_figure
    from geartrain.drawing.power_sankey import power_figure
    from geartrain.drawing.spherical_gears import sphere_figure
    from geartrain.drawing.tooth_contact import teeth_figure
    from geartrain.drawing.tornado_chart import VarianceShare, tornado_figure
    from geartrain.drawing.train_pictures import KINDS, picture
    from geartrain.drawing.transmission_curves import law_figure

__all__ = [
    "KINDS",
    "ConvergenceTrace",
    "CountProbabilities",
    "ErrorBands",
    "VarianceShare",
    "convergence_figure",
    "corner_figure",
    "counts_figure",
    "histogram_figure",
    "jam_map_figure",
    "law_figure",
    "monte_carlo_figure",
    "motion_figure",
    "picture",
    "pointer_error_figure",
    "power_figure",
    "render",
    "shapes_figure",
    "sphere_figure",
    "sweep_figure",
    "teeth_figure",
    "tornado_figure",
    "transmission_figure",
]

_PLACES = {
    "KINDS": "train_pictures",
    "ErrorBands": "pointer_error_plots",
    "CountProbabilities": "corner_plot",
    "ConvergenceTrace": "monte_carlo_plots",
    "VarianceShare": "tornado_chart",
    "convergence_figure": "monte_carlo_plots",
    "corner_figure": "corner_plot",
    "counts_figure": "corner_plot",
    "monte_carlo_figure": "monte_carlo_plots",
    "histogram_figure": "pointer_error_plots",
    "jam_map_figure": "jam_map",
    "law_figure": "transmission_curves",
    "motion_figure": "output_error_plots",
    "picture": "train_pictures",
    "power_figure": "power_sankey",
    "render": "backend",
    "shapes_figure": "form_comparison",
    "sphere_figure": "spherical_gears",
    "pointer_error_figure": "pointer_error_plots",
    "sweep_figure": "parameter_sweep_plot",
    "teeth_figure": "tooth_contact",
    "tornado_figure": "tornado_chart",
    "transmission_figure": "pair_transmission",
}

__getattr__ = lazy_names(__name__, _PLACES)
