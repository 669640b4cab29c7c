"""`geartrain mesh compare`: tooth forms compared with the 20 degree involute of the same pair and arcs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Out,
    check_distinct_outputs,
    draw,
    give,
    picture_sink,
    sink,
)
from geartrain.cli.mesh.form_options import read_wheels
from geartrain.cli.option_values import Theme, read_quantity
from geartrain.teeth.form_comparison import USUAL, arcs_error, comparable_forms, compare_forms

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity


def run(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the driving and the driven wheel.")],
    forms: Annotated[
        str, typer.Option("--forms", help=f"Tooth forms, separated by commas: {', '.join(comparable_forms())}.")
    ] = ",".join(USUAL),
    pressure_angle: Annotated[
        str | None,
        typer.Option(
            "--pressure-angle",
            help="Pressure angle of involute, uniform_stress, least_friction; default 20, 20, 25deg.",
        ),
    ] = None,
    arcs: Annotated[
        str,
        typer.Option("--arcs", help="Arcs of approach and recess in pitches: one value, or two separated by a comma."),
    ] = "0.5,0.5",
    bevel: Annotated[str | None, typer.Option("--bevel", help="Shaft angle of bevel wheels, such as 90deg.")] = None,
    internal: Annotated[bool, typer.Option("--internal", help="Make the second wheel a ring.")] = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw flanks, paths of contact and losses of all forms to this file.")
    ] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Compare loss, stress, heat, flash temperature and depth of tooth forms with the 20 degree involute.

    All forms have the same pair and the same arcs of approach and recess.
    """
    from geartrain.report.conjugate_pair_page import describe_form_comparison

    to, picture = sink(out, force, (".md", ".html", ".json")), picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    wheels = read_wheels(teeth, internal, bevel)
    names = list(dict.fromkeys(part.strip() for part in forms.split(",") if part.strip()))
    found = compare_forms(wheels, names, _arcs(arcs), _angle(pressure_angle))
    give(to, json, lambda: found, lambda: [describe_form_comparison(found)])
    if plot is not None:
        from geartrain.drawing import shapes_figure

        draw(shapes_figure({form.name: form.path for form in found.forms if form.path and form.runs}), picture)
    raise typer.Exit(GOOD if all(form.runs for form in found.forms) else VERDICT)


def _arcs(text: str) -> tuple[float, float]:
    """Parse arcs of approach and recess [pitch]; one number sets both."""
    parts = text.split(",")
    try:
        first, second = float(parts[0]), float(parts[-1])
    except ValueError:
        raise arcs_error(text) from None
    if len(parts) > 2:
        raise arcs_error(text)
    return first, second


def _angle(text: str | None) -> Quantity | None:
    return None if text is None else read_quantity("--pressure-angle", text, "angle")
