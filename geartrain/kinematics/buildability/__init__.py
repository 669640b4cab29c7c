"""Checks whether a declared train can be built: modules, positions, kinds of wheels, planets, clutches.

The input consists of the declaration, its tree of turning pairs and its circuits. The results are `BuildFinding`
records: errors if the train cannot be built as declared, and notes if its design is inadvisable. Checks that require a
layout or tooth outlines add records of the same type.
"""

from __future__ import annotations

from geartrain.kinematics.buildability.build_findings import BuildFinding, BuildLevel, build_errors

__all__ = ["BuildFinding", "BuildLevel", "build_errors"]
