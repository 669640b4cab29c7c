"""Wheels with cutting errors: each tooth has its own pitch deviation, height and flank angles (docs/cut-by-hand.md).

declared_errors      errors that a train declares, and their overrides
cut_wheel            triangular wheels in one or many trials, and pairs of such wheels
displaced_pair       wheels of all other tooth forms, with displaced flanks
meshing_cycle        events of many pairs, computed together: jam, clash, dwell, loss of contact
trial_transmission   transmission functions of many pairs, computed together
wheel_estimate       eccentricity and pitch deviations of a measured wheel; `verb` prints them
measured_motion      motion of a train with its wheels as measured
file_strokes         filing of teeth until pairs turn without a jam
"""
