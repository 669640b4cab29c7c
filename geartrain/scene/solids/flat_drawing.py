"""A flat drawing to scale: what is cut, and beside it what is only marked. Lengths in mm, y upwards."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.wheel_outline import WheelOutline

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

CUT, PITCH, ENGRAVE = "CUT", "PITCH", "ENGRAVE"
LAYERS = (CUT, PITCH, ENGRAVE)
"""Names of the layers: what a laser follows, circles that only guide, and letters."""

MARGIN = 2.0  # mm of white round the part
_MANY = 64  # vertices, which then bound a contour well enough
TOLERANCE = 0.001  # mm, how far a chord may leave a curve


@dataclass(frozen=True, slots=True)
class EngravedText:
    """Letters of some height (mm), their middle at a point (mm), their line turned from the x axis (degrees)."""

    text: str
    at: tuple[float, float]
    height: float
    angle: float = 0.0


@dataclass(frozen=True, slots=True)
class FlatDrawing:
    """One part.

    title   what it is, in a line
    cut     closed curves to cut: the outer one first, then holes
    pitch   what guides and is not cut: pitch circles, the edge of a sheet
    marks   letters that are engraved
    lines   chords that are engraved, (n, 2) each
    """

    title: str
    cut: tuple[Contour, ...]
    pitch: tuple[Contour, ...] = ()
    marks: tuple[EngravedText, ...] = ()
    tolerance: float = TOLERANCE
    lines: tuple[Floats, ...] = ()

    @property
    def box(self) -> tuple[Floats, Floats]:
        """Least and greatest x and y, with white around."""
        points = np.concatenate([_bounds(each) for each in (self.cut[0], *self.pitch)])
        return points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN


def _bounds(contour: Contour) -> Floats:
    """Points that bound a contour but for the margin: of many vertices these themselves."""
    return contour.points if len(contour.points) > _MANY else contour.flattened(0.01)


def wheel_drawing(wheel: WheelOutline) -> FlatDrawing:
    """The outline of a wheel of one pair."""
    what = "pins" if wheel.kind == "pins" else "teeth"
    title = (
        f"{wheel.z} {what}, module {wheel.module:g} mm, pitch diameter {2 * wheel.pitch_radius:.4f} mm, "
        f"backlash {wheel.backlash:.4g} mm, centre distance {wheel.centre_distance:.4f} mm"
    )
    return FlatDrawing(title, wheel.contours, tolerance=wheel.tolerance)
