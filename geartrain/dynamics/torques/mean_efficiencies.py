"""What a pair loses: as declared, or the mean efficiency of its teeth or of its pin, equations (17) to (20).

docs/torques.md, section 12. Over a turn the torques on the two sides of a pair cannot both be constant. Where that of
the driver is, a part mean(eta) of the work arrives; where that of the driven side is, mean(tau)/mean(tau/eta). Which of
the two is given follows from the balance: the link whose own row determines the pair.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.dynamics.pair_speeds import at_speed, pitch_line_speed
from geartrain.dynamics.torques.load_case import LoadCase
from geartrain.dynamics.torques.torque_balance import LoadedPair, TorqueBalance
from geartrain.kinematics.circuits import Circuit
from geartrain.teeth.transmission_figures import SlidingEfficiency

_ONE = Fraction(1)
_ROUNDING = 1e-9  # by so much the quadrature of a mean may pass 1


@dataclass(frozen=True)
class MeanEfficiencies:
    """Efficiencies of one pair with the first link driving, then with the second.

    driver   where the torque of the driver is constant over a turn
    load     where the torque of the driven side is
    """

    driver: tuple[Fraction, Fraction] = (_ONE, _ONE)
    load: tuple[Fraction, Fraction] = (_ONE, _ONE)

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


def find_mean_efficiencies(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies:
    """What one pair or coupling loses; nothing where nothing is declared, or it has no dimensions."""
    if circuit.kind != "gear":
        return _of_pin(setting, circuit)
    gear = setting.gears[circuit.id]
    if gear.efficiency is not None:
        declared = gear.efficiency.forward.base, gear.efficiency.backward.base
        return MeanEfficiencies(declared, declared)
    tooth = setting.meshes.get(circuit.id)
    if tooth is None or not tooth.rubs:
        return MeanEfficiencies()
    if tooth.wheels.friction_law is not None:
        speed = pitch_line_speed(setting, circuit, tooth)
        if speed.value is None and speed.problem is None:
            return MeanEfficiencies()
        tooth = at_speed(tooth, speed.known())
    return _of_both(*(tooth.efficiency(wheel) for wheel in gear.pair))


def _of_pin(setting: LoadCase, circuit: Circuit) -> MeanEfficiencies:
    """The slot is first. A follower passes no power on average: what its pin loses is no share of anything."""
    joint = setting.joints.get(circuit.id)
    if joint is None or not joint.law.friction or not circuit.b:
        return MeanEfficiencies()
    return _of_both(SlidingEfficiency(joint.reversed), SlidingEfficiency(joint.law))


def _of_both(ahead: SlidingEfficiency, back: SlidingEfficiency) -> MeanEfficiencies:
    return MeanEfficiencies(
        (_mean(ahead.mean), _mean(back.mean)), (_mean(ahead.at_constant_load), _mean(back.at_constant_load))
    )


def _mean(efficiency: float | None) -> Fraction:
    """A mean over teeth, to 15 digits; 0 where friction locks."""
    if efficiency is None:
        return Fraction(0)
    # rounding of a quadrature may pass 1 by a little; digits in decimal, so that 0.98 stays 49/50
    return _ONE if 1 < efficiency < 1 + _ROUNDING else Fraction(f"{efficiency:.15g}")


def settle_mean_efficiencies(
    balance: TorqueBalance, means: Mapping[str, MeanEfficiencies], driving: bool
) -> tuple[TorqueBalance, tuple[str, ...]]:
    """The balance with the right mean efficiency of each pair, and the pairs neither torque of which is constant."""
    if not any(each.differ for each in means.values()):
        return balance, ()
    given = _given(balance)
    meshes = tuple(_with(mesh, means[mesh.id], given.get(mesh.id, 0), driving) for mesh in balance.meshes)
    neither = tuple(mesh.id for mesh in meshes if means[mesh.id].differ and not given.get(mesh.id))
    return replace(balance, meshes=meshes), neither


def _with(mesh: LoadedPair, means: MeanEfficiencies, side: int, driving: bool) -> LoadedPair:
    forward, backward = means.given(side, driving)
    return replace(mesh, forward=forward, backward=backward)


def _given(balance: TorqueBalance) -> dict[str, int]:
    """By pair, 1 where the balance of its first link alone determines its torque, -1 where that of its second does."""
    found: dict[str, int] = {}
    for block in balance.parts:
        if len(block.rows) != 1 or len(block.columns) != 1 or block.rows[0] >= len(balance.links):
            continue
        link, column = balance.links[block.rows[0]], balance.columns[block.columns[0]]
        side = next((_side(mesh, link) * mesh.turn for mesh in column.meshes if link in mesh.links), 0)
        # equal planets have one torque between them, and may name their wheels in another order
        found |= {mesh.id: side * mesh.turn for mesh in column.meshes}
    return found


def _side(mesh: LoadedPair, link: str) -> int:
    return {mesh.links[0]: 1, mesh.links[1]: -1}.get(link, 0)
