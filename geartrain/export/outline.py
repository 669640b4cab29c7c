"""Outlines of single wheels as SVG, DXF or CSV, in mm."""

from __future__ import annotations

from geartrain.errors import GearTrainError, Problem
from geartrain.export.drawing import wheel_drawing
from geartrain.export.dxf import to_dxf
from geartrain.export.svg import to_svg
from geartrain.files import csv_text
from geartrain.outlines import Wheel

OUTLINES = (".svg", ".dxf", ".csv")


def outline_text(wheel: Wheel, suffix: str) -> str:
    """A wheel's outline as the text of a file: `.svg`, `.dxf` (millimetres, closed polylines with arcs), or `.csv`.

    Raises `GearTrainError`, for a format without its library too.
    """
    if suffix == ".svg":
        return to_svg(wheel_drawing(wheel))
    if suffix == ".dxf":
        return to_dxf(wheel_drawing(wheel))
    if suffix == ".csv":
        return _csv(wheel)
    what = f"no outline can be written as {suffix or 'a file without suffix'}"
    raise GearTrainError(Problem(what, "", f"use {', '.join(OUTLINES)}", "--profile"))


def _csv(wheel: Wheel) -> str:
    """A point a row; each contour ends where it began, its arcs as chords within the wheel's tolerance."""
    rows: list[tuple[object, ...]] = []
    for at, contour in enumerate(wheel.contours):
        points = contour.flattened(wheel.tolerance)
        rows += [(at, f"{x:.6f}", f"{y:.6f}") for x, y in [*points, points[0]]]
    return csv_text(("contour", "x_mm", "y_mm"), rows)
