"""Couplings that move the driven link by steps, with rests between them: Geneva drives, fingers and stars, ratchets,
and mutilated wheels.

A Geneva drive (Maltese cross) has pins at the radius r on its driver and n radial slots on its driven link; the axes
are at the distance C with r/C = sin(pi/n), so that a pin enters and leaves a slot without a jump of the speed. The
driven link moves by 1/n turn while the pin is in the slot, which is the fraction 1/2 - 1/n of the driver's turn
(external) or 1/2 + 1/n (internal); see Bickford, Mechanisms for Intermittent Motion (1972).

All other kinds move the driven link by whole teeth, instantaneously or evenly over an angle of the driver.
"""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from geartrain.numerics.exact import plural
from geartrain.numerics.plain_values import Boolean
from geartrain.numerics.quantity import Angle, Energy, bad, not_below_zero
from geartrain.teeth.coupling import Coupling

if TYPE_CHECKING:
    from geartrain.teeth.couplings.step_transmission import GenevaTransmission, StepTransmission


_MOST_MOVES = 10_000  # entries of a list of moves: a calendar of four years has 1461


def _moves(raw: object) -> object:
    """Return the declared moves `raw` as a sequence. A list is returned unchanged, a single number as a tuple with one
    element.
    """
    return raw if isinstance(raw, list | tuple) else (raw,)


_Moves = Annotated[
    tuple[Annotated[int, Field(ge=0)], ...],
    BeforeValidator(_moves),
    WithJsonSchema({"anyOf": [{"type": "integer"}, {"type": "array", "items": {"type": "integer"}}]}),
]


class SteppingCoupling(Coupling):
    """Coupling that moves its driven link in steps. It is the base class of all such couplings."""

    # a lock or a jumper stops the driven link, and a pin in its slot holds it in both senses
    LOCKS_BACK = HOLDS = True
    UNKNOWN = "friction of pin, finger and lock; impacts where the lock stops the driven link"

    pair: tuple[str, str] = Field(description="Driving link, and the link that moves in steps")
    internal: Boolean = Field(
        False, description="True if both links turn in the same sense; by default they turn in opposite senses"
    )

    @property
    def mean(self) -> Fraction:
        """Exact mean ratio: driven speed divided by driver speed; negative unless both turn in the same sense."""
        return self.turns if self.internal else -self.turns

    @property
    def turns(self) -> Fraction:
        """Revolutions of the driven link in one revolution of the driver, as an absolute value."""
        raise NotImplementedError

    @property
    def remark(self) -> str:
        """Text that gives the fraction of the time during which the driven link moves."""
        dwell = self.transmission.dwell if self.transmission else 0
        return f"moves {1 - dwell} of the time" if dwell else ""


class Geneva(SteppingCoupling):
    """Geneva drive, or Maltese cross: a pin enters a radial slot, turns the driven link by one slot, and leaves."""

    kind: Literal["geneva"] = Field(description="Geneva drive: 1/n turn for every pin that passes, then rest")
    slots: int = Field(ge=3, le=1000, description="Number of slots n of the driven link, 3 or more")
    pins: int = Field(1, ge=1, le=1000, description="Number of pins of the driver, evenly spaced")

    @model_validator(mode="after")
    def _check_pins(self) -> Geneva:
        most = int(1 / (Fraction(1, 2) + Fraction(1 if self.internal else -1, self.slots)))
        if self.pins > most:
            what = f"with {self.pins} pins and {self.slots} slots, two pins would be in slots at the same time"
            raise bad("geneva", what, f"give `pins: {most}` or fewer, or another number of slots")
        return self

    @property
    def turns(self) -> Fraction:
        """Revolutions of the driven link in one revolution of the driver: number of pins divided by number of slots."""
        return Fraction(self.pins, self.slots)

    @property
    def about(self) -> str:
        """Text that gives the numbers of slots and pins."""
        return f"{self.slots} slots, {plural(self.pins, 'pin')}{', internal' if self.internal else ''}"

    @property
    def formula(self) -> str:
        """Closed-form formula for the driven angle q while a pin is in its slot."""
        sign = "+" if self.internal else "-"
        return f"q = atan2(rho sin S, 1 {sign} rho cos S) while moving, rho = sin(pi/{self.slots})"

    @property
    def transmission(self) -> GenevaTransmission:
        """Transmission function, with angles from the middle of a step, where a pin is on the line of centres."""
        from geartrain.teeth.couplings.step_transmission import GenevaTransmission

        return GenevaTransmission(self.slots, self.pins, self.internal)

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one revolution of the driver: the number of pins."""
        return Fraction(self.pins)


class Step(SteppingCoupling):
    """Finger and star, ratchet or mutilated wheel: every engagement moves the driven link by one or more teeth."""

    kind: Literal["step"] = Field(description="Finger and star, ratchet or mutilated wheel: whole teeth, then rest")
    teeth: int = Field(ge=1, le=10**12, description="Number of teeth of the driven link")
    moves: _Moves = Field(
        (1,),
        max_length=_MOST_MOVES,
        description="Teeth moved by each engagement, or a list for successive engagements; default 1",
    )
    times: int = Field(
        1, ge=1, le=10_000, description="Number of engagements in one revolution of the driver, evenly spaced"
    )
    over: Annotated[Angle, not_below_zero("give an angle of 0 or more")] | None = Field(
        None,
        description="Angle of the driver during which an engagement moves the teeth evenly; default 0 (instantaneous)",
    )
    loss: Annotated[Energy, not_below_zero("give an energy of 0 or more")] | None = Field(
        None, description="Energy lost for every tooth that passes the jumper or click spring; default 0"
    )

    @model_validator(mode="after")
    def _check_moves(self) -> Step:
        if not any(self.moves):
            raise bad("step", "the driven link never moves", "give `moves` of 0 or more, and at least one above 0")
        if max(self.moves) > self.teeth:
            what = f"{max(self.moves)} teeth in one engagement are more than the {self.teeth} teeth of the wheel"
            raise bad("step", what, f"give `moves` of at most {self.teeth}")
        if self.moving_angle * self.times > 1:
            most = 360 / self.times
            what = f"with `over: {self.over}` the wheel would still be moving when the next engagement begins"
            raise bad("step", what, f"give `over` of at most {most:g} deg for `times: {self.times}`")
        return self

    @property
    def moving_angle(self) -> Fraction:
        """Angle of the driver [turn] during which an engagement moves the teeth; 0 for instantaneous steps."""
        return Fraction(0) if self.over is None else self.over.base

    @property
    def turns(self) -> Fraction:
        """Revolutions of the driven link per revolution of the driver: teeth moved divided by number of teeth."""
        return Fraction(self.times * sum(self.moves), len(self.moves) * self.teeth)

    @property
    def remark(self) -> str:
        """Text with the number of instantaneous steps, or the fraction of the time in which the driven link moves."""
        if self.moving_angle:
            return super().remark
        steps = Fraction(self.times * sum(1 for each in self.moves if each), len(self.moves))
        return f"moves at once, {'once' if steps == 1 else f'{steps} times'} a turn of the driver"

    @property
    def about(self) -> str:
        """Text that gives the numbers of teeth and of engagements."""
        low, high = min(self.moves), max(self.moves)
        moved = f"{low}" if low == high else f"{low} to {high}"
        over = f" over {self.over}" if self.over else ""
        return f"{self.teeth} teeth, {self.times} a turn move {moved}{over}"

    @property
    def friction_torque(self) -> Fraction:
        """Mean torque [N m] on the driven link against its motion that corresponds to the energy lost in the jumper."""
        # a wheel of z teeth loses z times the energy of one tooth in a revolution
        return Fraction(0) if self.loss is None else self.teeth * self.loss.base / (2 * Fraction(pi))

    @property
    def transmission(self) -> StepTransmission:
        """Transmission function. Angles are measured from the beginning of the first engagement."""
        from geartrain.teeth.couplings.step_transmission import StepTransmission

        return StepTransmission(self.teeth, self.moves, self.times, self.moving_angle)

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one revolution of the driver: number of engagements in one
        revolution divided by the length of the list of moves.
        """
        return Fraction(self.times, len(self.moves))
