"""Teeth that the viewer draws as closed solids, out of the corners of its triangles."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import manifold3d
import numpy as np
from numpy.typing import NDArray

from geartrain.scene.elements import SceneWheel

Floats = NDArray[np.float64]

CORE = 330  # corners of a worm's core: five rounds of two times 33


class DrawnTooth:
    """A tooth of a wheel as a closed solid about the wheel's own z axis, and where all its copies stand."""

    def __init__(self, points: Floats, elements: Sequence[float], count: int, worm: bool = False) -> None:
        sections = _turns(points, count) if worm else _sections(points)
        self.solid = _lofted(sections)
        self.volume = float(self.solid.volume())
        kinks = np.concatenate(sections)
        self.middle = kinks.mean(0)
        self.reach = float(np.linalg.norm(kinks - self.middle, axis=1).max())
        stand = np.array(elements).reshape(4, 4).T
        self.copies = np.array([stand @ about_z(2 * pi * copy / count) for copy in range(count)])

    def standing(self, body: Floats, ahead: float = 0.0) -> Floats:
        """Matrices of all copies where their body stands, turned on by some pitches (copies, 4, 4)."""
        found: Floats = body @ self.copies @ about_z(2 * pi * ahead / len(self.copies))
        return found

    def middles(self, stands: Floats) -> Floats:
        """Where the middles of its copies are (copies, 3)."""
        return np.asarray(stands[:, :3, :3] @ self.middle + stands[:, :3, 3])

    def placed(self, stands: Floats, copy: int) -> manifold3d.Manifold:
        """A copy where it stands."""
        found: manifold3d.Manifold = self.solid.transform(stands[copy][:3])
        return found


class BentTeeth:
    """The teeth of a thin wheel in one pose, each of another form: what `DrawnTooth` is for those of one form."""

    def __init__(self, wheel: SceneWheel, points: Floats) -> None:
        sections = [_sections(each) for each in points.reshape(wheel.teeth, -1, 3)]
        self.solids = [_lofted(each) for each in sections]
        self.volume = min(float(each.volume()) for each in self.solids)
        kinks = [np.concatenate(each) for each in sections]
        self.own = np.array([[*each.mean(0), 1.0] for each in kinks])
        self.reach = max(float(np.linalg.norm(each - each.mean(0), axis=1).max()) for each in kinks)
        self.wheel = wheel

    def standing(self, body: Floats, ahead: float = 0.0) -> Floats:
        """Matrices of all teeth, turned on by some pitches as they are bent (teeth, 4, 4)."""
        frame = np.eye(4)
        x, z = np.array(self.wheel.reference), np.array(self.wheel.direction)
        frame[:3] = np.column_stack([x, np.cross(z, x), z, self.wheel.centre])
        turned = frame @ about_z(2 * pi * ahead / self.wheel.teeth) @ np.linalg.inv(frame)
        return np.broadcast_to(body @ turned, (self.wheel.teeth, 4, 4))

    def middles(self, stands: Floats) -> Floats:
        """Where the middles of its teeth are (teeth, 3)."""
        return np.asarray(np.einsum("nij,nj->ni", stands[:, :3], self.own))

    def placed(self, stands: Floats, copy: int) -> manifold3d.Manifold:
        """A tooth where it stands."""
        found: manifold3d.Manifold = self.solids[copy].transform(stands[copy][:3])
        return found


def _sections(points: Floats) -> list[Floats]:
    """Return the outlines of both faces, corner by corner, from the corners of the drawn triangles.

    The corners are four of each piece of the flanks, then the corners of either face, and of the wall of a rim.
    The outline of a face begins with its base, and a pin has none.
    """
    quads = points[: len(points) // 4 * 4].reshape(-1, 4, 3)
    joined = np.isclose(quads[:-1, 1:3], quads[1:, [0, 3]]).all((1, 2))
    pieces = 1 + int(np.argmin(np.append(joined, False)))
    flanks, rest = points[: 4 * pieces].reshape(-1, 4, 3), points[4 * pieces :]
    if len(rest) == 2 * pieces:
        return [flanks[:, 0], flanks[:, 3]]
    edge = np.vstack([flanks[:, 0], flanks[-1:, 1]])
    for base in range(len(rest) // 2 - pieces):
        if np.allclose(rest[base : base + len(edge)], edge):
            size = base + len(edge)
            return [rest[:size], rest[size : 2 * size]]
    raise ValueError("no face follows the flanks: the viewer builds teeth in another way")


def _turns(points: Floats, starts: int) -> list[Floats]:
    """The sections of the first thread of a worm along its turns: of three strips side by side, behind the core."""
    strips = points[CORE:].reshape(starts, 3, -1, 2, 3)[0]
    if not np.allclose(strips[:-1, :, 1], strips[1:, :, 0]):
        raise ValueError("the strips of a thread do not hang together: the viewer builds worms in another way")
    return list(np.stack([*strips[:, :, 0], strips[-1, :, 1]], axis=1))


def _lofted(sections: Sequence[Floats]) -> manifold3d.Manifold:
    """What outlines of as many corners have between them, its flanks parted into triangles as the viewer does."""
    count = len(sections[0])
    here = np.arange(count)
    after = np.roll(here, -1)
    strip = np.vstack([np.c_[here, after, after + count], np.c_[here, after + count, here + count]])
    sides = np.vstack([strip + at * count for at in range(len(sections) - 1)])
    flat = _unrolled(sections[0])
    left = np.sum(flat[:, 0] * np.roll(flat[:, 1], -1) - np.roll(flat[:, 0], -1) * flat[:, 1]) > 0
    cap = np.array(manifold3d.triangulate([flat if left else flat[::-1]]))
    cap = cap[:, ::-1] if left else (count - 1 - cap)[:, ::-1]  # against the way the sides go round
    faces = np.vstack(
        [sides, cap if left else cap[:, ::-1], (cap[:, ::-1] if left else cap) + count * (len(sections) - 1)]
    )
    kinks = np.ascontiguousarray(np.vstack(sections))
    for each in (faces, faces[:, ::-1]):
        solid = manifold3d.Manifold(manifold3d.Mesh64(kinks, np.ascontiguousarray(each, dtype=np.uint64)))
        if solid.status() == manifold3d.Error.NoError and solid.volume() > 0:
            return solid
    raise ValueError(f"a tooth is no closed solid: {solid.status()}")


def _unrolled(outline: Floats) -> Floats:
    """An outline about the z axis in a plane: along the circle, and across it, radially or along the axis."""
    x, y, z = outline.T
    radius = np.hypot(x, y)
    aside = radius if np.ptp(radius) >= np.ptp(z) else z
    return np.stack([np.arctan2(y, x) * radius.mean(), aside], axis=1)


def about_z(angle: float) -> Floats:
    turned = np.eye(4)
    turned[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return turned
