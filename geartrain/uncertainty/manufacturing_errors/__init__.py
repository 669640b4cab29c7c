"""Wheels cut by hand: each tooth with its own place, height and flanks.

declared_errors                       what a train declares, and what is set in its place
cut_wheel, cut_pair                   one wheel, or many; two of them on their axles
contact_envelope, contact_intervals   one pair: which couple pushes, and from where to where
cut_transmission, meshing_events      its transmission function, and what goes wrong in a cycle
trial_transmission                    the transmission functions of many pairs at once
meshing_cycle, least_backlash         many pairs at once: whether they jam, clash, stand still, lose contact
pitch_error_verdicts                  the same where teeth are right but for their places, at much less cost
meshing_verdicts                      the cheaper of the two that is right
displaced_wheel, displaced_pair       wheels and pairs of teeth of all other forms, many at once
least_sums                            the least of what two wheels add, over all teeth that meet
file_strokes                          pairs filed until they pass
"""
