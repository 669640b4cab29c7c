"""What a balance of mean torques does not count, named: friction without a share of the power, swings within a turn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import inf

from geartrain.circuits import Circuit
from geartrain.exact import as_float, decimal
from geartrain.torques.losses import Means
from geartrain.torques.result import LeftOut
from geartrain.torques.reversing import Bounds, turning_back
from geartrain.torques.setting import Setting

_MEAN = "the torques given are means over a turn"


def find_omissions(
    setting: Setting,
    means: Mapping[str, Means],
    neither: Sequence[str],
    idle: Sequence[str],
    bearings: bool,
) -> tuple[LeftOut, ...]:
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
            "neither torque of these pairs is constant within a turn, so that their mean efficiency hangs on the "
            "others; the one at a constant load, or a constant driver's torque where loads drive, is taken"
        )
        found.append(LeftOut("mean efficiency", shared, why))
    return (*found, *_swing(setting, busy), *_inertia(setting))


def _pins(setting: Setting, busy: Sequence[Circuit]) -> Iterator[LeftOut]:
    """Friction of pins that is no share of the power that passes."""
    couplings = setting.couplings
    rubbing = [circuit for circuit in busy if circuit.kind != "gear" and _rubs(couplings[circuit.id].friction)]
    if swinging := tuple(circuit.id for circuit in rubbing if not circuit.b):
        why = "a follower only swings: it passes no power on average, of which its friction could be a share"
        yield LeftOut("friction of pins", swinging, why)
    if bare := tuple(circuit.id for circuit in rubbing if circuit.b and circuit.id not in setting.joints):
        yield LeftOut("friction of pins", bare, "it hangs on `pin_radius` and `offset`, which are not declared")


def _teeth(setting: Setting, busy: Sequence[Circuit], means: Mapping[str, Means]) -> Iterator[LeftOut]:
    """Friction declared on teeth that have no form."""
    found = []
    for circuit in busy:
        gear = setting.gears.get(circuit.id)
        if gear is None or gear.efficiency is not None or circuit.id in setting.meshes:
            continue
        rubs = _rubs(gear.friction or setting.train.friction) and means[circuit.id] == Means()
        if rubs and setting.relative(circuit.i, circuit.carrier) != 0:
            found.append(circuit.id)
    if found:
        why = "these teeth have no form of which it could take anything: give a `tooth_form`, or an `efficiency`"
        yield LeftOut("friction of teeth", tuple(found), why)


def _open(setting: Setting, busy: Sequence[Circuit], means: Mapping[str, Means]) -> Iterator[LeftOut]:
    """Losses of pairs that roll nobody knows which way."""
    found = tuple(
        circuit.id
        for circuit in busy
        if means[circuit.id] != Means() and setting.relative(circuit.i, circuit.carrier) is None
    )
    if found:
        yield LeftOut("losses of pairs", found, "who drives there hangs on speeds that are not determined")


def _rubbing(setting: Setting) -> list[str]:
    return [link for link in setting.train.links if setting.bearing(link)]


def _all_bearings(setting: Setting) -> Iterator[LeftOut]:
    if rubbing := _rubbing(setting):
        why = "it does not grow with the load, and is no share of it"
        yield LeftOut("friction of bearings", tuple(rubbing), why)


def _bearings(setting: Setting) -> Iterator[LeftOut]:
    """Bearings that turn nobody knows which way, or now this way and now that."""
    rubbing = _rubbing(setting)
    free = tuple(link for link in rubbing if setting.relative(link, setting.tree.parent[link][0]) is None)
    if free:
        yield LeftOut("friction of bearings", free, "which way they turn is not determined")
    known = [link for link in rubbing if link not in free]
    back = turning_back(setting, known)
    if back is None:
        why = "it is counted at the mean speeds; too many uneven pairs stand before them to ask whether they turn back"
        yield LeftOut("friction of bearings that turn back", tuple(known), why)
        return
    for link, bounds in back.items():
        mean = setting.relative(link, setting.tree.parent[link][0])
        yield LeftOut("friction of bearings that turn back", (link,), _turns(bounds, mean or Fraction(0)))


def _turns(bounds: Bounds, mean: Fraction) -> str:
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


def _swing(setting: Setting, busy: Sequence[Circuit]) -> Iterator[LeftOut]:
    """Pairs whose torques are not the same at every angle."""
    found = []
    for circuit in busy:
        tooth = setting.meshes.get(circuit.id)
        declared = circuit.kind == "gear" and setting.gears[circuit.id].efficiency is not None
        if circuit.kind != "gear" or (tooth is not None and (not tooth.rigid or (tooth.rubs and not declared))):
            found.append(circuit.id)
    if found:
        yield LeftOut("swing within a turn", tuple(found), f"{_MEAN}: at single angles they are more and less")


def _inertia(setting: Setting) -> Iterator[LeftOut]:
    """Masses that uneven pairs set swinging."""
    heavy = tuple(link for link, part in setting.train.links.items() if part.inertia is not None)
    uneven = any(circuit.kind != "gear" for circuit in setting.circuits)
    if heavy and (uneven or any(not tooth.rigid for tooth in setting.meshes.values())):
        yield LeftOut("inertia", heavy, "torques are those of slow turning: no acceleration and no blow is counted")


def _rubs(friction: object) -> bool:
    return bool(getattr(friction, "value", 0))
