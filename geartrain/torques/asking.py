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
from geartrain.torques.result import PairTorque, Torques, TorqueVerdict
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
    return {link: torque.base or torque.value for link, torque in loads.items()}, solve_for


def find_torques(setting: Setting) -> Torques:
    """Torques under the declared loads."""
    loads, solve_for = declared_loads(setting.train, setting.case)
    if not loads:
        text = "no load is declared: give `loads` on links, resisting where power over speed is negative"
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
    inputs = setting.case.inputs
    free = tuple(link for link in inputs if link not in loads)
    missing = len(inputs) - len(free)
    if not missing:
        return free, None
    links = dict.fromkeys(output.of or name for name, output in setting.case.outputs.items())
    candidates = (solve_for,) if solve_for else tuple(link for link in links if link not in loads and link not in free)
    if len(candidates) == missing:
        return free + candidates, None
    loaded = ", ".join(link for link in inputs if link in loads)
    text = (
        f"{loaded} carries a load, so {missing} other torque{'s' if missing > 1 else ''} must be unknown, and "
        f"{len(candidates)} can be: name one with `solve_for`"
    )
    return (), TorqueVerdict("undecided", text, candidates)


def _balanced(
    setting: Setting, loads: Mapping[str, Fraction], asked: tuple[str, ...], bearings: bool = True
) -> Torques:
    case, train = setting.case, setting.train
    rubbing = _bearings(setting) if bearings else {}
    known = dict(loads)
    for link, torque in rubbing.items():
        known[link] = known.get(link, Fraction(0)) + torque
    balance = Balance(
        tuple(link for link in train.links if link != train.frame),
        tuple(_mesh(setting, circuit) for circuit in setting.circuits),
        known,
        asked,
        tuple(link for link in case.fixed if link != train.frame),
        tuple(((a, setting.sense(a)), (b, setting.sense(b))) for a, b in case.locks if a != b),
    )
    flows, complete = find_flows(balance, _ties(setting.circuits, {*known, *asked, *balance.held}))
    verdict = _judge(setting, flows, complete, asked)
    if not flows:
        return Torques(case.state, verdict, asked)
    found = (_torques(setting, balance, flow, rubbing, verdict) for flow in flows)
    return min(found, key=lambda each: each.loss)


def _judge(setting: Setting, flows: Sequence[Flow], complete: bool, asked: tuple[str, ...]) -> TorqueVerdict:
    names = ", ".join(asked)
    if not flows:
        sure = "" if complete else " (not every pattern of power flow was tried)"
        return TorqueVerdict(
            "self-locking", f"no torque on {names} balances the load while the train turns this way{sure}", asked
        )
    if len(flows) > 1:
        return TorqueVerdict("ambiguous", f"{len(flows)} patterns of power flow balance the load", asked)
    if loose := flows[0].solved.loose:
        return TorqueVerdict(
            "indeterminate", f"how {', '.join(loose)} share their load is not determined: redundant pairs", loose
        )
    sure = "" if complete else "; other patterns of power flow were not tried"
    return TorqueVerdict("determined", f"every torque follows from the loads{sure}")


def _mesh(setting: Setting, circuit: Circuit) -> Mesh:
    """A circuit as a path of power, with what its teeth lose."""
    i, j, k = circuit.i, circuit.j, circuit.carrier
    senses = (setting.sense(i), setting.sense(j), setting.sense(k))
    relative = senses[0] * setting.speeds[i] - senses[2] * setting.speeds[k]
    forward, backward = _efficiencies(setting, circuit)
    return Mesh(circuit.id, (i, j, k), senses, circuit.a, circuit.b, circuit.a * relative, forward, backward)


def _efficiencies(setting: Setting, circuit: Circuit) -> tuple[Fraction, Fraction]:
    """With the first wheel driving, and with the second: declared, or the mean of the teeth, or none lost."""
    if circuit.kind != "gear":
        return Fraction(1), Fraction(1)
    gear = setting.gears[circuit.id]
    if gear.efficiency is not None:
        return gear.efficiency.forward.value, gear.efficiency.backward.value
    tooth = setting.meshes.get(circuit.id)
    if tooth is None or not tooth.law.friction:
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
        torque = (part.bearing.base or part.bearing.value) * ((relative > 0) - (relative < 0))
        found[link] = found.get(link, Fraction(0)) - own * torque
        if carrier != setting.train.frame:
            found[carrier] = found.get(carrier, Fraction(0)) + other * torque
    return found


def _ties(circuits: Sequence[Circuit], singled: set[str]) -> list[list[str]]:
    """Pairs of equal planets share alike: links that mesh with the same wheels by the same counts on one carrier.

    singled   links with a torque of their own: a loaded planet is not like the others
    """
    by_planet: dict[str, list[tuple[tuple[object, ...], str]]] = {}
    for circuit in circuits:
        if circuit.kind != "gear":
            continue
        first, second = circuit.wheels
        for planet, own, mate, other in (
            (circuit.i, circuit.a, second, circuit.b),
            (circuit.j, circuit.b, first, circuit.a),
        ):
            if planet not in singled:
                by_planet.setdefault(planet, []).append(((circuit.carrier, mate, own, other), circuit.id))
    alike: dict[tuple[object, ...], list[list[str]]] = {}
    for meshes in by_planet.values():
        meshes.sort(key=lambda mesh: str(mesh[0]))
        alike.setdefault(tuple(key for key, _ in meshes), []).append([name for _, name in meshes])
    groups = [group for group in alike.values() if len(group) > 1]
    return [list(names) for group in groups for names in zip(*group, strict=True)]


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
        side = flow.pattern.get(mesh.id, 0)
        through = mesh.power(x)
        torques = tuple(x * each for each in mesh.torques(side))
        share = mesh.forward if through > 0 else mesh.backward
        driver = "" if not through else circuit.wheels[0] if through > 0 else circuit.wheels[1]
        pairs[mesh.id] = PairTorque(
            mesh.id,
            driver,
            mesh.links,
            (torques[0], torques[1], torques[2]),
            abs(through),
            abs(through) * (1 - share),
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
        {link: torque for link, torque in external.items() if torque or link in balance.unknown},
        setting.speeds,
        pairs,
        lost,
    )
