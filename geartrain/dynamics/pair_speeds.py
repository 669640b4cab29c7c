"""Pitch-line speed of a gear pair, V = |w_i - w_k| r_i, for friction that depends on speed (equation (17a) of
docs/torques.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.quantity import RADIANS_PER_TURN

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import StateCase, Train


def radians_per_second(train: Train, case: StateCase) -> float | None:
    """Return the train's unit of speed, expressed in rad/s; None if its speeds are numbers without a unit.

    Speeds have a unit if the train declares a `rate`, which is the speed of the first input that turns, or if its
    inputs have units.
    """
    driving_speed = next((speed for speed in case.inputs.values() if speed), None)
    if case.rate is not None and case.rate.unit is not None and driving_speed is not None:
        # a rate scales the declared speeds of all links by the same factor
        return abs(case.rate.si / float(driving_speed))
    if not train.input_unit or train.unit_speed is None:
        return None
    return float(train.unit_speed * RADIANS_PER_TURN)


def pitch_line_speed(setting: LoadCase, circuit: Circuit, mesh: GearMesh) -> float | None:
    """Return the pitch-line speed of one gear pair in one state [m/s]; None if its relative motion is undetermined.

    Raises `GearTrainError`, which names the missing data, if the speed does not follow from the declaration.
    """
    turning = setting.relative(circuit.i, circuit.carrier)
    if turning is None:
        return None
    unit, radius = radians_per_second(setting.train, setting.case), mesh.pitch_radius
    missing = []
    if unit is None:
        missing.append(("the speed of the train", "`rate`, such as `rate: 1 turn/s`"))
    if radius is None:
        missing.append(("the size of its wheels", "the `module` of both wheels with a unit, such as `module: 1 mm`"))
    if missing:
        what = f"{mesh.label}: friction depends on the pitch-line speed, which is unknown"
        why = f"the declaration does not give {' or '.join(words for words, _ in missing)}"
        fix = f"give {', and '.join(keys for _, keys in missing)}; or give `friction` as a number"
        raise GearTrainError(Problem(what, why, fix, mesh.place))
    assert unit is not None
    assert radius is not None
    # the radius is that of the pair's first wheel, so its speed is needed
    first = mesh.gear.pair[0] in setting.train.links[circuit.i].wheels
    other = setting.relative(circuit.j, circuit.carrier)
    if not first and other is not None:
        turning = other
    return abs(float(turning)) * unit * radius


def at_speed(mesh: GearMesh, speed: float | None) -> GearMesh:
    """Return the mesh with the friction coefficient at a pitch-line speed [m/s]. A mesh whose friction does not depend
    on speed is returned unchanged.
    """
    if mesh.wheels.friction_law is None:
        return mesh
    return replace(mesh, wheels=replace(mesh.wheels, pitch_line=speed))


def at_own_speeds(meshes: Sequence[GearMesh], setting: LoadCase | None) -> tuple[GearMesh, ...]:
    """Return the meshes with the friction coefficients at their pitch-line speeds, or without a coefficient if the
    friction law needs a speed that is unknown.
    """
    if setting is None:
        return tuple(meshes)
    circuits = {circuit.id: circuit for circuit in setting.circuits}
    found = []
    for mesh in meshes:
        try:
            found.append(at_speed(mesh, pitch_line_speed(setting, circuits[mesh.name], mesh)))
        except GearTrainError:  # the speed is needed only where losses are computed
            found.append(at_speed(mesh, None))
    return tuple(found)
