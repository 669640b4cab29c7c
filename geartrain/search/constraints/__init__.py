"""Constraints on tooth counts in addition to ratios: assembly, clearance, interference, sums.

assembly_constraints      constraints of a declared train: assembly, interference
planet_constraints        equal planets: phase conditions, and clearance between neighbours
count_conditions          linear equations and conditions, evaluated for many candidates
constraint_options        options, and their parser for the command line
"""
