"""Sizes of triangular teeth that minimise loss, error, impact or the chance of a jam.

size_design         a design: radii, window, half angles, and its figures
size_search         the search: DIRECT, then Brent's method or Nelder-Mead; fronts of two aims; limits on a chance
best_sizes          the best sizes of a pair (`find_tooth_sizes`), confirmed by the contact of its drawn outlines
train_size_search   the best sizes of a train (`find_train_sizes`): coordinate descent from the best of each pair
tooth_sizes_report, tooth_sizes_plot, verb   the report, the plot, the commands
"""
