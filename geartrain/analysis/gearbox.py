"""Ratios, steps, slip, torques and power flow of a gearbox in all its states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from geartrain.dynamics.torques.power_flow import PowerNode, PowerStream, find_circulation, find_power_flow
from geartrain.dynamics.torques.train_torques import solve_driven
from geartrain.errors import Problem, QuestionError, check_choice
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.results import Key, Result, Tabular

if TYPE_CHECKING:
    from geartrain.dynamics import Torques
    from geartrain.dynamics.torques.power_flow import PowerFlow
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.answer import Answer, Verdict
    from geartrain.train import Train
    from geartrain.train.states import Clutch

ElementKind = Literal["brake", "clutch", "one-way brake", "one-way clutch"]


@dataclass(frozen=True)
class GearState(Result):
    """Results for one state of a gearbox: speeds, ratio, slip and torques of clutches, and recirculating power."""

    KEYS = (
        *("state", "engaged", "one_way", "verdict", "ratio", Key("step", to=as_float), "driven_by", "speeds", "slips"),
        *(Key(name, to=as_float) for name in ("torques", "efficiency", "recirculating", "mesh_power")),
    )

    state: str
    """Name of the state."""
    engaged: tuple[str, ...]
    """Names of the closed clutches and brakes, including one-way clutches that are engaged."""
    verdict: Verdict
    """Verdict on the speeds. A neutral state is free, and a park state is locked."""
    ratio: Fraction | None
    """Speed of the input divided by that of the output [1]; None if one is at rest or undetermined."""
    step: Fraction | None
    """Ratio of this state divided by that of the next state [1]; None without two ratios of one sign."""
    driven_by: str
    """Name of the link whose speed is the unit of `speeds` and `slips`: the input, or another turning input if the
    input is at rest. If no input turns, this name is empty, and `speeds` and `slips` are in the speed unit of the
    train.
    """
    speeds: Mapping[str, Fraction]
    """Speed of each link divided by the speed of `driven_by`. Links whose speed is undetermined are omitted."""
    slips: Mapping[str, Fraction]
    """Slip of each open brake (speed of its link) or clutch (first link relative to second), divided by the speed of
    `driven_by`. Undetermined slips are omitted.
    """
    torques: Mapping[str, Fraction | None]
    """Torque of each closed brake on its link, or clutch on its first link, divided by the torque of the input; None if
    statically indeterminate. Empty if the torques of the train are not determined.
    """
    efficiency: Fraction | float | None
    """Output power divided by input power; None if the torques are not determined."""
    recirculating: Fraction | None
    """Power that recirculates between gear sets, divided by the input power; None if the torques are not determined."""
    mesh_power: Fraction | None
    """Maximum power of a pair relative to its carrier, divided by the input power; None if undetermined."""
    one_way: tuple[str, ...] = ()
    """Names of the one-way clutches that transmit a torque, which they do only while the input drives."""

    @property
    def applied(self) -> tuple[str, ...]:
        """Names of the closed clutches and brakes that are actuated. One-way clutches are omitted."""
        return tuple(name for name in self.engaged if name not in self.one_way)


@dataclass(frozen=True)
class Shift(Result):
    """Shift from one state to another, with the clutches and brakes that open and those that close."""

    KEYS = ("before", "after", "released", "applied", "is_double")

    before: str
    """Name of the state before the shift."""
    after: str
    """Name of the state after the shift."""
    released: tuple[str, ...]
    """Names of the clutches and brakes that open. One-way clutches are omitted."""
    applied: tuple[str, ...]
    """Names of the clutches and brakes that close. One-way clutches are omitted."""

    @property
    def is_double(self) -> bool:
        """True if more than one element opens or more than one element closes (double-transition shift)."""
        return max(len(self.released), len(self.applied)) > 1


@dataclass(frozen=True)
class ShiftElement(Result):
    """Clutch or brake, with its maximum torque and its maximum slip speed over all states of the gearbox."""

    KEYS = ("name", "kind", "states", Key("torque", to=as_float), "torque_state", "slip", "slip_state")

    name: str
    """Name of the clutch or brake."""
    kind: ElementKind
    """Kind of the element: "brake", "clutch", "one-way brake" or "one-way clutch"."""
    states: tuple[str, ...]
    """Names of the states in which the element is closed."""
    torque: Fraction | None
    """Torque of maximum magnitude over all states, divided by the torque of the input; None if it is undetermined."""
    torque_state: str
    """Name of the state in which `torque` occurs; empty if `torque` is None."""
    slip: Fraction | None
    """Maximum slip of the open element over all states, divided by the speed of `driven_by`; None if undetermined."""
    slip_state: str
    """Name of the state in which `slip` occurs; empty if `slip` is None."""


@dataclass(frozen=True)
class Gearbox(Tabular, Result):
    """Results for all states of a train with clutches.

    See Also
    --------
    geartrain.GearTrain.gearbox : method that returns it
    """

    MEANINGS: ClassVar = {
        "state": "Name of the state.",
        "engaged": "Engaged clutches and brakes.",
        "ratio": "Speed of the input divided by speed of the output [1].",
        "step": "Ratio divided by the ratio of the next state [1].",
        "efficiency": "Output power divided by input power [1].",
        "recirculating": "Power that recirculates between gear sets, divided by input power [1].",
        "speed of *": "Speed of the link divided by speed of the input [1].",
    }

    PAGE = "report.gearbox_report:describe_gearbox"

    KEYS = ("name", "title", "input", "output", Key("spread", to=as_float), "states", "elements", "shifts")

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    input: str
    """Name of the input link."""
    output: str
    """Name of the output link."""
    states: tuple[GearState, ...]
    """Results of all states, in the order of declaration."""
    elements: tuple[ShiftElement, ...]
    """Clutches and brakes in the order of declaration."""
    shifts: tuple[Shift, ...]
    """Shifts between consecutive states that have ratios of the same sign. States without a ratio are skipped."""

    def _summary(self) -> str:
        ratios = ", ".join(f"{each.state} {float(each.ratio):.4g}" for each in self.states[:6] if each.ratio)
        return f"{self.name}: {len(self.states)} states, ratios {ratios}" + (", ..." if len(self.states) > 6 else "")

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with a row for each state: closed elements, ratios, efficiency, power, and link speeds."""
        links = dict.fromkeys(link for each in self.states for link in each.speeds)
        numbers = {
            name: [_optional_float(getattr(each, name)) for each in self.states]
            for name in ("ratio", "step", "efficiency", "recirculating")
        }
        speeds = {link: [_optional_float(each.speeds.get(link)) for each in self.states] for link in links}
        return {
            "state": [each.state for each in self.states],
            "engaged": [", ".join(each.engaged) for each in self.states],
            **numbers,
            **{f"speed of {link}": values for link, values in speeds.items()},
        }

    @property
    def spread(self) -> Fraction | None:
        """Maximum ratio of the forward states divided by their minimum ratio [1]; None if there is no forward state."""
        ratios = [each.ratio for each in self.states if each.ratio is not None and each.ratio > 0]
        return max(ratios) / min(ratios) if ratios else None


def _optional_float(value: Fraction | None) -> float | None:
    return None if value is None else as_float(value)


def find_gearbox(train: TrainMechanics, output: str | None = None) -> Gearbox:
    """Compute ratios, slips, torques and power flow of all states of a train with clutches; see `GearTrain.gearbox`."""
    source, link = gearbox_ends(train.declaration, output)
    answers = [train.kinematics.solve(name) for name in train.declaration.states]
    found = [_state(train, answer, source, link) for answer in answers]
    # a step from a forward to a reverse gear would be negative, and without meaning
    for at, (one, other) in enumerate(pairwise(found)):
        if one.ratio is not None and other.ratio is not None and one.ratio * other.ratio > 0:
            found[at] = replace(one, step=one.ratio / other.ratio)
    elements, shifts = tuple(_elements(train, found)), tuple(_shifts(found))
    own = train.declaration
    return Gearbox(own.name, own.title, source, link, tuple(found), elements, shifts)


def gearbox_ends(declared: Train, output: str | None) -> tuple[str, str]:
    """Return the names of the input link and the output link; raise `QuestionError` if the train is not a gearbox."""
    if not declared.clutches or not declared.states:
        what = f"'{declared.name}' is not a gearbox"
        why = "a gearbox declares `clutches`, and `states` that engage them"
        raise QuestionError(Problem(what, why, "declare `clutches`, and `states` with lists of `engaged` clutches"))
    case = declared.case(declared.state_or_first(None))
    source = next((link for link, speed in case.inputs.items() if speed), None)
    if source is None:
        what = f"'{declared.name}' has no input that turns"
        why = "a ratio is the speed of the input divided by the speed of the output"
        raise QuestionError(Problem(what, why, "declare a non-zero speed under `inputs`"))
    names = [name for name, each in case.outputs.items() if each.links(name, declared.frame)[0] != source]
    if output is None and not names:
        what = f"'{declared.name}' has no output other than its input"
        why = "a ratio is the speed of the input divided by the speed of an output"
        raise QuestionError(Problem(what, why, "declare the driven link under `outputs`"))
    if output is not None:
        check_choice("output", output, case.outputs)
    name = output or names[0]
    return source, case.outputs[name].links(name, declared.frame)[0]


def _state(train: TrainMechanics, answer: Answer, source: str, link: str) -> GearState:
    declared, state = train.declaration, answer.state or ""
    case = declared.case(state)
    engaged, given = case.closed, case.inputs
    # unit of speed: the input, or another input if the input is at rest
    drive = next((name for name in (source, *given) if answer.speeds.get(name)), "")
    unit = Fraction(answer.speeds[drive]) if drive else 1
    speeds = {name: Fraction(speed) / unit for name, speed in answer.speeds.items()}
    every = {name: _slip(speeds, clutch) for name, clutch in declared.clutches.items() if name not in engaged}
    slips = {name: slip for name, slip in every.items() if slip is not None}
    out, load = speeds.get(link), _load(train, state, source, link) if answer.verdict else None
    # equal planets count as one, so that the mesh power is their common power
    shared = load if train.planets_as_one is train else _load(train.planets_as_one, state, source, link)
    return GearState(
        state,
        engaged,
        answer.verdict,
        # with another link as the unit of speed, the input is at rest or undetermined
        1 / out if out and drive == source else None,
        None,
        drive,
        speeds,
        slips,
        {} if load is None else _torques(load, source, {name: declared.clutches[name].links for name in engaged}),
        None if load is None else load.efficiency,
        None if load is None or shared is None else _circulation(shared),
        None if load is None or shared is None else shared.circulating,
        tuple(each.name for each in case.one_way if each.name in engaged),
    )


def _slip(speeds: Mapping[str, Fraction], clutch: Clutch) -> Fraction | None:
    """Return the slip: speed of the first link minus that of the second, or of a braked link; None if undetermined."""
    one, other = clutch.locks or (clutch.fixes or "", "")
    if one not in speeds or (other and other not in speeds):
        return None
    return speeds[one] - (speeds[other] if other else 0)


def _load(train: TrainMechanics, state: str, source: str, link: str) -> Torques | None:
    """Return the torques if power enters at `source` and unit power leaves at `link`; None if they are undetermined."""
    found = solve_driven(train, link, source, state)
    # torques are divided by the input torque, so a torque of 0 counts as undetermined
    return found if found.verdict and found.external.get(source) else None


def _torques(load: Torques, source: str, engaged: Mapping[str, tuple[str, ...]]) -> dict[str, Fraction | None]:
    """Return the torque of each closed clutch divided by the input torque; None if clutches connect the same links."""
    drive, held = load.external[source], {each.links: each.torques for each in load.held}
    known = {name: held[links] for name, links in engaged.items() if links in held}
    # elements that hold the same links share their torque in an unknown ratio
    known |= {name: None for name, links in engaged.items() if list(engaged.values()).count(links) > 1}
    return {name: None if torques is None else torques[0] / drive for name, torques in known.items()}


def _circulation(load: Torques) -> Fraction | None:
    """Return the power that recirculates between gear sets divided by the input power; None if the input power is 0."""
    flow = find_power_flow(load)
    if not flow.power_in:
        return None
    _, loops = find_circulation(_between_sets(load, flow), flow.power_in)
    return sum((loop.power for loop in loops), Fraction(0)) / flow.power_in


def _between_sets(load: Torques, flow: PowerFlow) -> list[PowerStream]:
    """Return the power that flows between the gear sets of a train.

    A gear set is a group of pairs that have the same carrier and are connected by links other than the carrier.
    """
    sets: dict[str, str] = {}
    for carrier in dict.fromkeys(pair.links[2] for pair in load.pairs.values()):
        own = {name: pair.links[:2] for name, pair in load.pairs.items() if pair.links[2] == carrier}
        links = dict.fromkeys(link for ends in own.values() for link in ends)
        for group in joined_groups(links, own.values()):
            sets |= {name: f"{carrier}: {group[0]}" for name, ends in own.items() if ends[0] in group}

    def node(end: PowerNode) -> PowerNode:
        return end._replace(name=sets[end.name]) if end.kind == "pair" else end

    net: dict[tuple[PowerNode, PowerNode], Fraction] = {}
    for stream in flow.streams:
        ends = node(stream.source), node(stream.target)
        # opposite streams between the same nodes cancel
        net[ends] = net.get(ends, Fraction(0)) + stream.power - net.pop(ends[::-1], Fraction(0))
    directed = ((ends, power) if power > 0 else (ends[::-1], -power) for ends, power in net.items() if power)
    return [PowerStream(source, target, power) for (source, target), power in directed]


def _shifts(states: Sequence[GearState]) -> Iterator[Shift]:
    running = [each for each in states if each.ratio is not None]
    for one, other in pairwise(running):
        if one.ratio is not None and other.ratio is not None and one.ratio * other.ratio > 0:
            released = tuple(name for name in one.applied if name not in other.applied)
            applied = tuple(name for name in other.applied if name not in one.applied)
            yield Shift(one.state, other.state, released, applied)


def _elements(train: TrainMechanics, states: Sequence[GearState]) -> Iterator[ShiftElement]:
    for name, clutch in train.declaration.clutches.items():
        closed = tuple(each.state for each in states if name in each.engaged)
        torque, at = _maximum((each.state, each.torques.get(name)) for each in states)
        slip, where = _maximum((each.state, each.slips.get(name)) for each in states)
        kind: ElementKind = "brake" if clutch.fixes is not None else "clutch"
        if clutch.one_way is not None:
            kind = "one-way brake" if clutch.fixes is not None else "one-way clutch"
        yield ShiftElement(name, kind, closed, torque, at, slip, where)


def _maximum(values: Iterable[tuple[str, Fraction | None]]) -> tuple[Fraction | None, str]:
    known = [(value, state) for state, value in values if value is not None]
    return max(known, key=lambda each: abs(each[0]), default=(None, ""))
