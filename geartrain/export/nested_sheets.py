"""All flat parts of one thickness laid out on sheets of stock, by a library that packs rectangles."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import ceil

import numpy as np

from geartrain.errors import MissingExtraError, Problem, QuestionError
from geartrain.scene.solids.flat_drawing import EngravedText, FlatDrawing
from geartrain.teeth.outlines.contour import Contour

_GRAIN = 0.01  # mm: the packer counts in whole ones
_ANY = 1 << 20
"""Sheets that there are of a size, at most."""


@dataclass(frozen=True, slots=True)
class FlatPart:
    """A part to be laid out.

    name       on sheets and in lists
    count      how often it is needed
    thickness  of its sheet (mm)
    """

    name: str
    drawing: FlatDrawing
    count: int
    thickness: float


@dataclass(frozen=True, slots=True)
class NestedSheet:
    """One sheet of stock.

    file    its name, without suffix
    parts   names of what lies on it, one for each piece
    filled  area of the parts over that of the sheet
    """

    file: str
    drawing: FlatDrawing
    parts: tuple[str, ...]
    filled: float


def nested_sheets(parts: Iterable[FlatPart], size: tuple[float, float], gap: float) -> tuple[NestedSheet, ...]:
    """Sheets of a size on which all parts lie, those of one thickness together.

    Each part keeps `gap` from others and from the edge; it may be turned by a right angle.

    Parameters
    ----------
    parts : iterable of FlatPart
    size : tuple of float
        Width and height of a sheet (mm).
    gap : float
        Least distance of parts (mm), 0 or more.

    Raises
    ------
    QuestionError
        For a part that is larger than the sheet.
    MissingExtraError
        If rectpack is not installed.
    """
    alike: dict[float, list[FlatPart]] = {}
    for part in parts:
        alike.setdefault(round(part.thickness, 6), []).append(part)
    found: list[NestedSheet] = []
    for thickness, group in sorted(alike.items()):
        pieces = [part for part in group for _ in range(part.count)]
        for placed in _packed(pieces, size, gap):
            number = sum(each.file.startswith(f"sheet-{thickness:g}mm-") for each in found) + 1
            found.append(_sheet(f"sheet-{thickness:g}mm-{number}", placed, size))
    return tuple(found)


def _packed(pieces: list[FlatPart], size: tuple[float, float], gap: float) -> Iterator[list[FlatPart]]:
    """The pieces of each sheet, moved to where they lie."""
    try:
        from rectpack import newPacker
    except ImportError:
        raise MissingExtraError("rectpack", "nest", "parts laid out on sheets") from None
    packer = newPacker(rotation=True)
    room = [_grains(side - gap, up=False) for side in size]
    boxes = []
    for at, piece in enumerate(pieces):
        low, high = _bounds(piece.drawing)
        wide, tall = (_grains(float(side) + gap) for side in high - low)
        if not any(a <= room[0] and b <= room[1] for a, b in ((wide, tall), (tall, wide))):
            raise QuestionError(_too_large(piece, high - low, size))
        boxes.append((low, wide, tall))
        packer.add_rect(wide, tall, rid=at)
    packer.add_bin(*room, count=_ANY)
    packer.pack()
    for bin_ in packer:
        placed = []
        for rect in bin_:
            piece, (low, wide, tall) = pieces[rect.rid], boxes[rect.rid]
            corner = np.array([rect.x, rect.y]) * _GRAIN + gap
            turned = (rect.width, rect.height) != (wide, tall)
            placed.append(replace(piece, drawing=_moved(piece.drawing, low, corner, turned)))
        yield placed


def _sheet(file: str, placed: list[FlatPart], size: tuple[float, float]) -> NestedSheet:
    border = Contour.of([(0, 0, 0), (size[0], 0, 0), (*size, 0), (0, size[1], 0)])
    cut = tuple(contour for piece in placed for contour in piece.drawing.cut)
    # outer curves hold material, holes do not
    area = sum(
        abs(contour.moments()[0]) * (-1 if at else 1)
        for piece in placed
        for at, contour in enumerate(piece.drawing.cut)
    )
    names = tuple(piece.name for piece in placed)
    title = f"{file}: {len(names)} parts on {size[0]:g} x {size[1]:g} mm, scale 1:1"
    marks = tuple(mark for piece in placed for mark in piece.drawing.marks)
    lines = tuple(line for piece in placed for line in piece.drawing.lines)
    tolerance = min(piece.drawing.tolerance for piece in placed)
    drawing = FlatDrawing(title, cut, (border,), marks, tolerance, lines)
    return NestedSheet(file, drawing, names, area / (size[0] * size[1]))


def _bounds(drawing: FlatDrawing) -> tuple[np.ndarray, np.ndarray]:
    points = drawing.cut[0].flattened(_GRAIN / 4)
    return points.min(axis=0) - _GRAIN / 2, points.max(axis=0) + _GRAIN / 2


def _grains(length: float, up: bool = True) -> int:
    return ceil(length / _GRAIN) if up else int(length / _GRAIN)


def _moved(drawing: FlatDrawing, low: np.ndarray, corner: np.ndarray, turned: bool) -> FlatDrawing:
    """With its lower left corner elsewhere, and by a right angle to the left if `turned`."""
    height = _bounds(drawing)[1][1] - low[1]

    def place(points: np.ndarray) -> np.ndarray:
        own = points - low
        if turned:
            own = np.stack([height - own[..., 1], own[..., 0]], axis=-1)
        return np.asarray(own + corner)

    cut = tuple(Contour(place(each.points), each.bulges) for each in drawing.cut)
    marks = tuple(
        EngravedText(each.text, (float(at[0]), float(at[1])), each.height, 90.0 if turned else 0.0)
        for each in drawing.marks
        for at in (place(np.array(each.at)),)
    )
    return replace(drawing, cut=cut, pitch=(), marks=marks, lines=tuple(map(place, drawing.lines)))


def _too_large(piece: FlatPart, extent: np.ndarray, size: tuple[float, float]) -> Problem:
    what = f"'{piece.name}' does not fit on a sheet of {size[0]:g} x {size[1]:g} mm"
    why = f"it is {extent[0]:.4g} x {extent[1]:.4g} mm, and keeps its gap on all sides"
    return Problem(what, why, "give a larger --sheet, or a smaller --module", "--sheet")
