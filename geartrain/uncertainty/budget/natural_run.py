"""The run over which the torque of a train is told: a year, or less of it if everything repeats sooner."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.dynamics.turn.train_turn import find_torque_period
from geartrain.train.periods import period_table

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle

YEAR = period_table()["year_tropical_J2000"].value  # d
MOST_PASSAGES = 600_000
"""Teeth that pass, times the pairs that are asked at each: longer runs are cut off, at about two minutes without
compiled kernels."""
SAMPLES = 2_000


def find_natural_run(train: GearTrain, state: str | None, lead: str, of: str | None = None) -> TorqueCycle:
    """The torque over the natural run of a train.

    lead   the input; `of`, the link whose torque is asked for, by default the crank
    """
    turns = natural_turns(train, state, lead, of)
    return train.torques(state, turns=turns, samples=SAMPLES, of=of)


def natural_turns(train: GearTrain, state: str | None, lead: str, of: str | None = None) -> float:
    """Turns of the input in a year; where speeds are by no time, while what they are by passes once.

    Or in a period after which all repeats, if that is shorter. Where nothing is uneven any run is as good: then it is
    what speeds are by, an hour or a day. Fewer turns where more teeth pass than can be followed.
    """
    once = abs(train.declaration.case(state).inputs[lead]) or 1
    period, unit = find_torque_period(train.mechanics, state, of), train.declaration.unit_days
    if period is None:
        return float(once)
    used = train.motion(state, tuple(train.declaration.links)).ahead.used
    passages = len(used) * float(sum(each.cycles for each in used))
    whole = min(period, once if unit is None else once * YEAR / unit)
    return float(whole) if passages * whole <= MOST_PASSAGES else MOST_PASSAGES / passages
