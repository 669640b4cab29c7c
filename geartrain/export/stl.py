"""Solids as binary STL, in mm."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.export.solid import Solid

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def to_stl(solid: Solid, name: str) -> bytes:
    """A solid as binary STL; the header holds its name."""
    corners = solid.vertices[solid.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(corners), dtype=_TRIANGLE)
    rows["normal"] = normals / np.where(length > 0, length, 1)
    rows["corners"] = corners
    header = f"{name}, mm".encode("ascii", "replace")[:79].ljust(80)
    return header + np.uint32(len(rows)).tobytes() + rows.tobytes()
