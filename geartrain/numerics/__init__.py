"""Numbers, arrays, files and independent work, without any knowledge of gears.

In: numbers and tasks. Out: exact solutions of sparse systems, roots, piecewise functions, quantities with units,
results of tasks in their order. Most of it is for the rooms above; a user meets quantities and figures in declarations,
labelled arrays and long floats in answers, and runs long questions with an executor and a journal.

Exact numbers
    exact, factored_ratios                integers and Fractions of any length, and their text
    elimination                           sparse linear forms over the rationals
    integer_lattice                       integer rows in a rational span
    rational_angles                       angles as parts of a turn
Floats
    long_float                            floats with an exponent of their own
    rounding_bounds, bounded_polynomials  error-free transformations and a priori bounds; polynomials with such bounds
    sparse_least_squares                  least squares with a few entries a row
    roots                                 bracketed roots, one by one and many at once
    chebyshev, polynomial_pieces          functions as series and as pieces of polynomials
    confidence_intervals                  confidence intervals of means and probabilities
    vectors, polylines                    vectors in space, exact where they are; lines of points
    kernels                               functions in plain Python that numba can compile
Graphs
    graphs, lazy_graph                    paths in a rooted forest, groups of what is joined; a graph of networkx
    block_triangular                      matching, then strongly connected components (Dulmage and Mendelsohn)
Values with names and units, and their forms
    quantity                              values with a unit, their limits, and the number as it was written
    arrays, labelled_array                types of arrays, named tuples of arrays; arrays with names on their axes
    results                               results as JSON, as tables, as pictures
    containers                            mappings that cannot change
    markdown_text                         text that Markdown takes literally
Files, work, modules
    files                                 finished text and tables out, atomically
    work                                  independent tasks, their journal, and what runs them
    lazy_names                            names of a package that are imported when they are asked for
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.numerics.confidence_intervals import IntervalEstimate as IntervalEstimate
    from geartrain.numerics.confidence_intervals import ProbabilityEstimate as ProbabilityEstimate
    from geartrain.numerics.exact import decimal as decimal
    from geartrain.numerics.labelled_array import LabelledArray as LabelledArray
    from geartrain.numerics.long_float import LongFloat as LongFloat
    from geartrain.numerics.quantity import Figure as Figure
    from geartrain.numerics.quantity import Quantity as Quantity
    from geartrain.numerics.work.executors import open_executor as open_executor
    from geartrain.numerics.work.journal import Journal as Journal
    from geartrain.numerics.work.task_runner import Execution as Execution
    from geartrain.numerics.work.task_runner import run as run

__all__ = [
    "Execution",
    "Figure",
    "IntervalEstimate",
    "Journal",
    "LabelledArray",
    "LongFloat",
    "ProbabilityEstimate",
    "Quantity",
    "decimal",
    "open_executor",
    "run",
]

__getattr__ = lazy_names(
    __name__,
    {
        "Execution": "work.task_runner",
        "Figure": "quantity",
        **dict.fromkeys(("IntervalEstimate", "ProbabilityEstimate"), "confidence_intervals"),
        "Journal": "work.journal",
        "LabelledArray": "labelled_array",
        "LongFloat": "long_float",
        "Quantity": "quantity",
        "decimal": "exact",
        "open_executor": "work.executors",
        "run": "work.task_runner",
    },
)
