"""`geartrain mesh pin`: the law of a pin in a slot or in a follower."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import Force, Json, Out, give, sink
from geartrain.cli.option_values import at_option
from geartrain.cli.option_values import friction as _friction
from geartrain.cli.option_values import quantity as _quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.teeth.pin_transmission import PinTransmission


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
    from geartrain.report.pair_page import pin_data, pin_document

    to = sink(out, force, (".md", ".html", ".json"))
    law = _pin_law(pin_radius, offset, _friction(friction), driver)
    give(to, json, lambda: pin_data(law), lambda: [pin_document(law, driver)])


def _pin_law(pin_radius: str, offset: str, friction: float, driver: str) -> PinTransmission:
    from geartrain.teeth.pin_transmission import PinToSlotTransmission, SlotToPinTransmission

    if driver not in ("pin", "slot"):
        raise typer.BadParameter(f"'{driver}' is neither pin nor slot", param_hint="--driver")
    r = _quantity("--pin-radius", pin_radius, "length", plain=True)
    e = _quantity("--offset", offset, "length", plain=True)
    try:
        law = (PinToSlotTransmission if driver == "pin" else SlotToPinTransmission)(r, e, friction)
    except GearTrainError as error:
        raise at_option(error, "--driver" if driver == "slot" and 0 < r < e else "--pin-radius") from None
    if friction >= law.locking_friction:
        what = f"a friction of {friction:g} locks the pin in its slot"
        why = f"the pin locks from {law.locking_friction:.6g} on when the slot drives"
        raise GearTrainError(Problem(what, why, "give less friction, or let the pin drive", "--friction"))
    return law
