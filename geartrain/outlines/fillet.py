"""The root of a tooth: straight on from the flank, then a round that touches the root circle."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.outlines.flank import Flank

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Fillet:
    """In the frame of the tooth: x along its axis, y towards the space; modules.

    start    where the straight line ends and the round begins
    end      where the round touches the root circle
    centre, radius   of the round
    """

    start: Point
    end: Point
    centre: Point
    radius: float

    @property
    def half(self) -> float:
        """Angle (rad) between the axis of the tooth and where its root circle begins."""
        return atan2(self.end[1], self.end[0])


def fillet(flank: Flank, widening: float, root: float, radius: float, z: int, relief: float = 0.0) -> Fillet | None:
    """The round of `radius` between the flank and the circle of radius `root`; None where there is no room.

    widening   half angle of the tooth at the pitch circle (rad)
    relief     how far (rad) the straight line is turned into the tooth, off the flank's tangent
    """
    r, half = float(flank.r[0]), widening + float(flank.angle[0])
    E = (r * cos(half), r * sin(half))
    along, across = flank.tangent
    lean = atan2(across, abs(along)) - relief
    along, across = (cos(lean) if along > 0 else -cos(lean)), sin(lean)
    T = (along * cos(half) - across * sin(half), along * sin(half) + across * cos(half))
    N = (-T[1], T[0])
    if -N[0] * sin(half) + N[1] * cos(half) < 0:
        N = (-N[0], -N[1])
    s = flank.outward
    base = (E[0] + radius * N[0], E[1] + radius * N[1])
    b = base[0] * T[0] + base[1] * T[1]
    c = base[0] ** 2 + base[1] ** 2 - (root + s * radius) ** 2
    under = b * b - c
    if s * c < 0 or under < 0:
        return None
    t = -b - s * sqrt(under)
    if t < 0:
        return None
    centre = (base[0] + t * T[0], base[1] + t * T[1])
    far = hypot(*centre)
    found = Fillet((E[0] + t * T[0], E[1] + t * T[1]), (centre[0] * root / far, centre[1] * root / far), centre, radius)
    return found if found.half <= pi / z else None
