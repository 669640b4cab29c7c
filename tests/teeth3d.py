"""Teeth as points in space, tested mesh by mesh: an independent check of phase closure without azimuths.

Wheels turn by rotation matrices; every tooth is a point on the circle about the wheel's axis through the pitch point. A
mesh fits if, along the common tangent at the pitch point, each tooth of one wheel is midway between two of the other.
Sets are assembled like real wheels: one after another, each turned until it fits the assembled ones.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from geartrain import GearTrain

Vector = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Wheel:
    """A wheel: its link, tooth count, a point of its axis, the axis (right-handed), and the direction of its mark.

    The link's angle turns the mark about the axis; a tooth is at the mark. outward: the side to which its cone opens.
    """

    link: str
    teeth: int
    centre: Vector
    axis: Vector
    mark: Vector
    internal: bool = False
    outward: Vector | None = None


Pairs = Sequence[tuple[str, str]]


def cross(u: Vector, v: Vector) -> Vector:
    """Return the vector product; numpy's own takes ten times as long for two vectors."""
    (a, b, c), (x, y, z) = u.tolist(), v.tolist()
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def pitch_point(first: Wheel, second: Wheel) -> Vector:
    """Return the point at which the pitch circles or pitch cones touch."""
    if np.linalg.norm(cross(first.axis, second.axis)) > 1e-9:
        n, m = (wheel.axis if wheel.outward is None else wheel.outward for wheel in (first, second))
        # sin of the half-angles are as the teeth, and the point lies between the axes
        point = second.teeth * n / np.linalg.norm(n) + first.teeth * m / np.linalg.norm(m)
        return point / np.linalg.norm(point)
    apart = second.centre - first.centre
    apart = apart - first.axis * (apart @ first.axis) / (first.axis @ first.axis)
    if first.internal:
        return first.centre + apart * first.teeth / (first.teeth - second.teeth)
    if second.internal:
        return first.centre - apart * first.teeth / (second.teeth - first.teeth)
    return first.centre + apart * first.teeth / (first.teeth + second.teeth)


@cache
def circle(wheel: Wheel, mate: Wheel) -> tuple[Vector, Vector, Vector]:
    """Return the circle of teeth through the pitch point: centre, arm to its mark, and arm a quarter turn ahead."""
    k = wheel.axis / np.linalg.norm(wheel.axis)
    point, _ = touch(wheel, mate)
    foot = wheel.centre + k * ((point - wheel.centre) @ k)
    mark = wheel.mark - k * (wheel.mark @ k)
    mark = mark / np.linalg.norm(mark) * np.linalg.norm(point - foot)
    return foot, mark, cross(k, mark)


@cache
def touch(first: Wheel, second: Wheel) -> tuple[Vector, Vector]:
    """Return the pitch point of a mesh, and the direction in which the first wheel moves there."""
    point = pitch_point(first, second)
    tangent = cross(first.axis, point - first.centre)
    return point, tangent / np.linalg.norm(tangent)


def offset(wheel: Wheel, mate: Wheel, angle: float, point: Vector, tangent: Vector) -> float:
    """Return the position of the tooth nearest to the pitch point [pitches along the tangent]."""
    foot, mark, ahead = circle(wheel, mate)
    angles = angle + 2 * np.pi * np.arange(wheel.teeth) / wheel.teeth
    away = np.cos(angles)[:, None] * mark + np.sin(angles)[:, None] * ahead + (foot - point)
    squares = (away * away).sum(axis=1)
    nearest = int(squares.argmin())
    arc = 2 * math.asin(min(1.0, math.sqrt(squares[nearest]) / 2 / math.sqrt(mark @ mark)))
    return math.copysign(arc, away[nearest] @ tangent) * wheel.teeth / math.tau


def misfit(wheels: Mapping[str, Wheel], pair: tuple[str, str], angles: Mapping[str, float]) -> float:
    """Return the deviation of a mesh from a tooth in the middle of a gap [pitches, -1/2 to 1/2]."""
    first, second = wheels[pair[0]], wheels[pair[1]]
    point, tangent = touch(first, second)
    apart = offset(first, second, angles[first.link], point, tangent)
    apart -= offset(second, first, angles[second.link], point, tangent)
    return apart % 1.0 - 0.5


def misfits(wheels: Mapping[str, Wheel], pairs: Pairs, angles: Mapping[str, float]) -> list[float]:
    """Return the deviations of all meshes at given angles of links [rad]."""
    return [misfit(wheels, pair, angles) for pair in pairs]


def put_together(wheels: Mapping[str, Wheel], pairs: Pairs, most: int = 20_000) -> Iterator[dict[str, float]]:
    """Yield the angles of links, each assembled so that one tooth fits its mate, in every possible engagement.

    Only links with several wheels need to be tried in more than one engagement.
    """
    order: list[tuple[str, str, tuple[str, str]]] = []
    seen: dict[str, None] = {}
    mates: dict[str, list[tuple[str, str]]] = {}
    for pair in pairs:
        for wheel in pair:
            mates.setdefault(wheels[wheel].link, []).append(pair)
    for root in mates:
        if root in seen:
            continue
        seen[root] = None
        queue = deque([root])
        while queue:
            here = queue.popleft()
            for pair in mates[here]:
                own, other = pair if wheels[pair[0]].link == here else pair[::-1]
                if wheels[other].link not in seen:
                    seen[wheels[other].link] = None
                    queue.append(wheels[other].link)
                    order.append((own, other, pair))
    used: dict[str, set[str]] = {}
    for pair in pairs:
        for wheel in pair:
            used.setdefault(wheels[wheel].link, set()).add(wheel)
    ways = [range(wheels[new].teeth if len(used[wheels[new].link]) > 1 else 1) for _, new, _ in order]
    assert np.prod([float(len(way)) for way in ways]) <= most, "too many ways to try"
    for choice in product(*ways):
        angles = dict.fromkeys(seen, 0.0)
        for (_, new, pair), tooth in zip(order, choice, strict=True):
            wheel = wheels[new]
            angles[wheel.link] = 2 * np.pi * tooth / wheel.teeth
            off = misfits(wheels, [pair], angles)[0]
            # turn it by what it is off: one of both senses is right
            step = 2 * np.pi / wheel.teeth * off
            tries = [angles[wheel.link] + step, angles[wheel.link] - step]
            angles[wheel.link] = min(tries, key=lambda a: abs(misfits(wheels, [pair], {**angles, wheel.link: a})[0]))
        yield angles


def best(wheels: Mapping[str, Wheel], pairs: Pairs) -> float:
    """Return the maximum deviation of the best way to assemble the set [pitches]."""
    return min(max(map(abs, misfits(wheels, pairs, angles))) for angles in put_together(wheels, pairs))


def in_space(train: GearTrain) -> tuple[dict[str, Wheel], list[tuple[str, str]]]:
    """Return the wheels of a train in space from its declaration."""
    declared = train.declaration
    axis_of = {joint.pair[1]: joint.axis for joint in declared.revolutes}
    wheels = {}
    ways = [[0.0, 0.0, 1.0], *([float(part.value) for part in axis.direction] for axis in declared.axes.values())]
    for name, (link, wheel) in declared.wheels.items():
        axis = declared.axes[axis_of.get(link, "main")]
        place = [part.si for part in axis.position] if axis.position else [0.0, 0.0, 0.0]
        way = np.array([float(part.value) for part in axis.direction])
        facing = wheel.facing * way
        parallel = [np.array(w) for w in ways if np.allclose(np.cross(w, way), 0)]
        sense = parallel[0]  # as the first of its parallels
        mark = np.array([0.0, 1.0, 0.0]) if abs(way[0]) > 0.9 * np.linalg.norm(way) else np.array([1.0, 0.0, 0.0])
        mount = link if link != "frame" else name
        wheels[name] = Wheel(mount, wheel.count or 0, np.array(place), sense, mark, wheel.internal, facing)
    return wheels, [gear.pair for gear in declared.gears]
