"""The budget of a pointer's error: its causes in degrees and in days, one beside the other (docs/budgets.md).

train_budget     what is requested; ratios that drift, wheels cut by hand; all causes together
pin_theory       pins against the true motion of Moon and Sun
tooth_motion     teeth and backlash
crank_load       torque and efficiency at the crank, over a run, and of a weight
pointer_budget   what comes out
"""
