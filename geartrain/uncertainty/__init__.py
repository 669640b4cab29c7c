"""Trains in doubt: tooth counts that are not certain, wheels that are not cut true.

posterior
    In: a declaration with wheels in doubt, and what is known of its outputs. Out, by `infer_counts`: the posterior of
    every count by Bayes' theorem, exact by the weighted join of `synthesis` or from a sample (docs/counts-in-doubt.md).
monte_carlo
    In: a train with real teeth and errors of cutting and fitting, as a `TrialPlan`. Out: how often it jams, how
    far its pointers stray, with confidence intervals, and whose errors matter (Sobol indices) (docs/cut-by-hand.md).
    Or a train whose friction is known by its spread: the torque over a turn with its confidence intervals, by
    `try_frictions` (docs/torques.md).
budget
    In: a train, with whatever it declares. Out, by `find_budget`: what each pointer's error comes from (ratio, pins'
    theory, teeth, lost motion, cutting), in degrees and in days (docs/budgets.md).
manufacturing_errors
    In: what a train declares of how its wheels are cut, and drawn wheels with each tooth where it is. Out: which pairs
    jam, clash, stand still or lose contact, and their transmission functions. The trials of `monte_carlo` ask it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.uncertainty.budget.crank_load import CrankLoad as CrankLoad
    from geartrain.uncertainty.budget.crank_load import WeightDrive as WeightDrive
    from geartrain.uncertainty.budget.pointer_budget import BudgetCause as BudgetCause
    from geartrain.uncertainty.budget.pointer_budget import PointerBudget as PointerBudget
    from geartrain.uncertainty.budget.pointer_budget import RatioDrift as RatioDrift
    from geartrain.uncertainty.budget.pointer_budget import TrainBudget as TrainBudget
    from geartrain.uncertainty.budget.train_budget import BudgetQuestion as BudgetQuestion
    from geartrain.uncertainty.budget.train_budget import find_budget as find_budget
    from geartrain.uncertainty.confidence_intervals import IntervalEstimate as IntervalEstimate
    from geartrain.uncertainty.confidence_intervals import ProbabilityEstimate as ProbabilityEstimate
    from geartrain.uncertainty.manufacturing_errors.declared_errors import read_error_overrides as read_error_overrides
    from geartrain.uncertainty.monte_carlo.clearance_study import ClearanceCase as ClearanceCase
    from geartrain.uncertainty.monte_carlo.clearance_study import jamming_map as jamming_map
    from geartrain.uncertainty.monte_carlo.friction_trials import FrictionPlan as FrictionPlan
    from geartrain.uncertainty.monte_carlo.friction_trials import FrictionSpread as FrictionSpread
    from geartrain.uncertainty.monte_carlo.friction_trials import FrictionTrials as FrictionTrials
    from geartrain.uncertainty.monte_carlo.friction_trials import TrialFigure as TrialFigure
    from geartrain.uncertainty.monte_carlo.friction_trials import find_friction_plan as find_friction_plan
    from geartrain.uncertainty.monte_carlo.friction_trials import try_frictions as try_frictions
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult as MonteCarloResult
    from geartrain.uncertainty.monte_carlo.pair_trials import PairTrials as PairTrials
    from geartrain.uncertainty.monte_carlo.pointer_error import PointerErrorCourse as PointerErrorCourse
    from geartrain.uncertainty.monte_carlo.pointer_error import PointerErrorStatistics as PointerErrorStatistics
    from geartrain.uncertainty.monte_carlo.sobol_indices import SobolIndices as SobolIndices
    from geartrain.uncertainty.monte_carlo.sobol_indices import find_sobol_indices as find_sobol_indices
    from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan as TrialPlan
    from geartrain.uncertainty.monte_carlo.trial_plan import find_trial_plan as find_trial_plan
    from geartrain.uncertainty.monte_carlo.trial_results import PairEventRates as PairEventRates
    from geartrain.uncertainty.monte_carlo.trial_results import TrialResults as TrialResults
    from geartrain.uncertainty.monte_carlo.trial_run import run_course as run_course
    from geartrain.uncertainty.monte_carlo.trial_run import run_trials as run_trials
    from geartrain.uncertainty.posterior.inference import infer_counts as infer_counts
    from geartrain.uncertainty.posterior.posterior_result import CountCombination as CountCombination
    from geartrain.uncertainty.posterior.posterior_result import CountProbability as CountProbability
    from geartrain.uncertainty.posterior.posterior_result import ToothCountPosterior as ToothCountPosterior
    from geartrain.uncertainty.posterior.posterior_result import WheelPosterior as WheelPosterior

__all__ = [
    "BudgetCause",
    "BudgetQuestion",
    "ClearanceCase",
    "CountCombination",
    "CountProbability",
    "CrankLoad",
    "FrictionPlan",
    "FrictionSpread",
    "FrictionTrials",
    "IntervalEstimate",
    "MonteCarloResult",
    "PairEventRates",
    "PairTrials",
    "PointerBudget",
    "PointerErrorCourse",
    "PointerErrorStatistics",
    "ProbabilityEstimate",
    "RatioDrift",
    "SobolIndices",
    "ToothCountPosterior",
    "TrainBudget",
    "TrialFigure",
    "TrialPlan",
    "TrialResults",
    "WeightDrive",
    "WheelPosterior",
    "find_budget",
    "find_friction_plan",
    "find_sobol_indices",
    "find_trial_plan",
    "infer_counts",
    "jamming_map",
    "read_error_overrides",
    "run_course",
    "run_trials",
    "try_frictions",
]

__getattr__ = lazy_names(
    __name__,
    {
        **dict.fromkeys(("BudgetCause", "PointerBudget", "RatioDrift", "TrainBudget"), "budget.pointer_budget"),
        **dict.fromkeys(("BudgetQuestion", "find_budget"), "budget.train_budget"),
        **dict.fromkeys(("FrictionPlan", "FrictionSpread", "find_friction_plan"), "monte_carlo.friction_trials"),
        **dict.fromkeys(("FrictionTrials", "TrialFigure", "try_frictions"), "monte_carlo.friction_trials"),
        "CrankLoad": "budget.crank_load",
        "WeightDrive": "budget.crank_load",
        "ClearanceCase": "monte_carlo.clearance_study",
        "CountCombination": "posterior.posterior_result",
        "CountProbability": "posterior.posterior_result",
        "IntervalEstimate": "confidence_intervals",
        "MonteCarloResult": "monte_carlo.monte_carlo_result",
        "PairEventRates": "monte_carlo.trial_results",
        "PairTrials": "monte_carlo.pair_trials",
        "PointerErrorCourse": "monte_carlo.pointer_error",
        "PointerErrorStatistics": "monte_carlo.pointer_error",
        "ProbabilityEstimate": "confidence_intervals",
        "SobolIndices": "monte_carlo.sobol_indices",
        "ToothCountPosterior": "posterior.posterior_result",
        "TrialPlan": "monte_carlo.trial_plan",
        "TrialResults": "monte_carlo.trial_results",
        "WheelPosterior": "posterior.posterior_result",
        "find_sobol_indices": "monte_carlo.sobol_indices",
        "find_trial_plan": "monte_carlo.trial_plan",
        "infer_counts": "posterior.inference",
        "jamming_map": "monte_carlo.clearance_study",
        "read_error_overrides": "manufacturing_errors.declared_errors",
        "run_course": "monte_carlo.trial_run",
        "run_trials": "monte_carlo.trial_run",
    },
)
