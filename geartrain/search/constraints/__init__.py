"""Constraints on tooth counts in addition to ratios: assembly, clearance, sums of tooth counts.

assembly_constraints      constraints of a declared train: assembly, limits of wheels, phases and clearance of equal
                          planets
count_conditions          linear equations and conditions, evaluated for many candidates
constraint_options        options of the constraints, and their parser for the command line
"""

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.search.constraints.count_conditions import CountEquation as CountEquation

__getattr__, __all__ = public_names(__name__, {"count_conditions": "CountEquation"})
