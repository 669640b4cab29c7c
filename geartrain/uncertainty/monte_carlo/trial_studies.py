"""What is asked of a train beside its trials: clearances, courses, Sobol indices, a map of jams."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from geartrain.numerics.work import Execution
from geartrain.uncertainty.monte_carlo.clearance_study import jamming_map, run_clearances
from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult
from geartrain.uncertainty.monte_carlo.sobol_indices import find_sobol_indices
from geartrain.uncertainty.monte_carlo.trial_results import TrialResults
from geartrain.uncertainty.monte_carlo.trial_run import run_course

_FEW = 4  # outputs whose course and indices are worked out at a time
_POSITIONS, _COURSES = 120, 128  # along a turn, and trials that take them
_SHARES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)  # of windows, where no clearances are given
_SCALES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # of the errors declared


@dataclass(frozen=True)
class TrialStudies:
    """What is asked beside the trials themselves.

    clearances   factors, or shares of windows, at which the train is judged again
    courses      whether the first outputs are followed along a turn
    sobol        whether their Sobol indices are found, by wheel and by kind
    """

    clearances: Sequence[float] = ()
    courses: bool = False
    sobol: bool = False

    def of(self, trials: TrialResults, means: Execution) -> MonteCarloResult:
        """The trials with all that is asked beside them."""
        plan, seed, count = trials.plan, trials.seed, trials.wanted
        few = range(min(_FEW, len(plan.outputs)))
        by: tuple[Literal["wheel", "kind"], ...] = ("wheel", "kind")
        return MonteCarloResult(
            trials,
            run_clearances(plan, self.clearances, count, seed, means) if self.clearances else (),
            [run_course(plan, at, _POSITIONS, seed, _COURSES) for at in few] if self.courses else (),
            [find_sobol_indices(plan, at, each, count, seed, means) for at in few for each in by] if self.sobol else (),
        )

    def mapped(self, findings: MonteCarloResult, means: Execution) -> MonteCarloResult:
        """The findings with what a map of jams needs: the clearances, or others, and errors of other sizes."""
        of = findings.trials
        clearances = self.clearances or _SHARES
        return replace(findings, cleared=jamming_map(of.plan, clearances, _SCALES, of.wanted, of.seed, means))
