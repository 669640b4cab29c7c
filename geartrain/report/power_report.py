"""Torques, flow of power and losses of a train: as sections, and as figures for JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from geartrain.analysis.gear_train import GearTrain
from geartrain.numerics.decimal_text import percent_of_text, percent_text, watts_text
from geartrain.numerics.exact import as_float
from geartrain.numerics.plain_data import Key, Result
from geartrain.report.document import Document, Section, Table, cut, figure

if TYPE_CHECKING:
    from geartrain.dynamics import PowerFlow, PowerLoss, Torques, TorqueVerdict

_UNITS = (
    "Torques as loads are given; power is torque times speed in the train's unit, positive into the train; in a pair, "
    "in its carrier's frame. Brakes and locks: what they exert on what they hold."
)
_UNITS_IN_WATTS = (
    "Torques in N m; power is torque times speed in real time, positive into the train; in a pair, in its carrier's "
    "frame. Brakes and locks: what they exert on what they hold."
)


def describe_torques(train: GearTrain, found: Sequence[Torques]) -> Document:
    """Torques under the declared loads, one answer a state, and the efficiency there and back."""
    sections = [section for each in found for section in torque_sections(train, each)]
    lead = [f"Train '{train.name}'. {_units(train, found)}"]
    return Document(f"Torques of {train.name}", lead, sections)


def loaded_sections(train: GearTrain) -> Iterator[Section]:
    """Sections of all states with loads or friction of bearings; nothing, and free of cost, where there are none."""
    found = list(_loaded(train))
    sections = (section for each in found for section in torque_sections(train, each))
    for at, section in enumerate(sections):
        yield section if at else replace(section, paragraphs=(_units(train, found), *section.paragraphs))


def loaded_figures(train: GearTrain) -> tuple[TorqueFigures, ...]:
    """Torques of all states with loads or friction of bearings as plain data."""
    return tuple(collect_torques(train, each) for each in _loaded(train))


def _loaded(train: GearTrain) -> Iterator[Torques]:
    for state in train.states or (None,):
        if train.declaration.is_loaded(state):
            yield train.torques(state)


def torque_sections(train: GearTrain, found: Torques) -> Iterator[Section]:
    """Links, pairs and verdict of one state, then how power flows and where it is lost."""
    state = found.state
    head = "Torques" if state is None else f"State {state}: torques"
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    if found.verdict.kind == "undecided" and found.verdict.candidates:
        lines.append(f"It can be one of {', '.join(found.verdict.candidates)}.")
    lines += [f"Left out: {each}: {each.why}." for each in found.left_out]
    lines += _there_and_back(train, state)
    if not found.verdict:
        yield Section(head, lines)
        return
    amounts = _Amounts(train, found)
    efficiency, circulating = found.efficiency, found.circulating
    if efficiency is not None and circulating is not None:
        lines.append(
            f"Power in {amounts.text(found.power_in, 9)}, lost {amounts.text(found.loss, 9)}, efficiency "
            f"{figure(efficiency, 10)}{uncounted_words(found)}; the greatest power through a pair is "
            f"{figure(circulating, 5)} of it."
        )
    if found.bearing_loss:
        needed = ", ".join(f"at '{link}' {amounts.torque(found.external[link])}" for link in found.asked)
        lines.append(f"Torque needed, with the friction of bearings: {needed}{uncounted_words(found)}.")
    tables = [_links(found, amounts), *_held(found), _pairs(found, amounts)]
    yield Section(head, lines, tuple(tables))
    flow = train.power_flow(found)
    parts = tuple(_loops(flow, amounts)), tuple(_losses(flow, amounts, _blows(train, found)))
    if any(parts):
        yield Section("Flow of power" if state is None else f"State {state}: flow of power", *parts)


def _blows(train: GearTrain, found: Torques) -> Mapping[str, float]:
    """What the collisions of each pair dissipate (W), where inertias and a rate are declared."""
    return {pair: impact.power for pair, impact in train.impacts(found.state).items()}


class _Amounts:
    """Powers and torques in words: in watts and N m where they are real."""

    def __init__(self, train: GearTrain, found: Torques) -> None:
        from geartrain.dynamics.torques.power_flow import has_torque_units

        self.watts = _watts(train, found)
        self.unit = " N m" if has_torque_units(train.declaration, found.state) else ""

    def text(self, power: Fraction, digits: int = 7) -> str:
        return figure(power, digits) if self.watts is None else watts_text(float(power) * self.watts)

    def torque(self, torque: Fraction) -> str:
        return f"{figure(torque, 9)}{self.unit}"


def _watts(train: GearTrain, found: Torques) -> float | None:
    from geartrain.dynamics.torques.power_flow import watts_per_unit

    return watts_per_unit(train.declaration, train.declaration.case(found.state))


def _units(train: GearTrain, found: Sequence[Torques]) -> str:
    real = [_watts(train, each) is not None for each in found if each.verdict]
    return _UNITS_IN_WATTS if real and all(real) else _UNITS


def _links(found: Torques, amounts: _Amounts) -> Table:
    rows = [
        (
            link + (" (asked)" if link in found.asked else ""),
            figure(torque, 9),
            figure(found.speeds[link], 9) if link in found.speeds else "free",
            amounts.text(found.powers[link], 9) if link in found.speeds else "open",
        )
        for link, torque in found.external.items()
    ]
    return Table(("link", "torque", "speed", "power"), rows)


def _held(found: Torques) -> Iterator[Table]:
    """Brakes and locks, with what they exert on the links they hold."""
    rows = []
    for held in found.held:
        torques = ["open"] * len(held.links) if held.torques is None else [figure(each, 9) for each in held.torques]
        kind = "brake" if len(held.links) == 1 else "lock"
        name = f"{kind} {held.clutch}" if held.clutch else kind
        name += f" (for {' and '.join(held.cause)})" if held.cause else ""
        rows.append((name, ", ".join(held.links), torques[0], torques[1] if torques[1:] else ""))
    if rows:
        yield Table(("held by", "link", "torque on it", "on the second"), rows)


def uncounted_words(found: Torques) -> str:
    """What an efficiency does not count, to stand behind it."""
    uncounted = ", ".join(map(str, found.uncounted))
    return f" without {uncounted}" if uncounted else ", mean over a turn" if found.left_out else ""


def _pairs(found: Torques, amounts: _Amounts) -> Table:
    rows = [
        (
            pair.id + (" (shared)" if pair.loose else ""),
            pair.driver or ("open" if pair.power is None else "idle"),
            *(figure(torque, 7) for torque in pair.torques),
            "open" if pair.power is None else amounts.text(pair.power),
            "open" if pair.power is None else amounts.text(pair.loss),
        )
        for pair in found.pairs.values()
    ]
    return Table(("pair", "driver", "torque on first", "on second", "on carrier", "power", "loss"), rows)


# ------------------------------------------------------------------------------------------------------ flow and losses


def _loops(flow: PowerFlow, amounts: _Amounts) -> Iterator[str]:
    """Which pairs hand power round in circles, and how much."""
    if flow.loops:
        yield "Here power is torque times absolute speed, so that every shaft and pair gives on what it takes in."
    for loop in flow.loops:
        part = percent_of_text(loop.power / flow.power_in, "the power in") if flow.power_in else "no power in"
        yield (
            f"{amounts.text(loop.power)} circulates, {part}: through pairs {', '.join(loop.pairs)} and shafts "
            f"{', '.join(loop.shafts)}."
        )


def _losses(flow: PowerFlow, amounts: _Amounts, blows: Mapping[str, float]) -> Iterator[Table]:
    """What each pair and bearing loses, the total last; what collisions take stands in columns of its own."""
    if not flow.losses and not blows:
        return
    struck = [node for node in flow.nodes if node.kind == "pair" and node.name in blows]
    nodes = dict.fromkeys((*flow.losses, *struck))
    rows = []
    for node in nodes:
        pair = node.kind == "pair"
        row = _loss_row(flow, amounts, flow.losses.get(node, Fraction(0)), blows.get(node.name) if pair else None)
        rows.append((node.name if pair else f"bearing of {node.name}", *row))
    teeth = sum((loss for node, loss in flow.losses.items() if node.kind == "pair"), Fraction(0))
    if 0 < teeth < flow.loss:
        sums = {"all pairs": teeth, "all bearings": flow.loss - teeth}
        rows += [(name, *_loss_row(flow, amounts, lost, None)) for name, lost in sums.items()]
    rows.append(("total", *_loss_row(flow, amounts, flow.loss, sum(blows.values()) if blows else None)))
    header: tuple[str, ...] = ("where", "lost", "of power in", "of all lost")
    if blows:
        header = ("where", "sliding", "of power in", "of all sliding", "impact", "of power in")
    yield Table(header, cut([row[: len(header)] for row in rows]))


def _loss_row(flow: PowerFlow, amounts: _Amounts, lost: Fraction, blow: float | None) -> tuple[str, ...]:
    """A loss with its shares, then what collisions dissipate, and its share."""
    parts = (percent_text(lost / whole) if whole else "-" for whole in (flow.power_in, flow.loss))
    if blow is None:
        return (amounts.text(lost), *parts, "", "")
    whole = float(flow.power_in) * (amounts.watts or 0.0)
    return (amounts.text(lost), *parts, watts_text(blow), percent_text(Fraction(blow / whole)) if whole else "-")


# ------------------------------------------------------------------------------------------------------ there and back


def _there_and_back(train: GearTrain, state: str | None) -> Iterator[str]:
    for torques, first, last in train.drive_both_ways(state):
        efficiency = torques.efficiency
        if torques.verdict.kind == "self-locking":
            yield f"'{last}' cannot be driven from '{first}': the train locks."
        elif efficiency is not None:
            word = " (ambiguous)" if torques.verdict.kind == "ambiguous" else ""
            yield f"Efficiency from '{first}' to '{last}': {figure(efficiency, 10)}{word}{uncounted_words(torques)}."


# ---------------------------------------------------------------------------------------------------------- plain data


class Impact(NamedTuple):
    """Power (W) that the collisions of a pair dissipate."""

    impact: float


@dataclass(frozen=True)
class LossFigures:
    """What a pair or bearing loses; of a pair whose collisions are known, their `impact`."""

    KEYS = (Key("", "loss"), Key("", "collisions"))

    loss: PowerLoss
    collisions: Impact | None


@dataclass(frozen=True)
class DrivenFigures:
    """The efficiency of a train driven one way; None where it is not determined."""

    KEYS = ("verdict", Key("efficiency", to=as_float), Key("exact", "efficiency"), Key("left_out", "torques.left_out"))

    torques: Torques

    @property
    def verdict(self) -> TorqueVerdict:
        """Whether the train can be driven so."""
        return self.torques.verdict

    @property
    def efficiency(self) -> Fraction | None:
        """Power out over power in; None where it is not determined."""
        return self.torques.efficiency if self.verdict else None


class DrivenWays(NamedTuple):
    """Driven from the input, and from the output."""

    forward: DrivenFigures
    backward: DrivenFigures


@dataclass(frozen=True)
class TorqueFigures(Result):
    """Torques, flow of power and losses of one state.

    drives           None where it is not plain which link is the output
    watts_per_unit   None where torques or speeds are plain numbers
    """

    KEYS = (Key("", "torques"), "drives", "watts_per_unit", "losses", "flow")

    torques: Torques
    drives: DrivenWays | None
    watts_per_unit: float | None
    losses: tuple[LossFigures, ...]
    flow: PowerFlow


@dataclass(frozen=True)
class TorqueReport(Result):
    """Torques of a train in every state that was asked for."""

    name: str
    title: str
    states: tuple[TorqueFigures, ...]


def collect_torque_report(train: GearTrain, found: Sequence[Torques]) -> TorqueReport:
    """Torques of some states."""
    return TorqueReport(train.name, train.declaration.title, tuple(collect_torques(train, each) for each in found))


def collect_torques(train: GearTrain, found: Torques) -> TorqueFigures:
    """Torques of one state, with the flow of power and the efficiency there and back."""
    flow, blows, ways = train.power_flow(found), _blows(train, found), train.drive_both_ways(found.state)
    struck = {name: Impact(power) for name, power in blows.items()}
    return TorqueFigures(
        found,
        DrivenWays(*(DrivenFigures(way.torques) for way in ways)) if ways else None,
        _watts(train, found),
        tuple(
            LossFigures(loss, struck.get(loss.node.name) if loss.node.kind == "pair" else None) for loss in flow.shares
        ),
        flow,
    )
