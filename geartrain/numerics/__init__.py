"""Mathematics, quantities, results, files and parallel tasks, independent of gears.

Most modules are used by the rest of the package. Users encounter quantities and figures in declarations and labelled
arrays in results, and run long computations with an executor and a journal.

Exact numbers
    exact, factored_ratios                integers and Fractions of any length, and their text
    elimination                           sparse linear systems over the rationals
    integer_lattice                       integer rows in a rational span
Floats
    rounding_bounds, bounded_polynomials  error-free transformations; quotients of polynomials with error bounds
    roots                                 bracketed roots, one by one and vectorised
    chebyshev, polynomial_pieces          Chebyshev series and piecewise polynomials
    periodic_function                     periodic functions given by points or harmonics, and their extremes
    confidence_intervals                  confidence intervals of means and probabilities
    vectors, polylines                    vectors in space, exact for exact numbers; polylines
    kernels                               functions in plain Python that numba can compile
Graphs
    graphs, lazy_graph                    paths in a rooted forest, union-find; networkx graph with lazy attributes
    block_triangular                      matching and strongly connected components (Dulmage and Mendelsohn)
Values with names and units, and their representation
    quantity                              values with a unit, their limits, and numbers as written
    arrays, labelled_array                array types, named tuples of arrays; arrays with labelled axes
    results                               results as JSON, tables and pictures
    containers                            immutable mappings
Files, work, modules
    files                                 atomic output of finished texts and tables
    work                                  independent tasks, their journal, and their executors
    lazy_names                            names of a package that are imported on first access
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.numerics.confidence_intervals import IntervalEstimate as IntervalEstimate
    from geartrain.numerics.confidence_intervals import ProbabilityEstimate as ProbabilityEstimate
    from geartrain.numerics.exact import decimal as decimal
    from geartrain.numerics.labelled_array import LabelledArray as LabelledArray
    from geartrain.numerics.quantity import Figure as Figure
    from geartrain.numerics.quantity import Quantity as Quantity
    from geartrain.numerics.work.journal import Journal as Journal
    from geartrain.numerics.work.task_runner import Execution as Execution
    from geartrain.numerics.work.task_runner import open_executor as open_executor
    from geartrain.numerics.work.task_runner import run as run

__getattr__, __all__ = public_names(
    __name__,
    {
        "confidence_intervals": "IntervalEstimate ProbabilityEstimate",
        "exact": "decimal",
        "labelled_array": "LabelledArray",
        "quantity": "Figure Quantity",
        "work.journal": "Journal",
        "work.task_runner": "Execution open_executor run",
    },
)
