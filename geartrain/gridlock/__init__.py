"""Why meshes lock a train, and the least set of them to disengage so that it moves."""

from __future__ import annotations

from geartrain.gridlock.finding import find_gridlock
from geartrain.gridlock.result import Gridlock, Jam, Proof, Release

__all__ = ["Gridlock", "Jam", "Proof", "Release", "find_gridlock"]
