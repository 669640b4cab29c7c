"""Outputs as exact rational functions of variable tooth counts."""

from geartrain.kinematics.formulas.output_formulas import Formulas, find_formulas, with_counts
from geartrain.kinematics.formulas.rational_functions import Formula

__all__ = ["Formula", "Formulas", "find_formulas", "with_counts"]
