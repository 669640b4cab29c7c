"""Strength of a train: what torques do to teeth, arbors and pivots, and what turning wears off (docs/strength.md)."""
