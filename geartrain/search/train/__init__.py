"""Tooth counts of the free wheels of a train: every assignment that meets all requirements, counted."""
