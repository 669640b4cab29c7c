"""Data from which the motion of a train in one state is computed: equations, transmission functions and drivers."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import permutations
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.answer import Loop
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import SolvedPart
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system, relative_speed
from geartrain.numerics.containers import ItemwiseMapping

if TYPE_CHECKING:
    from geartrain.dynamics.gear_meshes import CouplingMesh
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.circuits.joint_tree import Tree
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver
    from geartrain.train.states import SteppedLink


@dataclass(frozen=True)
class MotionProblem:
    """Data from which the motion of a train in one state is computed, as collected by `find_motion_problem`."""

    system: WillisSystem
    """Labelled Willis equations, without the equations of redundant circuits."""
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    speeds: Mapping[str, Fraction]
    """Exact mean speed of each link. `driving_link` is the input whose angle defines the positions."""
    frame: str
    driving_link: str
    meshes: Mapping[str, GearMesh]
    """Gear pairs with a declared tooth form and with their driver in this state, by name; the teeth of a pair are built
    on first access.
    """
    couplings: Sequence[CouplingMesh]
    drivers: Mapping[str, MeshDriver]
    """Driver of each pair and coupling, with the reason why it drives."""
    angles: Mapping[str, float] = field(default_factory=dict)
    """Angle of each link at position 0 [rad]; links without an entry have the angle 0."""
    phases: Mapping[str, float] = field(default_factory=dict)
    """Declared phase of each pair: distance by which a tooth of its first wheel is past the line of centres [pitch]."""
    shared: Mapping[tuple[str, str], Sequence[tuple[str, bool]]] = field(default_factory=dict)
    """Other pairs that have a wheel and its line of centres in common with a given pair, by names of the given pair and
    the wheel.

    Each pair has a flag that is True if its contact and the contact of the given pair are on opposite sides of the
    wheel.
    """
    loops: Sequence[Loop] = ()
    """Loops closed by redundant pairs. The transmission errors of the teeth around such a loop may be incompatible."""
    tree: Tree | None = None
    """Joints of the train, for speeds relative to links that slide; None if no link slides."""
    stepped: SteppedLink | None = None
    """Link that one-way clutches drive stepwise, and which is at rest in `system`; None if there is no such link."""
    behind: frozenset[str] = frozenset()
    """The stepped link and the links whose motion depends on it."""

    def without_steps(
        self, outputs: Mapping[str, tuple[str, str]], requested: Collection[str] = ()
    ) -> dict[str, tuple[str, str]]:
        """Return the outputs that do not depend on a link that one-way clutches drive in steps. If there are no such
        outputs, return the links that drive this link.

        Raise `QuestionError` if an output depends on such a link and outputs were `requested`.
        """
        kept = {name: ends for name, ends in outputs.items() if self.behind.isdisjoint(ends)}
        if requested and (left := outputs.keys() - kept.keys()):
            what = f"the motion of '{min(left)}' is not determined at every position"
            why = "one-way clutches drive it in steps, and only the mean advance is computed"
            raise QuestionError(Problem(what, why, f"omit '{min(left)}'; `geartrain motion FILE` computes the advance"))
        return kept or {link: (link, self.frame) for link in (self.stepped.drivers if self.stepped else ())}

    @cached_property
    def periods(self) -> Mapping[str, Fraction]:
        """Number of periods of each coupling's transmission function per revolution of its driver."""
        return {joint.coupling.name: joint.coupling.periods_per_turn for joint in self.couplings}

    @property
    def deviation(self) -> str:
        """Term for the difference between the angle of an output and its mean motion: transmission error for teeth,
        anomaly for couplings, or deviation if both contribute.
        """
        return ("deviation" if self.couplings else "transmission error") if self.rippling else "anomaly"

    @property
    def way(self) -> int:
        """Sense of rotation of the driving link about its own axis, 1 or -1. Angles of the link are positive in it."""
        return -1 if self.speeds[self.driving_link] < 0 else 1

    def ratio(self, link: str) -> Fraction:
        """Return the exact mean speed of a link divided by the speed of the driving link."""
        return self.speeds[link] / self.speeds[self.driving_link]

    def seen_ratio(self, link: str, base: str) -> Fraction:
        """Return the mean speed of a link relative to the link `base`, about the axis of `link`, divided by the speed
        of the driving link.
        """
        base = base if self.tree is None else self.tree.reference(link, base)
        return relative_speed(link, base, self.ratio, self.signs)

    def relative(self, link: str, carrier: str) -> Fraction:
        """Return the mean speed of a link relative to its carrier, about the reference direction, divided by the speed
        of the driving link.
        """
        return self.signs.get(link, 1) * self.seen_ratio(link, carrier)

    def placed_by(self, pair: str) -> tuple[str, bool] | None:
        """Return the pair that drives the driver of `pair` and thereby determines the phase of `pair`, and True if the
        contacts of both pairs are on opposite sides of this wheel; None if there is no such pair.
        """
        if pair not in self.drivers:
            return None
        wheel = self.drivers[pair].wheel
        others = self.shared.get((pair, wheel), ())
        return next((each for each in others if self.drivers[each[0]].wheel != wheel), None)

    @property
    def teeth(self) -> list[GearMesh]:
        """All gear pairs with a declared tooth form."""
        return list(self.meshes.values())

    @property
    def rippling(self) -> list[GearMesh]:
        """Gear pairs whose teeth have a variable speed ratio, so that they are evaluated at each position."""
        return [mesh for mesh in self.teeth if not mesh.rigid]

    @property
    def rigid(self) -> list[GearMesh]:
        """Gear pairs whose tooth form has a constant ratio, so that they need not be evaluated at each position."""
        return [mesh for mesh in self.teeth if mesh.rigid]

    def contradictions(self) -> list[tuple[Loop, list[str]]]:
        """Return the loops closed by redundant pairs in which the speed ratio of at least one pair varies, each with
        the names of the pairs whose ratio varies.
        """
        found = []
        for loop in self.loops:
            meshes = {pair: self.meshes.get(pair) for pair in loop.pairs}
            real = [pair for pair, mesh in meshes.items() if (pair in self.periods if mesh is None else not mesh.rigid)]
            if real:
                found.append((loop, real))
        return found


def find_motion_problem(
    train: TrainMechanics, state: str | None = None, without: Sequence[str] = (), steps: bool = False
) -> MotionProblem:
    """Collect the data from which the motion of a train in one state is computed.

    without   redundant pairs to be omitted, so that the errors of teeth are compatible around every closed loop
    steps     True if a link that one-way clutches drive stepwise is at rest, False if its speed is undetermined

    Raises `QuestionError` if no input turns, or if the speeds of the train are not determined.
    """
    own, declared, meshes = train.kinematics, train.declaration, train.undriven
    case = own.case(state)
    solution, behind = own.solution(case), frozenset[str]()
    if steps and case.stepped is not None:
        behind = frozenset(declared.links).difference(solution.speeds)
        case = replace(case, fixed=(*case.fixed, case.stepped.link))
        solution = own.solution(case)
    if not any(case.inputs.values()):
        what, why = f"'{declared.name}' does not move", "no input has a speed other than 0"
        raise QuestionError(Problem(what, why, "declare a non-zero speed under `inputs`"))
    if not solution.verdict:
        what = f"the motion of '{declared.name}' is not determined"
        raise QuestionError(Problem(what, solution.verdict.text, "`geartrain check FILE` shows the cause"))
    circuits, drivers = own.circuits_without(without), train.drivers(case.state, without)
    links = tuple(declared.links)
    parts = SolvedPart(links, declared.frame, circuits, tuple(case.inputs)).reduced.components
    # redundant pairs are omitted, so that the system is square
    redundant = {parts.circuits[chord].id for chord in parts.closing}
    whole = assemble_willis_system(links, declared.frame, circuits, case, own.signs)
    kept = {circuit.id for circuit in circuits}
    return MotionProblem(
        WillisSystem(whole.links, tuple(row for row in whole.equations if row.label not in redundant)),
        circuits,
        own.signs,
        solution.speeds,
        declared.frame,
        next(link for link, speed in case.inputs.items() if speed),
        ItemwiseMapping((name for name in meshes if name in kept), lambda name: meshes[name].driven_by(drivers[name])),
        [joint for joint in train.couplings if joint.coupling.name in kept],
        drivers,
        {name: link.angle.si for name, link in declared.links.items() if link.angle is not None},
        {gear.name: float(gear.phase.value) for gear in declared.gears if gear.phase is not None},
        find_shared_wheels(circuits, own.tree) if meshes else {},
        [parts.loop(chord) for chord in parts.closing] if meshes or train.couplings else [],
        own.tree if own.tree.lines else None,
        case.stepped if steps else None,
        behind,
    )


def find_shared_wheels(circuits: Sequence[Circuit], tree: Tree) -> dict[tuple[str, str], list[tuple[str, bool]]]:
    """Return the other pairs that share the line of centres of a pair at one of its wheels, by names of the pair and
    the wheel.

    Examples are the pairs of a planet with a sun and with a ring. The flag of another pair is True if the two contacts
    are on opposite sides of the wheel, which is the case if one mate is a ring.
    """
    of_wheel: dict[str, list[tuple[Circuit, str]]] = {}
    for circuit in circuits:
        if circuit.kind == "gear":
            for at, wheel in enumerate(circuit.wheels):
                axis = tree.axis_seen_from(circuit.carrier, (circuit.j, circuit.i)[at])
                of_wheel.setdefault(wheel, []).append((circuit, axis))
    found: dict[tuple[str, str], list[tuple[str, bool]]] = {}
    for wheel, pairs in of_wheel.items():
        for (one, axis), (other, second) in permutations(pairs, 2):
            if one.carrier == other.carrier and axis == second:
                # one mate is a ring, the other is not
                opposite = (one.a * one.b < 0) != (other.a * other.b < 0)
                found.setdefault((one.id, wheel), []).append((other.id, opposite))
    return found
