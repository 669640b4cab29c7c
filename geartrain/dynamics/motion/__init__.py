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
