"""List of the parts of an export, with count, material, size, mass and fits of each part; also in CSV format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.files import csv_text
from geartrain.numerics.results import Shown
from geartrain.train.declaration import material_named

if TYPE_CHECKING:
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart
    from geartrain.train import Wheel

_STEEL = ("arbor", "stud", "pin", "eccentric", "cock", "rod")
_STOCK = {"laser": "acrylic", "fdm": "PLA"}  # of flat parts; brass for any other process
_SAME = 4  # decimals of a mm to which sizes are rounded and compared


@dataclass(frozen=True, slots=True)
class ListedPart(Shown):
    """Row of a parts list, which describes all parts of the same shape."""

    names: tuple[str, ...]
    """Names of the parts of this shape."""
    kind: str
    """Kind of part, such as wheel, plate, arbor, pipe, stud, collar or pin."""
    material: str
    """Name of the material from which the mass is computed."""
    size: str
    """Text with diameter and length of turned parts, or thickness of flat parts [mm]."""
    mass: float
    """Mass of one part [g]."""
    fits: str
    """Description of the holes or seats of the part and of the joining method; empty if there are none."""

    @property
    def count(self) -> int:
        """Number of parts of this shape."""
        return len(self.names)


def parts_list(work: SolidModel) -> list[ListedPart]:
    """Return the list of all parts of a train, with one row for all parts of the same shape."""
    alike: dict[tuple[object, ...], ListedPart] = {}
    for part in work.parts:
        row = ListedPart(
            (part.name,), part.kind, material_of(work, part), _size(part), 0.0, "; ".join(_fits(work, part))
        )
        # volumes to two decimals separate shapes of equal size, but not mirrored shapes that differ due to rounding
        volume = _volume(part)
        key = (row.kind, row.size, row.fits, round(volume, 2))
        wheel, declared = _wheel(work, part), work.train.declaration
        own = None if wheel is None else wheel.density or declared.density
        density = own or material_named(declared, row.material).density
        # 1 mm3 times 1 kg/m3 is 1e-6 g
        row = replace(row, mass=0.0 if density is None else volume * density.si / 1e6)
        known = alike.get(key)
        alike[key] = row if known is None else replace(known, names=(*known.names, part.name))
    return list(alike.values())


def material_of(work: SolidModel, part: SolidPart) -> str:
    """Return the name of the material of a part: as declared, or typical of its kind and process."""
    declared = work.train.declaration
    wheel = _wheel(work, part)
    own = None if wheel is None else wheel.material or declared.material
    if own is None and part.kind == "arbor" and part.turned is not None:
        arbor = declared.links[part.turned.link].arbor
        own = None if arbor is None else arbor.material
    if own is not None:
        return own
    if part.kind in _STEEL:
        return "steel"
    if part.kind == "weight":
        return "lead"
    return _STOCK.get(work.process.name, "brass") if part.turned is None else "brass"


def _wheel(work: SolidModel, part: SolidPart) -> Wheel | None:
    return work.train.declaration.wheels[part.name][1] if part.kind == "wheel" else None


def _volume(part: SolidPart) -> float:
    """Return the volume of a part [mm3]: exact for turned and flat parts, and from triangles for other parts."""
    if part.turned is not None:
        return part.turned.volume
    if part.contours:
        outer, *holes = (abs(contour.moments()[0]) for contour in part.contours)
        return (outer - sum(holes)) * part.height
    corners = part.solid.vertices[part.solid.faces]
    # divergence theorem: sum of the signed tetrahedra between the origin and each triangle
    return abs(float(np.linalg.det(corners).sum())) / 6


def _size(part: SolidPart) -> str:
    if part.turned is not None:
        low, high = part.turned.ends
        bore = 2 * part.turned.bands[0].bore
        inside = f", bore {round(bore, _SAME):g}" if bore else ""
        return f"diameter {round(part.turned.diameter, _SAME):g}, length {round(high - low, _SAME):g}{inside}"
    if part.contours:
        return f"thickness {round(part.height, _SAME):g}"
    return "illustration only, not to be cut"


def _fits(work: SolidModel, part: SolidPart) -> Iterator[str]:
    blank = work.blanks.wheels.get(part.name) if part.kind == "wheel" else None
    if blank is not None:
        eccentrics = () if work.frame is None else work.frame.plan.stack.eccentrics
        on = next((each for each in eccentrics if part.name in each.wheels), None)
        if work.frame is not None and part.name in work.frame.plan.cut:
            yield "one piece with its arbor"
        elif blank.bore:
            seat = work.process.joint if on is None else f"{'turns on' if on.wave is None else 'bent by'} {on.name}"
            yield f"bore {round(blank.bore, _SAME):g}, {seat}"
    if part.turned is not None and part.turned.joint:
        yield part.turned.joint


def to_csv(rows: Iterable[ListedPart]) -> str:
    """Return the parts list in CSV format, with one row for all parts of the same shape."""
    head = ("part", "count", "kind", "material", "size_mm", "mass_g", "fits")
    cells = [
        (", ".join(row.names), row.count, row.kind, row.material, row.size, f"{row.mass:.4g}", row.fits) for row in rows
    ]
    return csv_text(head, cells)
