"""Search for one ratio by one to five stages of gear pairs: all solutions, or the solutions that are proved to be best.

product_windows    sorted products of tooth counts, generated in windows of value
stage_problem      the search problem as plain data, feasible pairings of a multiset, total orders of solutions
search_segments    meet in the middle on sorted products, segment by segment, and the tolerance that proves the list
stage_search       `find_stages`, its result, and the explanation of an empty result
"""
