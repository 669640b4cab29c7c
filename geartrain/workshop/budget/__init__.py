"""The budget of the error of a pointer: its causes in degrees and in days (docs/budgets.md).

train_budget     the question and all causes together; drift of ratios, wheels cut by hand
motion_causes    pins against the true motion of Moon and Sun; teeth and backlash
crank_load       torque and efficiency at the crank, over a run, and of a weight
pointer_budget   the results
budget_report, budget_bars, verb   the report, the plot, the command
"""
