"""Transmission errors of teeth and pins, composed through a train at any position of its input.

motion_problem, motion_model              data of a train; its motion as a function of the turns of its input
pair_errors, error_propagation            errors of pairs as sources; their propagation to the links
error_composition                         errors along the order of solution
compiled_composition                      the same order as a compiled kernel
motion_run, run_statistics                a run over some turns, its spectrum by exact orders; peaks and moments
extreme_search, rate_bounds               extremes between the positions of a run, with bounds
kink_positions                            positions of kinks of transmission functions
superposition                             fast estimates
pair_impacts                              energy of tooth impacts
"""
