"""A train asked for its motion in time: two runs, of steps h and h/2, and what they say."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil, tau
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.dynamics.time.angle_spectrum import find_peaks
from geartrain.dynamics.time.contact_system import (
    BEARINGS,
    BLOW_COUNT,
    BLOW_ENERGY,
    BLOW_SPEED,
    BLOWS,
    CHANGES,
    FRICTION,
    GAP,
    IMPACTS,
    IMPULSE,
    RUBBED,
    STEP,
    TIME_APART,
    TIME_COAST,
    UNSOLVED,
    VISCOUS,
    WORK_DRIVE,
    WORK_SPRING,
    WORK_TORQUE,
)
from geartrain.dynamics.time.run_parts import (
    ContactInTime,
    EnergyAccount,
    ImpactList,
    OutputLead,
    SettledFigure,
    SpectrumPeak,
)
from geartrain.dynamics.time.simulation import SimulatedRun, StepPlan, simulate
from geartrain.dynamics.time.time_run import TimeRun
from geartrain.dynamics.time.train_model import TrainModel
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.kernels import is_fast
from geartrain.numerics.labelled_array import labelled_array

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

PER_TOOTH = 200
"""Steps of the coarser run in the shortest period of a pair."""
_FEWEST = 200  # steps in a turn of the lead
_SAMPLES = 12  # in the shortest period of a pair
_MOST_SAMPLES = 40_000
_MOST_STEPS = 2_000_000_000
_SLOW = 7e-5  # s: a step of one contact in plain Python
_AGREE = 0.05  # of a figure; `_SHARE`, of a share of time
_SHARE = 0.005


@dataclass(frozen=True)
class TimeStudy:
    """What is asked of a train in time.

    turns, skip   of the lead: counted, and left out before
    steps         of the coarser run in a turn of the lead; None for what its teeth ask
    samples       kept of the whole run; None for what a spectrum asks
    apart         gap from which teeth count as apart (rad)
    fast          whether kernels are compiled; None decides by the work
    """

    of: TrainModel
    outputs: Sequence[tuple[str, str, str]]
    turns: float
    skip: float = 1.0
    steps: int | None = None
    samples: int | None = None
    apart: float = 1e-5
    fast: bool | None = None

    def __post_init__(self) -> None:
        if not self.turns > 0 or not self.skip >= 0:
            what = f"a run of {self.turns:g} turns after {self.skip:g}"
            raise QuestionError(Problem(what, "time goes on", "give turns above 0, and 0 or more to leave out"))
        if self.steps is not None and self.steps < 1:
            raise QuestionError(Problem(f"{self.steps} steps in a turn", "time goes on", "give 1 or more"))
        if self.per_turn * (self.turns + self.skip) > _MOST_STEPS:
            what = f"{self.per_turn * (self.turns + self.skip):.3g} steps"
            raise QuestionError(Problem(what, f"more than {_MOST_STEPS:.0e} take days", "give fewer turns or steps"))

    @cached_property
    def busiest(self) -> float:
        """Periods of the pair that has most of them in a turn of the lead; 1 or more."""
        return max([1.0, *(float(source.cycles) for source in self.of.sources.values())])

    @cached_property
    def per_turn(self) -> int:
        """Steps of the coarser run in a turn of the lead."""
        if self.steps is not None:
            return self.steps
        found = max(_FEWEST, ceil(PER_TOOTH * self.busiest))
        turn = tau / abs(self.of.case.rate)
        beats = [beat for _, beat in self.of.case.escapements.values()]
        # a wheel that is let go falls much faster than it turns on the mean
        return max([found, *(ceil(50 * PER_TOOTH * turn / beat / 50) for beat in beats)])

    def plan(self, finer: int) -> StepPlan:
        """The steps of one run: `finer` 1 or 2."""
        steps, skip = (round(each * self.per_turn) * finer for each in (self.turns, self.skip))
        samples = self.samples or min(_MOST_SAMPLES, ceil(_SAMPLES * self.busiest * (self.turns + self.skip)))
        stride = max(1, (steps + skip) // finer // max(samples, 2)) * finer
        skip -= skip % stride
        return StepPlan(tau / abs(self.of.case.rate) / self.per_turn / finer, skip, steps, stride, self.apart)

    def run(self, on_done: Callable[[float], None] = lambda _: None) -> TimeRun:
        """Both runs, and what they say; `on_done` is called with the share of the work that each stretch adds."""
        model = self.of.model
        plans = self.plan(1), self.plan(2)
        whole = sum(plan.skip + plan.steps for plan in plans)
        fast = is_fast(self.fast, whole * max(len(model.pairs), 1) * _SLOW)
        runs = [_Reading(self, simulate(model, plan, fast, lambda done: on_done(done / whole))) for plan in plans]
        return runs[1].told(runs[0])


@dataclass(frozen=True)
class _Reading:
    """One run as figures of the train."""

    study: TimeStudy
    run: SimulatedRun

    @property
    def of(self) -> TrainModel:
        return self.study.of

    @property
    def plan(self) -> StepPlan:
        return self.run.plan

    @cached_property
    def duration(self) -> float:
        return self.plan.step * self.plan.steps

    @cached_property
    def first(self) -> int:
        """The first sample of what is counted."""
        return self.plan.skip // self.plan.stride

    @cached_property
    def time(self) -> Floats:
        return np.asarray(self.plan.step * self.plan.stride * np.arange(1, len(self.run.angles) + 1), dtype=np.float64)

    @cached_property
    def turned(self) -> Floats:
        """Angles of all links since the start (rad), (links, samples)."""
        found: Floats = self.of.speeds @ self.run.angles.T
        return found

    def turns_of(self, link: str) -> Floats:
        return np.asarray(self.turned[self.of.index[link]] / tau, dtype=np.float64)

    @cached_property
    def turns(self) -> Floats:
        """Turns of the lead, forwards."""
        return np.asarray(self.of.way * self.turns_of(self.of.problem.lead), dtype=np.float64)

    @cached_property
    def names(self) -> list[str]:
        return [pair.name for pair in self.of.model.pairs] + [stop.name for stop in self.of.model.stops]

    @cached_property
    def contacts(self) -> tuple[ContactInTime, ...]:
        steps, time = self.plan.steps, self.duration
        return tuple(
            ContactInTime(
                name,
                float(counts[TIME_APART] / steps),
                float(counts[TIME_COAST] / steps),
                float(counts[BLOW_COUNT] / time),
                float(counts[BLOW_ENERGY] / time),
                float(counts[BLOW_SPEED]),
                float(counts[IMPULSE] / time),
                float(counts[RUBBED] / time),
                float(counts[GAP]),
                float(counts[CHANGES] / time),
            )
            for name, counts in zip(self.names, self.run.counts, strict=True)
        )

    @cached_property
    def energy(self) -> EnergyAccount:
        energy = self.run.energy
        return EnergyAccount(
            drive=float(energy[WORK_DRIVE]),
            loads=float(energy[WORK_TORQUE]),
            springs=float(energy[WORK_SPRING]),
            bearings=float(energy[BEARINGS]),
            drag=float(energy[VISCOUS]),
            friction=float(energy[FRICTION]),
            blows=float(energy[BLOWS]),
            steps=float(energy[STEP]),
            kinetic=self.run.end - self.run.start,
            stored=self.run.end,
        )

    @cached_property
    def drive(self) -> Floats:
        """Torque where power enters, the way its link turns."""
        source = self.of.case.drive
        way = -1.0 if self.of.typical(source.link) < 0 else 1.0
        if source.kind == "rate":
            return np.asarray(way * self.run.drive[:, self.of.coordinates.index(source.link)])
        if source.kind == "torque":
            return np.full(len(self.time), way * source.torque)
        rest = source.wound + source.rate * self.time
        return np.asarray(way * source.stiffness * (rest - self.turned[self.of.index[source.link]]))

    @cached_property
    def torque(self) -> float:
        source, energy = self.of.case.drive, self.energy
        if source.kind == "torque":
            return float(abs(source.torque))
        angle = abs(float(self.of.speeds[self.of.index[source.link]] @ self.run.turned))
        work = energy.drive if source.kind == "rate" else energy.springs
        return float(work / angle) if angle else 0.0

    @cached_property
    def differences(self) -> dict[str, Floats]:
        """By how much each output is ahead of the motion in which all drive flanks touch (rad)."""
        motion = self.of.motion
        turns = self.turns * self.of.way
        names = list(motion.outputs)
        at = motion.at(np.append(turns, 0.0)).error if motion.ahead.used else np.zeros((len(names), len(turns) + 1))
        found = {}
        for name, link, base in self.study.outputs:
            parts = []
            for each in (link, base):
                row = names.index(each)
                mean = float(self.of.problem.ratio(each)) * tau * turns
                parts.append(self.turned[self.of.index[each]] - mean - (at[row, :-1] - at[row, -1]))
            sense = self.of.sense(link, base)
            way = -1.0 if self.of.typical(link) - sense * self.of.typical(base) < 0 else 1.0
            found[name] = way * (parts[0] - sense * parts[1])
        return found

    @cached_property
    def leads(self) -> tuple[OutputLead, ...]:
        counted = {name: each[self.first :] for name, each in self.differences.items()}
        return tuple(
            OutputLead(
                name,
                float(max(each.max(initial=0.0), 0.0)),
                float(max(-each.min(initial=0.0), 0.0)),
                float(np.sqrt(np.mean(each**2))) if len(each) else 0.0,
            )
            for name, each in counted.items()
        )

    def figures(self) -> Iterator[tuple[str, str, float, Literal["mean", "extreme"]]]:
        """What is compared between runs."""
        yield "torque of the drive", "N m", self.torque, "mean"
        yield "power of blows", "W", self.energy.blows / self.duration, "mean"
        for each in self.contacts:
            yield f"{each.name} apart", "", each.apart, "mean"
            yield f"{each.name} on the coast flank", "", each.coast, "mean"
        for lead in self.leads:
            yield f"{lead.output} ahead", "rad", lead.ahead, "extreme"
            yield f"{lead.output} behind", "rad", lead.behind, "extreme"

    def told(self, coarse: _Reading) -> TimeRun:
        """The result, this run being the finer one."""
        links, time = self.of.problem.system.links, [repr(float(each)) for each in self.time]
        start = np.array([self.of.problem.angles.get(link, 0.0) for link in links])[:, None]
        figures = zip(coarse.figures(), self.figures(), strict=True)
        return TimeRun(
            self.of.train.name,
            self.of.state,
            self.of.problem.lead,
            float(self.of.speeds[self.of.index[self.of.problem.lead]] @ self.run.turned) / self.duration,
            self.plan.step,
            self.plan.step * self.plan.skip,
            self.duration,
            _frozen(self.time),
            _frozen(self.turns),
            labelled_array(start + self.turned, link=links, time=time),
            labelled_array(self.of.speeds @ self.run.speeds.T, link=links, time=time),
            labelled_array(np.ascontiguousarray(self.run.forces.T), contact=self.names, time=time),
            _frozen(self.drive),
            self.torque,
            self.contacts,
            self._impacts(),
            self.energy,
            self.leads,
            {name: tuple(self._peaks(name)) for name, _, _ in self.study.outputs},
            tuple(_compared(*pair) for pair in figures),
            self.run.numbers[UNSOLVED],
            self.of.notes,
        )

    def _impacts(self) -> ImpactList:
        time, which, speed, energy, impulse = (_frozen(each) for each in self.run.impacts.T.copy())
        names = tuple(self.names[int(each)] for each in which)
        return ImpactList(self.run.numbers[IMPACTS], names, time, speed, energy, impulse)

    def _peaks(self, name: str) -> Iterator[SpectrumPeak]:
        link, base = next(each[1:] for each in self.study.outputs if each[0] == name)
        angle = self.turned[self.of.index[link]] - self.of.sense(link, base) * self.turned[self.of.index[base]]
        cycles = {source.id: float(source.cycles) for source in self.of.sources.values()}
        return iter(find_peaks(self.time[self.first :], angle[self.first :], abs(self.of.case.rate) / tau, cycles))


def _compared(
    coarse: tuple[str, str, float, Literal["mean", "extreme"]], fine: tuple[str, str, float, Literal["mean", "extreme"]]
) -> SettledFigure:
    name, unit, one, kind = coarse
    other = fine[2]
    near = _SHARE if not unit else 1e-6 if unit == "rad" else 0.0
    settled = bool(abs(one - other) <= max(_AGREE * max(abs(one), abs(other)) if unit else 0.0, near))
    return SettledFigure(name, unit, one, other, kind, settled)


def _frozen(values: Floats) -> Floats:
    values = np.asarray(values)
    values.flags.writeable = False
    return values
