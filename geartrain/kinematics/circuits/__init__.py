"""Turning pairs as a tree, and one fundamental circuit per gear pair and coupling."""

from __future__ import annotations

from geartrain.kinematics.circuits.axes import are_parallel, joint_sum_links, link_signs
from geartrain.kinematics.circuits.fundamental import Circuit, find_circuits
from geartrain.kinematics.circuits.joint_tree import Tree, find_tree
from geartrain.kinematics.circuits.rigid_bodies import close_joints, lint_rigid_bodies

__all__ = [
    "Circuit",
    "Tree",
    "are_parallel",
    "close_joints",
    "find_circuits",
    "find_tree",
    "joint_sum_links",
    "link_signs",
    "lint_rigid_bodies",
]
