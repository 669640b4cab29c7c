"""Torques of a train in one state: torques on each link and pair, power flow, and losses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar, Literal, NamedTuple

from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, Tabular, TrainResult, brief, imported_function


@dataclass(frozen=True)
class LinkTorque(Result):
    """External torque on a link, and its power."""

    KEYS = (Key("torque", to=as_float), Key("power", to=as_float), "requested")

    torque: Fraction
    """External torque on the link, or force on a link that slides [N m or N, or a number without a unit]."""
    power: Fraction | None
    """Power that the torque supplies to the train [unit of torque times the train's unit of speed]; None if the speed
    is undetermined.
    """
    requested: bool
    """True if the torque was computed because it was requested, False if it was declared."""


@dataclass(frozen=True)
class HoldingTorque(Result):
    """Brake on one link or lock between two links, and the torques that it exerts."""

    KEYS = ("links", "clutch", Key("cause", "declared_cause"), Key("torques", "by_link", as_float))

    links: tuple[str, ...]
    """Name of the braked link, or names of the two links that are locked together, as a tuple."""
    torques: tuple[Fraction, ...] | None
    """Torque on each of the links about its own axis [N m, or a number without a unit]; None if undetermined."""
    clutch: str | None = None
    """Name of the brake or clutch; None if it has no name."""
    cause: tuple[str, ...] = ()
    """Links of the declared lock that implies this brake or lock; empty if the brake or lock is itself declared.

    A lock across several axes locks every joint on the path between its links.
    """

    @property
    def declared_cause(self) -> tuple[str, ...] | None:
        """Links of the declared lock that implies this brake or lock; None if the brake or lock is itself declared."""
        return self.cause or None

    @property
    def by_link(self) -> Mapping[str, Fraction] | None:
        """Torque on each held link [N m, or a number without a unit]; None if undetermined."""
        return None if self.torques is None else dict(zip(self.links, self.torques, strict=True))


class MemberTorques(NamedTuple):
    """Torques on the two links and on the carrier of a gear pair or coupling [N m, or numbers without a unit]. For a
    link that slides, the value is a force [N].
    """

    first: Fraction
    """Torque on the first link of the pair [N m, or a number without a unit]."""
    second: Fraction
    """Torque on the second link of the pair [N m, or a number without a unit]."""
    carrier: Fraction
    """Torque on the carrier of the pair [N m, or a number without a unit]."""


@dataclass(frozen=True)
class BearingTorque(Result):
    """Friction torques of one bearing, equation (10) of docs/torques.md."""

    KEYS = ("link", "carrier", *(Key(key, to=as_float) for key in ("torque", "reaction", "loss")), "load")

    link: str
    """Link that turns in the bearing."""
    carrier: str
    """Link that carries the bearing."""
    torque: Fraction
    """Torque on the link about its own axis [N m, or a number without a unit]; 0 at rest or for unknown speed."""
    reaction: Fraction
    """Torque on the carrier about its own axis [N m, or a number without a unit]; 0 if the carrier is the frame."""
    loss: Fraction
    """Power lost in the bearing [unit of torque times the train's unit of speed]; it is not negative."""
    load: float | None = None
    """Load on the bearing, or total load on two bearings [N]; None if friction does not depend on it."""


@dataclass(frozen=True)
class PairTorque(Result):
    """Gear pair or coupling under load; see equations (2) and (4) to (6) of docs/torques.md."""

    KEYS = (
        "driver",
        Key("torques", "on_members", as_float),
        Key("power", to=as_float),
        Key("loss", to=as_float),
        Key("shared", "loose"),
    )

    id: str
    """Name of the pair or coupling."""
    driver: str
    """Wheel or link that drives relative to the carrier; "" if no power flows."""
    links: tuple[str, ...]
    """Names of the first link, second link and carrier of the pair. If one link slides and the other turns, the
    reaction of the force acts on the third link, and the reaction of the torque on a fourth link.
    """
    torques: tuple[Fraction, ...]
    """Torques on `links` about their own axes, or forces on sliding links [N m or N, or numbers without a unit]."""
    multiplier: Fraction
    """Multiplier x of the pair's Willis equation a (w_i - w_k) + b (w_j - w_k) = 0. Without losses, the torque on the
    first link is a x.
    """
    rolling: Fraction | None
    """Rolling speed, which is the coefficient a of the Willis equation times the speed of the first link relative to
    the carrier; None if undetermined.

    The power from the first link to the second is -x times this speed, where x is the `multiplier` of the pair.
    """
    share: Fraction
    """Efficiency of the pair if its carrier is at rest and `driver` drives; 1 for a pair without losses."""
    loose: bool = False
    """True if the balance of torques does not determine the torque of the pair."""
    exact: bool = True
    """False if `share` is a mean over positions of the teeth, which is a float with 15 digits."""

    @property
    def forces(self) -> tuple[bool, ...]:
        """Flag for each of the `links`: True if a force acts on the link, False if a torque acts on it."""
        return (True, False, True, False) if len(self.links) == 4 else (False,) * 3

    @property
    def efficiency(self) -> Fraction | float:
        """Basic efficiency (carrier at rest) if `driver` drives; a float if it is a mean over tooth positions."""
        return self.share if self.exact else float(self.share)

    @property
    def on_members(self) -> MemberTorques:
        """Torques on first link, second link and carrier [N m, or numbers without a unit]."""
        return MemberTorques(self.torques[0], self.torques[1], self.torques[-1])

    @cached_property
    def power(self) -> Fraction | None:
        """Power input of the driver relative to the carrier [unit of torque times the train's unit of speed]; None if
        undetermined.
        """
        # computed on demand, because both factors have many digits in a long train
        if self.rolling is None:
            return None if self.multiplier else Fraction(0)
        return abs(self.multiplier * self.rolling)

    @property
    def loss(self) -> Fraction:
        """Power lost in the pair [unit of torque times the train's unit of speed]; 0 if the speed is undetermined."""
        return (self.power or Fraction(0)) * (1 - self.share)


TorqueVerdictKind = Literal[
    "determined",
    "incomplete",
    "self-locking",
    "stalled",
    "ambiguous",
    "indeterminate",
    "contradictory",
    "unbalanced",
    "overrunning",
    "undecided",
    "unloaded",
    "still",
]


@dataclass(frozen=True)
class TorqueVerdict(Result):
    """Verdict on whether and how the loads determine the torques; see sections 5, 8, 11 and 13 of docs/torques.md.

    The truth value is True if torques are returned, which is the case for `determined`, `incomplete`, `ambiguous` and
    `indeterminate`.

    Kinds:

    - `determined`: all torques follow from the loads, and no declared effect is neglected.
    - `incomplete`: all torques follow from the loads, but `Torques.neglected` lists neglected effects.
    - `self-locking`: no torques, however large, balance the load while the train turns in this sense.
    - `stalled`: no torques balance this load, which is too small to overcome the friction of bearings.
    - `ambiguous`: several patterns of power flow balance the load; the one with minimum loss is returned.
    - `indeterminate`: some pairs share a load in proportions that the declaration does not determine.
    - `contradictory`: declared shares of pairs contradict the balance.
    - `unbalanced`: the loads set the train in motion, and no torques on the requested links can balance them.
    - `overrunning`: a one-way clutch that must hold would overrun.
    - `undecided`: the unknown torque could act on several links.
    - `unloaded`: no load and no friction of a bearing is declared.
    - `still`: the train or the requested link is at rest, or the speed is undetermined.

    Examples
    --------
    >>> import geartrain
    >>> geartrain.load("planetary-24-18-60").torques().verdict.kind
    'unloaded'
    """

    kind: TorqueVerdictKind
    """Kind of the verdict, from the list in the description of the class."""
    text: str
    """Verdict and its reason in one sentence."""
    candidates: tuple[str, ...] = ()
    """Links whose torque may be requested (`solve_for`), links whose torque can balance the loads, or pairs whose
    torques are unknown, depending on `kind`.
    """

    def _summary(self) -> str:
        return f"{self.kind}: {self.text}"

    def __bool__(self) -> bool:
        return self.kind in ("determined", "incomplete", "ambiguous", "indeterminate")


@dataclass(frozen=True)
class NeglectedEffect(Result):
    """Declared effect that is neglected in the calculation of torques; see docs/torques.md, section 13."""

    what: str
    """Neglected effect, such as `friction of bearings` or `variation within a turn`."""
    where: tuple[str, ...]
    """Names of the affected pairs or links."""
    why: str
    """Reason why the effect is neglected."""

    @property
    def counts(self) -> bool:
        """True if the neglected effect changes mean values. False if it causes only variations within a revolution, or
        determines only which of two known mean values applies.
        """
        return self.what not in ("variation within a turn", "mean efficiency")

    def __str__(self) -> str:
        return f"{self.what} ({', '.join(self.where)})"


class DrivenWay(NamedTuple):
    """Torques of a train in which the link `source` drives and a unit of power leaves at the link `load`."""

    torques: Torques
    """Torques of the driven train, with the `efficiency` in this direction."""
    source: str
    """Link at which power enters the train."""
    load: str
    """Link at which power leaves the train."""


@dataclass(frozen=True)
class Torques(FrozenFields, Tabular, TrainResult):
    """Exact torques and powers of a train in one state, from the torque balance, equation (3) of docs/torques.md.

    Torques are in N m if loads have units, and numbers without a unit if they do not. The unit of power is the unit of
    torque times the train's unit of speed. Powers are positive if they flow into the train.

    Examples
    --------
    Both pairs of a planetary set have an efficiency of 0.98, and the ring is fixed. The efficiency from sun to carrier
    is (1 + p e) / (1 + p), where p = 60/24 and e = 0.98^2 (see the table in section 10 of docs/torques.md):

    >>> import geartrain
    >>> found = geartrain.load('''
    ... extends: planetary-24-18-60
    ... gears: [{pair: [s, p], efficiency: 0.98}, {pair: [p, ring], efficiency: 0.98}]
    ... loads: {carrier: -10 N m}
    ... ''').torques()
    >>> found.verdict.kind, float(found.efficiency), round((1 + 60/24 * 0.98**2) / (1 + 60/24), 12)
    ('determined', 0.9717142857142858, 0.971714285714)
    >>> round(float(found.external["sun"]), 6), found.pairs["s~p"].driver
    (2.940312, 's')
    """

    MEANINGS: ClassVar = {
        "link": "Link with an external torque.",
        "torque": "External torque on the link",
        "speed": "Speed of the link; empty if it is not determined",
        "power": "Power that the torque supplies to the train; empty if the speed is not determined",
    }

    PAGE = "report.torque_report:torques_document"

    KEYS = (
        "state",
        "verdict",
        Key("efficiency", to=as_float),
        Key("circulating", to=as_float),
        Key("links", "link_torques"),
        "held",
        "pairs",
        "bearings",
        Key("power_in", "known_power_in", as_float),
        Key("loss", "known_loss", as_float),
        "neglected",
    )

    state: str | None
    """Name of the state; None for a train without states."""
    verdict: TorqueVerdict
    """Verdict on whether the loads determine the torques. If its truth value is False, only `verdict` and
    `neglected` have values.
    """
    requested: tuple[str, ...] = ()
    """Links whose external torque was computed from the torque balance."""
    external: Mapping[str, Fraction] = field(default_factory=dict)
    """External torque on each link, or force on a link that slides [N m or N, or a number without a unit], including
    loads, requested torques and brakes.
    """
    speeds: Mapping[str, Fraction] = field(default_factory=dict)
    """Speed of each link whose speed is determined [the train's unit of speed]."""
    pairs: Mapping[str, PairTorque] = field(default_factory=dict)
    """Torques and power of each gear pair and coupling, by name."""
    bearings: tuple[BearingTorque, ...] = ()
    """Friction torques of bearings; empty if no friction of bearings is declared."""
    held: tuple[HoldingTorque, ...] = ()
    """Brakes and locks, and the torques that they exert."""
    neglected: tuple[NeglectedEffect, ...] = ()
    """Declared effects that are not included in the torques."""
    reactions: Mapping[str, tuple[str, Fraction]] = field(default_factory=dict)
    """Reactions that do not act on the frame. For each such link in `requested`, they are the link on which the
    reaction acts, such as the link of the pallets, and the torque on that link, which is included in `external`.
    """
    overrunning: Mapping[str, Fraction | None] = field(default_factory=dict)
    """Slip speed of each overrunning one-way clutch [the train's unit of speed], by clutch; None if it is undetermined.
    An overrunning clutch transmits no torque.
    """
    arms: Mapping[str, Fraction] = field(default_factory=dict)
    """Lever arm of the force on each link that slides [m]. The power is the force times this arm times the angular
    speed, where a travel of 1 mm corresponds to one turn.
    """

    def power(self, link: str, load: Fraction) -> Fraction:
        """Return the power of a torque or force on a link [unit of torque times the train's unit of speed].

        Parameters
        ----------
        link : str
            Link whose speed is determined.
        load : Fraction
            Torque on the link, or force on a link that slides.
        """
        return load * self.arms.get(link, 1) * self.speeds[link]

    def _meaning(self, column: str) -> str:
        text = self.MEANINGS[column]
        return text if column == "link" else f"{text} [{self._units[column]}]."

    @property
    def _units(self) -> Mapping[str, str]:
        """Units of torque, speed and power in the table of torques, as text, by name of the column."""
        declared = self._declaration
        torque, speed = "N m, or the unit of the loads", "the train's unit of speed"
        if declared is not None:
            torque = "N m" if declared.has_torque_units(self.state) else "numbers without a unit"
            speed = declared.unit_name or "numbers without a unit"
        return {"torque": torque, "speed": speed, "power": f"{torque} x {speed}"}

    def _summary(self) -> str:
        figures = [f"{link} {brief(as_float(self.external[link]))}" for link in self.requested if link in self.external]
        if self.verdict and (efficiency := self.efficiency) is not None:
            figures.append(f"efficiency {as_float(efficiency):.6g}")
        return f"{self._named}: {', '.join([self.verdict.kind, *figures])}".strip()

    @property
    def powers(self) -> Mapping[str, Fraction]:
        """External power of each link whose speed is determined [unit of torque times the train's unit of speed];
        positive if it flows into the train.
        """
        return {link: self.power(link, load) for link, load in self.external.items() if link in self.speeds}

    @property
    def link_torques(self) -> Mapping[str, LinkTorque]:
        """External torque on each link, and its power."""
        powers = self.powers
        return {
            link: LinkTorque(torque, powers.get(link), link in self.requested) for link, torque in self.external.items()
        }

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table of external torques: torque, speed and power as floats, None if undetermined."""
        speeds, powers = ((each.get(link) for link in self.external) for each in (self.speeds, self.powers))
        return {
            "link": [*self.external],
            "torque": [as_float(torque) for torque in self.external.values()],
            "speed": [None if speed is None else as_float(speed) for speed in speeds],
            "power": [None if power is None else as_float(power) for power in powers],
        }

    def plot(self) -> Any:
        """Return a matplotlib figure of the power flow under these torques."""
        return imported_function("drawing.power_sankey", "power_figure")(self, self.state or "")

    @property
    def open_speeds(self) -> tuple[str, ...]:
        """Links with an external torque whose speed, and therefore power, is undetermined."""
        return tuple(link for link, torque in self.external.items() if torque and link not in self.speeds)

    @property
    def uncounted(self) -> tuple[NeglectedEffect, ...]:
        """Neglected effects that change powers and efficiency. Variations within a revolution are not included, because
        they do not change mean values.
        """
        return tuple(each for each in self.neglected if each.counts)

    @property
    def power_in(self) -> Fraction:
        """Power that enters the train [unit of torque times the train's unit of speed]."""
        powers = dict(self.powers)
        for link, (base, torque) in self.reactions.items():
            # power passes between both links of a reaction only through their relative motion
            passed = torque * self.speeds.get(base, Fraction(0))
            powers[link], powers[base] = powers[link] + passed, powers[base] - passed
        return sum((power for power in powers.values() if power > 0), Fraction(0))

    @property
    def bearing_loss(self) -> Fraction:
        """Power lost in bearings [unit of torque times the train's unit of speed]."""
        return sum((bearing.loss for bearing in self.bearings), Fraction(0))

    @property
    def loss(self) -> Fraction:
        """Power lost in pairs and bearings [unit of torque times the train's unit of speed]; it equals the net external
        power if torques of pairs are undetermined.
        """
        if any(pair.loose for pair in self.pairs.values()):
            return self._missing
        return sum((pair.loss for pair in self.pairs.values()), self.bearing_loss)

    @property
    def known_power_in(self) -> Fraction | None:
        """Power that enters the train [unit of torque times the train's unit of speed]; None if the speed of a loaded
        link is undetermined.
        """
        return None if self.open_speeds else self.power_in

    @property
    def known_loss(self) -> Fraction | None:
        """Power lost in pairs and bearings [unit of torque times the train's unit of speed]; None if the speed of a
        loaded link is undetermined.
        """
        return None if self.open_speeds else self.loss

    @property
    def efficiency(self) -> Fraction | float | None:
        """Power output divided by power input; a float if efficiencies of pairs are means over positions of the teeth,
        or if the friction of bearings depends on their load.

        It is None if no power enters, or if a requested torque or the speed of a loaded link is undetermined.
        """
        if not self.power_in or self.open_speeds or any(link not in self.external for link in self.requested):
            return None
        # the net external power is the loss, even if torques of pairs are undetermined
        found = 1 - self._missing / self.power_in
        exact = all(pair.exact for pair in self.pairs.values()) and all(each.load is None for each in self.bearings)
        return found if exact else float(found)

    @property
    def _missing(self) -> Fraction:
        return sum(self.powers.values(), Fraction(0))

    @property
    def circulating(self) -> Fraction | None:
        """Maximum power through a pair divided by the power input; None if a power is undetermined.

        Power recirculates if this quotient exceeds 1.
        """
        powers = [None if pair.loose else pair.power for pair in self.pairs.values()]
        known = [power for power in powers if power is not None]
        if not self.power_in or self.open_speeds or len(known) < len(powers):
            return None
        return max(known, default=Fraction(0)) / self.power_in
