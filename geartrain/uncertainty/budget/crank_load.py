"""What the crank of a train has to give: torque and efficiency under the declared loads, or for a unit of power."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Result

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Torques
    from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class CrankLoad(Result):
    """Torque and efficiency of the link that drives a train.

    Attributes
    ----------
    link : str
        The one that is turned.
    torque : float or None
        Under the declared loads [N m, or their plain unit]; None without loads.
    efficiency : float or None
        Power out over power in; None where neither friction nor an efficiency is declared, or nothing follows.
    note : str
        Under which loads, or what is not declared.

    See Also
    --------
    TrainBudget : holds it
    """

    link: str
    torque: float | None
    efficiency: float | None
    note: str


def find_crank_load(train: GearTrain, state: str | None, lead: str) -> CrankLoad:
    """Under the declared loads; where there are none, the efficiency from the input to the output."""
    declared = train.declaration
    link = declared.crank or lead
    found = train.torques(state)
    if found.verdict.kind != "unloaded":
        torque = found.external.get(link)
        note = f"under the declared loads: {found.verdict.text}"
        return CrankLoad(link, None if torque is None else float(torque), _efficiency(found, declared), note)
    ways = train.drive_both_ways(state) if _loses(declared) else []
    if not ways or not ways[0].torques.verdict:
        why = "neither loads nor friction are declared" if not _loses(declared) else "no loads are declared"
        return CrankLoad(link, None, None, why)
    way = ways[0]
    note = f"no loads are declared: a unit of power from '{way.source}' to '{way.load}'"
    return CrankLoad(link, None, _efficiency(way.torques, declared), note)


def _efficiency(found: Torques, declared: Train) -> float | None:
    """None where nothing could be lost because nothing is declared."""
    if found.efficiency is None or not _loses(declared):
        return None
    return float(found.efficiency)


def _loses(declared: Train) -> bool:
    """True if any friction or efficiency is declared."""
    pairs = any(gear.friction is not None or gear.efficiency is not None for gear in declared.gears)
    return declared.friction is not None or pairs or any(link.bearing for link in declared.links.values())
