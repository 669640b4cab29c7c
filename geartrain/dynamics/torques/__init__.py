"""Torques, power and losses: balances of links, directions of power, verdicts on self-locking (docs/torques.md)."""
