"""Solids of wheels whose teeth lie in no plane, as likenesses: bevel wheels, crown wheels, worms."""

from __future__ import annotations

from itertools import pairwise
from math import pi, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.solids.triangle_solids import Solid, between, joined, raised
from geartrain.scene.solids.triangulation import fill
from geartrain.teeth.standard_teeth import MOST_TEETH

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel, ToothProfile
    from geartrain.scene.solids.triangulation import Integers

_WEB = 0.75  # of the pitch radius: where the teeth of a crown wheel end inwards
_FACE = 0.7  # a bevel tooth ends at this part of its cone's length, or where its thickness does
_FLAT = 0.45 * pi  # rad: the height of a wider cone is next to nothing, so it is drawn as a crown
_SLICES = 48  # of a worm
_SIDES = 720  # of a wheel without teeth


def likeness_solid(wheel: SceneWheel, profile: ToothProfile) -> Solid:
    """A wheel of the scene, its pitch circle's middle at the origin, its first tooth towards x, its axis z."""
    if wheel.kind == "worm":
        return _worm(wheel, profile)
    if wheel.kind == "contrate" or wheel.cone > _FLAT:
        return _crown(wheel, profile)
    if wheel.cone:
        return _bevel(wheel, profile)
    points, triangles = _section(wheel, profile)
    return raised(points, triangles, wheel.thickness)


def _polar(wheel: SceneWheel, profile: ToothProfile) -> tuple[Floats, Floats]:
    """Radius (mm) and angle of the whole outline; a point where two teeth meet stands once.

    Of a wheel of more teeth than are cut it is the pitch circle.
    """
    if wheel.teeth > MOST_TEETH:
        return np.full(_SIDES, wheel.radius), np.arange(_SIDES) * 2 * pi / _SIDES
    r, angle = np.array(profile.points, dtype=float)[:-1].T
    turn = angle[None, :] + 2 * pi * np.arange(wheel.teeth)[:, None] / wheel.teeth
    return np.tile(r * wheel.radius, wheel.teeth), turn.reshape(-1)


def _section(wheel: SceneWheel, profile: ToothProfile) -> tuple[Floats, Integers]:
    r, turn = _polar(wheel, profile)
    outline = np.stack([r * np.cos(turn), r * np.sin(turn)], axis=1)
    if wheel.kind == "ring":
        sides = min(max(48, wheel.teeth), MOST_TEETH)
        around = np.arange(sides) * 2 * pi / sides
        rim = (wheel.root + 2 * wheel.module) * np.stack([np.cos(around), np.sin(around)], axis=1)
        return fill(rim, [outline])
    # every tooth is seen from the middle: a fan
    count = len(outline)
    spokes = np.arange(count)
    fan = np.stack([spokes, (spokes + 1) % count, np.full(count, count)], axis=1)
    return np.concatenate([outline, [[0.0, 0.0]]]), fan


def _bevel(wheel: SceneWheel, profile: ToothProfile) -> Solid:
    """The wide end in the plane of the pitch circle, the narrow one nearer the point where the axes meet."""
    points, triangles = _section(wheel, profile)
    height = wheel.radius / tan(wheel.cone)
    step = min((1 - _FACE) * height, max(wheel.thickness, wheel.module))
    wide = np.column_stack([points, np.zeros(len(points))])
    narrow = np.column_stack([points * (1 - step / height), np.full(len(points), wheel.facing * step)])
    return between(wide, narrow, triangles) if wheel.facing > 0 else between(narrow, wide, triangles)


def _crown(wheel: SceneWheel, profile: ToothProfile) -> Solid:
    """A disc with a rim whose teeth stand along the axis as those of the profile stand outwards."""
    r, turn = _polar(wheel, profile)
    count, side = len(r), wheel.facing or 1
    rise = side * (r - wheel.radius)
    back = max(wheel.thickness, 2 * wheel.module)
    base, web = -side * back, -side * max(0.5 * back, 1.3 * wheel.module)
    rows = []
    for radius, height in ((1.0, base), (1.0, rise), (_WEB, rise), (_WEB, web)):
        edge = wheel.radius * radius
        rows.append(np.column_stack([edge * np.cos(turn), edge * np.sin(turn), np.broadcast_to(height, count)]))
    here, after = np.arange(count), (np.arange(count) + 1) % count
    faces = []
    for low, high in pairwise(range(0, 4 * count, count)):
        faces.append(np.stack([low + here, low + after, high + after], axis=1))
        faces.append(np.stack([low + here, high + after, high + here], axis=1))
    outer, inner = 4 * count, 4 * count + 1  # middles of the back and of the web
    faces.append(np.stack([after, here, np.full(count, outer)], axis=1))
    faces.append(np.stack([3 * count + here, 3 * count + after, np.full(count, inner)], axis=1))
    found = np.concatenate(faces)
    vertices = np.concatenate([*rows, [[0.0, 0.0, base], [0.0, 0.0, web]]])
    return Solid(vertices, found if side > 0 else found[:, ::-1])


def _worm(wheel: SceneWheel, profile: ToothProfile) -> Solid:
    """A section with as many lobes as starts, turned on along the axis as its thread winds."""
    points, triangles = _section(wheel, profile)
    heights = np.linspace(-0.5, 0.5, _SLICES + 1) * wheel.thickness
    slices = []
    for height in heights:
        turn = height * tan(wheel.helix) / wheel.radius
        c, s = np.cos(turn), np.sin(turn)
        x, y = points.T
        slices.append(np.column_stack([c * x - s * y, s * x + c * y, np.full(len(points), height)]))
    return _lofted(slices, triangles)


def _lofted(slices: list[Floats], triangles: Integers) -> Solid:
    """A stack of like slices: caps at both ends, walls between."""
    whole = [between(low, high, triangles) for low, high in pairwise(slices)]
    n, caps = len(slices[0]), len(triangles)
    walls = [Solid(part.vertices, part.faces[2 * caps :]) for part in whole]
    stacked = joined(walls)
    # each slice stands twice, as the top of one part and the bottom of the next
    index = np.arange(len(stacked.vertices))
    part, place = np.divmod(index, 2 * n)
    faces = (part * n + place)[stacked.faces]
    ends = [triangles[:, ::-1], triangles + (len(slices) - 1) * n]
    return Solid(np.concatenate(slices), np.concatenate([*ends, faces]))
