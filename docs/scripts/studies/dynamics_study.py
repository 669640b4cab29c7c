"""Motion in time: error against run time of three ways for one pair, and which figures of a train settle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import degrees, sqrt
from typing import Literal

import numpy as np

from geartrain import GearTrain
from geartrain.simulation.contacts.compliant_train import damping_ratio
from studies.dynamics_methods import INERTIA, RATE, PairRun, by_events, stepped, yielding
from studies.measurement import Step, taken, timed
from studies.records import StudyRecords

RESTITUTIONS = (0.0, 0.5)
_STEPS, _FEW = (500, 2000, 8000, 32000, 128000), (500, 2000)
_STIFF, _SOFT = (1e2, 1e3, 1e4, 1e5), (1e2,)
_LOOK = 4.9  # s: when single trajectories are compared
_SWING = 80  # steps in a period of teeth that yield, or in what their damping takes


@dataclass(frozen=True, slots=True)
class PairRecord:
    """One way through two turns of the pair, against events.

    setting   steps a turn, or stiffness (N m/rad)
    steps     a turn; 0 for events
    apart     error of the share of time apart; `impacts`, of the energy of blows, relative
    """

    restitution: float
    method: str
    setting: float
    steps: int
    apart: float
    impacts: float
    seconds: float


@dataclass(frozen=True, slots=True)
class TrainRecord:
    """The Moon's train at 1 turn/s.

    steps           steps per turn of the reported run; `stiffness` is 0 for rigid teeth
    apart           mean share of time in which a pair is separated; `ahead` is the maximum lead of the Moon (degrees)
    moon_position   position of the Moon after 4.9 turns (degrees)
    torque          mean torque at the crank (N m)
    """

    restitution: float
    stiffness: float
    steps: int
    apart: float
    ahead: float
    moon_position: float
    torque: float
    seconds: float


@dataclass(frozen=True)
class DynamicsRecords(StudyRecords):
    """All measurements of one run on one machine."""

    pair: Sequence[PairRecord]
    train: Sequence[TrainRecord]


def dynamics(quick: bool = False) -> DynamicsRecords:
    """Measure all ways (`quick`: few settings, one turn of the train)."""
    return DynamicsRecords.sorted_by_kind("Motion in time", taken(_steps(quick)))


def _steps(quick: bool) -> Iterator[Step]:
    for restitution in RESTITUTIONS:
        yield f"pair, restitution {restitution:g}", partial(_pair, restitution, quick)
    # the last two tell chaos: one step a turn between them
    counts = (10_000,) if quick else (10_000, 20_000, 40_000, 40_001)
    for restitution in (0.0, 0.3):
        for steps in counts:
            yield f"train, {steps} steps", partial(_train, restitution, 0.0, steps, 4 if quick else 10)
        for stiffness in () if quick else (20.0, 200.0):
            yield f"train, {stiffness:g} N m/rad", partial(_train, restitution, stiffness, None, 4)


def _pair(restitution: float, quick: bool) -> list[PairRecord]:
    truth = by_events(restitution, 1e-12)
    stepped(restitution, 10), yielding(restitution, 1e2, 10)  # compiled before they are timed

    def record(method: str, setting: float, steps: int, seconds: float, found: PairRun) -> PairRecord:
        off = found.apart - truth.apart, found.impacts / truth.impacts - 1
        return PairRecord(restitution, method, setting, steps, float(off[0]), float(off[1]), seconds)

    rows = [record("events", 1e-8, 0, *timed(partial(by_events, restitution, 1e-8)))]
    for steps in _FEW if quick else _STEPS:
        rows.append(record("rigid steps", steps, steps, *timed(partial(stepped, restitution, steps))))
    for stiffness in _SOFT if quick else _STIFF:
        rate = sqrt(stiffness / INERTIA) * max(1.0, damping_ratio(restitution))
        count = round(_SWING * rate / RATE)
        run = timed(partial(yielding, restitution, stiffness, count))
        rows.append(record("teeth that yield", stiffness, count, *run))
    return rows


def _train(restitution: float, stiffness: float, steps: int | None, turns: float) -> list[TrainRecord]:
    more = {"stiffness": f"{stiffness} N m/rad"} if stiffness else {}
    train = GearTrain.declare({"extends": "moon-triangular-inertia", "friction": 0, **more})
    ask = partial(train.dynamics, rate="1 turn/s", restitution=restitution, outputs=["moon"], steps=steps, fast=True)
    model: Literal["rigid", "compliant"] = "compliant" if stiffness else "rigid"
    ask(turns=0.01, skip=0, model=model)
    seconds, run = timed(partial(ask, turns=turns, model=model))
    pairs, moon = run.contacts, run.leads[0]
    told = round(1 / run.step)
    apart = sum(each.apart for each in pairs) / len(pairs)
    position = degrees(float(np.interp(_LOOK, run.time, run["moon"])))
    return [TrainRecord(restitution, stiffness, told, apart, degrees(moon.ahead), position % 360, run.torque, seconds)]
