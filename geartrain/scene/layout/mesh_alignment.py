"""The angles at which wheels sit on their arbors, so that teeth of one meet spaces of the other.

Breadth first over the gear pairs: the first wheel of a train has a tooth at a pitch point, and each mate follows. With
s the pitches by which a tooth is past the pitch point, positive as the wheel turns, teeth and spaces meet where
s_1 + s_2 = 1/2 (mod 1) if positive angles turn the pitch point against each other, and s_1 - s_2 = 1/2 if not.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import pi, remainder

from geartrain.numerics.vectors import Vector, across, azimuth, cross, dot, frame, minus, size, unit
from geartrain.scene.layout.declared_geometry import PitchContact
from geartrain.scene.layout.parallel_groups import Arrangement
from geartrain.scene.layout.wheel_sizes import opposite

_MEET = 1e-6  # of a pitch: nearer, teeth meet


@dataclass(frozen=True, slots=True)
class PitchSide:
    """The pitch point of a pair as one of its wheels sees it.

    angle  of the pitch point about the wheel's axis, from the axis' reference (rad)
    """

    wheel: str
    teeth: int
    angle: float


@dataclass(frozen=True, slots=True)
class PitchPoint:
    """The pitch point of a pair.

    sense  1 where positive angles about both axes turn the pitch point the same way, -1 where against each other
    """

    name: str
    first: PitchSide
    second: PitchSide
    sense: int

    def seen_from(self, wheel: str) -> tuple[PitchSide, PitchSide]:
        """A wheel of the pair, and its mate."""
        return (self.first, self.second) if self.first.wheel == wheel else (self.second, self.first)


@dataclass(frozen=True, slots=True)
class MeshAlignment:
    """Angles of the first tooth of each wheel (rad, from 0 to a pitch); misses (pitches) of pairs that close a loop."""

    turns: Mapping[str, float]
    misses: Mapping[str, float]


def reference(direction: Vector) -> Vector:
    """Unit vector across an axis from which angles are counted: x where the axis is z."""
    return frame(direction)[0]


def align_meshes(found: Arrangement) -> MeshAlignment:
    """Angles at which the wheels of a train mesh, as they stand."""
    return _aligned([_pitch_point(found, contact) for contact in found.geometry.declared.contacts])


def _pitch_point(found: Arrangement, contact: PitchContact) -> PitchPoint:
    declared = found.geometry.declared
    directions = [declared.lines[axis].direction for axis in contact.axes]
    outs = _side_by_side(found, contact) if contact.parallel else _seated(found, contact)
    first, second = (
        PitchSide(wheel, declared.count(wheel), azimuth(across(out, direction), direction, reference(direction)))
        for wheel, direction, out in zip(contact.wheels, directions, outs, strict=True)
    )
    same = dot(cross(directions[0], outs[0]), cross(directions[1], outs[1])) > 0
    return PitchPoint(contact.name, first, second, contact.worm_sense or (1 if same else -1))


def _seated(found: Arrangement, contact: PitchContact) -> tuple[Vector, Vector]:
    """Where wheels of axes that are not parallel touch, as each wheel sees it."""
    first, second = (found.geometry.seats[contact.name, wheel] for wheel in contact.wheels)
    return first.out, second.out


def _side_by_side(found: Arrangement, contact: PitchContact) -> tuple[Vector, Vector]:
    """Towards each other, but away from the axis of a wheel that runs in a ring."""
    declared = found.geometry.declared
    direction = declared.lines[contact.axes[0]].direction
    apart = across(minus(found.points[contact.axes[1]], found.points[contact.axes[0]]), direction)
    out = unit(apart) if size(apart) else reference(direction)
    first, second = (declared.wheel(wheel).internal for wheel in contact.wheels)
    return opposite(out) if second else out, out if first else opposite(out)


def _aligned(points: Iterable[PitchPoint]) -> MeshAlignment:
    every = list(points)
    of: dict[str, list[PitchPoint]] = {}
    for one in every:
        of.setdefault(one.first.wheel, []).append(one)
        of.setdefault(one.second.wheel, []).append(one)
    turns: dict[str, float] = {}
    for start in of:
        if start in turns:
            continue
        own, _ = of[start][0].seen_from(start)
        turns[start] = own.angle % (2 * pi / own.teeth)
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for one in of[here]:
                own, mate = one.seen_from(here)
                if mate.wheel not in turns:
                    turns[mate.wheel] = _turn_of_mate(own, mate, one.sense, turns[here])
                    waiting.append(mate.wheel)
    misses = {one.name: _miss(one, turns) for one in every}
    return MeshAlignment(turns, {name: miss for name, miss in misses.items() if abs(miss) > _MEET})


def _past(side: PitchSide, turn: float) -> float:
    """Pitches by which the first tooth is past the pitch point."""
    return (turn - side.angle) * side.teeth / (2 * pi)


def _turn_of_mate(own: PitchSide, mate: PitchSide, sense: int, turn: float) -> float:
    """The angle of the mate of a wheel whose angle is known."""
    pitch = 2 * pi / mate.teeth
    # s_2 = 1/2 - s_1 where against each other, else s_1 - 1/2, which is s_1 + 1/2 (mod 1)
    return (mate.angle + (0.5 + sense * _past(own, turn)) * pitch) % pitch


def _miss(one: PitchPoint, turns: Mapping[str, float]) -> float:
    first, second = (_past(side, turns[side.wheel]) for side in (one.first, one.second))
    return remainder(first - one.sense * second - 0.5, 1.0)
