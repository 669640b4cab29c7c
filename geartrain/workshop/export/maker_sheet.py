"""Workshop drawings: a drawing of each plate with a datum and a hole table, and a table of all wheels.

Plates are drawn at full scale in mm, with holes in their finished size. The datum is the centre of a hole, because the
edge of a plate has few straight parts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from html import escape
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.flat_files import path_data
from geartrain.errors import printable
from geartrain.numerics.files import csv_text
from geartrain.workshop.export.cut_sheets import file_names, wheel_sheets
from geartrain.workshop.export.label_boxes import WIDE, LabelBoxes
from geartrain.workshop.export.parts_list import material_of

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plates import FlatPlate, Hole
    from geartrain.scene.solids.solid_assembly import SolidModel

Rows = Sequence[Sequence[str]]

_SIZE, _LINE, _MARGIN = 3.0, 4.8, 10.0  # mm: font size, distance of lines, margin of a sheet
_BAR = 50.0  # mm: length of the scale bar
_NO_AXIS = ("pillar", "post", "pin", "foot", "cock", "window")  # names of holes that are not of an axis
_HOLES = ("no.", "hole", "x mm", "y mm", "diameter mm")
_WHEELS = (
    *("wheel", "pieces", "teeth", "module mm", "helix deg", "pitch diameter mm", "outside diameter mm"),
    *("inside diameter mm", "root diameter mm", "bore mm", "thickness mm"),
)


def maker_sheets(work: SolidModel) -> Iterator[tuple[str, str, Callable[[], bytes]]]:
    """Yield path, title and a function that returns the content, for each drawing and table of plates and wheels."""
    plates = [] if work.frame is None else [plate for plate in work.frame.plates() if plate.holes]
    for name, plate in zip(file_names(plate.name for plate in plates), plates, strict=True):
        title = f"{plate.name}: holes from a datum, to read"
        yield f"drawings/{name}.svg", title, partial(plate_sheet, work, plate)
    if plates:
        rows = [(plate.name, *row) for plate in plates for row in hole_rows(plate)]
        yield "drawings/holes.csv", "coordinates and diameters of holes", csv_text(("plate", *_HOLES), rows).encode
    if work.blanks.wheels:
        yield "drawings/wheels.svg", "table of wheels", wheel_sheet(work).encode
        yield "drawings/wheels.csv", "table of wheels", csv_text(_WHEELS, wheel_rows(work)).encode


# ------------------------------------------------------------------------------------------------------------ contents


def hole_rows(plate: FlatPlate) -> list[tuple[str, ...]]:
    """Return number, name, x and y relative to the datum, and diameter of each hole of a plate, as text [mm]."""
    # the datum is the first hole of an axis, or the first hole if the plate has no axis
    holes = _ordered(plate)
    x, y = holes[0].at
    return [
        (str(number), hole.name, *(_mm(each) for each in (hole.at[0] - x, hole.at[1] - y, hole.diameter)))
        for number, hole in enumerate(holes, 1)
    ]


def _ordered(plate: FlatPlate) -> list[Hole]:
    """Return the holes of a plate. The holes for axes come first."""
    return sorted(plate.holes, key=lambda hole: hole.name in _NO_AXIS)


def wheel_rows(work: SolidModel) -> list[tuple[str, ...]]:
    """Return the table of wheels with a row for each shape; only internal wheels have an inside (tip) diameter."""
    rows = []
    for sheet in wheel_sheets(work.blanks.wheels):
        blank = work.blanks.wheels[sheet.parts[0]]
        outside = 2 * float(np.hypot(*blank.contours[0].points.T).max())
        inside = 2 * blank.tip_radius if blank.kind == "ring" else 0.0
        sizes = (2 * blank.pitch_radius, outside, inside, 2 * blank.root_radius, blank.bore, blank.thickness)
        helix = f"{degrees(blank.helix):+.4g}" if blank.helix else ""
        names, teeth = ", ".join(sheet.parts), f"{blank.teeth}{' inside' if blank.kind == 'ring' else ''}"
        numbers = (_mm(size) if size else "" for size in sizes)
        rows.append((names, str(len(sheet.parts)), teeth, f"{blank.module:.6g}", helix, *numbers))
    return rows


def _mm(length: float) -> str:
    """Return a length [mm] as text with at most four decimals."""
    return f"{round(length, 4) + 0.0:.4f}".rstrip("0").rstrip(".")


# -------------------------------------------------------------------------------------------------------------- sheets


def plate_sheet(work: SolidModel, plate: FlatPlate) -> bytes:
    """Return the sheet of a plate as an SVG file: outline, numbered holes, datum, table, scale bar, title block."""
    edge = plate.outline.flattened(0.05)
    (left, low), (right, high) = edge.min(axis=0), edge.max(axis=0)
    room = 3 * _SIZE  # around the plate, for numbers of holes
    origin = _MARGIN + room - left, _MARGIN + room + high  # of the coordinates of the stack, on the page
    across, down = right - left + 2 * room, high - low + 2 * room
    rows = hole_rows(plate)
    table, wide = _table(_HOLES, rows, _MARGIN + max(across, _BAR) + _SIZE, _MARGIN)
    width = _MARGIN + max(across, _BAR) + _SIZE + wide + _MARGIN
    height = _MARGIN + max(down, _LINE * (len(rows) + 1)) + 2 * _LINE
    at = np.array(plate.at)
    outline = " ".join(path_data(type(each)(each.points + at, each.bulges)) for each in plate.contours)
    place = f'transform="translate({origin[0]:.4f} {origin[1]:.4f})"'
    lines = [f'<path id="outline" fill="none" stroke="#000000" stroke-width="0.25" {place} d="{outline}"/>']
    lines += _marks(plate, origin, (_MARGIN, _MARGIN, _MARGIN + across, _MARGIN + down))
    lines += [*table, *_scale_bar(_MARGIN, height - _LINE)]
    solid = next((part for part in work.parts if part.name == plate.name), None)
    what = [f"thickness {plate.high - plate.low:.4g} mm"] + ([] if solid is None else [material_of(work, solid)])
    first = rows[0]
    remark = f"datum: centre of hole 1 ({first[1]}), x to the right, y upwards; holes have their finished size"
    return _page(work, plate.name, ", ".join([*what, "scale 1:1"]), remark, (width, height), lines).encode("utf-8")


def wheel_sheet(work: SolidModel) -> str:
    """Return a drawing sheet with the table of all wheels and a title block, as SVG."""
    found = wheel_rows(work)
    used = [at for at in range(len(_WHEELS)) if any(row[at] for row in found)]
    header, *rows = [[row[at] for at in used] for row in (_WHEELS, *found)]
    table, wide = _table(header, rows, _MARGIN, _MARGIN)
    size = 2 * _MARGIN + wide, 2 * _MARGIN + _LINE * (len(rows) + 1)
    remark = "modules are transverse; the outside diameter of a ring is that of its rim"
    return _page(work, "wheels", "those that can be cut flat", remark, size, table)


def _marks(plate: FlatPlate, origin: tuple[float, float], page: tuple[float, float, float, float]) -> Iterator[str]:
    """Yield SVG of a numbered cross at each hole and of axes at the first, for a plate at `origin` on the page [mm]."""
    labels, spots = LabelBoxes(page, _SIZE), []
    for hole in _ordered(plate):
        x, y, reach = origin[0] + hole.at[0], origin[1] - hole.at[1], hole.diameter / 2 + 0.5
        spots.append((x, y, reach))
        labels.taken.append((x - reach, y - reach, x + reach, y + reach))
    x, y, _ = spots[0]
    arrow = 3 * _SIZE
    labels.taken += [(x, y - 0.5, x + arrow, y + 0.5), (x - 0.5, y - arrow, x + 0.5, y)]
    line = f"M {x:.3f} {y - arrow:.3f} V {y:.3f} H {x + arrow:.3f}"
    yield f'<path id="datum" fill="none" stroke="#c02020" stroke-width="0.35" d="{line}"/>'
    for text, end in (("x", (x + arrow, y)), ("y", (x, y - arrow))):
        yield _text(text, *labels.place(text, *end), 'text-anchor="middle" fill="#c02020"')
    for number, (x, y, reach) in enumerate(spots, 1):
        cross = f"M {x - reach:.3f} {y:.3f} h {2 * reach:.3f} M {x:.3f} {y - reach:.3f} v {2 * reach:.3f}"
        yield f'<path fill="none" stroke="#0060c0" stroke-width="0.1" d="{cross}"/>'
        yield _text(str(number), *labels.place(str(number), x, y), 'text-anchor="middle" class="number"')


def _table(header: Sequence[str], rows: Rows, left: float, top: float) -> tuple[list[str], float]:
    """Return the drawn texts and lines of a table, and its width [mm]. The first column is left-aligned."""
    every = [header, *rows]
    widths = [WIDE * _SIZE * max(map(len, column)) + _SIZE for column in zip(*every, strict=True)]
    ends = left + np.cumsum(widths)
    lines = []
    for at, row in enumerate(every):
        y = top + _LINE * (at + 0.5)
        for column, cell in enumerate(row):
            flush = column < 2 and not cell.replace(".", "").lstrip("-").isdigit()
            x = ends[column] - widths[column] if flush else ends[column] - _SIZE
            lines.append(_text(cell, float(x), y, "" if flush else 'text-anchor="end"'))
    rule = f"M {left:.3f} {top + _LINE:.3f} H {ends[-1]:.3f}"
    return [*lines, f'<path stroke="#000000" stroke-width="0.2" d="{rule}"/>'], float(ends[-1] - left)


def _scale_bar(x: float, y: float) -> Iterator[str]:
    ticks = " ".join(f"M {x + at:.3f} {y:.3f} v -1.5" for at in np.arange(0, _BAR + 1, 10))
    line = f"M {x:.3f} {y:.3f} h {_BAR:g} {ticks}"
    yield f'<path id="scale-bar" fill="none" stroke="#000000" stroke-width="0.35" d="{line}"/>'
    yield _text(f"{_BAR:g} mm", x + _BAR + _SIZE, y - 0.8)


def _text(text: str, x: float, y: float, style: str = "") -> str:
    return f'<text x="{x:.3f}" y="{y:.3f}" {style}>{escape(printable(text))}</text>'


def _page(work: SolidModel, part: str, what: str, remark: str, size: tuple[float, float], lines: Sequence[str]) -> str:
    """Return an SVG page: contents `lines` of the size `size` [mm], above a title block with the other texts."""
    declared = work.train.declaration
    title = f"{declared.name}: {declared.title}" if declared.title else declared.name
    block = [title, f"{part}; {what}", f"lengths in mm; process: {work.process.name}", remark]
    width = max(size[0], 2 * _MARGIN + _SIZE + WIDE * _SIZE * max(map(len, block)))
    height = size[1] + _LINE * len(block) + 2 * _MARGIN
    top = size[1] + _MARGIN / 2
    frame = f'x="{_MARGIN:g}" y="{top:.3f}" width="{width - 2 * _MARGIN:.3f}" height="{_LINE * len(block) + _SIZE:.3f}"'
    head = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.3f}mm" height="{height:.3f}mm" '
        f'viewBox="0 0 {width:.3f} {height:.3f}">',
        f"<title>{escape(printable(title))}</title>",
        f'<rect width="{width:.3f}" height="{height:.3f}" fill="#ffffff"/>',
        f'<rect id="title-block" {frame} fill="none" stroke="#000000" stroke-width="0.35"/>',
        f'<g font-family="sans-serif" font-size="{_SIZE:g}" fill="#000000" dominant-baseline="central">',
    ]
    inside = (_text(line, _MARGIN + _SIZE, top + _SIZE / 2 + _LINE * (at + 0.5)) for at, line in enumerate(block))
    return "\n".join([*head, *inside, *lines, "</g></svg>", ""])
