"""An independent reference for cut wheels: their whole outlines as polygons, which are moved until they touch.

A wheel is given by the polar coordinates of each tip about the axle and the directions of its two flanks. Flanks are
extended to the intersection with the neighbouring flank, and shapely decides whether two outlines overlap.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import shapely


class Outline(NamedTuple):
    """A wheel about its own axle: tips at theta [rad] and r, and the half angles of both flanks [rad].

    `less` is the flank on the side of smaller angles. The flanks of a ring lead outwards from its tips.
    """

    theta: np.ndarray
    r: np.ndarray
    less: np.ndarray
    more: np.ndarray
    ring: bool = False

    @property
    def points(self) -> np.ndarray:
        """Tips and valleys in turn, (2 z, 2)."""
        tips = np.stack([self.r * np.cos(self.theta), self.r * np.sin(self.theta)], axis=-1)
        following = np.roll(tips, -1, axis=0)
        # inwards from a tip, in a ring outwards, turned to either side
        way = 1 if self.ring else -1
        out = self.theta + way * self.more
        back = np.roll(self.theta - way * self.less, -1)
        a = way * np.stack([np.cos(out), np.sin(out)], axis=-1)
        b = way * np.stack([np.cos(back), np.sin(back)], axis=-1)
        gap = following - tips
        along = (gap[:, 0] * b[:, 1] - gap[:, 1] * b[:, 0]) / (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        valleys = tips + along[:, None] * a
        return np.stack([tips, valleys], axis=1).reshape(-1, 2)

    def about(self, e: float, towards: float) -> Outline:
        """Return the outline about an axle from which its centre is at the distance e in direction `towards`."""
        points = self.points + e * np.array([np.cos(towards), np.sin(towards)])
        tips, after = points[::2], points[1::2]
        before = np.roll(after, 1, axis=0)
        theta = np.arctan2(tips[:, 1], tips[:, 0])

        def lean(valley: np.ndarray) -> np.ndarray:
            flank, inwards = valley - tips, tips if self.ring else -tips
            cross = flank[:, 0] * inwards[:, 1] - flank[:, 1] * inwards[:, 0]
            return np.abs(np.arctan2(cross, (flank * inwards).sum(axis=1)))

        near = theta + 2 * np.pi * np.round((self.theta - theta) / (2 * np.pi))
        return Outline(near, np.hypot(*tips.T), lean(before), lean(after), self.ring)


class Judge:
    """Two outlines on axles `D` apart. The driver at t has its tips at theta + t from the line to the other axle.

    The driven wheel is reflected, so that both angles increase together. The axle of a ring is on the other side of its
    mate's axle, nothing is reflected, and its mate is free while it is in the hole.
    """

    def __init__(self, driver: Outline, driven: Outline, D: float) -> None:
        self.driver, self.driven, self.D = driver.points, driven.points, D
        self.rings = driver.ring, driven.ring

    @classmethod
    def of(cls, sizes: Any) -> Judge:
        """Return the outlines of a pair of even wheels, of which one may be a ring."""
        wheels = zip((sizes.z1, sizes.z2), sizes.radii, sizes.half_angles, sizes.signs, strict=True)
        return cls(
            *(
                Outline(np.arange(z) * 2 * np.pi / z, *np.full((3, z), [[R], [b], [b]]), sign < 0)
                for z, R, b, sign in wheels
            ),
            sizes.D,
        )

    def overlap(self, t: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return True where the wheels overlap at driver positions t and driven positions y, (n,) each."""
        one, two = _turned(self.driver, t), _turned(self.driven, y)
        if any(self.rings):
            two[..., 0] += self.D if self.rings[0] else -self.D
            hole, mate = (one, two) if self.rings[0] else (two, one)
            return ~shapely.covers(shapely.polygons(hole), shapely.polygons(mate))
        two[..., 0] = self.D - two[..., 0]
        return shapely.intersects(shapely.polygons(one), shapely.polygons(two))

    def free(self, t: np.ndarray, centre: np.ndarray, width: float, steps: int = 60) -> tuple[np.ndarray, np.ndarray]:
        """Return the minimum and maximum free y about `centre`, or the nearest free y within `width`; else NaN."""
        offsets = np.linspace(-width, width, 2 * steps + 1)
        open_ = ~self.overlap(np.repeat(t, len(offsets)), (centre[:, None] + offsets).ravel())
        open_ = open_.reshape(len(t), -1)
        distance = np.where(open_, np.abs(offsets), np.inf)
        start = distance.argmin(axis=1)
        found = np.isfinite(distance.min(axis=1))
        low, high = np.full(len(t), np.nan), np.full(len(t), np.nan)
        for ends, way in ((low, -1), (high, 1)):
            for at in np.flatnonzero(found):
                inside = start[at]
                while 0 <= inside + way < len(offsets) and open_[at, inside + way]:
                    inside += way
                ends[at] = centre[at] + offsets[inside]
            beyond = ends + way * (offsets[1] - offsets[0])
            ends[found] = self._bisected(t[found], ends[found], beyond[found])
        return low, high

    def _bisected(self, t: np.ndarray, free: np.ndarray, met: np.ndarray) -> np.ndarray:
        for _ in range(36):
            middle = (free + met) / 2
            hit = self.overlap(t, middle)
            free, met = np.where(hit, free, middle), np.where(hit, middle, met)
        return free


def _turned(points: np.ndarray, by: np.ndarray) -> np.ndarray:
    cosine, sine = np.cos(by)[:, None], np.sin(by)[:, None]
    x, y = points[:, 0], points[:, 1]
    return np.stack([x * cosine - y * sine, x * sine + y * cosine], axis=-1)
