"""Torques on the members of a train under load: links, brakes and locks, bearings, pairs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result


@dataclass(frozen=True)
class LinkTorque(Result):
    """An external torque on a link, its power (None where the speed is open), and whether it was asked for."""

    KEYS = (Key("torque", to=as_float), Key("power", to=as_float), "asked")

    torque: Fraction
    power: Fraction | None
    asked: bool


@dataclass(frozen=True)
class HoldingTorque(Result):
    """A brake on one link, or a lock of two, with the torques it exerts on them.

    Attributes
    ----------
    links : tuple of str
        The link that is held, or the two that turn together.
    torques : tuple of Fraction or None
        On each of the links about its own axis [N m, or plain]; None where they are open.
    clutch : str or None
        Its name, if it has one.
    cause : tuple of str
        The links that are declared to be held, where these follow from it: a rigid connection across several axes
        closes every joint on its way.

    See Also
    --------
    Torques.held : where these stand.
    """

    KEYS = ("links", "clutch", Key("cause", "declared_cause"), Key("torques", "by_link", as_float))

    links: tuple[str, ...]
    torques: tuple[Fraction, ...] | None
    clutch: str | None = None
    cause: tuple[str, ...] = ()

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
    second: Fraction
    carrier: Fraction


class BearingTorque(NamedTuple):
    """Friction of one bearing: equation (10) of docs/torques.md.

    Attributes
    ----------
    link, carrier : str
        The link that turns in the bearing, and the one that bears it.
    torque, reaction : Fraction
        On the link and on the carrier, each about its own axis [N m, or plain]; 0 where the bearing rests or its speed
        is open, and on the frame.
    loss : Fraction
        Power it takes, 0 or more [torque times the train's unit of speed].

    See Also
    --------
    Torques.bearings : where these stand.
    """

    link: str
    carrier: str
    torque: Fraction
    reaction: Fraction
    loss: Fraction


@dataclass(frozen=True)
class PairTorque(Result):
    """One gear pair or coupling under load: equations (2) and (4) to (6) of docs/torques.md.

    Attributes
    ----------
    id : str
        Name of the pair.
    driver : str
        The wheel (or link) that drives in the carrier's frame; "" where no power flows.
    links : tuple of str
        First link, second link, carrier.
    torques : tuple of Fraction
        On these three, each about its own axis [N m, or plain].
    multiplier : Fraction
        The unknown x of the pair's row.
    rolling : Fraction or None
        a (w_i - w_k), so that -x times it is the power from the first link to the second; None where the wheels roll
        on each other at a speed that is not determined.
    share : Fraction
        Part of the power that is left behind the pair, the carrier held; 1 without loss.
    loose : bool
        True where the balance does not determine the torque.
    exact : bool
        False where `share` is a mean over teeth, a float to 15 digits.

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
    driver: str
    links: tuple[str, str, str]
    torques: tuple[Fraction, Fraction, Fraction]
    multiplier: Fraction
    rolling: Fraction | None
    share: Fraction
    loose: bool = False
    exact: bool = True

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
