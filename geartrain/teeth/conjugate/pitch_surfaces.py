"""Pitch surfaces that roll on each other: cylinders (spur), cones (bevel), a ring (its radius negative)."""

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
    """The pitch surfaces of a pair, gear 1 driving.

    z1, z2   tooth numbers; those of wheels that stand for bevels are not whole
    R1, R2   spur: pitch radii in modules; bevel: half-angles of the pitch cones (rad) on the unit sphere
    bevel    True for cones
    A ring is gear 2 with a negative R2: the formulas of an external pair then hold as they stand.
    """

    z1: float
    z2: float
    R1: float
    R2: float
    bevel: bool = False

    @classmethod
    def spur(cls, z1: float, z2: float, internal: bool = False) -> PitchSurfaces:
        """Parallel axes, module 1; `internal`: gear 2 is a ring."""
        return cls(z1, z2, z1 / 2, -z2 / 2 if internal else z2 / 2)

    @classmethod
    def cones(cls, z1: float, z2: float, shaft_angle: float = pi / 2) -> PitchSurfaces:
        """Axes that meet under `shaft_angle` (rad): tan R1 = sin S / (z2/z1 + cos S), R1 + R2 = S."""
        R1 = atan2(sin(shaft_angle), z2 / z1 + cos(shaft_angle))
        return cls(z1, z2, R1, shaft_angle - R1, True)

    @property
    def A(self) -> float:
        """1/R1, or cot R1."""
        return 1 / tan(self.R1) if self.bevel else 1 / self.R1

    @property
    def B(self) -> float:
        """1/R2, or cot R2; negative for a ring, 0 for a crown gear."""
        return 1 / tan(self.R2) if self.bevel else 1 / self.R2

    @property
    def reach(self) -> float:
        """Pitch-line displacement X in one radian of gear 1: R1, or sin R1."""
        return sin(self.R1) if self.bevel else self.R1

    @property
    def reach2(self) -> float:
        """Pitch-line displacement X in one radian of gear 2: R2 (negative for a ring), or sin R2."""
        return sin(self.R2) if self.bevel else self.R2

    def teeth_of(self, gear: int) -> float:
        """Tooth number of gear 1 or 2."""
        return self.z1 if gear == 1 else self.z2

    def reach_of(self, gear: int) -> float:
        """Pitch-line displacement in one radian of a gear, without sign."""
        return self.reach if gear == 1 else abs(self.reach2)

    def axle_of(self, gear: int) -> float:
        """Height of the axle of a gear above the pitch point; bevel: the angle of its axis from it (rad)."""
        return -self.R1 if gear == 1 else self.R2

    @property
    def p(self) -> float:
        """Circular pitch, as X."""
        return 2 * pi * self.reach / self.z1

    @property
    def exchanged(self) -> PitchSurfaces:
        """The same pair with gear 2 driving; approach and recess change places."""
        return PitchSurfaces(self.z2, self.z1, self.R2, self.R1, self.bevel)

    def S(self, d: ArrayLike) -> Floats:
        """d, or sin d."""
        found: Floats = np.sin(d) if self.bevel else np.asarray(d, dtype=float)
        return found

    def S_slope(self, d: ArrayLike) -> Floats:
        """1, or cos d."""
        found: Floats = np.cos(d) if self.bevel else np.ones(np.shape(d))
        return found

    def S_integral(self, d: ArrayLike) -> Floats:
        """The integral of S from 0: d^2/2, or 1 - cos d."""
        d = np.asarray(d, dtype=float)
        # 1 - cos d would cancel near the pitch point
        found: Floats = 2 * np.sin(d / 2) ** 2 if self.bevel else d * d / 2
        return found

    def point(self, d: Floats, sin_psi: Floats, cos_psi: Floats) -> Floats:
        """The contact point in the fixed frame, shape (..., 2) from the pitch point, or (..., 3) on the unit sphere."""
        S = self.S(d)
        if not self.bevel:
            return np.stack([S * cos_psi, S * sin_psi], axis=-1)
        return np.stack([S * cos_psi, S * sin_psi, np.cos(d)], axis=-1)

    def on_gear1(self, points: Floats, X: Floats) -> Floats:
        """Points of the fixed frame as gear 1 bears them at its X = 0 position: turned by +X / reach about O1."""
        return self._turned(points, X / self.reach, -self.R1)

    def on_gear2(self, points: Floats, X: Floats) -> Floats:
        """The same for gear 2: turned by -X / reach2 about O2."""
        return self._turned(points, -X / self.reach2, self.R2)

    def polar(self, gear: int, points: Floats) -> tuple[Floats, Floats]:
        """Radius of fixed points about the axle of a gear, and azimuth from the pitch point, positive the way X grows.

        Cylinders: points (..., 2), the radius in modules. Cones: points (..., 3) on the unit sphere, the radius in rad.
        """
        x = points[..., 0]
        if not self.bevel:
            R = self.axle_of(gear)
            y = points[..., 1] - R
            return np.hypot(x, y), np.arctan2(x, self._side(gear) * y)
        axis, up = self._axis_and_up(gear)
        outwards = points @ up
        # not acos, which loses half the digits of a slender cone
        return np.arctan2(np.hypot(x, outwards), points @ axis), np.arctan2(x, outwards)

    def from_polar(self, gear: int, radius: float, azimuth: Floats) -> Floats:
        """Fixed points of one radius about the axle of a gear, the inverse of `polar`."""
        if not self.bevel:
            up = self.axle_of(gear) + self._side(gear) * radius * np.cos(azimuth)
            return np.stack([radius * np.sin(azimuth), up], axis=-1)
        axis, up = self._axis_and_up(gear)
        out = np.sin(azimuth)[..., None] * np.array([1.0, 0.0, 0.0]) + np.cos(azimuth)[..., None] * up
        found: Floats = np.cos(radius) * axis + np.sin(radius) * out
        return found

    def _side(self, gear: int) -> float:
        """1 where the pitch point lies above the axle of a gear, -1 where it lies below."""
        return 1.0 if self.axle_of(gear) < 0 else -1.0

    def _axis_and_up(self, gear: int) -> tuple[Floats, Floats]:
        """Of cones: the axis of a gear, and at right angles to it the direction of the pitch point."""
        R, side = self.axle_of(gear), self._side(gear)
        return np.array([0.0, sin(R), cos(R)]), np.array([0.0, side * cos(R), -side * sin(R)])

    def _turned(self, points: Floats, angle: Floats, R: float) -> Floats:
        """Rodrigues' rotation about the axis at the polar angle `R` from the pitch point; spur: at height R over it."""
        cosine, sine = np.cos(angle), np.sin(angle)
        if not self.bevel:
            x, y = points[..., 0], points[..., 1] - R
            return np.stack([x * cosine - y * sine, x * sine + y * cosine + R], axis=-1)
        axis = np.array([0.0, sin(R), cos(R)])
        along = (points @ axis)[..., None] * axis
        across = np.cross(np.broadcast_to(axis, points.shape), points)
        turned: Floats = along + (points - along) * cosine[..., None] + across * sine[..., None]
        return turned
