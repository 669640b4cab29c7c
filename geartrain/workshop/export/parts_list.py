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
    """Kind of part: wheel, plate, arbor, pipe, eccentric, stud, collar, spacer, collet, barrel, pillar, post, cock,
    pin, rod, bob or weight.
    """
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
        # 1 mm3 times 1 kg/m3 is 1e-6 g
        row = replace(row, mass=volume * _density(work, part, row.material) / 1e6)
        known = alike.get(key)
        alike[key] = row if known is None else replace(known, names=(*known.names, part.name))
    return list(alike.values())


def material_of(work: SolidModel, part: SolidPart) -> str:
    """Return the name of the material of a part: as declared, or typical of its kind and of the manufacturing
    process.
    """
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


def _density(work: SolidModel, part: SolidPart, material: str) -> float:
    """Return the density of a part [kg/m3]; 0 if its declared material has no density."""
    wheel, declared = _wheel(work, part), work.train.declaration
    own = None if wheel is None else wheel.density or declared.density
    found = own or material_named(declared, material).density
    return 0.0 if found is None else found.si


def _volume(part: SolidPart) -> float:
    """Return the volume of a part [mm3]. It is exact for turned and flat parts, and computed from triangles for other
    parts.
    """
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
        one_piece = work.frame is not None and part.name in work.frame.plan.cut
        if one_piece:
            yield "one piece with its arbor"
        elif blank.bore:
            yield f"bore {round(blank.bore, _SAME):g}, {_eccentric_of(work, part.name) or work.process.joint}"
    if part.turned is not None and part.turned.joint:
        yield part.turned.joint


def _eccentric_of(work: SolidModel, wheel: str) -> str:
    """Return a phrase that names the eccentric on which a wheel turns or which deforms the wheel; empty if there is
    none.
    """
    own = () if work.frame is None else work.frame.plan.stack.eccentrics
    on = next((each for each in own if wheel in each.wheels), None)
    return "" if on is None else f"{'turns on' if on.wave is None else 'bent by'} {on.name}"


def to_csv(rows: Iterable[ListedPart]) -> str:
    """Return the parts list in CSV format, with one row for all parts of the same shape."""
    head = ("part", "count", "kind", "material", "size_mm", "mass_g", "fits")
    return csv_text(
        head,
        [
            (", ".join(row.names), row.count, row.kind, row.material, row.size, f"{row.mass:.4g}", row.fits)
            for row in rows
        ],
    )
