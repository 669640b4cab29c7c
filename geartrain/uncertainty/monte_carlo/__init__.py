"""Trains cut by hand, many times over: how often they jam, how far their pointers stray, and whose fault it is.

trial_plan                  what is asked of a train, and its errors
random_streams, trial_block, trial_run   wheels drawn, judged and put in motion, by blocks that anyone may work out
trial_results, pointer_error, monte_carlo_result   what comes out
clearance_study, sobol_indices   other clearances; whose errors
trial_studies, trial_table   all that may be asked beside trials; every trial as a row of a file
"""
