"""`geartrain mesh triangular`: contact, law, collisions and losses of a pair, or a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, PICTURES, VERDICT, Force, Json, Out, Sink, apart, as_json, draw, emit, show, sink
from geartrain.cli.mesh.pair import VARIED, Pair
from geartrain.cli.mesh.sweeping import sweep
from geartrain.cli.numbers import quantity as _quantity

if TYPE_CHECKING:
    from geartrain.teeth.triangular.law import TriangularLaw


def run(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the first and the second wheel.")],
    half_angle: Annotated[
        str, typer.Option("--half-angle", help="Half the aperture of a tooth, with its unit; two with a comma.")
    ] = "30deg",
    clearance: Annotated[str | None, typer.Option("--clearance", help="Clearance factor, above 1.")] = None,
    excess: Annotated[str | None, typer.Option("--excess", help="Clearance factor less 1.")] = None,
    window: Annotated[
        str | None, typer.Option("--window", help="Place in the pair's own window: 0 jams, 1 loses contact.")
    ] = None,
    backlash: Annotated[str | None, typer.Option("--backlash", help="Least play on the pitch circle.")] = None,
    centre_distance: Annotated[str | None, typer.Option("--centre-distance", help="Distance of the axes.")] = None,
    radii: Annotated[
        str, typer.Option("--radii", help="equal_depth, pitch_true, or two outer radii with a comma.")
    ] = "equal_depth",
    module: Annotated[
        str | None, typer.Option("--module", help="Pitch diameter over tooth count, which gives the wheels a size.")
    ] = None,
    friction: Annotated[str, typer.Option("--friction", help="Coefficient of friction.")] = "0",
    driver: Annotated[int, typer.Option("--driver", min=1, max=2, help="Which wheel drives, 1 or 2.")] = 1,
    backwards: Annotated[bool, typer.Option("--backwards", help="Turn backwards, on the back flanks.")] = False,
    inertia: Annotated[
        str | None, typer.Option("--inertia", help="Moment of inertia of all that turns with the driven wheel.")
    ] = None,
    rate: Annotated[str | None, typer.Option("--rate", help="Speed of the driver, such as '1 turn/s'.")] = None,
    load: Annotated[str | None, typer.Option("--load", help="Torque that resists the driven wheel.")] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option("--vary", help=f"NAME=FIRST:LAST:COUNT, once or twice; NAME is one of {', '.join(VARIED)}."),
    ] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the law, or the sweep, to this file.")] = None,
    teeth_plot: Annotated[Path | None, typer.Option("--teeth-plot", help="Draw the wheels in contact.")] = None,
    at: Annotated[str | None, typer.Option("--at", help="alpha_1 at which the wheels are drawn.")] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Contact, law, collisions and losses of a pair with triangular teeth, or a sweep over its parameters as CSV."""
    given = {
        "clearance": clearance,
        "excess": excess,
        "window": window,
        "backlash": backlash,
        "centre_distance": centre_distance,
    }
    to = sink(out, force, (".csv", ".json") if vary else (".md", ".html", ".json"))
    picture = sink(plot, force, PICTURES, "--plot")
    drawing = sink(teeth_plot, force, PICTURES, "--teeth-plot")
    apart(to, picture, drawing)
    pair = Pair(teeth, half_angle, given, radii, module, friction, driver, -1 if backwards else 1)
    if vary:
        if teeth_plot is not None:
            raise typer.BadParameter(
                "one pair is drawn, and a sweep has many: leave --vary out", param_hint="--teeth-plot"
            )
        sweep(pair, vary, picture, json, to)
        return
    law = pair.law()
    _page(pair, law, (inertia, rate, load), json, to)
    if plot is not None:
        from geartrain.plot import law_figure

        draw(law_figure(law), picture)
    if teeth_plot is not None:
        from geartrain.plot import teeth_figure

        angle = None if at is None else _quantity("--at", at, "angle")
        draw(teeth_figure(law, angle), drawing)
    raise typer.Exit(GOOD if law.verdict and law.friction < law.locking_friction else VERDICT)


def _page(pair: Pair, law: TriangularLaw, run: tuple[str | None, str | None, str | None], json: bool, to: Sink) -> None:
    from geartrain import report
    from geartrain.quantity import RADIANS_PER_TURN
    from geartrain.teeth.triangular.meshing import find_window

    inertia, rate, load = run
    running = report.Running(
        None if inertia is None else _quantity("--inertia", inertia, "inertia", least="above 0"),
        None if rate is None else _quantity("--rate", rate, "speed", least="above 0") / RADIANS_PER_TURN,
        None if load is None else _quantity("--load", load, "torque", least="0"),
    )
    found = find_window(law.sizes) if law.sizes.has_valleys else None
    if json or to.suffix == ".json":
        emit(as_json(report.mesh_data(law, found, running)), to)
    else:
        show([report.mesh_document(law, found, running)], to)
