"""Trials of trains cut by hand: how often they jam, how far pointers are off, and which errors matter.

trial_plan            a train as its trials see it: pairs, wheels with errors, composition of errors
random_streams        independent random streams by trial, wheel and kind of error
trial_block           wheels of a block of trials, drawn, judged and put in motion
trial_run             tasks of trials, their journal and their table
trial_results         results of trials by pair and by pointer, and errors of a pointer along a turn
clearance_study       the same trials at other clearances
sobol_indices         Sobol indices: whose errors move a pointer
monte_carlo_result    all of these as one result
monte_carlo_report, monte_carlo_plots, verb   the report, the plots, the command
friction_trials       torque over a turn with friction drawn from its spread
"""
