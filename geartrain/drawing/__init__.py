"""Static pictures of trains and of results.

In: a train, or a result of another package. Out: a figure of matplotlib, which `render` writes as SVG, PNG or PDF; the
same figure gives the same bytes. `picture` draws a train as plan to scale, stick diagram, graph, speed diagram or
dials; the other functions draw one result each. Plots of results of the wings are in the wings. Only places on the page
are calculated here: a speed diagram has its members at places that their teeth fix (docs/theory.md, equations 18 and
19), and bands of power are as wide as powers (docs/torques.md, 7).

train_pictures        `picture`, which chooses among the following
plan_view             plan to scale; `projection` has scenes on a page, from the side or obliquely
stick_diagram         functional diagram; `stick_grid` arranges axes, columns and levels
kinematic_graph       the graph (stress majorization)
lever_diagram         speed diagram
dial_faces            dials
transmission_curves   a transmission function, conjugate tooth forms; `parameter_sweep_plot` has one over a parameter
tooth_contact         two wheels of triangular teeth in contact
output_error_plots    errors of outputs, torque over a turn
power_sankey          power flow; `sankey` lays it out
spherical_gears       gears on a sphere
flat_files            outlines to cut: SVG, DXF, CSV
style                 panels for curves and for bars, legends, words, image files; `theme_colours` recolours a figure
arrangement           placement of nodes, words and callouts

The figures need the extra `plot`: a name that is used without it raises `MissingExtraError`. Nothing needs a display or
touches the state of pyplot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.drawing.flat_files import outline_text as outline_text
    from geartrain.drawing.output_error_plots import motion_figure as motion_figure
    from geartrain.drawing.output_error_plots import outputs_figure as outputs_figure
    from geartrain.drawing.output_error_plots import torque_cycle_figure as torque_cycle_figure
    from geartrain.drawing.parameter_sweep_plot import sweep_figure as sweep_figure
    from geartrain.drawing.power_sankey import power_figure as power_figure
    from geartrain.drawing.spherical_gears import sphere_figure as sphere_figure
    from geartrain.drawing.style import render as render
    from geartrain.drawing.tooth_contact import teeth_figure as teeth_figure
    from geartrain.drawing.train_pictures import picture as picture
    from geartrain.drawing.transmission_curves import shapes_figure as shapes_figure
    from geartrain.drawing.transmission_curves import transmission_figure as transmission_figure
    from geartrain.drawing.transmission_curves import triangular_figure as triangular_figure

__all__ = [
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
    "triangular_figure",
]

_PLACES = {
    "render": "style",
    "outline_text": "flat_files",
    "shapes_figure": "transmission_curves",
    **dict.fromkeys(("motion_figure", "outputs_figure"), "output_error_plots"),
    "sweep_figure": "parameter_sweep_plot",
    "power_figure": "power_sankey",
    "sphere_figure": "spherical_gears",
    "teeth_figure": "tooth_contact",
    "torque_cycle_figure": "output_error_plots",
    "picture": "train_pictures",
    **dict.fromkeys(("triangular_figure", "transmission_figure"), "transmission_curves"),
}

__getattr__ = lazy_names(__name__, _PLACES)
