"""Torques of a train at mean speeds, under the declared loads or if one link drives another."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from geartrain.dynamics.torques.load_case import input_and_output
from geartrain.dynamics.torques.torque_analysis import drive, find_torques, torques_unknown
from geartrain.dynamics.torques.torque_results import DrivenWay, TorqueVerdict
from geartrain.errors import check_choice

if TYPE_CHECKING:
    from geartrain.dynamics.torques.torque_results import Torques
    from geartrain.dynamics.train_mechanics import TrainMechanics


def solve(train: TrainMechanics, state: str | None) -> Torques:
    """Compute the torques on links and pairs under the loads of one state. Equal planets share loads equally."""
    found = train.unfolded.load_case(state)
    return torques_unknown(state) if found is None else find_torques(found)


def solve_driven(train: TrainMechanics, load: str, source: str, state: str | None) -> Torques:
    """Compute the torques if the link `source` drives and a unit of power leaves at `load`."""
    train = train.unfolded
    for link in (load, source):
        check_choice("link", link, tuple(train.declaration.links))
    found = train.load_case(state)
    return torques_unknown(state) if found is None else drive(found, load, source)


def drive_both_ways(train: TrainMechanics, state: str | None) -> list[DrivenWay]:
    """Compute the torques if the input drives the output, and if the output drives the input, for a unit of power at
    the driven link.

    If `state` is None, the first state is used. The list is empty if the output link is not unique.
    """
    train = train.unfolded
    declared = train.declaration
    found = input_and_output(declared, declared.case(declared.state_or_first(state)))
    # couplings that lock their driven link in a dwell, so that no power can flow back
    locked = {
        row.id: row.driven for each in declared.couplings if each.LOCKS_BACK for row in each.rows(declared.wheels)
    }
    ways = []
    for source, load in [] if found is None else [found, found[::-1]]:
        torques = solve_driven(train, load, source, state)
        if back := next((pair for pair in torques.pairs.values() if pair.driver == locked.get(pair.id)), None):
            text = f"'{back.driver}' is held by the lock of '{back.id}' while it rests"
            torques = replace(torques, verdict=TorqueVerdict("self-locking", text))
        ways.append(DrivenWay(torques, source, load))
    return ways
