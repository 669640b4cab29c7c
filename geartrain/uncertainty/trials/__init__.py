"""Trains cut by hand, many times over: how often they jam, how far their pointers stray, and whose fault it is."""

from geartrain.uncertainty.trials.clearing import Cleared, jam_map, read_clearances, run_clearances
from geartrain.uncertainty.trials.declared import KINDS, Setting, read_settings
from geartrain.uncertainty.trials.findings import Findings
from geartrain.uncertainty.trials.indices import Index, Indices, find_indices
from geartrain.uncertainty.trials.intervals import Figure, Share
from geartrain.uncertainty.trials.plan import Plan, find_plan
from geartrain.uncertainty.trials.result import Course, PairTally, Pointer, Trials
from geartrain.uncertainty.trials.running import Means, Rows, check_trials, question, run_course, run_trials
from geartrain.uncertainty.trials.tolerance import Tolerance, find_tolerance

__all__ = [
    "KINDS",
    "Cleared",
    "Course",
    "Figure",
    "Findings",
    "Index",
    "Indices",
    "Means",
    "PairTally",
    "Plan",
    "Pointer",
    "Rows",
    "Setting",
    "Share",
    "Tolerance",
    "Trials",
    "check_trials",
    "find_indices",
    "find_plan",
    "find_tolerance",
    "jam_map",
    "question",
    "read_clearances",
    "read_settings",
    "run_clearances",
    "run_course",
    "run_trials",
]
