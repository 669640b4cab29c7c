"""Errors of teeth composed through a train, in any position of its input.

motion_problem, motion_model              what is known of a train; its motion as a function of the turns of its input
pair_errors, error_propagation            errors of pairs as sources; how each reaches the links, alone or coupled
error_composition                         errors along the solved order
compiled_composition                      the same order as a compiled kernel
motion_run, run_statistics                one run over some turns, its spectrum by exact orders; peaks and moments
extreme_search, rate_bounds               extremes between the positions of a run, with bounds
kink_positions                          where laws have corners
superposition                             cheap estimates
pair_impacts                              what collisions of teeth cost
"""
