"""Drawings as DXF: millimetres, a layer for each use, closed polylines with arcs."""

from __future__ import annotations

from io import StringIO
from typing import TYPE_CHECKING, Any

from geartrain.errors import MissingExtraError
from geartrain.export.drawing import CUT, ENGRAVE, LAYERS, PITCH, Drawing

if TYPE_CHECKING:
    from geartrain.outlines import Contour

_COLOURS = dict(zip(LAYERS, (7, 5, 1), strict=True))  # black or white, blue, red


def to_dxf(drawing: Drawing) -> str:
    """A drawing as DXF R2010, its title in the header's comment. Raises `MissingExtraError`."""
    try:
        from ezdxf import units
        from ezdxf.enums import TextEntityAlignment
        from ezdxf.filemanagement import new
    except ImportError:
        raise MissingExtraError("ezdxf", "dxf", "an outline as DXF") from None
    document = new("R2010", units=units.MM)
    document.header["$TDCREATE"] = document.header["$TDUPDATE"] = 0  # the same drawing is the same file
    document.header.custom_vars.append("Title", drawing.title)
    space = document.modelspace()
    used: dict[str, int] = {CUT: len(drawing.cut), PITCH: len(drawing.pitch), ENGRAVE: len(drawing.marks)}
    for name, count in used.items():
        if count:
            document.layers.add(name, color=_COLOURS[name])
    for name, contours in ((CUT, drawing.cut), (PITCH, drawing.pitch)):
        for contour in contours:
            _draw(space, contour, name)
    for mark in drawing.marks:
        text = space.add_text(mark.text, height=mark.height, dxfattribs={"layer": ENGRAVE})
        text.set_placement(mark.at, align=TextEntityAlignment.MIDDLE_CENTER)
    out = StringIO()
    document.write(out)
    return out.getvalue()


def _draw(space: Any, contour: Contour, layer: str) -> None:
    attributes = {"layer": layer}
    if contour.is_circle:
        centre = contour.points.mean(axis=0)
        radius = float(abs(contour.points[0] - centre).max())
        space.add_circle(tuple(centre.tolist()), radius, dxfattribs=attributes)
        return
    vertices = [
        (float(x), float(y), float(bulge)) for (x, y), bulge in zip(contour.points, contour.bulges, strict=True)
    ]
    space.add_lwpolyline(vertices, format="xyb", close=True, dxfattribs=attributes)
