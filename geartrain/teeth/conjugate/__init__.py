"""Conjugate teeth from their path of contact, spur and bevel at once: profiles, sliding, stress, heat, loss.

The path is where contact happens in the fixed frame: at the signed distance d from the pitch point along a normal that
makes the pressure angle psi with the pitch line. One function, psi(d), gives both profiles and all that is asked of
them; a tooth form is a choice of it.
"""
