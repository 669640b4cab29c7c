"""Closed surfaces of triangles: flat shapes raised along an axis, arbors, wheels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import ceil, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polylines import simplified
from geartrain.scene.solids.triangulation import fill
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.triangulation import Integers
    from geartrain.scene.solids.wheel_blanks import Blank

FINE = 0.02  # mm, how far the chords of a solid may leave a curve
_SAME = 7  # decimals of a mm to which points are one
SIDES = 96
"""Of what is turned, and of round holes: chords leave a radius of 4 mm by 2 um."""
_SLICE = 0.1  # rad: by how much helical teeth turn from one layer to the next


@dataclass(frozen=True, slots=True)
class Solid:
    """Vertices (n, 3) in mm, and faces (m, 3) of their indices, counter-clockwise from outside."""

    vertices: Floats
    faces: Integers

    def moved(self, turn: Floats, by: Sequence[float]) -> Solid:
        """Turned by a matrix (3, 3), then moved."""
        return Solid(self.vertices @ turn.T + np.asarray(by), self.faces)


def joined(solids: Iterable[Solid]) -> Solid:
    """Several surfaces as one list of triangles."""
    parts = list(solids)
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return Solid(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts[:-1], strict=True)]),
    )


def welded(solid: Solid) -> Solid:
    """With points that coincide as one, and without the triangles that have no area then."""
    _, first, index = np.unique(solid.vertices.round(_SAME) + 0.0, axis=0, return_index=True, return_inverse=True)
    faces = np.asarray(index).reshape(-1)[solid.faces]
    return Solid(solid.vertices[first], faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)])


def wheel_solid(blank: Blank, tolerance: float = FINE) -> Solid:
    """A wheel from its flat shape, its middle at the origin. One pitch is filled and repeated where teeth allow."""
    contours = blank.contours
    ring = blank.kind == "ring"
    teeth = contours[1 if ring else 0]
    others = [contour for contour in contours if contour is not teeth]
    if blank.kind == "pins" or len(teeth.points) % blank.teeth or len(others) > 1:
        return plate_solid(contours, blank.thickness, tolerance)
    radius = float(abs(others[0].points).max()) if others else 0.0
    own = len(teeth.points) // blank.teeth + 1
    line = _open(teeth, own, tolerance)
    tooth = line[simplified(line, tolerance)]
    pitch = _pitch(tooth, radius, blank.teeth, tolerance)
    return twisted(*_repeated(*fill(pitch), blank.teeth), blank.thickness, blank.twist)


def _open(contour: Contour, count: int, tolerance: float) -> Floats:
    """The first vertices of a contour, its arcs between them as chords."""
    bulges = np.append(contour.bulges[: count - 1], 0.0)
    return Contour(contour.points[:count], bulges).flattened(tolerance)


def plate_solid(contours: Sequence[Contour], thickness: float, tolerance: float = FINE) -> Solid:
    """A flat part with holes, its middle plane at z = 0."""
    outer, *others = contours
    holes = [round_about(each) if each.is_circle else each.flattened(tolerance) for each in others]
    return raised(*fill(outer.flattened(tolerance), holes), thickness)


def round_about(circle: Contour) -> Floats:
    """A polygon round a circle, so that what has the size of the hole still stands in it."""
    centre = circle.points.mean(axis=0)
    radius = float(abs(circle.points[0] - centre).max()) / np.cos(pi / SIDES)
    turn = 2 * pi * np.arange(SIDES) / SIDES
    return np.asarray(centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1))


def raised(points: Floats, triangles: Integers, thickness: float) -> Solid:
    """A flat shape (n, 2) raised half the thickness to either side; walls stand on edges that have one triangle."""
    return piled(
        [np.column_stack([points, np.full(len(points), z)]) for z in (-thickness / 2, thickness / 2)], triangles
    )


def twisted(points: Floats, triangles: Integers, thickness: float, twist: float) -> Solid:
    """A flat shape (n, 2) raised half the thickness to either side, its upper face turned by `twist` (rad)."""
    x, y = points.T
    layers = []
    for height in np.linspace(-0.5, 0.5, 1 + max(1, ceil(abs(twist) / _SLICE))).tolist():
        c, s = np.cos(height * twist), np.sin(height * twist)
        layers.append(np.column_stack([c * x - s * y, s * x + c * y, np.full(len(points), height * thickness)]))
    return piled(layers, triangles)


def piled(layers: Sequence[Floats], triangles: Integers) -> Solid:
    """The solid through several copies (n, 3) of one flat shape, from the lowest to the highest."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {(a, b) for a, b in edges.tolist()}
    rim = np.array([(a, b) for a, b in edges.tolist() if (b, a) not in known], dtype=np.int64)
    n, top = len(layers[0]), len(layers[0]) * (len(layers) - 1)
    a, b = (rim.T[:, None] + n * np.arange(len(layers) - 1)[:, None]).reshape(2, -1)
    walls = np.concatenate([np.stack([a, b, b + n], axis=1), np.stack([a, b + n, a + n], axis=1)])
    return Solid(np.concatenate(layers), np.concatenate([triangles[:, ::-1], triangles + top, walls]))


def _pitch(tooth: Floats, radius: float, teeth: int, tolerance: float) -> Floats:
    """One tooth with its part of the web, from the first point's radius to the last one's."""
    first, last = (float(np.arctan2(y, x)) for x, y in (tooth[0], tooth[-1]))
    if not radius:
        return np.concatenate([tooth, [[0.0, 0.0]]])
    sweep = 2 * pi / teeth
    # -1: a tolerance beyond the diameter asks for no more than one chord
    steps = max(1, ceil(sweep / (2 * np.arccos(max(1 - tolerance / radius, -1.0)))), ceil(SIDES / teeth))
    radius = radius / float(np.cos(sweep / steps / 2))  # round the bore, as in `round_about`
    turn = last - sweep * np.arange(steps + 1) / steps
    assert abs((last - first - sweep + pi) % (2 * pi) - pi) < 1e-6
    return np.concatenate([tooth, radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)])


def _repeated(points: Floats, triangles: Integers, times: int) -> tuple[Floats, Integers]:
    """The same triangles in every pitch, points that meet made one."""
    turn = 2 * pi * np.arange(times)[:, None] / times
    c, s = np.cos(turn), np.sin(turn)
    x, y = points.T
    every = np.stack([c * x - s * y, s * x + c * y], axis=-1).reshape(-1, 2)
    # rounded only to be compared: last digits of a point seen from two pitches differ; + 0.0 makes -0.0 the same as 0.0
    _, first, index = np.unique(every.round(_SAME) + 0.0, axis=0, return_index=True, return_inverse=True)
    faces = (triangles + len(points) * np.arange(times)[:, None, None]).reshape(-1, 3)
    return every[first], np.asarray(index).reshape(-1)[faces]
