"""Constraints on tooth counts in addition to ratios: assembly, clearance, sums.

assembly_constraints      constraints of a declared train: assembly, limits of wheels; equal planets: phases, clearance
count_conditions          linear equations and conditions, evaluated for many candidates
constraint_options        options, and their parser for the command line
"""
