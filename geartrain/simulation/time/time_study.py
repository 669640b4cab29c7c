"""Time-domain simulation of a train by two runs with time steps h and h/2, whose results are compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, tau

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.kernels import is_fast
from geartrain.simulation.contacts.train_model import TrainModel
from geartrain.simulation.steps.simulation import StepPlan, simulate
from geartrain.simulation.time.run_figures import RunFigures
from geartrain.simulation.time.time_run import TimeRun

PER_TOOTH = 200
"""Number of steps of the coarser run in the shortest tooth-passing period."""
PER_SWING = 40
"""Number of steps in the period of the fastest mode of compliant teeth."""
_UNEVEN = 1.00618  # steps that meet a kink at every tooth would be evaluated on either side of it due to rounding
_FEWEST = 200  # minimum steps per revolution of the driving link
_FEWEST_TOUCHING = 1000  # the same with contacts: a pin's speed may change much within a small angle
_PER_BEAT = 1000  # steps between two beats of an escapement
_PER_FALL = 16  # steps of the motion between two stops of an escapement; a train at rest is not stepped
_MOST_FALLING = 300_000_000  # maximum number of steps of a run that are shortened for that
_SAMPLES = 12  # samples in the shortest tooth-passing period
_A_BEAT = 50  # samples between two beats of an escapement
_MOST_SAMPLES = 40_000
_FEWEST_SAMPLES = 500  # minimum samples of a run: the skipped part must be a whole number of samples
_MOST_STEPS = 2_000_000_000
_MOST_BLOCKS = 20  # maximum number of batches of whole revolutions
_MASSLESS = 1e-6  # factor of all inertias: a train this light is quasi-static
_SLOW = 7e-5  # time of one step of one contact in plain Python [s]


@dataclass(frozen=True)
class TimeStudy:
    """Time-domain simulation of a train by two runs, the second with half the time step of the first."""

    of: TrainModel
    outputs: Sequence[tuple[str, str, str]]
    turns: float
    """Revolutions of the driving link in the counted part."""
    skip: float = 1.0
    """Revolutions of the driving link before the counted part."""
    steps: int | None = None
    """Steps of the coarser run per revolution of the driving link; None to choose it from the tooth-passing periods."""
    samples: int | None = None
    """Number of samples of the whole run; None to choose a number that suits a spectrum."""
    fast: bool | None = None
    """True to compile the kernels, False to run them in Python; None to decide by the amount of work."""

    def __post_init__(self) -> None:
        if not self.turns > 0 or not self.skip >= 0:
            what = f"turns = {self.turns:g} or skip = {self.skip:g} is out of range"
            why = "turns must be above 0, and skip 0 or more"
            raise QuestionError(Problem(what, why, "for example, pass turns=10, skip=1"))
        if self.steps is not None and self.steps < 1:
            what = f"{self.steps} steps per revolution are too few"
            why = "at least 1 step per revolution is required"
            raise QuestionError(Problem(what, why, "for example, pass steps=200"))
        if self.per_turn * (self.turns + self.skip) > _MOST_STEPS:
            what = f"the run would take {self.per_turn * (self.turns + self.skip):.3g} steps"
            why = f"the maximum is {_MOST_STEPS:.0e} steps, which take days"
            raise QuestionError(Problem(what, why, "give fewer turns or steps"))

    @cached_property
    def busiest(self) -> float:
        """Maximum number of tooth-passing periods of a pair per revolution of the driving link, 1 or more."""
        return max([1.0, *(float(source.cycles) for source in self.of.sources.values())])

    @cached_property
    def per_turn(self) -> int:
        """Steps of the coarser run per revolution of the driving link."""
        if self.steps is not None:
            return self.steps
        fewest = _FEWEST_TOUCHING if self.of.model.pairs else _FEWEST
        found = max(fewest, ceil(PER_TOOTH * self.busiest * _UNEVEN))
        # a released escape wheel moves much faster than on average
        # the fastest mode must be resolved even if it is not excited by teeth
        swing = ceil(PER_SWING * self.of.fastest / abs(self.of.case.rate))
        found = max([found, swing, *(ceil(_PER_BEAT * each) for each in self.beats)])
        # a multiple, so that samples still coincide with beats
        falls = (_PER_FALL * tau / abs(self.of.case.rate) / each / found for each in self.of.model.fall_times)
        most = int(_MOST_FALLING / found / (self.turns + self.skip))
        return found * max(1, min(most, ceil(max(falls, default=1.0))))

    @property
    def beats(self) -> list[float]:
        """Number of beats of each escapement per revolution of the driving link."""
        return [tau / abs(self.of.case.rate) / beat for _, beat in self.of.case.escapements.values()]

    def plan(self, finer: int) -> StepPlan:
        """Return the time steps of one run: `finer` is 1 for time step h, 2 for h/2."""
        # the finer run has exactly twice the steps
        steps, skip = (round(each * self.per_turn) * finer for each in (self.turns, self.skip))
        often = max([_SAMPLES * self.busiest, *(_A_BEAT * each for each in self.beats)])
        samples = self.samples or min(_MOST_SAMPLES, max(_FEWEST_SAMPLES, ceil(often * (self.turns + self.skip))))
        stride = max(1, (steps + skip) // finer // max(samples, 2)) * finer
        # counting begins at a sample
        skip -= skip % stride
        # a block ends at a sample, so it may differ from whole revolutions by at most one sample
        block = round(ceil(self.turns / _MOST_BLOCKS) * self.per_turn * finer / stride) * stride
        return StepPlan(tau / abs(self.of.case.rate) / self.per_turn / finer, skip, steps, stride, block)

    @property
    def is_fast(self) -> bool:
        """True if the kernels are compiled for both runs."""
        steps = sum(plan.skip + plan.steps for plan in (self.plan(1), self.plan(2)))
        return is_fast(self.fast, steps * max(len(self.of.model.pairs), 1) * _SLOW)

    def run(self, on_done: Callable[[float], object] = lambda _: None) -> TimeRun:
        """Simulate both runs and return the result.

        on_done   called with the fraction of the total work done since the last call; if it returns True, the result is
                  that of the completed part of the first run, without a comparison

        Raises `KeyboardInterrupt` if `on_done` returns True before the counted part begins.
        """
        plans = self.plan(1), self.plan(2)
        whole = sum(plan.skip + plan.steps for plan in plans)
        fast, peaks = self.is_fast, self.static_peaks()

        def run(plan: StepPlan) -> RunFigures:
            done = simulate(self.of.model, plan, fast, lambda steps: on_done(steps / whole), self.of.yields)
            return RunFigures(self.of, self.outputs, done, peaks)

        first = run(plans[0])
        if not first.plan.steps:
            raise KeyboardInterrupt
        if first.plan.steps == plans[0].steps:
            second = run(plans[1])
            if second.plan.steps == plans[1].steps:
                return second.result(first)
        return first.result(None)

    def static_peaks(self) -> Sequence[float | None]:
        """Return the maximum quasi-static torque of each pair [N m], from a rigid run with almost no inertia.

        The values are None for rigid teeth, and if no speed is prescribed, since such a train would accelerate without
        limit.
        """
        model = self.of.model
        if self.of.yields is None or self.of.case.drive.kind != "rate":
            return [None] * len(model.pairs)
        steps = max(_FEWEST, ceil(PER_TOOTH * self.busiest))
        plan = StepPlan(tau / abs(self.of.case.rate) / steps, round(self.skip * steps), round(self.turns * steps), 1)
        # nearly without inertia a rigid train is quasi-static
        run = simulate(replace(model, mass=_MASSLESS * model.mass), plan, self.is_fast)
        return [float(each) for each in np.abs(run.forces[plan.skip :]).max(axis=0, initial=0.0)]
