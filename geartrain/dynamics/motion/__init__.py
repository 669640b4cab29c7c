"""Transmission errors of teeth and pins, and the motion of a train that results from them.

motion_problem, motion_model              data of a train; motion as a function of the input position
pair_errors, error_propagation            errors of pairs as sources; their propagation to the links
error_composition                         composition of errors in the order of solution
motion_run, run_statistics                run over several revolutions; its spectrum by exact orders; peaks and moments
extreme_search                            search for extremes between the positions of a run
kink_positions                            positions of kinks of transmission functions
superposition                             fast first-order estimates
pair_impacts                              energy of tooth impacts
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_propagation import CoupledErrors as CoupledErrors
    from geartrain.dynamics.motion.error_propagation import solve_coupled_errors as solve_coupled_errors
    from geartrain.dynamics.motion.motion_problem import find_motion_problem as find_motion_problem
    from geartrain.dynamics.motion.superposition import Superposition as Superposition

__getattr__, __all__ = public_names(
    __name__,
    {
        "error_propagation": "CoupledErrors solve_coupled_errors",
        "motion_problem": "find_motion_problem",
        "superposition": "Superposition",
    },
)
