"""Where two wheels meet: directions of contact and ways of turning, in the zero pose.

How wheels are put on their bodies, so that teeth stand as their law says when the train sets out.

A law fixes where the teeth of both wheels are at its driver's angle. From wheel to wheel that leaves no choice, and a
wheel with several mates can please one law only; of the others the driven wheel is set on so far that its driver
nowhere cuts into it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.numerics.vectors import Vector, across, azimuth, cross, dot, minus, scaled, size, unit_or_z
from geartrain.scene.bodies import as_placed
from geartrain.scene.context import SceneContext
from geartrain.scene.movement import MovementStart

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.scene.layout import WheelPlace
    from geartrain.teeth.gear_mesh import GearMesh


_NONE = 1e-9  # mm, or of a unit vector


@dataclass(frozen=True, slots=True)
class MeshDirections:
    """The two wheels of a pair.

    contact    unit vectors from their centres, across their axes, to where they touch
    same       1 where both turn about their own direction with teeth going one way at the contact, else -1
    """

    contact: tuple[Vector, Vector]
    same: int


def mesh_directions(stage: SceneContext, circuit: Circuit) -> MeshDirections | None:
    """How the wheels of a pair meet; None for skew axes, and for wheels about one axis."""
    wheels = [stage.train.declaration.wheels[name][1] for name in circuit.wheels]
    if "worm" in (wheels[0].kind, wheels[1].kind):
        return None
    first, second = (stage.layout.wheels[name] for name in circuit.wheels)
    axes = stage.reference(first.axis), stage.reference(second.axis)
    if size(cross(*axes)) >= _NONE and any(wheel.is_helical for wheel in wheels):
        return None
    if size(cross(*axes)) < _NONE:  # they are parallel
        between = across(minus(second.centre, first.centre), axes[0])
        if size(between) < _NONE:
            return None
        n = unit_or_z(between)
        back = scaled(n, -1.0)
        # a ring is touched from within, on the far side of its mate
        contact = (back, back) if wheels[1].internal else (n, n) if wheels[0].internal else (n, back)
    else:
        contact = _towards(stage, first, second, axes[0]), _towards(stage, second, first, axes[1])
    ways = [cross(axis, n) for axis, n in zip(axes, contact, strict=True)]
    return MeshDirections(contact, 1 if dot(*ways) > 0 else -1)


def _towards(stage: SceneContext, own: WheelPlace, mate: WheelPlace, axis: Vector) -> Vector:
    """Across the axis of a bevel wheel towards its mate, which lies off the apex on the side it faces."""
    lies = scaled(stage.along(mate.axis), float(mate.facing)) if mate.facing else minus(mate.centre, own.centre)
    return unit_or_z(across(lies, axis))


_NEAR = 1e-6  # of a pitch: teeth that stand as their law has them
_ROUNDS = 4


@dataclass(frozen=True, slots=True)
class WheelPhases:
    """Angles of first teeth (rad) by wheel, about the direction of its body, from its reference."""

    turns: Mapping[str, float]
    notices: tuple[Problem, ...] = ()


def phase_wheels(stage: SceneContext, moved: MovementStart) -> WheelPhases:
    """The turn of every wheel: so that it meshes with its mates, else as the layout has it."""
    found = _Mounting(stage, moved)
    for circuit in sorted(found.pairs, key=lambda each: (each.id not in moved.driving, each.id not in found.phases)):
        found.spread(circuit)
    turns = {wheel: found.turns.get(wheel, as_placed(stage, wheel)) for wheel in stage.layout.wheels}
    return WheelPhases(turns, tuple(found.notices()))


class _Mounting:
    def __init__(self, stage: SceneContext, moved: MovementStart) -> None:
        self.stage, self.moved = stage, moved
        self.turns: dict[str, float] = {}
        self.meetings: dict[str, MeshDirections] = {}
        self.mates: dict[str, list[Circuit]] = {}
        self.off: list[str] = []
        self.meshes: Mapping[str, GearMesh] = {mesh.name: mesh for mesh in stage.meshes}
        self.phases = {
            gear.name: float(gear.phase.value) for gear in stage.train.declaration.gears if gear.phase is not None
        }
        for circuit in stage.train.circuits:
            meeting = mesh_directions(stage, circuit) if circuit.kind == "gear" else None
            if meeting is not None:
                self.meetings[circuit.id] = meeting
                for wheel in circuit.wheels:
                    self.mates.setdefault(wheel, []).append(circuit)

    @property
    def pairs(self) -> list[Circuit]:
        """The pairs whose wheels can be set against each other."""
        return [circuit for circuit in self.stage.train.circuits if circuit.id in self.meetings]

    def spread(self, first: Circuit) -> None:
        """Mount all wheels that mesh with those of a pair, near or far, unless they are."""
        if any(wheel in self.turns for wheel in first.wheels):
            return
        at, setting = self._driver(first), self.moved.driving.get(first.id)
        if setting is not None:
            self._set(first, at, setting.S / self._pitch(first.wheels[at]))
        elif first.id in self.phases:
            at = 0
            self._set(first, at, self.phases[first.id])
        wheel = first.wheels[at]
        self.turns.setdefault(wheel, as_placed(self.stage, wheel))
        queue = deque([wheel])
        while queue:
            wheel = queue.popleft()
            for circuit in self.mates[wheel]:
                own = circuit.wheels.index(wheel)
                mate = circuit.wheels[1 - own]
                if mate not in self.turns:
                    self._mesh(circuit, own)
                    queue.append(mate)

    def _mesh(self, circuit: Circuit, own: int) -> None:
        """Mount the mate of a wheel that is mounted."""
        stands = self._stands(circuit, own)
        if own == self._driver(circuit):
            self._set(circuit, 1 - own, stands + self._ahead(circuit, stands))
            self._note_phase(circuit, stands)
            return
        at = stands - self._ahead(circuit)
        for _ in range(_ROUNDS):  # how far ahead depends on where the driver stands, and that on how far ahead
            at = stands - self._ahead(circuit, at)
        self._set(circuit, 1 - own, at)
        self._note_phase(circuit, at)

    def _shift(self, circuit: Circuit, stands: float) -> float:
        """Pitches by which a driver's tooth stands before where its law has it, less whole ones: teeth are alike."""
        setting = self.moved.driving.get(circuit.id)
        if setting is None:
            return 0.0
        shift = (stands - setting.S / self._pitch(circuit.wheels[self._driver(circuit)]) + 0.5) % 1 - 0.5
        return shift if abs(shift) > _NEAR else 0.0

    def _note_phase(self, circuit: Circuit, stands: float) -> None:
        if self._shift(circuit, stands):
            self.off.append(circuit.id)

    def _ahead(self, circuit: Circuit, stands: float | None = None) -> float:
        """How far (pitches, along the way of turning) the driven wheel's tooth stands before the driver's.

        stands   where the driver's tooth stands: off the phase of its law, the driven one is set on so far that the
                 driver nowhere cuts into it
        """
        mesh = self.meshes.get(circuit.id)
        if mesh is None:
            return 0.5
        setting = self.moved.driving.get(circuit.id)
        if setting is None:
            return mesh.stands or 0.5
        driver = self._driver(circuit)
        if any(self.stage.layout.wheels[wheel].cone for wheel in circuit.wheels):
            # no law knows the likeness of a crown: its teeth stand in the middle of spaces, in the mean
            middle = sum(setting.law.error_range()) / 2
            return 0.5 + (setting.error - middle) / self._pitch(circuit.wheels[1 - driver])
        shift = 0.0 if stands is None else self._shift(circuit, stands)
        error = setting.error_past(shift * self._pitch(circuit.wheels[driver])) if shift else setting.error
        return mesh.stands + error / self._pitch(circuit.wheels[1 - driver])

    def _driver(self, circuit: Circuit) -> int:
        """0 or 1: which wheel drives."""
        setting = self.moved.driving.get(circuit.id)
        if setting is not None:
            return int(setting.driver != circuit.i)
        mesh = self.meshes.get(circuit.id)
        return 0 if mesh is None else circuit.wheels.index(mesh.driver)

    def _stands(self, circuit: Circuit, at: int) -> float:
        """Where the first tooth of a mounted wheel stands at the beginning, in pitches from the contact, forwards."""
        wheel = circuit.wheels[at]
        return self._way(circuit, at) * (self.turns[wheel] - self._zero(circuit, at)) / self._pitch(wheel)

    def _set(self, circuit: Circuit, at: int, stands: float) -> None:
        """Mount a wheel so that a tooth of it stands there."""
        wheel = circuit.wheels[at]
        pitch = self._pitch(wheel)
        self.turns[wheel] = (self._zero(circuit, at) + self._way(circuit, at) * (stands % 1) * pitch) % (2 * pi)

    def _zero(self, circuit: Circuit, at: int) -> float:
        """The turn that puts the first tooth of a wheel on the line of centres at the beginning."""
        place = self.stage.layout.wheels[circuit.wheels[at]]
        axis = self.stage.reference(place.axis)
        rest = self.moved.rest[(circuit.i, circuit.j)[at]] - self.moved.rest[circuit.carrier]
        return azimuth(self.meetings[circuit.id].contact[at], axis, place.reference) - rest

    def _way(self, circuit: Circuit, at: int) -> int:
        """1 where a wheel turns forwards about its body's direction, else -1."""
        driver = self._driver(circuit)
        setting = self.moved.driving.get(circuit.id)
        forward = self._forward((circuit.i, circuit.j)[driver], circuit.carrier) if setting is None else setting.forward
        return forward if at == driver else forward * self.meetings[circuit.id].same

    def _forward(self, link: str, carrier: str) -> int:
        own, base = self.stage.speed(link) or 0, self.stage.speed(carrier) or 0
        return -1 if self.stage.sense(link) * own < self.stage.sense(carrier) * base else 1

    def _pitch(self, wheel: str) -> float:
        return 2 * pi / (self.stage.train.declaration.wheels[wheel][1].count or 1)

    def notices(self) -> Iterator[Problem]:
        """What the drawn teeth cannot show."""
        if self.off:
            yield Problem(
                f"the teeth of {', '.join(self.off)} are drawn off the phase of their law",
                "their driver meshes with several wheels, and stands as the first of them has it; the motion is exact, "
                "and the driven teeth are set on until nothing cuts into them, so that they touch but once a pitch",
                "",
            )
