"""Torque over a turn: the balance of every position, with its real ratio and friction (docs/torques.md, section 16)."""
