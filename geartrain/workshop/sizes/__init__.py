"""Optimisation of triangular tooth sizes for minimum loss, error or impact, or for the maximum margin before a jam.

size_design         a design (tip radii, relative clearance or window, half angles) and its objectives
size_search         search: DIRECT, then Brent's method or Nelder-Mead; Pareto fronts; limits on a probability
best_sizes          best sizes of a pair (`find_tooth_sizes`), verified by the contact of its drawn outlines
train_size_search   best sizes of a train (`find_train_sizes`): coordinate descent from the best sizes of each pair
tooth_sizes_report, tooth_sizes_plot, verb   report, plot and commands
"""
