"""Exact join: assignments of tooth counts to wheels that satisfy polynomial constraints, and the number of these
assignments.

Lists of products are joined on their common wheels, in ascending order of the expected size of the result. All numbers
are integers and Fractions.

product_lists           distinct products of tooth counts with the number of assignments of each, and arrays of partial
                        assignments
wheel_monomials         constraints on functions of tooth counts, and the monomials by which functions depend on wheels
polynomial_constraints  constraints as signs of polynomials, and windows of the last free variable
join_plan               order in which variables are assigned, by expected cost
exact_join              the join: bucket elimination (Dechter 1999)
inside_outside          sums over all assignments of a recorded join, and the best assignments (A* search)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.search.join.inside_outside import AssignmentSums as AssignmentSums
    from geartrain.search.join.inside_outside import BestFirst as BestFirst
    from geartrain.search.join.inside_outside import record_join as record_join
    from geartrain.search.join.join_plan import find_join_problem as find_join_problem
    from geartrain.search.join.wheel_monomials import IntervalConstraint as IntervalConstraint

__getattr__, __all__ = public_names(
    __name__,
    {
        "inside_outside": "AssignmentSums BestFirst record_join",
        "join_plan": "find_join_problem",
        "wheel_monomials": "IntervalConstraint",
    },
)
