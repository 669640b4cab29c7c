"""Static pictures of trains and of results.

The output is a matplotlib figure, which `render` writes as SVG, PNG or PDF. The same figure gives the same bytes.
`picture` draws a train, and each other function draws one kind of result. Plots of the results of the optional packages
are in those packages.

train_pictures        `picture`, which calls one of the next five modules
plan_view             plan to scale; `projection` puts scenes on a page, from the side or obliquely
stick_diagram         functional diagram; `stick_grid` arranges axes, columns and levels
kinematic_graph       kinematic graph (stress majorization)
lever_diagram         speed diagram
dial_faces            dials
transmission_curves   transmission functions, conjugate tooth forms; `parameter_sweep_plot` plots parameter sweeps
tooth_contact         two wheels of triangular teeth in contact
output_error_plots    deviations of outputs, torque over a revolution
power_sankey          power flow; `sankey` computes its layout
spherical_gears       gears on a sphere
flat_files            outlines to cut: SVG, DXF, CSV
style                 panels for curves and for bars, legends, text, image files; `theme_colours` recolours a figure
arrangement           placement of nodes, text and callouts

The figures need the extra `plot`. Without it the use of a name raises `MissingExtraError`. No figure needs a display
or changes the state of pyplot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.drawing.flat_files import outline_text as outline_text
    from geartrain.drawing.parameter_sweep_plot import sweep_figure as sweep_figure
    from geartrain.drawing.spherical_gears import sphere_figure as sphere_figure
    from geartrain.drawing.style import render as render
    from geartrain.drawing.train_pictures import picture as picture

__getattr__, __all__ = public_names(
    __name__,
    {
        "flat_files": "outline_text",
        "parameter_sweep_plot": "sweep_figure",
        "spherical_gears": "sphere_figure",
        "style": "render",
        "train_pictures": "picture",
    },
)
