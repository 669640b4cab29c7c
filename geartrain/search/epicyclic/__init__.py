"""Epicyclic sets for a ratio, in all their modes."""
