"""Error budget of a pointer: contributions to its error in degrees and in days (docs/budgets.md).

train_budget     options of a budget, collection of all causes, drift of ratios, cutting errors
motion_causes    errors of pins (relative to the true motion of Moon and Sun), of teeth and of backlash
pointer_budget   result types
budget_report, verb   the report and the chart, the command
"""
