"""Solids of wheels whose teeth lie in no plane, as likenesses: bevel wheels, crown wheels, worms."""

from __future__ import annotations

from itertools import pairwise
from math import pi, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.wheel_reach import CROWN, LAND, back_of_cone, height_on_cone, taper
from geartrain.scene.solids.triangle_solids import Solid, piled, raised, round_about, welded
from geartrain.scene.solids.triangulation import fill
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.standard_teeth import MOST_TEETH

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel, ToothProfile
    from geartrain.scene.solids.triangulation import Integers

_SLICES = 48  # of a worm
_RIDGE = 0.01  # of a pitch: half of what is left of a crown's tooth that runs out, or its flanks would be one line
_SIDES = 720  # of a wheel without teeth


def likeness_solid(wheel: SceneWheel, profile: ToothProfile, bore: float = 0.0) -> Solid:
    """A wheel of the scene, its pitch circle's middle at the origin, its first tooth towards x, its axis z.

    bore   diameter of the hole in it, unless it is a ring (mm)
    """
    if wheel.kind == "worm":
        return _worm(wheel, profile, bore)
    if wheel.cone:
        return welded(_coned(wheel, profile, bore))
    points, triangles = _section(wheel, profile, bore)
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
    # every tooth is seen from the middle: a fan
    count = len(outline)
    spokes = np.arange(count)
    fan = np.stack([spokes, (spokes + 1) % count, np.full(count, count)], axis=1)
    return np.concatenate([outline, [[0.0, 0.0]]]), fan


def _coned(wheel: SceneWheel, profile: ToothProfile, bore: float) -> Solid:
    """A bevel or crown wheel: its back, teeth from the wide end to the narrow one, and what is within them.

    Rows of points, from the bore at the back round the outside to the bore before it.
    """
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
    toothed = _revolved(rows, closed=bore > 0)
    if wheel.facing < 0:  # the apex lies up its axis
        return toothed
    return Solid(toothed.vertices * (1.0, 1.0, -1.0), toothed.faces[:, ::-1])


def _cone_points(wheel: SceneWheel, rho: Floats, turn: Floats, scale: float) -> Floats:
    """Points (n, 3) of its outline on its back cone, or as much nearer the apex as `scale` says, the apex upwards."""
    depth = (rho - 1) * wheel.radius
    r = (wheel.radius + depth * np.cos(wheel.cone)) * scale
    if wheel.cone > CROWN:
        turn = _aslant(wheel, turn, scale)
    z = height_on_cone(wheel.cone, wheel.radius, 0.0, scale) + depth * np.sin(wheel.cone) * scale
    return np.column_stack([r * np.cos(turn), r * np.sin(turn), z])


def _aslant(wheel: SceneWheel, turn: Floats, scale: float) -> Floats:
    """Angles at which a crown's flanks stand: what runs in its spaces is as wide further in, and comes aslant."""
    pitch = 2 * pi / wheel.teeth
    middle = np.round(turn / pitch) * pitch
    angle, off = turn - middle, np.sqrt(wheel.thickness / wheel.radius)
    space = pitch / 2 - abs(angle) + off - np.sin(off) + (1 - scale) * off / 2
    return np.asarray(middle + np.sign(angle) * np.maximum(_RIDGE * pitch, pitch / 2 - space / scale))


def _at_bore(row: Floats, bore: float) -> Floats:
    """A row drawn in to the bore, or to one point where there is none."""
    angle = np.arctan2(row[:, 1], row[:, 0])
    if not bore:
        return np.array([[0.0, 0.0, row[:, 2].mean()]])
    r = bore / 2 / np.cos(pi / len(row))  # round it, as other holes
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), row[:, 2]])


def _revolved(rows: list[Floats], *, closed: bool) -> Solid:
    """The surface through rows of points, each counter-clockwise; through the bore too, or with a point at each end."""
    count, starts = len(rows[1]), np.cumsum([0, *map(len, rows)])
    here, after = np.arange(count), (np.arange(count) + 1) % count
    faces = []
    rings = [(low, high) for low, high in pairwise(starts[:-1])] + ([(starts[-2], starts[0])] if closed else [])
    for low, high in rings if closed else rings[1:-1]:
        faces.append(np.stack([low + here, low + after, high + after], axis=1))
        faces.append(np.stack([low + here, high + after, high + here], axis=1))
    if not closed:
        first, last = starts[1], starts[-3]
        faces.append(np.stack([first + after, first + here, np.zeros(count, dtype=int)], axis=1))
        faces.append(np.stack([last + here, last + after, np.full(count, starts[-2])], axis=1))
    return Solid(np.concatenate(rows), np.concatenate(faces))


def _worm(wheel: SceneWheel, profile: ToothProfile, bore: float) -> Solid:
    """A section with as many lobes as starts, turned on along the axis as its thread winds."""
    points, triangles = _section(wheel, profile, bore)
    heights = np.linspace(-0.5, 0.5, _SLICES + 1) * wheel.thickness
    slices = []
    for height in heights:
        turn = height * tan(wheel.helix) / wheel.radius
        c, s = np.cos(turn), np.sin(turn)
        x, y = points.T
        slices.append(np.column_stack([c * x - s * y, s * x + c * y, np.full(len(points), height)]))
    return piled(slices, triangles)
