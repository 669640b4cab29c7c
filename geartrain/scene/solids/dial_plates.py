"""Plates of dials in front of and behind a mechanism: their sizes, heights, holes, scales and feet."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import cos, dist, hypot, inf, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import cross, dot
from geartrain.scene.dial_scale import DialScale, engrave
from geartrain.scene.parts.frame_plan import FramePlan
from geartrain.scene.parts.pillar_places import clear_of, far_apart, pillar_places
from geartrain.scene.parts.stack_discs import Point, swept_circle
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import EngravedText, FlatDrawing, around
from geartrain.scene.stroke_letters import text_length
from geartrain.teeth.outlines.contour import Contour
from geartrain.train.outputs import DEPTH

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.arbor_columns import AxisColumn
    from geartrain.scene.train_scene import DialFace, Scene
    from geartrain.train.outputs import FacePlate

THICKNESS = 1.5
"""Default thickness of a plate of dials [mm]."""
_AWAY = 2.0  # mm from turning parts to a dial
_ROOM = 0.5  # mm of clearance round the arbor of its pointer
_BESIDE = 1.0  # mm from a dial's edge to the arbor of another
_SCALE, _LETTER = 0.965, 0.055  # radius of the scale, and height of letters, divided by the radius of a dial
_SMALLEST = 1.2  # mm: minimum height of letters
_CORNER = 6.0  # mm from the sides of a rectangular plate to the middle of a foot
_LAND = 1.0  # mm: width of plate round the end of a foot
_SIDES = 48  # points of a circle for a convex hull
_SAME = 1e-6


@dataclass(frozen=True, slots=True)
class DialCircle:
    """Disc that contains all dials about one axis, with their scales."""

    at: Point
    """Centre of the disc, in the coordinates of the stack [mm]."""
    radius: float
    """Radius of the disc, slightly larger than the largest scale [mm]."""
    hole: float
    """Diameter of the hole for the arbors of the pointers [mm]."""
    scales: dict[str, DialScale]
    radii: dict[str, float]
    """Radius of the scale of each dial [mm], by name of the dial."""

    def lines(self) -> Iterator[Floats]:
        """Yield the engraved lines, including letters, in coordinates relative to the centre of the disc [mm]."""
        for name, scale in self.scales.items():
            for each in engrave(scale):
                yield from (self.radii[name] * np.array(line) for line in each.lines)

    def marks(self) -> Iterator[EngravedText]:
        """Yield the names of dials that fit below the hole, with positions relative to the centre of the disc [mm]."""
        height = max(_LETTER * self.radius, _SMALLEST)
        inside = min(self.radii.values()) * (1 - DEPTH)
        for depth, name in enumerate(self.scales):
            low = self.hole / 2 + (1.2 + 1.4 * depth) * height
            if hypot(text_length(name) * height / 2, low + height / 2) < inside:
                yield EngravedText(name, (0.0, -low), height)


@dataclass(frozen=True, slots=True)
class DialPlate:
    """Plate with all dials on one side of the frame, as engraved."""

    name: str
    """Name of the plate, which consists of "dial" and the names of its dials."""
    low: float
    """Height of the plate's lower face along the normal of the frame plates [mm]."""
    high: float
    """Height of the plate's upper face along the normal of the frame plates [mm]."""
    circles: tuple[DialCircle, ...]
    """Discs of the dials, one for each axis of pointers."""
    feet: tuple[TurnedPart, ...]
    """Pins that support the plate in front of a plate of the frame."""
    right: Point
    """Unit vector that points to the right for the reader of the plate, in the coordinates of the stack."""
    up: Point
    """Unit vector that points up for the reader of the plate, in the coordinates of the stack."""
    corners: tuple[Point, ...] = ()
    """Corners of a rectangular plate in the stack [mm]; empty if the edge follows the outlines of the dials."""

    @property
    def at(self) -> Point:
        """Origin of the coordinates of the plate [mm]: the centre of the first dial."""
        return self.circles[0].at

    @property
    def contours(self) -> tuple[Contour, ...]:
        """Edge of the plate, then its holes for pointers and feet, in stack coordinates relative to `at` [mm]."""
        return self._contours(self._own)

    def _own(self, point: Point) -> Point:
        return point[0] - self.at[0], point[1] - self.at[1]

    def _seen(self, point: Point) -> Point:
        """Return the position of a point to the right and upwards, as seen by the reader of the plate [mm]."""
        x, y = self._own(point)
        return x * self.right[0] + y * self.right[1], x * self.up[0] + y * self.up[1]

    def _contours(self, place: Callable[[Point], Point]) -> tuple[Contour, ...]:
        holes = [(each.at, each.hole / 2) for each in self.circles]
        holes += [(each.at, each.bands[0].radius) for each in self.feet]
        return self._edge(place), *(Contour.circle(radius, place(at)) for at, radius in holes)

    def _edge(self, place: Callable[[Point], Point]) -> Contour:
        """Return the edge of the plate: a declared rectangle, the disc of one dial, or a curve around all dials."""
        first, wide = self.circles[0], FOOT_RADIUS + _LAND
        if self.corners:
            return around([place(point) for point in _inset(self.corners, wide)], wide)
        if len(self.circles) == 1 and all(dist(each.at, first.at) + wide < first.radius + _SAME for each in self.feet):
            return Contour.circle(first.radius, place(first.at))
        turns = [2 * pi * k / _SIDES for k in range(_SIDES)]
        rims = [
            (each.at[0] + (each.radius - wide) * cos(turn), each.at[1] + (each.radius - wide) * sin(turn))
            for each in self.circles
            for turn in turns
        ]
        return around([place(point) for point in (*rims, *(foot.at for foot in self.feet))], wide)

    def drawing(self) -> FlatDrawing:
        """Return the drawing of the engraved plate as seen by the reader, with zero marks at the top."""
        title = f"{self.name}: thickness {self.high - self.low:.4g} mm, scale 1:1, front view; "
        scales = {name: scale for circle in self.circles for name, scale in circle.scales.items()}
        title += ", ".join(f"{name} {scale.divisions} cells" for name, scale in scales.items())
        marks: list[EngravedText] = []
        lines: list[Floats] = []
        for circle in self.circles:
            x, y = self._seen(circle.at)
            marks += (replace(each, at=(each.at[0] + x, each.at[1] + y)) for each in circle.marks())
            lines += (line + np.array([x, y]) for line in circle.lines())
        return FlatDrawing(title, self._contours(self._seen), marks=tuple(marks), lines=tuple(lines))


def dial_plates(scene: Scene, plan: FramePlan, thickness: float = THICKNESS) -> list[DialPlate]:
    """Return the plates of dials, at most one for each side, with all upright dials that a pointer's arbor reaches."""
    stack, columns = plan.stack, {column.axis: column for column in plan.columns}
    groups: dict[int, dict[str, list[DialFace]]] = {}
    for face in scene.dials:
        side = dot(face.normal, stack.normal)
        axis = next(
            (label for label, column in columns.items() if dist(column.at, stack.flat(face.centre)) < _SAME), None
        )
        upright = face.look == "scale" and abs(abs(side) - 1) < _SAME
        if scene.bodies[face.body].id == stack.frame and axis is not None and upright:
            groups.setdefault(1 if side > 0 else -1, {}).setdefault(axis, []).append(face)
    found = (_plate(side, by_axis, columns, plan, thickness) for side, by_axis in groups.items())
    return [plate for plate in found if plate is not None]


def _plate(
    side: int,
    by_axis: Mapping[str, Sequence[DialFace]],
    columns: Mapping[str, AxisColumn],
    plan: FramePlan,
    thickness: float,
) -> DialPlate | None:
    """Return the plate of dials on one side; None if no pointer's arbor reaches it, or its dials do not fit.

    side   1 above the wheels, -1 below them
    """
    ends = [face for disc in plan.discs for face in (disc.low, disc.high)]
    ends += [*plan.places.back, *plan.places.front, *(plan.bridge or ())]
    ends += [face for each in plan.wheels_across for face in (each.low, each.high) if plan.has_sized_dials]
    near = (max(ends) if side > 0 else min(ends)) + side * _AWAY
    low, high = sorted((near, near + side * thickness))
    found = (_circle(columns[axis], faces, plan, (low, high)) for axis, faces in by_axis.items())
    circles = tuple(circle for circle in found if circle is not None)
    if not circles:
        return None
    name = f"dial {' and '.join(name for circle in circles for name in circle.scales)}"
    first = next(iter(by_axis.values()))[0]
    right, up = (plan.stack.flat(way) for way in (cross(first.zero, first.normal), first.zero))
    corners = _corners(plan.stack.train.declaration.dial_plate, right, up)
    spots = _inset(corners, _CORNER) if corners else ()
    feet = dial_feet(plan, name, [(each.at, each.radius) for each in circles], (low, high), spots)
    return DialPlate(name, low, high, circles, tuple(feet), right, up, corners)


def _corners(sheet: FacePlate | None, right: Point, up: Point) -> tuple[Point, ...]:
    """Return the corners of a declared dial plate, in the coordinates of the stack [mm]; empty if none is declared.

    right, up   unit vectors of the reader of the plate in the plane of the stack
    """
    if sheet is None:
        return ()
    wide, high = float(millimetres(sheet.width)) / 2, float(millimetres(sheet.height)) / 2
    x, y = (0.0, 0.0) if sheet.centre is None else (float(millimetres(each)) for each in sheet.centre)
    seen = ((x + u * wide, y + v * high) for u, v in ((1, 1), (-1, 1), (-1, -1), (1, -1)))
    return tuple((a * right[0] + b * up[0], a * right[1] + b * up[1]) for a, b in seen)


def _inset(corners: Sequence[Point], far: float) -> tuple[Point, ...]:
    """Return the corners of a rectangle whose sides are moved inwards by the distance `far`."""
    found = []
    for at, (x, y) in enumerate(corners):
        for u, v in (corners[at - 1], corners[(at + 1) % 4]):
            share = far / dist((u, v), corners[at])
            x, y = x + share * (u - corners[at][0]), y + share * (v - corners[at][1])
        found.append((x, y))
    return tuple(found)


def _circle(
    column: AxisColumn, faces: Sequence[DialFace], plan: FramePlan, heights: tuple[float, float]
) -> DialCircle | None:
    through = column.radius(*heights)
    if not through:
        return None
    radius = max(face.radius for face in faces)
    if plan.stack.train.declaration.dials[max(faces, key=lambda each: each.radius).id].diameter is not None:
        radius = radius / _SCALE
    else:  # clear of other arbors and of wheels on crossing axes
        for other in plan.columns:
            if other.axis != column.axis and (rod := other.radius(*heights)):
                radius = min(radius, dist(other.at, column.at) - rod - _BESIDE)
        radius = min(radius, clear_of(column.at, plan.across(*heights)) - _BESIDE)
    hole = 2 * (through + _ROOM)
    if radius <= hole:
        return None
    # nested dials keep their relative sizes
    share = _SCALE * radius / max(face.radius for face in faces)
    ordered = sorted(faces, key=lambda each: -each.radius)
    scales, radii = {face.id: face.scale for face in ordered}, {face.id: share * face.radius for face in ordered}
    return DialCircle(column.at, radius, hole, scales, radii)


# ----------------------------------------------------------------------------------------------------------------- feet

FOOT_RADIUS = 1.5  # mm; its ends in the plates are thinner
_TENON = 0.6
_GAP = 0.5  # mm of clearance between a foot and turning parts
_FEET, _MOST, _WAYS = 3, 4, 48
_SHARES = 0.92, 0.8, 0.65, 0.5, 0.35  # candidate distances of a foot from the centre, over the radius of the dial
_EDGE = 1.0  # mm: width of dial round the end of a foot
_STEPS = 32  # samples from the centre of a dial to a foot, at which the edge between them is tested


def dial_feet(
    plan: FramePlan,
    name: str,
    circles: Sequence[tuple[Point, float]],
    faces: tuple[float, float],
    corners: Sequence[Point] = (),
) -> list[TurnedPart]:
    """Return up to four feet of a plate of dials, at its declared corners, inside its dials or outside moving parts.

    circles   centres and radii of the discs of the dials [mm]
    faces     heights of the faces of the plate [mm]
    """
    above = faces[0] > plan.places.front[1]
    plate = plan.places.front if above else plan.places.back
    low, high = (plate[1], faces[0]) if above else (faces[1], plate[0])
    turning = list(_between(plan, low, high))
    tried = list(corners)
    # declared corners replace the positions in the dials
    candidates = [] if corners else product(circles, _SHARES, range(_WAYS))
    for ((x, y), radius), share, way in candidates:
        away, turn = min(share * radius, radius - FOOT_RADIUS - _EDGE), 2 * pi * (way + 0.5) / _WAYS
        tried.append((x + away * cos(turn), y + away * sin(turn)))
    free = [spot for spot in tried if clear_of(spot, turning) > FOOT_RADIUS + _GAP]
    spots = far_apart(free, free[0], _MOST) if free else []
    if len(spots) < _FEET or max(dist(one, other) for one, other in combinations(spots, 2)) < circles[0][1]:
        even = len({column.at for column in plan.columns}) == 1  # same condition as for pillars
        spots = pillar_places(
            [at for at, _ in circles],
            turning,
            FOOT_RADIUS,
            lambda spot: _reaches(spot, circles, plan.across(*faces)) > 0,
            even,
        )
    ends = (plate, faces) if above else (faces, plate)
    return [_foot(plan, f"{name} foot {number}", spot, ends) for number, spot in enumerate(spots, 1)]


def _between(plan: FramePlan, low: float, high: float) -> Iterator[tuple[Point, float]]:
    """Yield circles that contain the fixed and turning parts between two heights, each as centre and radius [mm]."""
    yield from (swept_circle(disc) for disc in plan.discs if disc.low < high and low < disc.high)
    yield from ((column.at, wide) for column in plan.columns if (wide := column.radius(low, high)))
    yield from plan.across(low, high)


def _reaches(spot: Point, dials: Sequence[tuple[Point, float]], others: Sequence[tuple[Point, float]]) -> float:
    """Return the clearance [mm] between `others` and a strip that joins each dial to a foot at `spot`."""
    minimum = inf
    for (x, y), radius in dials:
        for step in range(_STEPS + 1):
            t = step / _STEPS
            at = x + t * (spot[0] - x), y + t * (spot[1] - y)
            minimum = min(minimum, clear_of(at, others) - (radius + t * (FOOT_RADIUS + _EDGE - radius)))
    return minimum


def _foot(plan: FramePlan, name: str, at: Point, ends: tuple[tuple[float, float], ...]) -> TurnedPart:
    below, above = ends
    thin = _TENON * FOOT_RADIUS
    bands = Band(*below, thin), Band(below[1], above[0], FOOT_RADIUS), Band(*above, thin)
    return TurnedPart(plan.stack.frame, name, "foot", at, bands, f"in both plates, {plan.process.joint}")
