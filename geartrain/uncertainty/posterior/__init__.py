"""Tooth counts in doubt: which combinations fit what the outputs show, and how likely each count is then."""

from geartrain.uncertainty.posterior.inference import LIMIT, METHODS, SAMPLES, infer_counts
from geartrain.uncertainty.posterior.posterior_result import (
    CountCombination,
    CountProbability,
    ToothCountPosterior,
    VarianceShares,
    WheelPosterior,
)
from geartrain.uncertainty.posterior.priors import ToothCountPrior, find_priors

__all__ = [
    "LIMIT",
    "METHODS",
    "SAMPLES",
    "CountCombination",
    "CountProbability",
    "ToothCountPosterior",
    "ToothCountPrior",
    "VarianceShares",
    "WheelPosterior",
    "find_priors",
    "infer_counts",
]
