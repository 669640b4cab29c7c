"""The fifth cause: wheels cut by hand. Trials of the whole train, and of each what even teeth would do taken off.

A trial's error holds the ripple of even teeth too, which is a cause of its own. The same positions with even teeth are
composed again and subtracted: what is left is the cutting's (docs/cut-by-hand.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError
from geartrain.uncertainty.budget.pointer_budget import BudgetCause, Declared
from geartrain.uncertainty.budget.tooth_motion import DeclaredPairs, ErrorDifference, without_teeth
from geartrain.uncertainty.confidence_intervals import deviation_of, percentile_of
from geartrain.uncertainty.manufacturing_errors.declared_errors import read_error_overrides
from geartrain.uncertainty.monte_carlo.clearance_study import run_clearances
from geartrain.uncertainty.monte_carlo.pointer_error import FEWEST
from geartrain.uncertainty.monte_carlo.trial_plan import find_trial_plan
from geartrain.uncertainty.monte_carlo.trial_results import turning_trials
from geartrain.uncertainty.monte_carlo.trial_run import run_trials

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.work import Execution
    from geartrain.uncertainty.monte_carlo.clearance_study import ClearanceCase
    from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan
    from geartrain.uncertainty.monte_carlo.trial_results import TrialResults


@dataclass(frozen=True)
class CuttingTrials:
    """Trials of a train, with what even teeth do at the same positions (rad), (outputs, trials)."""

    trials: TrialResults
    even: Floats

    def cause(self, name: str, known: DeclaredPairs) -> BudgetCause:
        """The range that holds 95 % of the errors of one output, and its interval: ends of both percentiles'.

        known   what moves the output
        """
        at = self.trials.plan.outputs.index(name)
        errors = self.trials.errors[:, at]
        whole = np.isfinite(errors)
        reach = len(self.trials.plan.reach[at])
        if known.gears and not reach:
            return BudgetCause.unknown("cutting", "none of the pairs that move it can be cut")
        if known.bare and not np.ptp(errors[whole]):
            return BudgetCause.unknown("cutting", f"no dimensions are declared of {', '.join(known.bare)}")
        runs = whole & turning_trials(self.trials.marks, self.trials.plan.reach[at])
        kept = runs if np.count_nonzero(runs) >= FEWEST else whole
        note = f"{int(np.count_nonzero(runs))} of {self.trials.done} trials turn"
        note += f", {reach} of {known.gears} pairs cut" if reach < known.gears else ""
        note += "" if kept is runs else "; taken from all, as the pushing flanks alone would have them"
        values = np.sort((errors - self.even[at])[kept])
        low, high = percentile_of(values, 2.5), percentile_of(values, 97.5)
        size = degrees(high.value - low.value)
        within = degrees(max(high.low - low.high, 0.0)), degrees(high.high - low.low)
        interval = within if np.isfinite(within).all() else None
        if interval is None:
            note += "; too few trials for an interval"
        declared: Declared = "part" if known.bare or reach < known.gears else "whole"
        deviation = degrees(deviation_of(values).value)
        return BudgetCause("cutting", declared, size, deviation, interval=interval, note=note)


def find_cutting_trials(plan: TrialPlan, motion: Motion, count: int, seed: int, means: Execution) -> CuttingTrials:
    """Cut the wheels so many times; the motion is that with even teeth."""
    found = run_trials(plan, count, seed, means)
    if not found.complete:  # interrupted: a budget of half the trials would not say so
        raise KeyboardInterrupt
    teeth = ErrorDifference(plan.composition, without_teeth(motion).ahead)
    parts = [teeth.at(found.turns[start : start + teeth.chunk]).error for start in range(0, found.done, teeth.chunk)]
    return CuttingTrials(found, np.concatenate(parts, axis=1))


def cutting_plan(
    train: GearTrain, cutting: Sequence[str], outputs: Sequence[str], state: str | None, without: Sequence[str]
) -> tuple[TrialPlan | None, str]:
    """What trials need, or why there are none. Raises `GearTrainError` where `cutting` cannot be tried."""
    settings = read_error_overrides(cutting)
    try:
        return find_trial_plan(train, settings, outputs, state, without), ""
    except GearTrainError as error:
        if cutting:
            raise
        return None, error.problems[0].what


def jams_over_clearance(
    plan: TrialPlan, clearances: Sequence[float], count: int, seed: int, means: Execution
) -> tuple[tuple[ClearanceCase, ...], str]:
    """How often some pair jams at each clearance; none, and why, where a pair has no window."""
    if not clearances:
        return (), "no clearance was asked for"
    try:
        return tuple(run_clearances(plan, clearances, count, seed, means)), ""
    except GearTrainError as error:
        return (), error.problems[0].what
