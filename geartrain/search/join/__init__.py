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

from geartrain.search.join.inside_outside import AssignmentSums, BestFirst, record_join
from geartrain.search.join.join_plan import find_join_problem
from geartrain.search.join.wheel_monomials import IntervalConstraint

__all__ = ["AssignmentSums", "BestFirst", "IntervalConstraint", "find_join_problem", "record_join"]
