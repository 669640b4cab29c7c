"""Torque over a revolution: balance at every position with its actual ratio and friction (docs/torques.md, section
16).
"""
