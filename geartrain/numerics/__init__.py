"""Numbers, arrays, files and independent work: nothing in this room knows what a gear is.

In: numbers and tasks. Out: exact solutions of sparse systems, roots, piecewise functions, quantities with units,
results of tasks in their order. Most of it is for the rooms above; a user meets quantities and figures in declarations,
labelled arrays and long floats in answers, and runs long questions with an executor and a journal.

exact, decimal_text, factored_ratios  integers and Fractions of any length, and their text
long_float, error_free               floats with an exponent of their own; sums and products with their rounding error
rounding_bounds                      a priori bounds on the rounding of sums and quotients
elimination                          sparse linear forms over the rationals
sparse_least_squares                 least squares with a few entries a row
integer_lattice, rational_angles     integer rows in a rational span; angles as parts of a turn
vectors                              three numbers as a vector in space, exact where they are
graphs                               paths in a rooted forest, groups of what is joined
lazy_graph                           a networkx graph whose attributes are made when they are read
block_triangular                     matching, then strongly connected components (Dulmage and Mendelsohn)
roots, simultaneous_roots            bracketed roots, one by one and many at once
chebyshev, polynomial_pieces         functions as series and as pieces of polynomials
kernels, compilation                 functions in plain Python that can be compiled; the time in which they are
quantity, units                      values with a unit, and the number as it was written
arrays, labelled_array, named_arrays arrays with names on their axes; containers that cannot change
files                                finished text and tables out, atomically
lazy_names                           names of a package that are imported when they are asked for
work                                 independent tasks, their journal, and what runs them
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.numerics.labelled_array import LabelledArray as LabelledArray
    from geartrain.numerics.long_float import LongFloat as LongFloat
    from geartrain.numerics.quantity import Figure as Figure
    from geartrain.numerics.quantity import Quantity as Quantity
    from geartrain.numerics.work.execution import Execution as Execution
    from geartrain.numerics.work.executors import open_executor as open_executor
    from geartrain.numerics.work.journal import Journal as Journal
    from geartrain.numerics.work.task_runner import run as run

__all__ = ["Execution", "Figure", "Journal", "LabelledArray", "LongFloat", "Quantity", "open_executor", "run"]

__getattr__ = lazy_names(
    __name__,
    {
        "Execution": "work.execution",
        "Figure": "quantity",
        "Journal": "work.journal",
        "LabelledArray": "labelled_array",
        "LongFloat": "long_float",
        "Quantity": "quantity",
        "open_executor": "work.executors",
        "run": "work.task_runner",
    },
)
