"""Driver of each gear pair and coupling, from the power that flows through it relative to its carrier (docs/torques.md,
section 3, "Who drives a pair").

If loads are declared, torques determine the drivers. Otherwise unknown torques T_o >= 0 are assumed to resist the
motion of the outputs o. Without losses, the multiplier of a pair is linear in them, x = sum c_o T_o, so that the
direction of power flow is known if all c_o have the same sign. One elimination gives the exact c_o of all loads.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.torques.flow_patterns import solve_block
from geartrain.dynamics.torques.load_case import power_inputs
from geartrain.dynamics.torques.torque_analysis import build_balance, find_idle_pairs, find_torques
from geartrain.dynamics.torques.torque_balance import equal_planets
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.numerics.elimination import LinearForm
from geartrain.teeth.meshing_wheels import MeshDriver

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_balance import TorqueBalance
    from geartrain.kinematics.circuits import Circuit
    from geartrain.train import Train


UnitLoads = Mapping[str, Mapping[str, Fraction]]
"""Unit loads of each output or link that resists its motion, by its name: torque on each link."""

_NAMED = 3  # loads listed by name; the others are only counted


LoadGroup = frozenset[str]
"""Names of outputs or links whose motion is resisted."""


def group_text(group: LoadGroup) -> str:
    """Return up to three names of a group of loads in alphabetical order, followed by the number of further names."""
    names = sorted(group)[:_NAMED]
    if rest := len(group) - len(names):
        names.append(f"{rest} more")
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))


class FlowDirections(NamedTuple):
    """Directions of power in a pair: names of the loads for which power flows from the first wheel to the second, and
    names of the loads for which it flows in the opposite direction.
    """

    ahead: LoadGroup = frozenset()
    back: LoadGroup = frozenset()
    shared: bool = False
    """True if redundant pairs share the power in undetermined proportions."""
    note: str = ""
    """Note on outputs to which this pair transmits no power; empty if there are none."""

    def __bool__(self) -> bool:
        return bool(self.ahead or self.back or self.shared)

    def joined(self, other: FlowDirections) -> FlowDirections:
        """Return the directions of power flow under the loads of this object and of another one."""
        return FlowDirections(self.ahead | other.ahead, self.back | other.back, self.shared or other.shared, self.note)


def find_flow_directions(balance: TorqueBalance, loads: UnitLoads) -> dict[str, FlowDirections]:
    """Return the direction in which each load drives power through each pair, by pair; empty if no torques balance the
    loads.

    balance   torque balance without losses; it uses which links have known torques, but not the values of these torques
    """
    at = {link: row for row, link in enumerate(balance.links)}
    names = sorted(loads)
    known: dict[int, LinearForm] = {row: {} for row in balance.rows}
    for number, name in enumerate(names):
        for link, torque in loads[name].items():
            if at.get(link) in known:
                # each load is a symbol, which has a negative column
                known[at[link]][-1 - number] = torque
    forms = solve_block(balance.columns, balance.whole, dict.fromkeys(range(len(balance.columns)), 0), known)
    found = {}
    for column, form in forms.items() if forms is not None else ():
        for mesh in balance.columns[column].meshes:
            # power flows from the first link to the second if the multiplier is opposite to the rolling speed
            signs = {names[-1 - symbol]: value * mesh.turn < 0 for symbol, value in (form or {}).items()}
            ahead = frozenset(name for name, forwards in signs.items() if forwards)
            found[mesh.id] = FlowDirections(ahead, frozenset(signs) - ahead, form is None)
    return found


def find_drivers(train: Train, circuits: Sequence[Circuit], setting: LoadCase | None) -> Mapping[str, MeshDriver]:
    """Return a lazy mapping of the driving wheel of every pair and the driving link of every coupling in one state.

    circuits   circuits of the pairs and couplings to include
    setting    load case with the speeds of the state, or None if the speeds are undetermined. In that case, only
               declared drivers are certain.
    """
    if setting is not None:
        return _Drivers(replace(setting, circuits=circuits)).found
    declared, text = _declared(train), "undetermined: the speeds of the train are not determined"
    return {
        each.id: declared.get(each.id) or MeshDriver(_assumed_driver(train, each), text, False) for each in circuits
    }


def _declared(train: Train) -> dict[str, MeshDriver]:
    return {gear.name: MeshDriver(gear.driver, "declared") for gear in train.gears if gear.driver is not None}


class _Drivers:
    """Drivers of all pairs of a train in one state."""

    def __init__(self, setting: LoadCase) -> None:
        self.setting = setting
        self.declared = _declared(setting.train)
        self.circuits = {circuit.id: circuit for circuit in setting.circuits}
        self.found = ItemwiseMapping(self.circuits, self._driver)

    def _driver(self, name: str) -> MeshDriver:
        if name in self.declared:
            return self.declared[name]
        if name not in self._idle and name in self._loaded:
            return self._loaded[name]
        circuit, way = self.circuits[name], self._ways.get(name, FlowDirections())
        (first, second), driver = circuit.wheels, _assumed_driver(self.setting.train, circuit)
        if way.shared:
            why = "redundant pairs share the load in an unknown ratio; declare `share` or `loads`"
        elif way.ahead and way.back:
            # the direction with more loads is assumed; with equal numbers neither is preferred
            ways = sorted([(-len(way.ahead), first, second, way.ahead), (-len(way.back), second, first, way.back)])
            (more, likely, other, most), (less, *_, rest) = ways
            driver = likely if more < less else driver
            flows = f"from {likely} to {other} for {group_text(most)}, and back for {group_text(rest)}"
            why = f"{way.note}power flows {flows}; declare `loads`"
        elif way:
            source = " and ".join(sorted(power_inputs(self.setting)))
            text = f"{way.note}power flow {source} -> {group_text(way.ahead or way.back)}"
            return MeshDriver(first if way.ahead else second, text)
        elif (turn := self.setting.turn(circuit)) is None:
            why = "the relative speed of its two sides is not determined"
        elif turn:
            why = "no power flows through it"
        else:
            what = "its driven side only oscillates" if circuit.swings else "its two sides have no relative motion"
            why = f"{what}, so no power flows on average"
        return MeshDriver(driver, f"undetermined: {why}", False)

    @cached_property
    def _idle(self) -> Collection[str]:
        """Names of the pairs that transmit no torque under the declared loads; empty if no pair has teeth."""
        return find_idle_pairs(self.setting) if self.setting.meshes else ()

    @cached_property
    def _loaded(self) -> Mapping[str, MeshDriver]:
        if not self.setting.train.is_loaded(self.setting.case.state):
            return {}
        loaded = find_torques(self.setting, flows_only=True)
        if not loaded.verdict:
            return {}
        why = "power flow under the loads"
        if loaded.verdict.kind == "ambiguous":
            why += ", in the pattern with minimum loss"
        pairs = {name: pair for name, pair in loaded.pairs.items() if pair.driver and not pair.loose}
        return {name: MeshDriver(pair.driver, why) for name, pair in pairs.items()}

    @cached_property
    def _ways(self) -> Mapping[str, FlowDirections]:
        """Directions of power flow through the pairs without a declared driver, under assumed loads on the outputs."""
        setting, found, note = self.setting, dict[str, FlowDirections](), ""
        left = {name for name, each in self.circuits.items() if name not in self.declared and setting.turn(each)}
        for loads, missed in _resistances(setting):
            if not left:
                break
            if loads:
                ways = {name: way for name, way in _directions(setting, loads).items() if way and name in left}
                found |= {name: way._replace(note=note) for name, way in ways.items()}
                left -= ways.keys()
                note = f"{missed} takes power through it; " if missed else note
        return found


# ----------------------------------------------------------------------------------------------- assumed resistances


def _resistances(setting: LoadCase) -> Iterator[tuple[UnitLoads, str]]:
    """Yield groups of assumed unit loads that oppose the motion, in order of precedence, each with words for a note on
    pairs through which none of these loads takes power, such as "no dial".
    """
    frame, declared = setting.train.frame, setting.case.outputs
    ends = {name: output.links(name, frame) for name, output in declared.items()}
    outputs = {name: drag for name, (of, base) in ends.items() if (drag := drag_torques(setting, of, base))}
    yield {name: drag for name, drag in outputs.items() if declared[name].dial is not None}, "no dial"
    # outputs on carriers, or relative to a carrier, are displays that take no power
    outer = {name for name, (of, base) in ends.items() if base == frame == setting.bearer(of)}
    yield {name: drag for name, drag in outputs.items() if name in outer}, "no output shaft"
    yield outputs, "no output"
    bearers = {link: setting.bearer(link) for link in setting.train.links if link != frame}
    joints = {link: drag for link, bearer in bearers.items() if (drag := drag_torques(setting, link, bearer))}
    yield {link: drag for link, drag in joints.items() if bearers[link] == frame}, ""
    yield joints, ""


def drag_torques(setting: LoadCase, of: str, base: str) -> dict[str, Fraction]:
    """Return a unit torque between the links `of` and `base` that opposes their relative rotation, by link; empty if
    the links do not move relative to each other.
    """
    own, other = setting.sense(of), setting.sense(base)
    relative = setting.relative(of, base) or Fraction(0)
    sign = (relative > 0) - (relative < 0)
    return {of: Fraction(-sign * own), base: Fraction(sign * other)} if sign else {}


# ----------------------------------------------------------------------------------------------------- power directions


def _directions(setting: LoadCase, loads: UnitLoads) -> dict[str, FlowDirections]:
    """Return, by pair, the directions in which the loads drive power through the pair, for all choices of the driving
    links.
    """
    found: dict[str, FlowDirections] = {}
    for requested in _sources(setting):
        like = equal_planets(build_balance(setting, {}, requested))
        spread = {name: _spread(each, like) for name, each in loads.items()}
        loaded = sorted({like.get(link, (link,))[0] for each in spread.values() for link in each})
        # equal planets remain equal under equal loads; the numbers only distinguish the loaded links
        number = {peer: Fraction(at) for at, link in enumerate(loaded, 2) for peer in like.get(link, (link,))}
        for name, way in find_flow_directions(build_balance(setting, number, requested), spread).items():
            found[name] = found[name].joined(way) if name in found else way
    return found


def _sources(setting: LoadCase) -> Iterator[tuple[str, ...]]:
    """Yield each possible set of driving links (links of unknown torque), whose number equals the number of inputs."""
    links, inputs = power_inputs(setting), tuple(setting.case.inputs)
    if len(links) == 1 and not setting.speeds.get(links[0]):
        links = inputs  # the crank is at rest and passes no power
    if len(links) == len(inputs):
        yield links
    else:
        yield from ((links[0], *rest) for rest in combinations(links[1:], len(inputs) - 1))


def _spread(load: Mapping[str, Fraction], like: Mapping[str, tuple[str, ...]]) -> dict[str, Fraction]:
    """Return the torques by link of a load that acts on all equal planets instead of one; torques on other links are
    multiplied by the number of planets.

    like   all planets that are equal to a planet, by planet
    """
    most = max((len(like.get(link, (link,))) for link in load), default=1)
    return {
        peer: torque * (1 if link in like else most)
        for link, torque in load.items()
        for peer in like.get(link, (link,))
    }


def _assumed_driver(train: Train, circuit: Circuit) -> str:
    """Return the assumed driver of a pair: the declared driving link of a coupling, the external wheel of a ring gear,
    the wheel with fewer teeth, or, for equal tooth counts, the wheel whose name is first in alphabetical order.
    """
    if circuit.kind != "gear":
        return circuit.j
    return min(
        circuit.wheels, key=lambda name: (train.wheels[name][1].internal, train.wheels[name][1].count or 0, name)
    )
