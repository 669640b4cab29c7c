"""Tooth numbers for a wanted motion, and sizes of triangular teeth.

In: a ratio, a train with wheels to be found, a kind of epicyclic set, or the periods of an orrery; limits on wheels.
Out: the tooth counts that fit, ranked, with proof that the search was complete, or why it was not.

`find_stages`   one ratio by stages of gear pairs: meet in the middle on sorted products
`search_train`  the free wheels of a declared train: an exact weighted join, which the posterior of counts uses too
`find_sets`     sets of sun, planets and ring: Willis' equation (theory (4), (5)) over all coaxial sets
`find_orrery`   many periods that share wheels: branch and bound, beam search
`find_tooth_sizes` the radii, clearance and half angle of triangular teeth: DIRECT, polished by Brent or Nelder and Mead
`find_train_sizes` the same for all pairs on the way to an output of a train, by its own loss or error
`approximants`  fractions near a number: the Stern-Brocot tree

`read_ratio` and `read_counts` read what is wanted from text. Counts are decided in integers, ratios in Fractions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.synthesis.constraints.constraint_options import ConstraintOptions as ConstraintOptions
    from geartrain.synthesis.epicyclic.epicyclic_sets import EpicyclicSet as EpicyclicSet
    from geartrain.synthesis.epicyclic.epicyclic_sets import SetFindings as SetFindings
    from geartrain.synthesis.epicyclic.set_search import find_sets as find_sets
    from geartrain.synthesis.orrery.orrery_result import Orrery as Orrery
    from geartrain.synthesis.orrery.orrery_search import find_orrery as find_orrery
    from geartrain.synthesis.ratio.stage_problem import StageConstraints as StageConstraints
    from geartrain.synthesis.ratio.stage_search import StageFindings as StageFindings
    from geartrain.synthesis.ratio.stage_search import find_stages as find_stages
    from geartrain.synthesis.search_outcome import GearStages as GearStages
    from geartrain.synthesis.search_outcome import Shortfall as Shortfall
    from geartrain.synthesis.stern_brocot import Approximant as Approximant
    from geartrain.synthesis.stern_brocot import approximants as approximants
    from geartrain.synthesis.target_ratio import TargetRatio as TargetRatio
    from geartrain.synthesis.target_ratio import read_ratio as read_ratio
    from geartrain.synthesis.tooth_count_ranges import CountRuns as CountRuns
    from geartrain.synthesis.tooth_count_ranges import read_counts as read_counts
    from geartrain.synthesis.tooth_sizes.best_sizes import BestToothSizes as BestToothSizes
    from geartrain.synthesis.tooth_sizes.best_sizes import find_tooth_sizes as find_tooth_sizes
    from geartrain.synthesis.tooth_sizes.outline_agreement import OutlineAgreement as OutlineAgreement
    from geartrain.synthesis.tooth_sizes.size_design import SizeLimit as SizeLimit
    from geartrain.synthesis.tooth_sizes.size_design import ToothSizes as ToothSizes
    from geartrain.synthesis.tooth_sizes.size_search import ChanceLimit as ChanceLimit
    from geartrain.synthesis.tooth_sizes.train_size_search import find_train_sizes as find_train_sizes
    from geartrain.synthesis.tooth_sizes.train_sizes import BestTrainSizes as BestTrainSizes
    from geartrain.synthesis.tooth_sizes.train_sizes import PairSizes as PairSizes
    from geartrain.synthesis.train.train_findings import Assignment as Assignment
    from geartrain.synthesis.train.train_findings import TrainFindings as TrainFindings
    from geartrain.synthesis.train.train_search import search_train as search_train

__all__ = [
    "Approximant",
    "Assignment",
    "BestToothSizes",
    "BestTrainSizes",
    "ChanceLimit",
    "ConstraintOptions",
    "CountRuns",
    "EpicyclicSet",
    "GearStages",
    "Orrery",
    "OutlineAgreement",
    "PairSizes",
    "SetFindings",
    "Shortfall",
    "SizeLimit",
    "StageConstraints",
    "StageFindings",
    "TargetRatio",
    "ToothSizes",
    "TrainFindings",
    "approximants",
    "find_orrery",
    "find_sets",
    "find_stages",
    "find_tooth_sizes",
    "find_train_sizes",
    "read_counts",
    "read_ratio",
    "search_train",
]

_PLACES = {
    "Approximant": "stern_brocot",
    "Assignment": "train.train_findings",
    "BestToothSizes": "tooth_sizes.best_sizes",
    "BestTrainSizes": "tooth_sizes.train_sizes",
    "ChanceLimit": "tooth_sizes.size_search",
    "ConstraintOptions": "constraints.constraint_options",
    "CountRuns": "tooth_count_ranges",
    "EpicyclicSet": "epicyclic.epicyclic_sets",
    "GearStages": "search_outcome",
    "Orrery": "orrery.orrery_result",
    "OutlineAgreement": "tooth_sizes.outline_agreement",
    "PairSizes": "tooth_sizes.train_sizes",
    "SetFindings": "epicyclic.epicyclic_sets",
    "Shortfall": "search_outcome",
    "SizeLimit": "tooth_sizes.size_design",
    "StageConstraints": "ratio.stage_problem",
    "StageFindings": "ratio.stage_search",
    "TargetRatio": "target_ratio",
    "ToothSizes": "tooth_sizes.size_design",
    "TrainFindings": "train.train_findings",
    "approximants": "stern_brocot",
    "find_orrery": "orrery.orrery_search",
    "find_sets": "epicyclic.set_search",
    "find_stages": "ratio.stage_search",
    "find_tooth_sizes": "tooth_sizes.best_sizes",
    "find_train_sizes": "tooth_sizes.train_size_search",
    "read_counts": "tooth_count_ranges",
    "read_ratio": "target_ratio",
    "search_train": "train.train_search",
}

__getattr__ = lazy_names(__name__, _PLACES)
