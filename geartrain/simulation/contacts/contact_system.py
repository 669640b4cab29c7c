"""What the kernels of time stepping read: the arrays of one train.

Coordinates stand in solved order: a pair's driven coordinate after those its row holds beside it. Rows are sparse, one
behind another: those of number m are entries at[m] to at[m + 1].
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


class ContactSystem(NamedTuple):
    """A train as coordinates and contacts, in SI units.

    mass, viscous, matrix   M, D, and M + h D + h^2 K, (n, n)
    torque                  constant torque on each coordinate
    given                   1 where the speed is prescribed
    owner                   the pair that determines a coordinate when it touches; -1 none
    near                    coordinates before it with which each may be coupled (sparse, `near_at`)
    pair_of                 of a pair's row; `pair_driver`, `pair_driven`: what they add to the speeds of both sides
    slot                    where in `near` of its owner an entry stands; -1 for the owner itself, -2 without one
    start_driver, start_driven   angles of both sides where all coordinates are 0
    two_sided               1 for a pin without clearance, and gears without play
    tables, rubbing         laws of both flanks; what friction adds to a driver's arm, (front, back) x (forward, back)
    stiff                   of pairs that determine nothing: inverse compliance of their row
    bearing_*               rows of relative speeds in bearings, with torques of sliding and sticking
    stop_*                  rows that may not pass first + (1 + floor(t/beat)) pitch
    spring_*                rows pulled by stiffness (rest + rate t - angle)
    """

    mass: Floats
    viscous: Floats
    matrix: Floats
    torque: Floats
    given: Ints
    owner: Ints
    near_at: Ints
    near: Ints
    pair_at: Ints
    pair_of: Ints
    pair_driver: Floats
    pair_driven: Floats
    slot: Ints
    start_driver: Floats
    start_driven: Floats
    two_sided: Ints
    restitution: Floats
    tables: Ints
    rubbing: Ints
    stiff: Floats
    bearing_at: Ints
    bearing_of: Ints
    bearing_c: Floats
    sliding: Floats
    sticking: Floats
    stop_at: Ints
    stop_of: Ints
    stop_c: Floats
    stop_first: Floats
    stop_pitch: Floats
    stop_beat: Floats
    stop_restitution: Floats
    stop_stiff: Floats
    spring_at: Ints
    spring_of: Ints
    spring_c: Floats
    spring_stiffness: Floats
    spring_rest: Floats
    spring_rate: Floats
