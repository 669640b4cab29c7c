"""Workshop: files to cut, wheels with cutting errors, Monte Carlo trials, tooth sizes and error budgets.

export        outlines, plates, solids, graphs and tables of a train as files; proof that the cut parts turn
rexs          gear units in the exchange format REXS, written and read
cutting       wheels with cutting errors: jams, clashes, loss of contact, and their transmission functions
monte_carlo   Monte Carlo trials of cutting errors and of friction: probabilities with intervals, Sobol indices
feasibility   probability that a train turns, jams, is too stiff or breaks, over declared tolerances
budget        error budget of each pointer: causes ratio, pins, teeth, lost motion and cutting (`find_budget`)
sizes         radii, clearance factor and half angle of triangular teeth, optimised for one objective
answers       result types that commands print as JSON
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.workshop.budget.pointer_budget import PointerBudget as PointerBudget
    from geartrain.workshop.budget.pointer_budget import TrainBudget as TrainBudget
    from geartrain.workshop.budget.train_budget import BudgetQuestion as BudgetQuestion
    from geartrain.workshop.budget.train_budget import find_budget as find_budget
    from geartrain.workshop.cutting.declared_errors import read_error_overrides as read_error_overrides
    from geartrain.workshop.cutting.wheel_estimate import WheelEstimate as WheelEstimate
    from geartrain.workshop.cutting.wheel_estimate import estimate_wheel as estimate_wheel
    from geartrain.workshop.export.file_set import export_files as export_files
    from geartrain.workshop.export.file_set import notices as notices
    from geartrain.workshop.export.file_set import train_file as train_file
    from geartrain.workshop.export.file_set import wheel_file as wheel_file
    from geartrain.workshop.feasibility.feasibility_plan import find_feasibility_plan as find_feasibility_plan
    from geartrain.workshop.feasibility.feasibility_trials import FeasibilityResult as FeasibilityResult
    from geartrain.workshop.feasibility.feasibility_trials import run_feasibility as run_feasibility
    from geartrain.workshop.monte_carlo.clearance_study import jamming_map as jamming_map
    from geartrain.workshop.monte_carlo.friction_trials import FrictionPlan as FrictionPlan
    from geartrain.workshop.monte_carlo.friction_trials import try_frictions as try_frictions
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult as MonteCarloResult
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices as SobolIndices
    from geartrain.workshop.monte_carlo.sobol_indices import find_sobol_indices as find_sobol_indices
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan as TrialPlan
    from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan as find_trial_plan
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse as PointerErrorCourse
    from geartrain.workshop.monte_carlo.trial_results import TrialResults as TrialResults
    from geartrain.workshop.monte_carlo.trial_run import run_course as run_course
    from geartrain.workshop.monte_carlo.trial_run import run_trials as run_trials
    from geartrain.workshop.sizes.best_sizes import find_tooth_sizes as find_tooth_sizes
    from geartrain.workshop.sizes.size_design import SizeLimit as SizeLimit
    from geartrain.workshop.sizes.size_design import ToothSizes as ToothSizes
    from geartrain.workshop.sizes.size_search import PairTrials as PairTrials
    from geartrain.workshop.sizes.size_search import ProbabilityLimit as ProbabilityLimit
    from geartrain.workshop.sizes.train_size_search import BestTrainSizes as BestTrainSizes
    from geartrain.workshop.sizes.train_size_search import find_train_sizes as find_train_sizes

__getattr__, __all__ = public_names(
    __name__,
    {
        "budget.pointer_budget": "PointerBudget TrainBudget",
        "budget.train_budget": "BudgetQuestion find_budget",
        "cutting.declared_errors": "read_error_overrides",
        "cutting.wheel_estimate": "WheelEstimate estimate_wheel",
        "export.file_set": "export_files notices train_file wheel_file",
        "feasibility.feasibility_plan": "find_feasibility_plan",
        "feasibility.feasibility_trials": "FeasibilityResult run_feasibility",
        "monte_carlo.clearance_study": "jamming_map",
        "monte_carlo.friction_trials": "FrictionPlan try_frictions",
        "monte_carlo.monte_carlo_result": "MonteCarloResult",
        "monte_carlo.sobol_indices": "SobolIndices find_sobol_indices",
        "monte_carlo.trial_plan": "TrialPlan find_trial_plan",
        "monte_carlo.trial_results": "PointerErrorCourse TrialResults",
        "monte_carlo.trial_run": "run_course run_trials",
        "sizes.best_sizes": "find_tooth_sizes",
        "sizes.size_design": "SizeLimit ToothSizes",
        "sizes.size_search": "PairTrials ProbabilityLimit",
        "sizes.train_size_search": "BestTrainSizes find_train_sizes",
    },
)
