"""Pins in slots and pins in holes as a train declares them: couplings whose mean ratio is a winding number.

A pin on one link slides in a slot of another link, whose axis is at the distance `offset`. In the frame of their
carrier, the slot's angle is phi + atan2(e sin phi, r - e cos phi) for pin angle phi, pin radius r and offset e. Over
one turn of the pin the slot turns m times: m = 1 if the pin's circle encloses the slot's axis (r > e), otherwise m = 0.

Three or more pins in round holes, each wider than its pin by 2 e, keep two links parallel: m = 1 at every instant.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from geartrain.errors import Problem, RangeError
from geartrain.numerics.quantity import Length, bad, checked
from geartrain.teeth.contact_coefficients import DeclaredCoulombFriction, DeclaredRestitution
from geartrain.teeth.coupling import Coupling
from geartrain.teeth.tooth_form import check_above_0

if TYPE_CHECKING:
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission, PinTransmission


_CLEARANCE = checked(
    lambda given: given.value >= 0,
    "a clearance of {text} is negative",
    "give 0 or more: a slot is as wide as its pin or wider",
)


class PinCoupling(Coupling):
    """Declared coupling of two links by one or more pins. It is the base class of all couplings with pins."""

    ENDS = ("pin", "slot")
    SIDES = ("slot", "pin")
    PARALLEL = "a pin and its slot or hole must move in the same plane"

    pin: str = Field(description="Link that carries the pin")
    slot: str = Field(description="Link that has the slot")
    pin_radius: Length | None = Field(None, description="Distance of the pin from the axis of its own link")
    offset: Length | None = Field(None, description="Distance between the axes of the two links")
    clearance: Annotated[Length, _CLEARANCE] | None = Field(
        None, description="Width of the slot minus the diameter of the pin; default 0"
    )
    friction: DeclaredCoulombFriction | None = Field(
        None,
        description="Coefficient of friction of the pin in its slot, or `{sliding, static, deviation}`; default none",
    )
    restitution: DeclaredRestitution | None = Field(
        None, description="Coefficient of restitution of impacts of the pin on its slot, 0 to 1; default from the train"
    )


class _PinInSlot(PinCoupling):
    """Pin in a slot. The class attribute `WINDING` is the number of turns of the slot in one turn of the pin."""

    WINDING: ClassVar[int] = 1

    @model_validator(mode="after")
    def _check_winding(self) -> Self:
        radius, offset, slack = self.pin_radius, self.offset, self.clearance
        if radius is None or offset is None:
            return self
        if radius.value <= 0 or offset.value < 0:
            what = f"pin_radius {radius.text} or offset {offset.text} is out of range"
            raise bad("pin", what, "give a pin_radius above 0 and an offset of 0 or more")
        # an offset of 0 needs no unit
        if offset.value and (radius.unit is None) != (offset.unit is None):
            what = f"only one of pin_radius {radius.text} and offset {offset.text} has a unit"
            raise bad("pin", what, "give both with a unit, or both without one")
        # compared as exact fractions, so that equal lengths in different units are recognised
        r, e = radius.base, offset.base
        # the slot would reverse its direction at that moment
        if r == e:
            what = f"pin_radius {radius.text} equals the offset: the pin would pass through the slot's axis"
            fix = "give different lengths: the mean ratio is 1 for a larger pin_radius and 0 for a smaller one"
            raise bad("pin", what, fix)
        if (r > e) != bool(self.WINDING):
            other = "pin_follower" if self.WINDING else "pin_and_slot"
            what = f"a {self.kind} with pin_radius {radius.text} and offset {offset.text} is a {other}"
            raise bad("pin", what, f"give `kind: {other}`, or correct the dimensions")
        # the pin passes the axis of the slot at the minimum distance |r - e|
        if slack is not None and (slack.unit is None) == (radius.unit is None) and slack.base >= 2 * abs(r - e):
            what = f"with a clearance of {slack.text} the pin passes the slot's axis without touching the slot"
            raise bad("pin", what, "give a clearance below twice the difference of pin_radius and offset")
        return self

    @property
    def mean(self) -> Fraction:
        """Mean ratio, which equals the winding number of the pin about the slot's axis."""
        return Fraction(self.WINDING)

    @property
    def transmission(self) -> PinToSlotTransmission | None:
        """Transmission function if the pin drives; None if the dimensions are not declared."""
        if self.pin_radius is None or self.offset is None:
            return None
        from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission

        friction = float(self.friction.sliding.value) if self.friction else 0.0
        return PinToSlotTransmission(self.pin_radius.si, self.offset.si, friction)


class PinAndSlot(_PinInSlot):
    """Pin in a slot whose axis is inside the pin's circle, so that both links have the same mean speed."""

    kind: Literal["pin_and_slot"] = Field(description="Pin whose circle encloses the slot's axis: mean ratio 1")


class PinFollower(_PinInSlot):
    """Pin in a slotted follower whose axis is outside the pin's circle, so that the follower oscillates."""

    WINDING = 0

    kind: Literal["pin_follower"] = Field(description="Pin whose circle does not enclose the slot's axis: mean ratio 0")


class _ParallelCoupling(PinCoupling):
    """Coupling that keeps two links parallel, so that both links have the same speed at every instant."""

    FOR_COPIES = True

    @model_validator(mode="after")
    def _has_no_friction(self) -> _ParallelCoupling:
        if self.friction is not None:
            what = f"friction of a {self.kind} coupling is not modelled"
            raise bad("pin", what, "declare its loss as the `efficiency` of the gear pair of its disc")
        lengths = ("pin_radius", "offset", "pin_diameter")
        check_above_0(self, "pin", *(name for name in lengths if name in type(self).model_fields))
        return self


class PinsInHoles(_ParallelCoupling):
    """Pins in round holes that keep two links parallel, as the output pins of a cycloidal reducer do.

    Both links turn at the same speed at every instant about axes that are `offset` apart. The diameter of a hole
    exceeds the diameter of its pin by twice this distance. `slot` is the link with the holes, and `pin_radius` is the
    radius of the circle through the centres of the pins.
    """

    SIDES = ("holes", "pins")

    kind: Literal["pins_in_holes"] = Field(description="Pins in round holes: ratio 1 at every instant")
    pins: int = Field(6, ge=3, le=1000, description="Number of pins, evenly spaced on their circle")
    pin_diameter: Length | None = Field(
        None, description="Diameter of the pins; the diameter of the holes is larger by twice `offset`"
    )


class Parallel(_ParallelCoupling):
    """Any coupling other than pins in holes that keeps two links parallel, such as parallel cranks, an Oldham coupling
    or a flexible wall.

    The links `pin` and `slot` are interchangeable. The coupling is not drawn.
    """

    SIDES = ("1", "1")

    kind: Literal["parallel"] = Field(
        description="Parallel cranks, an Oldham coupling or a similar mechanism: ratio 1 at every instant"
    )

    @model_validator(mode="after")
    def _has_no_pin(self) -> Parallel:
        if self.pin_radius is not None or self.clearance is not None:
            fix = "remove `pin_radius` and `clearance`, or give `kind: pins_in_holes`"
            raise bad("pin", "a coupling of kind parallel has no pin", fix)
        return self


def pin_transmission(
    pin_radius: float, offset: float, friction: float = 0.0, driver: Literal["pin", "slot"] = "pin"
) -> PinTransmission:
    """Return the transmission function of a pin in a slot that is driven by the pin or by the slot.

    `offset` is the distance between the two axes, in the unit of `pin_radius`. Raises `RangeError` if the coupling
    cannot turn; the location of the error is `driver` or `friction` if this value must be changed.
    """
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission, SlotToPinTransmission

    transmission = (PinToSlotTransmission if driver == "pin" else SlotToPinTransmission)(pin_radius, offset, friction)
    if friction >= transmission.locking_friction:
        what = f"a coefficient of friction of {friction:g} locks the pin in its slot"
        why = f"a pin driven by its slot locks at a coefficient of {transmission.locking_friction:.6g} or more"
        raise RangeError(Problem(what, why, "give a lower coefficient of friction, or let the pin drive", "friction"))
    return transmission
