"""Search for epicyclic gear sets of a given ratio in all their operating modes.

epicyclic_sets      types of epicyclic sets, results of a search, and declarations of the sets found
set_search          enumeration of all sets of one type within bounds, in every operating mode
verb                command `geartrain teeth set`
"""
