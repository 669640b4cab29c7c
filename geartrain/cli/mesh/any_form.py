"""`geartrain mesh FORM`: verdict, motion and losses of a pair, and outlines of its wheels, for any tooth form.

`geartrain mesh pin`: the transmission function of a pin in a slot or in a follower.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

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
from geartrain.cli.mesh.form_options import (
    FINE,
    Bore,
    Friction,
    Internal,
    Profile,
    Rate,
    Tolerance,
    WheelNumber,
    as_options,
    form_command,
    pair_in_mesh,
    profile_sink,
    read_form,
    read_helix,
    read_module,
    read_pair_friction,
    read_shaft_angle,
    two_wheels,
    write_profile,
)
from geartrain.cli.option_values import Theme, at_option, quantity, read_quantity
from geartrain.cli.option_values import friction as read_friction
from geartrain.errors import GearTrainError
from geartrain.teeth.any_tooth_form import tooth_form
from geartrain.teeth.tooth_form import ToothForm

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from geartrain.teeth.gear_mesh import GearMesh


_CONJUGATE = ("internal", "bevel", "clearance", "fillet", "rim")
"""Options that apply only to conjugate forms: rings, bevel wheels, and the root, which the path of contact does not
determine.
"""

_HELICAL = ("helix",)
"""Options only of the form whose teeth can be helical."""


def command(name: str) -> Callable[..., None]:
    """Create the command of a form from the common options and its own."""
    model = tooth_form(name)
    kind = "losses, stresses, faults and outlines" if model.conjugate else "motion, losses and outlines"
    words = f"Compute {kind} of a pair with {name.replace('_', '-')} teeth."
    without = (*(() if model.conjugate else _CONJUGATE), *(() if name == "involute" else _HELICAL))
    return form_command(model, partial(_run, model), words, without=without)


def _run(
    model: type[ToothForm],
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the first and the second wheel.")],
    internal: Internal = False,
    bevel: Annotated[str | None, typer.Option("--bevel", help="Shaft angle of bevel wheels, such as 90deg.")] = None,
    helix: Annotated[
        str | None, typer.Option("--helix", help="Helix angle, such as 20deg; modules are then normal modules.")
    ] = None,
    friction: Friction = "0",
    rate: Rate = None,
    driver: Annotated[int, typer.Option("--driver", min=1, max=2, help="Number of the driving wheel, 1 or 2.")] = 1,
    backlash: Annotated[
        str | None, typer.Option("--backlash", help="Backlash on the pitch circle, in modules or with a unit.")
    ] = None,
    module: Annotated[
        str | None, typer.Option("--module", help="Module (pitch diameter over tooth count), such as 2mm.")
    ] = None,
    profile: Profile = None,
    wheel: WheelNumber = 1,
    clearance: Annotated[
        str | None, typer.Option("--clearance", help="With --profile: bottom clearance; default module/4.")
    ] = None,
    fillet: Annotated[
        str | None, typer.Option("--fillet", help="With --profile: root fillet radius; default 0.38 module, or less.")
    ] = None,
    bore: Bore = None,
    rim: Annotated[
        str | None, typer.Option("--rim", help="With --profile: radial thickness of the rim of a ring or lantern.")
    ] = None,
    tolerance: Tolerance = FINE,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot",
            help="Draw flanks, path of contact and losses to this file; without such a path, the motion.",
        ),
    ] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
    **own: Any,
) -> None:
    from geartrain.report.pair_page import collect_pair, describe_pair

    to, picture = sink(out, force, (".md", ".html", ".json")), picture_sink(plot, force, theme)
    outlined = profile_sink(profile, force)
    check_distinct_outputs(to, outlined, picture)
    angle, size = read_shaft_angle(internal, bevel), read_module(module, backlash)
    rub = read_pair_friction(friction)
    wheels = two_wheels(teeth, rub.coefficient, size, internal or model.ringed, angle, read_helix(helix, angle))
    form = _read(model, own, clearance, backlash)
    try:
        mesh = rub.of(pair_in_mesh(form, wheels, angle, driver), rate)
    except GearTrainError as error:
        raise at_option(error, "--teeth") from None
    # the option is that of the form if the form has one, else that of the profile
    root = None if "clearance" in model.model_fields else clearance
    blank = {"clearance": root, "fillet": fillet, "bore": bore, "rim": rim, "tolerance": tolerance}
    outlines = write_profile(mesh, wheel, blank, outlined)
    give(to, json, lambda: collect_pair(mesh, outlines), lambda: [describe_pair(mesh, outlines)])
    if plot is not None:
        draw(_figure(mesh), picture)
    raise typer.Exit(GOOD if not mesh.faults else VERDICT)


def _read(model: type[ToothForm], own: dict[str, Any], clearance: str | None, backlash: str | None) -> ToothForm:
    """Parse the form.

    A clearance can be an option of the form or the clearance at the root of a profile. A form without a field for
    backlash is thinned.
    """
    if "clearance" in model.model_fields:
        own = own | {"clearance": clearance}
    if "backlash" in model.model_fields or backlash is None:
        return read_form(model, own | ({} if backlash is None else {"backlash": backlash}))
    return read_form(model, own).thinned(read_quantity("--backlash", backlash, "length", plain=True, minimum="0"))


def _figure(mesh: GearMesh) -> Figure:
    """Plot flanks and losses along the path of contact, or the motion over a pitch for forms without a path."""
    from geartrain.drawing import shapes_figure, transmission_figure

    if mesh.path is not None:
        return shapes_figure({mesh.form: mesh.path})
    driver, driven = mesh.counts
    return transmission_figure(mesh.losses, f"{mesh.tooth_form.words} teeth, {driver} drives {driven}")


def pin(
    pin_radius: Annotated[str, typer.Option("--pin-radius", help="Distance of the pin from the axis of its wheel.")],
    offset: Annotated[str, typer.Option("--offset", help="Distance between the two axes.")],
    friction: Annotated[str, typer.Option("--friction", help="Coefficient of friction between pin and slot.")] = "0",
    driver: Annotated[str, typer.Option("--driver", help="Driving member: pin or slot.")] = "pin",
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute mean ratio, amplitude and extreme speeds of a pin in a slot or in a follower."""
    from geartrain.report.pair_page import describe_pin
    from geartrain.teeth.pair_results import pin_figures
    from geartrain.teeth.pin_coupling import pin_transmission

    to = sink(out, force, (".md", ".html", ".json"))
    rub = read_friction(friction)
    if driver not in ("pin", "slot"):
        raise typer.BadParameter(f"'{driver}' is neither pin nor slot", param_hint="--driver")
    r = quantity("--pin-radius", pin_radius, "length", plain=True)
    e = quantity("--offset", offset, "length", plain=True)
    try:
        transmission = pin_transmission(r, e, rub, cast(Literal["pin", "slot"], driver))
    except GearTrainError as error:
        raise as_options(error, "--pin-radius") from None
    give(to, json, lambda: pin_figures(transmission), lambda: [describe_pin(transmission)])
