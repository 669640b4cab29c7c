"""Strength of a gear pair: contact pressure, stress at the root, wear (docs/strength.md). Units here: N, mm, MPa."""
