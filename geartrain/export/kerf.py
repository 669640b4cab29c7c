"""Outlines moved outwards by half of what a cut takes away, so that the part has its size."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, MissingExtraError, Problem
from geartrain.scene.solids.flat_drawing import FlatDrawing
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from shapely import Polygon

_AROUND = 16  # chords of a quarter turn about a corner


def compensated(drawing: FlatDrawing, kerf: float) -> FlatDrawing:
    """A drawing whose outer edges stand half a kerf further out and whose holes are as much narrower.

    Circles stay circles; of other curves chords within the drawing's tolerance are moved.

    Parameters
    ----------
    drawing : FlatDrawing
        True to size.
    kerf : float
        Width that the cut takes away (mm), 0 or more.

    Raises
    ------
    GearTrainError
        If a hole is narrower than the cut.
    MissingExtraError
        If shapely is not installed.
    """
    if not kerf:
        return drawing
    cut = tuple(_moved(contour, kerf / 2, at > 0, drawing) for at, contour in enumerate(drawing.cut))
    return replace(drawing, title=f"{drawing.title}, compensated for a kerf of {kerf:g} mm", cut=cut)


def _moved(contour: Contour, by: float, is_hole: bool, drawing: FlatDrawing) -> Contour:
    by = -by if is_hole else by
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
    rings = list(_rings(found))
    if len(rings) != 1:
        raise _too_narrow(drawing, 2 * abs(by))
    return Contour.of([(x, y, 0.0) for x, y in rings[0]])


def _rings(shape: Polygon) -> Iterator[np.ndarray]:
    """Outer edges of what is left, without the point that closes them, counter-clockwise."""
    for part in getattr(shape, "geoms", [shape]):
        if not part.is_empty:
            ring = np.array(part.exterior.coords)[:-1]
            yield ring if part.exterior.is_ccw else ring[::-1]


def _too_narrow(drawing: FlatDrawing, kerf: float) -> GearTrainError:
    name = drawing.title.split(":")[0]
    what = f"'{name}' has a hole or a slot narrower than the cut"
    why = f"the cut takes away {kerf:g} mm"
    return GearTrainError(Problem(what, why, "give a larger --module or --bore, or another --process", "--process"))
