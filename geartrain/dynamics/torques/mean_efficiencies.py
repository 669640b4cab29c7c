"""Mean efficiency of a pair, declared or computed from its teeth or pin by equations (17) to (20) of docs/torques.md.

With the speed ratio tau and the efficiency eta at each position, the mean efficiency is mean(eta) if the driver's
torque is constant, and mean(tau)/mean(tau/eta) if the driven side's torque is constant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import cos, radians, tan

from geartrain.dynamics.gear_meshes import PinMesh
from geartrain.dynamics.pair_speeds import at_speed, pitch_line_speed
from geartrain.dynamics.torques.load_case import LoadCase, MeanEfficiencies
from geartrain.dynamics.torques.torque_balance import TorqueBalance
from geartrain.kinematics.circuits import Circuit
from geartrain.teeth.pair_results import SlidingEfficiency

NORMAL_ANGLE = radians(20)
"""Normal pressure angle that is used if no tooth form specifies it [rad]."""
_ROUNDING = 1e-9  # amount by which rounding in the quadrature may make a mean exceed 1


def all_mean_efficiencies(setting: LoadCase) -> Mapping[str, MeanEfficiencies]:
    """Return the mean efficiencies of each pair and coupling, by name."""
    return {circuit.id: find_mean_efficiencies(setting, circuit) for circuit in setting.circuits}


def find_mean_efficiencies(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies:
    """Return the mean efficiencies of one pair or coupling. They do not depend on the loads, and are cached."""
    if circuit.id not in setting.means:
        setting.means[circuit.id] = _of_circuit(setting, circuit)
    return setting.means[circuit.id]


def _of_circuit(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies:
    """Return the mean efficiencies of a gear pair or coupling; 1 if no loss is declared, or if data are missing."""
    if circuit.kind != "gear":
        return _of_coupling(setting, circuit)
    gear = setting.gears[circuit.id]
    if gear.efficiency is not None:
        declared = gear.efficiency.forward.base, gear.efficiency.backward.base
        return MeanEfficiencies(declared, declared)
    if (screw := _of_screw(setting, circuit)) is not None:
        return screw
    if not setting.has_friction(gear) or circuit.id not in setting.meshes:
        return MeanEfficiencies()
    tooth = setting.meshes[circuit.id]
    if tooth.wheels.friction_law is not None:
        speed = pitch_line_speed(setting, circuit, tooth)
        # undetermined relative motion: `find_neglected_effects` reports these losses
        if speed is None:
            return MeanEfficiencies()
        tooth = at_speed(tooth, speed)
    return _of_both(*(tooth.efficiency(wheel) for wheel in gear.pair))


def _of_screw(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies | None:
    """Return the mean efficiencies of a worm drive or crossed helical gears; None without helix angles or friction."""
    gear = setting.gears[circuit.id]
    friction = setting.train.friction_of(gear)
    if friction is None or friction.sliding is None:
        return None
    helix = setting.helix_angles(circuit)
    if helix is None:
        return None
    form = setting.train.form_of(gear)
    angle = NORMAL_ANGLE if form is None or form.rack_angle is None else form.rack_angle
    # 15 digits, so that equal efficiencies are equal fractions
    found = [Fraction(f"{screw_efficiency(*pair, friction.sliding, angle):.15g}") for pair in (helix, helix[::-1])]
    # a screw gear has a constant ratio, so both torques may be constant
    return MeanEfficiencies((found[0], found[1]), (found[0], found[1]), exact=False)


def _of_coupling(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies:
    """Return the mean efficiencies of a coupling, whose first link is its driven link; 1 for a pin follower."""
    coupling = setting.couplings[circuit.id]
    if (losses := coupling.losses) is not None and circuit.b:
        both = losses.backward.base, losses.forward.base
        return MeanEfficiencies(both, both, exact=coupling.efficiency is not None)
    joint = setting.joints.get(circuit.id)
    if not isinstance(joint, PinMesh) or not joint.transmission.friction or not circuit.b:
        return MeanEfficiencies()
    return _of_both(SlidingEfficiency(joint.reversed), SlidingEfficiency(joint.transmission))


def _of_both(ahead: SlidingEfficiency, back: SlidingEfficiency) -> MeanEfficiencies:
    driver = _mean(ahead.mean), _mean(back.mean)
    load = _mean(ahead.at_constant_load), _mean(back.at_constant_load)
    return MeanEfficiencies(driver, load, exact=False)


def _mean(efficiency: float | None) -> Fraction:
    """Return a mean efficiency as a fraction with 15 digits; 0 if it is None because friction locks the pair."""
    if efficiency is None:
        return Fraction(0)
    # rounding in the quadrature may exceed 1 slightly; decimal digits keep 0.98 equal to 49/50
    return Fraction(1) if 1 < efficiency < 1 + _ROUNDING else Fraction(f"{efficiency:.15g}")


def apply_mean_efficiencies(
    balance: TorqueBalance, means: Mapping[str, MeanEfficiencies], driving: bool
) -> tuple[TorqueBalance, tuple[str, ...]]:
    """Return the balance with the mean efficiency of each pair, and the names of the pairs whose mean efficiency is
    uncertain.

    The mean efficiency depends on which torque of the pair is constant over a turn. It is uncertain if neither is
    constant.
    """
    if not any(each.differ for each in means.values()):
        return balance, ()
    given, meshes = _given(balance), []
    for mesh in balance.meshes:
        forward, backward = means[mesh.id].given(given.get(mesh.id, 0), driving)
        meshes.append(replace(mesh, forward=forward, backward=backward))
    neither = tuple(mesh.id for mesh in meshes if means[mesh.id].differ and not given.get(mesh.id))
    return replace(balance, meshes=tuple(meshes)), neither


def _given(balance: TorqueBalance) -> dict[str, int]:
    """Return, for each pair with a constant torque, 1 if this torque acts on the first link and -1 if it acts on the
    second link, by pair.
    """
    found: dict[str, int] = {}
    for block in balance.parts:
        # rows beyond those of the links are declared shares, not balances
        if len(block.rows) != 1 or len(block.columns) != 1 or block.rows[0] >= len(balance.links):
            continue
        link, column = balance.links[block.rows[0]], balance.columns[block.columns[0]]
        first = next((mesh for mesh in column.meshes if link in mesh.links), None)
        # the carrier is neither the first nor the second link
        side = 0 if first is None else {first.links[0]: 1, first.links[1]: -1}.get(link, 0) * first.turn
        # equal planets share one unknown torque, and may name their wheels in different orders
        found |= {mesh.id: side * mesh.turn for mesh in column.meshes}
    return found


# ------------------------------------------------------------------------------------------------------------ skew axes


def screw_efficiency(driving: float, driven: float, friction: float, pressure_angle: float = NORMAL_ANGLE) -> float:
    """Return the efficiency of a screw gear pair, equation (12c) of docs/theory.md; 0 or less means self-locking.

    driving, driven   helix angles of the driving and driven wheel [rad], positive for right-hand helices
    pressure_angle    normal pressure angle [rad]

    Only sliding along the teeth at the pitch point is considered; sliding along the profile is small compared with it.
    """
    slide = tan(driving) + tan(driven)
    # the normal force on an inclined flank is larger by 1 / cos(pressure angle)
    rough = friction / cos(pressure_angle) * (1 if slide >= 0 else -1)
    return (1 - rough * tan(driven)) / (1 + rough * tan(driving))
