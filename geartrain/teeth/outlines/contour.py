"""Closed curves of straight edges and circular arcs, as DXF has them: vertices, each with the bulge of its edge."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import acos, atan, ceil, pi, tan
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_SAME = 1e-9  # vertices nearer than this are one


@dataclass(frozen=True, slots=True)
class Contour:
    """A closed curve.

    points   (n, 2), mm; the last one joins the first
    bulges   (n,) of the edge that leaves each vertex: tan(sweep / 4), 0 straight, positive where it turns left
    """

    points: Floats
    bulges: Floats

    @classmethod
    def of(cls, vertices: Iterable[tuple[float, float, float]]) -> Contour:
        """From (x, y, bulge), edges of no length left out."""
        found = np.array(list(vertices), dtype=float)
        long = np.hypot(*(np.roll(found[:, :2], -1, axis=0) - found[:, :2]).T) > _SAME
        return cls(found[long, :2], found[long, 2])

    @classmethod
    def circle(cls, radius: float, centre: tuple[float, float] = (0.0, 0.0)) -> Contour:
        """Two half circles."""
        x, y = centre
        return cls(np.array([[x + radius, y], [x - radius, y]]), np.ones(2))

    def scaled(self, factor: float) -> Contour:
        """The same shape, larger."""
        return Contour(self.points * factor, self.bulges)

    @property
    def is_circle(self) -> bool:
        """True for what `circle` makes."""
        return len(self.points) == 2 and bool((self.bulges == 1).all())

    def flattened(self, tolerance: float) -> Floats:
        """Points (m, 2), the first not repeated, whose chords leave the arcs by at most `tolerance` (mm)."""
        parts = []
        for start, end, bulge in zip(self.points, np.roll(self.points, -1, axis=0), self.bulges, strict=True):
            parts.append(_arc(start, end, float(bulge), tolerance) if bulge else start[None, :])
        return np.concatenate(parts)


def _arc(start: Floats, end: Floats, bulge: float, tolerance: float) -> Floats:
    """Points of an arc, its end left out."""
    radius, sweep = arc_radius(start, end, bulge), 4 * atan(bulge)
    # the chord whose sagitta is the tolerance; 0 where that is lost beside 1: tenths of a degree then
    step = 2 * acos(max(1 - tolerance / radius, -1.0)) or pi / 1800
    count = max(1, ceil(abs(sweep) / step))
    chord = end - start
    centre = (start + end) / 2 + np.array([-chord[1], chord[0]]) * (1 - bulge**2) / (4 * bulge)
    turn = sweep * np.arange(count) / count
    x, y = start - centre
    return np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], axis=1) + centre


def arc_radius(start: Floats, end: Floats, bulge: float) -> float:
    """Radius of the arc between two vertices."""
    return float(np.hypot(*(end - start))) * (1 + bulge**2) / (4 * abs(bulge))


def bulge_about(start: tuple[float, float], end: tuple[float, float], centre: tuple[float, float]) -> float:
    """The bulge of the shorter arc about `centre` from `start` to `end`."""
    a, b = (complex(x - centre[0], y - centre[1]) for x, y in (start, end))
    return tan(float(np.angle(b / a)) / 4)
