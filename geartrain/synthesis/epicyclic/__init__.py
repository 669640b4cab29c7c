"""Epicyclic sets for a ratio, in all their modes."""

from geartrain.synthesis.epicyclic.declaring import declaration_of, declare
from geartrain.synthesis.epicyclic.finding import find_sets
from geartrain.synthesis.epicyclic.found import EpicyclicSet, SetFindings
from geartrain.synthesis.epicyclic.kinds import kinds

__all__ = ["EpicyclicSet", "SetFindings", "declaration_of", "declare", "find_sets", "kinds"]
