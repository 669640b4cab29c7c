"""Search for one ratio by one to five stages of gear pairs; complete, or limited to the best solutions with proof.

gear_pair_search   one pair in ranges of any length: a scan, or the Stern-Brocot tree
product_windows    sorted products of tooth counts, generated in windows of value
stage_problem      the search problem as plain data, feasible pairings of a multiset, total orders of solutions
search_segments    one segment of the search: meet in the middle on sorted products
segment_sweep      all segments, and the tolerance that proves the list of the best
stage_search       `find_stages`, its result, and the explanation of an empty result
"""
