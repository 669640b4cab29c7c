"""Contact of triangular teeth from the outlines of both wheels only, and the moments of the contact force.

The driver turns about the origin, the driven wheel about (D, 0), and the teeth move upwards at the line of centres: a
tip of the driver at the angle t from this line is at R1 (cos t, sin t), and a tip of the driven wheel at u is at
(D - R2 cos u, R2 sin u). The driver pushes upwards: a tip of one wheel is on a flank of the other, and the tooth pair
that advances the driven wheel farthest drives. The other flanks are treated by reflection.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from plane_statics import Touch, Vector


class Places(NamedTuple):
    """Driven angle u minus whole pitches, point of contact, and normal on the driven wheel, each over (n,)."""

    driven: np.ndarray
    x: np.ndarray
    y: np.ndarray
    normal_x: np.ndarray
    normal_y: np.ndarray


@dataclass(frozen=True)
class Outlines:
    """Two wheels with straight flanks that meet in points; lengths in one unit, half angles in radians."""

    z1: int
    z2: int
    R1: float
    R2: float
    b1: float
    b2: float
    D: float

    @classmethod
    def of(cls, sizes: Any) -> Outlines:
        """Return the outlines for the declared sizes of a pair."""
        return cls(sizes.z1, sizes.z2, sizes.R1, sizes.R2, sizes.beta1, sizes.beta2, sizes.D)

    def places(self, t: np.ndarray) -> Places:
        """Return the contact of the front flanks with a tip of the driver at t, (n,)."""
        pitch = 2 * np.pi / self.z1
        whole = np.round(t / pitch)
        found = [self._tooth_pair(t - whole * pitch + k * pitch, k) for k in range(-3, 4)]
        ahead = np.array([each.driven for each in found])
        best = ahead.argmax(axis=0)
        assert np.isfinite(ahead.max(axis=0)).all(), "no tooth touches"
        chosen = [np.take_along_axis(np.array(values), best[None], 0)[0] for values in zip(*found, strict=True)]
        return Places(chosen[0] + whole * 2 * np.pi / self.z2, *chosen[1:])

    def _tooth_pair(self, theta: np.ndarray, k: int) -> Places:
        """Return the driven angle for a driving tooth at theta and the k-th driven tooth; -inf without contact."""
        one, other = self._tip_of_driver(theta), self._tip_of_driven(theta)
        first = one.driven >= other.driven
        found = [np.where(first, *values) for values in zip(one, other, strict=True)]
        return Places(found[0] - k * 2 * np.pi / self.z2, *found[1:])

    def _tip_of_driver(self, theta: np.ndarray) -> Places:
        """Return the contact of the driver's tip with the lower flank of a driven tooth, by the law of sines."""
        x, y = self.R1 * np.cos(theta), self.R1 * np.sin(theta)
        away = np.hypot(self.D - x, y)
        valley = self.R2 * np.sin(self.b2) / np.sin(self.b2 + np.pi / self.z2)
        reached = (away <= self.R2) & (away >= valley)
        leans = np.arcsin(np.minimum(1.0, self.R2 * np.sin(self.b2) / away))
        u = np.where(reached, np.arctan2(y, self.D - x) + leans - self.b2, -np.inf)
        held = np.where(reached, u, 0.0)
        # along the flank from the driven tip towards the valley below it
        along = np.cos(held + self.b2), -np.sin(held + self.b2)
        return Places(u, x, y, *_upwards(along))

    def _tip_of_driven(self, theta: np.ndarray) -> Places:
        """Return the contact of a driven tip with the driver's upper flank, where its line leaves the tip circle."""
        along = -np.cos(theta - self.b1), -np.sin(theta - self.b1)
        x, y = self.R1 * np.cos(theta) - self.D, self.R1 * np.sin(theta)
        middle = -(x * along[0] + y * along[1])
        square = middle**2 - (x**2 + y**2 - self.R2**2)
        far = middle + np.sqrt(np.maximum(square, 0.0))
        length = self.R1 * np.sin(np.pi / self.z1) / np.sin(self.b1 + np.pi / self.z1)
        reached = (square >= 0) & (far >= 0) & (far <= length)
        x, y = x + far * along[0], y + far * along[1]
        return Places(np.where(reached, np.arctan2(y, -x), -np.inf), x + self.D, y, *_upwards(along))

    def moments(self, t: np.ndarray, friction: float) -> tuple[np.ndarray, np.ndarray]:
        """Return driven speed divided by driver speed, and driver torque divided by load torque, of front flanks."""
        at = self.places(t)
        # velocities of both points along the normal, for unit speeds: the driven wheel turns the other way round
        first = -at.y * at.normal_x + at.x * at.normal_y
        second = at.y * at.normal_x + (self.D - at.x) * at.normal_y
        speed = first / second
        along = -at.normal_y, at.normal_x
        slides = speed * (at.y * along[0] + (self.D - at.x) * along[1]) - (-at.y * along[0] + at.x * along[1])
        rubs = -friction * np.sign(slides)
        force = at.normal_x + rubs * along[0], at.normal_y + rubs * along[1]
        into = at.x * force[1] - at.y * force[0]
        out = (self.D - at.x) * force[1] + at.y * force[0]
        return speed, into / out

    def driven(self, t: float, flank: int = 0) -> float:
        """Return the angle of a driven tooth whose lower flank is pushed (0), or whose mate below is held back (1).

        The first angle is a lower limit and the second an upper limit; they differ by the backlash.
        """
        if flank == 0:
            return float(self.places(np.array([t])).driven[0])
        return 2 * np.pi / self.z2 - float(self.places(np.array([-t])).driven[0])

    def touch(
        self,
        t: float,
        links: tuple[str, str],
        centres: tuple[Vector, Vector],
        friction: float,
        flank: int = 0,
        clockwise: bool = False,
    ) -> Touch:
        """Return the contact of the front (0) or back (1) flank at one angle of the driver, in any position in the
        plane.

        t   counted forwards, which may be clockwise
        """
        mirror = (1.0, -1.0)[flank]
        at = self.places(np.array([mirror * t]))
        up = mirror * (-1.0 if clockwise else 1.0)
        point, normal = (float(at.x[0]), up * float(at.y[0])), (float(at.normal_x[0]), up * float(at.normal_y[0]))
        return Touch(*links, _moved(point, centres, self.D), _turned(normal, centres), friction)


def _upwards(along: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return the normal of a flank that has an upward component, the direction in which the driver pushes."""
    sign = np.where(along[0] > 0, 1.0, -1.0)
    return -along[1] * sign, along[0] * sign


def _turned(vector: Vector, centres: tuple[Vector, Vector]) -> Vector:
    (x, y), (X, Y) = centres
    distance = np.hypot(X - x, Y - y)
    c, s = (X - x) / distance, (Y - y) / distance
    return float(vector[0] * c - vector[1] * s), float(vector[0] * s + vector[1] * c)


def _moved(point: Vector, centres: tuple[Vector, Vector], D: float) -> Vector:
    """Return a point in the coordinates of the pair, whose axes are D apart."""
    scale = np.hypot(centres[1][0] - centres[0][0], centres[1][1] - centres[0][1]) / D
    x, y = _turned(point, centres)
    return float(centres[0][0] + scale * x), float(centres[0][1] + scale * y)
