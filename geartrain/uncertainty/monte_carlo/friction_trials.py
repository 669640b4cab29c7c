"""Torque over a turn where friction is known by its spread alone: trials with coefficients drawn anew."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.plain_data import Result
from geartrain.numerics.work import Execution
from geartrain.uncertainty.confidence_intervals import (
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    mean_of,
    percentiles_of,
)
from geartrain.uncertainty.monte_carlo.friction_plan import FrictionPlan, FrictionSpread, draw_friction
from geartrain.uncertainty.monte_carlo.trial_run import check_trials

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

FIGURES = ("mean", "greatest", "starting", "efficiency")
_TASK = 8  # trials that one task does: few, so that all processes have work


@dataclass(frozen=True)
class TrialFigure(Result):
    """One figure over trials.

    Attributes
    ----------
    values : ndarray
        Of the trials in which there is one, in their order.

    See Also
    --------
    FrictionTrials : holds them.
    """

    KEYS = ("mean", "deviation", "percentiles")

    values: Floats

    @property
    def mean(self) -> IntervalEstimate:
        """Mean, with its 95 % interval."""
        return mean_of(self.values)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation, with its 95 % interval."""
        return deviation_of(self.values)

    @property
    def percentiles(self) -> Mapping[float, IntervalEstimate]:
        """Percentiles, each with its 95 % interval; 95 % of the trials lie between the outer two."""
        return percentiles_of(self.values)


@dataclass(frozen=True)
class FrictionTrials(Result):
    """Torque over a turn in many trials of its friction.

    Attributes
    ----------
    link : str
        The link whose torque it is.
    wanted, done : int
        Trials asked for, and worked out.
    seed : int
        Of all that was drawn.
    spreads : mapping of str to FrictionSpread
        By `train` and by pair or coupling, what was drawn.
    mean, greatest, starting : TrialFigure
        Mean, greatest and starting torque of the trials that have one [N m, or plain].
    efficiency : TrialFigure
        Energy out over energy in.
    locks : ProbabilityEstimate
        How often the train locks somewhere in the run.

    See Also
    --------
    try_frictions : gives it.
    """

    KEYS = ("link", "wanted", "done", "seed", "spreads", *FIGURES, "locks")

    link: str
    wanted: int
    done: int
    seed: int
    spreads: Mapping[str, FrictionSpread]
    mean: TrialFigure
    greatest: TrialFigure
    starting: TrialFigure
    efficiency: TrialFigure
    locks: ProbabilityEstimate

    @property
    def complete(self) -> bool:
        """True if all trials that were asked for are done."""
        return self.done == self.wanted


def try_frictions(plan: FrictionPlan, trials: int, seed: int = 1, means: Execution | None = None) -> FrictionTrials:
    """Torque over a turn, so many times, each with frictions of its own.

    The same for any number of workers, however often it was interrupted and taken up. Interrupted (Ctrl-C), it returns
    the trials that are done.

    Parameters
    ----------
    plan : FrictionPlan
        The train and the run.
    trials : int
        1 to 10^9.
    seed : int
        The same seed draws the same frictions.
    means : Execution, optional
        Executor, journal of finished trials, progress report; by default this process, and none of the others.

    Returns
    -------
    FrictionTrials
        Mean, greatest and starting torque and efficiency with their intervals.

    Raises
    ------
    QuestionError
        For a number of trials that tells nothing, or where the torque is not known at all.

    Examples
    --------
    A pin at 10 mm in a slot 8 mm off: the mean torque is 10 (1 + 0.7 f) (docs/torques.md, equation 18), and so varies
    by 7 times what f does.

    >>> from geartrain import load
    >>> from geartrain.uncertainty.monte_carlo.friction_plan import find_friction_plan
    >>> plan = find_friction_plan(load('''
    ... links: {frame: {}, a: {}, b: {}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... couplings:
    ...   - {kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm,
    ...      friction: {sliding: 0.3, deviation: 0.05}}
    ... inputs: {a: 1}
    ... loads: {b: -10 N m}
    ... '''), turns=1, samples=100)
    >>> found = try_frictions(plan, trials=20)
    >>> 11.7 < found.mean.mean.value < 12.5 and found.locks.count == 0
    True
    """
    check_trials(trials)
    tasks = [[start, min(start + _TASK, trials)] for start in range(0, trials, _TASK)]
    found: list[list[float | None]] = []
    try:
        for rows in (means or Execution()).run(partial(work_frictions, plan, seed), tasks):
            found += rows
    except KeyboardInterrupt:
        if not found:
            raise
    columns = [np.array([value for value in column if value is not None]) for column in zip(*found, strict=True)]
    figures = dict(zip(FIGURES, map(TrialFigure, columns), strict=True))
    locked = sum(row[0] is None for row in found)
    return FrictionTrials(
        _link(plan), trials, len(found), seed, plan.spreads, **figures, locks=ProbabilityEstimate(locked, len(found))
    )


def work_frictions(plan: FrictionPlan, seed: int, task: Sequence[int]) -> list[list[float | None]]:
    """Some trials as plain data: the figures of each, None where the train locks."""
    return [list(plan.follow(draw_friction(plan.declared, seed, trial))) for trial in range(*task)]


def _link(plan: FrictionPlan) -> str:
    """The link whose torque is told; nothing of the run is followed for it."""
    from geartrain.analysis.gear_train import GearTrain

    return plan.of or GearTrain(plan.declared).torques(plan.state).asked[0]
