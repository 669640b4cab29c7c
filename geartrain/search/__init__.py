"""Searches for tooth counts, reconstruction of gear trains, and posterior distributions of tooth counts.

The input is a ratio, a train with unknown tooth counts, a type of epicyclic gear set, the periods of an orrery,
surviving wheels, or uncertain tooth counts. The output is either a ranked list of tooth counts that satisfy the
conditions, with a flag that states whether the search was complete, or the posterior probabilities of the tooth counts.
Tooth counts are compared as integers and ratios as `Fraction`s, so rounding errors cannot change a result.

ratio          tooth counts of gear stages for one ratio: meet in the middle on sorted products (`find_stages`)
train          tooth counts of varied wheels of a declared train: an exact weighted join (`search_train`)
epicyclic      sets of sun, planets and ring: the Willis equation for all coaxial sets (`find_sets`)
orrery         trains for many periods with shared wheels: branch and bound, beam search (`find_orrery`)
reconstruct    all trains that explain surviving wheels and pointers (`reconstruct.reconstruct`)
posterior      posterior of uncertain tooth counts by Bayes' theorem, exact or sampled (`infer_counts`)
join           the exact join used by `train` and `posterior`: bucket elimination on lists of products
constraints    further conditions on tooth counts: assembly, planets, limits of wheels

target_ratio, tooth_count_ranges   parsers for ratios and for ranges of tooth counts (`read_ratio`, `read_counts`)
search_outcome          results common to all searches: tooth counts of stages, numbers of rejected candidates
stern_brocot            fractions near a number: the Stern-Brocot tree (`approximants`)
information             entropy and relative entropy in bits
integer_columns         ranges of integers as arrays, distinct quotients, and sums by owner
teeth_verb, approximants_verb      the command `teeth`, and the options that its searches share
tooth_numbers_report    tooth counts as documents and tables
answers                 result types that commands print as JSON
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.search.constraints.constraint_options import ConstraintOptions as ConstraintOptions
    from geartrain.search.epicyclic.epicyclic_sets import EpicyclicSet as EpicyclicSet
    from geartrain.search.epicyclic.set_search import find_sets as find_sets
    from geartrain.search.orrery.orrery_search import Orrery as Orrery
    from geartrain.search.orrery.orrery_search import find_orrery as find_orrery
    from geartrain.search.posterior.corner_plot import counts_figure as counts_figure
    from geartrain.search.posterior.inference import infer_counts as infer_counts
    from geartrain.search.posterior.inference import joint_posterior as joint_posterior
    from geartrain.search.posterior.inference import most_informative_wheels as most_informative_wheels
    from geartrain.search.posterior.posterior_result import ToothCountPosterior as ToothCountPosterior
    from geartrain.search.ratio.stage_problem import StageConstraints as StageConstraints
    from geartrain.search.ratio.stage_search import StageFindings as StageFindings
    from geartrain.search.ratio.stage_search import find_stages as find_stages
    from geartrain.search.stern_brocot import approximants as approximants
    from geartrain.search.target_ratio import TargetRatio as TargetRatio
    from geartrain.search.target_ratio import read_ratio as read_ratio
    from geartrain.search.tooth_count_ranges import CountRuns as CountRuns
    from geartrain.search.tooth_count_ranges import read_counts as read_counts
    from geartrain.search.train.train_findings import TrainFindings as TrainFindings
    from geartrain.search.train.train_search import search_train as search_train

__getattr__, __all__ = public_names(
    __name__,
    {
        "constraints.constraint_options": "ConstraintOptions",
        "epicyclic.epicyclic_sets": "EpicyclicSet",
        "epicyclic.set_search": "find_sets",
        "orrery.orrery_search": "Orrery find_orrery",
        "posterior.corner_plot": "counts_figure",
        "posterior.inference": "infer_counts joint_posterior most_informative_wheels",
        "posterior.posterior_result": "ToothCountPosterior",
        "ratio.stage_problem": "StageConstraints",
        "ratio.stage_search": "StageFindings find_stages",
        "stern_brocot": "approximants",
        "target_ratio": "TargetRatio read_ratio",
        "tooth_count_ranges": "CountRuns read_counts",
        "train.train_findings": "TrainFindings",
        "train.train_search": "search_train",
    },
)
