"""The angles at which wheels sit on their arbors, so that teeth of one meet spaces of the other."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import atan2, pi, remainder

from geartrain.numerics.vectors import Vector, across, cross, dot, frame


@dataclass(frozen=True, slots=True)
class PitchPoint:
    """The pitch point of a pair as each wheel sees it.

    wheels  its wheels; `teeth`, their tooth numbers
    angles  of the pitch point about each axis, from each wheel's reference (rad)
    turned  1 where both axes turn the pitch point the same way for positive angles, -1 where against each other
    """

    name: str
    wheels: tuple[str, str]
    teeth: tuple[int, int]
    angles: tuple[float, float]
    turned: int


def pitch_point(
    name: str,
    wheels: tuple[str, str],
    teeth: tuple[int, int],
    ways: tuple[Vector, Vector],
    outs: tuple[Vector, Vector],
    turned: int = 0,
) -> PitchPoint:
    """A contact from the directions of axes and the ways across them to the pitch point."""
    angles = tuple(azimuth(way, out) for way, out in zip(ways, outs, strict=True))
    same = dot(cross(ways[0], outs[0]), cross(ways[1], outs[1]))
    return PitchPoint(name, wheels, teeth, angles, turned or (1 if same > 0 else -1))  # type: ignore[arg-type]


def reference(way: Vector) -> Vector:
    """Unit vector across an axis from which angles are counted: x where the axis is z."""
    return frame(way)[0]


def azimuth(way: Vector, out: Vector) -> float:
    """Angle of a direction about an axis, from its reference (rad)."""
    first, second = frame(way)
    flat = across(out, way)
    return atan2(dot(flat, second), dot(flat, first))


def align_meshes(contacts: Iterable[PitchPoint]) -> tuple[dict[str, float], dict[str, float]]:
    """Angles of the first tooth of each wheel (rad, from 0 to a pitch); misses (pitches) of pairs that close a loop.

    With s the pitches by which a tooth is past the pitch point, positive as the wheel turns, teeth and spaces meet
    where s_1 + s_2 = 1/2 (mod 1) if wheels turn against each other there, and s_1 - s_2 = 1/2 if not.
    """
    of: dict[str, list[PitchPoint]] = {}
    every = list(contacts)
    for one in every:
        for wheel in one.wheels:
            of.setdefault(wheel, []).append(one)
    turns: dict[str, float] = {}
    for start in of:
        if start in turns:
            continue
        first = of[start][0]
        side = first.wheels.index(start)
        turns[start] = first.angles[side] % (2 * pi / first.teeth[side])
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for one in of[here]:
                mate = one.wheels[1 - one.wheels.index(here)]
                if mate not in turns:
                    turns[mate] = _meet(one, here, turns[here])
                    waiting.append(mate)
    misses = {one.name: _miss(one, turns) for one in every}
    return turns, {name: miss for name, miss in misses.items() if abs(miss) > 1e-6}


def _meet(one: PitchPoint, here: str, turn: float) -> float:
    """The angle of the mate of a wheel that is mounted."""
    side = one.wheels.index(here)
    past = (turn - one.angles[side]) * one.teeth[side] / (2 * pi)
    pitch = 2 * pi / one.teeth[1 - side]
    # s_2 = 1/2 - s_1 where against each other, else s_1 - 1/2
    return (one.angles[1 - side] + (0.5 + one.turned * past) * pitch) % pitch


def _miss(one: PitchPoint, turns: Mapping[str, float]) -> float:
    past = [
        (turns[wheel] - angle) * teeth / (2 * pi)
        for wheel, angle, teeth in zip(one.wheels, one.angles, one.teeth, strict=True)
    ]
    return remainder(past[0] - one.turned * past[1] - 0.5, 1.0)
