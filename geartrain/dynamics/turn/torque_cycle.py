"""What torque over a turn answers: the torque at every position, energies over the run, extremes and where they are."""

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
    """A torque, and where in the run it is needed.

    See Also
    --------
    TorqueCycle.greatest, TorqueCycle.least, TorqueCycle.starting : where these stand.
    """

    torque: float
    """At the link asked for, positive where it drives the way the link turns on average [N m, or plain]."""
    turns: float
    """Turns of the input from the start of the run."""
    days: float | None = None
    """Time from the start of the run; None where the train's speeds are not by a time."""


class CycleFigures(NamedTuple):
    """What trials are told of a run: mean, greatest and starting torque, efficiency; None where there is none.

    See Also
    --------
    TorqueCycle : everything.
    """

    mean: float | None
    maximum: float | None
    starting: float | None
    efficiency: float | None


class PlaceInRun(NamedTuple):
    """Where in a run something is.

    See Also
    --------
    TorqueCycle.locked : where these stand.
    """

    turns: float
    """Turns of the input from the start of the run."""
    days: float | None = None
    """Time from there; None where the train's speeds are not by a time."""


@dataclass(frozen=True)
class CycleEnergy(Result):
    """Energies over a run [J, or plain torque times radians].

    What goes in comes out or is lost: put_in - returned = taken_out - loads_put_in + mesh + pin + bearing.

    See Also
    --------
    TorqueCycle.energy : where this stands.
    """

    KEYS = (
        *(Key("in", "put_in"), "returned", Key("out", "taken_out"), Key("loads_in", "loads_put_in")),
        *(group("lost", "mesh", "pin", "bearing"), "net_in", "net_out"),
    )

    put_in: float
    """What the unknown torques (the crank's) put in, over the stretches in which they do."""
    returned: float
    """What they take back where loads drive them."""
    taken_out: float
    """What loads take out, over the stretches in which they do."""
    loads_put_in: float
    """What loads put in."""
    mesh: float
    """Energy lost in gear pairs, 0 or more."""
    pin: float
    """Energy lost in pins and slots, 0 or more."""
    bearing: float
    """Energy lost in bearings, 0 or more."""

    @property
    def net_in(self) -> float:
        """What the unknown torques put in, less what they take back."""
        return self.put_in - self.returned

    @property
    def net_out(self) -> float:
        """What loads take out, less what they put in."""
        return self.taken_out - self.loads_put_in

    @property
    def efficiency(self) -> float | None:
        """Energy out over energy in; None where nothing is put in on the whole."""
        if self.net_in > 0:
            return max(self.net_out, 0.0) / (self.net_in + max(-self.net_out, 0.0))
        return -self.net_in / -self.net_out if self.net_out < 0 else None

    @property
    def lost(self) -> float:
        """What is lost in pairs, pins and bearings."""
        return self.mesh + self.pin + self.bearing


@dataclass(frozen=True)
class PairCycle(Result):
    """One gear pair, coupling or bearing over a run.

    See Also
    --------
    TorqueCycle.parts : where these stand.
    """

    KEYS = ("kind", "loss", "passed", "flank_changes", "maximum")

    kind: str
    """`mesh`, `pin` or `bearing`."""
    loss: float
    """Energy lost [J, or plain torque times radians]."""
    passed: float
    """Energy that its driving side put in, in its carrier's frame; of a bearing the same as the loss."""
    flank_changes: int = 0
    """How often the torque through it changes its sense: each time the play of real teeth is crossed. In a run of
    whole periods the change from its end to its start counts."""
    maximum: float = 0.0
    """Greatest torque on its driven side at any position, whichever its sense [N m, or plain]; of a bearing 0."""


@dataclass(frozen=True)
class TorqueCycle(FrozenFields, Tabular, Pictured, TrainResult):
    """Torques of a train over some turns of its input, position by position: docs/torques.md, sections 16 to 18.

    Positions are about `samples` even ones, every corner and jump of the laws with a position on either side of it,
    those at which something turns back or changes its flank, and more where integrals ask for them; arrays over them
    are read-only. Where nothing balances the train is locked: the torque is NaN there. A torque of 1 N m over one turn
    of its own link is 2 pi J.

    Examples
    --------
    A pin at 10 mm drives a slot whose axis is 8 mm off, with friction, against 10 N m. The mean has a closed form,
    10 (1 + 0.3/pi ln((10 + 8)/(10 - 8))), and the torque goes up to five times as much:

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

    FIGURE = "torque_cycle_figure"

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
        *(Key("turns", "span"), "period", "complete", "left_out"),
    )

    state: str | None
    """The state; None for a train without states."""
    verdict: TorqueVerdict
    """Whether torques follow: `determined`; `incomplete` where something is left out; `ambiguous` where several
    patterns of power flow balance somewhere; `self-locking` where nothing balances at some position. Where redundant
    pairs share a load in no certain way it is `indeterminate`, and the least torques that balance are given. Where
    the question itself has no answer it is the verdict of `Torques`, and nothing else is given."""
    link: str = ""
    """The link whose torque is asked for."""
    newton_metres: bool = True
    """True where torques are in N m, False where they are in the plain unit of the loads."""
    span: float = 0.0
    """Turns of the input in the run."""
    period: float | None = None
    """Turns after which everything stands as at the start; None where nothing ripples."""
    turns: Floats | None = None
    """Positions of the input, in ascending order; the two sides of a jump stand at one position. Shape (n,)."""
    torque: Floats | None = None
    """Torque at the link, positive where it drives the way the link turns on average (about its own axis, if it
    turns nowhere on average); where several patterns balance, of the one that loses least [N m, or plain]. Shape
    (n,)."""
    highest: Floats | None = None
    """The same with the pattern that loses most. Shape (n,)."""
    standing: Floats | None = None
    """The torque that starts the train at each position, static friction everywhere. Shape (n,)."""
    speeds: LabelledArray | None = None
    """Speeds of links over the input's, (link, position)."""
    powers: LabelledArray | None = None
    """Power that each torque from outside puts in, over the speed of the input, (link, position) [N m, or plain]."""
    losses: LabelledArray | None = None
    """Power lost over the speed of the input, (part, position) [N m, or plain]."""
    mean: float | None = None
    """Mean of the torque over the run; None where the train locks."""
    maximum: TorqueExtreme | None = None
    """Greatest torque, of all patterns where several balance; None where the train locks."""
    minimum: TorqueExtreme | None = None
    """Least torque, of all patterns where several balance."""
    starting: TorqueExtreme | None = None
    """What starts the train at the worst position; None where it locks there."""
    energy: CycleEnergy | None = None
    """Over the run; None where the train locks."""
    parts: Mapping[str, PairCycle] = field(default_factory=dict)
    """Gear pairs, couplings, and bearings by `bearing LINK`."""
    locked_share: float = 0.0
    """Share of the run in which nothing balances."""
    held_share: float = 0.0
    """Share of the run in which loads and link both put power in, and all of it is lost."""
    ambiguous_share: float = 0.0
    """Share of the run in which several patterns balance."""
    locked: tuple[tuple[PlaceInRun, PlaceInRun], ...] = ()
    """Beginning and end of each stretch in which nothing balances."""
    complete: bool = True
    """False where there were too many patterns of power flow to try them all."""
    left_out: tuple[NeglectedEffect, ...] = ()
    """What is not counted."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for each in fields(self):
            value = getattr(self, each.name)
            if hasattr(value, "flags"):
                value.flags.writeable = False

    def _meaning(self, column: str) -> str:
        text = super()._meaning(column).split(" [")[0].rstrip(".")
        return f"{text} [{'turn' if column == 'turns' else self.unit or 'plain number'}]."

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
        """A row for each position: turns of the input, and torques at the link as the attributes of these names say."""
        names = ("turns", "torque", "highest", "standing")
        return {name: getattr(self, name).tolist() for name in names}

    @property
    def unit(self) -> str:
        """`N m`, or nothing for plain numbers."""
        return "N m" if self.newton_metres else ""

    @property
    def maximum_torque(self) -> float | None:
        """The greatest torque."""
        return None if self.maximum is None else self.maximum.torque

    @property
    def maximum_place(self) -> PlaceInRun | None:
        """Where the torque is greatest."""
        return _place(self.maximum)

    @property
    def minimum_torque(self) -> float | None:
        """The least torque; below 0 the loads drive there."""
        return None if self.minimum is None else self.minimum.torque

    @property
    def minimum_place(self) -> PlaceInRun | None:
        """Where the torque is least."""
        return _place(self.minimum)

    @property
    def starting_torque(self) -> float | None:
        """What starts the train at the worst position; None where it locks."""
        return None if self.starting is None else self.starting.torque

    @property
    def starting_place(self) -> PlaceInRun | None:
        """The worst position to start from."""
        return _place(self.starting)

    @property
    def efficiency(self) -> float | None:
        """Energy out over energy in, over the run; None where the train locks, or nothing is put in on the whole."""
        return None if self.energy is None else self.energy.efficiency

    @property
    def flank_changes(self) -> Mapping[str, int]:
        """How often the play is crossed, by pair and coupling."""
        return {name: part.flank_changes for name, part in self.parts.items() if part.kind != "bearing"}

    @property
    def loses_most(self) -> str | None:
        """The pair, coupling or bearing that loses most energy; None where nothing is lost."""
        name = max(self.parts, key=lambda each: self.parts[each].loss, default=None)
        return None if name is None or not self.parts[name].loss else name

    @property
    def recirculating(self) -> Mapping[str, float]:
        """Pairs through which more energy passes than is put into the train, with how many times as much."""
        if self.energy is None or not (put_in := self.energy.put_in + self.energy.loads_put_in) > 0:
            return {}
        shares = {name: part.passed / put_in for name, part in self.parts.items() if part.kind != "bearing"}
        return {name: share for name, share in shares.items() if share > 1 + 1e-9}

    def at(self, turns: float) -> float:
        """The torque at a position between those of the run, by a straight line between its neighbours.

        Parameters
        ----------
        turns : float
            Turns of the input, from 0 to `span`.

        Returns
        -------
        float
            At the link asked for [N m, or plain]; NaN where the train is locked.
        """
        import numpy as np

        assert self.turns is not None
        assert self.torque is not None
        return float(np.interp(turns, self.turns, self.torque))


def _place(extreme: TorqueExtreme | None) -> PlaceInRun | None:
    return None if extreme is None else PlaceInRun(extreme.turns, extreme.days)
