"""`geartrain mesh pin`: the law of a pin in a slot or in a follower."""

from __future__ import annotations

from typing import Annotated, Literal, cast

import typer

from geartrain.cli.common import Force, Json, Out, give, sink
from geartrain.cli.mesh.form_options import as_options
from geartrain.cli.option_values import friction as read_friction
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError


def run(
    pin_radius: Annotated[str, typer.Option("--pin-radius", help="Distance of the pin from its own axis.")],
    offset: Annotated[str, typer.Option("--offset", help="Distance of the two axes.")],
    friction: Annotated[str, typer.Option("--friction", help="Friction of the pin along the slot.")] = "0",
    driver: Annotated[str, typer.Option("--driver", help="Which drives: pin or slot.")] = "pin",
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Law of a pin in a slot or in a follower: mean ratio, amplitude, extreme speeds."""
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
        law = pin_transmission(r, e, rub, cast(Literal["pin", "slot"], driver))
    except GearTrainError as error:
        raise as_options(error, "--pin-radius") from None
    give(to, json, lambda: pin_figures(law), lambda: [describe_pin(law)])
