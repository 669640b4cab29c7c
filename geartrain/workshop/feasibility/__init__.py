"""Feasibility of a train: probability that it turns, jams, is too stiff or breaks, over declared spreads.

feasibility_plan      input data: cutting errors, friction, strengths of teeth and pivots, torque limit
feasibility_trials    the trials, and their result
feasibility_report, verb    the report and the plot, the command
"""
