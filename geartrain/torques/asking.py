"""From a declared train in one case to its torques: what is known, what is asked for, and what each pair loses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import isnan

from geartrain.circuits import Circuit, Tree
from geartrain.meshes import Mesh as ToothMesh
from geartrain.torques.balance import Balance, Mesh
from geartrain.torques.directions import Flow, find_flows
from geartrain.torques.judging import Question, judge
from geartrain.torques.result import PairTorque, Torques, TorqueVerdict
from geartrain.torques.sharing import find_shares, find_ties
from geartrain.train import Case, GearPair, Train


@dataclass(frozen=True)
class Setting:
    """A train in one case, solved for its speeds: everything torques need to know of it."""

    train: Train
    tree: Tree
    circuits: Sequence[Circuit]
    signs: Mapping[str, int]
    case: Case
    speeds: Mapping[str, Fraction]
    teeth: Sequence[ToothMesh] = ()

    @cached_property
    def gears(self) -> Mapping[str, GearPair]:
        """Gear pairs by name."""
        return {gear.name: gear for gear in self.train.gears}

    @cached_property
    def meshes(self) -> Mapping[str, ToothMesh]:
        """Pairs with real teeth by name."""
        return {mesh.name: mesh for mesh in self.teeth}

    def sense(self, link: str) -> int:
        """1, or -1 where the link's axis points against its parallels."""
        return self.signs.get(link, 1)


def declared_loads(train: Train, case: Case) -> tuple[dict[str, Fraction], str | None]:
    """The loads of one case, N m or plain, and the link whose torque is named as unknown."""
    state = train.states[case.state] if case.state is not None else None
    loads = train.loads if state is None or state.loads is None else state.loads
    solve_for = train.solve_for if state is None or state.solve_for is None else state.solve_for
    return {link: torque.base for link, torque in loads.items()}, solve_for


def find_torques(setting: Setting) -> Torques:
    """Torques under the declared loads, or under the friction of bearings alone."""
    loads, solve_for = declared_loads(setting.train, setting.case)
    if not loads and not any(_bearings(setting).values()):
        text = "no load is declared: give `loads` on links, negative against their turning, or `bearing` friction"
        return Torques(setting.case.state, TorqueVerdict("unloaded", text))
    asked, verdict = _asked(setting, loads, solve_for)
    return _balanced(setting, loads, asked) if verdict is None else Torques(setting.case.state, verdict)


def drive(setting: Setting, load: str, source: str) -> Torques:
    """Torques while a resisting unit of power leaves at `load` and `source` is to drive it; bearings left out."""
    speed = setting.speeds.get(load)
    if not speed or not setting.speeds.get(source):
        return Torques(setting.case.state, TorqueVerdict("still", f"'{load if not speed else source}' does not turn"))
    return _balanced(setting, {load: -1 / speed}, (source,), bearings=False)


def _asked(
    setting: Setting, loads: Mapping[str, Fraction], solve_for: str | None
) -> tuple[tuple[str, ...], TorqueVerdict | None]:
    """The links whose torque is unknown, as many as there are inputs, or why that is not plain."""
    inputs, entries = setting.case.inputs, _entries(setting)
    free = tuple(link for link in entries if link not in loads)
    needed = len(inputs)
    if needed == 1 and solve_for is not None:
        free = (solve_for,)
    if len(free) == needed:
        return free, _still(setting, free)
    if len(free) > needed:  # the crank, and inputs of which one has no torque
        certain, candidates = free[:1], free[1:]
    else:
        links = dict.fromkeys(output.of or name for name, output in setting.case.outputs.items())
        certain, candidates = free, tuple(link for link in links if link not in loads and link not in free)
    candidates = (solve_for,) if solve_for else candidates
    missing = needed - len(certain)
    if len(candidates) == missing:
        return certain + candidates, None
    loaded = ", ".join(link for link in entries if link in loads)
    why = f"{loaded} carries a load" if loaded else f"power enters at {entries[0]}, which is no input"
    text = (
        f"{why}, so {missing} other torque{'s' if missing > 1 else ''} must be unknown, and "
        f"{len(candidates)} can be: name one with `solve_for`"
    )
    return (), TorqueVerdict("undecided", text, candidates)


def _entries(setting: Setting) -> tuple[str, ...]:
    """Where power may enter: the inputs, or, where only their speeds are given, the crank in place of one of them."""
    inputs, crank = tuple(setting.case.inputs), setting.train.crank
    if crank is None or crank in inputs:
        return inputs
    return (crank,) if len(inputs) == 1 else (crank, *inputs)


def _still(setting: Setting, asked: tuple[str, ...]) -> TorqueVerdict | None:
    """A link at rest moves nothing; a single input at rest is a train at rest, which balances."""
    speeds = setting.speeds
    if len(asked) == 1 and not speeds[asked[0]] and any(speeds[link] for link in setting.case.inputs):
        return TorqueVerdict("still", f"'{asked[0]}' does not turn, so no torque on it does any work")
    return None


def _balanced(
    setting: Setting, loads: Mapping[str, Fraction], asked: tuple[str, ...], bearings: bool = True
) -> Torques:
    rubbing = _bearings(setting) if bearings else {}
    known = dict(loads)
    for link, torque in rubbing.items():
        known[link] = known.get(link, Fraction(0)) + torque
    balance = _balance(setting, known, asked)
    found, complete = find_flows(balance)
    question = Question(balance, setting.speeds, loads, rubbing)
    # all else being known, the power asked for tells the order of losses
    flows = sorted(found, key=lambda flow: (len(flow.solved.open), question.power(flow)))
    verdict = judge(question, flows, complete)
    if not flows:
        return Torques(setting.case.state, verdict, asked)
    return _torques(setting, balance, flows[0], rubbing, verdict)


def _balance(setting: Setting, known: Mapping[str, Fraction], asked: tuple[str, ...]) -> Balance:
    case, train = setting.case, setting.train
    meshes = tuple(_mesh(setting, circuit) for circuit in setting.circuits)
    locks = tuple((a, b) for a, b in case.locks if a != b)
    held = {*asked, *case.fixed, *(link for lock in locks for link in lock)}
    shares = find_shares(train, setting.circuits, {*held, *known})
    shared = {name for _, parts in shares for name in parts}
    planets = {link for mesh in meshes if mesh.id in shared for link in mesh.links[:2]}
    return Balance(
        tuple(link for link in train.links if link != train.frame),
        meshes,
        known,
        asked,
        tuple(link for link in case.fixed if link != train.frame),
        tuple(((a, setting.sense(a)), (b, setting.sense(b))) for a, b in locks),
        find_ties(setting.circuits, meshes, known, held | planets),
        shares,
    )


def _mesh(setting: Setting, circuit: Circuit) -> Mesh:
    """A circuit as a path of power, with what its teeth lose."""
    i, j, k = circuit.i, circuit.j, circuit.carrier
    senses = (setting.sense(i), setting.sense(j), setting.sense(k))
    relative = senses[0] * setting.speeds[i] - senses[2] * setting.speeds[k]
    forward, backward = _efficiencies(setting, circuit)
    a, b = circuit.a, circuit.b
    if min(a, b, key=abs) < 0:  # the sign of a row is free: one for both orders of a planet and its ring
        a, b = -a, -b
    return Mesh(circuit.id, (i, j, k), senses, a, b, a * relative, forward, backward)


def _efficiencies(setting: Setting, circuit: Circuit) -> tuple[Fraction, Fraction]:
    """With the first wheel driving, and with the second: declared, or the mean of the teeth, or none lost."""
    if circuit.kind != "gear":
        return Fraction(1), Fraction(1)
    gear = setting.gears[circuit.id]
    if gear.efficiency is not None:
        return gear.efficiency.forward.base, gear.efficiency.backward.base
    tooth = setting.meshes.get(circuit.id)
    if tooth is None or not tooth.rubs:
        return Fraction(1), Fraction(1)
    laws = (tooth.law, tooth.reversed)
    ahead, back = (_mean(law.efficiency_mean()) for law in laws)
    return (ahead, back) if tooth.driver == gear.pair[0] else (back, ahead)


def _mean(efficiency: float) -> Fraction:
    """A mean over teeth, to 15 digits; 0 where friction locks."""
    return Fraction(0) if isnan(efficiency) else Fraction(f"{efficiency:.15g}")


def _bearings(setting: Setting) -> dict[str, Fraction]:
    """Friction of bearings against the turning of each link in its joint."""
    found: dict[str, Fraction] = {}
    for link, part in setting.train.links.items():
        if part.bearing is None or link == setting.train.frame:
            continue
        carrier = setting.tree.parent[link][0]
        own, other = setting.sense(link), setting.sense(carrier)
        relative = own * setting.speeds[link] - other * setting.speeds.get(carrier, Fraction(0))
        torque = part.bearing.base * ((relative > 0) - (relative < 0))
        found[link] = found.get(link, Fraction(0)) - own * torque
        if carrier != setting.train.frame:
            found[carrier] = found.get(carrier, Fraction(0)) + other * torque
    return found


def _torques(
    setting: Setting, balance: Balance, flow: Flow, rubbing: Mapping[str, Fraction], verdict: TorqueVerdict
) -> Torques:
    solved = flow.solved
    external = dict(balance.known)
    for found in (solved.external, solved.brakes):
        for link, torque in found.items():
            external[link] = external.get(link, Fraction(0)) + torque
    pairs = {}
    for mesh, circuit in zip(balance.meshes, setting.circuits, strict=True):
        x = solved.multipliers[mesh.id]
        torques = tuple(x * each for each in mesh.torques(flow.pattern.get(mesh.id, 0)))
        ahead = ((x < 0) - (x > 0)) * mesh.turn
        pairs[mesh.id] = PairTorque(
            mesh.id,
            circuit.wheels[0 if ahead > 0 else 1] if ahead else "",
            mesh.links,
            (torques[0], torques[1], torques[2]),
            x,
            mesh.rolling,
            mesh.efficiency(ahead),
            mesh.id in solved.loose,
        )
    lost = -sum((torque * setting.speeds[link] for link, torque in rubbing.items()), Fraction(0))
    # friction of a bearing is no power from outside
    for link, torque in rubbing.items():
        external[link] -= torque
    return Torques(
        setting.case.state,
        verdict,
        balance.unknown,
        {link: torque for link, torque in external.items() if torque or link in solved.external},
        setting.speeds,
        pairs,
        lost,
    )
