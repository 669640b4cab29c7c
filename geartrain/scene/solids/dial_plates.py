"""Plates of dials before and behind a mechanism: how large, how high, with which hole, and the scales on each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import dist, hypot
from typing import TYPE_CHECKING

from geartrain.numerics.vectors import dot
from geartrain.scene.dial_scale import DialScale, clock_point
from geartrain.scene.layout.swept_overlap import segment_distance
from geartrain.scene.parts.stack_discs import Point
from geartrain.scene.solids.flat_drawing import EngravedText, FlatDrawing
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.arbor_columns import AxisColumn
    from geartrain.scene.parts.frame_plates import FramePlates
    from geartrain.scene.train_scene import DialFace, Scene

THICKNESS = 1.5
"""Of a dial, where nothing else is asked for [mm]."""
_AWAY = 2.0  # mm from all that turns to a dial
_ROOM = 0.5  # mm round the arbor of its pointer
_BESIDE = 1.0  # mm from a dial's edge to the arbor of another
_SCALE, _NUMBER, _TICK, _LETTER = 0.84, 1.075, 0.05, 0.055  # of the radius of a dial
_SMALLEST = 1.2  # mm: letters
_SAME = 1e-6


@dataclass(frozen=True, slots=True)
class DialPlate:
    """A disc with the scales of all dials about one axis, on one side.

    Attributes
    ----------
    name : str
        "dial", and the names of the dials.
    at : tuple of float
        Its middle, in the coordinates of the stack [mm].
    low, high : float
        Its faces along the plates' normal [mm].
    radius, hole : float
        Of the disc; diameter of the hole for the arbors of its pointers [mm].
    scales : mapping of str to DialScale
        By dial, radii in mm.
    """

    name: str
    at: Point
    low: float
    high: float
    radius: float
    hole: float
    scales: dict[str, DialScale]

    @property
    def contours(self) -> tuple[Contour, ...]:
        """Its edge and its hole, about its middle."""
        return Contour.circle(self.radius), Contour.circle(self.hole / 2)

    def drawing(self) -> FlatDrawing:
        """As its reader sees it, zero marks above; what is engraved are scales, numbers and names."""
        title = f"{self.name}: thickness {self.high - self.low:.4g} mm, scale 1:1, as its reader sees it; "
        title += ", ".join(f"{name} {scale.divisions} cells" for name, scale in self.scales.items())
        lines = tuple(line for scale in self.scales.values() for line in self._lines(scale))
        return FlatDrawing(title, self.contours, marks=tuple(self._marks()), lines=lines)

    def _lines(self, scale: DialScale) -> Iterator[Floats]:
        import numpy as np

        yield scale.line()
        yield from (np.array(mark) for mark in scale.marks(_TICK * self.radius))

    def _marks(self) -> Iterator[EngravedText]:
        height = max(_LETTER * self.radius, _SMALLEST)
        for depth, (name, scale) in enumerate(self.scales.items()):
            band = (scale.outer - scale.inner) / scale.turns  # of one turn of a spiral: marks take its upper part
            for cell, turn in scale.numbers():
                if scale.turns == 1:
                    at, tall = clock_point(_NUMBER * scale.outer, turn), 0.8 * height
                else:
                    tall = 0.42 * band
                    at = -(0.35 * len(str(cell)) + 0.3) * tall, scale.radius(float(turn)) + 0.2 * band
                yield EngravedText(str(cell), at, tall)
            yield EngravedText(name, (0.0, -(self.hole / 2 + (1.2 + 1.4 * depth) * height)), height)


def dial_plates(scene: Scene, frame: FramePlates, thickness: float = THICKNESS) -> list[DialPlate]:
    """Of all dials that stand on the frame, across its normal, and that the arbor of a pointer reaches."""
    stack, columns = frame.plan.stack, {column.axis: column for column in frame.plan.columns}
    assert stack.normal is not None
    groups: dict[tuple[str, int], list[DialFace]] = {}
    for face in scene.dials:
        side = dot(face.normal, stack.normal)
        axis = next((label for label, column in columns.items() if _same(column.at, stack.flat(face.centre))), None)
        if scene.bodies[face.body].id == stack.frame and axis is not None and abs(abs(side) - 1) < _SAME:
            groups.setdefault((axis, 1 if side > 0 else -1), []).append(face)
    found = (_plate(columns[axis], side, faces, frame, thickness) for (axis, side), faces in groups.items())
    return [plate for plate in found if plate is not None]


def _same(one: Point, other: Point) -> bool:
    return dist(one, other) < _SAME


def _across(at: Point, faces: tuple[float, float], frame: FramePlates) -> Iterator[float]:
    """How far from an axis wheels stand that reach between two heights and do not stand upright."""
    stack, layout = frame.plan.stack, frame.plan.layout
    assert stack.normal is not None
    upright = {disc.name for disc in frame.plan.discs}
    for place in layout.wheels.values():
        height, outer = dot(place.centre, stack.normal), place.radius + place.module
        if place.wheel not in upright and height - outer < faces[1] and faces[0] < height + outer:
            (x, y), (u, v) = stack.flat(place.centre), stack.flat(layout.axes[place.axis].direction)
            flat = hypot(u, v)
            start, end = ((x + way * outer * v / flat, y - way * outer * u / flat) for way in (-1, 1))
            yield segment_distance(at, start, end) - place.thickness / 2


def _plate(
    column: AxisColumn, side: int, faces: Sequence[DialFace], frame: FramePlates, thickness: float
) -> DialPlate | None:
    plan = frame.plan
    ends = [face for disc in plan.discs for face in (disc.low, disc.high)]
    ends += [*plan.places.back, *plan.places.front, *(plan.bridge or ())]
    near = (max(ends) if side > 0 else min(ends)) + side * _AWAY
    low, high = sorted((near, near + side * thickness))
    through = column.radius(low, high)
    if not through:
        return None
    radius = max(face.radius for face in faces)
    for other in plan.columns:
        if other.axis != column.axis and (rod := other.radius(low, high)):
            radius = min(radius, dist(other.at, column.at) - rod - _BESIDE)
    radius = min([radius, *(away - _BESIDE for away in _across(column.at, (low, high), frame))])
    hole = 2 * (through + _ROOM)
    if radius <= hole:
        return None
    share = _SCALE * radius / max(face.radius for face in faces)
    scales = {
        face.id: DialScale(face.turns, face.divisions, share * face.radius, share * face.inner)
        for face in sorted(faces, key=lambda each: -each.radius)
    }
    return DialPlate(f"dial {' and '.join(scales)}", column.at, low, high, radius, hole, scales)
