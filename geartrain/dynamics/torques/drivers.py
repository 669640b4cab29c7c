"""Driving side of each gear pair and coupling, from the power that flows through it relative to its carrier.

The rules are in docs/torques.md, section 3, "Who drives a pair". If loads are declared, torques determine the driving
side of all pairs that transmit a load. Otherwise every pointer on a dial is assumed to resist its motion with an
unknown torque. Without loss the multiplier of a pair is linear in these torques, x = sum c_o T_o with T_o >= 0. If all
c_o of a pair have one sign, the power flows in one direction for any torques of the pointers; otherwise the direction
is undetermined. For pairs through which no pointer takes power, resistance is assumed at the outputs on shafts, then at
all outputs, all shafts, and finally every joint. The order of declaration does not matter.

The coefficients c_o are exact. One elimination treats all loads at once: each load is a symbol, and every unknown
torque is a linear form of the symbols. If several loads have the same sign in one torque and occur nowhere else, their
sum becomes a new symbol. This reduces run time and the number of digits in long trains.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.torques.flow_patterns import solve_block
from geartrain.dynamics.torques.torque_analysis import build_balance, find_idle_pairs, find_torques, power_inputs
from geartrain.numerics.block_triangular import Block
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.numerics.elimination import LinearForm, add_into
from geartrain.teeth.meshing_wheels import MeshDriver

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_balance import TorqueBalance
    from geartrain.dynamics.torques.torque_results import Torques
    from geartrain.kinematics.circuits import Circuit
    from geartrain.train import Train


UnitLoads = Mapping[str, Mapping[str, Fraction]]
"""Unit loads: name of the resisting output or link -> link -> torque."""

_NAMED = 3  # loads listed by name; the others are only counted


@dataclass(frozen=True)
class LoadGroup:
    """Set of loads: their number, and their first names in alphabetical order."""

    count: int
    names: tuple[str, ...]

    def __str__(self) -> str:
        rest = self.count - len(self.names)
        names = [*self.names, f"{rest} more"] if rest else list(self.names)
        return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))

    def joined(self, other: LoadGroup) -> LoadGroup:
        """Return the union of two sets of loads; loads whose names are in both are counted once."""
        names = sorted({*self.names, *other.names})
        twice = len({*self.names} & {*other.names})
        return LoadGroup(self.count + other.count - twice, tuple(names[:_NAMED]))


NOTHING = LoadGroup(0, ())  # no load


class LoadInfluence(NamedTuple):
    """Loads that make the multiplier of a mesh positive, and loads that make it negative. `open` is True if it is
    undetermined.
    """

    plus: LoadGroup = NOTHING
    minus: LoadGroup = NOTHING
    open: bool = False


def find_load_influence(balance: TorqueBalance, loads: UnitLoads) -> dict[str, LoadInfluence] | None:
    """Return the influence of loads on every mesh; None if no torques balance the loads.

    balance   torque balance without losses; its known torques only mark the loaded links
    """
    weighing = _InfluenceSolver(balance, loads)
    return weighing.found if weighing.go() else None


class _InfluenceSolver:
    def __init__(self, balance: TorqueBalance, loads: UnitLoads) -> None:
        self.balance, self.loads = balance, loads
        self.found: dict[str, LoadInfluence] = {}

    def _start(self) -> None:
        self.groups: dict[int, LoadGroup] = {}
        self.rows: dict[int, LinearForm] = {row: {} for row in self.balance.rows}
        self.holding_rows: dict[int, set[int]] = {}
        at = {link: row for row, link in enumerate(self.balance.links)}
        # sorted, so that the order of declaration has no effect
        for name in sorted(self.loads):
            symbol = self._symbol(LoadGroup(1, (name,)))
            for link, torque in self.loads[name].items():
                if at.get(link) in self.rows:
                    self._add(at[link], {symbol: torque}, 1)

    def _symbol(self, group: LoadGroup) -> int:
        symbol = -1 - len(self.groups)
        self.groups[symbol] = group
        self.holding_rows[symbol] = set()
        return symbol

    def _add(self, row: int, form: LinearForm, factor: Fraction | int) -> None:
        own = self.rows[row]
        add_into(own, form, factor)
        for symbol in form:
            (self.holding_rows[symbol].add if symbol in own else self.holding_rows[symbol].discard)(row)

    def go(self) -> bool:
        """Solve the system block by block, or as a whole if a block leaves a torque open that a later block may
        need.
        """
        self._start()
        done = self._through(self.balance.parts)
        if done is None:
            self._start()
            done = self._through([self.balance.whole])
        return bool(done)

    def _through(self, blocks: Sequence[Block]) -> bool | None:
        self.found = {}
        for block in blocks:
            forms = self._solve(block)
            if forms is None:
                return False
            # an undetermined torque may be determined by a later block
            if block is not blocks[-1] and None in forms.values():
                return None
            for column, form in forms.items():
                self._take(column, form)
        return True

    def _solve(self, block: Block) -> dict[int, LinearForm | None] | None:
        """Return the unknowns of a block as linear forms of symbols, with None for undetermined unknowns.

        The result is None if no torques balance the loads.
        """
        known = {row: self.rows.pop(row) for row in block.rows}
        for row, form in known.items():
            for symbol in form:
                self.holding_rows[symbol].discard(row)
        found = solve_block(self.balance.columns, block, dict.fromkeys(block.columns, 0), known)
        if found is None or len(block.rows) > 1 or len(block.columns) > 1:
            return found
        return {column: None if form is None else self._merged(form) for column, form in found.items()}

    def _merged(self, form: LinearForm) -> LinearForm:
        """Return the form with loads of one sign replaced by a new symbol for their sum, if no other row contains
        them.
        """
        # symbols in no remaining row are not needed separately; only their sum continues
        signs = {value > 0 for value in form.values()}
        if len(signs) != 1 or any(self.holding_rows[symbol] for symbol in form):
            return form
        return {self._symbol(self._sum(form)): Fraction(1 if signs.pop() else -1)}

    def _sum(self, symbols: Sequence[int] | LinearForm) -> LoadGroup:
        found = NOTHING
        for symbol in symbols:
            found = found.joined(self.groups[symbol])
        return found

    def _take(self, at: int, form: LinearForm | None) -> None:
        column = self.balance.columns[at]
        if form is None:
            share = LoadInfluence(open=True)
        else:
            share = LoadInfluence(
                self._sum([symbol for symbol, value in form.items() if value > 0]),
                self._sum([symbol for symbol, value in form.items() if value < 0]),
            )
            for row, coefficient in column.pieces[0].items():
                if row in self.rows and form:
                    self._add(row, form, coefficient)
        self.found |= {mesh.id: share for mesh in column.meshes}


class FlowDirections(NamedTuple):
    """Loads whose power flows from a pair's first wheel to its second, and loads whose power flows in reverse."""

    ahead: LoadGroup = NOTHING
    back: LoadGroup = NOTHING
    shared: bool = False
    """True if redundant pairs share the power, and the shares are undetermined."""
    note: str = ""
    """Note on outputs that take no power through this pair."""

    def __bool__(self) -> bool:
        return bool(self.ahead.count or self.back.count or self.shared)

    def joined(self, other: FlowDirections) -> FlowDirections:
        """Return the union of the loads of two results for one pair."""
        ahead, back = self.ahead.joined(other.ahead), self.back.joined(other.back)
        return FlowDirections(ahead, back, self.shared or other.shared, self.note)


def find_drivers(train: Train, circuits: Sequence[Circuit], setting: LoadCase | None) -> Mapping[str, MeshDriver]:
    """Return the driving wheel of every pair and the driving link of every coupling in one state, found when first
    read.

    circuits   circuits of the pairs and couplings to include
    setting    load case with the speeds of the state; None if they are undetermined: only declared drivers are then
    certain
    """
    if setting is None:
        return _undetermined(train, circuits, "the speeds of the train are not determined")
    return _Drivers(replace(setting, circuits=circuits)).found


def _undetermined(train: Train, circuits: Iterable[Circuit], why: str) -> dict[str, MeshDriver]:
    """Return the drivers for a train with unknown speeds, for the reason `why`: only declared drivers are certain."""
    declared = _declared(train)
    text = f"undetermined: {why}"
    return {
        each.id: declared.get(each.id) or MeshDriver(_assumed_driver(train, each), text, False) for each in circuits
    }


def _declared(train: Train) -> dict[str, MeshDriver]:
    return {gear.name: MeshDriver(gear.driver, "declared") for gear in train.gears if gear.driver is not None}


class _Drivers:
    """Driving sides in one state with known speeds. Efficiencies are computed only for pairs that transmit a load."""

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
        source = " and ".join(sorted(power_inputs(self.setting)))
        return _driver_of(self.setting, self.circuits[name], self._ways.get(name, FlowDirections()), source)

    @cached_property
    def _idle(self) -> Collection[str]:
        """Pairs that transmit no load, so that their efficiencies are not needed; searched for only if efficiencies
        need teeth.
        """
        return find_idle_pairs(self.setting) if self.setting.meshes else ()

    @cached_property
    def _loaded(self) -> Mapping[str, MeshDriver]:
        if not self.setting.train.is_loaded(self.setting.case.state):
            return {}
        loaded = find_torques(self.setting, flows_only=True)
        return _under_loads(loaded) if loaded.verdict else {}

    @cached_property
    def _ways(self) -> Mapping[str, FlowDirections]:
        rest = (circuit for name, circuit in self.circuits.items() if name not in self.declared)
        return _ways(self.setting, {circuit.id for circuit in rest if self.setting.turn(circuit)})


def _under_loads(loaded: Torques) -> dict[str, MeshDriver]:
    why = "power flow under the loads"
    if loaded.verdict.kind == "ambiguous":
        why += ", in the pattern with minimum loss"
    return {name: MeshDriver(pair.driver, why) for name, pair in loaded.pairs.items() if pair.driver and not pair.loose}


# ----------------------------------------------------------------------------------------------- assumed resistances


def _ways(setting: LoadCase, wanted: Collection[str]) -> dict[str, FlowDirections]:
    """Return the directions of power through the pairs `wanted` from assumed resistance at pointers, outputs, shafts or
    joints.
    """
    found: dict[str, FlowDirections] = {}
    note = ""
    for loads, missed in _RESISTING:
        left = {name for name in wanted if name not in found}
        if not left or not (resisting := loads(setting)):
            continue
        found |= {name: way._replace(note=note) for name, way in _flow_directions(setting, resisting).items()
                  if way and name in left}  # fmt: skip
        note = f"{missed} takes power through it; " if missed else note
    return found


def _pointers(setting: LoadCase) -> UnitLoads:
    """Return unit loads at every output with a dial, against its motion."""
    outputs = setting.case.outputs
    return {name: drag for name, drag in _outputs(setting).items() if outputs[name].dial is not None}


def _output_shafts(setting: LoadCase) -> UnitLoads:
    """Return unit loads at every output shaft that turns in the frame.

    Outputs on carriers, or relative to a carrier, are only displays without power.
    """
    frame = setting.train.frame
    ends = {name: output.links(name, frame) for name, output in setting.case.outputs.items()}
    outer = {name for name, (of, base) in ends.items() if base == frame == setting.bearer(of)}
    return {name: drag for name, drag in _outputs(setting).items() if name in outer}


def _outputs(setting: LoadCase) -> UnitLoads:
    """Return unit loads at every output, against its motion."""
    frame = setting.train.frame
    ends = {name: output.links(name, frame) for name, output in setting.case.outputs.items()}
    return {name: drag for name, (of, base) in ends.items() if (drag := _drag(setting, of, base))}


def _shafts(setting: LoadCase) -> UnitLoads:
    """Return unit loads at every link that turns in the frame, against its motion."""
    return {link: drag for link, drag in _joints(setting).items() if setting.bearer(link) == setting.train.frame}


def _joints(setting: LoadCase) -> UnitLoads:
    """Return unit loads at every link, against its rotation in its bearing."""
    links = (link for link in setting.train.links if link != setting.train.frame)
    return {link: drag for link in links if (drag := _drag(setting, link, setting.bearer(link)))}


_RESISTING: Sequence[tuple[Callable[[LoadCase], UnitLoads], str]] = (
    (_pointers, "no dial"),
    (_output_shafts, "no output shaft"),
    (_outputs, "no output"),
    (_shafts, ""),
    (_joints, ""),
)
"""Assumed resistances in order of precedence, with the text for pairs through which they take no power."""


def _drag(setting: LoadCase, of: str, base: str) -> dict[str, Fraction]:
    """Return a unit torque between two links against their relative rotation, by link; empty if they are at relative
    rest.
    """
    own, other = setting.sense(of), setting.sense(base)
    relative = setting.relative(of, base) or Fraction(0)
    sign = (relative > 0) - (relative < 0)
    return {of: Fraction(-sign * own), base: Fraction(sign * other)} if sign else {}


# ----------------------------------------------------------------------------------------------------- power directions


def _flow_directions(setting: LoadCase, loads: UnitLoads) -> dict[str, FlowDirections]:
    """Return the directions of power in every pair for any combination of loads with positive factors."""
    found: dict[str, FlowDirections] = {}
    for requested in _sources(setting) if loads else ():
        like = _equal_planets(build_balance(setting, {}, requested))
        spread = {name: _spread(each, like) for name, each in loads.items()}
        loaded = sorted({like.get(link, (link,))[0] for each in spread.values() for link in each})
        # equal planets remain equal under equal loads; the numbers only distinguish the loaded links
        number = {peer: Fraction(at) for at, link in enumerate(loaded, 2) for peer in like.get(link, (link,))}
        shares = find_load_influence(balance := build_balance(setting, number, requested), spread)
        for mesh in balance.meshes if shares is not None else ():
            plus, minus, shared = (shares or {})[mesh.id]
            way = FlowDirections(minus, plus, shared) if mesh.turn > 0 else FlowDirections(plus, minus, shared)
            found[mesh.id] = found[mesh.id].joined(way) if mesh.id in found else way
    return found


def _sources(setting: LoadCase) -> Iterator[tuple[str, ...]]:
    """Yield the sets of links with unknown torque, each with as many links as there are inputs.

    If there is a crank besides the inputs, the sets are all combinations of the crank with further links.
    """
    links, inputs = power_inputs(setting), tuple(setting.case.inputs)
    if len(links) == 1 and not setting.speeds.get(links[0]):
        links = inputs  # the crank is at rest and passes no power
    if len(links) == len(inputs):
        yield links
    else:
        yield from ((links[0], *rest) for rest in combinations(links[1:], len(inputs) - 1))


def _equal_planets(balance: TorqueBalance) -> dict[str, tuple[str, ...]]:
    """Return for each planet the planets that are equal to it, including itself."""
    ends = {mesh.id: mesh.links[:2] for mesh in balance.meshes}
    found: dict[str, tuple[str, ...]] = {}
    for group in balance.ties:
        common = set.intersection(*(set(ends[name]) for name in group))
        planets = tuple(sorted(link for name in group for link in ends[name] if link not in common))
        found |= dict.fromkeys(planets, planets)
    return found


def _spread(load: Mapping[str, Fraction], like: Mapping[str, tuple[str, ...]]) -> dict[str, Fraction]:
    """Return the load applied equally to all planets that are equal to the loaded planet, and as often to their
    carrier.
    """
    most = max((len(like.get(link, (link,))) for link in load), default=1)
    return {
        peer: torque * (1 if link in like else most)
        for link, torque in load.items()
        for peer in like.get(link, (link,))
    }


# ------------------------------------------------------------------------------------------------------------- verdicts


def _driver_of(setting: LoadCase, circuit: Circuit, way: FlowDirections, source: str) -> MeshDriver:
    first, second = circuit.wheels
    if way.shared:
        why = "redundant pairs share the load in an unknown ratio; declare `share` or `loads`"
        return _open(setting, circuit, why)
    if way.ahead.count and way.back.count:
        # the direction with more loads is assumed; with equal numbers neither is preferred
        ways = sorted([(-way.ahead.count, first, second, way.ahead), (-way.back.count, second, first, way.back)])
        (more, likely, other, most), (less, *_, rest) = ways
        why = f"{way.note}power flows from {likely} to {other} for {most}, and back for {rest}; declare `loads`"
        found = _open(setting, circuit, why)
        return replace(found, wheel=likely) if more < less else found
    if way:
        group = way.ahead if way.ahead.count else way.back
        return MeshDriver(first if way.ahead.count else second, f"{way.note}power flow {source} -> {group}")
    turn = setting.turn(circuit)
    if turn is None:
        return _open(setting, circuit, "the relative speed of its two sides is not determined")
    if not turn:
        what = "its slot only oscillates" if circuit.swings else "its two sides have no relative motion"
        return _open(setting, circuit, f"{what}, so no power flows on average")
    return _open(setting, circuit, "no power flows through it")


def _open(setting: LoadCase, circuit: Circuit, why: str) -> MeshDriver:
    return MeshDriver(_assumed_driver(setting.train, circuit), f"undetermined: {why}", False)


def _assumed_driver(train: Train, circuit: Circuit) -> str:
    """Return the assumed driver of a pair whose driver is undetermined: the wheel with fewer teeth (then by name), or
    the pin.
    """
    if circuit.kind != "gear":
        return circuit.j
    return min(
        circuit.wheels, key=lambda name: (train.wheels[name][1].internal, train.wheels[name][1].count or 0, name)
    )
