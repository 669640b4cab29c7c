"""Outputs as exact rational functions of the tooth counts that are free."""

from geartrain.synthesis.formulas.finding import Formulas, find_formulas, with_counts
from geartrain.synthesis.formulas.functions import Formula

__all__ = ["Formula", "Formulas", "find_formulas", "with_counts"]
