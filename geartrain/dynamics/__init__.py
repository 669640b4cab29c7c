"""Torques and transmission error: what real teeth and losses do to a train of known speeds.

In: circuits, speeds and loads of a state, and what is known of each gear pair. Out: torques, powers, efficiencies and
who drives whom (docs/torques.md); every link's angle at every position, with the error of its teeth (docs/motion.md).

gear_meshes   the gear pairs of a train with their real teeth, and the way power takes through each
torques       balance by the transpose of the Willis system, losses by the direction of power, recirculating power
motion        transmission functions composed along the solved order of the train
"""
