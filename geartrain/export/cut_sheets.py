"""All flat drawings of an export, as they are cut: wheels, plates, and sheets of stock with all of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.export.kerf import compensated
from geartrain.export.nested_sheets import FlatPart, nested_sheets
from geartrain.export.plate_sheets import plate_sheets
from geartrain.export.wheel_sheets import file_names, wheel_sheets
from geartrain.scene.solids.flat_drawing import FlatDrawing

if TYPE_CHECKING:
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.wheel_blanks import Blank


def cut_sheets(work: SolidModel) -> Iterator[tuple[str, FlatDrawing]]:
    """Paths, without suffixes, and drawings, outlines moved by half the kerf of the process."""
    kerf, parts = work.process.kerf, list(_parts(work))
    for folder, part in parts:
        yield f"{folder}/{part.name}", compensated(part.drawing, kerf)
    if work.making.sheet is not None:
        cut = [FlatPart(each.name, compensated(each.drawing, kerf), each.count, each.thickness) for _, each in parts]
        for sheet in nested_sheets(cut, work.making.sheet, 2 * work.process.web):
            yield f"sheets/{sheet.file}", sheet.drawing


def wheel_drawing(work: SolidModel, blank: Blank) -> FlatDrawing:
    """Of one wheel."""
    return compensated(wheel_sheets({blank.wheel: blank})[0].drawing, work.process.kerf)


def _parts(work: SolidModel) -> Iterator[tuple[str, FlatPart]]:
    for each in wheel_sheets(work.blanks.wheels):
        yield "wheels", FlatPart(each.file, each.drawing, len(each.parts), each.thickness)
    plates = plate_sheets(work)
    for plate, name in zip(plates, file_names(plate.name for plate in plates), strict=True):
        yield "plates", FlatPart(name, plate.drawing, 1, plate.thickness)
