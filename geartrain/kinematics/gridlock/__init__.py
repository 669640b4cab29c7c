"""Gridlock: loops of meshes that lock a train, and the smallest set of meshes to be disengaged so that it can move."""

from __future__ import annotations

from geartrain.kinematics.gridlock.locked_subgraphs import find_gridlock
from geartrain.kinematics.gridlock.removal import Gridlock, LockedSubgraph, MeshRemoval, RemovalBound

__all__ = ["Gridlock", "LockedSubgraph", "MeshRemoval", "RemovalBound", "find_gridlock"]
