"""Search for tooth counts of one to five gear stages with a given ratio. It finds all solutions, or solutions that are
proved to be the best.

product_windows    sorted products of tooth counts, generated for intervals (windows) of their value
stage_problem      the search problem as plain data, feasible pairings of tooth counts, total orders of solutions
search_segments    meet in the middle on sorted products, segment by segment, and the tolerance within which the list is
                   proved
stage_search       `find_stages`, its result, and the explanation of an empty result
"""
