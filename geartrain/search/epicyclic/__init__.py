"""Search for epicyclic gear sets of a given ratio in all their operating modes."""
