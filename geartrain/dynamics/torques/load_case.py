"""Train in one load case: its speeds, teeth, pins and loads, and a check of equilibrium by virtual work.

The equations are (14) to (16) of docs/torques.md. Loads are in equilibrium if they do no work in any motion that is
compatible with the constraints. This condition does not contain speeds, so a torque may be determined although a speed
is undetermined.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from geartrain.dynamics.gear_meshes import CouplingMesh
from geartrain.dynamics.torques.torque_results import BearingTorque
from geartrain.kinematics.circuits import Axes, Circuit, Tree, pallet_link
from geartrain.kinematics.circuits.fundamental import WillisEquation
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system, relative_speed
from geartrain.numerics.elimination import LinearForm, add_into, eliminate
from geartrain.numerics.quantity import TRAVEL_ARM
from geartrain.teeth.coupling import Coupling
from geartrain.teeth.gear_mesh import GearMesh as ToothMesh
from geartrain.train import GearPair, StateCase, Train

PRESCRIBED = -1
"""Column of a linear form that contains the constant term, which comes from prescribed speeds."""


@dataclass(frozen=True)
class VirtualMotion:
    """Virtual motion of the train: the speed of each link, and the power of the loads."""

    speeds: Mapping[str, Fraction]
    power: Fraction


def speed_forms(links: Iterable[str], rows: Iterable[WillisEquation]) -> dict[str, LinearForm]:
    """Return the speed of each link, by name, as a linear form in undetermined speeds and the constant 1 (column
    `PRESCRIBED`).

    rows   equations of the Willis system to be satisfied
    """
    at = {link: number for number, link in enumerate(links)}
    held: list[LinearForm] = []
    for row in rows:
        form: LinearForm = {at[link]: Fraction(coefficient) for link, coefficient in row.terms}
        if row.right:
            form[PRESCRIBED] = -row.right
        held.append(form)
    found = eliminate(held).forms()
    return {link: found.get(number, {number: Fraction(1)}) for link, number in at.items()}


def unbalanced_motions(
    system: WillisSystem, loads: Mapping[str, Fraction], still: Collection[str]
) -> list[VirtualMotion]:
    """Return a basis of the virtual motions if the loads do work in at least one of them, equation (15) of
    docs/torques.md; empty if the loads are in equilibrium.

    still   links with unknown torques; the links are at rest in all these motions, so that their torques do no work
    """
    held = [WillisEquation(f"still {link}", "fixed", ((link, 1),)) for link in still]
    forms = speed_forms(system.links, [*(row for row in system.equations if row.kind != "input"), *held])
    found = []
    # one motion for each free speed, with the other free speeds 0
    for column in sorted({column for form in forms.values() for column in form}):
        speeds = {link: form[column] for link, form in forms.items() if form.get(column)}
        power = sum((loads.get(link, Fraction(0)) * speed for link, speed in speeds.items()), Fraction(0))
        found.append(VirtualMotion(speeds, power))
    return found if any(motion.power for motion in found) else []


def balancing_torque(motions: Sequence[VirtualMotion], link: str) -> Fraction | None:
    """Return the torque on `link` that balances the loads in every motion, equation (16) of docs/torques.md; None if no
    torque does.
    """
    found: Fraction | None = None
    for motion in motions:
        speed = motion.speeds.get(link, Fraction(0))
        if not speed:
            # the loads do work in a motion in which the link is at rest
            if motion.power:
                return None
            continue
        torque = -motion.power / speed
        if found is not None and torque != found:
            return None
        found = torque
    return found


_ONE = Fraction(1)  # efficiency without loss


@dataclass(frozen=True)
class MeanEfficiencies:
    """Mean efficiencies of one pair. In each tuple, the first value is for the first link as the driver, the second
    value for the second link as the driver.
    """

    driver: tuple[Fraction, Fraction] = (_ONE, _ONE)
    """Efficiencies if the torque of the driver is constant over a revolution; they are at most 1."""
    load: tuple[Fraction, Fraction] = (_ONE, _ONE)
    """Efficiencies if the torque of the driven link is constant over a revolution."""
    exact: bool = True
    """True for declared values; False for mean values over tooth positions, which are floats rounded to 15 digits."""

    @property
    def differ(self) -> bool:
        """True if the efficiency depends on which torque is constant, the driver's or the driven link's."""
        return self.driver != self.load

    def given(self, side: int, driving: bool) -> tuple[Fraction, Fraction]:
        """Return the efficiency if the first link drives and the efficiency if the second link drives. Both depend on
        which torque of the pair is constant over a turn.

        side      1 if the torque of the first link is constant, -1 if the torque of the second link is, 0 if neither is
        driving   True if loads supply power to the train; only used if neither torque is constant
        """
        if side > 0:
            return self.driver[0], self.load[1]
        if side < 0:
            return self.load[0], self.driver[1]
        return self.driver if driving else self.load


@dataclass(frozen=True)
class LoadCase:
    """Train in one load case with its speeds, which is the input of the torque analysis."""

    train: Train
    tree: Tree
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    """Sign of each link's axis: -1 if it points against the reference direction of its parallel axes, 1 if it
    does not.
    """
    case: StateCase
    speeds: Mapping[str, Fraction]
    """Speed of each link whose speed is determined [the train's unit of speed]."""
    meshes: Mapping[str, ToothMesh] = field(default_factory=dict)
    """Meshing teeth of each gear pair that has a declared tooth form, by name of the pair."""
    varying: Sequence[CouplingMesh] = ()
    """Couplings that have a variable ratio and declared dimensions."""
    forms: Mapping[str, LinearForm] = field(default_factory=dict)
    """Speeds of all links as linear forms in the free speeds, if the train is underdetermined; empty if it is not."""
    means: dict[str, MeanEfficiencies] = field(default_factory=dict, init=False, repr=False, compare=False)
    """Mean efficiencies computed so far, by name of the pair or coupling."""

    @cached_property
    def gears(self) -> Mapping[str, GearPair]:
        """Gear pairs by name."""
        return {gear.name: gear for gear in self.train.gears}

    @cached_property
    def couplings(self) -> Mapping[str, Coupling]:
        """Couplings by name."""
        return {row.id: each for each in self.train.couplings for row in each.rows(self.train.wheels)}

    @cached_property
    def joints(self) -> Mapping[str, CouplingMesh]:
        """Couplings with variable ratio and declared dimensions, by name."""
        return {joint.coupling.name: joint for joint in self.varying}

    @cached_property
    def system(self) -> WillisSystem:
        """Labelled Willis equations of the load case."""
        return assemble_willis_system(tuple(self.train.links), self.train.frame, self.circuits, self.case, self.signs)

    @cached_property
    def axes(self) -> Axes:
        """Directions and positions of the axes of all links, by link."""
        return Axes(self.train, self.tree)

    @property
    def arms(self) -> Mapping[str, Fraction]:
        """Lever arm by which the force on each sliding link is converted to a torque [m]."""
        return dict.fromkeys(self.tree.lines, TRAVEL_ARM)

    def axis_labels(self, circuit: Circuit) -> tuple[str, str]:
        """Return the labels of the axes about which a circuit's first and second link turn on its carrier."""
        seen_from = self.tree.axis_seen_from
        return seen_from(circuit.carrier, circuit.i), seen_from(circuit.carrier, circuit.j)

    def helix_angles(self, circuit: Circuit) -> tuple[float, float] | None:
        """Return the helix angles of a pair on skew axes [rad]; None if axes are parallel or angles unknown."""
        first, second = (self.train.wheels[name][1] for name in circuit.wheels)
        return self.axes.helix_angles(self.axis_labels(circuit), (first, second))

    @property
    def open(self) -> tuple[str, ...]:
        """Names of the links whose speed is not determined."""
        return tuple(link for link in self.train.links if link not in self.speeds)

    def sense(self, link: str) -> int:
        """Return -1 if the axis of the link points against the reference direction of the axes parallel to it,
        otherwise 1.
        """
        return self.signs.get(link, 1)

    def relative(self, link: str, carrier: str) -> Fraction | None:
        """Return the speed of a link relative to `carrier`, about the reference direction [the train's unit of speed];
        None if it is undetermined.

        The relative speed of two links may be determined even if neither absolute speed is determined.
        """
        return self._difference(link, self.tree.reference(link, carrier))

    def _difference(self, link: str, carrier: str) -> Fraction | None:
        own = self.sense(link)
        found = relative_speed(link, carrier, self.speeds.get, self.signs)
        if found is not None:
            return own * found
        form = {column: own * value for column, value in self.forms[link].items()}
        add_into(form, self.forms[carrier], -self.sense(carrier))
        free = any(value for column, value in form.items() if column != PRESCRIBED)
        return None if free else form.get(PRESCRIBED, Fraction(0))

    def has_friction(self, part: GearPair | Coupling) -> bool:
        """Return True if the declared friction of a pair or coupling is greater than 0 or depends on speed, or if the
        losses follow from its tooth form.
        """
        mesh = self.meshes.get(part.name)
        if mesh is not None and not mesh.has_shape:
            return mesh.computes_losses
        friction = self.train.friction_of(part)
        return friction is not None and friction.has_friction

    def bearer(self, link: str) -> str:
        """Return the link that carries the axis of `link`. The order in which coaxial joints are declared does not
        matter.
        """
        return self.tree.top.get(link, link)

    def reacts_on(self, link: str) -> str:
        """Return the link on which the reaction to an unknown torque on `link` acts, which is usually the frame.

        For the escape wheel, it is the link on which the pallets are mounted.
        """
        escapement = self.train.escapement
        return self.train.frame if escapement is None or link != escapement.link else pallet_link(escapement, self.tree)

    def turn(self, circuit: Circuit) -> Fraction | None:
        """Return the speed of the first link of a circuit relative to its carrier; None if the speed is undetermined.
        Power flows through the circuit only if this speed is not 0.
        """
        return self._difference(circuit.i, circuit.subtracted[0])

    def bearings(self, loaded: Mapping[str, tuple[float, float]], steady: bool = True) -> tuple[BearingTorque, ...]:
        """Return the friction torque of every bearing with friction, which opposes the rotation of its link, equation
        (10) of docs/torques.md.

        The torque is 0 if the relative speed in the bearing is 0 or undetermined.

        loaded   load-dependent friction torque and bearing load, by link
        steady   True to include friction that does not depend on the load
        """
        own = {(link, self.tree.borne_by(link)): Fraction(torque) for link, (torque, _) in loaded.items()}
        found = []
        for link, carrier in {**(self._rubbing if steady else {}), **own}:
            friction = own.get((link, carrier), Fraction(0)) + (self._rubbing.get((link, carrier), 0) if steady else 0)
            ends = {end: friction * torque for end, torque in self.friction_senses(link, carrier)}
            relative = self.relative(link, carrier) or Fraction(0)
            torque, reaction = (ends.get(end, Fraction(0)) for end in (link, carrier))
            load = loaded[link][1] if (link, carrier) in own else None
            found.append(BearingTorque(link, carrier, torque, reaction, friction * abs(relative), load))
        return tuple(found)

    def friction_senses(self, link: str, carrier: str | None = None) -> Iterator[tuple[str, int]]:
        """Yield the link, and its carrier unless this is the frame, each with the sign (1, -1 or 0) of the torque that
        friction in the bearing between them exerts on it about its own axis.
        """
        carrier = self.tree.borne_by(link) if carrier is None else carrier
        relative = self.relative(link, carrier) or Fraction(0)
        way = (relative > 0) - (relative < 0)
        yield link, -self.sense(link) * way
        if carrier != self.train.frame:
            yield carrier, self.sense(carrier) * way

    @cached_property
    def _rubbing(self) -> Mapping[tuple[str, str], Fraction]:
        """Positive load-independent friction torques of bearings, by link and the link that carries it."""
        own = [(link, self.tree.borne_by(link), self.bearing(link)) for link in self.train.links if self.bearing(link)]
        couplings = (each for each in self.circuits if each.kind != "gear")
        jumpers = ((each.i, each.carrier, self.couplings[each.id].friction_torque) for each in couplings)
        found: dict[tuple[str, str], Fraction] = {}
        for link, carrier, friction in (*own, *jumpers):
            if friction:
                found[link, carrier] = found.get((link, carrier), Fraction(0)) + friction
        return found

    def bearing(self, link: str) -> Fraction:
        """Return the friction torque of a link's bearing [N m, or a number without a unit]; 0 if none is declared."""
        friction = self.train.links[link].bearing
        return Fraction(0) if friction is None or link == self.train.frame else friction.sliding.base


def power_inputs(setting: LoadCase) -> tuple[str, ...]:
    """Return the links at which power may enter the train: the inputs, or the crank if it is another link.

    A crank replaces a single input, which then only prescribes the speed. If there are several inputs, power may enter
    at the crank and at all inputs.
    """
    inputs, crank = tuple(setting.case.inputs), setting.train.crank
    if crank is None or crank in inputs:
        return inputs
    return (crank,) if len(inputs) == 1 else (crank, *inputs)


def input_and_output(train: Train, case: StateCase) -> tuple[str, str] | None:
    """Return the links at which power enters and leaves the train; None if they are not unique.

    Power enters at the declared crank, or, if none is declared, at the only input. Power leaves at the only loaded
    link, or, if no link is loaded, at the only output.
    """
    if len(case.inputs) != 1:
        return None
    source = train.crank or next(iter(case.inputs))
    links = dict.fromkeys(output.of or name for name, output in case.outputs.items())
    loads = [link for link in case.loads if link != source]
    chosen = loads if len(loads) == 1 else [link for link in links if link != source]
    return (source, chosen[0]) if len(chosen) == 1 else None
