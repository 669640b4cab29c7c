"""Operation of a train: clutches, states, drives, and the prescriptions of each state.

A drive moves the train in time-domain simulations: a hand, a spring, a falling weight, or a prescribed rate or torque.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import inf, pi, tau
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, NamedTuple

from pydantic import BeforeValidator, Field, model_validator

from geartrain.errors import Loc, Problem
from geartrain.numerics.exact import abridged_text, decimal
from geartrain.numerics.quantity import (
    TRAVEL_ARM,
    Angle,
    Figure,
    Inertia,
    InputSpeed,
    Load,
    Mass,
    MeasuredLength,
    Quantity,
    Rate,
    Share,
    Speed,
    Time,
    Torque,
    TorsionalStiffness,
    above_zero,
    bad,
    check_range,
    checked,
    not_below_zero,
)
from geartrain.numerics.results import Result, Shown
from geartrain.train.fields import (
    ByName,
    Count,
    Declared,
    ExpectedVerdict,
    Id,
    Nothing,
    exactly_one,
    read_count,
    short_for,
)
from geartrain.train.outputs import Output

if TYPE_CHECKING:
    from geartrain.train.fusees import FuseeSpring

GRAVITY = 9.80665
"""Standard gravity [m/s^2]."""

_MOST_FALLS = 100
_EFFICIENCY = "an efficiency must be above 0 and at most 1, not {text}", "give a number or a percentage such as 40 %"
Impulse = Annotated[Angle, not_below_zero("give an angle such as 0.5 deg")]
_NEAR = 0.05  # relative tolerance of the length of a simple pendulum, for rods with mass

DriveTorque = Annotated[Torque, not_below_zero("give its magnitude: it acts in the direction in which the input turns")]


class Fusee(Declared):
    """Fusee on the driving link, declared by its constant torque or by its radii."""

    turns: Annotated[Figure, above_zero("give the turns of the fusee in its run, such as 6")] = Field(
        description="Turns of the fusee from fully wound to run down"
    )
    torque: Annotated[Torque, above_zero("give a torque such as 0.27 N m")] | None = Field(
        None, description="Constant torque of a fusee whose radii equalise the spring"
    )
    radii: tuple[Annotated[MeasuredLength, above_zero("give a length such as 6 mm")], ...] | None = Field(
        None,
        description="Radii of the chain's middle line at equal angles over the run, fully wound first, 2 or more; "
        "straight lines in between",
    )

    @model_validator(mode="after")
    def _has_one_form(self) -> Fusee:
        exactly_one(self, "a fusee", ("torque", "radii"))
        if self.radii is not None and len(self.radii) < 2:
            raise bad("fusee", "a fusee with one radius is a drum", "give 2 radii or more, such as [6 mm, 14 mm]")
        if self.torque is not None and self.torque.unit is None:
            raise bad("fusee", "the torque of a fusee has no unit", f"write {self.torque.text} N m")
        return self


class SpringDrive(Declared):
    """Spring on the driving link, whose torque is `stiffness` times the remaining wound angle."""

    stiffness: Annotated[TorsionalStiffness, above_zero("give a stiffness such as 0.02 N m/rad")] = Field(
        description="Torsional stiffness: torque per radian of winding"
    )
    turns: Annotated[Figure, not_below_zero("give the turns of winding at the start, 0 or more")] = Field(
        description="Turns of winding at the start"
    )
    barrel: Annotated[MeasuredLength, above_zero("give a length such as 15 mm")] | None = Field(
        None, description="Radius of the barrel to the middle line of the chain; requires `fusee`"
    )
    fusee: Fusee | None = Field(None, description="Fusee on the driving link, turned by a chain from the barrel")

    @model_validator(mode="after")
    def _check_fusee(self) -> SpringDrive:
        if (self.barrel is None) != (self.fusee is None):
            fix = "give `barrel: 15 mm` and `fusee: {turns: 6, torque: 0.27 N m}`, or neither"
            why = "a fusee is pulled by a chain that is wound on the barrel"
            raise bad("drive", "`barrel` and `fusee` must be given together", fix, why)
        if (chained := self.chained) is not None and (end := chained.end) < inf:
            what = f"the spring has run down after {end:.6g} of the {chained.turns:g} turns of the fusee"
            fix = "give more `turns` of winding, fewer turns of the fusee, or smaller radii"
            raise bad("drive", what, fix, "the spring must pull the chain until the fusee has no more chain")
        return self

    @property
    def chained(self) -> FuseeSpring | None:
        """Spring together with its fusee; None if no fusee is declared."""
        if self.barrel is None or self.fusee is None:
            return None
        from geartrain.train.fusees import FuseeSpring

        fusee = self.fusee
        return FuseeSpring(
            self.stiffness.si,
            tau * float(self.turns.value),
            self.barrel.si,
            float(fusee.turns.value),
            None if fusee.torque is None else fusee.torque.si,
            tuple(radius.si for radius in fusee.radii or ()),
        )

    def torque(self, unwound: float) -> float:
        """Return the torque on the driving link [N m] after this link has turned by `unwound` [rad] since the start."""
        if (chained := self.chained) is not None:
            return chained.torque(unwound)
        return self.stiffness.si * (tau * float(self.turns.value) - unwound)


class HandDrive(Declared):
    """Hand at the crank: a torque, or a speed that acts through a torsional stiffness, and the inertia of arm and
    crank.

    In Monte Carlo trials of feasibility, the torque is the maximum that the operator can exert.
    """

    torque: DriveTorque | None = Field(None, description="Constant torque of the hand")
    range: tuple[DriveTorque, DriveTorque] | None = Field(
        None, description="Minimum and maximum of the uniform distribution of `torque` in Monte Carlo runs"
    )
    handle: Annotated[MeasuredLength, above_zero("give a length such as 30 mm")] | None = Field(
        None, description="Radius of the crank's handle, at which the force of the hand is reported"
    )
    rate: Speed | None = Field(None, description="Speed that the hand maintains")
    stiffness: Annotated[TorsionalStiffness, above_zero("give a stiffness such as 5 N m/rad")] | None = Field(
        None, description="Torque per radian by which the crank lags behind the hand; default rigid"
    )
    inertia: Annotated[Inertia, not_below_zero("give an inertia of 0 or more")] | None = Field(
        None, description="Moment of inertia of arm and crank; default 0"
    )

    @model_validator(mode="after")
    def _has_one_key(self) -> HandDrive:
        exactly_one(self, "a hand", ("torque", "rate"))
        if self.torque is not None and self.stiffness is not None:
            fix = "omit `stiffness`, or give `rate` instead of `torque`"
            why = "a stiffness connects the crank to a hand of given speed"
            raise bad("drive", "`stiffness` applies only to a hand with a `rate`", fix, why)
        check_range("drive", self.torque, self.range)
        return self


_KINDS = ("rate", "torque", "weight", "spring", "hand")


class Drive(Declared):
    """Drive of the train in time-domain simulations, declared by exactly one of rate, torque, weight, spring and hand.

    A drive acts on `crank`, by default the input, in the direction in which this link turns. A rate is the mean speed
    of the input, like the train's `rate`; if `crank` is another link, its speed follows from the mean ratio.

    See Also
    --------
    Train : its field `drive`
    State : may have its own drive
    StateCase : drive in one state

    Examples
    --------
    >>> drive = Drive(weight="4 kg", drum="20 mm")
    >>> drive.kind, drive.weight.si * drive.drum.si
    ('weight', 0.08)
    """

    rate: Rate | None = Field(None, description="Constant speed of the input in real time, for any load")
    torque: DriveTorque | None = Field(None, description="Constant torque")
    weight: Annotated[Mass, above_zero("give a mass such as 4 kg")] | None = Field(
        None,
        description="Mass of a weight on a line around a drum; requires `drum`, unless the `crank` is the link of the "
        "weight, which slides",
    )
    drum: Annotated[MeasuredLength, above_zero("give a length such as 20 mm")] | None = Field(
        None,
        description="Lever arm of the line: radius of the drum plus half the thickness of the line",
    )
    falls: Annotated[int, Field(le=_MOST_FALLS), BeforeValidator(read_count)] = Field(
        1, description="Number of lines that carry the weight; 2 for a weight in a pulley"
    )
    drop: Annotated[MeasuredLength, above_zero("give a length such as 1.28 m")] | None = Field(
        None, description="Height through which the weight descends between two windings; it determines the going time"
    )
    spring: SpringDrive | None = Field(None, description="Drive by a spring")
    hand: HandDrive | None = Field(None, description="Drive by a hand")

    @model_validator(mode="after")
    def _has_one_key(self) -> Drive:
        exactly_one(self, "a drive", _KINDS, "kind")
        given = [key for key in ("drum", "drop") if getattr(self, key) is not None and self.weight is None]
        given += ["falls"] if self.falls > 1 and self.drum is None else []
        if given:
            needed = "drum" if self.weight is not None else "weight"
            fix = "give `weight`, a mass, and `drum`, its lever arm, such as `weight: 4 kg, drum: 20 mm`"
            why = "the weight hangs from a cord that is wound on the drum"
            raise bad("drive", f"`{given[0]}` is given without `{needed}`", fix, why)
        return self

    @property
    def torques(self) -> tuple[Quantity, ...]:
        """Torques that are declared for the drive as numbers or with a unit; empty if the drive prescribes a speed, or
        is a weight or a spring.
        """
        hand = () if self.hand is None else (self.hand.torque, *(self.hand.range or ()))
        return tuple(torque for torque in (self.torque, *hand) if torque is not None)

    @property
    def arm(self) -> float | None:
        """Descent of the weight per radian of its drum [m]; None for other drives, and for a weight without a drum."""
        return None if self.drum is None else self.drum.si / self.falls

    @property
    def steady_torque(self) -> float | None:
        """Constant torque of a drive [N m]: the declared torque, the torque of an equalising fusee, or the torque of a
        weight (mass times gravitational acceleration times descent per radian); None for other drives.

        For a weight that is a link of the train, it is the torque equivalent to its force; see `as_torque`.
        """
        fusee = None if self.spring is None else self.spring.fusee
        declared = [*self.torques, *([fusee.torque] if fusee is not None and fusee.torque is not None else [])]
        if declared or self.weight is None:
            return declared[0].si if declared else None
        return self.weight.si * GRAVITY * (float(TRAVEL_ARM) if self.arm is None else self.arm)

    @property
    def kind(self) -> str:
        """Kind of the drive: rate, torque, weight, spring or hand."""
        return next(key for key in _KINDS if getattr(self, key) is not None)


EXPANSIONS = {"steel": 11.5e-6, "brass": 19e-6, "pine": 4e-6, "invar": 1e-6}
"""Coefficients of linear expansion of pendulum rods by material [1/K], rounded; for pine, along the grain."""


class Pendulum(Declared):
    """Pendulum of an escapement. In a declaration, a length instead of a mapping sets `length`."""

    SHORT: ClassVar = {"type": "string", "format": "length"}

    length: Annotated[MeasuredLength, above_zero("give a length such as 994 mm")] = Field(
        description="Length from the suspension to the middle of the bob"
    )
    bob: Annotated[Mass, above_zero("give a mass such as 4.5 kg")] | None = Field(None, description="Mass of the bob")
    quality: Annotated[Figure, above_zero("give a number such as 5000")] | None = Field(
        None,
        description="Quality factor: stored energy divided by the energy lost per radian of oscillation",
    )
    rod: Literal["steel", "brass", "pine", "invar"] | None = Field(
        None, description="Material of the rod, whose thermal expansion changes the rate"
    )


class Escapement(Declared):
    """Escapement that lets one link advance by at most half a tooth per beat (a unilateral constraint).

    Angles are relative to the link on which the pallets are mounted, by default the link that carries the escape wheel.
    """

    link: Id = Field(description="Link of the escape wheel")
    teeth: Count = Field(description="Tooth count of the escape wheel")
    on: Id | None = Field(
        None, description="Link with the pallets; default the link that carries the axis of the escape wheel"
    )
    beat: Annotated[Time, above_zero("give a time such as 1 s")] = Field(
        description="Time between beats, each of which lets half a tooth pass"
    )
    pendulum: Annotated[Pendulum, short_for("length")] | None = Field(
        None,
        description="Pendulum of the escapement, or only its length from the suspension to the middle of the bob; "
        "default none",
    )
    efficiency: Annotated[Share, checked(lambda part: 0 < part.base <= 1, *_EFFICIENCY)] | None = Field(
        None, description="Fraction of the energy of the escape wheel that reaches the pendulum; above 0, at most 1"
    )
    deadbeat: tuple[Impulse, Impulse] | None = Field(
        None,
        description="Deadbeat escapement: angles of the pendulum before and after the middle between which it "
        "receives a constant torque",
    )
    recoil: Impulse | None = Field(
        None,
        description="Recoil escapement: angle of the pendulum after the middle at which its constant torque "
        "changes its sense",
    )
    arc: Annotated[Angle, above_zero("give an angle such as 1.5 deg")] | None = Field(
        None, description="Minimum amplitude of the pendulum at which the escape wheel is released"
    )

    @model_validator(mode="after")
    def _check_pendulum(self) -> Escapement:
        """Check that the pendulum's length l agrees with the beat pi sqrt(l/g); a rod with mass shortens the beat."""
        if self.deadbeat is not None and self.recoil is not None:
            exactly_one(self, "an escapement", ("deadbeat", "recoil"), "kind")
        if self.pendulum is not None:
            # simple pendulum whose half period is one beat
            length = GRAVITY * (self.beat.si / pi) ** 2
            if abs(self.pendulum.length.si / length - 1) > _NEAR:
                fix = f"give {1000 * length:.4g} mm as its length, or another `beat`"
                why = "the beat of a pendulum of length l is pi sqrt(l/g)"
                raise bad("escapement", "the length of the pendulum does not match the beat", fix, why)
        return self

    @property
    def speed(self) -> Fraction:
        """Mean speed of the escape wheel relative to the link that carries it [turn/s]: half a tooth per beat."""
        return 1 / (2 * self.teeth * self.beat.base)

    def has_wheel(self, link: str, count: int | None) -> bool:
        """Return True if a wheel on `link` with `count` teeth is the escape wheel; False if `count` is None."""
        return (link, count) == (self.link, self.teeth)


def _read_sense(raw: object) -> object:
    if raw in ("forward", "backward", None):
        return raw
    fix = "write `one_way: forward` or `one_way: backward`: the sense in which it may turn"
    raise bad("one_way", "`one_way` needs a sense of rotation", fix, f"{raw!r} is not a sense of rotation")


class Clutch(Declared):
    """Brake (`fixes`) or clutch (`locks`); exactly one of the two keys is required.

    A clutch with `one_way` is an overrunning clutch, freewheel or ratchet, which is active in every state: depending on
    speeds and torques, it holds, or it overruns in the sense `one_way`.
    """

    fixes: Id | None = Field(None, description="Link that the brake fixes to the frame")
    locks: tuple[Id, Id] | None = Field(None, description="Two links that the clutch locks together")
    one_way: Annotated[Literal["forward", "backward"] | None, BeforeValidator(_read_sense)] = Field(
        None,
        description="Sense in which a one-way clutch overruns: the fixed link may turn only forward or backward; the "
        "second of two locked links may turn only forward or backward relative to the first",
    )
    teeth: Count | None = Field(None, description="Tooth count of a ratchet, which engages within one tooth")

    @model_validator(mode="after")
    def _has_one_key(self) -> Clutch:
        if self.teeth is not None and self.one_way is None:
            fix, why = "add `one_way: forward`, or omit `teeth`", "they are the teeth of a ratchet"
            raise bad("teeth", "`teeth` applies only to a one-way clutch", fix, why)
        return exactly_one(self, "a clutch", ("fixes", "locks"))

    @property
    def links(self) -> tuple[str, ...]:
        """Name of the fixed link, or names of the two links that are locked together."""
        return self.locks or (self.fixes or "",)

    @property
    def senses(self) -> frozenset[int]:
        """Signs of the torques that the clutch can exert on the last link in `links`: {1}, {-1} or {1, -1}."""
        return frozenset((1, -1)) if self.one_way is None else frozenset((1 if self.one_way == "forward" else -1,))


class State(Declared):
    """Operating state of the train. Its values replace those of the train; its outputs are merged by name.

    See Also
    --------
    Train : its field `states`, by name
    StateCase : prescriptions in one state
    """

    engaged: tuple[Id, ...] = Field(
        (),
        description="Clutches and brakes that are engaged, by name; a one-way clutch named here is required to hold",
    )
    free: tuple[Id, ...] = Field((), description="One-way clutches that are disabled, by name")
    fixed: tuple[Id, ...] | None = Field(None, description="Links fixed to the frame; default from the train")
    locks: tuple[tuple[Id, Id], ...] | None = Field(
        None, description="Pairs of links that are locked together; default from the train"
    )
    inputs: ByName[InputSpeed] | None = Field(None, description="Prescribed speeds by link; default from the train")
    loads: ByName[Load] | None = Field(
        None,
        description="External torques, and forces on sliding links, by link, positive if power enters the train in the "
        "positive sense; default from the train",
    )
    solve_for: Id | None = Field(None, description="Link whose external torque is the unknown; default from the train")
    drive: Drive | None = Field(None, description="Drive of the train for simulations in time; default from the train")
    outputs: ByName[Annotated[Output, Nothing]] = Field(
        {}, validate_default=True, description="Outputs of this state, merged with the train's by name"
    )
    expect: ExpectedVerdict | None = Field(
        None,
        description="Expected verdict, which does not count as a failure (`free` for neutral); default from the train",
    )
    note: str | None = Field(None, description="Remark for readers")


class Erratum(Declared):
    """Error in a published source, with the correct value and the evidence for it."""

    place: Id = Field(description="Page or table of the source")
    printed: Id = Field(description="Printed value or statement")
    right: Id = Field(description="Correct value or statement")
    why: str = Field(description="Evidence for the correction")


class Remove(Declared):
    """Parts of the parent declaration that a child declaration removes before it adds its own parts."""

    links: tuple[Id, ...] = Field((), description="Links to remove with their wheels, joints, pairs and couplings")
    wheels: tuple[Id, ...] = Field((), description="Wheels to remove with their pairs")
    gears: tuple[Id, ...] = Field((), description="Ids of gear pairs")
    couplings: tuple[Id, ...] = Field((), description="Ids of couplings")
    revolutes: tuple[tuple[Id, Id], ...] = Field((), description="Turning pairs, each as its two links")
    slides: tuple[tuple[Id, Id], ...] = Field((), description="Sliding pairs, each as its two links")
    outputs: tuple[Id, ...] = Field((), description="Names of outputs")
    dials: tuple[Id, ...] = Field((), description="Names of dials")
    states: tuple[Id, ...] = Field((), description="Names of states")
    axes: tuple[Id, ...] = Field((), description="Labels of axes")


# ----------------------------------------------------------------------------------------------------------- state case


@dataclass(frozen=True)
class OneWayAction(Result):
    """Behaviour of a one-way clutch in one state (holding or overrunning), with its torque and its slip."""

    name: str
    """Name of the clutch."""
    holds: bool
    """True if the clutch holds, False if it overruns."""
    slip: Fraction | None
    """Speed of the second link relative to the first, in the sense in which the clutch overruns [the train's unit of
    speed]; 0 if the clutch holds, None if undetermined.
    """
    torque: Fraction | None
    """Torque of the clutch on its second link, or on the link that it fixes; 0 if the clutch overruns, None if
    undetermined. It has the unit `torque_unit` if loads are declared; otherwise it is divided by the torque of the
    input.
    """
    torque_unit: str = ""
    """Unit of `torque`, such as `N m`; empty for a number without a unit."""
    required: bool = False
    """True if the state names the clutch under `engaged`, so that it must hold."""
    teeth: int | None = None
    """Tooth count of a ratchet; None for other clutches."""

    @property
    def fails(self) -> bool:
        """True if the clutch is required to hold but overruns."""
        return self.required and not self.holds

    def text(self, unit: str = "") -> str:
        """Return the behaviour as text, with speeds in `unit`: `F holds (1.48 N m)` or `F overruns at 0.473`."""
        if self.holds:
            amount = "" if self.torque is None else f" ({f'{decimal(self.torque, 6)} {self.torque_unit}'.strip()})"
            amount = " without torque" if self.torque == 0 else amount
            text = f"holds{amount}"
        else:
            text = "overruns" + ("" if self.slip is None else f" at {f'{decimal(self.slip, 6)} {unit}'.strip()}")
        text += f"; takes hold within 1/{self.teeth} turn" if self.teeth else ""
        return f"{self.name} {text}" + ("; FAILS: it is required to hold" if self.fails else "")

    def _summary(self) -> str:
        return self.text()


class SteppedLink(NamedTuple):
    """Link that one-way clutches drive in steps: oscillating links push it, and friction holds it between the steps."""

    link: str
    """Name of the link."""
    sense: int
    """Sense in which the link turns about its axis, 1 or -1."""
    drivers: Mapping[str, int]
    """Links that drive it through the clutches, each with the sense about its axis in which it drives, 1 or -1."""


@dataclass(frozen=True, slots=True)
class StateCase(Shown):
    """Prescribed speeds, loads and locks of a train in one state, including values inherited from the train.

    Examples
    --------
    >>> import geartrain
    >>> case = geartrain.load("planetary").declaration.case("sun fixed")
    >>> case.fixed, case.given("ring")
    (('sun',), 'ring = 1')
    """

    state: str | None
    """Name of the state; None for a train without states."""
    inputs: Mapping[str, Fraction]
    """Prescribed speed of each input link [`Train.unit_name`]."""
    fixed: tuple[str, ...]
    """Links fixed to the frame."""
    locks: tuple[tuple[str, str], ...]
    """Pairs of links that are locked together."""
    outputs: Mapping[str, Output]
    """Outputs in this state, by name."""
    loc: Loc
    """Path of the keys that declare the inputs."""
    engaged: tuple[str, ...]
    """Names of engaged clutches and brakes, including the one-way clutches that hold."""
    clutches: Mapping[tuple[str, ...], str]
    """Name of the brake or clutch for each fixed link and each pair of locked links."""
    loads: Mapping[str, Quantity] = field(default_factory=dict)
    """Torque on each loaded link; positive if the torque supplies power to the train."""
    solve_for: str | None = None
    """Link whose torque is to be calculated; None if none is declared."""
    exact: bool = True
    """False if radians were converted to turns, or turns to radians; this conversion has 50 digits."""
    drive: Drive | None = None
    """Drive of the state, by default of the train, or the train's `rate` as a drive; None if none is declared."""
    rate: Quantity | None = None
    """Real speed of the input, from the drive or the train's `rate`; None if neither is declared."""
    expect: ExpectedVerdict = "determined"
    """Expected kind of verdict. A verdict of this kind is not reported as a failure."""
    causes: Mapping[tuple[str, ...], tuple[str, ...]] = field(default_factory=dict)
    """Links of the declared brake or lock that causes an indirect one, by the links of the indirect brake or lock."""
    sliding: frozenset[str] = frozenset()
    """Links that slide; their speeds are travels in mm."""
    problems: tuple[Problem, ...] = ()
    """Problems that prevent the calculation of speeds in this state; empty if speeds can be calculated."""
    senses: Mapping[tuple[str, ...], int] = field(default_factory=dict)
    """Sign of the torque that a brake or lock of one-way clutches with one sense can exert on its last link."""
    one_way: tuple[OneWayAction, ...] = ()
    """One-way clutches that are active in the state, in the order of declaration."""
    notes: tuple[str, ...] = ()
    """Remarks about the one-way clutches, such as their behaviour when the output drives."""
    stepped: SteppedLink | None = None
    """Link that one-way clutches drive in steps, so that its mean speed is not a ratio; None if there is none."""

    @property
    def closed(self) -> tuple[str, ...]:
        """Names of the engaged clutches and brakes, without the one-way clutches that hold but transmit no torque."""
        idle = {each.name for each in self.one_way if each.torque == 0}
        return tuple(name for name in self.engaged if name not in idle)

    def given(self, link: str) -> str:
        """Return the prescribed speed of a link as text, such as `sun = 1400`.

        Parameters
        ----------
        link : str
            Name of an input link.
        """
        unit = " mm" if link in self.sliding else ""
        return f"{link} = {self.shown(self.inputs[link])}{unit}"

    def shown(self, speed: Fraction) -> str:
        """Return a speed as text: a fraction, or a decimal number if the speed is not exact.

        Parameters
        ----------
        speed : Fraction
            Speed in this state [the train's unit of speed].
        """
        return abridged_text(speed) if self.exact else decimal(speed)

    def says(self, *links: str) -> str:
        """Describe a brake on one link or a lock of two links, and the declared brake or lock that causes it, if any.

        Parameters
        ----------
        *links : str
            One link that is fixed, or two that are locked together.
        """
        declared = self.declares(*links)
        if self.causes.get(links, links) == links:
            return declared
        effect = f"fixes '{links[0]}'" if len(links) == 1 else f"locks '{links[0]}' and '{links[1]}' together"
        return f"{declared}, which {effect}"

    def declares(self, *links: str) -> str:
        """Describe the declared brake or lock that directly or indirectly fixes one link or locks two links.

        Parameters
        ----------
        *links : str
            One link that is fixed, or two that are locked together.
        """
        # an indirect brake or lock is described by the declaration that causes it
        links = self.causes.get(links, links)
        by = f" by {self.clutches[links]}" if links in self.clutches else ""
        if len(links) == 1:
            return f"'{links[0]}' is fixed{by}"
        return f"'{links[0]}' and '{links[1]}' are locked together{by}"
