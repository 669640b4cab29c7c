"""Torques of a train in one case: what acts on each link and pair, where power flows, and what is lost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, ClassVar, Literal, NamedTuple

from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, Tabular, TrainResult, brief, picture_maker


@dataclass(frozen=True)
class LinkTorque(Result):
    """An external torque on a link, its power (None where the speed is open), and whether it was asked for."""

    KEYS = (Key("torque", to=as_float), Key("power", to=as_float), "requested")

    torque: Fraction
    """External torque on the link."""
    power: Fraction | None
    """Power that it puts into the train; None where the speed is not determined."""
    requested: bool
    """True if the torque was requested, False if it was given."""


@dataclass(frozen=True)
class HoldingTorque(Result):
    """A brake on one link, or a lock of two, with the torques it exerts on them.

    See Also
    --------
    Torques.held : where these stand.
    """

    KEYS = ("links", "clutch", Key("cause", "declared_cause"), Key("torques", "by_link", as_float))

    links: tuple[str, ...]
    """The link that is held, or the two that turn together."""
    torques: tuple[Fraction, ...] | None
    """On each of the links about its own axis [N m, or plain]; None where they are open."""
    clutch: str | None = None
    """Its name, if it has one."""
    cause: tuple[str, ...] = ()
    """The links that are declared to be held, where these follow from it: a rigid connection across several axes
    closes every joint on its way."""

    @property
    def declared_cause(self) -> tuple[str, ...] | None:
        """The cause; None where what is held is what is declared."""
        return self.cause or None

    @property
    def by_link(self) -> Mapping[str, Fraction] | None:
        """The torques by link; None where they are open."""
        return None if self.torques is None else dict(zip(self.links, self.torques, strict=True))


class MemberTorques(NamedTuple):
    """Torques on the members of a gear pair or coupling."""

    first: Fraction
    """On the first wheel."""
    second: Fraction
    """On the second wheel."""
    carrier: Fraction
    """On the carrier."""


class BearingTorque(NamedTuple):
    """Friction of one bearing: equation (10) of docs/torques.md.

    See Also
    --------
    Torques.bearings : where these stand.
    """

    link: str
    """The link that turns in the bearing."""
    carrier: str
    """The link that bears it."""
    torque: Fraction
    """Torque on the link about its own axis [N m, or plain]; 0 where the bearing rests or its speed is not
    determined."""
    reaction: Fraction
    """Torque on the carrier about its own axis [N m, or plain]; 0 also where the frame bears it."""
    loss: Fraction
    """Power it takes, 0 or more [torque times the train's unit of speed]."""


@dataclass(frozen=True)
class PairTorque(Result):
    """One gear pair or coupling under load: equations (2) and (4) to (6) of docs/torques.md.

    See Also
    --------
    Torques.pairs : where these stand.
    """

    KEYS = (
        "driver",
        Key("torques", "on_members", as_float),
        Key("power", to=as_float),
        Key("loss", to=as_float),
        Key("shared", "loose"),
    )

    id: str
    """Name of the pair."""
    driver: str
    """The wheel (or link) that drives in the carrier's frame; "" where no power flows."""
    links: tuple[str, str, str]
    """First link, second link, carrier."""
    torques: tuple[Fraction, Fraction, Fraction]
    """On these three, each about its own axis [N m, or plain]."""
    multiplier: Fraction
    """The unknown x of the pair's row."""
    rolling: Fraction | None
    """A (w_i - w_k), so that -x times it is the power from the first link to the second; None where the wheels roll
    on each other at a speed that is not determined."""
    share: Fraction
    """Part of the power that is left behind the pair, the carrier held; 1 without loss."""
    loose: bool = False
    """True where the balance does not determine the torque."""
    exact: bool = True
    """False where `share` is a mean over teeth, a float to 15 digits."""

    @property
    def efficiency(self) -> Fraction | float:
        """Part of the power that is left behind the pair; a float where it follows from a mean over teeth."""
        return self.share if self.exact else float(self.share)

    @property
    def on_members(self) -> MemberTorques:
        """The torques by name."""
        return MemberTorques(*self.torques)

    @cached_property
    def power(self) -> Fraction | None:
        """Power that the driver puts in, in the carrier's frame: torque times the train's speeds; None where open."""
        # worked out when asked for: both factors have many digits in a long train
        if self.rolling is None:
            return None if self.multiplier else Fraction(0)
        return abs(self.multiplier * self.rolling)

    @property
    def loss(self) -> Fraction:
        """Power lost; where the speed is open nothing is counted."""
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
    "undecided",
    "unloaded",
    "still",
]


@dataclass(frozen=True)
class TorqueVerdict(Result):
    """Whether the torques follow from the loads: see sections 5, 8, 11 and 13 of docs/torques.md.

    True where torques are given: for `determined`, `incomplete`, `ambiguous` and `indeterminate`.

    Kinds:

    - `determined`: they follow, and nothing that is declared is left out.
    - `incomplete`: they follow, but for what `Torques.left_out` names.
    - `self-locking`: no torques balance the load, however great, while the train turns this way.
    - `stalled`: none balance this load, which is too small to overcome the friction of bearings.
    - `ambiguous`: several patterns of power flow do; the one that loses least is given.
    - `indeterminate`: some tooth torques share a load in proportions that nothing declared decides.
    - `contradictory`: declared shares of pairs do not go with the balance.
    - `unbalanced`: the loads set the train moving, and no torque of the links asked for can hold them.
    - `undecided`: it is not plain which torque is to be found.
    - `unloaded`: no load and no friction of a bearing is declared.
    - `still`: the train, or the link asked for, does not turn, or at a speed that is not determined.

    Examples
    --------
    >>> import geartrain
    >>> geartrain.load("planetary-24-18-60").torques().verdict.kind
    'unloaded'
    """

    kind: TorqueVerdictKind
    """One of the kinds above."""
    text: str
    """The verdict in a sentence."""
    candidates: tuple[str, ...] = ()
    """Links whose torque may be requested (`solve_for`) or would balance the loads; pairs that share a load openly."""

    def _summary(self) -> str:
        return f"{self.kind}: {self.text}"

    def __bool__(self) -> bool:
        return self.kind in ("determined", "incomplete", "ambiguous", "indeterminate")


@dataclass(frozen=True)
class NeglectedEffect(Result):
    """Something that is declared and does not stand in the torques given: the table in section 13 of docs/torques.md.

    See Also
    --------
    Torques.left_out : where these stand.
    """

    what: str
    """What is left out, such as `friction of bearings` or `swing within a turn`."""
    where: tuple[str, ...]
    """The pairs or links concerned."""
    why: str
    """The reason in words."""

    @property
    def counts(self) -> bool:
        """False for what changes no mean: a swing, and the choice between two means."""
        return self.what not in ("swing within a turn", "mean efficiency")

    def __str__(self) -> str:
        return f"{self.what} ({', '.join(self.where)})"


class DrivenWay(NamedTuple):
    """Torques of a train driven at `source` while a unit of power leaves at `load`.

    See Also
    --------
    geartrain.GearTrain.driven : gives the torques of one way.
    """

    torques: Torques
    """What answers; its `efficiency` is that of this way."""
    source: str
    """The link at which power enters."""
    load: str
    """The link at which power leaves."""


@dataclass(frozen=True)
class Torques(FrozenFields, Tabular, TrainResult):
    """Torques and powers of a train in one state, all exact: A^T x + T = 0, equation (3) of docs/torques.md.

    Torques are in N m where loads have units, else in the plain unit of the loads; powers are torques times the train's
    unit of speed. Power is positive into the train.

    Examples
    --------
    Both pairs of a planetary set have an efficiency of 0.98, and its ring is held. From sun to carrier
    (1 + p e) / (1 + p) comes out, with p = 60/24 and e = 0.98^2 (the table in section 10 of docs/torques.md):

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
        "speed": "Speed of the link; empty where it is not determined",
        "power": "Power that the torque puts into the train; empty where the speed is not determined",
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
        Key("power_in", "known_power_in", as_float),
        Key("loss", "known_loss", as_float),
        "left_out",
    )

    state: str | None
    """The state; None for a train without states."""
    verdict: TorqueVerdict
    """Whether the torques follow from the loads. Where they do not, nothing but this and `left_out` is given."""
    requested: tuple[str, ...] = ()
    """The links whose torque was found."""
    external: Mapping[str, Fraction] = field(default_factory=dict)
    """Torque from outside on every link that has one: loads, what was asked for, brakes."""
    speeds: Mapping[str, Fraction] = field(default_factory=dict)
    """Speeds of the links whose speed is determined."""
    pairs: Mapping[str, PairTorque] = field(default_factory=dict)
    """Gear pairs and couplings by name."""
    bearings: tuple[BearingTorque, ...] = ()
    """Friction of bearings; empty where it was not asked for."""
    held: tuple[HoldingTorque, ...] = ()
    """Brakes and locks with the torques they exert."""
    left_out: tuple[NeglectedEffect, ...] = ()
    """What is not counted."""

    def _meaning(self, column: str) -> str:
        text = self.MEANINGS[column]
        return text if column == "link" else f"{text} [{self._units[column]}]."

    @property
    def _units(self) -> Mapping[str, str]:
        """Units of torque, speed and power, as the declaration has them."""
        declared = self._declaration
        torque, speed = "N m, or the plain unit of the loads", "unit of the train"
        if declared is not None:
            torque = "N m" if declared.has_torque_units(self.state) else "plain number"
            speed = declared.unit_name or "plain number"
        return {"torque": torque, "speed": speed, "power": f"{torque} x {speed}"}

    def _summary(self) -> str:
        figures = [f"{link} {brief(as_float(self.external[link]))}" for link in self.requested if link in self.external]
        if self.verdict and (efficiency := self.efficiency) is not None:
            figures.append(f"efficiency {as_float(efficiency):.6g}")
        return f"{self._named}: {', '.join([self.verdict.kind, *figures])}".strip()

    @property
    def powers(self) -> Mapping[str, Fraction]:
        """External power by link, positive into the train; of links whose speed is determined."""
        return {link: torque * self.speeds[link] for link, torque in self.external.items() if link in self.speeds}

    @property
    def link_torques(self) -> Mapping[str, LinkTorque]:
        """External torques by link."""
        powers = self.powers
        return {
            link: LinkTorque(torque, powers.get(link), link in self.requested) for link, torque in self.external.items()
        }

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each link with a torque from outside: its torque, speed and power as floats; None where open."""
        speeds, powers = ((each.get(link) for link in self.external) for each in (self.speeds, self.powers))
        return {
            "link": [*self.external],
            "torque": [as_float(torque) for torque in self.external.values()],
            "speed": [None if speed is None else as_float(speed) for speed in speeds],
            "power": [None if power is None else as_float(power) for power in powers],
        }

    def plot(self) -> Any:
        """The flow of power under these torques, as a figure that notebooks show: `geartrain.drawing.power_figure`."""
        return picture_maker("drawing", "power_figure")(self, self.state or "")

    @property
    def open_speeds(self) -> tuple[str, ...]:
        """Links with a torque from outside whose speed, and so whose power, is not determined."""
        return tuple(link for link, torque in self.external.items() if torque and link not in self.speeds)

    @property
    def uncounted(self) -> tuple[NeglectedEffect, ...]:
        """What is left out of the powers and the efficiency; a swing leaves their means as they are."""
        return tuple(each for each in self.left_out if each.counts)

    @property
    def power_in(self) -> Fraction:
        """Power that enters."""
        return sum((power for power in self.powers.values() if power > 0), Fraction(0))

    @property
    def bearing_loss(self) -> Fraction:
        """Power lost in bearings."""
        return sum((bearing.loss for bearing in self.bearings), Fraction(0))

    @property
    def loss(self) -> Fraction:
        """Power lost in pairs and bearings; what goes in and does not come out, where some pairs are open."""
        if any(pair.loose for pair in self.pairs.values()):
            return self._missing
        return sum((pair.loss for pair in self.pairs.values()), self.bearing_loss)

    @property
    def known_power_in(self) -> Fraction | None:
        """Power that enters; None where the speed of a loaded link is open."""
        return None if self.open_speeds else self.power_in

    @property
    def known_loss(self) -> Fraction | None:
        """Power lost; None where the speed of a loaded link is open."""
        return None if self.open_speeds else self.loss

    @property
    def efficiency(self) -> Fraction | float | None:
        """Power out over power in, a float where pairs have means over teeth; None where nothing goes in, or an asked
        torque or a loaded link's speed is open."""
        if not self.power_in or self.open_speeds or any(link not in self.external for link in self.requested):
            return None
        found = 1 - self._missing / self.power_in
        return found if all(pair.exact for pair in self.pairs.values()) else float(found)

    @property
    def _missing(self) -> Fraction:
        return sum(self.powers.values(), Fraction(0))

    @property
    def circulating(self) -> Fraction | None:
        """The greatest power through a pair over the power put in; above 1 power circulates. None where one is open."""
        powers = [None if pair.loose else pair.power for pair in self.pairs.values()]
        known = [power for power in powers if power is not None]
        if not self.power_in or self.open_speeds or len(known) < len(powers):
            return None
        return max(known, default=Fraction(0)) / self.power_in
