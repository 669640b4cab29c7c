"""Torque over a revolution: torque balance at every position with the actual speed ratio and friction (docs/torques.md,
section 16).

train_turn           main functions: torque of a train over revolutions of its input, and the results of a run
turn_run             positions at which torques are computed, and integrals over the run
position_motion      speeds of all links, and driver angles of the pairs, at these positions
train_contacts       transmission function, friction and driving side of every pair in one load case
turn_balance         torque balance, powers and losses at any position
torque_cycle         results: torques, energies, extremes
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.dynamics.turn.train_turn import find_torque_period as find_torque_period
    from geartrain.dynamics.turn.train_turn import find_turn_balance as find_turn_balance

__getattr__, __all__ = public_names(
    __name__,
    {
        "train_turn": "find_torque_period find_turn_balance",
    },
)
