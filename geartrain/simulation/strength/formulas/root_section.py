"""Bending stress at the root of a tooth of any form: Lewis's cantilever, every section of the true outline tried."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.outlines.tooth_outline import Vertex

_CHORD = 2e-5  # modules
_STEP = 0.004  # modules from one section to the next


@dataclass(frozen=True, slots=True)
class ToothLoad:
    """Where a force presses on a tooth, in the frame of the tooth: x along its axis from the axle. Lengths in modules.

    radius   of the point where it acts; `apex` where its line meets the axis of the tooth
    angle    (rad) between it and the perpendicular of that axis
    """

    radius: float
    apex: float
    angle: float


@dataclass(frozen=True, slots=True)
class RootSection:
    """The section where bending is greatest. Lengths in modules.

    x        from the axle; `thickness` of the tooth there
    factor   stress over torque/(width module^2)
    """

    x: float
    thickness: float
    factor: float

    def stress(self, torque: float, width: float, module: float) -> float:
        """Bending stress [MPa] under a torque [N mm] that this tooth bears alone; width and module in mm."""
        return self.factor * torque / (width * module**2)

    def lewis_factor(self, pitch_radius: float) -> float:
        """Y = Ft/(b m stress), Ft the tangential force at a radius [module]."""
        return 1 / (self.factor * pitch_radius)


@dataclass(frozen=True, slots=True)
class ToothSide:
    """Half an outline, from its tip to mid-space: x along the axis of the tooth, y >= 0. Lengths in modules.

    outward   1, or -1 for a ring, whose tips look to the axle
    """

    points: Floats
    outward: int

    @classmethod
    def of(cls, tooth: Sequence[Vertex], outward: int = 1) -> ToothSide:
        """From the vertices of one tooth about the x axis, from root to root."""
        points = Contour.of((*tooth[:-1], (*tooth[-1][:2], 0.0))).flattened(_CHORD)
        upper = points[points[:, 1] >= -1e-12]
        # along a tip or a root circle the azimuth grows
        radius, azimuth = np.hypot(*upper.T), np.arctan2(upper[:, 1], upper[:, 0])
        order = np.lexsort((azimuth, -np.round(radius, 9) * outward))
        return cls(upper[order], outward)

    def half(self, radius: float) -> float:
        """Half the angle (rad) that the tooth fills at a radius."""
        r = np.hypot(*self.points.T) * self.outward
        azimuth = np.arctan2(self.points[:, 1], self.points[:, 0])
        tip = r >= r.max() - 1e-9
        r, azimuth = np.append(r[~tip][::-1], r.max()), np.append(azimuth[~tip][::-1], azimuth[tip].max())
        return float(np.interp(radius * self.outward, r, azimuth))

    @property
    def tip(self) -> float:
        """Radius of the tip circle."""
        r = np.hypot(*self.points.T)
        return float(r.max() if self.outward > 0 else r.min())

    @property
    def root(self) -> float:
        """Radius of the root circle."""
        r = np.hypot(*self.points.T)
        return float(r.min() if self.outward > 0 else r.max())

    def load_at(self, radius: float, arm: float) -> ToothLoad:
        """A force at some radius whose line passes the axle at a distance `arm`: docs/strength.md (4)."""
        pressure = acos(min(arm / radius, 1.0))
        angle = pressure - self.outward * self.half(radius)
        return ToothLoad(radius, arm / cos(angle), angle)

    def load_at_tip(self) -> ToothLoad:
        """A force at the end of the flank, normal to its last chord, for teeth without a path of contact."""
        r = np.hypot(*self.points.T)
        flank = self.points[np.abs(r - self.tip) > 1e-9]
        end = np.array([self.tip * cos(half := self.half(self.tip)), self.tip * sin(half)])
        along = end - flank[0]
        angle = atan2(-along[1], abs(along[0]))
        apex = float(end[0] - self.outward * end[1] * np.tan(angle))
        return ToothLoad(float(hypot(*end)), apex, angle)

    def weakest_section(self, load: ToothLoad) -> RootSection:
        """The section with the greatest bending stress under a force, in the lower half of the tooth: (5).

        Under a force at its very point a pointed tooth has no thickness: there it is crushed, not bent.
        """
        x, y = self._sections()
        lever = (load.apex - x) * self.outward
        below = (lever > 0) & ((x - (self.tip + self.root) / 2) * self.outward <= 0)
        if not below.any():  # the force passes beneath the root, as it may in a ring, and bends nothing
            deepest = int(np.argmin(x * self.outward))
            return RootSection(float(x[deepest]), float(2 * y[deepest]), 0.0)
        x, y, lever = x[below], y[below], lever[below]
        factors = 6 * lever / (load.apex * (2 * y) ** 2)
        at = int(np.argmax(factors))
        return RootSection(float(x[at]), float(2 * y[at]), float(factors[at]))

    def _sections(self) -> tuple[Floats, Floats]:
        """Half thickness at every height, points set between those of the outline."""
        x, y = self.points.T
        steps = np.hypot(np.diff(x), np.diff(y))
        s = np.concatenate(([0.0], np.cumsum(steps)))
        fine = np.union1d(s, np.linspace(0, s[-1], max(int(s[-1] / _STEP), 2)))
        x, y = np.interp(fine, s, x), np.interp(fine, s, y)
        keep = y > 1e-9
        return x[keep], y[keep]


def pin_stress(force: float, length: float, diameter: float) -> float:
    """Bending stress [MPa] of a pin held at both ends under a force [N] spread over its length [mm].

    The moment at its ends is F l/12; sigma = 32 M/(pi d^3).

    >>> round(pin_stress(10.0, 6.0, 2.0), 4)
    6.3662
    """
    return 32 * force * length / 12 / (pi * diameter**3)
