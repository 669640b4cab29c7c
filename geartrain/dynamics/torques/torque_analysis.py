"""Torques of a declared train in one load case: known and unknown torques, losses, and the verdict.

A verdict states why no torques balance the loads, which of several solutions is returned, or that the input must supply
power in addition to the loads (sections 5, 6, 8 and 11 of docs/torques.md).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.torques.flow_patterns import FlowPattern, find_flow_patterns
from geartrain.dynamics.torques.load_case import (
    LoadCase,
    MeanEfficiencies,
    balancing_torque,
    power_inputs,
    unbalanced_motions,
)
from geartrain.dynamics.torques.torque_balance import LoadedPair, LoadShares, TorqueBalance, generic_balance, idle_pairs
from geartrain.dynamics.torques.torque_results import (
    BearingTorque,
    HoldingTorque,
    NeglectedEffect,
    PairTorque,
    Torques,
    TorqueVerdict,
)
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.exact import decimal
from geartrain.numerics.quantity import TRAVEL_ARM
from geartrain.train import Train

if TYPE_CHECKING:
    from geartrain.dynamics.torques.bearing_loads import BearingLoads

_MOST_ROUNDS = 8  # maximum changes of the pattern of power flow by the friction of loaded bearings
_GREAT = 10**12  # lambda of section 6: factor of the load that makes constant friction negligible


@dataclass(frozen=True)
class LoadedBalance:
    """Torque balance whose known torques are the loads and the friction of bearings."""

    balance: TorqueBalance
    speeds: Mapping[str, Fraction]
    loads: Mapping[str, Fraction]
    bearing_friction: Mapping[str, Fraction]
    enough: bool = True
    """True if the number of unknown torques equals the number of degrees of freedom.

    If there are fewer unknown torques, the loads must be in equilibrium without additional torques.
    """
    open: tuple[str, ...] = ()
    """Links whose speed is undetermined."""
    bearings: tuple[BearingTorque, ...] = ()
    """Friction torques of the bearings. `bearing_friction` is the sum of the load-independent friction torques on each
    link.
    """
    bearing_loads: BearingLoads | None = None
    """Loads of the bearings whose friction depends on the load; None if there are none."""

    @property
    def names(self) -> str:
        """Names of the links with unknown torques, separated by commas; "any link" if there are none."""
        return ", ".join(self.balance.unknown) or "any link"

    @property
    def load(self) -> str:
        """Name of the load for use in sentences: "the load" or "the friction of the bearings"."""
        return "the load" if self.loads else "the friction of the bearings"

    @property
    def has_friction(self) -> bool:
        """True if there is a load, and if some bearing friction is not proportional to the load."""
        masses = {} if self.bearing_loads is None else self.bearing_loads.masses
        return any(self.loads.values()) and any((*masses.values(), *self.bearing_friction.values()))

    def sorted_flows(self, balance: TorqueBalance) -> tuple[list[FlowPattern], bool]:
        """Return the patterns of power flow of a balance, and True if all patterns were tried.

        The patterns are sorted by the number of undetermined torques, and for equal numbers by losses.
        """
        found, complete = find_flow_patterns(balance)
        # the known powers are the same in all flows, so the power of the unknown torques orders the losses
        return sorted(found, key=lambda flow: (len(flow.solved.open), self.power(flow.solved.external))), complete

    def solve(self) -> tuple[LoadedBalance, list[FlowPattern], bool]:
        """Return the balance including load-dependent friction of bearings, its patterns of power flow in the order of
        `sorted_flows`, and True if all patterns were tried. The friction follows from the bearing loads in the first
        pattern.
        """
        found, loads = self, self.bearing_loads
        flows, complete = self.sorted_flows(self.balance)
        if loads is None:
            return self, flows, complete
        for _ in range(_MOST_ROUNDS):
            loaded = loads.friction_torques(self.balance, flows[0], self.loads) if flows else None
            if loaded is None:
                break
            bearings = loads.setting.bearings(loaded, loads.steady)
            known = _acting(self.loads, _bearing_friction(loads.setting, bearings))
            found = replace(self, balance=replace(self.balance, known=known), bearings=bearings)
            before, (flows, complete) = flows[0].pattern, self.sorted_flows(found.balance)
            if flows and flows[0].pattern == before:
                return found, flows, complete
        return self, [], complete

    def power(self, torques: Mapping[str, Fraction]) -> Fraction:
        """Return the total power of the given torques on links whose speed is determined [unit of torque times the
        train's unit of speed].
        """
        return sum((torque * self.speeds.get(link, 0) for link, torque in torques.items()), Fraction(0))

    def heavily_loaded(self) -> tuple[FlowPattern, ...]:
        """Return the patterns of power flow for a load so large that load-independent friction is negligible."""
        loads = {link: _GREAT * torque for link, torque in self.loads.items()}
        known = _acting(loads, self.bearing_friction)
        return tuple(replace(self, loads=loads, balance=replace(self.balance, known=known)).solve()[1])


def find_imbalance(setting: LoadCase, known: Mapping[str, Fraction], requested: Sequence[str]) -> TorqueVerdict | None:
    """Return a verdict if the unknown torques cannot balance the loads even without losses; return None if they can."""
    motions = unbalanced_motions(setting.system, known, requested)
    if not motions:
        return None
    moving = {link for motion in motions if motion.power for link in motion.speeds}
    outputs = (output.of or name for name, output in setting.case.outputs.items())
    borne = (link for link in setting.train.links if setting.tree.parent.get(link, ("",))[0] == setting.train.frame)
    # links at which a torque can be applied are suggested first: inputs, outputs, links that turn on the frame
    likely = [link for link in dict.fromkeys((*setting.case.inputs, *outputs, *borne)) if link in moving]
    torques = {link: torque for link in likely if (torque := balancing_torque(motions, link)) is not None}
    helpful = {link: torque for link, torque in torques.items() if not known.get(link)}
    shown = {link: decimal(_load(setting.arms, link, torque), 6) for link, torque in torques.items()}
    amounts = [f"{shown[link]} at {link}" for link in helpful] or [f"{shown[link]} more at {link}" for link in torques]
    fix = f"; a torque of {' or '.join(amounts[:3])} would balance them" if amounts else ""
    held = f"with {', '.join(requested)} at rest, they" if requested else "they"
    text = f"the loads do not balance: {held} set {_some(likely or sorted(moving))} in motion{fix}"
    return TorqueVerdict("unbalanced", text, tuple(helpful))


def _some(links: Sequence[str]) -> str:
    """Return up to three link names separated by commas, followed by the number of the other names."""
    more = f" and {len(links) - 3} more" if links[3:] else ""
    return ", ".join(links[:3]) + more


def find_torque_verdict(
    question: LoadedBalance, flows: Sequence[FlowPattern], complete: bool, neglected: Sequence[NeglectedEffect] = ()
) -> TorqueVerdict:
    """Return the verdict on the torques. The patterns of power flow `flows` are sorted by the number of undetermined
    torques, then by losses; the torques of the first pattern are reported.
    """
    if not flows:
        return _unbalanced(question, complete)
    uncounted: dict[str, list[str]] = {}
    for each in neglected:
        if each.counts:
            uncounted.setdefault(each.what, []).extend(each.where)
    named = [f"{what} ({', '.join(where)})" for what, where in uncounted.items()]
    but = f"; not included: {', '.join(named)}" if named else " (mean over a turn)" if neglected else ""
    # undetermined torques come first, because the number of patterns then has no meaning
    if any(flow.solved.loose or flow.solved.open or None in flow.solved.locks for flow in flows):
        verdict = _indeterminate(flows, question)
        return replace(verdict, text=verdict.text + but)
    if len(flows) > 1:
        given, *others = (question.power(flow.solved.external) for flow in flows)
        rest = " or ".join(_describe_flow(question, power, given < 0) for power in others)
        text = (
            f"{len(flows)} patterns of power flow balance {question.load}: in the reported one, with minimum loss, "
            f"{_describe_flow(question, given, False)}; in {'others' if others[1:] else 'the other'} {rest}{but}"
        )
        return TorqueVerdict("ambiguous", text)
    sure = "" if complete else "; other patterns of power flow were not tried"
    source = "the loads" if question.loads else question.load
    free = f"; {_some(question.open)} turn freely, but torques do not depend on their speeds" if question.open else ""
    return TorqueVerdict(
        "incomplete" if neglected else "determined",
        f"every torque follows from {source}{but}{_driving_note(question, flows[0])}{free}{sure}",
    )


def _unbalanced(question: LoadedBalance, complete: bool) -> TorqueVerdict:
    """Return the verdict that no torques balance the loads, with the cause: too few unknown torques, declared shares of
    load, bearing friction, or teeth that lock.
    """
    names = question.names
    if not question.enough:
        text = "the loads balance without losses, but not with them: one more unknown torque is needed"
        return TorqueVerdict("unbalanced", text)
    if shares := question.balance.shares:
        pairs = dict.fromkeys(name for _, parts in shares for name in parts)
        # without the shares there is a solution, so they are the cause
        if find_flow_patterns(replace(question.balance, shares=()))[0]:
            text = (
                f"the declared shares of {', '.join(pairs)} contradict the balance, which has a solution without them"
            )
            return TorqueVerdict("contradictory", text)
    # a larger load turns the train, so the constant friction of bearings is the cause
    if question.has_friction and question.heavily_loaded():
        text = (
            f"the load is too small to overcome the friction of the bearings, and no torque on {names} compensates for "
            "it while the train turns this way; the teeth do not lock: a larger load turns the train"
        )
        return TorqueVerdict("stalled", text)
    sure = "" if complete else " (not every pattern of power flow was tried)"
    great = ", however large: the teeth lock, not the bearings" if question.has_friction else ""
    text = f"no torque on {names} balances {question.load} while the train turns this way{great}{sure}"
    return TorqueVerdict("self-locking", text)


def _locked_bearings(question: LoadedBalance) -> TorqueVerdict:
    """Return the verdict that load-dependent friction of bearings locks the train."""
    assert question.bearing_loads is not None
    links = ", ".join(question.bearing_loads.links)
    if question.has_friction and question.heavily_loaded():
        text = (
            f"the load is too small to overcome the friction of the bearings of {links}: a larger load turns the train"
        )
        return TorqueVerdict("stalled", text)
    text = (
        f"no torque on {question.names} balances {question.load} while the train turns this way: the friction of the "
        f"bearings of {links} grows with the load and locks the train; without it the train turns"
    )
    return TorqueVerdict("self-locking", text)


def _driving_note(question: LoadedBalance, flow: FlowPattern) -> str:
    """Return a note that a load supplies power but too little to drive the train alone; "" if there is no such load."""
    if question.power(question.loads) <= 0 or question.power(flow.solved.external) <= 0:
        return ""
    heavy = question.heavily_loaded() if question.has_friction else ()
    if any(question.power(each.solved.external) <= 0 for each in heavy):
        return (
            f"; the load is too small to overcome the friction of the bearings, so {question.names} must drive as well"
        )
    parts = "teeth" if question.bearing_loads is None else "teeth and bearings"
    return (
        f"; no load in this sense drives the train, because the {parts} dissipate all of its power: "
        f"{question.names} must drive as well"
    )


def _indeterminate(flows: Sequence[FlowPattern], question: LoadedBalance) -> TorqueVerdict:
    """Return the verdict on torques that are undetermined because of redundant pairs, brakes and locks."""
    loose = tuple(dict.fromkeys(name for flow in flows for name in flow.solved.loose))
    links = list(flows[0].solved.open)
    locks = zip(question.balance.locks, flows[0].solved.locks, strict=True)
    links += [f"the lock of {a} and {b}" for ((a, _), (b, _)), torque in locks if torque is None]
    if not loose:
        text = f"the torque on {', '.join(links)} is not determined: brakes and locks share it in an unknown ratio"
        return TorqueVerdict("indeterminate", text, flows[0].solved.open)
    also = f", nor is the torque on {', '.join(links)}" if links else ""
    text = (
        f"the load sharing of {', '.join(loose)} is not determined{also}: they are redundant, and `share` is not "
        "declared"
    )
    return TorqueVerdict("indeterminate", text, loose)


def _describe_flow(question: LoadedBalance, power: Fraction, resisted: bool) -> str:
    """Return a phrase that describes the power supplied or absorbed by the links whose torque is unknown, in one
    solution. `resisted` is True if they absorb power in the solution with minimum loss.
    """
    if power < 0:
        return f"power {decimal(-power, 6)} leaves at {question.names}, which resists"
    also = " as well, and all power is lost" if resisted else ""
    return f"{question.names} drives with power {decimal(power, 6)}{also}"


_Key = tuple[object, ...]


def find_shares(train: Train, circuits: Sequence[Circuit], loaded: Collection[str]) -> tuple[LoadShares, ...]:
    """Return, for each wheel with two or more pairs that declare a `share`, the fraction of its torque that each of
    these pairs transmits.

    loaded   links with an external torque or a brake

    The pairs of an idler do not share its torque, because each of them transmits the entire torque; they may share the
    torque of their other wheels.
    """
    by_wheel: dict[str, dict[str, Fraction]] = {}
    for gear in train.gears:
        if gear.share is not None:
            for wheel in gear.pair:
                by_wheel.setdefault(wheel, {})[gear.name] = gear.share.value
    meshing = Counter(link for each in circuits for link in {each.i, each.j, each.carrier})
    shared = ((train.wheels[wheel][0], parts) for wheel, parts in by_wheel.items() if len(parts) > 1)
    # an idler has two meshes and no other torque
    return tuple(each for each in shared if each[0] in loaded or each[0] == train.frame or meshing[each[0]] != 2)


def find_ties(
    circuits: Sequence[Circuit],
    meshes: Sequence[LoadedPair],
    known: Mapping[str, Fraction],
    singled: Collection[str],
) -> tuple[tuple[str, ...], ...]:
    """Return groups of corresponding pairs of equal planets. All pairs in a group have equal torques.

    Planets are equal if they have the same carrier and external torque, and if they mesh with the same wheels or with
    equal planets, with equal tooth counts and efficiencies. They are found by colour refinement.

    singled   links that are not equal to any other: the frame, braked, locked or requested links, and links with shares
    """
    apart = {*singled, *(circuit.carrier for circuit in circuits)}
    # pins in slots have different angles at equal planets
    apart |= {link for circuit in circuits if circuit.swings for link in (circuit.i, circuit.j)}
    meshing = _planet_meshes(circuits, meshes, apart)
    classes = _planet_classes(meshing, known)
    groups: dict[_Key, list[str]] = {}
    grouped: set[str] = set()
    # a mesh of two planets is grouped from the side of the class with the smaller number
    for planet in sorted(meshing, key=classes.__getitem__):
        for name, mate, key in meshing[planet]:
            if name not in grouped:
                grouped.add(name)
                groups.setdefault((classes[planet], classes.get(mate, -1), key), []).append(name)
    return tuple(tuple(names) for names in groups.values() if len(names) > 1)


def _planet_meshes(
    circuits: Sequence[Circuit], meshes: Sequence[LoadedPair], apart: Collection[str]
) -> dict[str, list[tuple[str, str, _Key]]]:
    """Return the meshes of each planet: name, mating link, and a key by which meshes of equal planets are matched."""
    found: dict[str, list[tuple[str, str, _Key]]] = {}
    for circuit, mesh in zip(circuits, meshes, strict=True):
        first, second = circuit.wheels if circuit.kind == "gear" else (circuit.i, circuit.j)
        ways = (mesh.forward, mesh.backward)
        at_first, at_second = mesh.torques(0)[:2]
        for planet, mate, wheel, own, other, losses in (
            (circuit.i, circuit.j, second, at_first, at_second, ways),
            (circuit.j, circuit.i, first, at_second, at_first, ways[::-1]),
        ):
            if planet not in apart:
                key = (circuit.carrier, wheel if mate in apart else None, own, other, losses)
                found.setdefault(planet, []).append((circuit.id, mate, key))
    return found


def _planet_classes(
    meshing: Mapping[str, Sequence[tuple[str, str, _Key]]], known: Mapping[str, Fraction]
) -> dict[str, int]:
    """Return the class of equal planets of each planet as a number, keyed by planet."""
    classes: dict[str, int] = {}
    while True:
        keys: dict[str, _Key] = {}
        for planet, found in meshing.items():
            around = sorted(((key, classes.get(mate, -1)) for _, mate, key in found), key=str)
            keys[planet] = (known.get(planet, Fraction(0)), classes.get(planet), *around)
        numbers = {key: at for at, key in enumerate(dict.fromkeys(keys.values()))}
        if len(numbers) == len(set(classes.values())):
            return classes
        classes = {planet: numbers[key] for planet, key in keys.items()}


@dataclass(frozen=True)
class TorqueQuestion:
    """Loads in one load case [N m, or numbers without a unit], and the links whose torques are computed."""

    loads: Mapping[str, Fraction]
    links: tuple[str, ...]
    enough: bool = True
    """True if the number of unknown torques equals the number of degrees of freedom.

    If the number of unknown torques is smaller, the loads must be in equilibrium without additional torques.
    """
    undecided: TorqueVerdict | None = None
    """Verdict that requests a further unknown torque, which is returned if the loads are not in equilibrium. None if no
    further torque is required.
    """


def find_torques(setting: LoadCase, flows_only: bool = False) -> Torques:
    """Compute the torques under the declared loads and the friction of bearings; see equations (3) to (8) and (10) of
    docs/torques.md.

    flows_only   True to omit the search for neglected effects, which requires the teeth of every pair
    """
    question = find_question(setting, setting.case.solve_for)
    if isinstance(question, TorqueVerdict):
        return Torques(setting.case.state, question)
    return _balanced(setting, question, flows_only=flows_only)


def find_idle_pairs(setting: LoadCase) -> Collection[str]:
    """Return the pairs that have no torque under the declared loads, whatever the losses are; empty if torques are
    undetermined.

    They correspond to the zero-force members of a truss.
    """
    # proof: nothing but such pairs acts on the links beyond them, so the balance of these links is homogeneous for all
    # efficiencies, which only scale its coefficients: the multipliers are 0, or open between redundant pairs
    question = find_question(setting, setting.case.solve_for)
    if isinstance(question, TorqueVerdict):
        return ()
    known = _acting(question.loads, _bearing_friction(setting, setting.bearings({})))
    return idle_pairs(generic_balance(build_balance(setting, known, question.links)))


def find_question(setting: LoadCase, solve_for: str | None) -> TorqueQuestion | TorqueVerdict:
    """Return the loads and the links of unknown torque, or a verdict with the reason why torques cannot be computed."""
    loads = {link: torque.base for link, torque in setting.case.loads.items()}
    if not loads and not any(map(setting.bearing, setting.train.links)) and not setting.train.has_jumpers:
        text = "no load is declared: give `loads` on links (negative against their motion) or `bearing` friction"
        return TorqueVerdict("unloaded", text)
    question = _requested(setting, loads, solve_for)
    if (verdict := _without_axis(setting, (*loads, *question.links))) is not None:
        return verdict
    links, speeds = question.links, setting.speeds
    if len(links) == 1 and speeds.get(links[0]) == 0 and any(speeds[link] for link in setting.case.inputs):
        return TorqueVerdict("still", f"'{links[0]}' does not turn, so a torque on it does no work")
    return question


def torques_unknown(state: str | None) -> Torques:
    """Return a result without torques. Its verdict states that the speeds in the state are undetermined."""
    return Torques(state, TorqueVerdict("still", "the speeds of this state are not determined"))


def resist(setting: LoadCase, drag: Mapping[str, Fraction]) -> Torques:
    """Compute the torques if the inputs drive the train against the torques `drag`, without friction of bearings."""
    if (verdict := _without_axis(setting, drag)) is not None:
        return Torques(setting.case.state, verdict)
    links = power_inputs(setting)
    question = TorqueQuestion(drag, links, len(links) == len(setting.case.inputs) and not setting.forms)
    return _balanced(setting, question, bearings=False, flows_only=True)


class EscapementTorques(NamedTuple):
    """Torque that drives a clock, and the resulting torque at its escape wheel [N m]."""

    source: str
    """Name of the link at which power enters the train."""
    torque: float
    """Torque at `source`, in its sense of rotation [N m]."""
    at_escape: float
    """Torque at the escape wheel, in its sense of rotation [N m]; 0 or less if friction stops the train."""
    without_bearings: float
    """Torque at the escape wheel if load-independent bearing friction is omitted [N m]."""
    lost_in_bearings: float
    """Fraction of the input power that is lost in bearings."""


def escapement_torques(setting: LoadCase) -> EscapementTorques | None:
    """Return the torque at the escape wheel of a clock under its only load, or, if there is no load, under its drive.
    Return None if neither drives the train with a known torque [N m], or if no torques balance.
    """
    escapement, case = setting.train.escapement, setting.case
    (source, torque), *more = case.loads.items() or [(power_inputs(setting)[0], None)]
    speed = setting.speeds.get(source)
    if more or escapement is None or not speed or source == escapement.link:
        return None
    way = 1 if speed > 0 else -1
    if torque is not None:
        known = torque.base if torque.unit is not None else Fraction(0)
    elif case.drive is None or any(each.unit is None for each in case.drive.torques):
        return None
    else:
        known = Fraction(case.drive.steady_torque or 0) * way
    # a load that resists does not drive the clock
    if known * way <= 0:
        return None
    question = TorqueQuestion({source: known}, (escapement.link,), len(case.inputs) == 1 and not setting.forms)
    # the pallets may turn, too
    ahead = setting.relative(escapement.link, setting.reacts_on(escapement.link)) or 0
    sense = setting.sense(escapement.link) * (1 if ahead > 0 else -1)
    found, without = (_balanced(setting, question, bearings, flows_only=True) for bearings in (True, False))
    if not found.verdict or not without.verdict:
        return None
    at_escape, lossless = (float(-each.external[escapement.link] * sense) for each in (found, without))
    lost = float(found.bearing_loss / found.power_in) if found.power_in else 0.0
    return EscapementTorques(source, float(known * way), at_escape, lossless, lost)


def drive(setting: LoadCase, load: str, source: str) -> Torques:
    """Compute the torques if `source` drives and a unit of power leaves at `load`, without friction of bearings."""
    if (verdict := _without_axis(setting, (load, source))) is not None:
        return Torques(setting.case.state, verdict)
    for link in (load, source):
        if not setting.speeds.get(link):
            why = "does not turn" if link in setting.speeds else "turns at a speed that is not determined"
            return Torques(setting.case.state, TorqueVerdict("still", f"'{link}' {why}"))
    # a single unknown torque is enough for one degree of freedom
    enough = len(setting.case.inputs) == 1 and not setting.forms
    # the torque that takes one unit of power out at this speed
    question = TorqueQuestion({load: -1 / setting.speeds[load]}, (source,), enough)
    return _balanced(setting, question, bearings=False)


def _requested(setting: LoadCase, loads: Mapping[str, Fraction], solve_for: str | None) -> TorqueQuestion:
    """Return the loads and the links of unknown torque: as many links as inputs, or fewer if the choice is unclear."""
    inputs, enter = setting.case.inputs, power_inputs(setting)
    free = tuple(link for link in enter if link not in loads)
    needed = len(inputs)
    if setting.forms and len(free) <= needed:
        # a freely turning link has no torque except a declared or requested one
        named = (solve_for,) if solve_for is not None and solve_for not in free else ()
        return TorqueQuestion(loads, (*free, *named), enough=False)
    if needed == 1 and solve_for is not None:
        free = (solve_for,)
    if len(free) == needed:
        return TorqueQuestion(loads, free)
    if len(free) > needed:  # a crank besides the inputs: one of the inputs has no torque
        certain, candidates = free[:1], free[1:]
    else:
        links = dict.fromkeys(output.of or name for name, output in setting.case.outputs.items())
        certain, candidates = free, tuple(link for link in links if link not in loads and link not in free)
    if solve_for:
        candidates = () if solve_for in certain else (solve_for,)
    lacking = needed - len(certain)
    if len(candidates) == lacking:
        return TorqueQuestion(loads, certain + candidates, enough=not setting.forms)
    loaded = ", ".join(link for link in enter if link in loads)
    why = f"{loaded} carries a load" if loaded else f"power enters at {enter[0]}, which is not an input"
    text = (
        f"{why}, so {lacking} other torque{'s' if lacking > 1 else ''} must be unknown (number of candidates: "
        f"{len(candidates)}): name one with `solve_for`"
    )
    certain += candidates if len(candidates) < lacking else ()
    return TorqueQuestion(loads, certain, False, TorqueVerdict("undecided", text, candidates))


def _without_axis(setting: LoadCase, links: Iterable[str]) -> TorqueVerdict | None:
    """Return the verdict that a torque on one of the links is undefined, because the link rotates about several axes
    that are not parallel; None if there is no such link.
    """
    sums = setting.axes.joint_sums
    for link in links:
        if link in sums:
            why = "the axes between it and the frame are not parallel, and its sum of joint speeds is not a rotation"
            return TorqueVerdict("undecided", f"a torque on '{link}' has no unique axis: {why}")
    return None


def _balanced(setting: LoadCase, unknown: TorqueQuestion, bearings: bool = True, flows_only: bool = False) -> Torques:
    constant = setting.bearings({}) if bearings else ()
    bearing_friction = _bearing_friction(setting, constant)
    known = _acting(unknown.loads, bearing_friction)
    state = setting.case.state
    if not unknown.enough and (lacking := find_imbalance(setting, known, unknown.links)) is not None:
        return Torques(state, _with_reason(unknown, lacking), unknown.links)
    from geartrain.dynamics.torques.mean_efficiencies import all_mean_efficiencies, apply_mean_efficiencies

    means = all_mean_efficiencies(setting)
    driving = sum((torque * setting.speeds.get(link, 0) for link, torque in unknown.loads.items()), Fraction(0)) > 0
    balance, neither = apply_mean_efficiencies(build_balance(setting, known, unknown.links, means), means, driving)
    question = LoadedBalance(
        balance, setting.speeds, unknown.loads, bearing_friction, unknown.enough, setting.open, constant
    )
    loads = None
    if any(part.friction_radius for part in setting.train.links.values()):
        from geartrain.dynamics.torques.bearing_loads import BearingLoads

        loads = BearingLoads(setting, bearings)
        question = replace(question, bearing_loads=loads)
    question, flows, complete = question.solve()
    if not flows and loads is not None and find_flow_patterns(balance)[0]:
        return Torques(state, _locked_bearings(question), unknown.links)
    if not flows and balance.senses and (any_way := find_flow_patterns(replace(balance, senses={}))[0]):
        names = _overrunning(setting, balance, any_way[0])
        text = f"{' and '.join(names)} would have to hold against the sense in which a one-way clutch can hold"
        return Torques(state, TorqueVerdict("overrunning", text, names), unknown.links)
    idle = [name for name, x in flows[0].solved.multipliers.items() if not x] if flows else []
    loose = flows[0].solved.loose if flows else ()
    neglected: tuple[NeglectedEffect, ...] = ()
    if not flows_only:
        from geartrain.dynamics.torques.neglected_effects import find_neglected_effects

        missed = [name for name in idle if name not in loose]
        neglected = find_neglected_effects(setting, means, neither, missed, bearings, loads, loose)
    verdict = find_torque_verdict(question, flows, complete, neglected)
    if not flows:
        verdict = _with_reason(unknown, verdict)
        return Torques(state, verdict, unknown.links, neglected=neglected)
    return _torques(setting, question.balance, flows[0], question.bearings, verdict, neglected)


def _overrunning(setting: LoadCase, balance: TorqueBalance, flow: FlowPattern) -> tuple[str, ...]:
    """Return the names of the holding one-way clutches whose torque has the wrong sense; if there are none, the names
    of those whose torque is undetermined.
    """
    senses = setting.case.senses
    held = [each for each in _held(setting, balance, flow) if each.links in senses]
    wrong = [each for each in held if each.torques and senses[each.links] * each.torques[-1] < 0]
    return tuple(each.clutch or "" for each in wrong or held if wrong or each.torques is None)


def _with_reason(question: TorqueQuestion, lacking: TorqueVerdict) -> TorqueVerdict:
    """Return the verdict `lacking`. If the question does not determine its unknown torques, the reason precedes the
    text.
    """
    if question.undecided is None:
        return lacking
    untried = [link for link in question.undecided.candidates if link not in question.links]
    if not untried and not lacking.candidates:
        return lacking
    text = f"{question.undecided.text}; {lacking.text}"
    return TorqueVerdict("undecided", text, tuple(untried) or lacking.candidates)


def build_balance(
    setting: LoadCase,
    known: Mapping[str, Fraction],
    requested: tuple[str, ...],
    means: Mapping[str, MeanEfficiencies] | None = None,
) -> TorqueBalance:
    """Build the torque balance of a train with the torques `known` and unknown torques on the links `requested`. All
    efficiencies are 1 if `means` is None.
    """
    case, train = setting.case, setting.train
    meshes = tuple(_mesh(setting, circuit, means[circuit.id] if means else None) for circuit in setting.circuits)
    locks = [(a, b) for a, b in case.locks if a != b]
    # reactions that do not act on the frame
    bases = {link: base for link in requested if (base := setting.reacts_on(link)) != train.frame}
    held = {*requested, *case.fixed, *(link for lock in locks for link in lock)}
    shares = find_shares(train, setting.circuits, {*held, *known})
    shared = {name for _, parts in shares for name in parts}
    # planets with declared shares need not be loaded equally
    planets = {link for mesh in meshes if mesh.id in shared for link in mesh.links[:2]}
    # planets with different pivots are not equal
    pivots = {link: Fraction(part.friction_radius) for link, part in train.links.items() if part.friction_radius}
    return TorqueBalance(
        tuple(link for link in train.links if link != train.frame),
        meshes,
        known,
        requested,
        tuple(link for link in case.fixed if link != train.frame),
        tuple(((a, setting.sense(a)), (b, setting.sense(b))) for a, b in locks),
        find_ties(setting.circuits, meshes, _acting(known, pivots), {train.frame} | held | planets),
        shares,
        {link: (base, -setting.sense(link) * setting.sense(base)) for link, base in bases.items()},
        case.senses,
    )


def _mesh(setting: LoadCase, circuit: Circuit, means: MeanEfficiencies | None) -> LoadedPair:
    """Return the coefficients, speed and efficiencies of a gear pair or coupling for the torque balance."""
    # a travel reacts on a link that slides and on a link that turns, other pairs on one link
    links = (circuit.i, circuit.j, *(circuit.subtracted if circuit.travels else circuit.subtracted[:1]))
    senses = tuple(map(setting.sense, links))
    relative = setting.turn(circuit) or Fraction(0)
    forward, backward = means.given(0, driving=False) if means else (Fraction(1), Fraction(1))
    a, b = circuit.a, circuit.b
    # the sign of a row is arbitrary: normalised, so that equal planets have equal rows for either order of their
    # wheels and for opposite axes
    if min(a * senses[0], b * senses[1], key=abs) < 0:
        a, b = -a, -b
    return LoadedPair(circuit.id, links, senses, a, b, a * relative, forward, backward)


def _acting(loads: Mapping[str, Fraction], bearing_friction: Mapping[str, Fraction]) -> dict[str, Fraction]:
    return {
        link: loads.get(link, Fraction(0)) + bearing_friction.get(link, Fraction(0))
        for link in {**loads, **bearing_friction}
    }


def _bearing_friction(setting: LoadCase, bearings: Sequence[BearingTorque]) -> dict[str, Fraction]:
    """Return the sum of the friction torques of bearings on each link [N m, or a number without a unit], by link."""
    found: dict[str, Fraction] = {}
    for bearing in bearings:
        for link, torque in ((bearing.link, bearing.torque), (bearing.carrier, bearing.reaction)):
            if link != setting.train.frame:
                found[link] = found.get(link, Fraction(0)) + torque
    return found


def _torques(
    setting: LoadCase,
    balance: TorqueBalance,
    flow: FlowPattern,
    bearings: tuple[BearingTorque, ...],
    verdict: TorqueVerdict,
    neglected: tuple[NeglectedEffect, ...],
) -> Torques:
    solved = flow.solved
    external = dict(balance.known)
    for found in (solved.external, solved.brakes):
        for link, torque in found.items():
            external[link] = external.get(link, Fraction(0)) + torque
    reactions = {
        link: (base, way * solved.external[link])
        for link, (base, way) in balance.reactions.items()
        if solved.external.get(link)
    }
    for base, torque in reactions.values():
        external[base] = external.get(base, Fraction(0)) + torque
    # bearing friction is internal, not external power; its loss depends only on the speeds in the joints
    for link, torque in _bearing_friction(setting, bearings).items():
        external[link] -= torque
    arms = setting.arms
    return Torques(
        setting.case.state,
        verdict,
        balance.unknown,
        {link: _load(arms, link, torque) for link, torque in external.items() if torque or link in solved.external},
        setting.speeds,
        {
            mesh.id: _pair(setting, mesh, circuit, flow)
            for mesh, circuit in zip(balance.meshes, setting.circuits, strict=True)
        },
        bearings,
        _held(setting, balance, flow),
        neglected,
        reactions,
        {each.name: each.slip for each in setting.case.one_way if not each.holds},
        arms,
    )


def _load(arms: Mapping[str, Fraction], link: str, torque: Fraction) -> Fraction:
    """Return the force [N] on a sliding link that a torque represents, or the torque itself if the link turns."""
    return torque / arms[link] if link in arms else torque


def _pair(setting: LoadCase, mesh: LoadedPair, circuit: Circuit, flow: FlowPattern) -> PairTorque:
    x = flow.solved.multipliers[mesh.id]
    # power flows from the first link to the second if the multiplier is opposite to the rolling speed
    ahead = ((x < 0) - (x > 0)) * mesh.turn
    return PairTorque(
        mesh.id,
        circuit.wheels[0 if ahead > 0 else 1] if ahead else "",
        mesh.links,
        tuple(
            # the frame takes the force of a travel if it does not slide with the pair
            x * torque / (TRAVEL_ARM if circuit.travels and at in (0, 2) else 1)
            for at, torque in enumerate(mesh.torques(flow.pattern.get(mesh.id, 0)))
        ),
        x,
        mesh.rolling if setting.turn(circuit) is not None else None,
        mesh.efficiency(ahead),
        mesh.id in flow.solved.loose,
        setting.means[mesh.id].exact,
    )


def _held(setting: LoadCase, balance: TorqueBalance, flow: FlowPattern) -> tuple[HoldingTorque, ...]:
    """Return the torques of all brakes and locks, each about the axis of the held link."""
    case, arms = setting.case, setting.arms
    found: list[tuple[tuple[str, ...], tuple[Fraction, ...] | None]] = []
    for link in balance.held:
        torque = flow.solved.brakes.get(link)
        found.append(((link,), None if torque is None else (_load(arms, link, torque),)))
    for ((a, sense), (b, other)), torque in zip(balance.locks, flow.solved.locks, strict=True):
        # the torque on the second link is the reaction to the torque on the first
        both = None if torque is None else (_load(arms, a, sense * torque), _load(arms, b, -other * torque))
        found.append(((a, b), both))
    causes = {links: case.causes.get(links, links) for links, _ in found}
    return tuple(
        HoldingTorque(links, torques, case.clutches.get(causes[links]), causes[links] if causes[links] != links else ())
        for links, torques in found
    )
