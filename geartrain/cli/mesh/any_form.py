"""`geartrain mesh FORM` for any tooth form: what its mesh tells of itself, its law as a picture, its wheels to cut."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Out,
    draw,
    emit,
    give,
)
from geartrain.cli.mesh.conjugate_options import FormOptions, read_any_form, read_module
from geartrain.cli.mesh.form_options import (
    Backlash,
    Bore,
    Driver,
    Friction,
    Module,
    Profile,
    ProfiledWheel,
    form_command,
    no_scale,
    pair_sinks,
)
from geartrain.cli.option_values import at_option, quantity
from geartrain.cli.option_values import friction as _friction
from geartrain.errors import GearTrainError

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_outline import WheelOutline


def _common(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the first and the second wheel.")],
    friction: Friction = "0",
    driver: Driver = 1,
    backlash: Backlash = None,
    module: Module = None,
    profile: Profile = None,
    wheel: ProfiledWheel = 1,
    bore: Bore = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw error, speed ratio and efficiency over a pitch to this file.")
    ] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Only its parameters count: those that all forms have."""


def command(form: str) -> Callable[..., None]:
    """The command of a form: the options all have, and its own."""
    return form_command(form, _common, _run, "Motion, losses and outlines")


def _run(
    form: str,
    own: FormOptions,
    *,
    driver: int,
    wheel: int,
    bore: str | None,
    profile: Path | None,
    plot: Path | None,
    json: bool,
    out: Out,
    force: bool,
    **given: Any,
) -> None:
    from geartrain.report.gear_pairs import describe_pair, pair_data

    to, picture, outlined = pair_sinks(out, plot, profile, force)
    mesh = _mesh(form, own, driver, given)
    if profile is not None:
        from geartrain.export import outline_text

        emit(outline_text(_outline(mesh, wheel, bore), outlined.suffix), outlined)
    give(to, json, lambda: pair_data(mesh), lambda: [describe_pair(mesh)])
    if plot is not None:
        from geartrain.drawing import transmission_figure

        draw(transmission_figure(mesh.law, f"{mesh.tooth_form.words} teeth, {mesh.name}"), picture)
    raise typer.Exit(GOOD if not mesh.faults else VERDICT)


def _mesh(form: str, own: FormOptions, driver: int, given: dict[str, Any]) -> GearMesh:
    """The two wheels in mesh. Raises `GearTrainError` where the form gives no such pair."""
    from geartrain.teeth.meshing_wheels import MeshDriver, MeshingWheels
    from geartrain.train import GearPair

    size = read_module(given["module"])
    teeth = given["teeth"]
    pair = GearPair(pair=("wheel 1", "wheel 2"))
    distance = None if size is None else size * sum(teeth) / 2
    wheels = MeshingWheels(pair, "", teeth, friction=_friction(given["friction"]), distance=distance)
    try:
        mesh = read_any_form(form, own, given["backlash"]).mesh(wheels, lambda: None)
    except GearTrainError as error:
        raise at_option(error, "--teeth") from None
    assert mesh is not None
    return mesh.driven_by(MeshDriver(pair.pair[driver - 1], ""))


def _outline(mesh: GearMesh, wheel: int, bore: str | None) -> WheelOutline:
    """A wheel of the pair, to scale."""
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, mesh_outline

    if mesh.wheels.module is None:
        raise no_scale()
    hole = None if bore is None else 1000 * quantity("--bore", bore, "length")
    return mesh_outline(mesh, wheel, BlankSizes(1000 * mesh.wheels.module, bore=hole))
