"""Files for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

flat_files      a flat part with its layers as SVG or DXF
wheel_sheets    a drawing of each kind of wheel
triangle_files  the assembly as STL and GLB
step_file       the assembly for CAD
rexs            the gear unit as REXS
csv_tables      its tables
file_set        which files there are

Shapes come from `geartrain.scene.solids`.
"""

from __future__ import annotations

from geartrain.export.file_set import (
    KINDS,
    SUFFIXES,
    WHEEL_SUFFIXES,
    export_files,
    installed,
    kind_of,
    notices,
    train_file,
    wheel_file,
)
from geartrain.export.flat_files import OUTLINES, outline_text
from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes
from geartrain.scene.solids.solid_assembly import SolidModel

__all__ = [
    "KINDS",
    "OUTLINES",
    "SUFFIXES",
    "WHEEL_SUFFIXES",
    "ManufacturingSizes",
    "SolidModel",
    "export_files",
    "installed",
    "kind_of",
    "notices",
    "outline_text",
    "train_file",
    "wheel_file",
]
