"""Files for makers and for other tools: outlines to cut, plates, solids, graphs, tables.

drawing, svg, dxf    a flat part with its layers, and how it is written
making               sizes a maker chooses, and the layout at them
blanks, sheets       the flat shape of every wheel, and a drawing of each kind of wheel
plates               what bears the arbors; discs of pins and slots
triangles, solid, likeness, assembly    closed surfaces, and where they stand
turning              angles of all bodies while the lead turns
stl, glb, step       the assembly for printers, browsers and CAD
rexs, tables         the gear unit and its tables as data
parcel               which files there are
"""

from __future__ import annotations

from geartrain.export.assembly import Workpiece
from geartrain.export.making import Making
from geartrain.export.outline import OUTLINES, outline_text
from geartrain.export.parcel import (
    KINDS,
    SUFFIXES,
    WHEEL_SUFFIXES,
    installed,
    kind_of,
    notices,
    one_wheel,
    parcel,
    whole,
)

__all__ = [
    "KINDS",
    "OUTLINES",
    "SUFFIXES",
    "WHEEL_SUFFIXES",
    "Making",
    "Workpiece",
    "installed",
    "kind_of",
    "notices",
    "one_wheel",
    "outline_text",
    "parcel",
    "whole",
]
