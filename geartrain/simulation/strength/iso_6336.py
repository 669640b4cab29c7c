"""Bending at roots and contact of involute pairs: ISO 6336-2 and -3, and Lewis's cantilever (docs/strength.md).

ISO 6336, method B: every factor by itself, all load factors K 1. Helical pairs as in the editions of 2006: contact in
the transverse section, roots as of the spur wheel that has the same teeth across them. For teeth as a rack cuts them,
its corner round with a radius; the root of an exported outline is another one: there Lewis's cantilever tries every
section of the true outline of a tooth of any form.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import acos, atan2, cos, degrees, hypot, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Result
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.outlines.tooth_outline import Vertex


HOB_CORNER = 0.38
"""Radius of a rack's corner [module], of ISO 53 profile A."""

_CHORD = 2e-5  # modules
_STEP = 0.004  # modules from one section to the next


# ------------------------------------------------------------------------------------------------------------- ISO 6336


@dataclass(frozen=True, slots=True)
class RackWheel:
    """A wheel that a rack cuts. Lengths in modules."""

    z: float
    """Teeth, also parts of one of the spur wheel that stands for a helical one, and shift of the rack."""
    shift: float
    """Teeth, also parts of one of the spur wheel that stands for a helical one, and shift of the rack."""
    tip: float
    """Radius of the tip circle."""
    dedendum: float = 1.25
    """Depth of the rack under its pitch line; `corner`, radius at its tip."""
    corner: float = HOB_CORNER


@dataclass(frozen=True, slots=True)
class ToothLean:
    """How the teeth of helical wheels lie: helix angles (rad) at the pitch and base circle, and overlap in pitches."""

    helix: float = 0.0
    base: float = 0.0
    overlap: float = 0.0

    @property
    def Zbeta(self) -> float:
        """Helix angle factor of contact."""
        return 1 / sqrt(cos(self.helix))

    @property
    def Ybeta(self) -> float:
        """Helix angle factor of roots: nothing is gained beyond an overlap of 1, and beyond 30 degrees."""
        return 1 - min(self.overlap, 1.0) * min(degrees(self.helix), 30.0) / 120

    def Zeps(self, contact_ratio: float) -> float:
        """Contact ratio factor."""
        part = min(self.overlap, 1.0)
        return sqrt((4 - contact_ratio) / 3 * (1 - part) + part / contact_ratio)

    def single(self, M: float) -> float:
        """ZB or ZD of a wheel whose M is that of a spur wheel: 1 from an overlap of 1 on, between them in a line."""
        over = max(M, 1.0)
        return over - min(self.overlap, 1.0) * (over - 1)


@dataclass(frozen=True, slots=True)
class RackPair:
    """Two such wheels at their distance, helical ones in the transverse section. Angles in rad."""

    first: RackWheel
    second: RackWheel
    angle: float
    """Pressure angles of the rack, and at work."""
    working: float
    """Pressure angles of the rack, and at work."""
    contact_ratio: float
    """1 to 2."""
    lean: ToothLean = ToothLean()
    """Of helical wheels."""

    def __post_init__(self) -> None:
        """Raise `RangeError` for a contact ratio that the standard does not cover."""
        if not 1 <= self.contact_ratio < 2:
            what = f"ISO 6336 method B covers contact ratios from 1 to 2, and this one is {self.contact_ratio:.4g}"
            raise RangeError(Problem(what, "load is shared otherwise", "take the figures by Lewis and Hertz"))

    def wheel(self, at: int) -> RackWheel:
        """Wheel 0 or 1."""
        return self.second if at else self.first


@dataclass(frozen=True, slots=True)
class IsoContact(Result):
    """Contact stress by ISO 6336-2."""

    ZH: float
    """Zone factor."""
    ZE: float
    """Elasticity factor [sqrt(MPa)]."""
    Zeps: float
    """Contact ratio factor."""
    M1: float
    """ZB and ZD before they are kept from falling below 1, and of spur wheels."""
    M2: float
    """ZB and ZD before they are kept from falling below 1, and of spur wheels."""
    nominal: float
    """sH0, at the pitch point [MPa]."""
    stress: tuple[float, float]
    """At the inner points of single contact of both wheels, ZB and ZD times that [MPa]."""
    Zbeta: float = 1.0
    """Helix angle factor; 1 of straight teeth."""


@dataclass(frozen=True, slots=True)
class IsoRoot(Result):
    """Root stress of one wheel by ISO 6336-3, the load at the outer point of single contact."""

    chord: float
    """Thickness of the root at its 30 degree tangent [module]."""
    radius: float
    """Radius of the root fillet at its 30 degree tangent [module]."""
    lever: float
    """Lever of the force about the root at its 30 degree tangent [module]."""
    YF: float
    """Form factor."""
    YS: float
    """Stress correction factor."""
    stress: float
    """sF0 [MPa]."""
    Ybeta: float = 1.0
    """Helix angle factor; 1 of straight teeth."""


def contact_stress(pair: RackPair, elasticity: float, tangential: float, width: float, module: float) -> IsoContact:
    """Contact stress of an external pair; force in N, lengths in mm: docs/strength.md (7) to (9), (21)."""
    a, aw, eps = pair.angle, pair.working, pair.contact_ratio
    z1, z2 = pair.first.z, pair.second.z
    ZH = sqrt(2 * cos(pair.lean.base) * cos(aw) / (cos(a) ** 2 * sin(aw)))
    Zeps, Zbeta = pair.lean.Zeps(eps), pair.lean.Zbeta
    far = [sqrt((each.tip / (each.z / 2 * cos(a))) ** 2 - 1) for each in (pair.first, pair.second)]
    M1 = tan(aw) / sqrt((far[0] - 2 * pi / z1) * (far[1] - (eps - 1) * 2 * pi / z2))
    M2 = tan(aw) / sqrt((far[1] - 2 * pi / z2) * (far[0] - (eps - 1) * 2 * pi / z1))
    u = z2 / z1
    nominal = ZH * elasticity * Zeps * Zbeta * sqrt(tangential * (u + 1) / (module * z1 * width * u))
    stress = pair.lean.single(M1) * nominal, pair.lean.single(M2) * nominal
    return IsoContact(ZH, elasticity, Zeps, M1, M2, nominal, stress, Zbeta)


def outer_single_contact(wheel: RackWheel, angle: float, contact_ratio: float) -> float:
    """Radius [module] of the outer point at which one couple bears all."""
    base = wheel.z / 2 * cos(angle)
    return sqrt((sqrt(wheel.tip**2 - base**2) - pi * cos(angle) * (contact_ratio - 1)) ** 2 + base**2)


def root_stress(
    wheel: RackWheel, angle: float, tangential: float, width: float, module: float, load_radius: float
) -> IsoRoot:
    """Root stress under a force [N] at a radius [module]; width and module in mm: docs/strength.md (10) to (13)."""
    z, rho, hf = wheel.z, wheel.corner, wheel.dedendum
    E = pi / 4 - hf * tan(angle) - (1 - sin(angle)) * rho / cos(angle)
    G = rho - hf + wheel.shift
    H = 2 / z * (pi / 2 - E) - pi / 3
    th = _tangent(2 * G / z, H)
    chord = z * sin(pi / 3 - th) + sqrt(3) * (G / cos(th) - rho)
    radius = rho + 2 * G**2 / (cos(th) * (z * cos(th) ** 2 - 2 * G))
    ae = acos(z / 2 * cos(angle) / load_radius)
    gamma = (pi / 2 + 2 * wheel.shift * tan(angle)) / z + _inv(angle) - _inv(ae)
    aF = ae - gamma
    reach = (cos(gamma) - sin(gamma) * tan(aF)) * 2 * load_radius
    lever = (reach - z * cos(pi / 3 - th) - G / cos(th) + rho) / 2
    YF = 6 * lever * cos(aF) / (chord**2 * cos(angle))
    L, q = chord / lever, chord / (2 * radius)
    YS = (1.2 + 0.13 * L) * q ** (1 / (1.21 + 2.3 / L))
    return IsoRoot(chord, radius, lever, YF, YS, tangential / (width * module) * YF * YS)


def helical_root_stress(
    wheel: RackWheel, angle: float, pair: RackPair, tangential: float, width: float, module: float
) -> IsoRoot | None:
    """Of a helical wheel, by the spur wheel with its teeth across them: docs/strength.md (22).

    wheel, angle   teeth, shift, tip, dedendum and corner in normal modules; normal pressure angle
    module         the normal one [mm]

    None where as many as two couples of that spur wheel always touch.
    """
    lean = pair.lean
    contact_ratio = pair.contact_ratio / cos(lean.base) ** 2
    if contact_ratio >= 2:
        return None
    z = wheel.z / (cos(lean.base) ** 2 * cos(lean.helix))
    stands_in = replace(wheel, z=z, tip=z / 2 + wheel.tip)
    radius = outer_single_contact(stands_in, angle, contact_ratio)
    found = root_stress(stands_in, angle, tangential, width, module, radius)
    return replace(found, stress=found.stress * lean.Ybeta, Ybeta=lean.Ybeta)


def _inv(angle: float) -> float:
    return tan(angle) - angle


def _tangent(slope: float, H: float) -> float:
    """The angle th = slope tan th - H, by Newton's method from pi/6."""
    th = pi / 6
    for _ in range(50):
        step = (th - slope * tan(th) + H) / (1 - slope / cos(th) ** 2)
        th -= step
        if abs(step) < 1e-14:
            break
    return th


# ---------------------------------------------------------------------------------------------------------------- Lewis


@dataclass(frozen=True, slots=True)
class ToothLoad:
    """Where a force presses on a tooth, in the frame of the tooth: x along its axis from the axle. Lengths in
    modules."""

    radius: float
    """Of the point where it acts; `apex` where its line meets the axis of the tooth."""
    apex: float
    angle: float
    """(rad) between it and the perpendicular of that axis."""


@dataclass(frozen=True, slots=True)
class RootSection:
    """The section where bending is greatest. Lengths in modules."""

    x: float
    """From the axle; `thickness` of the tooth there."""
    thickness: float
    factor: float
    """Stress over torque/(width module^2)."""

    def stress(self, torque: float, width: float, module: float) -> float:
        """Bending stress [MPa] under a torque [N mm] that this tooth bears alone; width and module in mm."""
        return self.factor * torque / (width * module**2)

    def lewis_factor(self, pitch_radius: float) -> float:
        """Y = Ft/(b m stress), Ft the tangential force at a radius [module]."""
        return 1 / (self.factor * pitch_radius)


@dataclass(frozen=True, slots=True)
class ToothSide:
    """Half an outline, from its tip to mid-space: x along the axis of the tooth, y >= 0. Lengths in modules."""

    points: Floats
    outward: int
    """1, or -1 for a ring, whose tips look to the axle."""

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
