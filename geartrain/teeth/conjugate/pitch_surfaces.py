"""Pitch surfaces of a gear pair: cylinders (spur), cones (bevel), and a ring gear with a negative radius."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True, slots=True)
class PitchSurfaces:
    """Pitch cylinders or cones of a gear pair in which gear 1 drives.

    z1, z2   tooth numbers; the virtual tooth numbers of bevel gears need not be integers
    R1, R2   spur: pitch radii in modules; bevel: half-angles of the pitch cones [rad]
    bevel    True for cones

    A ring gear is gear 2 with a negative R2. The formulas of an external pair then apply to a ring gear without change.
    """

    z1: float
    z2: float
    R1: float
    R2: float
    bevel: bool = False

    @classmethod
    def spur(cls, z1: float, z2: float, internal: bool = False) -> PitchSurfaces:
        """Return the pitch cylinders of gears on parallel axes with module 1. An `internal` gear 2 is a ring gear."""
        return cls(z1, z2, z1 / 2, -z2 / 2 if internal else z2 / 2)

    @classmethod
    def cones(cls, z1: float, z2: float, shaft_angle: float = pi / 2) -> PitchSurfaces:
        """Return the pitch cones of gears whose axes intersect at the angle `shaft_angle` [rad].

        The half-angles follow from tan R1 = sin S / (z2/z1 + cos S) and R1 + R2 = S, where S is the shaft angle.
        """
        R1 = atan2(sin(shaft_angle), z2 / z1 + cos(shaft_angle))
        return cls(z1, z2, R1, shaft_angle - R1, True)

    @property
    def A(self) -> float:
        """Curvature of the pitch surface of gear 1: 1/R1 [1/module], or cot R1 on cones."""
        return 1 / tan(self.R1) if self.bevel else 1 / self.R1

    @property
    def B(self) -> float:
        """Curvature of the pitch surface of gear 2: 1/R2 [1/module], or cot R2 on cones; negative for ring gears."""
        return 1 / tan(self.R2) if self.bevel else 1 / self.R2

    @property
    def reach(self) -> float:
        """Arc on the pitch surfaces per radian of rotation of gear 1: R1, or sin R1 on cones."""
        return sin(self.R1) if self.bevel else self.R1

    @property
    def reach2(self) -> float:
        """Arc on the pitch surfaces per radian of rotation of gear 2: R2 (below 0 for rings), or sin R2 on cones."""
        return sin(self.R2) if self.bevel else self.R2

    def teeth_of(self, gear: int) -> float:
        """Return the tooth number of gear 1 or 2."""
        return self.z1 if gear == 1 else self.z2

    def reach_of(self, gear: int) -> float:
        """Return the absolute value of the arc on the pitch surfaces per radian of rotation of gear 1 or 2."""
        return self.reach if gear == 1 else abs(self.reach2)

    def axle_of(self, gear: int) -> float:
        """Return the height of a gear's axle above the pitch point [module]; for bevel gears, the angle of the axle
        from the pitch point [rad].
        """
        return -self.R1 if gear == 1 else self.R2

    @property
    def p(self) -> float:
        """Circular pitch as an arc X [module; rad for bevel gears]."""
        return 2 * pi * self.reach / self.z1

    def S(self, d: ArrayLike) -> Floats:
        """Return the function S of the distance d from the pitch point: S = d on cylinders, S = sin d on cones."""
        # with S instead of d, docs/shapes.md (2) to (5) hold for spur and bevel gears
        found: Floats = np.sin(d) if self.bevel else np.asarray(d, dtype=float)
        return found

    def S_slope(self, d: ArrayLike) -> Floats:
        """Return dS/dd at distances d from the pitch point: 1 on cylinders, cos d on cones."""
        found: Floats = np.cos(d) if self.bevel else np.ones(np.shape(d))
        return found

    def S_integral(self, d: ArrayLike) -> Floats:
        """Return the integral of S from 0 to the distance d: d^2/2 on cylinders, 1 - cos d on cones."""
        d = np.asarray(d, dtype=float)
        # 1 - cos d would cancel near the pitch point
        found: Floats = 2 * np.sin(d / 2) ** 2 if self.bevel else d * d / 2
        return found

    def point(self, d: Floats, sin_psi: Floats, cos_psi: Floats) -> Floats:
        """Return contact points in the fixed frame, from their distance `d` from the pitch point and their pressure
        angle psi. x is along the pitch line, and the axle of gear 1 is at negative y. The shape is (..., 2) from the
        pitch point, or (..., 3) on the unit sphere.
        """
        S = self.S(d)
        if not self.bevel:
            return np.stack([S * cos_psi, S * sin_psi], axis=-1)
        return np.stack([S * cos_psi, S * sin_psi, np.cos(d)], axis=-1)

    def on_gear(self, gear: int, points: Floats, X: Floats) -> Floats:
        """Transform points from the fixed frame to the frame of a gear, which is equal to the fixed frame at X = 0.

        When the pitch surfaces have rolled by the arc X, gear 1 has turned about its axle by X / reach and gear 2 by -X
        / reach2. The points are turned back by this angle (for cones, by Rodrigues' formula).
        """
        angle, R = X / self.reach if gear == 1 else -X / self.reach2, self.axle_of(gear)
        cosine, sine = np.cos(angle), np.sin(angle)
        if not self.bevel:
            x, y = points[..., 0], points[..., 1] - R
            return np.stack([x * cosine - y * sine, x * sine + y * cosine + R], axis=-1)
        axis, _ = self._axis_and_up(gear)
        along = (points @ axis)[..., None] * axis
        across = np.cross(np.broadcast_to(axis, points.shape), points)
        turned: Floats = along + (points - along) * cosine[..., None] + across * sine[..., None]
        return turned

    def polar(self, gear: int, points: Floats) -> tuple[Floats, Floats]:
        """Return radii and azimuths [rad] of points of the fixed frame about the axle of a gear.

        The azimuth is counted from the pitch point and is positive in the direction of increasing X. For cylinders,
        points have the shape (..., 2) and the radius is in modules. For cones, points have the shape (..., 3) on the
        unit sphere and the radius is in rad.
        """
        x = points[..., 0]
        if not self.bevel:
            R = self.axle_of(gear)
            y = points[..., 1] - R
            return np.hypot(x, y), np.arctan2(x, self._side(gear) * y)
        axis, up = self._axis_and_up(gear)
        outwards = points @ up
        # arctan2, because acos loses half the digits for a slender cone
        return np.arctan2(np.hypot(x, outwards), points @ axis), np.arctan2(x, outwards)

    def from_polar(self, gear: int, radius: float, azimuth: Floats) -> Floats:
        """Return points of the fixed frame from `radius` and `azimuth` about a gear's axle, the inverse of `polar`."""
        if not self.bevel:
            up = self.axle_of(gear) + self._side(gear) * radius * np.cos(azimuth)
            return np.stack([radius * np.sin(azimuth), up], axis=-1)
        axis, up = self._axis_and_up(gear)
        out = np.sin(azimuth)[..., None] * np.array([1.0, 0.0, 0.0]) + np.cos(azimuth)[..., None] * up
        found: Floats = np.cos(radius) * axis + np.sin(radius) * out
        return found

    def _side(self, gear: int) -> float:
        """Return 1 if the axle of a gear is at negative y in the fixed frame, or -1 if it is at positive y."""
        return 1.0 if self.axle_of(gear) < 0 else -1.0

    def _axis_and_up(self, gear: int) -> tuple[Floats, Floats]:
        """Return two unit vectors of a pitch cone: the direction of the gear's axis, and the direction perpendicular to
        the axis towards the pitch point.
        """
        R, side = self.axle_of(gear), self._side(gear)
        return np.array([0.0, sin(R), cos(R)]), np.array([0.0, side * cos(R), -side * sin(R)])
