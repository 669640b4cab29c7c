"""What drives a train in time: a speed, a torque, a weight, a spring, a hand; and the escapement that lets it go."""

from __future__ import annotations

from fractions import Fraction
from math import pi, tau
from typing import Annotated

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import (
    Figure,
    Inertia,
    Mass,
    MeasuredLength,
    Quantity,
    Speed,
    Time,
    Torque,
    TorsionalStiffness,
)
from geartrain.numerics.quantity_bounds import above_zero, not_below_zero
from geartrain.train.fields import Count, Declared, Id

GRAVITY = 9.80665
"""Standard gravity, m/s^2."""

_NEAR = 0.05  # of the length of a pendulum with all of its mass in its bob

DriveTorque = Annotated[Torque, not_below_zero("it acts the way the input turns: give its magnitude")]


class SpringDrive(Declared):
    """A spring on the driven link: its torque is `stiffness` times the angle by which it is wound, and runs down.

    See Also
    --------
    Drive : holds it as `spring`
    """

    stiffness: Annotated[TorsionalStiffness, above_zero("give for example 0.02 N m/rad")] = Field(
        description="Torque for each radian by which it is wound"
    )
    turns: Annotated[Figure, not_below_zero("give the turns by which it is wound at the start")] = Field(
        description="Turns by which it is wound at the start"
    )

    def torque(self, unwound: float) -> float:
        """Torque [N m] after the link has turned some way as it is driven.

        Parameters
        ----------
        unwound : float
            How far it has turned [rad].
        """
        return self.stiffness.si * (tau * float(self.turns.value) - unwound)


class HandDrive(Declared):
    """A hand at the crank: a torque, or a speed that it keeps with some stiffness, and the inertia that moves along.

    See Also
    --------
    Drive : holds it as `hand`
    """

    torque: DriveTorque | None = Field(None, description="Torque that it gives")
    rate: Speed | None = Field(None, description="Speed that it means to keep")
    stiffness: Annotated[TorsionalStiffness, above_zero("give for example 5 N m/rad")] | None = Field(
        None, description="Torque for each radian by which the crank is behind the hand; default rigid"
    )
    inertia: Annotated[Inertia, not_below_zero("an inertia is 0 or more")] | None = Field(
        None, description="Moment of inertia of arm and crank; default 0"
    )

    @model_validator(mode="after")
    def _is_one_thing(self) -> HandDrive:
        if (self.torque is None) == (self.rate is None):
            raise PydanticCustomError(
                "drive", "a hand gives a torque or keeps a rate", {"fix": "give exactly one of torque, rate"}
            )
        if self.torque is not None and self.stiffness is not None:
            raise PydanticCustomError(
                "drive",
                "a hand that gives a torque needs no stiffness",
                {"fix": "`stiffness` says how a hand that keeps a `rate` yields: leave it out, or give `rate`"},
            )
        return self


class Drive(Declared):
    """What drives the train in time: exactly one of rate, torque, weight, spring, hand.

    All act where power enters, at `crank`, else at the input, the way it turns. A rate is that of the input in the
    mean, as the train's own `rate`: a crank is kept at its own share of it.

    See Also
    --------
    Train : holds it as `drive`
    State : holds one of its own
    StateCase : what is in force in one state

    Examples
    --------
    >>> drive = Drive(weight="4 kg", drum="20 mm")
    >>> drive.kind, drive.weight.si * drive.drum.si
    ('weight', 0.08)
    """

    rate: Speed | None = Field(None, description="Speed of the input in real time, held whatever the load")
    torque: DriveTorque | None = Field(None, description="A constant torque")
    weight: Annotated[Mass, above_zero("give a mass such as 4 kg")] | None = Field(
        None, description="Mass of a weight that pulls a line on a drum"
    )
    drum: Annotated[MeasuredLength, above_zero("give a length such as 20 mm")] | None = Field(
        None,
        description="Radius at which that line pulls, that of the drum plus half the thickness of the line. The line "
        "carries the whole weight: if the weight hangs in a pulley, give half of its mass",
    )
    spring: SpringDrive | None = Field(None, description="A spring")
    hand: HandDrive | None = Field(None, description="A hand")

    @model_validator(mode="after")
    def _is_one_thing(self) -> Drive:
        kinds = ("rate", "torque", "weight", "spring", "hand")
        given = [key for key in kinds if getattr(self, key) is not None]
        if len(given) != 1:
            raise PydanticCustomError(
                "drive",
                "a drive is one thing, and this gives {given}",
                {"given": " and ".join(given) or "nothing", "fix": f"give exactly one of {', '.join(kinds)}"},
            )
        if (self.weight is None) != (self.drum is None):
            raise PydanticCustomError(
                "drive",
                "a weight pulls a line on a drum",
                {"fix": "give `weight`, a mass, and `drum`, the radius at which its line pulls"},
            )
        return self

    @property
    def torques(self) -> tuple[Quantity, ...]:
        """The torques it declares as such."""
        hand = None if self.hand is None else self.hand.torque
        return tuple(torque for torque in (self.torque, hand) if torque is not None)

    @property
    def pull(self) -> float | None:
        """Torque of a weight at its drum, mass times gravity times radius [N m]; None of another drive."""
        if self.weight is None or self.drum is None:
            return None
        return self.weight.si * GRAVITY * self.drum.si

    @property
    def steady_torque(self) -> float | None:
        """The torque of what drives with the same torque all the time, a weight or a torque [N m]; None of others."""
        return next((torque.si for torque in self.torques), self.pull)

    @property
    def kind(self) -> str:
        """rate, torque, weight, spring or hand."""
        return next(key for key in ("rate", "torque", "weight", "spring", "hand") if getattr(self, key) is not None)


class Escapement(Declared):
    """It lets one link pass by half a tooth a beat, and no more: a limit from one side.

    The angle is relative to the link that bears the escape wheel, on which its pallets ride.

    See Also
    --------
    Train : holds it as `escapement`

    Examples
    --------
    >>> Escapement(link="escape", teeth=30, beat="1 s").speed
    Fraction(1, 60)
    >>> Escapement(link="escape", teeth=30, beat="1 s", pendulum="994 mm").pendulum.si
    0.994
    """

    link: Id = Field(description="The link of the escape wheel")
    teeth: Count = Field(description="Teeth of the escape wheel")
    beat: Annotated[Time, above_zero("give a time such as 1 s")] = Field(
        description="Time from one beat to the next, of which each lets half a tooth pass"
    )
    pendulum: Annotated[MeasuredLength, above_zero("give a length such as 994 mm")] | None = Field(
        None, description="Length of its pendulum, from where it hangs to the middle of its bob"
    )

    @model_validator(mode="after")
    def _beats(self) -> Escapement:
        """A pendulum swings from side to side in pi sqrt(l/g); a rod with some mass makes it a little quicker."""
        if self.pendulum is not None:
            length = GRAVITY * (self.beat.si / pi) ** 2
            if abs(self.pendulum.si / length - 1) > _NEAR:
                raise PydanticCustomError(
                    "escapement",
                    "a pendulum of that length does not beat so",
                    {"fix": f"by pi sqrt(l/g) it is {1000 * length:.4g} mm long: give that, or another `beat`"},
                )
        return self

    @property
    def speed(self) -> Fraction:
        """Mean speed of its link relative to the one that bears it [turn/s]: half a tooth a beat."""
        return 1 / (2 * self.teeth * self.beat.base)

    def has_wheel(self, link: str, count: int | None) -> bool:
        """Whether a wheel of a link is the escape wheel, which meshes nothing.

        Parameters
        ----------
        link : str
            Its link.
        count : int or None
            Its teeth, where known.
        """
        return (link, count) == (self.link, self.teeth)
