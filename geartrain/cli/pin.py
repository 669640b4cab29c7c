"""`geartrain pin`: transmission function of a pin in a slot or in a follower."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

import typer

from geartrain.cli.common import Force, Json, Out, give, sink
from geartrain.cli.option_values import friction as read_friction
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError


def run(
    pin_radius: Annotated[
        str, typer.Argument(help="Distance of the pin from the axis of its wheel, such as 9.6mm.", metavar="PIN_RADIUS")
    ],
    offset: Annotated[str, typer.Argument(help="Distance between the two axes, such as 1.1mm.", metavar="OFFSET")],
    friction: Annotated[str, typer.Option("--friction", help="Coefficient of friction between pin and slot.")] = "0",
    driver: Annotated[
        Literal["pin", "slot"], typer.Option("--driver", help="Driving member: the pin or the slot.")
    ] = "pin",
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute the mean ratio, amplitude and extreme speeds of a pin in a slot or in a follower.

    Example: `geartrain pin 9.6mm 1.1mm`.
    """
    from geartrain.report.pair_page import describe_pin
    from geartrain.teeth.couplings.pins import pin_transmission
    from geartrain.teeth.pair_results import pin_figures

    to = sink(out, force, (".md", ".html", ".json"))
    rub = read_friction(friction)
    r = quantity("PIN_RADIUS", pin_radius, "length", plain=True)
    e = quantity("OFFSET", offset, "length", plain=True)
    try:
        transmission = pin_transmission(r, e, rub, driver)
    except GearTrainError as error:
        raise GearTrainError(
            replace(each, place=f"--{each.place}" if each.place else "PIN_RADIUS") for each in error.problems
        ) from None
    give(to, json, lambda: pin_figures(transmission), lambda: [describe_pin(transmission)])
