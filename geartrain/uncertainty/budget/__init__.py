"""The budget of a pointer's error: its causes in degrees and in days, one beside the other (docs/budgets.md)."""
