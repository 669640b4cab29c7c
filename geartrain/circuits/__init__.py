"""Turning pairs as a tree, and one fundamental circuit per gear pair and coupling."""

from __future__ import annotations

from geartrain.circuits.axes import are_parallel, bookkeeping_links, link_signs
from geartrain.circuits.bodies import close_joints, rigid_remarks
from geartrain.circuits.finding import Circuit, find_circuits
from geartrain.circuits.tree import Tree, find_tree

__all__ = [
    "Circuit",
    "Tree",
    "are_parallel",
    "bookkeeping_links",
    "close_joints",
    "find_circuits",
    "find_tree",
    "link_signs",
    "rigid_remarks",
]
