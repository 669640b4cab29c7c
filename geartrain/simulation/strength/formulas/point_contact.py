"""Contact of two bodies at a point: Hertz's ellipse, and the involute helicoids of wheels on crossed axes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import asin, atan, cos, pi, sin, sqrt, tan
from typing import NamedTuple

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.vectors import cross, dot, minus, scaled, size, unit

YIELD_AT_POINT = 1.6
"""Greatest pressure of a contact at a point over the yield stress where yielding begins below it.

Of spheres, by Tresca and by von Mises alike (Johnson, Contact Mechanics, 1985, section 6.2); of a long ellipse 5/3.
"""

_POSITIONS = 401


class ContactEllipse(NamedTuple):
    """What two bodies touch in: greatest pressure [MPa], and the longer and the shorter half axis [mm]."""

    pressure: float
    longer: float
    shorter: float


def contact_ellipse(force: float, factor: float, curvatures: tuple[float, float], crossing: float) -> ContactEllipse:
    """Hertz's ellipse of two cylinders that cross: docs/strength.md (25).

    force        pressing them together [N]; `factor` of elasticity, ZE [sqrt(MPa)]
    curvatures   of both [1/mm]
    crossing     angle between their straight lines (rad), above 0

    Two rods of 20 mm that cross at a right angle, as a ball of 20 mm on a plane:

    >>> round(contact_ellipse(10, 189.81, (0.1, 0.1), pi / 2).pressure, 1)
    628.2
    """
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipkm1

    one, other = curvatures
    total = (one + other) / 2
    apart = sqrt(max(one**2 + other**2 + 2 * one * other * cos(2 * crossing), 0.0)) / 2
    wanted = (total + apart) / (total - apart)

    def ratio(log: float) -> float:
        k2 = np.exp(2 * log)  # of the half axes, squared
        K, E = ellipkm1(k2), ellipe(1 - k2)
        return float(np.log((E / k2 - K) / (K - E)) - np.log(wanted))

    if apart <= 1e-9 * total:
        k = 1.0
    elif ratio(-34.0) < 0:
        why = f"their lines cross at {crossing:.3g} rad"
        raise RangeError(Problem("two cylinders touch along a line", why, "take the pressure of a line contact"))
    else:
        k = float(np.exp(brentq(ratio, -34.0, -1e-7)))
    modulus = pi * factor**2
    pressure = ((total * modulus / float(ellipe(1 - k**2))) ** 2 * 3 * force * k / (2 * pi)) ** (1 / 3)
    longer = sqrt(3 * force / (2 * pi * pressure * k))
    return ContactEllipse(float(pressure), longer, k * longer)


@dataclass(frozen=True)
class CrossedWheels:
    """Two helical wheels of involute teeth on axes that cross; one of them may be a worm. Lengths in mm.

    radii            of the pitch circles
    helix            helix angles (rad), of right hands above 0; they add up to the shaft angle
    module           across the teeth
    pressure_angle   across the teeth (rad)
    addenda          of both, in modules
    widths           of both, infinite where they are not known
    """

    radii: tuple[float, float]
    helix: tuple[float, float]
    module: float
    pressure_angle: float
    addenda: tuple[float, float] = (1.0, 1.0)
    widths: tuple[float, float] = (float("inf"), float("inf"))

    @property
    def pitch(self) -> float:
        """From one couple to the next along the line on which teeth touch."""
        return pi * self.module * cos(self.pressure_angle)

    def flank_radius(self, at: int) -> float:
        """Radius of curvature of a flank at the pitch point, across its straight lines."""
        transverse = atan(tan(self.pressure_angle) / cos(self.helix[at]))
        return self.radii[at] * sin(transverse) / cos(self._base_helix(at))

    def _base_helix(self, at: int) -> float:
        return asin(sin(self.helix[at]) * cos(self.pressure_angle))

    def normal_count(self, at: int) -> float:
        """Teeth of the spur wheel whose teeth are those of a wheel seen along them; not whole."""
        return 2 * self.radii[at] / self.module / cos(self._base_helix(at)) ** 2

    def tooth_length(self, at: int) -> float:
        """Of a tooth, along its pitch helix."""
        return self.widths[at] / cos(self.helix[at])

    @cached_property
    def crossing(self) -> float:
        """Angle between the straight lines of both flanks where they touch (rad)."""
        normal = cos(self.pressure_angle), 0.0, sin(self.pressure_angle)
        axes = (sin(self.helix[0]), cos(self.helix[0]), 0.0), (-sin(self.helix[1]), cos(self.helix[1]), 0.0)
        # each lies in the plane of its axis and the normal, at right angles to the normal
        first, second = (unit(minus(axis, scaled(normal, dot(axis, normal)))) for axis in axes)
        return asin(min(size(cross(first, second)), 1.0))

    def _bounds(self, at: int) -> dict[str, float]:
        """How far past the pitch point, towards the tip of one wheel, each thing lets them touch."""
        alpha, lean = self.pressure_angle, self.helix[at]
        tip = self.radii[at] + self.addenda[at] * self.module
        # (r + s sin a)^2 + (s cos a cos b)^2 = tip^2
        square, half = sin(alpha) ** 2 + (cos(alpha) * cos(lean)) ** 2, self.radii[at] * sin(alpha)
        reach = (sqrt(half**2 + square * (tip**2 - self.radii[at] ** 2)) - half) / square
        steps = (cos(alpha) * abs(sin(lean)) for lean in self.helix)  # along each axis
        aside = [width / 2 / step for step, width in zip(steps, self.widths, strict=True) if step]
        return {"tip": reach, "base": self.flank_radius(1 - at), "width": min(aside, default=float("inf"))}

    @cached_property
    def ends(self) -> tuple[float, float]:
        """How far they touch, along the common normal: towards the tip of the second wheel, and of the first."""
        return min(self._bounds(1).values()), min(self._bounds(0).values())

    @property
    def bounded_by(self) -> frozenset[str]:
        """What ends the contact: tip, base or width."""
        return frozenset(min(found, key=found.__getitem__) for found in (self._bounds(0), self._bounds(1)))

    @property
    def contact_ratio(self) -> float:
        """Pitches on which a couple touches."""
        return sum(self.ends) / self.pitch

    def couples(self, place: float) -> int:
        """How many touch while one does at a place, counted along the normal past the pitch point."""
        back, front = self.ends
        slack = 1e-9 * self.pitch
        return int((place + back + slack) // self.pitch + (front - place + slack) // self.pitch + 1)

    def ellipse(self, place: float, force: float, factor: float) -> ContactEllipse:
        """Where they touch at a place, all couples sharing a normal force [N]."""
        rho = self.flank_radius(0) + place, self.flank_radius(1) - place
        return contact_ellipse(force / self.couples(place), factor, (1 / rho[0], 1 / rho[1]), self.crossing)

    def worst(self, force: float, factor: float) -> ContactEllipse:
        """The greatest pressure of all places where as few couples touch as anywhere."""
        back, front = self.ends
        places = np.linspace(-back, front, _POSITIONS)[1:-1].tolist()
        fewest = min(self.couples(place) for place in places)
        found = [self.ellipse(place, force, factor) for place in places if self.couples(place) == fewest]
        return max(found)
