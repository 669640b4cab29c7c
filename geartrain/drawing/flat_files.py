"""Drawings as SVG, DXF and CSV files, in mm. Contours of DXF files are closed polylines with arcs."""

from __future__ import annotations

from html import escape
from io import StringIO
from typing import Any

from geartrain.errors import GearTrainError, MissingExtraError, Problem, printable
from geartrain.numerics.files import csv_text
from geartrain.scene.solids.bearing_plates import CUT, ENGRAVE, LAYERS, PITCH, EngravedText, FlatDrawing, wheel_drawing
from geartrain.teeth.outlines.contour import Contour, arc_radius
from geartrain.teeth.outlines.wheel_outline import WheelOutline

_STRAIGHT = 1e-9  # bulge below which an arc is drawn as a line


def to_svg(drawing: FlatDrawing) -> str:
    """Return a drawing as an SVG string with one path to be cut, and a group for each layer that is not cut."""
    (left, low), (right, high) = (corner.tolist() for corner in drawing.box)
    width, height = right - left, high - low
    cut = " ".join(map(path_data, drawing.cut))
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.4f}mm" height="{height:.4f}mm" '
        f'viewBox="{left:.4f} {-high:.4f} {width:.4f} {height:.4f}">',
        f"<title>{escape(drawing.title)}</title>",
        f'<path id="{CUT}" fill="none" stroke="#000000" stroke-width="0.1" d="{cut}"/>',
    ]
    if drawing.pitch:
        guides = (_circle(each) if each.is_circle else f'<path d="{path_data(each)}"/>' for each in drawing.pitch)
        style = 'fill="none" stroke="#0060c0" stroke-width="0.05" stroke-dasharray="1 0.5"'
        lines.append(f'<g id="{PITCH}" {style}>{"".join(guides)}</g>')
    if drawing.marks or drawing.lines:
        style = 'fill="#c02020" font-family="sans-serif" text-anchor="middle" dominant-baseline="central"'
        chords = ("M " + " L ".join(f"{x:.4f} {-y:.4f}" for x, y in line) for line in drawing.lines)
        drawn = f'<path fill="none" stroke="#c02020" stroke-width="0.1" d="{" ".join(chords)}"/>'
        letters = "".join(map(_text, drawing.marks))
        lines.append(f'<g id="{ENGRAVE}" {style}>{drawn if drawing.lines else ""}{letters}</g>')
    return printable("\n".join([*lines, "</svg>", ""]))


def path_data(contour: Contour) -> str:
    """Return a contour as the data of an SVG path. Arcs are retained, and y points downwards."""
    points = [*contour.points, contour.points[0]]
    parts = [f"M {points[0][0]:.6f} {-points[0][1]:.6f}"]
    for start, end, bulge in zip(points, points[1:], contour.bulges.tolist(), strict=False):
        to = f"{end[0]:.6f} {-end[1]:.6f}"
        if abs(bulge) < _STRAIGHT:
            parts.append(f"L {to}")
        else:
            # a bulge is tan(angle / 4), so that above 1 the arc exceeds a semicircle; sweep flag 0 is counter-clockwise
            radius, large, turn = arc_radius(start, end, bulge), int(abs(bulge) > 1), int(bulge < 0)
            parts.append(f"A {radius:.6f} {radius:.6f} 0 {large} {turn} {to}")
    return " ".join([*parts, "Z"])


def _circle(contour: Contour) -> str:
    (x, y), radius = contour.points.mean(axis=0), abs(contour.points[0] - contour.points[1]).max() / 2
    return f'<circle cx="{x:.6f}" cy="{-y:.6f}" r="{radius:.6f}"/>'


def _text(mark: EngravedText) -> str:
    x, y = mark.at
    turn = f' transform="rotate({-mark.angle:.6g} {x:.4f} {-y:.4f})"' if mark.angle else ""
    return f'<text x="{x:.4f}" y="{-y:.4f}" font-size="{mark.height:.4g}"{turn}>{escape(mark.text)}</text>'


_COLOURS = dict(zip(LAYERS, (7, 5, 1), strict=True))  # black or white, blue, red


def to_dxf(drawing: FlatDrawing) -> str:
    """Return a drawing as a DXF R2010 string; raise `MissingExtraError` if ezdxf is not installed."""
    try:
        from ezdxf import options, units  # type: ignore[attr-defined]
        from ezdxf.enums import TextEntityAlignment
        from ezdxf.filemanagement import new
    except ImportError:
        raise MissingExtraError("ezdxf", "dxf", "an outline as DXF") from None
    kept = options.write_fixed_meta_data_for_testing
    # fixed dates and GUIDs, which ezdxf sets when a document is created and when it is written
    options.write_fixed_meta_data_for_testing = True
    try:
        return _dxf(drawing, new("R2010", units=units.MM), TextEntityAlignment.MIDDLE_CENTER)
    finally:
        options.write_fixed_meta_data_for_testing = kept


def _dxf(drawing: FlatDrawing, document: Any, centred: Any) -> str:
    document.header.custom_vars.append("Title", drawing.title)
    space = document.modelspace()
    used: dict[str, int] = {
        CUT: len(drawing.cut),
        PITCH: len(drawing.pitch),
        ENGRAVE: len(drawing.marks) + len(drawing.lines),
    }
    for name, count in used.items():
        if count:
            document.layers.add(name, color=_COLOURS[name])
    for name, contours in ((CUT, drawing.cut), (PITCH, drawing.pitch)):
        for contour in contours:
            _draw(space, contour, name)
    for line in drawing.lines:
        space.add_lwpolyline([(float(x), float(y)) for x, y in line], dxfattribs={"layer": ENGRAVE})
    for mark in drawing.marks:
        text = space.add_text(mark.text, height=mark.height, rotation=mark.angle, dxfattribs={"layer": ENGRAVE})
        text.set_placement(mark.at, align=centred)
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


OUTLINES = (".svg", ".dxf", ".csv")
"""Suffixes of the file formats that can contain the outline of one wheel."""


def outline_text(wheel: WheelOutline, suffix: str) -> str:
    """Return the outline of a wheel as the text of an SVG, DXF or CSV file, at full scale (1:1), in mm.

    Parameters
    ----------
    wheel : WheelOutline
        Outline of the wheel, from `GearMesh.wheel_outline`.
    suffix : {".svg", ".dxf", ".csv"}
        File format. DXF contains closed polylines with arcs; CSV contains one row per point.

    Returns
    -------
    str
        Content of the file.

    Raises
    ------
    MissingExtraError
        If the library that writes DXF is not installed.
    GearTrainError
        If the suffix is not supported.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.teeth.outlines.wheel_outline import BlankSizes
    >>> mesh = geartrain.load("planetary-24-18-60-involute").meshes[0]
    >>> outline_text(mesh.wheel_outline(1, BlankSizes(module=1.0)), ".csv").splitlines()[0]
    'contour,x_mm,y_mm'
    """
    if suffix == ".svg":
        return to_svg(wheel_drawing(wheel))
    if suffix == ".dxf":
        return to_dxf(wheel_drawing(wheel))
    if suffix == ".csv":
        rows: list[tuple[object, ...]] = []
        for at, contour in enumerate(wheel.contours):
            points = contour.flattened(wheel.tolerance)
            rows += [(at, f"{x:.6f}", f"{y:.6f}") for x, y in [*points, points[0]]]
        return csv_text(("contour", "x_mm", "y_mm"), rows)
    what, fix = f"an outline cannot be written as {suffix or 'a file without suffix'}", ", ".join(OUTLINES)
    raise GearTrainError(Problem(what, "the suffix determines the format", f"use one of {fix}", "--profile"))
