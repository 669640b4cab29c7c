"""Tooth numbers for a wanted motion.

In: a ratio, a train with wheels to be found, a kind of epicyclic set, or the periods of an orrery; limits on wheels.
Out: the tooth counts that fit, ranked, with proof that the search was complete, or why it was not.

ratio        one ratio by stages: meet in the middle
train        every assignment of the free wheels of a declared train that meets all constraints: the exact join
epicyclic    sets of sun, planets and ring
orrery       many ratios that share wheels: beam search
formulas     outputs as rational functions of the free counts
constraints  what else must hold: assembly, clearance, interference, sums of teeth
"""
