"""Model of a complete declaration.

This module also defines the epoch (a date, and the turns of the input at that date) and the effective friction of a
pair or coupling (sliding and static coefficients, and the standard deviation).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field, PrivateAttr, model_validator

from geartrain.errors import Loc, Marks, Problem, QuestionError, dotted, suggest
from geartrain.numerics.quantity import (
    Figure,
    InputSpeed,
    Load,
    PairDamping,
    PairStiffness,
    Quantity,
    Rate,
    as_rotation,
    as_torque,
    bad,
    in_unit,
    same_kind,
)
from geartrain.numerics.results import imported_function, summary_line
from geartrain.teeth.contact_coefficients import CoulombFriction, DeclaredRestitution
from geartrain.teeth.coupling import Coupling
from geartrain.train.fields import (
    ByName,
    Declared,
    DeclaredCoupling,
    DeclaredFriction,
    DeclaredToothForm,
    ExpectedVerdict,
    Id,
    Nothing,
    short_for,
)
from geartrain.train.manufacturing import FaceWidth, Material, PairMounting, WheelManufacture, material_table
from geartrain.train.mechanism import (
    Axis,
    Direction,
    GearPair,
    Joint,
    Link,
    MaterialDensity,
    Revolutes,
    Slide,
    Slides,
    Source,
    Thickness,
    Wheel,
)
from geartrain.train.outputs import Dial, FacePlate, Output, SpeedUnit, TourStep, View
from geartrain.train.periods import julian_day, period_table, read_date
from geartrain.train.reconstruction import Reconstruction
from geartrain.train.states import Clutch, Drive, Erratum, Escapement, Remove, State, StateCase

if TYPE_CHECKING:
    from geartrain.teeth.couplings.pins import PinCoupling
    from geartrain.teeth.friction_law import FrictionLaw


# ---------------------------------------------------------------------------------------------------------------- epoch


class Epoch(Declared):
    """Date at which the position of the train is known. The position is the number of turns of the input since all
    pointers were at the start of their scales.

    Years are astronomical: 0 is 1 BC, -204 is 205 BC. Dates before 1582-10-15 are in the Julian calendar, and later
    dates in the Gregorian calendar, unless `calendar` is given. In a declaration, a single string instead of a mapping
    is the date.
    """

    SHORT: ClassVar = {"type": "string"}

    date: str = Field(
        description="Year, month, day, such as -204-05-12 for 12 May 205 BC, optionally with a time such as "
        "`2000-01-01 18:30`; default noon"
    )
    calendar: Literal["julian", "gregorian"] | None = Field(
        None, description="Calendar of the date; default Julian before 1582-10-15, Gregorian from then on"
    )
    turns: Figure = Field(
        Figure.parse(0),
        description="Turns of the input from the state with all pointers at the start of their scales to the date",
    )
    source: Id | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")

    @model_validator(mode="after")
    def _check_date(self) -> Epoch:
        try:
            read_date(self.date, self.calendar)
        except ValueError as error:
            fix = "write year-month-day, such as 2000-01-01, or -204-05-12 for 12 May 205 BC"
            raise bad("date", str(error), fix) from None
        return self

    @cached_property
    def julian_day(self) -> Fraction:
        """Julian day of the date [d]; day 0 begins at noon of -4712-01-01 in the Julian calendar."""
        return julian_day(read_date(self.date, self.calendar))


DeclaredEpoch = Annotated[Epoch, short_for("date")]
"""Epoch; in a declaration, a single string instead of a mapping is its date."""


# ------------------------------------------------------------------------------------------------ friction that applies


@dataclass(frozen=True, slots=True)
class FrictionInForce:
    """Effective friction of a gear pair or coupling, declared for it or for the whole train."""

    sliding: float | None
    """Coefficient of sliding friction; None if the coefficient follows a friction law."""
    static: float
    """Coefficient of static friction; for a friction law, the value of the law at speed 0."""
    deviation: float = 0.0
    """Standard deviation of `sliding`; the ratio of `static` to `sliding` does not vary."""
    law: FrictionLaw | None = None
    """Friction law (coefficient as a function of sliding speed), if one is declared."""

    @property
    def has_friction(self) -> bool:
        """True if a friction law or a coefficient greater than 0 is declared."""
        return self.law is not None or bool(self.sliding) or self.static > 0


def friction_in_force(declared: CoulombFriction | FrictionLaw | None) -> FrictionInForce | None:
    """Return the effective friction for a declared coefficient or law; None if none is declared."""
    if declared is None:
        return None
    if not isinstance(declared, CoulombFriction):
        return FrictionInForce(None, declared.at_rest, law=declared)
    sliding = float(declared.sliding.value)
    static = sliding if declared.static is None else float(declared.static.value)
    return FrictionInForce(sliding, static, 0.0 if declared.deviation is None else float(declared.deviation.value))


# ---------------------------------------------------------------------------------------------------------- declaration


class Train(Declared):
    """Declaration of a gear train: links with their wheels, turning pairs, gear pairs, couplings, inputs and outputs.

    See Also
    --------
    declare : Build a train from plain data, with an example.
    geartrain.GearTrain : Analyse a train.
    """

    name: str = Field("train", description="Short name, preferably the same as the file name")
    title: str = Field("", description="One-line title for readers")
    note: str | None = Field(None, description="Remark for readers")
    frame: Id = Field("frame", description="Fixed link, whose speed is 0")
    unit: SpeedUnit | None = Field(
        None, description="Unit of all speeds; default numbers without a unit, or the unit of the inputs"
    )
    links: ByName[Annotated[Link, Nothing]] = Field(description="All links with their wheels, by name")
    axes: ByName[Axis] = Field(
        {},
        validate_default=True,
        description="Directions and positions of axes, by label; default all axes are parallel",
    )
    gravity: Direction | None = Field(
        None,
        description="Direction in which weights pull, for the load of bearings: [0, -1, 0] is down for axes along z; "
        "default without weights",
    )
    revolutes: Revolutes = Field((), description="Turning pairs of the links, which form a tree")
    slides: Slides = Field((), description="Sliding pairs of the links, which form one tree with the turning pairs")
    gears: tuple[GearPair, ...] = Field((), description="Gear pairs in mesh")
    couplings: tuple[DeclaredCoupling, ...] = Field((), description="Couplings of links other than gear pairs")
    belts: tuple[str, ...] = Field(
        (), description="Belts or chains around two wheels, `first ~ second`: a short form, read into `couplings`"
    )
    inputs: ByName[InputSpeed] = Field(
        {},
        validate_default=True,
        description="Prescribed speeds by link: numbers in the train's `unit`, or with a unit such as `30 rpm`; for a "
        "sliding link a travel such as `1.25 mm` or `2 mm/s`",
    )
    outputs: ByName[Annotated[Output, Nothing]] = Field(
        {}, validate_default=True, description="Required outputs of the train, by name"
    )
    fixed: tuple[Id, ...] = Field((), description="Links fixed to the frame")
    locks: tuple[tuple[Id, Id], ...] = Field((), description="Pairs of links that are locked together")
    clutches: ByName[Clutch] = Field(
        {}, validate_default=True, description="Brakes and clutches by name; states engage them"
    )
    states: ByName[Annotated[State, Nothing]] = Field(
        {}, validate_default=True, description="Modes of operation by name, each of which is solved"
    )
    expect: ExpectedVerdict | None = Field(
        None, description="Expected verdict of all states, which does not count as a failure; default `determined`"
    )
    friction: DeclaredFriction | None = Field(
        None, description="Default friction of all gear pairs: a coefficient, or the keys of a friction law"
    )
    tooth_form: DeclaredToothForm | None = Field(None, description="Default tooth form of all gear pairs")
    restitution: DeclaredRestitution | None = Field(
        None, description="Default coefficient of restitution of all pairs and couplings, 0 to 1"
    )
    stiffness: PairStiffness | None = Field(None, description="Default mesh stiffness of all gear pairs")
    damping: PairDamping | None = Field(None, description="Default mesh damping of all gear pairs")
    loads: ByName[Load] = Field(
        {},
        validate_default=True,
        description="External torques by link, and forces on sliding links such as `-100 N`; positive about the axis "
        "or along it, so that power enters the train if the link moves in the positive sense",
    )
    solve_for: Id | None = Field(None, description="Link whose external torque is the unknown")
    crank: Id | None = Field(None, description="Link at which power enters the train; default the inputs")
    rate: Rate | None = Field(None, description="Speed of the input in real time, for powers and impacts")
    drive: Drive | None = Field(None, description="Drive of the train for simulations in time; default `rate`")
    escapement: Escapement | None = Field(
        None, description="Escapement, which lets one link advance by half a tooth per beat"
    )
    thickness: Thickness | None = Field(None, description="Default thickness of all wheels")
    face_width: FaceWidth | None = Field(None, description="Default face width of all wheels")
    material: Id | None = Field(
        None, description="Default material of all wheels: a name of the table or of `materials`"
    )
    density: MaterialDensity | None = Field(None, description="Default density of all wheels")
    materials: ByName[Material] = Field({}, validate_default=True, description="Additional materials, by name")
    cutting: WheelManufacture | None = Field(None, description="Default manufacturing errors of all wheels")
    fitting: PairMounting | None = Field(None, description="Default mounting errors of all gear pairs")
    view: View = Field(View(), description="Side from which the train is viewed, and positive sense of rotation")
    dials: ByName[Annotated[Dial, Nothing]] = Field(
        {}, validate_default=True, description="Dials with their scales, by name"
    )
    dial_plate: FacePlate | None = Field(
        None, description="Size of the rectangular plates of the dials; default as small as the dials permit"
    )
    epoch: DeclaredEpoch | None = Field(
        None, description="Date at which the positions of all pointers are known; requires a `unit` of time"
    )
    tour: tuple[TourStep, ...] = Field((), description="Tour of the train on its page; not inherited")
    extends: str | None = Field(
        None,
        description="Declaration to extend: a file in the same folder, or the name of a shipped train or evidence",
    )
    remove: Remove | None = Field(None, description="Parts of the declaration in `extends` to remove")
    sources: ByName[Annotated[Source, BeforeValidator(lambda raw: {"cite": raw} if isinstance(raw, str) else raw)]] = (
        Field({}, validate_default=True, description="Sources by key")
    )
    errata: tuple[Erratum, ...] = Field((), description="Errors in published sources")
    reconstruct: Reconstruction | None = Field(
        None, description="Evidence of an incomplete train, for `geartrain reconstruct`"
    )

    _marks: Marks | None = PrivateAttr(None)

    def __repr__(self) -> str:
        counts = f"{len(self.links)} links, {len(self.gears)} gear pairs"
        more = f", {len(self.states)} states" if self.states else ""
        return summary_line("Train", f"{self.name}: {counts}{more}")

    def place(self, *loc: str | int) -> str:
        """Return the location where a value was written: `file.yaml:12`, or the path of its keys if it was not read
        from a file.

        Parameters
        ----------
        *loc : str or int
            Keys and list indices that lead to the value.
        """
        return self._marks(loc) if self._marks else dotted(loc)

    @cached_property
    def wheels(self) -> Mapping[str, tuple[str, Wheel]]:
        """All wheels by name, each as a pair of the name of its link and the wheel."""
        return {name: (link, wheel) for link, part in self.links.items() for name, wheel in part.wheels.items()}

    @cached_property
    def tour_parts(self) -> Mapping[str, str]:
        """Kind of each part that a tour can show, keyed by name: output, link, wheel, dial or coupling."""
        outputs = chain(self.outputs, *(state.outputs for state in self.states.values()))
        couplings = (coupling.id for coupling in self.couplings)
        kinds = {"coupling": couplings, "dial": self.dials, "wheel": self.wheels, "link": self.links, "output": outputs}
        return {name: kind for kind, names in kinds.items() for name in names}

    def form_of(self, gear: GearPair) -> DeclaredToothForm | None:
        """Return the tooth form of a gear pair, by default the tooth form of the train; None if neither is declared.

        Parameters
        ----------
        gear : GearPair
            Gear pair of this train.
        """
        return gear.tooth_form or self.tooth_form

    def friction_of(self, part: GearPair | Coupling) -> FrictionInForce | None:
        """Return the friction of a gear pair (by default, the friction of the train) or of the pin of a coupling; None
        if no friction is declared.

        Parameters
        ----------
        part : GearPair or Coupling
            Gear pair or coupling of this train.
        """
        if isinstance(part, GearPair):
            return friction_in_force(part.friction or self.friction)
        return friction_in_force(getattr(part, "friction", None))

    def stiffness_of(self, gear: GearPair) -> Quantity | None:
        """Return the tooth stiffness of a gear pair. A value declared for the pair has precedence over a value of its
        tooth form, and that over a value of the train; None if none of them is declared.

        Parameters
        ----------
        gear : GearPair
            Gear pair of this train.
        """
        form = self.form_of(gear)
        return gear.stiffness or (form.stiffness if form is not None else None) or self.stiffness

    def damping_of(self, gear: GearPair) -> Quantity | None:
        """Return the tooth damping of a gear pair. A value declared for the pair has precedence over a value of its
        tooth form, and that over a value of the train; None if it is not declared.

        Parameters
        ----------
        gear : GearPair
            Gear pair of this train.
        """
        form = self.form_of(gear)
        return gear.damping or (form.damping if form is not None else None) or self.damping

    def restitution_of(self, part: GearPair | Coupling) -> float | None:
        """Return the coefficient of restitution of a pair or coupling, by default the coefficient of the train; None if
        neither is declared.

        Parameters
        ----------
        part : GearPair or Coupling
            Gear pair or coupling of this train.
        """
        own = getattr(part, "restitution", None)
        found = self.restitution if own is None else own
        return None if found is None else float(found.value)

    @property
    def pin_couplings(self) -> tuple[PinCoupling, ...]:
        """Couplings by pins, and couplings that keep two links parallel, in the order of declaration."""
        if not self.couplings:
            return ()
        from geartrain.teeth.couplings.pins import PinCoupling

        return tuple(each for each in self.couplings if isinstance(each, PinCoupling))

    @property
    def cases(self) -> tuple[StateCase, ...]:
        """Prescriptions (inputs, brakes, locks, loads, drive) of each state; one element if the train has no states."""
        return tuple(self.case(state) for state in self.states) if self.states else (self.case(None),)

    def one_way_clutches(self, state: str | None) -> tuple[str, ...]:
        """Return the names of the one-way clutches that are active in one state.

        Parameters
        ----------
        state : str or None
            A declared state; None for a train without states.
        """
        free = () if state is None else self.states[state].free
        return tuple(name for name, each in self.clutches.items() if each.one_way is not None and name not in free)

    def case(self, state: str | None, holding: Sequence[str] | None = None) -> StateCase:
        """Return all prescriptions in one state: inputs, brakes, locks, loads and drive.

        Parameters
        ----------
        state : str or None
            A declared state; None for a train without states.
        holding : sequence of str, optional
            Names of the one-way clutches that hold; by default they are determined from speeds and torques.
        """
        if holding is None and self.one_way_clutches(state):
            if state not in self._decided_cases:
                # depends on speeds and torques, whose modules import this one and load only if they are needed
                decide_case = imported_function("dynamics.torques.one_way_clutches", "decide_case")
                self._decided_cases[state] = decide_case(self, state)
            return self._decided_cases[state]
        own = self.states[state] if state is not None else State()
        closed = {name for name in own.engaged if self.clutches[name].one_way is None}.union(holding or ())
        engaged = tuple(name for name in dict.fromkeys((*own.engaged, *self.clutches)) if name in closed)
        inputs = self.inputs if own.inputs is None else own.inputs
        fixed = list(self.fixed if own.fixed is None else own.fixed)
        locks = list(self.locks if own.locks is None else own.locks)
        clutches: dict[tuple[str, ...], str] = {}
        senses = {links: frozenset((1, -1)) for links in [*((link,) for link in fixed), *locks]}
        for name in engaged:
            clutch = self.clutches[name]
            if clutch.fixes is not None:
                fixed.append(clutch.fixes)
            links = clutch.links
            # clutches of opposite senses may lock the same two links
            if clutch.locks is not None and links not in clutches:
                locks.append(clutch.locks)
            clutches[links] = f"{clutches[links]} and {name}" if links in clutches else name
            senses[links] = senses.get(links, frozenset()) | clutch.senses
        outputs = dict(self.outputs)
        for name, output in own.outputs.items():
            inherited = outputs.get(name)
            # a state changes only the keys that it declares
            update = {key: getattr(output, key) for key in output.model_fields_set}
            outputs[name] = inherited.model_copy(update=update) if inherited else output
        loc: Loc = ("states", state, "inputs") if state is not None and own.inputs is not None else ("inputs",)
        drive = own.drive or self.drive or (None if self.rate is None else Drive(rate=self.rate))
        rate = self.rate if drive is None or drive.rate is None else drive.rate
        return StateCase(
            state,
            inputs={link: self._speed(speed) for link, speed in inputs.items()},
            # without duplicates: a brake may fix a link that is fixed in every state
            fixed=tuple(dict.fromkeys(fixed)),
            locks=tuple(locks),
            outputs=outputs,
            loc=loc,
            engaged=engaged,
            clutches=clutches,
            loads={link: as_torque(load) for link, load in self.loads_in(state).items()},
            solve_for=self.solve_for if own.solve_for is None else own.solve_for,
            exact=all(self._is_exact(speed) for speed in inputs.values()),
            drive=drive,
            expect=own.expect or self.expect or "determined",
            rate=None if rate is None else as_rotation(rate),
            sliding=self.sliding,
            senses={links: next(iter(each)) for links, each in senses.items() if len(each) == 1},
        )

    def loads_in(self, state: str | None) -> Mapping[str, Quantity]:
        """Return the load on each loaded link in one state.

        Parameters
        ----------
        state : str or None
            A declared state; None for a train without states.
        """
        own = None if state is None else self.states[state].loads
        return self.loads if own is None else own

    @cached_property
    def _decided_cases(self) -> dict[str | None, StateCase]:
        return {}

    def __copy__(self) -> Train:
        """Return a copy without the cached cases, in which one-way clutches depend on all values of the train."""
        copied = super().__copy__()
        copied.__dict__.pop("_decided_cases", None)
        return copied

    def check_state(self, state: str | None) -> None:
        """Raise `QuestionError` if a state is not declared.

        Parameters
        ----------
        state : str or None
            Name of the state; None is always accepted.
        """
        if state is not None and state not in self.states:
            fix = suggest(state, self.states) if self.states else "omit the state"
            raise QuestionError(
                Problem(f"'{self.name}' has no state '{state}'", "a state must be declared under `states`", fix)
            )

    def single_state(self, state: str | None) -> str | None:
        """Return the name of the given state, or of the only state if none is given; None for a train without states.
        Raises `QuestionError` if there are several states and none is given.

        Parameters
        ----------
        state : str or None
            Name of a state; None for the only state, or for a train without states.
        """
        if state is None and len(self.states) > 1:
            what, why = f"'{self.name}' has several states", "the result depends on the state"
            raise QuestionError(Problem(what, why, f"give one of these states: {', '.join(self.states)}"))
        self.check_state(state)
        return next(iter(self.states), None) if state is None else state

    def state_or_first(self, state: str | None) -> str | None:
        """Return the given state, by default the first declared one; None for a train without states.

        Parameters
        ----------
        state : str or None
            Name of a declared state; None for the first one.
        """
        return next(iter(self.states), None) if state is None else state

    @property
    def has_placed_axes(self) -> bool:
        """True if the position or the direction of at least one axis is declared."""
        return any(axis.position is not None or "direction" in axis.model_fields_set for axis in self.axes.values())

    @property
    def has_inertia(self) -> bool:
        """True if the inertia of at least one link is declared, or follows from the density of its wheels."""
        wheels = (wheel.density is not None for _, wheel in self.wheels.values())
        heavy = any(link.inertia or (link.mass and name in self.sliding) for name, link in self.links.items())
        return self.density is not None or heavy or any(wheels)

    def has_torque_units(self, state: str | None) -> bool:
        """Return True if a state has torques other than 0 (loads, bearings or jumpers), and all of them have units.

        Parameters
        ----------
        state : str or None
            A declared state; None for a train without states.
        """
        bearings = (part.bearing.sliding for part in self.links.values() if part.bearing is not None)
        torques = [torque for torque in (*self.loads_in(state).values(), *bearings) if torque.value]
        # friction of a jumper has a unit
        return bool(torques or self.has_jumpers) and all(torque.unit is not None for torque in torques)

    @property
    def has_jumpers(self) -> bool:
        """True if at least one coupling has friction that does not depend on its load."""
        return any(coupling.friction_torque for coupling in self.couplings)

    def is_loaded(self, state: str | None) -> bool:
        """Return True if loads, bearing torques or jumper torques are declared for a state.

        Parameters
        ----------
        state : str or None
            A declared state; None for a train without states.
        """
        return (
            bool(self.loads_in(state))
            or self.has_jumpers
            or any(link.bearing is not None and link.bearing.sliding.value for link in self.links.values())
        )

    def _speed(self, speed: Quantity) -> Fraction:
        """Convert a prescribed speed to the train's unit of speed."""
        speed = as_rotation(speed)
        if speed.unit is None:
            return speed.value
        if self.unit is not None:
            return speed.base * (self.unit_base or 1)
        return in_unit(speed, self.input_unit)

    def _is_exact(self, speed: Quantity) -> bool:
        """Return True if a speed is exact in the train's unit; False if radians are converted to turns or back."""
        return not speed.value or same_kind(
            as_rotation(speed).unit, None if self.unit is not None else self.input_unit or None
        )

    @cached_property
    def input_unit(self) -> str:
        """Unit of the input speeds, which is the unit of the first input that has a unit and is not 0. If all such
        inputs are 0, it is the unit of the first; "" if no input has a unit.
        """
        groups = [own.inputs for own in self.states.values() if own.inputs is not None]
        # the train's inputs are unused if every state has its own
        if len(groups) == len(self.states) and groups:
            speeds = [speed for group in groups for speed in group.values()]
        else:
            speeds = [speed for group in (self.inputs, *groups) for speed in group.values()]
        named = [speed for speed in map(as_rotation, speeds) if speed.unit]
        return next((speed.unit or "" for speed in named if speed.value), (named[0].unit or "") if named else "")

    def dial_outputs(self, names: Sequence[str]) -> tuple[str, ...]:
        """Return the given names that are outputs with a dial; if there are none, the outputs with a target; if there
        are none either, all given names.

        Parameters
        ----------
        names : sequence of str
            Names of outputs or links.

        Returns
        -------
        tuple of str
            Selected names, in the given order.
        """
        known = [(name, self.outputs[name]) for name in names if name in self.outputs]
        dials = tuple(name for name, output in known if output.dial)
        return dials or tuple(name for name, output in known if output.targets) or tuple(names)

    @property
    def unit_speed(self) -> Fraction | None:
        """Size of the train's unit of speed [turn/s]; None for numbers without a unit, or if the unit is a length."""
        if self.unit is not None:
            return None if self.unit_days is None else 1 / (self.unit_days * 86400)
        return Quantity(Fraction(1), self.input_unit, "1").base if self.input_unit else None

    @cached_property
    def unit_days(self) -> Fraction | None:
        """Length of the time in the key `unit` [d]; None if `unit` is not declared or does not contain a time."""
        if self.unit is None:
            return None
        row = period_table().get(self.unit.per)
        if row is not None:
            return row.value if row.kind == "period" else None
        quantity = self.unit_quantity
        return quantity.base / 86400 if quantity and quantity.dimension == "time" else None

    @property
    def unit_base(self) -> Fraction | None:
        """Size of the time or length of the key `unit` [s or m]; None if `unit` is not declared."""
        quantity = self.unit_quantity
        if quantity is not None:
            return quantity.base
        return None if self.unit_days is None else self.unit_days * 86400

    @property
    def unit_quantity(self) -> Quantity | None:
        """Time or length of the key `unit` as a quantity, such as 1 d for speeds in turns per day; None if `unit` names
        a period or is not declared.
        """
        if self.unit is None or self.unit.per in period_table():
            return None
        try:
            return Quantity.parse(self.unit.per, "time or length", plain=False)
        except ValueError:
            return None

    @property
    def unit_name(self) -> str:
        """Name of the unit of speeds, such as `turns per tropical year` or `rpm`; empty if speeds have no unit."""
        if self.unit is not None:
            row = period_table().get(self.unit.per)
            return f"turns per {(row.what if row else '') or str(self.unit.per).removeprefix('1 ')}"
        return self.input_unit

    @property
    def travel_unit(self) -> str:
        """Unit of the speeds of sliding links, such as `mm/min`; `mm`, for mm per turn, if speeds have no unit."""
        name = self.unit_name.replace("rpm", "turn/min")
        return re.sub("^turns?", "mm", name) or "mm"

    @cached_property
    def sliding(self) -> frozenset[str]:
        """Names of the links that slide on their neighbours in the direction of the frame; all other links turn."""
        if not self.slides:
            return frozenset()
        found, reached = set(), {self.frame}
        waiting: list[Joint] = [*self.revolutes, *self.slides]
        while joint := next((each for each in waiting if len(reached.intersection(each.pair)) == 1), None):
            waiting.remove(joint)
            (link,) = {*joint.pair} - reached
            reached.add(link)
            if isinstance(joint, Slide):
                found.add(link)
        return frozenset(found)

    @property
    def cases_declared(self) -> Iterator[tuple[Loc, Train | State]]:
        """Yield the train and each of its states, with their paths in the declaration. Each of them can declare inputs
        and loads.
        """
        yield (), self
        for name, state in self.states.items():
            yield ("states", name), state

    def uncertain_wheels(self) -> Iterator[tuple[str, Wheel]]:
        """Yield the name and the wheel of every tooth count that is declared with a range or choices."""
        return ((name, wheel) for name, (_, wheel) in self.wheels.items() if wheel.uncertainty)


def wheel_thickness(train: Train, wheel: Wheel) -> Quantity | None:
    """Return the thickness of a wheel. It is the first of these that is declared: thickness of the wheel, face width of
    the wheel, thickness of the train, face width of the train; None if none is declared.
    """
    return wheel.thickness or wheel.face_width or train.thickness or train.face_width


def face_width(train: Train, wheel: Wheel) -> Quantity | None:
    """Return the face width of a wheel. It is the first of these that is declared: face width of the wheel, thickness
    of the wheel, face width of the train, thickness of the train; None if none is declared.
    """
    return wheel.face_width or wheel.thickness or train.face_width or train.thickness


def material_named(train: Train, name: str) -> Material:
    """Return the material with a given name from the declaration of the train, or from the shipped table if the train
    does not declare it.
    """
    return train.materials.get(name) or material_table()[name]
