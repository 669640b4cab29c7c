"""Search for a gear train with few wheels that drives pointers of several periods from one arbor.

orrery_search      problem, beam search and results
arbor_trees        trees of arbors: minimum number of wheels, and enumeration up to a given size
verb               command `geartrain teeth orrery`
"""
