"""What motion needs to know of a train in one case, gathered: rows, mean speeds, laws, who drives, loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import permutations
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.answer import Loop
from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import SolvedPart
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system, relative_speed
from geartrain.numerics.containers import ItemwiseMapping

if TYPE_CHECKING:
    from geartrain.dynamics.gear_meshes import PinMesh
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.circuits.joint_tree import Tree
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver


@dataclass(frozen=True)
class MotionProblem:
    """What motion needs to know of a train in one case."""

    system: WillisSystem
    """The labelled rows without redundant circuits."""
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    speeds: Mapping[str, Fraction]
    """Exact mean speeds; `lead` is the input whose angle is given."""
    frame: str
    driving_link: str
    meshes: Mapping[str, GearMesh]
    """Pairs with real teeth by name, as they are driven, each made when it is first read."""
    pins: Sequence[PinMesh]
    drivers: Mapping[str, MeshDriver]
    """Who drives each pair and coupling, and how that is known."""
    angles: Mapping[str, float] = field(default_factory=dict)
    """Starting angles of links (rad); `phases`, of pairs, in pitches of their first wheel."""
    phases: Mapping[str, float] = field(default_factory=dict)
    shared: Mapping[tuple[str, str], Sequence[tuple[str, bool]]] = field(default_factory=dict)
    """By pair and wheel, the other pairs of that wheel about the same line, and whether its contacts lie on opposite
    sides."""
    loops: Sequence[Loop] = ()
    """Loops that are redundant: real teeth in them contradict the rest."""

    @property
    def way(self) -> int:
        """1, or -1 where the lead turns backwards about its own axis: motion counts turns and angles in its sense."""
        return -1 if self.speeds[self.driving_link] < 0 else 1

    def ratio(self, link: str) -> Fraction:
        """Mean speed of a link over the lead's, exactly."""
        return self.speeds[link] / self.speeds[self.driving_link]

    def seen_ratio(self, link: str, base: str) -> Fraction:
        """Mean speed of a link seen from another, about the first one's axis, over the lead's."""
        return relative_speed(link, base, self.ratio, self.signs)

    def relative(self, link: str, carrier: str) -> Fraction:
        """Mean speed of a link seen from its carrier, over the lead's, both about the direction of their parallels."""
        return self.signs.get(link, 1) * self.seen_ratio(link, carrier)

    def placed_by(self, pair: str) -> tuple[str, bool] | None:
        """The pair that drives the driver of a pair, and so places its teeth; of `shared`, None where there is none."""
        if pair not in self.drivers:
            return None
        wheel = self.drivers[pair].wheel
        others = self.shared.get((pair, wheel), ())
        return next((each for each in others if self.drivers[each[0]].wheel != wheel), None)

    @property
    def teeth(self) -> list[GearMesh]:
        """All pairs with real teeth."""
        return list(self.meshes.values())

    @property
    def rippling(self) -> list[GearMesh]:
        """The pairs whose teeth do not keep their ratio at every instant."""
        return [mesh for mesh in self.teeth if not mesh.rigid]

    @property
    def rigid(self) -> list[GearMesh]:
        """The pairs with real teeth that do: nothing of them is worked out position by position."""
        return [mesh for mesh in self.teeth if mesh.rigid]

    def contradictions(self) -> list[tuple[Loop, list[str]]]:
        """Redundant loops in which something ripples, with what does."""
        found = ((loop, [pair for pair in loop.pairs if self._ripples(pair)]) for loop in self.loops)
        return [(loop, real) for loop, real in found if real]

    def _ripples(self, pair: str) -> bool:
        mesh = self.meshes.get(pair)
        return any(joint.coupling.name == pair for joint in self.pins) if mesh is None else not mesh.rigid


def find_motion_problem(train: TrainMechanics, state: str | None = None, without: Sequence[str] = ()) -> MotionProblem:
    """A train in one state; pairs that are left out leave their teeth out too. Raises `QuestionError` if it rests.

    without   pairs left out, so that real teeth do not contradict each other around a loop
    """
    own, declared, meshes, pins = train.kinematics, train.declaration, train.undriven, train.pins
    case = own.case(state)
    solution = own.solution(case)
    if not solution.verdict or not any(case.inputs.values()):
        what = f"'{declared.name}' does not move"
        raise QuestionError(Problem(what, solution.verdict.text, "drive it from an input"))
    circuits, drivers = own.circuits_without(without), train.drivers(case.state, without)
    links = tuple(declared.links)
    parts = SolvedPart(links, declared.frame, circuits, tuple(case.inputs)).reduced.components
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
        [joint for joint in pins if joint.coupling.name in kept],
        drivers,
        {name: link.angle.si for name, link in declared.links.items() if link.angle is not None},
        {gear.name: float(gear.phase.value) for gear in declared.gears if gear.phase is not None},
        find_shared_wheels(circuits, own.tree) if meshes else {},
        [parts.loop(chord) for chord in parts.closing] if meshes or pins else [],
    )


def find_shared_wheels(circuits: Sequence[Circuit], tree: Tree) -> dict[tuple[str, str], list[tuple[str, bool]]]:
    """Wheels with coaxial mates, as a planet between sun and ring: their lines of centres are one line.

    The contacts lie on opposite sides where one mate is a ring.
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
                opposite = (one.a * one.b < 0) != (other.a * other.b < 0)
                found.setdefault((one.id, wheel), []).append((other.id, opposite))
    return found
