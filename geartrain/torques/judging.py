"""Verdicts on torques: why nothing balances, which of several balances is given, and who must help whom."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.exact import decimal
from geartrain.torques.balance import Balance
from geartrain.torques.directions import Flow, find_flows
from geartrain.torques.result import TorqueVerdict

_GREAT = 10**12  # a load so many times as great makes constant friction as good as nothing


@dataclass(frozen=True)
class Question:
    """A balance with what stands behind its known torques: loads, and friction of bearings."""

    balance: Balance
    speeds: Mapping[str, Fraction]
    loads: Mapping[str, Fraction]
    rubbing: Mapping[str, Fraction]

    @property
    def names(self) -> str:
        """The links asked for."""
        return ", ".join(self.balance.unknown)

    @property
    def load(self) -> str:
        """What the train works against, in words."""
        return "the load" if self.loads else "the friction of the bearings"

    @property
    def driving(self) -> Fraction:
        """Power that the loads put in, less what they take out."""
        return sum((torque * self.speeds[link] for link, torque in self.loads.items()), Fraction(0))

    @property
    def rubs(self) -> bool:
        """True if friction of bearings stands beside a load."""
        return any(self.loads.values()) and any(self.rubbing.values())

    def power(self, flow: Flow) -> Fraction:
        """Power that the links asked for put in."""
        return sum((torque * self.speeds[link] for link, torque in flow.solved.external.items()), Fraction(0))

    def heavily_loaded(self) -> tuple[Flow, ...]:
        """Flows where the load is so great that constant friction hardly matters."""
        known = dict(self.rubbing)
        for link, torque in self.loads.items():
            known[link] = known.get(link, Fraction(0)) + _GREAT * torque
        return find_flows(replace(self.balance, known=known))[0]


def judge(question: Question, flows: Sequence[Flow], complete: bool) -> TorqueVerdict:
    """The verdict on flows, the first of which is the one given: with least left open, and least lost."""
    if not flows:
        return _none(question, complete)
    if any(flow.solved.loose for flow in flows):
        return _open(flows)
    if len(flows) > 1:
        return _several(question, flows)
    sure = "" if complete else "; other patterns of power flow were not tried"
    source = "the loads" if question.loads else question.load
    return TorqueVerdict("determined", f"every torque follows from {source}{_help(question, flows[0])}{sure}")


def _none(question: Question, complete: bool) -> TorqueVerdict:
    """Why no torques balance: shares, bearings, or teeth."""
    names = question.names
    if shares := question.balance.shares:
        pairs = dict.fromkeys(name for _, parts in shares for name in parts)
        if find_flows(replace(question.balance, shares=()))[0]:
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


def _help(question: Question, flow: Flow) -> str:
    """What to say where the load drives, and yet does not do it alone."""
    if question.driving <= 0 or question.power(flow) <= 0:
        return ""
    heavy = question.heavily_loaded() if question.rubs else ()
    if any(question.power(each) <= 0 for each in heavy):
        return (
            f"; the load is too small to overcome the friction of the bearings, so {question.names} must drive as well"
        )
    return f"; no load this way round drives the train, for its teeth lose it all: {question.names} must drive as well"


def _open(flows: Sequence[Flow]) -> TorqueVerdict:
    """What redundant pairs leave open."""
    loose = tuple(dict.fromkeys(name for flow in flows for name in flow.solved.loose))
    links = ", ".join(flows[0].solved.open)
    also = f", nor is the torque on {links}" if links else ""
    text = f"how {', '.join(loose)} share their load is not determined{also}: redundant pairs; `share` declares it"
    return TorqueVerdict("indeterminate", text, loose)


def _several(question: Question, flows: Sequence[Flow]) -> TorqueVerdict:
    """Name the flow that is given, and mention the others."""
    given, *others = (question.power(flow) for flow in flows)
    rest = " or ".join(_way(question, power, given < 0) for power in others)
    text = (
        f"{len(flows)} patterns of power flow balance {question.load}: in the one given, which loses least, "
        f"{_way(question, given, False)}; in {'others' if others[1:] else 'the other'} {rest}"
    )
    return TorqueVerdict("ambiguous", text)


def _way(question: Question, power: Fraction, resisted: bool) -> str:
    """One flow in words; `resisted` is said where power leaves in the flow that is given."""
    if power < 0:
        return f"power {decimal(-power, 6)} leaves at {question.names}, which resists"
    also = " as well, and all is lost" if resisted else ""
    return f"{question.names} drives with power {decimal(power, 6)}{also}"
