"""Tooth counts of the free wheels of a train: every assignment that meets all demands, counted."""

from geartrain.synthesis.trains.findings import Assignment, TrainFindings
from geartrain.synthesis.trains.searching import search

__all__ = ["Assignment", "TrainFindings", "search"]
