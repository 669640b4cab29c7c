"""Torques of a train in one case: what acts on each link and pair, where power flows, and what is lost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, Literal

from geartrain.exact import as_float
from geartrain.frozen import FrozenFields

Kind = Literal[
    "determined",
    "self-locking",
    "stalled",
    "ambiguous",
    "indeterminate",
    "contradictory",
    "undecided",
    "unloaded",
    "still",
]


@dataclass(frozen=True)
class TorqueVerdict:
    """Whether the torques follow from the loads.

    determined      they do
    self-locking    no torques balance the load, however great, while the train turns this way
    stalled         none balance this load, which is too small to overcome the friction of bearings
    ambiguous       several patterns of power flow do; the one that loses least is given
    indeterminate   some tooth torques share a load in proportions that nothing here decides
    contradictory   declared shares of pairs do not go with the balance
    undecided       it is not plain which torque is to be found: `candidates`
    unloaded        no load and no friction of a bearing is declared
    still           the train does not turn, or its speeds are not determined
    """

    kind: Kind
    text: str
    candidates: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return self.kind in ("determined", "ambiguous", "indeterminate")

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"kind": self.kind, "text": self.text, "candidates": list(self.candidates)}


@dataclass(frozen=True)
class PairTorque:
    """One gear pair or coupling under load.

    driver      the wheel (or link) that drives in the carrier's frame; "" where nothing flows
    torques     on the first link, the second and the carrier
    multiplier  of its row, `rolling` of which is the power, and `efficiency` what is left of it
    loose       the balance does not determine it
    """

    id: str
    driver: str
    links: tuple[str, str, str]
    torques: tuple[Fraction, Fraction, Fraction]
    multiplier: Fraction
    rolling: Fraction
    efficiency: Fraction
    loose: bool = False

    @cached_property
    def power(self) -> Fraction:
        """Power that the driver puts in, in the carrier's frame: torque times the train's speeds."""
        # worked out when asked for: both factors have many digits in a long train
        return abs(self.multiplier * self.rolling)

    @property
    def loss(self) -> Fraction:
        """Power lost."""
        return self.power * (1 - self.efficiency)

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "driver": self.driver,
            "torques": dict(zip(("first", "second", "carrier"), map(as_float, self.torques), strict=True)),
            "power": as_float(self.power),
            "loss": as_float(self.loss),
            "shared": self.loose,
        }


@dataclass(frozen=True)
class Torques(FrozenFields):
    """External torques by link, torques and powers by pair, and the balance of power, all exact.

    external    on every link that has one: loads, bearings, what was asked for, brakes
    asked       the links whose torque was found
    """

    state: str | None
    verdict: TorqueVerdict
    asked: tuple[str, ...] = ()
    external: Mapping[str, Fraction] = field(default_factory=dict)
    speeds: Mapping[str, Fraction] = field(default_factory=dict)
    pairs: Mapping[str, PairTorque] = field(default_factory=dict)
    bearing_loss: Fraction = Fraction(0)

    @property
    def powers(self) -> Mapping[str, Fraction]:
        """External power by link, positive into the train."""
        return {link: torque * self.speeds[link] for link, torque in self.external.items()}

    @property
    def power_in(self) -> Fraction:
        """Power that enters."""
        return sum((power for power in self.powers.values() if power > 0), Fraction(0))

    @property
    def loss(self) -> Fraction:
        """Power lost in pairs and bearings; what goes in and does not come out, where some pairs are open."""
        if any(pair.loose for pair in self.pairs.values()):
            return self._missing
        return sum((pair.loss for pair in self.pairs.values()), self.bearing_loss)

    @property
    def efficiency(self) -> Fraction | None:
        """Power out over power in; None where nothing goes in, or a torque asked for is open."""
        if not self.power_in or any(link not in self.external for link in self.asked):
            return None
        return 1 - self._missing / self.power_in

    @property
    def _missing(self) -> Fraction:
        return sum(self.powers.values(), Fraction(0))

    @property
    def circulating(self) -> Fraction | None:
        """The greatest power through a pair over the power put in; above 1 power circulates. None where one is open."""
        if not self.power_in or any(pair.loose for pair in self.pairs.values()):
            return None
        return max((pair.power for pair in self.pairs.values()), default=Fraction(0)) / self.power_in

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        efficiency, circulating = self.efficiency, self.circulating
        return {
            "state": self.state,
            "verdict": self.verdict.to_dict(),
            "efficiency": None if efficiency is None else as_float(efficiency),
            "circulating": None if circulating is None else as_float(circulating),
            "links": {
                link: {"torque": as_float(torque), "power": as_float(self.powers[link]), "asked": link in self.asked}
                for link, torque in self.external.items()
            },
            "pairs": {name: pair.to_dict() for name, pair in self.pairs.items()},
            "power_in": as_float(self.power_in),
            "loss": as_float(self.loss),
        }
