"""A train in one case, as torques see it: speeds as far as they are determined, real teeth and pins, loads.

Equilibrium by virtual work: equations (14) to (16) of docs/torques.md.

Loads balance if they do no work in any motion that the known constraints leave. Speeds do not enter: a link may turn as
it likes and its torque be determined all the same.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from geartrain.dynamics.gear_meshes import PinMesh
from geartrain.dynamics.torques.torque_results import BearingTorque
from geartrain.kinematics.circuits import Axes, Circuit, Tree
from geartrain.kinematics.willis_equation import WillisEquation
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system, relative_speed
from geartrain.numerics.elimination import LinearForm, add_into, eliminate
from geartrain.teeth.gear_mesh import GearMesh as ToothMesh
from geartrain.teeth.pin_coupling import Coupling
from geartrain.train import GearPair, StateCase, Train

PRESCRIBED = -1
"""The column of a form in which prescribed numbers stand."""


@dataclass(frozen=True)
class VirtualMotion:
    """One way in which the train may be displaced, speeds by link, and the power of the loads in it."""

    speeds: Mapping[str, Fraction]
    power: Fraction


def speed_forms(system: WillisSystem) -> dict[str, LinearForm]:
    """The speed of every link in terms of those that are free; what is prescribed stands in the column `PRESCRIBED`."""
    return _forms(system.links, system.equations)


def unbalanced_motions(
    system: WillisSystem, loads: Mapping[str, Fraction], still: Collection[str]
) -> list[VirtualMotion]:
    """Independent motions in one of which at least the loads do work, equation (15); none if they balance.

    still   the links whose torque is unknown: they stand still in all these motions, and it does no work
    """
    held = [WillisEquation(f"still {link}", "fixed", ((link, 1),)) for link in still]
    forms = _forms(system.links, [*(row for row in system.equations if row.kind != "input"), *held])
    found = []
    for column in sorted({column for form in forms.values() for column in form}):
        speeds = {link: form[column] for link, form in forms.items() if form.get(column)}
        power = sum((loads.get(link, Fraction(0)) * speed for link, speed in speeds.items()), Fraction(0))
        found.append(VirtualMotion(speeds, power))
    return found if any(motion.power for motion in found) else []


def balancing_torque(motions: Sequence[VirtualMotion], link: str) -> Fraction | None:
    """The torque on one link that takes up what the loads do in every motion, equation (16); None where none does."""
    found: Fraction | None = None
    for motion in motions:
        speed = motion.speeds.get(link, Fraction(0))
        if not speed:
            if motion.power:
                return None
            continue
        torque = -motion.power / speed
        if found is not None and torque != found:
            return None
        found = torque
    return found


def _forms(links: Iterable[str], rows: Iterable[WillisEquation]) -> dict[str, LinearForm]:
    at = {link: number for number, link in enumerate(links)}
    held: list[LinearForm] = []
    for row in rows:
        form: LinearForm = {at[link]: Fraction(coefficient) for link, coefficient in row.terms}
        if row.right:
            form[PRESCRIBED] = -row.right
        held.append(form)
    found = eliminate(held).forms()
    return {link: found.get(number, {number: Fraction(1)}) for link, number in at.items()}


_ONE = Fraction(1)


@dataclass(frozen=True)
class MeanEfficiencies:
    """Efficiencies of one pair with the first link driving, then with the second."""

    driver: tuple[Fraction, Fraction] = (_ONE, _ONE)
    """Where the torque of the driver is constant over a turn."""
    load: tuple[Fraction, Fraction] = (_ONE, _ONE)
    """Where the torque of the driven side is."""
    exact: bool = True
    """As declared; False for means over teeth, which are floats to 15 digits."""

    @property
    def differ(self) -> bool:
        """True if it matters which torque is constant."""
        return self.driver != self.load

    def given(self, side: int, driving: bool) -> tuple[Fraction, Fraction]:
        """Forward and backward with the torque of the first link constant (1), of the second (-1), or of neither (0).

        driving   for neither: the loads put power in, so that what drives is nearer to what is given
        """
        if side > 0:
            return self.driver[0], self.load[1]
        if side < 0:
            return self.load[0], self.driver[1]
        return self.driver if driving else self.load


@dataclass(frozen=True)
class LoadCase:
    """A train in one case, solved for its speeds: everything torques need to know of it."""

    train: Train
    tree: Tree
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    case: StateCase
    speeds: Mapping[str, Fraction]
    """Of the links whose speed is determined."""
    meshes: Mapping[str, ToothMesh] = field(default_factory=dict)
    """Pairs with real teeth by name."""
    pins: Sequence[PinMesh] = ()
    forms: Mapping[str, LinearForm] = field(default_factory=dict)
    """In a train that is free, the speeds of all links in terms of what is free; else empty."""
    means: dict[str, MeanEfficiencies] = field(default_factory=dict, init=False, repr=False, compare=False)
    """What pairs and couplings lose on the mean, by name, as far as it has been asked for."""

    @cached_property
    def gears(self) -> Mapping[str, GearPair]:
        """Gear pairs by name."""
        return {gear.name: gear for gear in self.train.gears}

    @cached_property
    def couplings(self) -> Mapping[str, Coupling]:
        """Pins in slots by name."""
        return {coupling.name: coupling for coupling in self.train.couplings}

    @cached_property
    def joints(self) -> Mapping[str, PinMesh]:
        """Pins in slots with dimensions, by name."""
        return {joint.coupling.name: joint for joint in self.pins}

    @cached_property
    def system(self) -> WillisSystem:
        """The labelled rows of the case."""
        return assemble_willis_system(tuple(self.train.links), self.train.frame, self.circuits, self.case, self.signs)

    @cached_property
    def axes(self) -> Axes:
        """Directions and positions of all axes."""
        return Axes(self.train, self.tree)

    def axis_labels(self, circuit: Circuit) -> tuple[str, str]:
        """The axes of a circuit's first and second link, as its carrier holds them."""
        seen_from = self.tree.axis_seen_from
        return seen_from(circuit.carrier, circuit.i), seen_from(circuit.carrier, circuit.j)

    def helix_angles(self, circuit: Circuit) -> tuple[float, float] | None:
        """Helix angles (rad) of two wheels that slide along each other; None on parallel axes, or where unknown."""
        first, second = (self.train.wheels[name][1] for name in circuit.wheels)
        return self.axes.helix_angles(self.axis_labels(circuit), (first, second))

    @property
    def open(self) -> tuple[str, ...]:
        """Links whose speed is not determined."""
        return tuple(link for link in self.train.links if link not in self.speeds)

    def sense(self, link: str) -> int:
        """1, or -1 where the link's axis points against its parallels."""
        return self.signs.get(link, 1)

    def relative(self, link: str, carrier: str) -> Fraction | None:
        """Speed of a link seen from another, both about the direction of their parallels; None where that is free.

        Two links that are free may still have one speed between them.
        """
        own = self.sense(link)
        found = relative_speed(link, carrier, self.speeds.get, self.signs)
        if found is not None:
            return own * found
        form = {column: own * value for column, value in self.forms[link].items()}
        add_into(form, self.forms[carrier], -self.sense(carrier))
        free = any(value for column, value in form.items() if column != PRESCRIBED)
        return None if free else form.get(PRESCRIBED, Fraction(0))

    def rubs(self, part: GearPair | Coupling) -> bool:
        """True for a pair or coupling whose coefficient of friction is above 0, or follows a law of speed."""
        friction = self.train.friction_of(part)
        return friction is not None and friction.rubs

    def bearer(self, link: str) -> str:
        """What bears the axis that a link turns about, however its coaxial joints are declared."""
        return self.tree.top.get(link, link)

    def reacts_on(self, link: str) -> str:
        """What takes the reaction of a torque asked for at a link: pallets ride on what bears the escape wheel."""
        escapement = self.train.escapement
        return self.train.frame if escapement is None or link != escapement.link else self.bearer(link)

    def turn(self, circuit: Circuit) -> Fraction | None:
        """Speed of a circuit's first link seen from its carrier: where it is 0 no power flows between the two."""
        return self.relative(circuit.i, circuit.carrier)

    @cached_property
    def bearings(self) -> tuple[BearingTorque, ...]:
        """Friction of every bearing that has one, against the turning of its link in it: equation (10).

        Nothing where the speed in the joint is 0 or not determined.
        """
        found = []
        for link in self.train.links:
            if not (friction := self.bearing(link)):
                continue
            carrier = self.tree.parent[link][0]
            relative = self.relative(link, carrier) or Fraction(0)
            torque = friction * ((relative > 0) - (relative < 0))
            reaction = Fraction(0) if carrier == self.train.frame else self.sense(carrier) * torque
            found.append(BearingTorque(link, carrier, -self.sense(link) * torque, reaction, torque * relative))
        return tuple(found)

    def bearing(self, link: str) -> Fraction:
        """Friction torque of a link's bearing, N m or plain."""
        friction = self.train.links[link].bearing
        if friction is None or link == self.train.frame:
            return Fraction(0)
        return friction.sliding.base


def input_and_output(train: Train, case: StateCase) -> tuple[str, str] | None:
    """The one input and the one link that power leaves by: an output, loaded or alone; None if that is not plain."""
    if len(case.inputs) != 1:
        return None
    source = train.crank or next(iter(case.inputs))
    links = dict.fromkeys(output.of or name for name, output in case.outputs.items())
    loads = [link for link in case.loads if link != source]
    chosen = loads if len(loads) == 1 else [link for link in links if link != source]
    return (source, chosen[0]) if len(chosen) == 1 else None
