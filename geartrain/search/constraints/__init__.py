"""Constraints on tooth counts in addition to ratios: assembly, clearance, interference, sums."""
