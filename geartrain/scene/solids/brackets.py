"""Brackets: plates that stand across an arbor at a right angle to the plates of the frame, and bear its ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import dist
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.parts.frame_plates import FramePlates
from geartrain.scene.parts.plate_passages import Passage
from geartrain.scene.parts.stack_discs import swept_circle
from geartrain.scene.solids.bearing_plates import around
from geartrain.scene.solids.solid_part import SolidPart
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneBody
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.train_scene import Scene

GAP = 0.5
"""Along an arbor, from its last wheel to what bears it [mm]."""
_ROOM = 1.5  # mm, the same of a bracket: the wheel's window in the plate and a web of that stand between
LAND = 2.0
"""Metal round a bearing [mm]."""
_FLAT = 1e-6


@dataclass(frozen=True)
class Bracket:
    """What bears one end of an arbor.

    body   that it bears; `reach`, how far along the arbor's direction its outer face stands (mm)
    side   of the frame's plate in which it stands, through the `mortise` there
    """

    body: int
    reach: float
    side: str
    mortise: Passage
    part: SolidPart


def find_brackets(scene: Scene, plan: FramePlan, bores: Mapping[str, float]) -> tuple[Bracket, ...]:
    """Of every arbor that the frame bears across its plates' normal.

    bores   diameters (mm) of arbors by axis
    """
    sides = FramePlates(plan).sides
    borne = {column.axis for column in plan.all_columns}
    found: list[Bracket] = []
    for at, body in enumerate(scene.bodies):
        frame = body.parent is not None and scene.bodies[body.parent].id == plan.stack.frame
        across = abs(float(np.dot(body.direction, plan.stack.normal or ()))) < _FLAT if frame else False
        if across and body.axis not in borne and bores.get(body.axis):
            found += _brackets(scene, plan, sides, at, bores[body.axis] / 2)
    return tuple(found)


def wheel_ends(scene: Scene, at: int) -> tuple[float, float] | None:
    """Along a body's direction, from its point: between which places its wheels stand; None if it has none."""
    body = scene.bodies[at]
    along = np.array(body.direction)
    own = [wheel for wheel in scene.wheels if wheel.body == at and wheel.kind != "ring"]
    centres = [float((np.array(wheel.centre) - np.array(body.point)) @ along) for wheel in own]
    ends = [centre + end for wheel, centre in zip(own, centres, strict=True) for end in wheel.span]
    return (min(ends), max(ends)) if ends else None


def _brackets(
    scene: Scene, plan: FramePlan, sides: Mapping[str, tuple[float, float]], at: int, radius: float
) -> Iterator[Bracket]:
    body, ends = scene.bodies[at], wheel_ends(scene, at)
    if ends is None:
        return
    middle = np.mean([plan.stack.in_space(column.at) for column in plan.columns], axis=0)
    centre = float((middle - np.array(body.point)) @ np.array(body.direction))
    low, high = ends
    faces = {1: high + _ROOM, -1: low - _ROOM}
    ways = [way for way, inner in ((1, high > centre - _FLAT), (-1, low < centre + _FLAT)) if inner]
    if len(ways) == 1:  # on the inner side, unless wheels are in its way there
        ways = [min(ways[0], -ways[0], key=lambda way: _in_the_way(plan, body, faces[way], way, sides)[0])]
    for way in ways:
        yield _bracket(scene, plan, sides, at, faces[way], way, radius)


def _in_the_way(
    plan: FramePlan, body: SceneBody, face: float, way: int, sides: Mapping[str, tuple[float, float]]
) -> tuple[int, float, str]:
    """How many wheels stand before the plate to which a bracket goes best, how far it is (mm), and which it is."""
    place, stack = _middle(plan, body, face, way), plan.stack
    height, foot = float(place @ np.array(stack.normal)), stack.flat(tuple(place.tolist()))

    def cost(side: str) -> tuple[int, float, str]:
        low, high = sorted((height, sum(sides[side]) / 2))
        wheels = [swept_circle(disc) for disc in plan.discs if disc.low < high and low < disc.high]
        return sum(dist(foot, middle) < reach for middle, reach in wheels), high - low, side

    return min(map(cost, sides), key=lambda each: each[:2])


def _middle(plan: FramePlan, body: SceneBody, face: float, way: int) -> Floats:
    """Of a bracket, on the axis that it bears."""
    return np.array(body.point) + (face + way * plan.thickness / 2) * np.array(body.direction)


def _bracket(
    scene: Scene,
    plan: FramePlan,
    sides: Mapping[str, tuple[float, float]],
    at: int,
    face: float,
    way: int,
    radius: float,
) -> Bracket:
    """At one end of an arbor, on the plate that is nearest of those with the fewest wheels before them."""
    body, stack = scene.bodies[at], plan.stack
    place, normal = _middle(plan, body, face, way), np.array(stack.normal)
    height, foot, edge = float(place @ normal), stack.flat(tuple(place.tolist())), radius + LAND
    _, _, side = _in_the_way(plan, body, face, way, sides)
    away = max(sides[side], key=lambda each: abs(each - height)) - height
    down = max(abs(away) - edge, 0.0) * (1 if away > 0 else -1)
    hole = Contour.circle(radius + plan.process.running / 2)
    cut = around([(0.0, 0.0), (down, 0.0)], edge), hole
    name = f"{body.id} bracket" + (" 2" if way < 0 else "")
    aside = np.cross(body.direction, normal)
    turn = np.column_stack([normal, aside, body.direction])
    mortise = Passage(foot, stack.flat(tuple(aside.tolist())), edge, (plan.thickness + plan.process.press) / 2)
    part = SolidPart(_frame(scene, plan), name, "plate", turn, place, "", cut, plan.thickness)
    return Bracket(at, face + way * plan.thickness, side, mortise, part)


def _frame(scene: Scene, plan: FramePlan) -> int:
    return next(at for at, body in enumerate(scene.bodies) if body.id == plan.stack.frame)


def on_axis(body: SceneBody, along: float) -> Floats:
    """The point of a body's axis at a place along it (mm)."""
    return np.asarray(np.array(body.point) + along * np.array(body.direction))
