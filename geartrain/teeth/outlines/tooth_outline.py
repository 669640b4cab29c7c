"""One tooth from root to tip: flank, the round at the root, and what it leaves of the circle at its tip."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.contour import Contour, bulge_about

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.outlines.flank_curve import FlankCurve


Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class RootFillet:
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


def fillet(
    flank: FlankCurve, widening: float, root: float, radius: float, z: float, relief: float = 0.0
) -> RootFillet | None:
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
    found = RootFillet(
        (E[0] + t * T[0], E[1] + t * T[1]), (centre[0] * root / far, centre[1] * root / far), centre, radius
    )
    return found if found.half <= pi / z else None


_MEETING = 1e-9  # rad

Vertex = tuple[float, float, float]
"""A point, and the bulge of the edge to the next one."""


@dataclass(frozen=True, slots=True)
class ToothOutline:
    """A tooth of z alike; lengths in modules.

    widening   half angle (rad) of the tooth at the pitch circle
    root       radius of the root circle
    """

    z: float
    flank: FlankCurve
    fillet: RootFillet
    widening: float
    root: float

    @property
    def tip(self) -> float:
        """Radius of the tip circle."""
        return float(self.flank.r[-1])

    @property
    def land(self) -> float:
        """Half the angle (rad) of the top land."""
        return self.widening + float(self.flank.angle[-1])

    def half_at(self, radius: Floats) -> Floats:
        """Half angle (rad) of the tooth as it is cut, straight edges and round, at radii from root to tip."""
        x, y = np.array([point[:2] for point in self._half()[1:]]).T
        place = x + 1j * y
        r, s = np.abs(place), self.flank.outward
        at = np.clip(np.searchsorted(r * s, radius * s, side="right") - 1, 0, len(r) - 2)
        start, along = place[at], place[at + 1] - place[at]
        # |start + t along| = radius, on the side where the radius grows towards the tip
        a, b, c = np.abs(along) ** 2, (np.conj(along) * start).real, r[at] ** 2 - radius**2
        t = (-b + s * np.sqrt(np.maximum(b * b - a * c, 0.0))) / a
        edge = np.angle(start + np.clip(t, 0.0, 1.0) * along)
        if not self.fillet.radius:
            return np.asarray(edge)
        centre = complex(*self.fillet.centre)
        far = abs(centre)
        # where the radius is 0 no quotient of 0
        cosine = (radius**2 + far**2 - self.fillet.radius**2) / (2 * np.maximum(radius, 1e-300) * far)
        round_ = np.angle(centre) - np.arccos(np.clip(cosine, -1.0, 1.0))
        return np.asarray(np.where(radius * s < r[0] * s, round_, edge))

    def _half(self) -> list[tuple[float, float, float]]:
        """From root to tip on the far side of the axis of the tooth, with the bulge to the next point."""
        fillet = self.fillet
        half = self.widening + self.flank.angle
        flank = zip((self.flank.r * np.cos(half)).tolist(), (self.flank.r * np.sin(half)).tolist(), strict=True)
        round_ = bulge_about(fillet.end, fillet.start, fillet.centre) if fillet.radius else 0.0
        end = fillet.end
        if pi / self.z - fillet.half < _MEETING:  # two rounds meet in the middle of the space
            end = self.root * cos(pi / self.z), self.root * sin(pi / self.z)
        return [(*end, round_), (*fillet.start, 0.0), *((x, y, 0.0) for x, y in flank)]

    def whole(self) -> Contour:
        """All teeth round the axle, counter-clockwise, the first of them about the x axis."""
        return Contour.of(repeated(self.vertices(), int(self.z)))

    def vertices(self) -> list[Vertex]:
        """One tooth about the x axis, from one root to the other, the last edge along the root circle."""
        half = self._half()
        origin = (0.0, 0.0)
        x, y, _ = half[-1]
        land = bulge_about((x, -y), (x, y), origin)
        gap = pi / self.z - self.fillet.half
        ground = np.tan(gap / 2) if gap >= _MEETING else 0.0
        up = [(x, -y, -bulge) for x, y, bulge in half[:-1]] + [(x, -y, float(land))]
        # coming down each edge is met at its other end
        bulges = [bulge for _, _, bulge in half]
        down = [(x, y, -bulge) for (x, y, _), bulge in zip(half[:0:-1], bulges[-2::-1], strict=True)]
        return [*up, *down, (*half[0][:2], float(ground))]


def repeated(tooth: Sequence[Vertex], z: int) -> Iterator[Vertex]:
    """z teeth round the axle from one."""
    for k in range(z):
        c, s = cos(2 * pi * k / z), sin(2 * pi * k / z)
        for x, y, bulge in tooth:
            yield c * x - s * y, s * x + c * y, bulge


def pin_span(R: float, radius: float) -> Floats:
    """A pin of `radius` on the circle of radius R, radius and signed angle (2, n)."""
    turn = np.linspace(0, 2 * pi, 181)
    x, y = R + radius * np.cos(turn), radius * np.sin(turn)
    return np.stack([np.hypot(x, y), np.arctan2(y, x)])
