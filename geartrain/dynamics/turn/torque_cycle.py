"""Results of the torques over a run: torque at every position, energies, and extreme torques with their positions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, NamedTuple

from geartrain.dynamics.torques.torque_results import NeglectedEffect, TorqueVerdict
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.results import Key, Pictured, Result, Tabular, TrainResult, group

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray


class TorqueExtreme(NamedTuple):
    """Extreme value of the torque, and the position of the input at which it occurs."""

    torque: float
    """Torque at the requested link [N m, or a number without a unit]. It is positive if it drives the link in its mean
    sense of rotation.
    """
    turns: float
    """Position of the input from the start of the evaluated range [revolutions]."""
    days: float | None = None
    """Time since the start of the evaluated range [d]; None if the train's speeds have no unit of time."""


class PlaceInRun(NamedTuple):
    """Position of the input since the start of the evaluated range, in revolutions and in days."""

    turns: float
    """Revolutions of the input since the start of the evaluated range."""
    days: float | None = None
    """Time since the start of the evaluated range [d]; None if the train's speeds have no unit of time."""


@dataclass(frozen=True)
class CycleEnergy(Result):
    """Energies that a train receives, delivers and loses over several revolutions of the input [J, or rad if torques
    are numbers without a unit].

    Energy is conserved: `put_in` + `loads_put_in` = `returned` + `taken_out` + `mesh` + `pin` + `bearing`.
    """

    KEYS = (
        *(Key("in", "put_in"), "returned", Key("out", "taken_out"), Key("loads_in", "loads_put_in")),
        *(group("lost", "mesh", "pin", "bearing"), "net_in", "net_out"),
    )

    put_in: float
    """Energy supplied by the unknown torques, such as the torque at the crank, while their power is positive [J, or rad
    if torques are numbers without a unit].
    """
    returned: float
    """Energy absorbed by the unknown torques while their power is negative, because the loads drive [J, or rad if
    torques are numbers without a unit].
    """
    taken_out: float
    """Energy absorbed by the loads while their power is negative [J, or rad if torques are numbers without a unit]."""
    loads_put_in: float
    """Energy supplied by the loads while their power is positive [J, or rad if torques are numbers without a unit]."""
    mesh: float
    """Energy lost in gear pairs [J, or rad if torques are numbers without a unit]; it is not negative."""
    pin: float
    """Energy lost in couplings such as pins in slots [J, or rad if torques are numbers without a unit], 0 or more."""
    bearing: float
    """Energy lost in bearings [J, or rad if torques are numbers without a unit]; it is not negative."""

    @property
    def net_in(self) -> float:
        """Energy supplied by the unknown torques minus energy absorbed by them [J, or rad if torques are numbers
        without a unit].
        """
        return self.put_in - self.returned

    @property
    def net_out(self) -> float:
        """Energy absorbed by the loads minus energy supplied by the loads [J, or rad if torques are numbers without a
        unit].
        """
        return self.taken_out - self.loads_put_in

    @property
    def efficiency(self) -> float | None:
        """Energy output divided by energy input; None if neither the unknown torques nor the loads have a net input.

        If the unknown torques have no net input, the loads drive the train, and the energy output is the energy that
        the unknown torques absorb.
        """
        if self.net_in > 0:
            return max(self.net_out, 0.0) / (self.net_in + max(-self.net_out, 0.0))
        # the loads drive, and the unknown torques absorb energy
        return -self.net_in / -self.net_out if self.net_out < 0 else None

    @property
    def lost(self) -> float:
        """Energy lost in pairs, couplings and bearings [J, or rad if torques are numbers without a unit]."""
        return self.mesh + self.pin + self.bearing


@dataclass(frozen=True)
class PairCycle(Result):
    """Energy loss, energy input and maximum torque of one gear pair, coupling or bearing over several revolutions."""

    kind: str
    """Kind of the pair: `mesh`, `pin` or `bearing`."""
    loss: float
    """Energy lost in the pair, coupling or bearing over the evaluated revolutions [J, or rad if torques are numbers
    without a unit].
    """
    passed: float
    """Energy input of the driving side relative to the carrier [J, or rad if torques are numbers without a unit]; for a
    bearing, it equals the loss.
    """
    flank_changes: int = 0
    """Number of sign changes of the torque that the pair transmits. The teeth traverse their backlash at each sign
    change.

    If the evaluated range is an integer number of periods, a change between its end and its start is included.
    """
    maximum: float = 0.0
    """Maximum magnitude of the torque on the driven link [N m, or a number without a unit]; 0 for a bearing."""


@dataclass(frozen=True)
class TorqueCycle(FrozenFields, Tabular, Pictured, TrainResult):
    """Torques of a train at positions over several revolutions of its input; see docs/torques.md, sections 16 to 18.

    The run has about `samples` equally spaced positions. Positions are added on both sides of every kink and jump of
    the transmission functions, where a motion reverses or the flank in contact changes, and where the integrals require
    more positions. Arrays with one value per position are read-only. At positions where no torque balances the loads,
    the train is locked and the torque is NaN.

    Examples
    --------
    A pin at a radius of 10 mm drives a slot with an axis offset of 8 mm against a torque of 10 N m, with a coefficient
    of friction of 0.3. The mean torque is 10 (1 + 0.3/pi ln((10 + 8)/(10 - 8))), and the maximum torque is five times
    the load:

    >>> import geartrain
    >>> found = geartrain.load('''
    ... links: {frame: {}, a: {}, b: {}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: 0.3}]
    ... inputs: {a: 1}
    ... outputs: {b: {}}
    ... loads: {b: -10 N m}
    ... ''').torques(turns=1)
    >>> found.link, round(found.mean, 6), round(found.maximum.torque, 6), round(found.efficiency, 6)
    ('a', 12.098195, 50.978459, 0.82657)
    """

    PAGE = "report.torque_report:torques_document"

    FIGURE = "drawing.output_error_plots:torque_cycle_figure"

    KEYS = (
        "state",
        "verdict",
        group(
            "input",
            *("link", "mean", Key("maximum", "maximum_torque"), Key("minimum", "minimum_torque")),
            *(Key("maximum_at", "maximum_place"), Key("minimum_at", "minimum_place")),
        ),
        Key("starting", "starting_torque"),
        Key("starting_at", "starting_place"),
        *("efficiency", "energy", "parts", "flank_changes", "loses_most", "recirculating"),
        *("locked_share", "locked", "held_share", "ambiguous_share"),
        *(Key("turns", "span"), "period", "complete", "neglected"),
    )

    state: str | None
    """Name of the state; None for a train without states."""
    verdict: TorqueVerdict
    """Verdict on whether the loads determine the torques.

    `determined`: all torques follow from the loads. `incomplete`: some effects are neglected. `ambiguous`: several
    patterns of power flow balance the loads at some position. `self-locking`: no torque balances the loads at some
    position. `indeterminate`: redundant pairs share a load in an undetermined way, and the minimum-norm torques are
    returned. If no torque can be requested, the verdict is that of `Torques`, and the other fields are empty.
    """
    link: str = ""
    """Name of the link at which the torque is requested."""
    newton_metres: bool = True
    """True if torques are in N m, False if they are numbers without a unit."""
    span: float = 0.0
    """Length of the evaluated range [revolutions of the input]."""
    period: float | None = None
    """Revolutions of the input after which all positions repeat; None if the torque is constant."""
    turns: Floats | None = None
    """Positions of the input [revolutions], in ascending order, shape (n,). A position at which the torque jumps occurs
    twice, for the limits from below and from above.
    """
    torque: Floats | None = None
    """Torque at `link` in the solution with minimum loss [N m, or a number without a unit], shape (n,).

    The torque is positive if it drives in the link's mean sense of rotation, or about the link's own axis if its mean
    speed is 0.
    """
    highest: Floats | None = None
    """Torque at `link` in the solution with maximum loss [N m, or a number without a unit], shape (n,)."""
    standing: Floats | None = None
    """Breakaway torque at each position, which overcomes static friction in every contact [N m, or a number without a
    unit], shape (n,).
    """
    speeds: LabelledArray | None = None
    """Speed of each link divided by the input speed [1], as an array labelled by link and position."""
    powers: LabelledArray | None = None
    """Power of each external torque divided by the input speed [N m, or a number without a unit], positive into the
    train, as an array labelled by link and position.
    """
    losses: LabelledArray | None = None
    """Power lost in each pair, coupling and bearing divided by the input speed [N m, or a number without a unit], as an
    array labelled by part and position.
    """
    mean: float | None = None
    """Mean torque at `link` over the evaluated range [N m, or number without a unit]; None if the train locks at some
    position.
    """
    maximum: TorqueExtreme | None = None
    """Maximum torque of all solutions at all positions, with its position; None if the train locks at some position."""
    minimum: TorqueExtreme | None = None
    """Minimum torque in the solution with minimum loss, with its position; None if the train is always locked."""
    starting: TorqueExtreme | None = None
    """Maximum breakaway torque over all positions, which is sufficient to start the train at any position. None if no
    torque starts it at some position.
    """
    energy: CycleEnergy | None = None
    """Energy balance over the evaluated range; None if the train locks at some position."""
    parts: Mapping[str, PairCycle] = field(default_factory=dict)
    """Loss and torque of each gear pair and coupling by name, and of each bearing as `bearing LINK`."""
    locked_share: float = 0.0
    """Fraction of the input revolutions in which no torque balances the loads, so that the train is locked, 0 to 1."""
    held_share: float = 0.0
    """Fraction of the input revolutions in which the loads and the requested link all supply power, which is lost to
    friction, 0 to 1.
    """
    ambiguous_share: float = 0.0
    """Fraction of the input revolutions in which several patterns of power flow balance the loads, 0 to 1."""
    locked: tuple[tuple[PlaceInRun, PlaceInRun], ...] = ()
    """Start and end of each interval of the input position in which no torque balances the loads."""
    complete: bool = True
    """False if there were too many patterns of power flow to examine all of them."""
    neglected: tuple[NeglectedEffect, ...] = ()
    """Declared effects that the torques do not include."""
    force: bool = False
    """True if `link` slides, so that its torques are forces [N, or numbers without a unit]."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for each in fields(self):
            value = getattr(self, each.name)
            if hasattr(value, "flags"):
                value.flags.writeable = False

    def _meaning(self, column: str) -> str:
        text = super()._meaning(column).split(" [")[0].rstrip(".")
        return f"{text} [{'turn' if column == 'turns' else self.unit or 'number without a unit'}]."

    def _summary(self) -> str:
        figures: list[str] = [self.verdict.kind]
        if self.mean is not None:
            figures.append(f"mean {self.mean:.6g} {self.unit}".rstrip())
        if self.minimum is not None and self.maximum is not None:
            figures.append(f"{self.minimum.torque:.6g} to {self.maximum.torque:.6g}")
        if (efficiency := self.efficiency) is not None:
            figures.append(f"efficiency {efficiency:.6g}")
        turns = f"{self.span:g} turn{'' if self.span == 1 else 's'}"
        return f"{self._named}: torque at {self.link or 'no link'} over {turns}: {', '.join(figures)}".strip()

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each position: revolutions of the input, torque with minimum and with
        maximum loss, and breakaway torque.
        """
        names = ("turns", "torque", "highest", "standing")
        return {name: getattr(self, name).tolist() for name in names}

    @property
    def unit(self) -> str:
        """Unit of the torques: `N m`; `N` for a link that slides; empty for numbers without a unit."""
        return ("N" if self.force else "N m") if self.newton_metres else ""

    @property
    def maximum_torque(self) -> float | None:
        """Maximum torque [N m, or a number without a unit]; None if the train locks at some position."""
        return None if self.maximum is None else self.maximum.torque

    @property
    def maximum_place(self) -> PlaceInRun | None:
        """Position of the maximum torque; None if the train locks at some position."""
        return _place(self.maximum)

    @property
    def minimum_torque(self) -> float | None:
        """Minimum torque [N m, or a number without a unit], negative if the loads drive; None if the train is locked at
        all positions.
        """
        return None if self.minimum is None else self.minimum.torque

    @property
    def minimum_place(self) -> PlaceInRun | None:
        """Input position of the minimum torque; None if the train is locked at all positions."""
        return _place(self.minimum)

    @property
    def starting_torque(self) -> float | None:
        """Maximum breakaway torque [N m, or a number without a unit]; None if no torque starts the train somewhere."""
        return None if self.starting is None else self.starting.torque

    @property
    def starting_place(self) -> PlaceInRun | None:
        """Input position of the maximum breakaway torque; None if no torque starts the train at some position."""
        return _place(self.starting)

    @property
    def efficiency(self) -> float | None:
        """Energy output divided by energy input; None if the train locks at a position or has no net input."""
        return None if self.energy is None else self.energy.efficiency

    @property
    def flank_changes(self) -> Mapping[str, int]:
        """Number of times that the teeth of each gear pair, or the pin of each coupling, traverse their backlash."""
        return {name: part.flank_changes for name, part in self.parts.items() if part.kind != "bearing"}

    @property
    def loses_most(self) -> str | None:
        """Name of the pair, coupling or bearing with the largest energy loss; None if no energy is lost."""
        name = max(self.parts, key=lambda each: self.parts[each].loss, default=None)
        return None if name is None or not self.parts[name].loss else name

    @property
    def recirculating(self) -> Mapping[str, float]:
        """Energy through each pair divided by the energy input of the train, for pairs in which this exceeds 1."""
        if self.energy is None or not (put_in := self.energy.put_in + self.energy.loads_put_in) > 0:
            return {}
        shares = {name: part.passed / put_in for name, part in self.parts.items() if part.kind != "bearing"}
        # a pair that transmits the whole power has 1 to rounding
        return {name: share for name, share in shares.items() if share > 1 + 1e-9}

    def at(self, turns: float) -> float:
        """Return the torque at any position of the input in the evaluated range, by linear interpolation.

        Parameters
        ----------
        turns : float
            Position of the input [revolutions], from 0 to `span`.

        Returns
        -------
        float
            Torque at the requested link [N m, or a number without a unit]; NaN if the train is locked at this position.
        """
        import numpy as np

        assert self.turns is not None
        assert self.torque is not None
        return float(np.interp(turns, self.turns, self.torque))


def _place(extreme: TorqueExtreme | None) -> PlaceInRun | None:
    return None if extreme is None else PlaceInRun(extreme.turns, extreme.days)
