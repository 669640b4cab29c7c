"""Static pictures of trains and of results.

In: a train, or a result of another room. Out: a figure of matplotlib, which `render` writes as SVG, PNG or PDF; the
same figure gives the same bytes. `picture` draws a train as plan to scale, stick diagram, graph, speed diagram or
dials; the other functions draw one result each: a transmission function, teeth in contact, tooth forms side by side,
the errors of pointers, the flow of power, torque over a turn, gears on a sphere. Plots of results of the wings are in
the wings. Nothing is worked out here but where things stand on the page: a speed diagram has its
members at places that their teeth fix (docs/theory.md, equations 18 and 19), and bands of power are as wide as powers
(docs/torques.md, 7).

Map: `train_pictures` chooses among `plan_view` (with `projection`, `oblique_side_views`, `callouts`), `stick_diagram`
(`stick_grid`), `kinematic_graph` (`arrangement`), `lever_diagram` and `dial_faces`. Pairs are drawn by `tooth_contact`,
`transmission_curves`, `form_comparison` and `parameter_sweep_plot`; a train in motion by `output_error_plots`,
`torque_cycle_plot` and `power_sankey` (`sankey`); spheres by `spherical_gears`. `flat_files` writes outlines to cut.
`backend`, `style`, `theme_colours` and `labels` are shared.

The figures need the extra `plot`: a name that is asked for without it raises `MissingExtraError`. Nothing needs a
display or touches the state of pyplot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.drawing.backend import render as render
    from geartrain.drawing.flat_files import outline_text as outline_text
    from geartrain.drawing.form_comparison import shapes_figure as shapes_figure
    from geartrain.drawing.output_error_plots import motion_figure as motion_figure
    from geartrain.drawing.output_error_plots import outputs_figure as outputs_figure
    from geartrain.drawing.parameter_sweep_plot import sweep_figure as sweep_figure
    from geartrain.drawing.power_sankey import power_figure as power_figure
    from geartrain.drawing.spherical_gears import sphere_figure as sphere_figure
    from geartrain.drawing.tooth_contact import teeth_figure as teeth_figure
    from geartrain.drawing.torque_cycle_plot import torque_cycle_figure as torque_cycle_figure
    from geartrain.drawing.train_pictures import picture as picture
    from geartrain.drawing.transmission_curves import law_figure as law_figure
    from geartrain.drawing.transmission_curves import transmission_figure as transmission_figure

__all__ = [
    "law_figure",
    "motion_figure",
    "outline_text",
    "outputs_figure",
    "picture",
    "power_figure",
    "render",
    "shapes_figure",
    "sphere_figure",
    "sweep_figure",
    "teeth_figure",
    "torque_cycle_figure",
    "transmission_figure",
]

_PLACES = {
    "render": "backend",
    "outline_text": "flat_files",
    "shapes_figure": "form_comparison",
    **dict.fromkeys(("motion_figure", "outputs_figure"), "output_error_plots"),
    "sweep_figure": "parameter_sweep_plot",
    "power_figure": "power_sankey",
    "sphere_figure": "spherical_gears",
    "teeth_figure": "tooth_contact",
    "torque_cycle_figure": "torque_cycle_plot",
    "picture": "train_pictures",
    **dict.fromkeys(("law_figure", "transmission_figure"), "transmission_curves"),
}

__getattr__ = lazy_names(__name__, _PLACES)
