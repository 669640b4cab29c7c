"""Torques, powers and losses of a train at some positions of its input."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats


class PositionTorques(NamedTuple):
    """Torques at some positions, (n,) last; powers and losses are over the speed of the input.

    turns     of the input
    valid     where something balances; `layers`, how many solutions there are
    adrift    where no flanks agree with the torques that press on them
    torque    on each link asked for, about its own axis, in the solution that loses least, (asked, n)
    highest   the same in the one that loses most
    speeds    of the links with a torque from outside, about their own axes, over the input's, (outside, n)
    powers    what each of these torques puts in, (outside, n)
    losses    of pairs, then bearings, (parts, n); `passed`, what the driving side of each puts in
    pressed   multiplier of each pair: above 0 on its drive flanks, (pairs, n)
    turning   forward speed of each pair's driver, over the input's, (pairs, n)
    slipping  speed of each bearing over the input's, (bearings, n)
    kinks     what changes its sign at kinks of which no law tells, (kinks, n)
    """

    turns: Floats
    valid: Bools
    adrift: Bools
    layers: Floats
    torque: Floats
    highest: Floats
    speeds: Floats
    powers: Floats
    losses: Floats
    passed: Floats
    pressed: Floats
    turning: Floats
    slipping: Floats
    kinks: Floats
