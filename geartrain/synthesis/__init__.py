"""Tooth numbers for a wanted motion: of one ratio, of the free wheels of a train, of epicyclic sets, of an orrery."""
