"""Outlines of wheels as SVG, DXF or CSV, in mm."""

from __future__ import annotations

from io import StringIO
from math import hypot
from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, MissingExtraError, Problem
from geartrain.files.writing import write_text

if TYPE_CHECKING:
    from geartrain.outlines import Contour, Wheel

OUTLINES = (".svg", ".dxf", ".csv")
_MARGIN = 2.0  # mm of white round the wheel
_STRAIGHT = 1e-9  # bulges below this are drawn as lines


def write_outline(path: Path, wheel: Wheel) -> None:
    """Write a wheel's outline in the format of the suffix. Raises `GearTrainError`, for one without its library too."""
    write_text(path, outline_text(wheel, path.suffix.lower()))


def outline_text(wheel: Wheel, suffix: str) -> str:
    """A wheel's outline as the text of a file: `.svg`, `.dxf` (millimetres, closed polylines with arcs), or `.csv`."""
    if suffix == ".svg":
        return _svg(wheel)
    if suffix == ".dxf":
        return _dxf(wheel)
    if suffix == ".csv":
        return _csv(wheel)
    raise GearTrainError(
        Problem(
            f"no outline can be written as {suffix or 'a file without suffix'}",
            "",
            f"use {', '.join(OUTLINES)}",
            "--profile",
        )
    )


def _svg(wheel: Wheel) -> str:
    """One path; a unit is a millimetre, y downwards as SVG has it, so that the wheel looks as it is."""
    half = max(hypot(x, y) for x, y in wheel.contours[0].points) + _MARGIN
    box = f"{-half:.4f} {-half:.4f} {2 * half:.4f} {2 * half:.4f}"
    size = f"{2 * half:.4f}mm"
    path = " ".join(map(_path, wheel.contours))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" viewBox="{box}">\n'
        f"<title>{_title(wheel)}</title>\n"
        f'<path fill="none" stroke="#000000" stroke-width="0.1" d="{path}"/>\n</svg>\n'
    )


def _path(contour: Contour) -> str:
    from geartrain.outlines.contour import arc_radius

    points = [*contour.points, contour.points[0]]
    parts = [f"M {points[0][0]:.6f} {-points[0][1]:.6f}"]
    for start, end, bulge in zip(points, points[1:], contour.bulges.tolist(), strict=False):
        to = f"{end[0]:.6f} {-end[1]:.6f}"
        if abs(bulge) < _STRAIGHT:
            parts.append(f"L {to}")
        else:
            radius, large, turn = arc_radius(start, end, bulge), int(abs(bulge) > 1), int(bulge < 0)
            parts.append(f"A {radius:.6f} {radius:.6f} 0 {large} {turn} {to}")
    return " ".join([*parts, "Z"])


def _dxf(wheel: Wheel) -> str:
    try:
        from ezdxf import units
        from ezdxf.filemanagement import new
    except ImportError:
        raise MissingExtraError("ezdxf", "dxf", "an outline as DXF") from None
    document = new("R2010", units=units.MM)
    space = document.modelspace()
    document.layers.add("CUT")
    for contour in wheel.contours:
        layer = {"layer": "CUT"}
        if contour.is_circle:
            centre = contour.points.mean(axis=0)
            space.add_circle(tuple(centre), float(abs(contour.points[0] - centre).max()), dxfattribs=layer)
        else:
            vertices = [
                (float(x), float(y), float(bulge)) for (x, y), bulge in zip(contour.points, contour.bulges, strict=True)
            ]
            space.add_lwpolyline(vertices, format="xyb", close=True, dxfattribs=layer)
    text = StringIO()
    document.write(text)
    return text.getvalue()


def _csv(wheel: Wheel) -> str:
    """A point a row; each contour ends where it began, its arcs as chords within the wheel's tolerance."""
    rows = ["contour,x_mm,y_mm"]
    for at, contour in enumerate(wheel.contours):
        points = contour.flattened(wheel.tolerance)
        rows += [f"{at},{x:.6f},{y:.6f}" for x, y in [*points, points[0]]]
    return "\n".join(rows) + "\n"


def _title(wheel: Wheel) -> str:
    what = "pins" if wheel.kind == "pins" else "teeth"
    return (
        f"{wheel.z} {what}, module {wheel.module:g} mm, pitch diameter {2 * wheel.pitch_radius:.4f} mm, "
        f"backlash {wheel.backlash:.4g} mm, centre distance {wheel.centre_distance:.4f} mm"
    )
