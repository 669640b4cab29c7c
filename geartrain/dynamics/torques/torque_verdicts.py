"""Verdicts on torques: why nothing balances, which of several balances is given, where the input must drive as well.

Sections 5, 6, 8 and 11 of docs/torques.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.dynamics.torques.flow_patterns import FlowPattern, find_flow_patterns
from geartrain.dynamics.torques.load_case import LoadCase
from geartrain.dynamics.torques.torque_balance import TorqueBalance
from geartrain.dynamics.torques.torque_results import NeglectedEffect, TorqueVerdict
from geartrain.dynamics.torques.virtual_work import balancing_torque, unbalanced_motions
from geartrain.numerics.exact import decimal

_GREAT = 10**12  # lambda of section 6: beside a load so many times as great, constant friction hardly matters


@dataclass(frozen=True)
class LoadedBalance:
    """A balance with what stands behind its known torques: loads, and friction of bearings.

    enough   as many torques are unknown as the train has freedoms; else the loads must balance of themselves
    open     links whose speed is not determined
    """

    balance: TorqueBalance
    speeds: Mapping[str, Fraction]
    loads: Mapping[str, Fraction]
    rubbing: Mapping[str, Fraction]
    enough: bool = True
    open: tuple[str, ...] = ()

    @property
    def names(self) -> str:
        """The links asked for."""
        return ", ".join(self.balance.unknown) or "any link"

    @property
    def load(self) -> str:
        """What the train works against, in words."""
        return "the load" if self.loads else "the friction of the bearings"

    @property
    def driving(self) -> Fraction:
        """Power that the loads put in, less what they take out."""
        return self._power(self.loads)

    @property
    def rubs(self) -> bool:
        """True if friction of bearings stands beside a load."""
        return any(self.loads.values()) and any(self.rubbing.values())

    def power(self, flow: FlowPattern) -> Fraction:
        """Power that the links asked for put in."""
        return self._power(flow.solved.external)

    def _power(self, torques: Mapping[str, Fraction]) -> Fraction:
        """Power at the links whose speed is determined."""
        return sum((torque * self.speeds.get(link, 0) for link, torque in torques.items()), Fraction(0))

    def heavily_loaded(self) -> tuple[FlowPattern, ...]:
        """Flows where the load is so great that constant friction hardly matters."""
        known = dict(self.rubbing)
        for link, torque in self.loads.items():
            known[link] = known.get(link, Fraction(0)) + _GREAT * torque
        return find_flow_patterns(replace(self.balance, known=known))[0]


def find_imbalance(setting: LoadCase, known: Mapping[str, Fraction], asked: Sequence[str]) -> TorqueVerdict | None:
    """The verdict on loads that the links asked for cannot hold, losses apart; None where they can."""
    motions = unbalanced_motions(setting.system, known, asked)
    if not motions:
        return None
    moving = {link for motion in motions if motion.power for link in motion.speeds}
    outputs = (output.of or name for name, output in setting.case.outputs.items())
    borne = (link for link in setting.train.links if setting.tree.parent.get(link, ("",))[0] == setting.train.frame)
    likely = [link for link in dict.fromkeys((*setting.case.inputs, *outputs, *borne)) if link in moving]
    torques = {link: torque for link in likely if (torque := balancing_torque(motions, link)) is not None}
    helpful = {link: torque for link, torque in torques.items() if not known.get(link)}
    amounts = [f"{decimal(torque, 6)} at {link}" for link, torque in helpful.items()] or [
        f"{decimal(torque, 6)} more at {link}" for link, torque in torques.items()
    ]
    fix = f"; it would take {' or '.join(amounts[:3])}" if amounts else ""
    held = f"with {', '.join(asked)} held still they" if asked else "they"
    text = f"the loads do not balance: {held} set {_some(likely or sorted(moving))} turning{fix}"
    return TorqueVerdict("unbalanced", text, tuple(helpful))


def _some(links: Sequence[str]) -> str:
    """Some links by name, and how many more."""
    more = f" and {len(links) - 3} more" if links[3:] else ""
    return ", ".join(links[:3]) + more


def find_torque_verdict(
    question: LoadedBalance, flows: Sequence[FlowPattern], complete: bool, left_out: Sequence[NeglectedEffect] = ()
) -> TorqueVerdict:
    """The verdict on flows, the first of which is the one given: with least left open, and least lost."""
    if not flows:
        return _none(question, complete)
    but = _but(left_out)
    if any(flow.solved.loose or flow.solved.open or None in flow.solved.locks for flow in flows):
        verdict = _open(flows, question)
        return replace(verdict, text=verdict.text + but)
    if len(flows) > 1:
        verdict = _several(question, flows)
        return replace(verdict, text=verdict.text + but)
    sure = "" if complete else "; other patterns of power flow were not tried"
    source = "the loads" if question.loads else question.load
    free = f"; {_some(question.open)} turn freely: torques do not depend on their speeds" if question.open else ""
    return TorqueVerdict(
        "incomplete" if left_out else "determined",
        f"every torque follows from {source}{but}{_help(question, flows[0])}{free}{sure}",
    )


def _but(left_out: Sequence[NeglectedEffect]) -> str:
    """What is not counted, in a few words."""
    uncounted: dict[str, list[str]] = {}
    for each in left_out:
        if each.counts:
            uncounted.setdefault(each.what, []).extend(each.where)
    if uncounted:
        named = [f"{what} ({', '.join(where)})" for what, where in uncounted.items()]
        return f", but for {', '.join(named)}"
    return ", as a mean over a turn" if left_out else ""


def _none(question: LoadedBalance, complete: bool) -> TorqueVerdict:
    """Why no torques balance: shares, bearings, or teeth."""
    names = question.names
    if not question.enough:
        text = "the loads balance while nothing is lost, and do not with the losses: an unknown torque is lacking"
        return TorqueVerdict("unbalanced", text)
    if shares := question.balance.shares:
        pairs = dict.fromkeys(name for _, parts in shares for name in parts)
        if find_flow_patterns(replace(question.balance, shares=()))[0]:
            text = f"the declared shares of {', '.join(pairs)} contradict the balance, which holds without them"
            return TorqueVerdict("contradictory", text)
    if question.rubs and question.heavily_loaded():
        text = (
            f"the load is too small to overcome the friction of the bearings, and no torque on {names} makes up for "
            "it while the train turns this way; its teeth do not lock: a greater load turns it"
        )
        return TorqueVerdict("stalled", text)
    sure = "" if complete else " (not every pattern of power flow was tried)"
    great = ", however great: its teeth lock, not its bearings" if question.rubs else ""
    text = f"no torque on {names} balances {question.load} while the train turns this way{great}{sure}"
    return TorqueVerdict("self-locking", text)


def _help(question: LoadedBalance, flow: FlowPattern) -> str:
    """What to say where the load drives, and yet does not do it alone."""
    if question.driving <= 0 or question.power(flow) <= 0:
        return ""
    heavy = question.heavily_loaded() if question.rubs else ()
    if any(question.power(each) <= 0 for each in heavy):
        return (
            f"; the load is too small to overcome the friction of the bearings, so {question.names} must drive as well"
        )
    return f"; no load this way round drives the train, for its teeth lose it all: {question.names} must drive as well"


def _open(flows: Sequence[FlowPattern], question: LoadedBalance) -> TorqueVerdict:
    """What redundant pairs, brakes and locks leave open."""
    loose = tuple(dict.fromkeys(name for flow in flows for name in flow.solved.loose))
    links = list(flows[0].solved.open)
    locks = zip(question.balance.locks, flows[0].solved.locks, strict=True)
    links += [f"the lock of {a} and {b}" for ((a, _), (b, _)), torque in locks if torque is None]
    if not loose:
        text = f"the torque on {', '.join(links)} is not determined: brakes and locks share it in no certain way"
        return TorqueVerdict("indeterminate", text, flows[0].solved.open)
    also = f", nor is the torque on {', '.join(links)}" if links else ""
    text = f"how {', '.join(loose)} share their load is not determined{also}: redundant pairs; `share` declares it"
    return TorqueVerdict("indeterminate", text, loose)


def _several(question: LoadedBalance, flows: Sequence[FlowPattern]) -> TorqueVerdict:
    """Name the flow that is given, and mention the others."""
    given, *others = (question.power(flow) for flow in flows)
    rest = " or ".join(_way(question, power, given < 0) for power in others)
    text = (
        f"{len(flows)} patterns of power flow balance {question.load}: in the one given, which loses least, "
        f"{_way(question, given, False)}; in {'others' if others[1:] else 'the other'} {rest}"
    )
    return TorqueVerdict("ambiguous", text)


def _way(question: LoadedBalance, power: Fraction, resisted: bool) -> str:
    """One flow in words; `resisted` is said where power leaves in the flow that is given."""
    if power < 0:
        return f"power {decimal(-power, 6)} leaves at {question.names}, which resists"
    also = " as well, and all is lost" if resisted else ""
    return f"{question.names} drives with power {decimal(power, 6)}{also}"
