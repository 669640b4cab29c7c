"""What the crank of a train has to give: torque and efficiency under the declared loads, or for a unit of power."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.train_torques import drive_both_ways
from geartrain.errors import GearTrainError
from geartrain.numerics.plain_data import Result
from geartrain.uncertainty.budget.natural_run import find_natural_run
from geartrain.uncertainty.budget.weight_drive import WeightDrive, find_weight_drive

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle, Torques
    from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class CrankLoad(Result):
    """Torque and efficiency of the link that drives a train.

    Attributes
    ----------
    link : str
        The one that is turned.
    torque : float or None
        Under the declared loads, in the link's own sense of turning: positive puts power in, as in `over_turn` [N m, or
        their plain unit]; None without loads.
    efficiency : float or None
        Power out over power in; None where neither friction nor an efficiency is declared, or nothing follows.
    note : str
        Under which loads, or what is not declared.
    pointers : mapping of str to float
        By pointer, the efficiency of a train that drives it alone; empty without friction, and without what cannot be
        driven.
    over_turn : TorqueCycle or None
        The torque position by position over a year, or over a period after which everything repeats if that is
        shorter; None without loads.
    weight : WeightDrive or None
        The weight that drives it; None where another thing does.

    See Also
    --------
    TrainBudget : holds it
    """

    link: str
    torque: float | None
    efficiency: float | None
    note: str
    pointers: Mapping[str, float] = field(default_factory=dict)
    over_turn: TorqueCycle | None = None
    weight: WeightDrive | None = None


def find_crank_load(train: GearTrain, state: str | None, lead: str, links: Mapping[str, str]) -> CrankLoad:
    """Under the declared loads; where there are none, the efficiency from the input to the output. Then over a run.

    links   by pointer, the link that turns
    """
    found = _at_mean_speeds(train, state, lead, links)
    drive = train.declaration.case(state).drive
    loaded = train.declaration.is_loaded(state)
    if not loaded and (drive is None or drive.pull is None):
        return found
    try:
        over_turn = find_natural_run(train, state, lead) if loaded else None
        weight = find_weight_drive(train, state, found.link, lead, over_turn)
    except GearTrainError as error:  # teeth in a loop, or that cannot turn
        return replace(found, note=f"{found.note}; not followed over a run: {error.problems[0].what}")
    return replace(found, over_turn=over_turn, weight=weight)


def _at_mean_speeds(train: GearTrain, state: str | None, lead: str, links: Mapping[str, str]) -> CrankLoad:
    link, loses = train.declaration.crank or lead, _loses(train.declaration)
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
