"""Monte Carlo trials of trains with cutting errors: probability of jamming, pointer errors and their causes.

trial_plan            input data of the trials: pairs, wheels with errors, composition of errors
trial_block           one block of trials: wheels are drawn, pairs are evaluated, pointer errors are computed
trial_run             tasks of trials, their journal and their table
trial_results         event probabilities of each pair, error statistics of each pointer, errors over a turn
clearance_study       the trials repeated with other clearance factors
sobol_indices         Sobol indices of a pointer error by wheel or by kind of error
monte_carlo_result    combined result of all these studies
monte_carlo_report, monte_carlo_plots, verb   the report, the plots, the command
friction_trials       torque over a run with friction coefficients drawn from their distributions
"""
