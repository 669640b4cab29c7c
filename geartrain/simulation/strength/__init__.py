"""Strength of gear pairs, arbors and pins under load, and their wear (docs/strength.md), in N, mm and MPa.

train_strength     entry point: `solve_strength`, for all pairs and arbors of a train
strength_results   the results
strength_report    the report and its data in JSON format; `verb` is the command
loaded_pair        one pair under its torque: pressures, root stresses, wear
tooth_forces       forces at pitch points
virtual_spurs      virtual spur wheels of bevels (Tredgold) and of wheels on crossed axes
pin_strength       contacts of lobes on pins and of pins in holes
contact_pressure   Hertzian line and point contact, Archard's wear
iso_6336           contact and root stress by ISO 6336 method B, root stress by Lewis
"""
