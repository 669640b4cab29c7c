"""Tooth counts in doubt: which combinations fit what the outputs show, and how likely each count is then."""

from geartrain.uncertainty.counts.doubts import Doubt, find_doubts
from geartrain.uncertainty.counts.result import Chance, Combination, CountSweep, Posterior, Shares
from geartrain.uncertainty.counts.sweeping import LIMIT, METHODS, SAMPLES, sweep

__all__ = [
    "LIMIT",
    "METHODS",
    "SAMPLES",
    "Chance",
    "Combination",
    "CountSweep",
    "Doubt",
    "Posterior",
    "Shares",
    "find_doubts",
    "sweep",
]
