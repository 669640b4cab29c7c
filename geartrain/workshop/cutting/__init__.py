"""Wheels cut by hand: each tooth with its own place, height and flanks.

declared_errors                 what a train declares, and what is set in its place
cut_wheel, cut_pair             triangular wheels, one or many; two of them on their axles
meshing_cycle, least_backlash   many pairs at once: whether they jam, clash, stand still, lose contact
meshing_verdicts                the verdict on each; at much less cost where teeth are right but for their places
displaced_wheel, displaced_pair wheels and pairs of teeth of all other forms, many at once
trial_transmission              the transmission functions of many pairs at once
file_strokes                    pairs filed until they pass
"""
