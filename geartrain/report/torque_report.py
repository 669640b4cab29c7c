"""Torques, flow of power and losses of a train, as a page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.numerics.exact import percent_of_text, percent_text, watts_text
from geartrain.report.document import Document, Section, Table, cut, figure
from geartrain.report.torque_figures import DrivenWays, TorqueFigures, TorqueReport
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.dynamics import PowerFlow, Torques

_UNITS = (
    "Torques as loads are given; power is torque times speed in the train's unit, positive into the train; in a pair, "
    "in its carrier's frame. Brakes and locks: what they exert on what they hold."
)
_UNITS_IN_WATTS = (
    "Torques in N m; power is torque times speed in real time, positive into the train; in a pair, in its carrier's "
    "frame. Brakes and locks: what they exert on what they hold."
)


def describe_torques(found: TorqueReport) -> Document:
    """Torques under the declared loads, state by state: verdict, efficiency both ways, links, pairs, flow and losses.

    Where they were asked for, the torque over some turns follows, and trials of its friction.

    Parameters
    ----------
    found : TorqueReport
        From `collect_torque_report`.

    Returns
    -------
    Document
        Torques in the unit of the loads; powers in watts where loads and speeds have units.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.report import collect_torque_report
    >>> train = geartrain.GearTrain.declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}},
    ...     "b": {"wheels": {"w": 40}}}, "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}, "loads": {"b": 3},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}]})
    >>> page = describe_torques(collect_torque_report(train, [train.torques()]))
    >>> page.sections[0].tables[0].rows[1]
    ('a (solved for)', '1.5', '1', '1.5')
    """
    sections = [section for each in found.states for section in torque_sections(each)]
    if found.over_turn is not None:
        from geartrain.report.torque_cycle_report import cycle_sections

        sections += cycle_sections(found.over_turn)
    if found.friction_trials is not None:
        sections += wing("workshop.monte_carlo.friction_trials_report").trial_sections(found.friction_trials)
    lead = [f"Train '{found.name}'. {_units(found.states)}"]
    return Document(f"Torques of {found.name}", lead, sections)


def loaded_sections(found: Sequence[TorqueFigures]) -> Iterator[Section]:
    """Sections of the loaded states of a train."""
    sections = (section for each in found for section in torque_sections(each))
    for at, section in enumerate(sections):
        yield section if at else replace(section, paragraphs=(_units(found), *section.paragraphs))


def torque_sections(figures: TorqueFigures) -> Iterator[Section]:
    """Links, pairs and verdict of one state, then how power flows and where it is lost."""
    found, flow = figures.torques, figures.flow
    state = found.state
    head = "Torques" if state is None else f"State {state}: torques"
    lines = [f"Verdict: {found.verdict.kind}: {found.verdict.text}."]
    if found.verdict.kind == "undecided" and found.verdict.candidates:
        lines.append(f"It can be one of {', '.join(found.verdict.candidates)}.")
    lines += [f"Left out: {each}: {each.why}." for each in found.left_out]
    lines += _there_and_back(figures.drives)
    if not found.verdict:
        yield Section(head, lines)
        return
    amounts = _Amounts(figures)
    efficiency, circulating = found.efficiency, found.circulating
    if efficiency is not None and circulating is not None:
        kept = f"efficiency {figure(efficiency, 6)}{uncounted_words(found)}" if efficiency else "nothing is taken out"
        lines.append(
            f"Power in {amounts.text(found.power_in, 6)}, lost {amounts.text(found.loss, 6)}, {kept}; "
            f"the greatest power through a pair is {figure(circulating, 5)} times that."
        )
    if found.bearing_loss:
        needed = ", ".join(f"at '{link}' {amounts.torque(found.external[link])}" for link in found.asked)
        lines.append(f"Torque needed, with the friction of bearings: {needed}{uncounted_words(found)}.")
    tables = [_links(found, amounts), *_held(found), _pairs(found, amounts)]
    yield Section(head, lines, tuple(tables))
    parts = tuple(_loops(flow, amounts)), tuple(_losses(flow, amounts, figures.blows))
    if any(parts):
        yield Section("Flow of power" if state is None else f"State {state}: flow of power", *parts)


class _Amounts:
    """Powers and torques in words: in watts and N m where they are real."""

    def __init__(self, found: TorqueFigures) -> None:
        self.watts = found.watts_per_unit
        self.unit = " N m" if found.in_newton_metres else ""

    def text(self, power: Fraction, digits: int = 6) -> str:
        return figure(power, digits) if self.watts is None else watts_text(float(power) * self.watts)

    def torque(self, torque: Fraction) -> str:
        return f"{figure(torque, 6)}{self.unit}"


def _units(found: Sequence[TorqueFigures]) -> str:
    real = [each.watts_per_unit is not None for each in found if each.torques.verdict]
    return _UNITS_IN_WATTS if real and all(real) else _UNITS


def _links(found: Torques, amounts: _Amounts) -> Table:
    rows = [
        (
            link + (" (solved for)" if link in found.asked else ""),
            figure(torque, 6),
            figure(found.speeds[link], 6) if link in found.speeds else "free",
            amounts.text(found.powers[link], 6) if link in found.speeds else "open",
        )
        for link, torque in found.external.items()
    ]
    return Table(("link", "torque", "speed", "power"), rows)


def _held(found: Torques) -> Iterator[Table]:
    """Brakes and locks, with what they exert on the links they hold."""
    rows = []
    for held in found.held:
        torques = ["open"] * len(held.links) if held.torques is None else [figure(each, 6) for each in held.torques]
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
            *(figure(torque, 6) for torque in pair.torques),
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


def summary_text(torques: Torques) -> str:
    """Efficiency, or why there is none, and what is lost where."""
    if not torques.verdict or not torques.power_in:
        return torques.verdict.text
    teeth = torques.loss - torques.bearing_loss
    lost = {"teeth": teeth, "bearings": torques.bearing_loss}
    named = [f"{percent_text(power / torques.power_in)} is lost in {where}" for where, power in lost.items() if power]
    out = percent_text(1 - torques.loss / torques.power_in)
    uncounted = [f"left out: {', '.join(map(str, torques.left_out))}"] if torques.left_out else []
    return "; ".join([f"{out} of the power that enters comes out", *named, *uncounted])


# ------------------------------------------------------------------------------------------------------ there and back


def _there_and_back(drives: DrivenWays | None) -> Iterator[str]:
    for way in drives or ():
        torques, first, last = way.way
        efficiency = torques.efficiency
        if torques.verdict.kind == "self-locking":
            yield f"'{last}' cannot be driven from '{first}': the train locks."
        elif efficiency is not None:
            word = " (ambiguous)" if torques.verdict.kind == "ambiguous" else ""
            yield f"Efficiency from '{first}' to '{last}': {figure(efficiency, 6)}{word}{uncounted_words(torques)}."
