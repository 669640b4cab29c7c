"""One ratio by one to five stages of gear pairs: complete, or the best, proved.

gear_pair_search   one pair in ranges of any length: a scan, or the Stern-Brocot tree
product_windows    sorted products of tooth counts, window by window
stage_problem      the question in plain data, pairings that a set allows, and total orders of solutions
search_segments    one piece of the search: meet in the middle on sorted products
segment_sweep      all pieces, and the tolerance that proves the best
stage_search       `find_stages`, its result, and why there are no stages
"""
