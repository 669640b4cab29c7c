"""Trains cut by hand, many times over: how often they jam, how far their pointers stray, and whose fault it is.

trial_plan, trial_pair           what is asked of a train, and its errors
random_streams, trial_block      wheels drawn, judged and put in motion
trial_run                        tasks of trials, their journal and their table
trial_results, pointer_error     what comes out
monte_carlo_result               all that can be asked besides, and the whole result
clearance_study, sobol_indices   other clearances; whose errors move a pointer
pair_trials                      a single pair
friction_trials                  torque over a turn with friction drawn from its spread
"""
