"""Tree of turning pairs, and the fundamental circuits of the gear pairs and couplings."""

from __future__ import annotations

from geartrain.kinematics.circuits.fundamental import Circuit, couplings_on_axes, find_circuits
from geartrain.kinematics.circuits.joint_tree import (
    Axes,
    Tree,
    check_pallets,
    close_joints,
    find_tree,
    pallet_link,
    rigid_across_axes,
    rigid_place,
)

__all__ = [
    "Axes",
    "Circuit",
    "Tree",
    "check_pallets",
    "close_joints",
    "couplings_on_axes",
    "find_circuits",
    "find_tree",
    "pallet_link",
    "rigid_across_axes",
    "rigid_place",
]
