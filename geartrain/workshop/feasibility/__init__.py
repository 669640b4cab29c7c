"""Feasibility of a train: probability that it turns, jams, is too stiff or breaks, over declared spreads.

feasibility_plan      input data: cutting errors, friction, strengths of teeth and pivots, the hand at the crank
feasibility_trials    the trials, and their outcomes
feasibility_result    probabilities with intervals, crank torque, probability of turning by accuracy
feasibility_report, feasibility_plot, verb    the report, the plot, the command
"""
