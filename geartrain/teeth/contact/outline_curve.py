"""A smooth curve of a tooth's outline; straight ones through points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class OutlineCurve:
    """A smooth curve of a tooth, from parameter `start` to `end`.

    Attributes
    ----------
    points : callable
        Parameters of shape (n,) -> (n, 2): x forward, y outward along the middle of the tooth, the axle at 0; or
        (n, 3), bevel, on the unit sphere, the axis along z.
    start, end : float
        Parameters of its ends.

    See Also
    --------
    polyline : straight curves.
    """

    points: Callable[[Floats], Floats]
    start: float = 0.0
    end: float = 1.0

    def at(self, t: ArrayLike) -> Floats:
        """Points of the curve.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            (n, 2), or (n, 3) on the sphere.
        """
        return np.asarray(self.points(np.asarray(t, dtype=float)), dtype=float)

    def polar(self, t: ArrayLike) -> Floats:
        """Radius and azimuth of points of the curve.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            (2, n): radius (bevel: polar angle [rad]) and azimuth [rad, forward from y].
        """
        points = self.at(t)
        x, y = points[:, 0], points[:, 1]
        radius = np.hypot(x, y)
        return np.stack([np.arctan2(radius, points[:, 2]) if points.shape[1] == 3 else radius, np.arctan2(x, y)])

    def mapped(self, change: Callable[[Floats], Floats]) -> OutlineCurve:
        """The curve whose points are those of this one, changed.

        Parameters
        ----------
        change : callable
            Points (n, 2) or (n, 3) to points of the same shape.

        Returns
        -------
        OutlineCurve
            With the same parameters.
        """
        return OutlineCurve(lambda t: change(self.points(t)), self.start, self.end)


def polyline(points: ArrayLike) -> tuple[OutlineCurve, ...]:
    """Straight curves through points; on the sphere arcs of great circles.

    Parameters
    ----------
    points : array_like
        (n, 2) or (n, 3), n at least 2.

    Returns
    -------
    tuple of OutlineCurve
        n - 1 of them.

    Examples
    --------
    >>> curve, = polyline([(0, 1), (0, 2)])
    >>> curve.at([0.5]).tolist()
    [[0.0, 1.5]]
    """
    return tuple(_straight(a, b) for a, b in pairwise(np.asarray(points, dtype=float)))


def _straight(a: Floats, b: Floats) -> OutlineCurve:
    def points(t: Floats) -> Floats:
        found: Floats = a + t[:, None] * (b - a)
        return found if len(a) == 2 else found / np.linalg.norm(found, axis=1, keepdims=True)

    return OutlineCurve(points)
