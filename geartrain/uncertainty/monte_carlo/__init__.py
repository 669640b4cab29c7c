"""Trains cut by hand, many times over: how often they jam, how far their pointers stray, and whose fault it is."""

from geartrain.uncertainty.confidence_intervals import IntervalEstimate, ProbabilityEstimate
from geartrain.uncertainty.manufacturing_errors.declared_errors import ERROR_KINDS, ErrorOverride, read_error_overrides
from geartrain.uncertainty.monte_carlo.clearance_study import (
    ClearanceCase,
    jamming_map,
    read_clearances,
    run_clearances,
)
from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult
from geartrain.uncertainty.monte_carlo.pointer_error import (
    PairEventRates,
    PointerErrorCourse,
    PointerErrorStatistics,
    TrialResults,
)
from geartrain.uncertainty.monte_carlo.sobol_indices import SobolIndex, SobolIndices, find_sobol_indices
from geartrain.uncertainty.monte_carlo.tolerance_allocation import ToleranceAllocation, find_tolerance
from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan, find_trial_plan
from geartrain.uncertainty.monte_carlo.trial_run import (
    TrialRecord,
    check_trials,
    journal_key,
    run_course,
    run_trials,
)

__all__ = [
    "ERROR_KINDS",
    "ClearanceCase",
    "ErrorOverride",
    "IntervalEstimate",
    "MonteCarloResult",
    "PairEventRates",
    "PointerErrorCourse",
    "PointerErrorStatistics",
    "ProbabilityEstimate",
    "SobolIndex",
    "SobolIndices",
    "ToleranceAllocation",
    "TrialPlan",
    "TrialRecord",
    "TrialResults",
    "check_trials",
    "find_sobol_indices",
    "find_tolerance",
    "find_trial_plan",
    "jamming_map",
    "journal_key",
    "read_clearances",
    "read_error_overrides",
    "run_clearances",
    "run_course",
    "run_trials",
]
