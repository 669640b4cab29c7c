"""Drawings of all plates of a train: those of the frame, those that turn, dials, discs of pins and slots."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.scene.solids.bearing_plates import Plate
from geartrain.scene.solids.flat_drawing import EngravedText, FlatDrawing

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plates import FlatPlate
    from geartrain.scene.solids.solid_assembly import SolidModel

_LETTER = 1.8  # mm: height of letters beside holes


def plate_sheets(work: SolidModel) -> list[Plate]:
    """A drawing for each plate."""
    frame = [] if work.frame is None else [_sheet(plate) for plate in work.frame.plates()]
    base = work.train.declaration.frame
    dials = [Plate(base, each.name.replace(" ", "-"), each.drawing(), each.high - each.low) for each in work.dials]
    return [*frame, *dials, *work.couplings.plates]


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
