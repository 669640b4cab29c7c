"""Contact and root stress of involute pairs by ISO 6336-2 and -3, and root stress by Lewis's formula
(docs/strength.md).

ISO 6336 is applied by method B with all load factors K equal to 1. Helical pairs follow the editions of 2006: contact
stress in the transverse section, root stress of the virtual spur wheel in the normal section. The formulas apply to
teeth cut by a rack with a rounded corner. An exported outline has a different root. Lewis's formula is evaluated for
every section of the true outline of a tooth, whatever its form.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
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
"""Tip radius of the basic rack of ISO 53, profile A [module]."""

_CHORD = 2e-5  # tolerance of chords [module]
_STEP = 0.004  # distance between sections [module]


# ------------------------------------------------------------------------------------------------------------- ISO 6336


@dataclass(frozen=True, slots=True)
class RackWheel:
    """Wheel cut by a rack. Lengths are in modules."""

    z: float
    """Number of teeth, which is not an integer for the virtual spur wheel of a helical wheel."""
    shift: float
    """Profile shift of the rack [module]."""
    tip: float
    """Radius of the tip circle [module]."""
    dedendum: float = 1.25
    """Depth of the rack below its pitch line [module]. `corner` is the tip radius of the rack [module]."""
    corner: float = HOB_CORNER


@dataclass(frozen=True, slots=True)
class HelixData:
    """Helix angles at the pitch circle and at the base circle [rad], and overlap ratio of helical wheels."""

    helix: float = 0.0
    base: float = 0.0
    overlap: float = 0.0

    @property
    def Zbeta(self) -> float:
        """Helix angle factor Zbeta for the contact stress."""
        return 1 / sqrt(cos(self.helix))

    @property
    def Ybeta(self) -> float:
        """Helix angle factor Ybeta for the root stress; overlap ratio and angle count up to 1 and 30 degrees."""
        return 1 - min(self.overlap, 1.0) * min(degrees(self.helix), 30.0) / 120

    def Zeps(self, contact_ratio: float) -> float:
        """Return the contact ratio factor Zeps for the contact stress."""
        part = min(self.overlap, 1.0)
        return sqrt((4 - contact_ratio) / 3 * (1 - part) + part / contact_ratio)

    def single(self, M: float) -> float:
        """Return the single pair contact factor ZB or ZD of a helical wheel from the factor M1 or M2 of a spur wheel.

        The factor is 1 for overlap ratios of 1 or more, and is interpolated linearly for smaller overlap ratios.
        """
        over = max(M, 1.0)
        return over - min(self.overlap, 1.0) * (over - 1)


@dataclass(frozen=True, slots=True)
class RackPair:
    """Pair of rack-cut wheels at its centre distance, described in the transverse section. Angles are in rad."""

    first: RackWheel
    second: RackWheel
    angle: float
    """Transverse pressure angle of the rack [rad]."""
    working: float
    """Operating pressure angle [rad]."""
    contact_ratio: float
    """Transverse contact ratio, at least 1 and less than 2."""
    lean: HelixData = HelixData()
    """Helix data of the pair; zero angles for spur teeth."""

    def __post_init__(self) -> None:
        """Raise `RangeError` for a contact ratio that the standard does not cover."""
        if not 1 <= self.contact_ratio < 2:
            what = f"the contact ratio {self.contact_ratio:.4g} is outside the range of ISO 6336 method B"
            why = "its load sharing applies to contact ratios from 1 to 2, excluding 2"
            raise RangeError(Problem(what, why, "use the stresses by Lewis and Hertz"))


@dataclass(frozen=True, slots=True)
class IsoContact(Result):
    """Contact stress of a gear pair by ISO 6336-2, with the factors from which it is computed."""

    ZH: float
    """Zone factor."""
    ZE: float
    """Elasticity factor [sqrt(MPa)]."""
    Zeps: float
    """Contact ratio factor."""
    M1: float
    """Factor M1 of spur wheels. ZB is the larger of M1 and 1."""
    M2: float
    """Factor M2 of spur wheels. ZD is the larger of M2 and 1."""
    nominal: float
    """Nominal contact stress sH0 at the pitch point [MPa]."""
    stress: tuple[float, float]
    """Contact stresses at the inner points of single contact of both wheels [MPa]: `nominal` times ZB and ZD."""
    Zbeta: float = 1.0
    """Helix angle factor; 1 for spur teeth."""


@dataclass(frozen=True, slots=True)
class IsoRoot(Result):
    """Root stress of one wheel by ISO 6336-3, with the load at the outer point of single contact."""

    chord: float
    """Thickness of the tooth root at the 30 degree tangent [module]."""
    radius: float
    """Radius of the root fillet at the 30 degree tangent [module]."""
    lever: float
    """Bending moment arm of the force about the root section at the 30 degree tangent [module]."""
    YF: float
    """Form factor YF for the load at the outer point of single contact."""
    YS: float
    """Stress correction factor."""
    stress: float
    """Nominal root stress sF0 of the tooth [MPa]."""
    Ybeta: float = 1.0
    """Helix angle factor; 1 for spur teeth."""


def contact_stress(pair: RackPair, elasticity: float, tangential: float, width: float, module: float) -> IsoContact:
    """Return the contact stress of an external pair by ISO 6336-2, equations (7) to (9) and (21) of docs/strength.md.

    elasticity   elasticity factor [sqrt(MPa)]
    tangential   tangential force at the reference circle [N]
    width        face width [mm]; `module` is the transverse module [mm]
    """
    a, aw, eps = pair.angle, pair.working, pair.contact_ratio
    z1, z2 = pair.first.z, pair.second.z
    ZH = sqrt(2 * cos(pair.lean.base) * cos(aw) / (cos(a) ** 2 * sin(aw)))
    Zeps, Zbeta = pair.lean.Zeps(eps), pair.lean.Zbeta
    far = [sqrt((each.tip / (each.z / 2 * cos(a))) ** 2 - 1) for each in (pair.first, pair.second)]
    # M1 and M2 convert the stress at the pitch point to the inner points of single contact
    M1 = tan(aw) / sqrt((far[0] - 2 * pi / z1) * (far[1] - (eps - 1) * 2 * pi / z2))
    M2 = tan(aw) / sqrt((far[1] - 2 * pi / z2) * (far[0] - (eps - 1) * 2 * pi / z1))
    # the gear ratio of the standard
    u = z2 / z1
    nominal = ZH * elasticity * Zeps * Zbeta * sqrt(tangential * (u + 1) / (module * z1 * width * u))
    stress = pair.lean.single(M1) * nominal, pair.lean.single(M2) * nominal
    return IsoContact(ZH, elasticity, Zeps, M1, M2, nominal, stress, Zbeta)


def outer_single_contact(wheel: RackWheel, angle: float, contact_ratio: float) -> float:
    """Return the outer radius of single contact, up to which one tooth pair carries the whole load [module]."""
    base = wheel.z / 2 * cos(angle)
    # (contact ratio - 1) base pitches before the tip, measured along the line of action
    return sqrt((sqrt(wheel.tip**2 - base**2) - pi * cos(angle) * (contact_ratio - 1)) ** 2 + base**2)


def root_stress(
    wheel: RackWheel, angle: float, tangential: float, width: float, module: float, load_radius: float
) -> IsoRoot:
    """Return the root stress by ISO 6336-3, equations (10) to (13) of docs/strength.md.

    angle         pressure angle of the rack [rad]
    tangential    tangential force [N]; `width` and `module` in mm
    load_radius   radius of the point of application [module]
    """
    z, rho, hf = wheel.z, wheel.corner, wheel.dedendum
    # auxiliary values E, G, H and theta of the standard
    E = pi / 4 - hf * tan(angle) - (1 - sin(angle)) * rho / cos(angle)
    G = rho - hf + wheel.shift
    H = 2 / z * (pi / 2 - E) - pi / 3
    th = _tangent(2 * G / z, H)
    chord = z * sin(pi / 3 - th) + sqrt(3) * (G / cos(th) - rho)
    radius = rho + 2 * G**2 / (cos(th) * (z * cos(th) ** 2 - 2 * G))
    # pressure angle at the point of load, and its direction at the tooth axis
    ae = acos(z / 2 * cos(angle) / load_radius)
    gamma = (pi / 2 + 2 * wheel.shift * tan(angle)) / z + _inv(angle) - _inv(ae)
    aF = ae - gamma
    reach = (cos(gamma) - sin(gamma) * tan(aF)) * 2 * load_radius
    lever = (reach - z * cos(pi / 3 - th) - G / cos(th) + rho) / 2
    YF = 6 * lever * cos(aF) / (chord**2 * cos(angle))
    L, q = chord / lever, chord / (2 * radius)
    # stress correction factor of ISO 6336-3, given for 1 <= q < 8
    YS = (1.2 + 0.13 * L) * q ** (1 / (1.21 + 2.3 / L))
    return IsoRoot(chord, radius, lever, YF, YS, tangential / (width * module) * YF * YS)


def helical_root_stress(
    wheel: RackWheel, angle: float, pair: RackPair, tangential: float, width: float, module: float
) -> IsoRoot | None:
    """Return the root stress of a helical wheel from its virtual spur wheel in the normal section, equation (22) of
    docs/strength.md; None if at least two tooth pairs of the virtual spur wheel are always in contact.

    wheel    data in the normal section; `wheel.tip` is the height of the tip above the pitch circle [module]
    angle    normal pressure angle [rad]
    module   normal module [mm]
    """
    lean = pair.lean
    contact_ratio = pair.contact_ratio / cos(lean.base) ** 2
    if contact_ratio >= 2:
        return None
    # virtual number of teeth in the normal section
    z = wheel.z / (cos(lean.base) ** 2 * cos(lean.helix))
    equivalent = replace(wheel, z=z, tip=z / 2 + wheel.tip)
    radius = outer_single_contact(equivalent, angle, contact_ratio)
    found = root_stress(equivalent, angle, tangential, width, module, radius)
    return replace(found, stress=found.stress * lean.Ybeta, Ybeta=lean.Ybeta)


def _inv(angle: float) -> float:
    return tan(angle) - angle


def _tangent(slope: float, H: float) -> float:
    """Return the solution x [rad] of the equation x = `slope` tan(x) - `H` by Newton's method."""
    th = pi / 6
    # Newton's method converges quadratically, so few of these steps are needed
    for _ in range(50):
        step = (th - slope * tan(th) + H) / (1 - slope / cos(th) ** 2)
        th -= step
        if abs(step) < 1e-14:
            break
    return th


# ---------------------------------------------------------------------------------------------------------------- Lewis


@dataclass(frozen=True, slots=True)
class ToothLoad:
    """Force on a tooth in a coordinate system whose origin is on the wheel's axis and whose x-axis is the centre line
    of the tooth.

    Lengths are in modules.
    """

    radius: float
    """Radius of the point of application [module]. `apex` is the position at which the line of action intersects the
    centre line of the tooth [module].
    """
    apex: float
    angle: float
    """Angle between the force and the normal of the tooth's centre line [rad]."""


@dataclass(frozen=True, slots=True)
class RootSection:
    """Section of a tooth with the maximum bending stress. Lengths are in modules."""

    x: float
    """Distance of the section from the wheel's axis [module]. `thickness` is the thickness of the tooth in this section
    [module].
    """
    thickness: float
    factor: float
    """Bending stress of the section divided by torque/(width module^2) [1]."""

    def stress(self, torque: float, width: float, module: float) -> float:
        """Return the bending stress [MPa] under a torque on the tooth [N mm], for width and module in mm."""
        return self.factor * torque / (width * module**2)

    def lewis_factor(self, pitch_radius: float) -> float:
        """Return Lewis's form factor Y = Ft/(b m stress), with the face width b and the module m.

        Ft is the tangential force at the radius `pitch_radius` [module].
        """
        return 1 / (self.factor * pitch_radius)


@dataclass(frozen=True)
class ToothSide:
    """Half of the outline of a tooth [module], from the centre of its tip to the centre of the gap beside it. The
    x-axis is the centre line of the tooth, and y is 0 or more.
    """

    points: Floats
    outward: int
    """Direction of the teeth: 1 for outward teeth, -1 for a ring gear, whose teeth point inwards."""

    @classmethod
    def of(cls, tooth: Sequence[Vertex], outward: int = 1) -> ToothSide:
        """Return the half outline of a tooth whose vertices are given from root to root, symmetric about the x-axis."""
        points = Contour.of((*tooth[:-1], (*tooth[-1][:2], 0.0))).flattened(_CHORD)
        # the half above the centre line, with the points on it
        upper = points[points[:, 1] >= -1e-12]
        # along a tip or a root circle the azimuth increases
        radius, azimuth = np.hypot(*upper.T), np.arctan2(upper[:, 1], upper[:, 0])
        # points ordered from the tip to the root, also along circular arcs
        order = np.lexsort((azimuth, -np.round(radius, 9) * outward))
        return cls(upper[order], outward)

    @cached_property
    def _flank(self) -> tuple[Floats, Floats]:
        """Radii of the outline's points [module], negative for a ring gear, in increasing order, and azimuths [rad]."""
        r = np.hypot(*self.points.T) * self.outward
        azimuth = np.arctan2(self.points[:, 1], self.points[:, 0])
        # all points of the tip circle; only the last of them is needed for the interpolation
        tip = r >= r.max() - 1e-9
        return np.append(r[~tip][::-1], r.max()), np.append(azimuth[~tip][::-1], azimuth[tip].max())

    def half(self, radius: float) -> float:
        """Return half the angular thickness of the tooth at a given radius [rad]."""
        return float(np.interp(radius * self.outward, *self._flank))

    @property
    def tip(self) -> float:
        """Radius of the tip circle [module]."""
        r = np.hypot(*self.points.T)
        return float(r.max() if self.outward > 0 else r.min())

    @property
    def root(self) -> float:
        """Radius of the root circle [module]."""
        r = np.hypot(*self.points.T)
        return float(r.min() if self.outward > 0 else r.max())

    def load_at(self, radius: float, arm: float) -> ToothLoad:
        """Return the load on a tooth due to a force that acts at the radius `radius`, along a line at the distance
        `arm` from the axis [module].

        The load is defined by equation (4) of docs/strength.md.
        """
        (apex,), (angle,) = self._lines_of_action(np.array([radius]), np.array([arm]))
        return ToothLoad(radius, float(apex), float(angle))

    def _lines_of_action(self, radii: Floats, arms: Floats) -> tuple[Floats, Floats]:
        """Return the apex [module] and the angle [rad] of the line of each force, as defined in `ToothLoad`, from the
        radius of its point of application and its distance from the axis [module].
        """
        # rounding may put the point of load inside the base circle
        pressure = np.arccos(np.minimum(arms / radii, 1.0))
        angles = pressure - self.outward * np.interp(radii * self.outward, *self._flank)
        return arms / np.cos(angles), angles

    def bending_factors(self, radii: Floats, arms: Floats) -> Floats:
        """Return the maximum bending stress of the tooth divided by torque/(width module^2) [1], for each of several
        forces that act at the radii `radii`, along lines at the distances `arms` from the axis [module].
        """
        apexes, _ = self._lines_of_action(radii, arms)
        return np.asarray(self._section_factors(apexes).max(axis=1))

    def load_at_tip(self) -> ToothLoad:
        """Return the load on a tooth due to a force at the end of the flank, normal to its last chord. It is used for
        teeth without a path of contact.
        """
        r = np.hypot(*self.points.T)
        # points off the tip circle
        flank = self.points[np.abs(r - self.tip) > 1e-9]
        end = np.array([self.tip * cos(half := self.half(self.tip)), self.tip * sin(half)])
        along = end - flank[0]
        angle = atan2(-along[1], abs(along[0]))
        apex = float(end[0] - self.outward * end[1] * np.tan(angle))
        return ToothLoad(float(hypot(*end)), apex, angle)

    def weakest_section(self, load: ToothLoad) -> RootSection:
        """Return the section of maximum bending stress under a force, in the lower half of the tooth, from equation (5)
        of docs/strength.md.

        Sections near the point of a pointed tooth are excluded, because their thickness tends to 0 and they fail by
        compression instead of bending.
        """
        (x, y), (factors,) = self._sections, self._section_factors(np.array([load.apex]))
        # a force that passes below the root, as it may in a ring, causes no bending in any section
        at = int(np.argmax(factors) if factors.any() else np.argmin(x * self.outward))
        return RootSection(float(x[at]), float(2 * y[at]), float(factors[at]))

    def _section_factors(self, apexes: Floats) -> Floats:
        """Return the bending stress of each section divided by torque/(width module^2) [1], shape (forces, sections),
        for forces with the given apexes [module].
        """
        x, y = self._sections
        lever = np.maximum((apexes[:, None] - x) * self.outward, 0.0)
        # bending stress 6 F l/(b s^2), with the force F = torque/apex across the centre line
        return 6 * lever / (apexes[:, None] * (2 * y) ** 2)

    @cached_property
    def _sections(self) -> tuple[Floats, Floats]:
        """Distance from the wheel's axis and half thickness of the sections in the lower half of the tooth [module]."""
        x, y = self.points.T
        steps = np.hypot(np.diff(x), np.diff(y))
        s = np.concatenate(([0.0], np.cumsum(steps)))
        # sections between the points of the outline, which are sparse on straight flanks
        fine = np.union1d(s, np.linspace(0, s[-1], max(int(s[-1] / _STEP), 2)))
        x, y = np.interp(fine, s, x), np.interp(fine, s, y)
        # a section at the point of a tooth has no thickness
        keep = (y > 1e-9) & ((x - (self.tip + self.root) / 2) * self.outward <= 0)
        return x[keep], y[keep]


def pin_stress(force: float, length: float, diameter: float) -> float:
    """Return the bending stress of a pin fixed at both ends [MPa], under a force [N] distributed over its length [mm].

    The bending moment at the ends is M = F l/12 for a force F and a length l. The stress is 32 M/(pi d^3) for a
    diameter d.

    >>> round(pin_stress(10.0, 6.0, 2.0), 4)
    6.3662
    """
    return 32 * force * length / 12 / (pi * diameter**3)
