"""A train asked for its motion in time: two runs, of steps h and h/2, and what they say."""

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
"""Steps of the coarser run in the shortest period of a pair."""
PER_SWING = 40
"""In the period of the fastest mode, where teeth yield."""
_UNEVEN = (
    1.00618  # steps that fall on corners tooth after tooth are read on either side of them by rounding, and part teeth
)
_FEWEST = 200  # steps in a turn of the lead
_FEWEST_TOUCHING = 1000  # where pairs touch and part: a pin's speed changes much in little of its turn
_PER_BEAT = 1000  # steps from one beat of an escapement to the next
_PER_FALL = 16  # from one stop of an escapement to the next, while a train at rest is not stepped
_MOST_FALLING = 300_000_000  # steps of a run that are made so short for that
_SAMPLES = 12  # in the shortest period of a pair
_A_BEAT = 50  # samples of an escapement
_MOST_SAMPLES = 40_000
_FEWEST_SAMPLES = 500  # of a run: what is left out before it is counted in whole samples
_MOST_STEPS = 2_000_000_000
_MOST_BLOCKS = 20  # whole turns or several, whose figures are compared
_MASSLESS = 1e-6  # of all inertias: what turns so light is in balance at every moment
_SLOW = 7e-5  # s: a step of one contact in plain Python


@dataclass(frozen=True)
class TimeStudy:
    """What is asked of a train in time."""

    of: TrainModel
    outputs: Sequence[tuple[str, str, str]]
    turns: float
    """Of the lead: counted, and left out before."""
    skip: float = 1.0
    """Of the lead: counted, and left out before."""
    steps: int | None = None
    """Of the coarser run in a turn of the lead; None for what its teeth ask."""
    samples: int | None = None
    """Kept of the whole run; None for what a spectrum asks."""
    fast: bool | None = None
    """Whether kernels are compiled; None decides by the work."""

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
        fewest = _FEWEST_TOUCHING if self.of.model.pairs else _FEWEST
        found = max(fewest, ceil(PER_TOOTH * self.busiest * _UNEVEN))
        # a wheel that is let go falls much faster than it turns on the mean
        swing = ceil(PER_SWING * self.of.fastest / abs(self.of.case.rate))
        found = max([found, swing, *(ceil(_PER_BEAT * each) for each in self.beats)])
        # a multiple, so that samples still fall on beats
        falls = (_PER_FALL * tau / abs(self.of.case.rate) / each / found for each in self.of.model.falls)
        most = int(_MOST_FALLING / found / (self.turns + self.skip))
        return found * max(1, min(most, ceil(max(falls, default=1.0))))

    @property
    def beats(self) -> list[float]:
        """Beats of each escapement in a turn of the lead."""
        return [tau / abs(self.of.case.rate) / beat for _, beat in self.of.case.escapements.values()]

    def plan(self, finer: int) -> StepPlan:
        """The steps of one run: `finer` 1 or 2."""
        steps, skip = (round(each * self.per_turn) * finer for each in (self.turns, self.skip))
        often = max([_SAMPLES * self.busiest, *(_A_BEAT * each for each in self.beats)])
        samples = self.samples or min(_MOST_SAMPLES, max(_FEWEST_SAMPLES, ceil(often * (self.turns + self.skip))))
        stride = max(1, (steps + skip) // finer // max(samples, 2)) * finer
        skip -= skip % stride
        # a block ends with a sample, and is at most a sample off whole turns
        block = round(ceil(self.turns / _MOST_BLOCKS) * self.per_turn * finer / stride) * stride
        return StepPlan(tau / abs(self.of.case.rate) / self.per_turn / finer, skip, steps, stride, block)

    @property
    def is_fast(self) -> bool:
        """Whether kernels are compiled for both runs."""
        steps = sum(plan.skip + plan.steps for plan in (self.plan(1), self.plan(2)))
        return is_fast(self.fast, steps * max(len(self.of.model.pairs), 1) * _SLOW)

    def run(self, on_done: Callable[[float], object] = lambda _: None) -> TimeRun:
        """Both runs, and what they say.

        on_done   called with the share of the work that each stretch adds; where it returns True, what is done is told:
                  of the first run, as far as it came, without another to compare it with

        Raises `KeyboardInterrupt` where it does so before anything is counted.
        """
        model = self.of.model
        plans = self.plan(1), self.plan(2)
        whole = sum(plan.skip + plan.steps for plan in plans)
        fast = self.is_fast
        stopped = False

        def advance(steps: int) -> bool:
            nonlocal stopped
            stopped = on_done(steps / whole) is True
            return stopped

        yields = self.of.yields
        peaks = self.static_peaks()
        first = RunFigures(self.of, self.outputs, simulate(model, plans[0], fast, advance, yields), peaks)
        if not first.plan.steps:
            raise KeyboardInterrupt
        if stopped:
            return first.told(None)
        second = RunFigures(self.of, self.outputs, simulate(model, plans[1], fast, advance, yields), peaks)
        return first.told(None) if second.plan.steps < plans[1].steps else second.told(first)

    def static_peaks(self) -> Sequence[float | None]:
        """Greatest torque of each pair (N m) in balance at every moment: rigid, and nearly without inertia.

        None where teeth are rigid, or where no speed is prescribed, since such a train would run away.
        """
        model = self.of.model
        if self.of.yields is None or self.of.case.drive.kind != "rate":
            return [None] * len(model.pairs)
        steps = max(_FEWEST, ceil(PER_TOOTH * self.busiest))
        plan = StepPlan(tau / abs(self.of.case.rate) / steps, round(self.skip * steps), round(self.turns * steps), 1)
        run = simulate(replace(model, mass=_MASSLESS * model.mass), plan, self.is_fast)
        return [float(each) for each in np.abs(run.forces[plan.skip :]).max(axis=0, initial=0.0)]
