"""Feasibility of a train: probability that it turns, jams, is too stiff or breaks, for declared tolerances.

feasibility_plan      input data: cutting errors, friction, strengths of teeth and pivots, torque limit
feasibility_trials    the trials and their results
feasibility_report, verb    the report and the plot, the command
"""
