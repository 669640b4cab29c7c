"""Torque and efficiency of the link that drives a train, at mean speeds and over a run.

The run is a year, or a period after which everything repeats if that is shorter. A weight on its drum gives a torque,
and a part of it arrives at the escape wheel.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.train_torques import drive_both_ways
from geartrain.dynamics.turn.train_turn import find_torque_period
from geartrain.errors import GearTrainError
from geartrain.numerics.quantity import Quantity
from geartrain.numerics.results import Result
from geartrain.train.periods import period_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle, Torques
    from geartrain.train import Train


# ------------------------------------------------------------------------------------------------------------------ run


YEAR = period_table()["year_tropical_J2000"].value  # d
MOST_PASSAGES = 600_000
"""Teeth that pass, times the pairs that are asked at each: longer runs are cut off, at about two minutes without
compiled kernels."""
SAMPLES = 2_000


def find_natural_run(train: GearTrain, state: str | None, driving_link: str, of: str | None = None) -> TorqueCycle:
    """The torque over the natural run of a train.

    lead   the input; `of`, the link whose torque is asked for, by default the crank
    """
    turns = natural_turns(train, state, driving_link, of)
    return train.torques(state, turns=turns, samples=SAMPLES, of=of)


def natural_turns(train: GearTrain, state: str | None, driving_link: str, of: str | None = None) -> float:
    """Turns of the input in a year; where speeds are by no time, while what they are by passes once.

    Or in a period after which all repeats, if that is shorter. Where nothing is uneven any run is as good: then it is
    what speeds are by, an hour or a day. Fewer turns where more teeth pass than can be followed.
    """
    once = abs(train.declaration.case(state).inputs[driving_link]) or 1
    period, unit = find_torque_period(train.mechanics, state, of), train.declaration.unit_days
    if period is None:
        return float(once)
    used = train.motion(state, tuple(train.declaration.links))._forward.used
    passages = len(used) * float(sum(each.cycles for each in used))
    whole = min(period, once if unit is None else once * YEAR / unit)
    return float(whole) if passages * whole <= MOST_PASSAGES else MOST_PASSAGES / passages


# --------------------------------------------------------------------------------------------------------------- weight


@dataclass(frozen=True, slots=True)
class WeightDrive(Result):
    """What a weight gives at its drum, and what the train makes of it over a run.

    See Also
    --------
    CrankLoad : holds it
    """

    KEYS = ("link", "torque", "needed", "suffices", "wheel", "mean", "minimum", "efficiency")

    link: str
    """The link of the drum."""
    torque: float
    """Mass times gravity times the radius at which the line pulls [N m]."""
    needed: float | None = None
    """What starts the train at its worst position under its declared loads [N m]; None without loads, or where it
    locks."""
    wheel: str | None = None
    """The link of the escape wheel; None where none is declared, or loads are."""
    mean: float | None = None
    """Mean torque over the run at the escape wheel while the weight alone drives [N m]."""
    minimum: float | None = None
    """Least torque over the run at the escape wheel while the weight alone drives [N m]."""
    efficiency: float | None = None
    """Energy that arrives there over that of the weight."""

    @property
    def suffices(self) -> bool | None:
        """True if the weight starts the train at its worst position; None where that is not known."""
        return None if self.needed is None else self.torque >= self.needed


def find_weight_drive(
    train: GearTrain, state: str | None, link: str, driving_link: str, under_load: TorqueCycle | None
) -> WeightDrive | None:
    """The weight that drives a train in one state; None where another thing drives it.

    link         the drum's; `lead`, the input
    under_load   torque over the run under the declared loads; None where none are declared
    """
    drive = train.declaration.case(state).drive
    if drive is None or drive.pull is None:
        return None
    if under_load is not None:
        return WeightDrive(link, drive.pull, under_load.starting_torque)
    escapement = train.declaration.escapement
    if escapement is None:
        return WeightDrive(link, drive.pull)
    found = find_natural_run(_driven_by(train, state, link, drive.pull), state, driving_link, escapement.link)
    mean = None if found.mean is None else -found.mean
    minimum = None if found.maximum is None else -found.maximum.torque
    return WeightDrive(link, drive.pull, None, escapement.link, mean, minimum, found.efficiency)


def _driven_by(train: GearTrain, state: str | None, link: str, pull: float) -> GearTrain:
    """The same train with this torque at the drum, the way it turns."""
    from geartrain.analysis.gear_train import GearTrain

    speed = train.solve(state)[link]
    way = -1 if speed is not None and speed < 0 else 1
    load = Quantity.parse(f"{way * pull!r} N m", "torque", plain=False)
    return GearTrain(train.declaration.model_copy(update={"loads": {link: load}}))


# ---------------------------------------------------------------------------------------------------------------- crank


@dataclass(frozen=True, slots=True)
class CrankLoad(Result):
    """Torque and efficiency of the link that drives a train.

    See Also
    --------
    TrainBudget : holds it
    """

    link: str
    """The one that is turned."""
    torque: float | None
    """Under the declared loads, in the link's own sense of turning: positive puts power in, as in `over_turn` [N m,
    or their plain unit]; None without loads."""
    efficiency: float | None
    """Power out over power in; None where neither friction nor an efficiency is declared, or nothing follows."""
    note: str
    """Under which loads, or what is not declared."""
    pointers: Mapping[str, float] = field(default_factory=dict)
    """By pointer, the efficiency of a train that drives it alone; empty without friction, and without what cannot be
    driven."""
    over_turn: TorqueCycle | None = None
    """The torque position by position over a year, or over a period after which everything repeats if that is
    shorter; None without loads."""
    weight: WeightDrive | None = None
    """The weight that drives it; None where another thing does."""


def find_crank_load(train: GearTrain, state: str | None, driving_link: str, links: Mapping[str, str]) -> CrankLoad:
    """Under the declared loads; where there are none, the efficiency from the input to the output. Then over a run.

    links   by pointer, the link that turns
    """
    found = _at_mean_speeds(train, state, driving_link, links)
    drive = train.declaration.case(state).drive
    loaded = train.declaration.is_loaded(state)
    if not loaded and (drive is None or drive.pull is None):
        return found
    try:
        over_turn = find_natural_run(train, state, driving_link) if loaded else None
        weight = find_weight_drive(train, state, found.link, driving_link, over_turn)
    except GearTrainError as error:  # teeth in a loop, or that cannot turn
        return replace(found, note=f"{found.note}; not followed over a run: {error.problems[0].what}")
    return replace(found, over_turn=over_turn, weight=weight)


def _at_mean_speeds(train: GearTrain, state: str | None, driving_link: str, links: Mapping[str, str]) -> CrankLoad:
    link, loses = train.declaration.crank or driving_link, _loses(train.declaration)
    found = train.torques(state)
    pointers = dict(_efficiencies(train, state, link, links)) if loses else {}
    if found.verdict.kind != "unloaded":
        sense = -1 if train.solve(state).speeds[link] < 0 else 1
        torque = found.external.get(link)
        note = f"under the declared loads: {found.verdict.text}"
        efficiency = _efficiency(found) if loses else None
        return CrankLoad(link, None if torque is None else sense * float(torque), efficiency, note, pointers)
    if not loses:
        return CrankLoad(link, None, None, "neither loads nor friction are declared", pointers)
    ways = drive_both_ways(train.mechanics, state)
    if not ways or not ways[0].torques.verdict:
        return CrankLoad(link, None, None, "no loads are declared", pointers)
    way = ways[0]
    note = f"no loads are declared: a unit of power from '{way.source}' to '{way.load}'"
    return CrankLoad(link, None, _efficiency(way.torques), note, pointers)


def _efficiencies(
    train: GearTrain, state: str | None, crank: str, links: Mapping[str, str]
) -> Iterator[tuple[str, float]]:
    """The efficiency from the crank to each pointer that can be driven from it."""
    known: dict[str, float | None] = {}
    for name, link in links.items():
        if link != crank and link not in known:
            found = train.driven(link, crank, state)
            known[link] = _efficiency(found) if found.verdict else None
        if (efficiency := known.get(link)) is not None:
            yield name, efficiency


def _efficiency(found: Torques) -> float | None:
    return None if found.efficiency is None else float(found.efficiency)


def _loses(declared: Train) -> bool:
    """True if any friction or efficiency is declared."""
    pairs = any(gear.friction is not None or gear.efficiency is not None for gear in declared.gears)
    return declared.friction is not None or pairs or any(link.bearing for link in declared.links.values())
