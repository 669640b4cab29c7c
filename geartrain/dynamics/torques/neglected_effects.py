"""What a balance of mean torques does not count, by name: the table in section 13 of docs/torques.md."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import inf

from geartrain.dynamics.torques.bearing_reversal import SpeedBounds, find_reversing_bearings
from geartrain.dynamics.torques.load_case import LoadCase
from geartrain.dynamics.torques.mean_efficiencies import all_mean_efficiencies
from geartrain.dynamics.torques.pair_means import MeanEfficiencies
from geartrain.dynamics.torques.torque_results import NeglectedEffect
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.exact import as_float

_NO_FORM = "these teeth have no form of which it could take anything: give a `tooth_form`, or an `efficiency`"
_NO_LEAD = (
    "these teeth slide along each other: declare the `helix_angle` of the worm, or of both wheels, on axes that cross, "
    "and a constant `friction`; or an `efficiency`"
)
_MEAN = "the torques given are means over a turn"


def find_neglected_effects(
    setting: LoadCase,
    means: Mapping[str, MeanEfficiencies],
    neither: Sequence[str],
    idle: Sequence[str],
    bearings: bool,
) -> tuple[NeglectedEffect, ...]:
    """Everything that the torques of one case leave out.

    neither   pairs of whose torques neither is constant over a turn
    idle      pairs that carry nothing: what they might lose is not missed
    bearings  False where friction of bearings was not asked for
    """
    busy = [circuit for circuit in setting.circuits if circuit.id not in set(idle)]
    found = [*_pins(setting, busy), *_teeth(setting, busy, means), *_open(setting, busy, means)]
    found += _bearings(setting) if bearings else _all_bearings(setting)
    shared = tuple(circuit.id for circuit in busy if circuit.id in set(neither))
    if shared:
        why = (
            "neither torque of these pairs is constant within a turn, so that their mean efficiency depends on the "
            "others; the one at a constant load, or a constant driver's torque where loads drive, is taken"
        )
        found.append(NeglectedEffect("mean efficiency", shared, why))
    return (*found, *_drag(setting), *_swing(setting, busy), *_inertia(setting))


def _drag(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Viscous drag, which a balance of exact means does not count."""
    if links := tuple(link for link, part in setting.train.links.items() if part.drag is not None and part.drag.value):
        yield NeglectedEffect(
            "viscous drag", links, "it is by speed: torques over a turn count it where speeds are real"
        )


def neglected_over_turn(setting: LoadCase, at_means: Sequence[str]) -> tuple[NeglectedEffect, ...]:
    """What torques over a turn leave out: nothing of pins, bearings and swing, where what they need is declared.

    at_means   pairs with real teeth that lose their mean share everywhere
    """
    found = [
        *_bare_pins(setting, setting.circuits),
        *_teeth(setting, setting.circuits, all_mean_efficiencies(setting)),
        *_inertia(setting),
    ]
    if at_means:
        why = "they are redundant, and nothing says at which part of its pitch each of them works: the mean is taken"
        found.append(NeglectedEffect("swing within a turn", tuple(at_means), why))
    return tuple(found)


def _pins(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Friction of pins that is no share of the power that passes."""
    couplings = setting.couplings
    rubbing = [circuit for circuit in busy if circuit.kind != "gear" and setting.rubs(couplings[circuit.id])]
    if swinging := tuple(circuit.id for circuit in rubbing if not circuit.b):
        why = "a follower only swings: it passes no power on average, of which its friction could be a share"
        yield NeglectedEffect("friction of pins", swinging, why)
    yield from _bare_pins(setting, [circuit for circuit in rubbing if circuit.b])


def _bare_pins(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Friction declared on pins that have no dimensions."""
    couplings = setting.couplings
    rubbing = [circuit.id for circuit in busy if circuit.kind != "gear" and setting.rubs(couplings[circuit.id])]
    if bare := tuple(name for name in rubbing if name not in setting.joints):
        why = "it depends on `pin_radius` and `offset`, which are not declared"
        yield NeglectedEffect("friction of pins", bare, why)


def _teeth(
    setting: LoadCase, busy: Sequence[Circuit], means: Mapping[str, MeanEfficiencies]
) -> Iterator[NeglectedEffect]:
    """Friction declared on teeth that have no form, and on worms of unknown lead."""
    bare: dict[str, list[str]] = {_NO_FORM: [], _NO_LEAD: []}
    for circuit in busy:
        gear = setting.gears.get(circuit.id)
        if gear is None or gear.efficiency is not None or circuit.id in setting.meshes:
            continue
        rubs = setting.rubs(gear) and means[circuit.id] == MeanEfficiencies()
        if rubs and setting.relative(circuit.i, circuit.carrier) != 0:
            bare[_NO_LEAD if _slides(setting, circuit) else _NO_FORM].append(circuit.id)
    for why, names in bare.items():
        if names:
            yield NeglectedEffect("friction of teeth", tuple(names), why)


def _slides(setting: LoadCase, circuit: Circuit) -> bool:
    """True for worms, and helical wheels on axes that are not parallel: no tooth form of theirs has a mean loss."""
    wheels = [setting.train.wheels[name][1] for name in circuit.wheels]
    helical = any(wheel.is_helical for wheel in wheels) and not setting.axes.are_parallel(setting.axis_labels(circuit))
    return helical or any(wheel.kind == "worm" for wheel in wheels)


def _open(
    setting: LoadCase, busy: Sequence[Circuit], means: Mapping[str, MeanEfficiencies]
) -> Iterator[NeglectedEffect]:
    """Losses of pairs whose direction of rolling is not determined."""
    found = tuple(
        circuit.id
        for circuit in busy
        if (means[circuit.id] != MeanEfficiencies() or _at_no_speed(setting, circuit))
        and setting.relative(circuit.i, circuit.carrier) is None
    )
    if found:
        yield NeglectedEffect("losses of pairs", found, "who drives there depends on speeds that are not determined")


def _at_no_speed(setting: LoadCase, circuit: Circuit) -> bool:
    """True for teeth whose friction asks for a speed, which has no means where none is determined."""
    tooth = setting.meshes.get(circuit.id)
    declared = circuit.kind == "gear" and setting.gears[circuit.id].efficiency is not None
    return tooth is not None and not declared and tooth.wheels.friction_law is not None


def _rubbing(setting: LoadCase) -> list[str]:
    return [link for link in setting.train.links if setting.bearing(link)]


def _all_bearings(setting: LoadCase) -> Iterator[NeglectedEffect]:
    if rubbing := _rubbing(setting):
        why = "it does not grow with the load, and is no share of it"
        yield NeglectedEffect("friction of bearings", tuple(rubbing), why)


def _bearings(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Bearings whose direction of turning is not determined, or changes within a turn."""
    rubbing = _rubbing(setting)
    free = tuple(link for link in rubbing if setting.relative(link, setting.tree.parent[link][0]) is None)
    if free:
        yield NeglectedEffect("friction of bearings", free, "which way they turn is not determined")
    known = [link for link in rubbing if link not in free]
    back = find_reversing_bearings(setting, known)
    if back is None:
        why = "it is counted at the mean speeds; too many uneven pairs stand before them to ask whether they turn back"
        yield NeglectedEffect("friction of bearings that turn back", tuple(known), why)
        return
    for link, bounds in back.items():
        mean = setting.relative(link, setting.tree.parent[link][0])
        yield NeglectedEffect("friction of bearings that turn back", (link,), _turns(bounds, mean or Fraction(0)))


def _turns(bounds: SpeedBounds, mean: Fraction) -> str:
    """How far a bearing's loss is from that at its mean speed."""
    reach = f"the speed goes from {bounds.low:.4g} to {bounds.high:.4g}"
    what = f"it is counted at the mean speed {decimal(mean, 4)}, and {reach}"
    if bounds.magnitude is None or bounds.most is None:
        return f"{what} within a turn"
    if not mean:
        return f"{what} within a turn: nothing is counted of a mean magnitude of {bounds.magnitude:.4g}"
    size = abs(as_float(mean) or inf)
    return (
        f"{what} within a turn: what it takes is {bounds.magnitude / size:.3f} times as much on average, and "
        f"{bounds.most / size:.3f} times at its greatest"
    )


def _swing(setting: LoadCase, busy: Sequence[Circuit]) -> Iterator[NeglectedEffect]:
    """Pairs whose torques are not the same at every angle."""
    found = []
    for circuit in busy:
        tooth = setting.meshes.get(circuit.id)
        declared = circuit.kind == "gear" and setting.gears[circuit.id].efficiency is not None
        if circuit.swings or (tooth is not None and (not tooth.rigid or (tooth.rubs and not declared))):
            found.append(circuit.id)
    if found:
        yield NeglectedEffect("swing within a turn", tuple(found), f"{_MEAN}: at single angles they are more and less")


def _inertia(setting: LoadCase) -> Iterator[NeglectedEffect]:
    """Masses that uneven pairs set swinging."""
    heavy = tuple(link for link, part in setting.train.links.items() if part.inertia is not None)
    uneven = any(circuit.swings for circuit in setting.circuits)
    if heavy and (uneven or any(not tooth.rigid for tooth in setting.meshes.values())):
        yield NeglectedEffect(
            "inertia", heavy, "torques are those of slow turning: no acceleration and no blow is counted"
        )
