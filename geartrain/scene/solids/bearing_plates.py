"""Full-scale drawings of flat parts, curves around holes, and discs that carry pins or slots. Lengths are in mm, y is
up.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import asin, atan2, cos, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem
from geartrain.teeth.couplings.pins import Parallel, PinsInHoles
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.wheel_outline import WheelOutline

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.couplings.pins import PinCoupling

CUT, PITCH, ENGRAVE = "CUT", "PITCH", "ENGRAVE"
LAYERS = (CUT, PITCH, ENGRAVE)
"""Names of the layers of a drawing: contours to cut, circles for orientation (pitch circles), and engraved letters."""

MARGIN = 2.0  # mm of margin round the part
_MANY = 64  # number of vertices above which they bound a contour sufficiently
TOLERANCE = 0.001  # mm: tolerance of chords


@dataclass(frozen=True, slots=True)
class EngravedText:
    """Text with its centre [mm], the height of its letters [mm], and its angle from the x axis [degrees]."""

    text: str
    at: tuple[float, float]
    height: float
    angle: float = 0.0


@dataclass(frozen=True, slots=True)
class FlatDrawing:
    """Drawing of one flat part at full scale (1:1), with contours to cut, curves for orientation and engraving [mm]."""

    title: str
    """Title of the drawing, on one line."""
    cut: tuple[Contour, ...]
    """Closed curves to cut: first the outer curve, then the holes."""
    pitch: tuple[Contour, ...] = ()
    """Curves that are not cut, such as pitch circles and the edge of a sheet."""
    marks: tuple[EngravedText, ...] = ()
    tolerance: float = TOLERANCE
    lines: tuple[Floats, ...] = ()
    """Polylines to be engraved [mm], shape (n, 2) each."""

    @property
    def box(self) -> tuple[Floats, Floats]:
        """Minimum x and y, and maximum x and y, of all contours [mm], including a margin."""
        contours = self.cut[0], *self.pitch
        points = np.concatenate([c.points if len(c.points) > _MANY else c.flattened(0.01) for c in contours])
        return points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN


def wheel_drawing(wheel: WheelOutline) -> FlatDrawing:
    """Return the drawing of one wheel of a gear pair, with its data in the title."""
    what = "pins" if wheel.kind == "pins" else "teeth"
    title = (
        f"{wheel.z} {what}, module {wheel.module:g} mm, pitch diameter {2 * wheel.pitch_radius:.4f} mm, "
        f"backlash {wheel.backlash:.4g} mm, centre distance {wheel.centre_distance:.4f} mm"
    )
    return FlatDrawing(title, wheel.contours, tolerance=wheel.tolerance)


# --------------------------------------------------------------------------------------------------- curves round holes


Point = tuple[float, float]

_DISC = 3.0  # mm: thickness of discs that carry pins or slots
_LAND = 3.0  # mm: width of plate round a hole
_PIN = 0.25  # diameter of a pin divided by its distance from the axis, at most 2 mm


@dataclass(frozen=True, slots=True)
class Plate:
    """Flat part of a link, with its drawing and its sheet thickness [mm]."""

    link: str
    name: str
    drawing: FlatDrawing
    thickness: float


@dataclass(frozen=True, slots=True)
class Plates:
    """Plates of the couplings of a train, and warnings about parts that could not be drawn."""

    plates: tuple[Plate, ...]
    notices: tuple[Problem, ...]


def coupling_discs(
    couplings: Sequence[PinCoupling], bores: Mapping[str, float], holed: frozenset[str] = frozenset()
) -> Plates:
    """Return the separate discs that carry pins or slots, and warnings about couplings that are not modelled.

    bores   diameters of the holes for arbors, by link [mm]
    holed   names of couplings whose holes are cut into a wheel
    """
    plates: list[Plate] = []
    notices: list[Problem] = []
    for coupling in couplings:
        if isinstance(coupling, Parallel):
            what = f"the mechanism of '{coupling.name}' is not modelled"
            why = "the parts that keep its two links parallel are not declared"
            notices.append(Problem(what, why, "add it by hand, or declare `kind: pins_in_holes`"))
        elif isinstance(coupling, PinsInHoles):
            lacking = "pins" if coupling.name in holed else "pins and holes"
            what = f"the {lacking} of '{coupling.name}' are not modelled"
            why = "they are modelled only if their sizes are declared and both links have sufficiently large wheels"
            fix = "declare pin_radius, offset and pin_diameter, and a wheel on both links, or add these parts by hand"
            notices.append(Problem(what, why, fix))
        elif coupling.pin_radius is None or coupling.offset is None:
            what = f"the pin and slot of '{coupling.name}' are not modelled"
            notices.append(
                Problem(what, "the dimensions of the coupling are not declared", "declare pin_radius and offset")
            )
        else:
            plates.append(_disc(coupling, coupling.pin, bores, slotted=False))
            plates.append(_disc(coupling, coupling.slot, bores, slotted=True))
    return Plates(tuple(plates), tuple(notices))


def around(points: Sequence[Point], radius: float) -> Contour:
    """Return the convex curve of straight edges and arcs at the distance `radius` from the convex hull of points."""
    corners = _hull(points)
    if len(corners) == 1:
        return Contour.circle(radius, corners[0])
    vertices = []
    for at, (x, y) in enumerate(corners):
        before, after = corners[at - 1], corners[(at + 1) % len(corners)]
        first = atan2(y - before[1], x - before[0]) - pi / 2
        last = atan2(after[1] - y, after[0] - x) - pi / 2
        sweep = (last - first) % (2 * pi)
        # the bulge is the tangent of a quarter of the arc's angle
        vertices.append((x + radius * cos(first), y + radius * sin(first), tan(sweep / 4)))
        vertices.append((x + radius * cos(last), y + radius * sin(last), 0.0))
    return Contour.of(vertices)


def _hull(points: Sequence[Point]) -> list[Point]:
    """Return the corners of the convex hull, counter-clockwise from the leftmost; collinear points give two ends."""
    # here, because scenes without plates do not need scipy
    from scipy.spatial import ConvexHull

    # rounded, so that coincident axes are one point
    ordered = sorted({(round(x, 9), round(y, 9)) for x, y in points})
    apart = np.subtract(ordered, ordered[0])
    if np.linalg.matrix_rank(apart, tol=1e-6) < 2:  # mm: a collinear point is not a corner
        return list(dict.fromkeys((ordered[0], ordered[-1])))
    corners = [int(at) for at in ConvexHull(apart).vertices]
    first = corners.index(0)
    return [ordered[at] for at in corners[first:] + corners[:first]]


# ------------------------------------------------------------------------------------------------------ pins and slots


def pin_diameter(radius: float) -> float:
    """Return the default diameter [mm] of a pin that revolves at a given radius: a quarter of it, at most 2 mm."""
    return min(2.0, _PIN * radius)


def slotted_bar(r: float, e: float, pin: float) -> tuple[Contour, ...]:
    """Return the edge and the slot of a bar that extends along x from its axis at the origin [mm].

    The pin revolves at the radius `r` about an axis at the distance `e`. It moves in the slot between |r - e| and r + e
    from the origin. `pin` is the diameter of the pin.
    """
    low, high = abs(r - e), r + e
    return around([(0.0, 0.0), (high, 0.0)], 1.2 * pin), around([(low, 0.0), (high, 0.0)], 0.55 * pin)


def holed_bar(r: float, e: float, pin: float) -> tuple[Contour, ...]:
    """Return the edge and the hole of a bar that extends along x from its axis at the origin [mm].

    A pin of the diameter `pin` moves in the hole, at the radius `r` about an axis at the distance `e`. The bar turns
    with the mean ratio of the coupling. If this ratio is 1 (r > e), the pin moves relative to the bar on a circle of
    radius e about (r, 0); if it is 0, on a circle of radius r about (e, 0).
    """
    wide, hole = 1.2 * pin, min(r, e) + 0.55 * pin
    middle, rim = max(r, e), hole + 0.65 * pin
    aside = asin(wide / rim)
    x = middle - rim * cos(aside)
    # bulge of the arc round the hole, which spans 2 (pi - aside)
    sweep = tan((pi - aside) / 2)
    edge = Contour.of([(0.0, wide, 1.0), (0.0, -wide, 0.0), (x, -wide, sweep), (x, wide, 0.0)])
    return edge, Contour.circle(hole, (middle, 0.0))


def _disc(coupling: PinCoupling, link: str, diameters: Mapping[str, float], slotted: bool) -> Plate:
    """Return the disc that carries the pin of a coupling, or the disc with its slot."""
    assert coupling.pin_radius is not None
    assert coupling.offset is not None
    r, e = coupling.pin_radius.si * 1000, coupling.offset.si * 1000
    pin = pin_diameter(r)
    low, high = (abs(r - e), r + e) if slotted else (r, r)  # ends of the slot, or the pin, as distances from the axis
    # a bore that would meet the slot is reduced
    own = min(diameters.get(link, 0.0), max(2 * (low - pin), 0.0))
    cut = [Contour.circle(high + pin / 2 + _LAND), around([(low, 0.0), (high, 0.0)], pin / 2)]
    if own:
        cut.append(Contour.circle(own / 2))
    what = "slot" if slotted else "pin"
    title = f"{link}: {what} of {coupling.name}, pin {pin:.4g} mm at {r:.6g} mm, axes {e:.6g} mm apart, scale 1:1"
    title += f", thickness {_DISC:g} mm"
    marks = (EngravedText(link, (-(high + pin) / 2, 0.0), 0.6 * _LAND),)
    drawing = FlatDrawing(title, tuple(cut), marks=marks)
    name = f"{what}-{coupling.name}-{link}"
    return Plate(link, name, drawing, _DISC)
