"""How the train is run and changed: clutches, states, drives; and everything prescribed in one state.

Drives run a train in time: a hand, a spring, a falling weight, an escapement.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import pi, tau
from typing import Annotated

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.errors import Loc, Problem
from geartrain.numerics.exact import abridged_text, decimal
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
    above_zero,
    not_below_zero,
)
from geartrain.numerics.results import Shown
from geartrain.train.fields import ByName, Count, Declared, ExpectedVerdict, Id, Nothing
from geartrain.train.outputs import Output

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


class Clutch(Declared):
    """A brake or a clutch: one of `fixes` and `locks`.

    See Also
    --------
    Train : holds them as `clutches`, by name
    State : engages them
    """

    fixes: Id | None = Field(None, description="The link it holds to the frame")
    locks: tuple[Id, Id] | None = Field(None, description="The two links it makes one body")

    @model_validator(mode="after")
    def _is_one_thing(self) -> Clutch:
        if (self.fixes is None) == (self.locks is None):
            raise PydanticCustomError(
                "clutch", "a clutch fixes one link or locks two", {"fix": "give exactly one of fixes, locks"}
            )
        return self


class State(Declared):
    """One way the train is run. What is given here replaces the train's; outputs merge by name.

    See Also
    --------
    Train : holds them as `states`, by name
    StateCase : what comes of one
    """

    engaged: tuple[Id, ...] = Field((), description="Clutches and brakes that are closed")
    fixed: tuple[Id, ...] | None = Field(None, description="Links held to the frame, one body with it")
    locks: tuple[tuple[Id, Id], ...] | None = Field(None, description="Pairs of links that are one body")
    inputs: ByName[Speed] | None = Field(None, description="Prescribed speeds by link")
    loads: ByName[Torque] | None = Field(None, description="Torques on links; power into the train is positive")
    solve_for: Id | None = Field(None, description="The link whose torque is unknown")
    drive: Drive | None = Field(None, description="What drives the train in time")
    outputs: ByName[Annotated[Output, Nothing]] = Field(
        {}, validate_default=True, description="Outputs of this state, merged with the train's by name"
    )
    expect: ExpectedVerdict | None = Field(
        None, description="The verdict that holds and is no failure: neutral is free"
    )
    note: str | None = Field(None, description="A remark for the reader")


class Erratum(Declared):
    """Something a source prints that is not so."""

    place: Id = Field(description="Where it is printed")
    printed: Id = Field(description="What is printed")
    right: Id = Field(description="What is right")
    why: str = Field(description="How one knows")


class Remove(Declared):
    """What a child takes away from its parent before it adds its own."""

    links: tuple[Id, ...] = Field((), description="Links, with their wheels, joints, pairs and couplings")
    wheels: tuple[Id, ...] = Field((), description="Wheels, with their pairs")
    gears: tuple[Id, ...] = Field((), description="Gear pairs by id")
    couplings: tuple[Id, ...] = Field((), description="Couplings by id")
    revolutes: tuple[tuple[Id, Id], ...] = Field((), description="Turning pairs by their two links")
    outputs: tuple[Id, ...] = Field((), description="Outputs by name")
    dials: tuple[Id, ...] = Field((), description="Dials by name")
    states: tuple[Id, ...] = Field((), description="States by name")
    axes: tuple[Id, ...] = Field((), description="Axes by label")


# ----------------------------------------------------------------------------------------------------------- state case


@dataclass(frozen=True, slots=True)
class StateCase(Shown):
    """What is prescribed when the train is run in one state.

    Examples
    --------
    >>> import geartrain
    >>> case = geartrain.load("planetary").declaration.case("sun fixed")
    >>> case.fixed, case.given("ring")
    (('sun',), 'ring = 1')
    """

    state: str | None
    """The state; None for a train without states."""
    inputs: Mapping[str, Fraction]
    """Prescribed speed by link [`Train.unit_name`]."""
    fixed: tuple[str, ...]
    """Links held to the frame."""
    locks: tuple[tuple[str, str], ...]
    """Pairs of links that turn together."""
    outputs: Mapping[str, Output]
    """What is asked for in this state, by name."""
    loc: Loc
    """Where the inputs were declared: the keys that lead to them."""
    engaged: tuple[str, ...]
    """Clutches and brakes that are closed."""
    clutches: Mapping[tuple[str, ...], str]
    """The clutch or brake behind a fixed link or a lock."""
    loads: Mapping[str, Quantity] = field(default_factory=dict)
    """Torques on links; power into the train is positive."""
    solve_for: str | None = None
    """The link whose torque is named as unknown."""
    exact: bool = True
    """False where radians had to be counted in turns, or turns in radians: to 50 digits then."""
    drive: Drive | None = None
    """What drives the train in time: the state's, the train's, or its `rate`."""
    rate: Quantity | None = None
    """Speed of the input in real time, where `drive` or the train's `rate` says it."""
    expect: ExpectedVerdict = "determined"
    """The verdict that is no failure."""
    causes: Mapping[tuple[str, ...], tuple[str, ...]] = field(default_factory=dict)
    """A link that is fixed, or two that are locked, only because something else is -> the links of that."""
    problems: tuple[Problem, ...] = ()
    """Why no speed can be calculated in this state; mostly none."""

    def given(self, link: str) -> str:
        """A prescribed speed in words: `sun = 1400`.

        Parameters
        ----------
        link : str
            One of the inputs.
        """
        return f"{link} = {self.shown(self.inputs[link])}"

    def shown(self, speed: Fraction) -> str:
        """A speed for a reader: as a fraction, or in decimal where it is not exact.

        Parameters
        ----------
        speed : Fraction
            Any speed of the case.
        """
        return abridged_text(speed) if self.exact else decimal(speed)

    def says(self, *links: str) -> str:
        """A brake on one link or a lock of two, in words, and what it follows from where it is not declared itself.

        Parameters
        ----------
        *links : str
            One link that is held, or two that are locked together.
        """
        declared = self.declares(*links)
        if self.causes.get(links, links) == links:
            return declared
        held = f"'{links[0]}' still" if len(links) == 1 else f"'{links[0]}' and '{links[1]}' together"
        return f"{declared}, which holds {held}"

    def declares(self, *links: str) -> str:
        """What is declared behind a brake or a lock, in words, with the clutch that does it.

        Parameters
        ----------
        *links : str
            One link that is held, or two that are locked together.
        """
        links = self.causes.get(links, links)
        by = f" by {self.clutches[links]}" if links in self.clutches else ""
        return (
            f"'{links[0]}' is fixed{by}"
            if len(links) == 1
            else f"'{links[0]}' and '{links[1]}' are locked together{by}"
        )
