"""Whether a declared train can be built, from the declaration alone: modules, places, kinds, planets, clutches.

In: the declaration, its tree of turning pairs and its circuits. Out: `BuildFinding` records, errors where nothing can
be built so and notes where it is unwise. What needs a layout or outlines of teeth adds records of the same type where
those are known.
"""

from __future__ import annotations

from geartrain.kinematics.buildability.build_findings import BuildFinding, BuildLevel, build_errors

__all__ = ["BuildFinding", "BuildLevel", "build_errors"]
