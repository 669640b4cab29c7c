"""What the kernels of time stepping write: the state of a train, and a record of its run."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

OPEN, FRONT, BACK = 0, 1, 2
"""Which flank of a pair touches: none, the drive flank, the coast flank."""

WORK_DRIVE, WORK_TORQUE, WORK_SPRING, BEARINGS, VISCOUS, BLOWS, STEP, FRICTION = range(8)
"""Columns of the energy account (J): three kinds of work put in, five of loss."""

ENERGIES = 8

TIME_APART, TIME_COAST, BLOW_COUNT, BLOW_ENERGY, BLOW_SPEED, IMPULSE, RUBBED, GAP, CHANGES = range(9)
"""Columns of what is counted of each pair: steps apart and on the coast flank, blows, their energy and greatest speed,
impulse, energy rubbed away, greatest gap, changes of flank."""

COUNTS = 9

IMPACT_COLUMNS = 5
"""Columns of the list of impacts: time, pair (stops behind the pairs), closing speed, energy, impulse."""


class ContactState(NamedTuple):
    """Where a train is: changed by the kernel in place.

    clock      time (s), step number
    angle      of the coordinates (rad); `speed` (rad/s)
    touching   flank of each pair; `turning`, of each bearing: -1, 0 (stuck), 1; `stopped` of each stop: 0, 1
    ratio      speed ratio of each pair at the last step, (pairs, 2); `struck` of pairs and stops: 1 in a blow
    steady     impulse of each pair in its last step without blow
    flown      steps for which each pair has been apart; `stop_rate`, (stops, 2), speeds at each stop a step ago, and
               when it was last left
    """

    clock: Floats
    angle: Floats
    speed: Floats
    touching: Ints
    turning: Ints
    stopped: Ints
    ratio: Floats
    struck: Ints
    steady: Floats
    flown: Ints
    stop_rate: Floats


class RunRecord(NamedTuple):
    """What a run leaves: changed by the kernel in place.

    energy         as `WORK_DRIVE` and the others
    counts         (pairs and stops, COUNTS)
    angles, speeds samples, (samples, n); `forces` mean force torques between samples, (samples, pairs + stops)
    drive          mean torque of each prescribed coordinate between samples, (samples, n)
    impacts        (room, IMPACT_COLUMNS); `numbers`: samples, impacts seen, steps not solved, pivots, steps
                   counted, 1 where the steps diverged and the run stopped
    """

    energy: Floats
    counts: Floats
    angles: Floats
    speeds: Floats
    forces: Floats
    drive: Floats
    impacts: Floats
    numbers: Ints


SAMPLES, IMPACTS, UNSOLVED, PIVOTS, STEPS, DIVERGED = range(6)
