"""Tooth counts of the free wheels of a train: every assignment that meets all demands, counted."""

from geartrain.synthesis.train.train_findings import Assignment, TrainFindings
from geartrain.synthesis.train.train_search import search

__all__ = ["Assignment", "TrainFindings", "search"]
