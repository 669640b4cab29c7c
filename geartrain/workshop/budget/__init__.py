"""Error budget of a pointer: its causes in degrees and in days (docs/budgets.md).

train_budget     options of a budget and all causes together; drift of ratios, cutting errors
motion_causes    pins against the true motion of Moon and Sun; teeth and backlash
crank_load       torque and efficiency at the crank, over a run, and with a weight
pointer_budget   the results
budget_report, budget_bars, verb   the report, the plot, the command
"""
