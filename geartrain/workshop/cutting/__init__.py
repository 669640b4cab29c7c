"""Wheels cut by hand: each tooth with its own place, height and flanks (docs/cut-by-hand.md).

declared_errors      errors that a train declares, and overrides of them
cut_wheel            triangular wheels, one or many, and two of them on their axles
displaced_pair       the same of teeth of all other forms
meshing_cycle        verdicts on many pairs at once: whether they jam, clash, stand still, lose contact
minimum_backlash       the minimum backlash of a front and a back couple: Newton's method safeguarded by bisection
trial_transmission   the transmission functions of many pairs at once
file_strokes         pairs filed until they pass
"""
