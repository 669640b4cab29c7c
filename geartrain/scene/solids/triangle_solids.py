"""Closed surfaces of triangles: extruded flat shapes, turned parts and wheels.

A polygon with holes is triangulated by ear clipping, after its holes are joined to the outer polygon by bridges
(Eberly, "Triangulation by ear clipping"). A corner is an ear if it is convex and no other point lies in its triangle;
every polygon with more than three corners has an ear (Meisters 1975). The ear with the best aspect ratio is cut off
first, to avoid slivers.

Wheels without planar teeth (bevel wheels, crown wheels, worms) are approximate.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import ceil, dist, pi, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polylines import simplified
from geartrain.scene.layout.wheel_reach import CROWN, LAND, back_of_cone, height_on_cone, taper
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.standard_teeth import MOST_TEETH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel, ToothProfile

    Integers = NDArray[np.int64]
    from geartrain.scene.solids.wheel_blanks import Blank

_FLAT = 1e-12  # mm2: twice the area below which a triangle is degenerate
_NEXT = [1, 2, 0]


def fill(outer: Floats, holes: Sequence[Floats] = ()) -> tuple[Floats, Integers]:
    """Return the points (n, 2) of a polygon and then of its holes, and counter-clockwise triangles (m, 3) of indices.

    Polygons, shape (k, 2), may have either orientation. They must not intersect themselves or each other.
    """
    parts = [outer if area(outer) > 0 else outer[::-1], *(hole if area(hole) < 0 else hole[::-1] for hole in holes)]
    points = np.concatenate(parts)
    starts = np.cumsum([0, *map(len, parts)])
    rings = [list(range(start, end)) for start, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True)]
    loop = rings[0]
    # from the right, ties from the top, so that a bridge does not cross a hole that is not joined yet
    for ring in sorted(rings[1:], key=lambda ring: max(map(tuple, points[ring].tolist())), reverse=True):
        loop = _bridged(points, loop, ring)
    return points, np.array(_ears(points, loop), dtype=np.int64).reshape(-1, 3)


def area(polygon: Floats) -> float:
    """Return the signed area of a polygon in its squared unit, positive for counter-clockwise points."""
    x, y = polygon.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _bridged(points: Floats, loop: list[int], hole: list[int]) -> list[int]:
    """Return the loop joined to a hole by a bridge from the hole's rightmost point to the nearest visible point.

    Only points to the right of the hole are considered. Raise `ValueError` if none is visible.
    """
    at = int(np.lexsort(points[hole].T[::-1])[-1])
    hole = hole[at:] + hole[:at]
    start = points[hole[0]]
    a, b = points[loop], points[loop[1:] + loop[:1]]
    for k in np.argsort(np.hypot(*(a - start).T), kind="stable"):
        end = a[k]
        if tuple(end) <= tuple(start) or not _inside(points, loop, int(k), start):
            continue
        away = (a != end).any(axis=1) & (b != end).any(axis=1)
        cross = (_turn(start, end, a) * _turn(start, end, b) <= 0) & (_turn(a, b, start) * _turn(a, b, end) <= 0)
        if not (cross & away).any():
            return [*loop[: k + 1], *hole, hole[0], *loop[k:]]
    raise ValueError("a hole is not inside its polygon, or intersects it")


def _inside(points: Floats, loop: list[int], k: int, to: Floats) -> bool:
    """Return True if the segment from vertex k of the loop to a point starts inside the loop."""
    before, here, after = points[loop[k - 1]], points[loop[k]], points[loop[(k + 1) % len(loop)]]
    left, right = _turn(here, after, to) > 0, _turn(before, here, to) > 0
    return bool(left and right if _turn(before, here, after) > 0 else left or right)


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    """Return twice the signed area of the triangle a b c; the arguments are broadcast."""
    turn: Floats = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    return turn


def _ears(points: Floats, loop: list[int]) -> list[tuple[int, int, int]]:
    """Return the triangles of a polygon, found by ear clipping. The ear with the best aspect ratio is clipped first."""
    corners = _Corners(points[loop])
    found: list[tuple[int, int, int]] = []
    while corners.left.sum() > 3:
        at = corners.find_ear()
        if corners.turn[at] != 0:
            found.append((loop[corners.before[at]], loop[at], loop[corners.after[at]]))
        corners.cut(at)
    a, b, c = np.flatnonzero(corners.left).tolist()
    return [*found, (loop[a], loop[b], loop[c])]


class _Corners:
    """Corners of a polygon during ear clipping: neighbours, orientation and shape of each corner that is left."""

    def __init__(self, corners: Floats) -> None:
        count = len(corners)
        self.corners, self.left = corners, np.ones(count, bool)
        self.before, self.after = [count - 1, *range(count - 1)], [*range(1, count), 0]
        self.turn, self.fatness = np.zeros(count), np.zeros(count)
        self.blocker = np.full(count, -1)  # a corner known to be in the triangle of each; -1 if unknown
        for at in range(count):
            self._measure(at)

    def find_ear(self) -> int:
        """Return the ear with the best aspect ratio, or the flattest corner if no corner is an ear."""
        while True:
            tried = self.left & (self.turn > _FLAT) & ~((self.blocker >= 0) & self.left[self.blocker])
            if not tried.any():  # without an ear only flat corners are left
                return int(np.argmin(np.where(self.left, abs(self.turn), np.inf)))
            at = int(np.argmax(np.where(tried, self.fatness, -np.inf)))
            if self._empty(at):
                return at

    def _empty(self, at: int) -> bool:
        """Return True if no other corner is inside the triangle of a corner, else False and store one in `blocker`."""
        own = self.corners[[self.before[at], at, self.after[at]]]
        (ax, ay), (x, y) = own.T[..., None], self.corners.T
        side = (ax[_NEXT] - ax) * (y - ay) - (ay[_NEXT] - ay) * (x - ax)  # side of each edge, shape (3, n)
        within = np.flatnonzero(self.left & (side.min(axis=0) >= 0))
        others = within[~(self.corners[within][:, None] == own).all(-1).any(-1)]
        self.blocker[at] = others[0] if len(others) else -1
        return not len(others)

    def cut(self, at: int) -> None:
        """Cut off a corner and update its neighbours."""
        a, c = self.before[at], self.after[at]
        self.left[at], self.after[a], self.before[c] = False, c, a
        self._measure(a)
        self._measure(c)

    def _measure(self, at: int) -> None:
        """Update twice the signed area of a corner's triangle, and its aspect ratio."""
        a, b, c = self.corners[[self.before[at], at, self.after[at]]].tolist()
        turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        # the sum of two squares bounds the larger one, which is sufficient to rank corners
        longest = max(dist(a, c) ** 2, dist(a, b) ** 2 + dist(b, c) ** 2)
        self.turn[at], self.fatness[at], self.blocker[at] = turn, turn / (longest or 1.0), -1


# --------------------------------------------------------------------------------------------- raised and turned shapes


FINE = 0.02  # mm: tolerance of chords of a solid
_SAME = 7  # decimals (mm) to which points are merged
SIDES = 96
"""Number of sides of the polygons that represent turned parts and round holes. At a radius of 4 mm, the chords deviate
by 2 um.
"""
_SLICE = 0.1  # rad: maximum rotation of helical teeth between layers


@dataclass(frozen=True, slots=True)
class Solid:
    """Closed surface: vertices [mm], shape (n, 3), and outward triangles as vertex indices, shape (m, 3)."""

    vertices: Floats
    faces: Integers

    def moved(self, turn: Floats, by: Sequence[float]) -> Solid:
        """Return the solid rotated by the matrix `turn`, shape (3, 3), and then translated by `by` [mm]."""
        return Solid(self.vertices @ turn.T + np.asarray(by), self.faces)


def joined(solids: Iterable[Solid]) -> Solid:
    """Return several surfaces combined into one surface."""
    parts = list(solids)
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return Solid(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts[:-1], strict=True)]),
    )


def _merged(points: Floats, faces: Integers) -> tuple[Floats, Integers]:
    """Return points without duplicates, and the faces with the new indices."""
    # rounded only for the comparison, because pitches differ in the last digits; + 0.0 turns -0.0 into 0.0
    _, first, index = np.unique(points.round(_SAME) + 0.0, axis=0, return_index=True, return_inverse=True)
    return points[first], np.asarray(index).reshape(-1)[faces]


def wheel_solid(blank: Blank) -> Solid:
    """Return the solid of a wheel from its flat shape, centred at the origin.

    One pitch is triangulated and repeated, unless the wheel has holes besides its bore; it is then without twist.
    """
    contours = blank.contours
    ring = blank.kind == "ring"
    teeth = contours[1 if ring else 0]
    others = [contour for contour in contours if contour is not teeth]
    if blank.kind == "pins" or len(teeth.points) % blank.teeth or len(others) > 1:
        return plate_solid(contours, blank.thickness)
    radius = float(abs(others[0].points).max()) if others else 0.0
    own = len(teeth.points) // blank.teeth + 1
    line = Contour(teeth.points[:own], np.append(teeth.bulges[: own - 1], 0.0)).flattened(FINE)
    tooth = line[simplified(line, FINE)]
    pitch = _pitch(tooth, radius, blank.teeth, FINE)
    return extruded(*_repeated(*fill(pitch), blank.teeth), blank.thickness, blank.twist)


def plate_solid(contours: Sequence[Contour], thickness: float) -> Solid:
    """Return the solid of a flat part with holes, whose middle plane is at z = 0."""
    outer, *others = contours
    holes = [round_about(each) if each.is_circle else each.flattened(FINE) for each in others]
    return extruded(*fill(outer.flattened(FINE), holes), thickness)


def round_about(circle: Contour) -> Floats:
    """Return a polygon circumscribed about a circle, so that a part with the diameter of the circle fits into it."""
    centre = circle.points.mean(axis=0)
    radius = float(abs(circle.points[0] - centre).max()) / np.cos(pi / SIDES)
    turn = 2 * pi * np.arange(SIDES) / SIDES
    return np.asarray(centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1))


def extruded(
    points: Floats, triangles: Integers, thickness: float, twist: float = 0.0, layers: int | None = None
) -> Solid:
    """Return a flat shape (n, 2) extruded by half the thickness to each side, with the top rotated by `twist` [rad].

    The boundary edges become walls of `layers` layers; by default each layer turns by at most 0.1 rad.
    """
    x, y = points.T
    sections = []
    for height in np.linspace(-0.5, 0.5, 1 + (layers or max(1, ceil(abs(twist) / _SLICE)))).tolist():
        c, s = np.cos(height * twist), np.sin(height * twist)
        sections.append(np.column_stack([c * x - s * y, s * x + c * y, np.full(len(points), height * thickness)]))
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {(a, b) for a, b in edges.tolist()}
    rim = np.array([(a, b) for a, b in edges.tolist() if (b, a) not in known], dtype=np.int64)
    n, top = len(points), len(points) * (len(sections) - 1)
    a, b = (rim.T[:, None] + n * np.arange(len(sections) - 1)[:, None]).reshape(2, -1)
    walls = np.concatenate([np.stack([a, b, b + n], axis=1), np.stack([a, b + n, a + n], axis=1)])
    return Solid(np.concatenate(sections), np.concatenate([triangles[:, ::-1], triangles + top, walls]))


def lathed(rows: Sequence[Floats]) -> Solid:
    """Return the closed surface through rows of counter-clockwise points (n, 3); a row of one point is a pole."""
    starts = np.cumsum([0, *map(len, rows)])
    count = max(map(len, rows))
    rings = [start + np.arange(count) * (len(row) > 1) for start, row in zip(starts.tolist(), rows, strict=False)]
    faces = []
    for low, high in zip(rings, [*rings[1:], rings[0]], strict=True):
        after = np.roll(high, -1)
        if low[0] != low[-1]:
            faces.append(np.column_stack([low, np.roll(low, -1), after]))
        if high[0] != high[-1]:
            faces.append(np.column_stack([low, after, high]))
    return Solid(np.concatenate(rows), np.concatenate(faces).astype(np.int64))


def _pitch(tooth: Floats, radius: float, teeth: int, tolerance: float) -> Floats:
    """Return the polygon of a tooth and its sector of the web, whose hole is drawn within a `tolerance` [mm]."""
    first, last = (float(np.arctan2(y, x)) for x, y in (tooth[0], tooth[-1]))
    if not radius:
        return np.concatenate([tooth, [[0.0, 0.0]]])
    sweep = 2 * pi / teeth
    # -1: a tolerance larger than the diameter requires only one chord
    steps = max(1, ceil(sweep / (2 * np.arccos(max(1 - tolerance / radius, -1.0)))), ceil(SIDES / teeth))
    radius = radius / float(np.cos(sweep / steps / 2))  # circumscribed about the bore, as in `round_about`
    turn = last - sweep * np.arange(steps + 1) / steps
    # a tooth spans one pitch, so that the copies of tooth and bore join
    assert abs((last - first - sweep + pi) % (2 * pi) - pi) < 1e-6
    return np.concatenate([tooth, radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)])


def _repeated(points: Floats, triangles: Integers, times: int) -> tuple[Floats, Integers]:
    """Return the points and triangles of one pitch repeated about the axis, with coincident points merged."""
    turn = 2 * pi * np.arange(times)[:, None] / times
    c, s = np.cos(turn), np.sin(turn)
    x, y = points.T
    every = np.stack([c * x - s * y, s * x + c * y], axis=-1).reshape(-1, 2)
    return _merged(every, (triangles + len(points) * np.arange(times)[:, None, None]).reshape(-1, 3))


# ------------------------------------------------------------------------------------------------ bevels, crowns, worms


_SLICES = 48  # sections of a worm
_RIDGE = 0.01  # minimum half width of a crown's tooth in pitches, or its flanks would coincide
_SIDES = 720  # sides of a wheel drawn without teeth


def approximation_solid(wheel: SceneWheel, profile: ToothProfile, bore: float = 0.0) -> Solid:
    """Return the approximate solid of a wheel with a given bore [mm]; its axis is z, and its first tooth is along x."""
    if wheel.kind == "worm":
        twist = wheel.thickness * tan(wheel.helix) / wheel.radius
        return extruded(*_section(wheel, profile, bore), wheel.thickness, twist, _SLICES)
    if wheel.cone:
        coned = _coned(wheel, profile, bore)
        vertices, faces = _merged(coned.vertices, coned.faces)
        return Solid(vertices, faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)])  # without degenerate triangles
    return extruded(*_section(wheel, profile, bore), wheel.thickness)


def _polar(wheel: SceneWheel, profile: ToothProfile) -> tuple[Floats, Floats]:
    """Return the radii [mm] and angles [rad] of the outline of a wheel, or of its pitch circle for too many teeth."""
    if wheel.teeth > MOST_TEETH:
        return np.full(_SIDES, wheel.radius), np.arange(_SIDES) * 2 * pi / _SIDES
    r, angle = np.array(profile.points, dtype=float)[:-1].T
    turn = angle[None, :] + 2 * pi * np.arange(wheel.teeth)[:, None] / wheel.teeth
    return np.tile(r * wheel.radius, wheel.teeth), turn.reshape(-1)


def _section(wheel: SceneWheel, profile: ToothProfile, bore: float) -> tuple[Floats, Integers]:
    r, turn = _polar(wheel, profile)
    outline = np.stack([r * np.cos(turn), r * np.sin(turn)], axis=1)
    if wheel.kind == "ring":
        sides = min(max(48, wheel.teeth), MOST_TEETH)
        around = np.arange(sides) * 2 * pi / sides
        rim = (wheel.root + 2 * wheel.module) * np.stack([np.cos(around), np.sin(around)], axis=1)
        return fill(rim, [outline])
    if bore:
        return fill(outline, [round_about(Contour.circle(bore / 2))])
    # the outline is star-shaped about the centre, so that a fan of triangles fills it
    count = len(outline)
    spokes = np.arange(count)
    fan = np.stack([spokes, (spokes + 1) % count, np.full(count, count)], axis=1)
    return np.concatenate([outline, [[0.0, 0.0]]]), fan


def _coned(wheel: SceneWheel, profile: ToothProfile, bore: float) -> Solid:
    """Return the solid of a bevel or crown wheel, from rows of points around it: back bore to front bore."""
    radius, cone, thickness = wheel.radius, wheel.cone, wheel.thickness
    r, turn = _polar(wheel, profile)
    rho = r / radius
    roots = np.full(len(rho), rho.min() - LAND)
    behind = back_of_cone(cone, radius, thickness, wheel.root - radius)
    wide, narrow = 1.0, taper(cone, radius, thickness)
    rows = [
        _cone_points(wheel, r, turn, scale) for r, scale in ((roots, wide), (rho, wide), (rho, narrow), (roots, narrow))
    ]
    back = rows[0].copy()
    back[:, 2] = behind
    rows = [_at_bore(back, bore), back, *rows, _at_bore(rows[-1], bore)]
    toothed = lathed(rows)
    if wheel.facing < 0:  # the apex is on the positive side of its axis
        return toothed
    return Solid(toothed.vertices * (1.0, 1.0, -1.0), toothed.faces[:, ::-1])


def _cone_points(wheel: SceneWheel, rho: Floats, turn: Floats, scale: float) -> Floats:
    """Return the outline of a wheel on its back cone [mm], shape (n, 3), scaled towards the apex on the z axis."""
    depth = (rho - 1) * wheel.radius
    r = (wheel.radius + depth * np.cos(wheel.cone)) * scale
    if wheel.cone > CROWN:  # tooth spaces of a crown wheel are wide enough for teeth that pass obliquely
        pitch = 2 * pi / wheel.teeth
        middle = np.round(turn / pitch) * pitch
        angle, off = turn - middle, np.sqrt(wheel.thickness / wheel.radius)
        space = pitch / 2 - abs(angle) + off - np.sin(off) + (1 - scale) * off / 2
        turn = middle + np.sign(angle) * np.maximum(_RIDGE * pitch, pitch / 2 - space / scale)
    z = height_on_cone(wheel.cone, wheel.radius, 0.0, scale) + depth * np.sin(wheel.cone) * scale
    return np.column_stack([r * np.cos(turn), r * np.sin(turn), z])


def _at_bore(row: Floats, bore: float) -> Floats:
    """Return a row of points contracted radially to the bore, or to one point if the bore is 0."""
    angle = np.arctan2(row[:, 1], row[:, 0])
    if not bore:
        return np.array([[0.0, 0.0, row[:, 2].mean()]])
    r = bore / 2 / np.cos(pi / len(row))  # circumscribed, as for other holes
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), row[:, 2]])
