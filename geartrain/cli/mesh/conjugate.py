"""`geartrain mesh involute` and the other conjugate forms: costs and faults of one pair, and outlines of its wheels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Out,
    Sink,
    draw,
    emit,
    give,
)
from geartrain.cli.mesh.conjugate_options import (
    ConjugateOptions,
    FormOptions,
    pair,
    read_form,
    read_wheels,
)
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
from geartrain.cli.option_values import friction as _friction
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline

_SIZES = ("module", "clearance", "fillet", "bore", "rim")


def _common(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the driving and the driven wheel.")],
    internal: Annotated[bool, typer.Option("--internal", help="The second wheel is a ring.")] = False,
    bevel: Annotated[str | None, typer.Option("--bevel", help="Angle between the axes, such as 90deg.")] = None,
    friction: Friction = "0",
    driver: Driver = 1,
    backlash: Backlash = None,
    module: Module = None,
    profile: Profile = None,
    wheel: ProfiledWheel = 1,
    clearance: Annotated[
        str | None, typer.Option("--clearance", help="With --profile: root to mate's tip; default module/4.")
    ] = None,
    fillet: Annotated[
        str | None, typer.Option("--fillet", help="With --profile: radius at the root; default 0.38 module, or less.")
    ] = None,
    bore: Bore = None,
    rim: Annotated[
        str | None, typer.Option("--rim", help="With --profile: what stands round a ring or a lantern.")
    ] = None,
    tolerance: Annotated[
        str, typer.Option("--tolerance", help="With --profile: how far chords may leave a flank.")
    ] = "0.001mm",
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw flanks, path of contact and costs to this file.")
    ] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Only its parameters count: those that all forms have."""


def command(form: str) -> Callable[..., None]:
    """The command of a form: the options all have, and its own."""
    return form_command(form, _common, _run, "Costs, faults and outlines")


def _run(
    form: str,
    own: FormOptions,
    *,
    friction: str,
    driver: int,
    wheel: int,
    profile: Path | None,
    plot: Path | None,
    json: bool,
    out: Out,
    force: bool,
    **given: Any,
) -> None:
    from geartrain.report.conjugate_pair_page import shape_data, shape_document
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission

    to, picture, outlined = pair_sinks(out, plot, profile, force)
    asked = read_wheels(given["teeth"], given["internal"], given["bevel"], given["module"], given["backlash"])
    model = read_form(form, own, asked.backlash)
    found = pair(model, asked)
    law = ConjugateTransmission(found, _friction(friction), driver)
    wheels = [] if profile is None else [_cut(model, found, asked, wheel, outlined, given)]
    give(to, json, lambda: shape_data(form, law, wheels), lambda: [shape_document(form, law, wheels)])
    if plot is not None:
        from geartrain.drawing import shapes_figure

        draw(shapes_figure({form: found.path}), picture)
    raise typer.Exit(GOOD if law.verdict and law.friction < law.locking_friction else VERDICT)


# ------------------------------------------------------------------------------------------------------------ outlines


def _cut(
    model: ConjugateToothForm,
    found: ConjugatePair,
    asked: ConjugateOptions,
    wheel: int,
    to: Sink,
    given: dict[str, Any],
) -> WheelOutline:
    """The outline of a wheel, written."""
    from geartrain.export import outline_text
    from geartrain.teeth.outlines.wheel_outline import outline

    if given["module"] is None:
        raise no_scale()
    sizes = _sizes(given)
    if sizes.clearance is None and (free := _bottom_clearance(model, asked, wheel)) is not None:
        sizes = replace(sizes, clearance=free * sizes.module)
    made = outline(found, wheel, sizes, model.lantern_pins(asked.wheels))
    emit(outline_text(made, to.suffix), to)
    return made


def _sizes(given: dict[str, Any]) -> BlankSizes:
    from geartrain.teeth.outlines.wheel_outline import BlankSizes

    sizes = {
        name: None if given[name] is None else 1000 * quantity(f"--{name}", given[name], "length")
        for name in (*_SIZES, "tolerance")
    }
    return BlankSizes(**sizes)  # type: ignore[arg-type]


def _bottom_clearance(model: ConjugateToothForm, asked: ConjugateOptions, wheel: int) -> float | None:
    """What the form leaves between a wheel's root and its mate's tip, in modules; None where it does not say."""
    free = model.bottom_clearance(asked.wheels, wheel)
    if free is not None and free < 0:
        raise GearTrainError(
            Problem(
                f"the root of gear {wheel} stands in the way of its mate's tip",
                f"they overlap by {-free:.4g} modules at this centre distance",
                "give a greater --dedendum or a smaller --addendum",
                "--dedendum",
            )
        )
    return free
