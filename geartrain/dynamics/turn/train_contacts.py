"""From a declared train in one case to the contacts of all its pairs: which law, which friction, which side drives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.pair_speeds import pitch_line_speed, radians_per_second
from geartrain.dynamics.torques.mean_efficiencies import find_mean_efficiencies
from geartrain.dynamics.torques.power_flow import has_torque_units
from geartrain.dynamics.turn.pair_contact import (
    BasicEfficiency,
    ContactLosses,
    NoLosses,
    PairContact,
    PinFriction,
    ToothFriction,
)
from geartrain.teeth.friction_law import PairFriction

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.turn.position_motion import PositionMotion
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.gear_mesh import GearMesh


def followed_pairs(setting: LoadCase, teeth: Mapping[str, GearMesh]) -> set[str]:
    """The pairs that have to be followed: their ratio depends on their position, or what they lose does."""
    names = {circuit.id for circuit in setting.circuits}
    uneven = {name for name, mesh in teeth.items() if not mesh.rigid or _by_friction(setting, mesh)}
    return names & {*uneven, *setting.joints}


def find_contacts(
    setting: LoadCase, positions: PositionMotion, teeth: Mapping[str, GearMesh]
) -> dict[str, PairContact]:
    """The contact of every pair and coupling, by name.

    positions   with the pairs that are followed position by position; others have a constant ratio
    teeth       real teeth with the wheel driving whose law is followed
    """
    found = {}
    for circuit in setting.circuits:
        source = positions.sources.get(circuit.id)
        contact = _contact(setting, circuit, source, teeth.get(circuit.id))
        if source is not None:
            contact = replace(contact, way=positions.way * source.forward, sense=positions.way * source.sense)
        found[circuit.id] = contact
    return found


def mean_friction_pairs(
    setting: LoadCase, sources: Mapping[str, PairErrorSource], teeth: Mapping[str, GearMesh]
) -> Iterator[str]:
    """The pairs whose friction is counted by its mean: redundant ones, of whose position the motion does not tell."""
    names = {circuit.id for circuit in setting.circuits} - sources.keys()
    return (name for name in teeth if name in names and _by_friction(setting, teeth[name]))


def _by_friction(setting: LoadCase, mesh: GearMesh) -> bool:
    gear = setting.gears[mesh.name]
    return gear.efficiency is None and setting.rubs(gear)


def _contact(setting: LoadCase, circuit: Circuit, source: PairErrorSource | None, mesh: GearMesh | None) -> PairContact:
    first = circuit.kind == "gear" and (mesh is None or mesh.driver == circuit.wheels[0])
    losses = _pin_losses(setting, circuit) if circuit.kind != "gear" else _losses(setting, circuit, first, source, mesh)
    if source is not None:
        return PairContact(circuit, first, source.forward, source.sense, float(source.law.ratio), losses, source)
    own, other = (circuit.a, circuit.b) if first else (circuit.b, circuit.a)
    return PairContact(circuit, first, 1, -1 if circuit.a * circuit.b > 0 else 1, abs(own / other), losses)


def _pin_losses(setting: LoadCase, circuit: Circuit) -> ContactLosses:
    joint, friction = setting.joints.get(circuit.id), setting.train.friction_of(setting.couplings[circuit.id])
    if joint is None or friction is None or not friction.rubs:
        return NoLosses()
    return PinFriction(joint.law, joint.law.friction, friction.static)


def _losses(
    setting: LoadCase, circuit: Circuit, first: bool, source: PairErrorSource | None, mesh: GearMesh | None
) -> ContactLosses:
    """What a gear pair loses: by its friction at each position, or the same part everywhere."""
    if source is not None and mesh is not None and _by_friction(setting, mesh):
        return _tooth_friction(setting, circuit, source, mesh)
    means = find_mean_efficiencies(setting, circuit).load
    driver, driven = (float(each) for each in (means if first else means[::-1]))
    return NoLosses() if driver == driven == 1 else BasicEfficiency(driver, driven)


def _tooth_friction(setting: LoadCase, circuit: Circuit, source: PairErrorSource, mesh: GearMesh) -> ToothFriction:
    law, coefficient = mesh.wheels.friction_law, mesh.friction or 0.0
    declared = setting.train.friction_of(setting.gears[circuit.id])
    static = coefficient if declared is None else declared.static
    if law is None:
        return ToothFriction(coefficient, static)
    pitch_line = pitch_line_speed(setting, circuit, mesh).known() / (source.mean or 1.0)
    return ToothFriction(lambda sliding, turning: PairFriction(law, pitch_line * turning)(sliding), static)


class BearingTorques(NamedTuple):
    """Friction torque of a bearing while it turns, and at rest; and viscous drag for a unit of the input's speed."""

    sliding: float
    static: float
    drag: float = 0.0


def find_bearings(setting: LoadCase) -> dict[str, BearingTorques]:
    """The links whose bearing rubs, or that drag where it is known how fast they turn."""
    train, unit = setting.train, _radians_per_second(setting)
    found = {}
    for link, part in train.links.items():
        sliding, static = (0.0, 0.0) if part.bearing is None else (
            float(part.bearing.sliding.base), float(part.bearing.at_rest.base)
        )  # fmt: skip
        each = BearingTorques(sliding, static, 0.0 if part.drag is None else part.drag.si * (unit or 0.0))
        if link != train.frame and any(each):
            found[link] = each
    return found


def dragging_links(setting: LoadCase) -> tuple[str, ...]:
    """Links whose viscous drag is not counted: nothing says how fast they turn, or torques are plain numbers."""
    links = tuple(link for link, part in setting.train.links.items() if part.drag is not None and part.drag.si)
    return () if _radians_per_second(setting) else links


def _radians_per_second(setting: LoadCase) -> float | None:
    """Of the input, by magnitude; None where speeds or torques are plain numbers."""
    unit = radians_per_second(setting.train, setting.case)
    lead = next((speed for speed in setting.case.inputs.values() if speed), None)
    if unit is None or lead is None or not has_torque_units(setting.train, setting.case.state):
        return None
    return unit * abs(float(lead))
