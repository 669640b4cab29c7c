"""ISO 6336-2 and -3, method B, of involute pairs: every factor by itself, all load factors K 1 (docs/strength.md).

Helical pairs as in the editions of 2006: contact in the transverse section, roots as of the spur wheel that has the
same teeth across them. For teeth as a rack cuts them, its corner round with a radius; the root of an exported outline
is another one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import acos, cos, degrees, pi, sin, sqrt, tan

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Result

HOB_CORNER = 0.38
"""Radius of a rack's corner [module], of ISO 53 profile A."""


@dataclass(frozen=True, slots=True)
class RackWheel:
    """A wheel that a rack cuts. Lengths in modules.

    z, shift    teeth, also parts of one of the spur wheel that stands for a helical one, and shift of the rack
    tip         radius of the tip circle
    dedendum    depth of the rack under its pitch line; `corner`, radius at its tip
    """

    z: float
    shift: float
    tip: float
    dedendum: float = 1.25
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
    """Two such wheels at their distance, helical ones in the transverse section. Angles in rad.

    angle, working   pressure angles of the rack, and at work
    contact_ratio    1 to 2
    lean             of helical wheels
    """

    first: RackWheel
    second: RackWheel
    angle: float
    working: float
    contact_ratio: float
    lean: ToothLean = ToothLean()

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
    """Contact stress by ISO 6336-2.

    Attributes
    ----------
    ZH, ZE, Zeps : float
        Zone factor; factor of elasticity [sqrt(MPa)]; contact ratio factor.
    M1, M2 : float
        ZB and ZD before they are kept from falling below 1, and of spur wheels.
    nominal : float
        sH0, at the pitch point [MPa].
    stress : tuple of float
        At the inner points of single contact of both wheels, ZB and ZD times that [MPa].
    Zbeta : float
        Helix angle factor; 1 of straight teeth.
    """

    ZH: float
    ZE: float
    Zeps: float
    M1: float
    M2: float
    nominal: float
    stress: tuple[float, float]
    Zbeta: float = 1.0


@dataclass(frozen=True, slots=True)
class IsoRoot(Result):
    """Root stress of one wheel by ISO 6336-3, the load at the outer point of single contact.

    Attributes
    ----------
    chord, radius, lever : float
        Of the root at its 30 degree tangent: thickness, radius of the round, and lever of the force [module].
    YF, YS : float
        Form factor, stress correction factor.
    stress : float
        sF0 [MPa].
    Ybeta : float
        Helix angle factor; 1 of straight teeth.
    """

    chord: float
    radius: float
    lever: float
    YF: float
    YS: float
    stress: float
    Ybeta: float = 1.0


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
