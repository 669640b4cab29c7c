"""Drawings as SVG: a user unit is a millimetre, and y downwards as SVG has it, so that the part looks as it is."""

from __future__ import annotations

from html import escape

from geartrain.errors import printable
from geartrain.export.drawing import CUT, ENGRAVE, PITCH, Drawing, Mark
from geartrain.outlines import Contour
from geartrain.outlines.contour import arc_radius

_STRAIGHT = 1e-9  # bulges below this are drawn as lines


def to_svg(drawing: Drawing) -> str:
    """A drawing as SVG: one path to cut, and a group for each layer that is not cut."""
    (left, low), (right, high) = (corner.tolist() for corner in drawing.box)
    width, height = right - left, high - low
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.4f}mm" height="{height:.4f}mm" '
        f'viewBox="{left:.4f} {-high:.4f} {width:.4f} {height:.4f}">',
        f"<title>{escape(drawing.title)}</title>",
        f'<path id="{CUT}" fill="none" stroke="#000000" stroke-width="0.1" d="{" ".join(map(_path, drawing.cut))}"/>',
    ]
    if drawing.pitch:
        circles = (_circle(contour) for contour in drawing.pitch)
        style = 'fill="none" stroke="#0060c0" stroke-width="0.05" stroke-dasharray="1 0.5"'
        lines.append(f'<g id="{PITCH}" {style}>{"".join(circles)}</g>')
    if drawing.marks:
        style = 'fill="#c02020" font-family="sans-serif" text-anchor="middle" dominant-baseline="central"'
        lines.append(f'<g id="{ENGRAVE}" {style}>{"".join(map(_text, drawing.marks))}</g>')
    return printable("\n".join([*lines, "</svg>", ""]))


def _path(contour: Contour) -> str:
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


def _circle(contour: Contour) -> str:
    (x, y), radius = contour.points.mean(axis=0), abs(contour.points[0] - contour.points[1]).max() / 2
    return f'<circle cx="{x:.6f}" cy="{-y:.6f}" r="{radius:.6f}"/>'


def _text(mark: Mark) -> str:
    x, y = mark.at
    return f'<text x="{x:.4f}" y="{-y:.4f}" font-size="{mark.height:.4g}">{escape(mark.text)}</text>'
