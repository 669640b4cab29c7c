"""What a fitter asks of tooth counts besides ratios, as equations and conditions."""

from geartrain.synthesis.constraints.assembly_constraints import find_constraints
from geartrain.synthesis.constraints.constraint_options import ConstraintOptions, read_constraint_options
from geartrain.synthesis.constraints.count_conditions import CountConstraint

__all__ = ["ConstraintOptions", "CountConstraint", "find_constraints", "read_constraint_options"]
