"""Workshop: files to cut, wheels with cutting errors, Monte Carlo trials, tooth sizes and error budgets.

export        outlines, plates, solids, graphs and tables of a train as files; proof that the cut parts turn
rexs          gear units in the exchange format REXS, written and read
cutting       wheels with cutting errors: jams, clashes, loss of contact, and their transmission functions
monte_carlo   Monte Carlo trials of cutting errors and of friction: probabilities with intervals, Sobol indices
budget        error budget of each pointer: ratio, pins, teeth, lost motion, cutting (`find_budget`)
sizes         radii, clearance factor and half angle of triangular teeth, optimised for one objective
answers       result types that commands print as JSON
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.workshop.budget.budget_bars import budget_figure as budget_figure
    from geartrain.workshop.budget.budget_report import describe_budget as describe_budget
    from geartrain.workshop.budget.crank_load import CrankLoad as CrankLoad
    from geartrain.workshop.budget.crank_load import WeightDrive as WeightDrive
    from geartrain.workshop.budget.pointer_budget import BudgetCause as BudgetCause
    from geartrain.workshop.budget.pointer_budget import PointerBudget as PointerBudget
    from geartrain.workshop.budget.pointer_budget import RatioDrift as RatioDrift
    from geartrain.workshop.budget.pointer_budget import TrainBudget as TrainBudget
    from geartrain.workshop.budget.train_budget import BudgetQuestion as BudgetQuestion
    from geartrain.workshop.budget.train_budget import find_budget as find_budget
    from geartrain.workshop.cutting.declared_errors import read_error_overrides as read_error_overrides
    from geartrain.workshop.export.assembly_guide import AssemblyStep as AssemblyStep
    from geartrain.workshop.export.assembly_guide import assembly_steps as assembly_steps
    from geartrain.workshop.export.file_set import ExportFile as ExportFile
    from geartrain.workshop.export.file_set import export_files as export_files
    from geartrain.workshop.export.file_set import notices as notices
    from geartrain.workshop.export.file_set import train_file as train_file
    from geartrain.workshop.export.file_set import wheel_file as wheel_file
    from geartrain.workshop.export.parts_list import ListedPart as ListedPart
    from geartrain.workshop.export.parts_list import parts_list as parts_list
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase as ClearanceCase
    from geartrain.workshop.monte_carlo.clearance_study import jamming_map as jamming_map
    from geartrain.workshop.monte_carlo.friction_trials import FrictionPlan as FrictionPlan
    from geartrain.workshop.monte_carlo.friction_trials import FrictionSpread as FrictionSpread
    from geartrain.workshop.monte_carlo.friction_trials import FrictionTrials as FrictionTrials
    from geartrain.workshop.monte_carlo.friction_trials import TrialFigure as TrialFigure
    from geartrain.workshop.monte_carlo.friction_trials import find_friction_plan as find_friction_plan
    from geartrain.workshop.monte_carlo.friction_trials import try_frictions as try_frictions
    from geartrain.workshop.monte_carlo.monte_carlo_plots import monte_carlo_figure as monte_carlo_figure
    from geartrain.workshop.monte_carlo.monte_carlo_report import describe_monte_carlo as describe_monte_carlo
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult as MonteCarloResult
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices as SobolIndices
    from geartrain.workshop.monte_carlo.sobol_indices import find_sobol_indices as find_sobol_indices
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan as TrialPlan
    from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan as find_trial_plan
    from geartrain.workshop.monte_carlo.trial_results import PairEventRates as PairEventRates
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse as PointerErrorCourse
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorStatistics as PointerErrorStatistics
    from geartrain.workshop.monte_carlo.trial_results import TrialResults as TrialResults
    from geartrain.workshop.monte_carlo.trial_run import run_course as run_course
    from geartrain.workshop.monte_carlo.trial_run import run_trials as run_trials
    from geartrain.workshop.sizes.best_sizes import BestToothSizes as BestToothSizes
    from geartrain.workshop.sizes.best_sizes import OutlineAgreement as OutlineAgreement
    from geartrain.workshop.sizes.best_sizes import find_tooth_sizes as find_tooth_sizes
    from geartrain.workshop.sizes.size_design import SizeLimit as SizeLimit
    from geartrain.workshop.sizes.size_design import ToothSizes as ToothSizes
    from geartrain.workshop.sizes.size_search import PairTrials as PairTrials
    from geartrain.workshop.sizes.size_search import ProbabilityLimit as ProbabilityLimit
    from geartrain.workshop.sizes.tooth_sizes_plot import tooth_sizes_figure as tooth_sizes_figure
    from geartrain.workshop.sizes.tooth_sizes_plot import train_sizes_figure as train_sizes_figure
    from geartrain.workshop.sizes.train_size_search import BestTrainSizes as BestTrainSizes
    from geartrain.workshop.sizes.train_size_search import PairSizes as PairSizes
    from geartrain.workshop.sizes.train_size_search import find_train_sizes as find_train_sizes

__all__ = [
    "AssemblyStep",
    "BestToothSizes",
    "BestTrainSizes",
    "BudgetCause",
    "BudgetQuestion",
    "ClearanceCase",
    "CrankLoad",
    "ExportFile",
    "FrictionPlan",
    "FrictionSpread",
    "FrictionTrials",
    "ListedPart",
    "MonteCarloResult",
    "OutlineAgreement",
    "PairEventRates",
    "PairSizes",
    "PairTrials",
    "PointerBudget",
    "PointerErrorCourse",
    "PointerErrorStatistics",
    "ProbabilityLimit",
    "RatioDrift",
    "SizeLimit",
    "SobolIndices",
    "ToothSizes",
    "TrainBudget",
    "TrialFigure",
    "TrialPlan",
    "TrialResults",
    "WeightDrive",
    "assembly_steps",
    "budget_figure",
    "describe_budget",
    "describe_monte_carlo",
    "export_files",
    "find_budget",
    "find_friction_plan",
    "find_sobol_indices",
    "find_tooth_sizes",
    "find_train_sizes",
    "find_trial_plan",
    "jamming_map",
    "monte_carlo_figure",
    "notices",
    "parts_list",
    "read_error_overrides",
    "run_course",
    "run_trials",
    "tooth_sizes_figure",
    "train_file",
    "train_sizes_figure",
    "try_frictions",
    "wheel_file",
]

_PLACES = {
    "budget_figure": "budget.budget_bars",
    "describe_budget": "budget.budget_report",
    **dict.fromkeys(("CrankLoad", "WeightDrive"), "budget.crank_load"),
    **dict.fromkeys(("BudgetCause", "PointerBudget", "RatioDrift", "TrainBudget"), "budget.pointer_budget"),
    **dict.fromkeys(("BudgetQuestion", "find_budget"), "budget.train_budget"),
    "read_error_overrides": "cutting.declared_errors",
    **dict.fromkeys(("AssemblyStep", "assembly_steps"), "export.assembly_guide"),
    **dict.fromkeys(("ExportFile", "export_files", "notices", "train_file", "wheel_file"), "export.file_set"),
    **dict.fromkeys(("ListedPart", "parts_list"), "export.parts_list"),
    **dict.fromkeys(("ClearanceCase", "jamming_map"), "monte_carlo.clearance_study"),
    **dict.fromkeys(
        ("FrictionPlan", "FrictionSpread", "FrictionTrials", "TrialFigure", "find_friction_plan", "try_frictions"),
        "monte_carlo.friction_trials",
    ),
    "monte_carlo_figure": "monte_carlo.monte_carlo_plots",
    "describe_monte_carlo": "monte_carlo.monte_carlo_report",
    "MonteCarloResult": "monte_carlo.monte_carlo_result",
    **dict.fromkeys(("SobolIndices", "find_sobol_indices"), "monte_carlo.sobol_indices"),
    **dict.fromkeys(("TrialPlan", "find_trial_plan"), "monte_carlo.trial_plan"),
    **dict.fromkeys(
        ("PairEventRates", "PointerErrorCourse", "PointerErrorStatistics", "TrialResults"), "monte_carlo.trial_results"
    ),
    **dict.fromkeys(("run_course", "run_trials"), "monte_carlo.trial_run"),
    **dict.fromkeys(("BestToothSizes", "OutlineAgreement", "find_tooth_sizes"), "sizes.best_sizes"),
    **dict.fromkeys(("SizeLimit", "ToothSizes"), "sizes.size_design"),
    **dict.fromkeys(("ProbabilityLimit", "PairTrials"), "sizes.size_search"),
    **dict.fromkeys(("tooth_sizes_figure", "train_sizes_figure"), "sizes.tooth_sizes_plot"),
    **dict.fromkeys(("BestTrainSizes", "PairSizes", "find_train_sizes"), "sizes.train_size_search"),
}

__getattr__ = lazy_names(__name__, _PLACES)
