"""Flat drawings of an export for cutting: wheels, plates, and sheets of stock with all parts."""

from __future__ import annotations

import re
from cmath import exp
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import hypot, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, MissingExtraError, Problem, QuestionError
from geartrain.scene.solids.bearing_plates import EngravedText, FlatDrawing, Plate
from geartrain.scene.solids.wheel_blanks import RIM, Blank
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.frame_plates import FlatPlate
    from geartrain.scene.solids.solid_assembly import SolidModel


@dataclass(frozen=True, slots=True)
class Sheet:
    """Drawing of one or more flat parts of the same shape, or of a sheet of stock that contains several parts."""

    file: str
    """Name of the file without suffix, which is also the label of the part on sheets of stock."""
    drawing: FlatDrawing
    parts: tuple[str, ...]
    """Names of the parts in the drawing, with one entry for each piece."""
    thickness: float
    """Thickness of the sheet [mm]."""


def cut_sheets(work: SolidModel) -> Iterator[tuple[str, FlatDrawing]]:
    """Yield path and kerf-compensated drawing of each shape of wheel, of each plate, and of each sheet of stock.

    The paths are relative to the exported folder and have no suffix.
    """
    kerf, base = work.process.kerf, work.train.declaration.frame
    plates = [] if work.frame is None else [_sheet(plate) for plate in work.frame.plates()]
    plates += [Plate(base, each.name.replace(" ", "-"), each.drawing(), each.high - each.low) for each in work.dials]
    plates += work.couplings.plates
    names = file_names(plate.name for plate in plates)
    flat = [("wheels", each) for each in wheel_sheets(work.blanks.wheels)]
    flat += [
        ("plates", Sheet(name, plate.drawing, (plate.name,), plate.thickness))
        for name, plate in zip(names, plates, strict=True)
    ]
    cut = [(folder, replace(each, drawing=compensated(each.drawing, kerf))) for folder, each in flat]
    if work.making.sheet is not None:
        stock = stock_sheets((each for _, each in cut), work.making.sheet, 2 * work.process.web)
        cut += [("sheets", each) for each in stock]
    for folder, each in cut:
        yield f"{folder}/{each.file}", each.drawing


def wheel_drawing(work: SolidModel, blank: Blank) -> FlatDrawing:
    """Return the drawing of one wheel, compensated for the kerf."""
    return compensated(wheel_sheets({blank.wheel: blank})[0].drawing, work.process.kerf)


# -------------------------------------------------------------------------------------------------------------- wheels

_LETTER_SHARE = 0.5  # height of letters, as a fraction of the free width of the web
_MAXIMUM = 5.0  # mm: maximum height of letters
_LETTER_WIDTH = 0.62  # mean width of a letter, as a fraction of its height
_GAP = 0.3  # mm between letters and a hole
_SMALLER, _WAYS, _STEPS = (1.0, 0.8, 0.6, 0.45, 0.3, 0.2), 24, 9  # sizes, directions and radii tried for a label
_CENTRAL = 1e-6  # mm: a hole whose centre is nearer to the axis is the bore
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.I)  # file names reserved by Windows


def wheel_sheets(blanks: Mapping[str, Blank]) -> tuple[Sheet, ...]:
    """Return one drawing for each shape of wheel. Wheels of the same shape share a drawing."""
    alike: dict[object, list[Blank]] = {}
    for blank in blanks.values():
        alike.setdefault(_shape(blank), []).append(blank)
    names = file_names(group[0].wheel for group in alike.values())
    return tuple(
        Sheet(name, _drawing(group), tuple(blank.wheel for blank in group), group[0].thickness)
        for name, group in zip(names, alike.values(), strict=True)
    )


def file_names(names: Iterable[str]) -> list[str]:
    """Return file names that are valid on every file system and remain unique if case is ignored."""
    used: set[str] = set()
    found = []
    for name in names:
        # at most 80 characters, so that paths stay below the limits of file systems
        base = re.sub(r"[^\w.+-]+", "-", name).strip("-.")[:80] or "part"
        stem = base = f"part-{base}" if _RESERVED.match(base) else base
        count = 1
        while stem.lower() in used:  # some file systems ignore case
            count += 1
            stem = f"{base}-{count}"
        used.add(stem.lower())
        found.append(stem)
    return found


def _shape(blank: Blank) -> object:
    # rounded to 1e-6 mm, so that rounding errors do not distinguish equal wheels
    outline = tuple(contour.points.round(6).tobytes() for contour in blank.contours)
    return blank.form, round(blank.thickness, 6), outline


def _drawing(group: list[Blank]) -> FlatDrawing:
    blank = group[0]
    names = ", ".join(each.wheel for each in group)
    what = "pins" if blank.kind == "pins" else "teeth"
    often = f", {len(group)} times" if len(group) > 1 else ""
    title = (
        f"{names}{often}: {blank.teeth} {what}{' inside' if blank.kind == 'ring' else ''}, {blank.form}, module "
        f"{blank.module:.6g} mm, pitch diameter {2 * blank.pitch_radius:.4f} mm, thickness {blank.thickness:.4g} mm"
        + (f", bore {blank.bore:.4g} mm" if blank.bore else "")
        + (f", {blank.arms} spokes" if blank.arms else "")
    )
    inner, outer = blank.bore / 2, min(blank.root_radius, blank.tip_radius)
    if blank.kind == "ring":
        inner, outer = blank.root_radius, float(abs(blank.contours[0].points).max())
    elif blank.arms:
        inner = outer - RIM * blank.module  # on the rim, because below it there are only spokes
    height = min(_LETTER_SHARE * (outer - inner), _MAXIMUM, 1.6 * outer / max(len(names), 1))
    mark = _label_off_holes(_holes(blank), EngravedText(names, (0.0, (inner + outer) / 2), height), inner, outer)
    return FlatDrawing(title, blank.contours, (Contour.circle(blank.pitch_radius),), (mark,))


def _holes(blank: Blank) -> list[tuple[complex, float]]:
    """Return centre and radius of a circle around each hole of a wheel [mm], except bore and windows of spokes."""
    own = blank.contours[1:] if blank.kind == "external" else blank.contours[2:]
    found = []
    for hole in own if not blank.arms and blank.kind != "pins" else ():
        # chords within 0.05 mm are accurate enough for a label
        points = hole.flattened(0.05) @ np.array([1, 1j])
        middle = complex(points.mean())
        if abs(middle) > _CENTRAL:
            found.append((middle, float(abs(points - middle).max())))
    return found


def _label_off_holes(
    holes: list[tuple[complex, float]], mark: EngravedText, inner: float, outer: float
) -> EngravedText:
    """Return engraved text moved off the holes, between two radii, in the largest size that fits, or unchanged."""

    def free(at: complex, along: complex, height: float) -> bool:
        half, tall = _LETTER_WIDTH * height * len(mark.text) / 2, height / 2
        # the corners of the frame of the text, and the middles of its long sides
        corners = [abs(at + along * complex(x, y)) for x in (-half, 0.0, half) for y in (-tall, tall)]
        if max(corners) > outer or min(corners) < inner:
            return False
        # holes in the frame of the text, where the text is a rectangle parallel to the axes
        seen = [((middle - at) * along.conjugate(), radius) for middle, radius in holes]
        return all(hypot(max(abs(z.real) - half, 0), max(abs(z.imag) - tall, 0)) > radius + _GAP for z, radius in seen)

    if not holes or free(complex(*mark.at), 1 + 0j, mark.height):
        return mark
    # the largest free text: try all positions at one height before a smaller height
    for part in _SMALLER:
        height = part * mark.height
        for step in range(_WAYS):
            out = 1j * exp(-2j * pi * step / _WAYS)
            for away in np.linspace(outer - height / 2, inner + height / 2, _STEPS).tolist():
                if free(out * away, -1j * out, height):
                    at = out * away
                    return EngravedText(mark.text, (at.real, at.imag), height, -360 * step / _WAYS)
    return mark


# -------------------------------------------------------------------------------------------------------------- plates

_LETTER = 1.8  # mm: height of letters next to holes


def _sheet(plate: FlatPlate) -> Plate:
    x, y = plate.at
    marks = tuple(
        EngravedText(hole.name, (hole.at[0] - x, hole.at[1] - y - hole.diameter / 2 - 0.7 * _LETTER), _LETTER)
        for hole in plate.holes
        if hole.name not in ("pillar", "post", "pin", "hub")
    )
    sizes = ", ".join(dict.fromkeys(f"{hole.name} {hole.diameter:.4g}" for hole in plate.holes))
    title = f"{plate.name}: thickness {plate.high - plate.low:.4g} mm, scale 1:1; holes (mm): {sizes}"
    drawing = FlatDrawing(title, plate.contours, marks=marks)
    return Plate(plate.link, plate.name.replace(" ", "-"), drawing, plate.high - plate.low)


# ---------------------------------------------------------------------------------------------------------------- kerf

_AROUND = 16  # chords per quarter circle around a corner


def compensated(drawing: FlatDrawing, kerf: float) -> FlatDrawing:
    """Return a drawing with outer edges offset outwards, and holes inwards, by half the kerf [mm].

    Curves other than circles are replaced by chords within the tolerance of the drawing. Raises `GearTrainError` if a
    hole or slot is narrower than the cut, and `MissingExtraError` if shapely is not installed.
    """
    if not kerf:
        return drawing
    cut = tuple(_offset(contour, kerf / 2, at > 0, drawing) for at, contour in enumerate(drawing.cut))
    return replace(drawing, title=f"{drawing.title}, compensated for a kerf of {kerf:g} mm", cut=cut)


def _offset(contour: Contour, by: float, is_hole: bool, drawing: FlatDrawing) -> Contour:
    by = -by if is_hole else by  # half of the cut is lost on each side, so outlines grow and holes shrink
    if contour.is_circle:
        centre = contour.points.mean(axis=0)
        radius = float(abs(contour.points[0] - centre).max()) + by
        if radius > 0:
            return Contour.circle(radius, (float(centre[0]), float(centre[1])))
        raise _too_narrow(drawing, -2 * by)
    try:
        from shapely import Polygon
    except ImportError:
        raise MissingExtraError("shapely", "proof", "an outline compensated for its kerf") from None
    found = Polygon(contour.flattened(drawing.tolerance)).buffer(by, quad_segs=_AROUND)
    if found.is_empty or found.geom_type != "Polygon":  # the offset hole has vanished or has been split
        raise _too_narrow(drawing, 2 * abs(by))
    ring = np.array(found.exterior.coords)[:-1]  # without the closing point
    return Contour.of([(x, y, 0.0) for x, y in (ring if found.exterior.is_ccw else ring[::-1])])


def _too_narrow(drawing: FlatDrawing, kerf: float) -> GearTrainError:
    name = drawing.title.split(":")[0]
    what = f"'{name}' has a hole or a slot narrower than the cut"
    why = f"the cut (kerf) is {kerf:g} mm wide"
    return GearTrainError(Problem(what, why, "give a larger --module or --bore, or another --process", "--process"))


# --------------------------------------------------------------------------------------------------------------- stock

_CHORD = 0.005  # mm: maximum deviation of chords from a curve


def stock_sheets(parts: Iterable[Sheet], size: tuple[float, float], gap: float) -> tuple[Sheet, ...]:
    """Return sheets of stock on which all parts are laid out; the parts of a sheet have the same thickness.

    The algorithm is next-fit decreasing height (Coffman et al. 1980, SIAM J. Comput. 9, 808). Raises `QuestionError` if
    a part is larger than the sheet.

    size   width and height of a sheet [mm]
    gap    minimum distance between parts, and between a part and the edge of the sheet [mm]
    """
    alike: dict[float, list[Sheet]] = {}
    for part in parts:
        alike.setdefault(float(f"{part.thickness:g}"), []).append(part)  # rounded as in the name of the file
    found = []
    for thickness, group in sorted(alike.items()):
        pieces = [_fitted_to_sheet(part, size, gap) for part in group for _ in part.parts]
        for number, placed in enumerate(_rows(pieces, size, gap), 1):
            found.append(_stock_sheet(f"sheet-{thickness:g}mm-{number}", placed, size, thickness))
    return tuple(found)


def _fitted_to_sheet(part: Sheet, size: tuple[float, float], gap: float) -> Sheet:
    """Return a part rotated to fit on a sheet, if possible with its longer side along the width of the sheet."""
    low, high = _box(part.drawing)
    wide, tall = (high - low).tolist()
    room = [side - 2 * gap for side in size]
    sides = {False: (wide, tall), True: (tall, wide)}
    ways = [way for way in (tall > wide, tall <= wide) if sides[way][0] <= room[0] and sides[way][1] <= room[1]]
    if not ways:
        what = f"'{part.file}' does not fit on a sheet of {size[0]:g} x {size[1]:g} mm"
        why = f"it measures {wide:.4g} x {tall:.4g} mm, plus a gap of {gap:g} mm on all sides"
        raise QuestionError(Problem(what, why, "give a larger --sheet, or a smaller --module", "--sheet"))
    # points are rows, so this is the transpose of a rotation by +90 degrees
    quarter = np.array([[0.0, 1.0], [-1.0, 0.0]])
    return replace(part, drawing=_moved(part.drawing, quarter, np.zeros(2), 90.0)) if ways[0] else part


def _rows(pieces: list[Sheet], size: tuple[float, float], gap: float) -> Iterator[list[Sheet]]:
    """Yield the pieces of each sheet, shifted to their positions in rows; `size` and `gap` of the sheets are in mm."""
    boxes = [_box(piece.drawing) for piece in pieces]
    order = sorted(range(len(pieces)), key=lambda at: -float(np.ptp(boxes[at], axis=0)[1]))
    sheet: list[Sheet] = []
    x = y = gap
    row = 0.0  # height
    for at in order:
        low, high = boxes[at]
        wide, tall = (high - low).tolist()
        if x + wide + gap > size[0]:
            x, y, row = gap, y + row + gap, 0.0
        if y + tall + gap > size[1]:
            yield sheet
            sheet, x, y, row = [], gap, gap, 0.0
        sheet.append(replace(pieces[at], drawing=_moved(pieces[at].drawing, np.eye(2), np.array([x, y]) - low, 0.0)))
        x, row = x + wide + gap, max(row, tall)
    if sheet:
        yield sheet


def _stock_sheet(file: str, placed: list[Sheet], size: tuple[float, float], thickness: float) -> Sheet:
    border = Contour.of([(0, 0, 0), (size[0], 0, 0), (*size, 0), (0, size[1], 0)])
    title = f"{file}: {len(placed)} parts on {size[0]:g} x {size[1]:g} mm, scale 1:1"
    cut = tuple(contour for piece in placed for contour in piece.drawing.cut)
    marks = tuple(mark for piece in placed for mark in piece.drawing.marks)
    lines = tuple(line for piece in placed for line in piece.drawing.lines)
    tolerance = min(piece.drawing.tolerance for piece in placed)
    drawing = FlatDrawing(title, cut, (border,), marks, tolerance, lines)
    return Sheet(file, drawing, tuple(piece.file for piece in placed), thickness)


def _box(drawing: FlatDrawing) -> tuple[Floats, Floats]:
    points = drawing.cut[0].flattened(_CHORD)
    # an arc may extend beyond its chords by this deviation
    return points.min(axis=0) - _CHORD, points.max(axis=0) + _CHORD


def _moved(drawing: FlatDrawing, turn: Floats, by: Floats, degrees: float) -> FlatDrawing:
    """Return a drawing rotated by the matrix `turn` (an angle of `degrees`) and then shifted by `by` [mm]."""
    cut = tuple(Contour(each.points @ turn + by, each.bulges) for each in drawing.cut)
    spots = [(np.array(mark.at) @ turn + by).tolist() for mark in drawing.marks]
    marks = tuple(
        replace(mark, at=(x, y), angle=mark.angle + degrees) for mark, (x, y) in zip(drawing.marks, spots, strict=True)
    )
    return replace(drawing, cut=cut, pitch=(), marks=marks, lines=tuple(line @ turn + by for line in drawing.lines))
