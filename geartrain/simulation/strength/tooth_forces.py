"""Tangential, axial and radial forces at the pitch points of a train under load, equations (18) and (19) of
docs/strength.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import atan, copysign, cos, sin, tan
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.torques.bearing_loads import separation
from geartrain.dynamics.torques.mean_efficiencies import NORMAL_ANGLE
from geartrain.errors import RangeError
from geartrain.kinematics.circuits.fundamental import shaft_angle
from geartrain.simulation.strength.contact_pressure import CrossedWheels
from geartrain.simulation.strength.strength_results import WheelForce
from geartrain.simulation.strength.virtual_spurs import ConeMiddle
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
from geartrain.teeth.involute import Involute
from geartrain.train.declaration import face_width

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_results import PairTorque
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import Wheel


_MM = 1e3
WheelParts = tuple[float, float, float | None]


@dataclass(frozen=True)
class ToothForces:
    """Tooth forces at the pitch points of all gear pairs in one load case."""

    setting: LoadCase
    modules: Mapping[str, float]
    """Transverse module of each wheel [m], keyed by wheel. Wheels of pairs without a module are omitted."""
    pairs: Mapping[str, PairTorque]
    """Torques on both wheels of each pair, keyed by pair."""
    meshes: Mapping[str, GearMesh]
    """Gear pairs that have a tooth form, keyed by name."""
    swings: Mapping[str, float] = field(default_factory=dict)
    """Ratio of the design torque to the mean torque of each pair, keyed by pair."""

    def find(self) -> Iterator[WheelForce]:
        """Yield the forces on both wheels of every pair that transmits torque, first wheel first."""
        for circuit in self.setting.circuits:
            if circuit.kind != "gear":
                continue
            torque = self.pairs[circuit.id]
            # an undetermined torque has no force
            if torque.multiplier and not torque.loose and all(wheel in self.modules for wheel in circuit.wheels):
                yield from self._of_pair(circuit, torque)

    def _of_pair(self, circuit: Circuit, torque: PairTorque) -> Iterator[WheelForce]:
        wheels = [self.setting.train.wheels[name][1] for name in circuit.wheels]
        # the pitch point of a contrate wheel varies along its face
        if any(wheel.kind == "contrate" for wheel in wheels):
            return
        loads = [float(each) * _MM * self.swings.get(circuit.id, 1.0) for each in torque.torques[:2]]
        if self._is_parallel(circuit):
            cosines = [-1.0 if wheel.internal else 1.0 for wheel in wheels]
            found = self._both(loads, [self._rolling_radius(circuit, at) for at in (0, 1)], cosines)
            parts = [(radius, self._parallel(circuit, at, push)) for at, (radius, push) in enumerate(found)]
        elif (crossing := _shaft_angle(self.setting, circuit)) is not None:
            middles = [self._middle(circuit, at, crossing) for at in (0, 1)]
            cosines = [cos(middle.cone(1)) for middle in middles]
            found = self._both(loads, [middle.radius(1) for middle in middles], cosines)
            parts = [
                (radius, bevel_force(push, middles[at].cone(1), self._angle(circuit), wheels[at].facing))
                for at, (radius, push) in enumerate(found)
            ]
        elif all(wheel.helix_angle is not None for wheel in wheels):
            drives = [torque.driver == name for name in circuit.wheels]
            parts = [self._skew(circuit, at, loads[at], drives[at]) for at in (0, 1)]
        else:
            return
        for name, load, (radius, force) in zip(circuit.wheels, loads, parts, strict=True):
            yield WheelForce(circuit.id, name, radius, *force, load / _MM)

    @staticmethod
    def _both(loads: Sequence[float], radii: Sequence[float], cosines: Sequence[float]) -> list[tuple[float, float]]:
        """Return the pitch radius and the tangential force of both wheels of a pair, equation (32) of docs/strength.md.

        loads     torques on the wheels
        radii     pitch radii
        cosines   cosines of the pitch cone angles: 1 for parallel axes, -1 for a ring gear
        """
        others = cosines[::-1]
        lever = sum(radius * other for radius, other in zip(radii, others, strict=True))
        force = abs(sum(abs(load) * other for load, other in zip(loads, others, strict=True)) / lever)
        return [(radius, copysign(force, load)) for radius, load in zip(radii, loads, strict=True)]

    def is_crossed(self, circuit: Circuit) -> bool:
        """Return True for a pair of helical wheels, or of a worm and its wheel, on crossed axes."""
        if any(self._wheel(circuit, at).kind not in ("spur", "worm") for at in (0, 1)):
            return False
        return not self._is_parallel(circuit) and _shaft_angle(self.setting, circuit) is None

    def crossed_wheels(self, circuit: Circuit) -> CrossedWheels:
        """Return the geometry of two wheels on crossed axes. Their helix angles and modules must be known."""
        wheels = [self._wheel(circuit, at) for at in (0, 1)]
        widths = [face_width(self.setting.train, wheel) for wheel in wheels]
        first, second = (float("inf") if width is None else _MM * width.si for width in widths)
        addenda = self.involute_of(circuit).addendum
        return CrossedWheels(
            (self._radius(circuit, 0), self._radius(circuit, 1)),
            self.setting.helix_angles(circuit) or (0.0, 0.0),
            _MM * self.modules[circuit.wheels[0]] / wheels[0].slant,
            self._angle(circuit),
            (float(addenda[0].value), float(addenda[1].value)),
            (first, second),
        )

    def involute_of(self, circuit: Circuit) -> Involute:
        """Return the declared tooth form of wheels on crossed axes, or standard involutes if none is declared."""
        form = self.setting.train.form_of(self.setting.gears[circuit.id])
        return form if isinstance(form, Involute) else Involute(form="involute")

    def _is_parallel(self, circuit: Circuit) -> bool:
        return self.setting.axes.are_parallel(self.setting.axis_labels(circuit))

    def _wheel(self, circuit: Circuit, at: int) -> Wheel:
        return self.setting.train.wheels[circuit.wheels[at]][1]

    def _radius(self, circuit: Circuit, at: int) -> float:
        """Return the pitch radius of wheel `at` of a pair, 0 or 1 [mm], from module, tooth count and helix."""
        wheel = self._wheel(circuit, at)
        normal = self.modules[circuit.wheels[at]] / wheel.slant
        return _MM * normal * (wheel.count or 0) / 2 / cos(wheel.helix)

    def _angle(self, circuit: Circuit) -> float:
        """Return the normal pressure angle of a pair without a path of contact [rad]."""
        form = self.setting.train.form_of(self.setting.gears[circuit.id])
        return NORMAL_ANGLE if form is None or form.rack_angle is None else form.rack_angle

    def _rolling_radius(self, circuit: Circuit, at: int) -> float:
        """Return the operating pitch radius of a wheel [mm], which a profile shift of involutes changes."""
        radius, mesh = self._radius(circuit, at), self.meshes.get(circuit.id)
        if mesh is None:
            return radius
        if mesh.path is None:
            return radius * (1.0 if mesh.own_size is None else mesh.own_size.stretch)
        axle = mesh.path.pitch.axle_of(mesh.gears.index(circuit.wheels[at]) + 1)
        return radius * abs(axle) / ((self._wheel(circuit, at).count or 0) / 2)

    def _parallel(self, circuit: Circuit, at: int, push: float) -> WheelParts:
        wheel, mesh = self._wheel(circuit, at), self.meshes.get(circuit.id)
        # a ring is pushed outwards
        outwards = -1 if wheel.internal else 1
        # the lead is the same at all radii, so the helix angle increases with the radius
        lean = tan(wheel.helix) * self._rolling_radius(circuit, at) / self._radius(circuit, at)
        apart = separation(self.setting, circuit, mesh)
        # 0.0 - x instead of -x avoids -0.0 for spur wheels
        return push, 0.0 - push * lean, None if apart is None else outwards * abs(push) * apart

    def _skew(self, circuit: Circuit, at: int, load: float, drives: bool) -> tuple[float, WheelParts]:
        """Return the pitch radius of a wheel on crossed axes [mm], and its tangential, axial and radial force [N]. The
        forces include friction along the teeth.
        """
        helix = self.setting.helix_angles(circuit) or (0.0, 0.0)
        friction = self.setting.train.friction_of(self.setting.gears[circuit.id])
        angle, radius = self._angle(circuit), self._radius(circuit, at)
        sliding = 0.0 if friction is None or friction.sliding is None else friction.sliding
        # friction opposes sliding, whose sense depends on both helix angles
        sense = (1 if tan(helix[0]) + tan(helix[1]) >= 0 else -1) * (-1 if drives else 1)
        return radius, helical_force(load / radius, helix[at], angle, sense * friction_angle(sliding, angle))

    def _middle(self, circuit: Circuit, at: int, crossing: float) -> ConeMiddle:
        """Return the pitch cones of a bevel pair at the middle of the face width, or at the large ends if the face
        width is not known.
        """
        own, mate = self._wheel(circuit, at), self._wheel(circuit, 1 - at)
        widths = [_MM * width.si for each in (own, mate) if (width := face_width(self.setting.train, each)) is not None]
        # angles of the pitch cones depend only on the tooth numbers and the shaft angle
        cones = PitchSurfaces.cones(own.count or 1, mate.count or 1, crossing)
        return ConeMiddle(cones, _MM * self.modules[circuit.wheels[at]], min(widths, default=0.0))


def _shaft_angle(setting: LoadCase, circuit: Circuit) -> float | None:
    """Return the shaft angle of intersecting axes [rad], or None for other axes."""
    try:
        return shaft_angle(setting.train, setting.tree, circuit)
    except RangeError:
        return None


# ----------------------------------------------------------------------------------------------------- at a pitch point


class PitchForce(NamedTuple):
    """Force on a wheel from its mate at the pitch point, in the unit of the tangential force."""

    tangential: float
    """Tangential force with the sign of the torque, in the unit of the given force."""
    axial: float
    """Axial force, positive in the direction of the wheel's axis."""
    radial: float
    """Radial force, positive towards the wheel's axis. It is negative for a ring gear, which is pushed outwards."""


def helical_force(tangential: float, helix: float, pressure_angle: float, friction_angle: float = 0.0) -> PitchForce:
    """Return the force on a wheel at its pitch point, equation (18) of docs/strength.md.

    tangential       torque divided by pitch radius, in any unit of force
    helix            helix angle [rad], positive for a right-hand helix; 0 for spur wheels, near pi/2 for a worm
    pressure_angle   normal pressure angle [rad]
    friction_angle   friction angle along the teeth [rad]; negative for the driver, positive for the driven wheel, or
                     reversed if the helix angles reverse the sliding; 0 on parallel axes

    A right-hand driver with 10 N along its pitch circle turns in the positive sense about its axis, against the torque
    of its mate. The thrust is in the direction of the axis:

    >>> from math import radians
    >>> force = helical_force(-10.0, radians(30), radians(20))
    >>> round(force.axial, 4), round(force.radial, 4)
    (5.7735, 4.2028)
    """
    lean = helix + friction_angle
    # component N cos(alpha) of the normal force in the pitch plane, divided by the tangential force
    across = cos(friction_angle) / cos(lean)
    return PitchForce(tangential, 0.0 - tangential * tan(lean), abs(tangential * across) * tan(pressure_angle))


def bevel_force(tangential: float, cone: float, pressure_angle: float, facing: int = 1) -> PitchForce:
    """Return the force on a straight bevel gear at its pitch point, equation (19) of docs/strength.md.

    `cone` is the half-angle of its pitch cone [rad]. `facing` is 1 if the direction of the wheel's axis points from the
    apex towards the wheel, and -1 if it points away from the wheel. The axial force acts away from the apex.
    """
    apart = abs(tangential) * tan(pressure_angle)
    # the separating force is perpendicular to the pitch cone
    return PitchForce(tangential, facing * apart * sin(cone), apart * cos(cone))


def friction_angle(friction: float, pressure_angle: float) -> float:
    """Return the friction angle along the teeth [rad], atan(mu / cos(pressure angle)) for the coefficient mu."""
    return atan(friction / cos(pressure_angle))
