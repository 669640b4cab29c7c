"""Still pictures: of a train, and of what was found out about it.

In: a train, or a result of another room. Out: a figure of matplotlib, which `render` writes as SVG, PNG or PDF; the
same figure gives the same bytes. `picture` draws a train as plan to scale, stick diagram, graph, speed diagram or
dials; the other functions draw one result each: a transmission function, teeth in contact, tooth forms side by side,
the errors of pointers, the flow of power, torque over a turn, motion in time, gears on a sphere, trials of wheels
cut by hand, counts in doubt. Nothing is worked out here but where things stand on the page: a speed diagram has its
members at places that their teeth fix (docs/theory.md, equations 18 and 19), and bands of power are as wide as powers
(docs/torques.md, 7).

Map: `train_pictures` chooses among `plan_view` (with `projection`, `oblique_side_views`, `callouts`), `stick_diagram`
(`stick_grid`), `kinematic_graph` (`arrangement`), `lever_diagram` and `dial_faces`. Pairs are drawn by `tooth_contact`,
`transmission_curves`, `form_comparison` and `tooth_sizes_plot`; a train in motion by `output_error_plots`,
`torque_cycle_plot`, `time_run_plot` and `power_sankey` (`sankey`); doubt and errors by `monte_carlo_plots` (`jam_map`,
`tornado_chart`, `pointer_error_plots`), `budget_bars`, `corner_plot` and `parameter_sweep_plot`; spheres by
`spherical_gears`. `backend`, `style`, `theme_colours` and `labels` are shared.

The figures need the extra `plot`: a name that is asked for without it raises `MissingExtraError`. Nothing needs a
display or touches the state of pyplot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.drawing.backend import render as render
    from geartrain.drawing.budget_bars import budget_figure as budget_figure
    from geartrain.drawing.corner_plot import counts_figure as counts_figure
    from geartrain.drawing.form_comparison import shapes_figure as shapes_figure
    from geartrain.drawing.monte_carlo_plots import monte_carlo_figure as monte_carlo_figure
    from geartrain.drawing.output_error_plots import motion_figure as motion_figure
    from geartrain.drawing.output_error_plots import outputs_figure as outputs_figure
    from geartrain.drawing.parameter_sweep_plot import sweep_figure as sweep_figure
    from geartrain.drawing.power_sankey import power_figure as power_figure
    from geartrain.drawing.spherical_gears import sphere_figure as sphere_figure
    from geartrain.drawing.time_run_plot import time_run_figure as time_run_figure
    from geartrain.drawing.tooth_contact import teeth_figure as teeth_figure
    from geartrain.drawing.tooth_sizes_plot import tooth_sizes_figure as tooth_sizes_figure
    from geartrain.drawing.tooth_sizes_plot import train_sizes_figure as train_sizes_figure
    from geartrain.drawing.torque_cycle_plot import torque_cycle_figure as torque_cycle_figure
    from geartrain.drawing.train_pictures import picture as picture
    from geartrain.drawing.transmission_curves import law_figure as law_figure
    from geartrain.drawing.transmission_curves import transmission_figure as transmission_figure

_PLACES = {
    "budget_figure": "budget_bars",
    "counts_figure": "corner_plot",
    "law_figure": "transmission_curves",
    "monte_carlo_figure": "monte_carlo_plots",
    "motion_figure": "output_error_plots",
    "outputs_figure": "output_error_plots",
    "picture": "train_pictures",
    "power_figure": "power_sankey",
    "render": "backend",
    "shapes_figure": "form_comparison",
    "sphere_figure": "spherical_gears",
    "sweep_figure": "parameter_sweep_plot",
    "teeth_figure": "tooth_contact",
    "time_run_figure": "time_run_plot",
    "tooth_sizes_figure": "tooth_sizes_plot",
    "train_sizes_figure": "tooth_sizes_plot",
    "torque_cycle_figure": "torque_cycle_plot",
    "transmission_figure": "transmission_curves",
}

__all__ = [
    "budget_figure",
    "counts_figure",
    "law_figure",
    "monte_carlo_figure",
    "motion_figure",
    "outputs_figure",
    "picture",
    "power_figure",
    "render",
    "shapes_figure",
    "sphere_figure",
    "sweep_figure",
    "teeth_figure",
    "time_run_figure",
    "tooth_sizes_figure",
    "torque_cycle_figure",
    "train_sizes_figure",
    "transmission_figure",
]

__getattr__ = lazy_names(__name__, _PLACES)
