"""Torques, flow of power and losses of a train: figures for JSON, from which the page is told."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result
from geartrain.wings import WingResult, has_wing, wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import PowerFlow, PowerLoss, TorqueCycle, Torques, TorqueVerdict
    from geartrain.dynamics.torques.torque_results import DrivenWay


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

    KEYS = (
        *("verdict", Key("efficiency", to=as_float), Key("exact", "exact_efficiency")),
        Key("left_out", "way.torques.left_out"),
    )

    way: DrivenWay

    @property
    def verdict(self) -> TorqueVerdict:
        """Whether the train can be driven so."""
        return self.way.torques.verdict

    @property
    def efficiency(self) -> Fraction | float | None:
        """Power out over power in; None where it is not determined."""
        return self.way.torques.efficiency if self.verdict else None

    @property
    def exact_efficiency(self) -> Fraction | None:
        """The efficiency where it is exact; None for a float."""
        return self.efficiency if isinstance(self.efficiency, Fraction) else None


class DrivenWays(NamedTuple):
    """Driven from the input, and from the output."""

    forward: DrivenFigures
    backward: DrivenFigures


@dataclass(frozen=True)
class TorqueFigures(Result):
    """Torques, flow of power and losses of one state.

    drives             None where it is not plain which link is the output
    watts_per_unit     None where torques or speeds are plain numbers
    in_newton_metres   whether torques have a unit
    blows              what the collisions of each pair dissipate (W), where inertias and a rate are declared
    """

    KEYS = (Key("", "torques"), "drives", "watts_per_unit", "losses", "flow")

    torques: Torques
    drives: DrivenWays | None
    watts_per_unit: float | None
    in_newton_metres: bool
    flow: PowerFlow
    blows: Mapping[str, float]

    @property
    def losses(self) -> tuple[LossFigures, ...]:
        """What each pair and bearing loses."""
        struck = {name: Impact(power) for name, power in self.blows.items()}
        return tuple(
            LossFigures(loss, struck.get(loss.node.name) if loss.node.kind == "pair" else None)
            for loss in self.flow.shares
        )


@dataclass(frozen=True)
class TorqueReport(Result):
    """Torques of a train in every state that was asked for.

    Attributes
    ----------
    name : str
        Of the train.
    title : str
        One line for a reader.
    states : tuple of TorqueFigures
        Torques, powers, flow and losses of each state, in the order asked.
    over_turn : TorqueCycle or None
        Torque over some turns of the one state asked for; None where it was not asked for.
    friction_trials : geartrain.workshop.FrictionTrials or None
        The same in trials of friction; None where none were asked for.

    See Also
    --------
    collect_torque_report : Gives it.
    """

    name: str
    title: str
    states: tuple[TorqueFigures, ...]
    over_turn: TorqueCycle | None = None
    friction_trials: Annotated[Any, WingResult("workshop", "FrictionTrials")] | None = None


def collect_torque_report(
    train: GearTrain,
    found: Sequence[Torques],
    over_turn: TorqueCycle | None = None,
    friction_trials: Any = None,
) -> TorqueReport:
    """Torques of some states of a train with their flow of power, what is lost where, and the efficiency both ways.

    Parameters
    ----------
    train : GearTrain
        The train.
    found : sequence of Torques
        What `train.torques` gave, one for each state.
    over_turn : TorqueCycle, optional
        What `train.torques` gave over some turns.
    friction_trials : geartrain.workshop.FrictionTrials, optional
        What `try_frictions` gave.

    Returns
    -------
    TorqueReport
        Its `to_dict` is the answer of `geartrain torques --json`.

    Examples
    --------
    A wheel of 20 teeth needs half of the torque on its mate of 40 (docs/torques.md, equation 1):

    >>> import geartrain
    >>> train = geartrain.GearTrain.declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}},
    ...     "b": {"wheels": {"w": 40}}}, "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}, "loads": {"b": 3},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}]})
    >>> data = collect_torque_report(train, [train.torques()]).to_dict()
    >>> data["states"][0]["links"]["a"]
    {'torque': 1.5, 'power': 1.5, 'asked': True}
    """
    states = tuple(collect_torques(train, each) for each in found)
    return TorqueReport(train.name, train.declaration.title, states, over_turn, friction_trials)


def collect_torques(train: GearTrain, found: Torques) -> TorqueFigures:
    """Torques of one state, with the flow of power and the efficiency there and back."""
    from geartrain.dynamics.torques.power_flow import find_power_flow, has_torque_units, watts_per_unit
    from geartrain.dynamics.torques.train_torques import drive_both_ways

    declared, state, ways = train.declaration, found.state, drive_both_ways(train.mechanics, found.state)
    impacts: Mapping[str, Any] = {}
    if train.declaration.has_inertia and has_wing("simulation"):
        impacts = wing("simulation.contacts.train_separation").find_tooth_impacts(train.mechanics, state)
    return TorqueFigures(
        found,
        DrivenWays(*map(DrivenFigures, ways)) if ways else None,
        watts_per_unit(declared, declared.case(state)),
        has_torque_units(declared, state),
        find_power_flow(found),
        {pair: impact.power for pair, impact in impacts.items()},
    )
