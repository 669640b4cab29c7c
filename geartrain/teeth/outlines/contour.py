"""Closed curves of straight edges and circular arcs, stored as vertices with bulges, as in DXF files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import acos, atan, ceil, cos, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_SAME = 1e-9  # vertices closer than this are merged
_MINIMUM_STEP = 2 * pi / 65536  # minimum angle of a chord (rad), which bounds the number of points of very large wheels


@dataclass(frozen=True, slots=True)
class Contour(Shown):
    """Closed curve of straight edges and circular arcs. Arcs are stored as bulges, as in DXF.

    Examples
    --------
    >>> round(Contour.circle(2.0).moments()[0], 6)
    12.566371
    """

    points: Floats
    """Vertices of the contour, shape (n, 2) [mm; modules before scaling]. The last one is joined to the first."""
    bulges: Floats
    """Bulge of the edge that starts at each vertex, shape (n,): tan(sweep / 4), where the sweep is the angle of the
    arc. The bulge is 0 for a straight edge and positive for an edge that turns left.
    """

    @classmethod
    def of(cls, vertices: Iterable[tuple[float, float, float]]) -> Contour:
        """Return a contour through the given vertices with bulges. Edges shorter than 1e-9 are omitted.

        Parameters
        ----------
        vertices : iterable of tuple
            x, y and bulge of each vertex.
        """
        found = np.array(list(vertices), dtype=float)
        # an arc without a chord would have no centre
        long = np.hypot(*(np.roll(found[:, :2], -1, axis=0) - found[:, :2]).T) > _SAME
        return cls(found[long, :2], found[long, 2])

    @classmethod
    def circle(cls, radius: float, centre: tuple[float, float] = (0.0, 0.0)) -> Contour:
        """Return a circular contour, made of two half circles.

        Parameters
        ----------
        radius : float
            Radius [mm].
        centre : tuple of float
            Centre [mm].
        """
        x, y = centre
        return cls(np.array([[x + radius, y], [x - radius, y]]), np.ones(2))

    def scaled(self, factor: float) -> Contour:
        """Return a contour with the same shape at another scale.

        Parameters
        ----------
        factor : float
            Scale factor, above 0.
        """
        return Contour(self.points * factor, self.bulges)

    @property
    def is_circle(self) -> bool:
        """True if the contour consists of two half circles, as created by `circle`."""
        return len(self.points) == 2 and bool((self.bulges == 1).all())

    def _edges(self) -> Iterator[tuple[Floats, Floats, float]]:
        """Yield the start point, the end point and the bulge of every edge."""
        return zip(self.points, np.roll(self.points, -1, axis=0), self.bulges.tolist(), strict=True)

    def moments(self) -> tuple[float, float]:
        """Return the enclosed area [mm2] and the polar second moment of this area about the origin [mm4], computed
        exactly by Green's theorem.

        Each result is the value of the polygon of the vertices plus the values of the circular segments of all arcs.
        Both results are negative if the contour is clockwise.
        """
        (x, y), (u, v) = self.points.T, np.roll(self.points, -1, axis=0).T
        cross = x * v - y * u
        area = float(cross.sum() / 2)
        polar = float((cross * (x * x + x * u + u * u + y * y + y * v + v * v)).sum() / 12)
        for start, end, bulge in self._edges():
            if bulge:
                own = _segment_moments(start, end, bulge)
                area, polar = area + own[0], polar + own[1]
        return area, polar

    def flattened(self, tolerance: float) -> Floats:
        """Return the vertices of a polygon that deviates from the contour by at most `tolerance`.

        A circle has at most 65 536 points, so that the deviation exceeds `tolerance` at radii above 8.7e8 times
        `tolerance`.

        Parameters
        ----------
        tolerance : float
            Maximum deviation [mm].

        Returns
        -------
        ndarray
            Points, shape (m, 2); the first point is not repeated.
        """
        parts = []
        for start, end, bulge in self._edges():
            parts.append(_arc(start, end, bulge, tolerance) if bulge else start[None, :])
        return np.concatenate(parts)


def _arc(start: Floats, end: Floats, bulge: float, tolerance: float) -> Floats:
    """Return points of a polyline within `tolerance` of an arc with a given bulge. The last point is omitted."""
    radius, sweep = arc_radius(start, end, bulge), 4 * atan(bulge)
    # angle of the chord whose sagitta equals the tolerance
    step = max(2 * acos(max(1 - tolerance / radius, -1.0)), _MINIMUM_STEP)
    count = max(1, ceil(abs(sweep) / step))
    centre = _arc_centre(start, end, bulge)
    turn = sweep * np.arange(count) / count
    x, y = start - centre
    return np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], axis=1) + centre


def _segment_moments(start: Floats, end: Floats, bulge: float) -> tuple[float, float]:
    """Return the area of the circular segment between an arc and its chord, and the polar second moment of this area
    about the origin, in powers of the unit of `start` and `end`.
    """
    R, s = arc_radius(start, end, bulge), 4 * atan(bulge)
    centre = _arc_centre(start, end, bulge)
    area = R**2 * (s - sin(s)) / 2
    # second moment about the centre of the arc, and first moment along the bisector
    own = R**4 * (s / 4 - sin(s) * (2 + cos(s)) / 12)
    x, y = (start - centre) / R
    bisector = np.array([x * cos(s / 2) - y * sin(s / 2), x * sin(s / 2) + y * cos(s / 2)])
    first = 2 / 3 * R**3 * sin(s / 2) ** 3
    return area, float(area * (centre @ centre) + 2 * first * (centre @ bisector) + own)


def _arc_centre(start: Floats, end: Floats, bulge: float) -> Floats:
    chord = end - start
    return np.asarray((start + end) / 2 + np.array([-chord[1], chord[0]]) * (1 - bulge**2) / (4 * bulge))


def arc_radius(start: Floats, end: Floats, bulge: float) -> float:
    """Return the radius of the arc with a given bulge from `start` to `end`, in the unit of these vertices."""
    return float(np.hypot(*(end - start))) * (1 + bulge**2) / (4 * abs(bulge))


def bulge_about(start: complex, end: complex, centre: complex = 0j) -> float:
    """Return the bulge of the shorter arc from `start` to `end` about `centre`, all as complex numbers x + iy."""
    return tan(float(np.angle((end - centre) / (start - centre))) / 4)
