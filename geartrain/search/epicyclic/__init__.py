"""Search for epicyclic gear sets of a given ratio in all their operating modes.

epicyclic_sets      types of sets, results of a search, and their declarations
set_search          enumeration of all sets of a type within bounds, in every mode
verb                command `geartrain teeth set`
"""
