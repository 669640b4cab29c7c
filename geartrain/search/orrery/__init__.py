"""Search for a gear train that shows several periods from one arbor with few wheels.

orrery_search      problem, beam search and results
arbor_trees        trees of arbors: minimum number of wheels, and enumeration up to a size
verb               command `geartrain teeth orrery`
"""
