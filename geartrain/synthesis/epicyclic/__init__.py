"""Epicyclic sets for a ratio, in all their modes."""

from geartrain.synthesis.epicyclic.epicyclic_sets import EpicyclicSet, SetFindings, declaration_of, declare
from geartrain.synthesis.epicyclic.set_kinds import kinds
from geartrain.synthesis.epicyclic.set_search import find_sets

__all__ = ["EpicyclicSet", "SetFindings", "declaration_of", "declare", "find_sets", "kinds"]
