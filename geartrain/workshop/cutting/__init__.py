"""Wheels with cutting errors: each tooth has its own pitch deviation, height and flank angles (docs/cut-by-hand.md).

declared_errors      errors that a train declares, and their overrides
cut_wheel            triangular wheels, one or many, and pairs of two wheels
displaced_pair       wheels of all other tooth forms, with displaced flanks
meshing_cycle        events of many pairs at once: jam, clash, dwell, loss of contact
trial_transmission   transmission functions of many pairs at once
wheel_estimate       eccentricity and pitch deviations of a measured wheel; `verb` prints them
measured_motion      motion of a train with its wheels as measured
file_strokes         filing of teeth until pairs turn without a jam
"""
