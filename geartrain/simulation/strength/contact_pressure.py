"""Hertzian contact of two teeth, and Archard's wear (docs/strength.md).

ContactLoad          line contact; tooth pairs in contact on the path of contact share the load equally; for
                     helical involutes on parallel axes, thin spur slices, each rotated against the next, with the load
                     uniform along all lines of contact
CrossedWheels        point contact: the contact ellipse, and involute helicoids on crossed axes
loss_over_friction, deepest_passage   wear V = (K/H) times the integral of force over sliding distance
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import asin, atan, ceil, cos, floor, isfinite, pi, sin, sqrt, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Key, Result, finite
from geartrain.numerics.vectors import cross, dot, minus, scaled, size, unit

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import Material


WEAR_RANGE = (1e-7, 1e-3)
"""Range of Archard's wear coefficient K [1], from greased metal to dry bronze or brass: four decades."""

YIELD_AT = 5 / 3
"""Maximum pressure of a line contact at first yield, divided by the yield stress.

Yielding begins below the surface. The maximum shear stress is 0.300 of the pressure at a depth of 0.79 half widths; by
Tresca, metal yields at half the yield stress (Johnson, Contact Mechanics, 1985, sections 4.2 and 6.2).
"""

YIELD_AT_POINT = 1.6
"""Maximum pressure of a point contact at first yield, divided by the yield stress.

The value applies to spheres, by Tresca and by von Mises (Johnson, Contact Mechanics, 1985, section 6.2). For a long
ellipse it is 5/3.
"""

_CUSP = 0.1  # excluded range about a pitch point with infinite curvature [pitches]
_POSITIONS = 801
_POINTS = 401
_SLIGHT = 1e-5  # coefficient of friction so small that the loss is proportional to it


# --------------------------------------------------------------------------------------------------------- along a line


@dataclass(frozen=True, slots=True)
class Elasticity:
    """Young's modulus [MPa] and Poisson's ratio [1] of a material."""

    youngs_modulus: float
    poisson: float

    @classmethod
    def of(cls, material: Material) -> Elasticity:
        """Return the elastic constants of a material."""
        return cls(material.youngs_modulus.si / 1e6, float(material.poisson.value))


def elasticity_factor(first: Elasticity, second: Elasticity) -> float:
    """Return the elasticity factor ZE of two materials [sqrt(MPa)], equation (1) of docs/strength.md.

    ZE^2 = 1 / (pi ((1 - nu1^2)/E1 + (1 - nu2^2)/E2))

    >>> steel = Elasticity(206_000, 0.3)
    >>> round(elasticity_factor(steel, steel), 2)
    189.81
    """
    yields = sum((1 - each.poisson**2) / each.youngs_modulus for each in (first, second))
    return 1 / sqrt(pi * yields)


def hertz_pressure(factor: float, force: float, width: float, curvature: float) -> float:
    """Return the maximum pressure of a line contact [MPa], equation (2) of docs/strength.md.

    factor      elasticity factor [sqrt(MPa)]
    force       normal force on the flanks [N]; `width` of contact [mm]
    curvature   1/rho1 + 1/rho2 [1/mm]
    """
    return factor * sqrt(force / width * curvature)


@dataclass(frozen=True, slots=True)
class ContactPlace(Result):
    """Pressure at one position on the path of contact."""

    KEYS = ("where", "position", "tooth_pairs", "force", Key("pressure", to=finite))

    where: str
    """Name of the position on the path of contact, such as "pitch point"."""
    position: float
    """Position of the contact, given as an arc on the pitch line from the pitch point [pitch]."""
    tooth_pairs: float
    """Number of tooth pairs in contact, each of which transmits an equal force.

    For helical teeth, the number is averaged over the width, and its minimum during the mesh is used.
    """
    force: float
    """Normal force of one tooth pair [N]."""
    pressure: float
    """Maximum Hertzian pressure in the contact [MPa]; infinite if the radius of curvature of a flank is 0."""


@dataclass(frozen=True, slots=True)
class ContactLoad:
    """Forces and pressures along the path of contact of a loaded pair with line contact.

    Positions X along the path are arcs on the pitch line, measured from the pitch point [module]. For helical teeth the
    quantities refer to the transverse section.
    """

    path: PathOfContact
    """Path of contact, with lengths given in modules."""
    module: float
    """Module [mm]. `width` is the width of the teeth in contact [mm]."""
    width: float
    torque: float
    """Torque on gear 1 [N mm]."""
    factor: float
    """Elasticity factor [sqrt(MPa)]."""
    base_helix: float = 0.0
    """Base helix angle [rad]; 0 for spur teeth."""
    overlap: float = 0.0
    """Overlap ratio: circumferential advance of helical teeth over the face width, divided by the pitch."""

    @property
    def lines(self) -> float:
        """Minimum number of tooth pairs in contact. For helical teeth, the number is averaged over the width."""
        return minimum_tooth_pairs(self.path.contact_ratio, self.overlap)

    @property
    def tangential(self) -> float:
        """Tangential force at the pitch line [N]."""
        return self.torque / (self.path.pitch.R1 * self.module)

    def forces(self, X: Floats) -> tuple[Floats, Floats]:
        """Return the force of one tooth pair at each position X [N], and the number of tooth pairs that share the
        torque.

        For spur teeth, the force is normal to the flanks. For helical teeth, it is the force in the transverse section.
        """
        if self.base_helix:
            return self.tangential / self.path.at(X).cos_psi / self.lines, np.full(X.shape, self.lines)
        p, (approach, recess) = self.path.pitch.p, self.path.arcs
        most = ceil((approach + recess) / p)
        # one row for each tooth pair that may be in contact while another one is at X
        pairs = X + p * np.arange(-most, most + 1)[:, None]
        # rounding must not lose a pair at the ends of the path
        touching = (pairs >= -approach - 1e-9 * p) & (pairs <= recess + 1e-9 * p)
        touching[most] = True
        cosines = np.zeros(pairs.shape)
        cosines[touching] = self.path.at(np.clip(pairs[touching], -approach, recess)).cos_psi
        # equal forces: the torque divides by the sum of the cosines of all pairs in contact
        return self.tangential / cosines.sum(axis=0), touching.sum(axis=0)

    def pressures(self, X: Floats) -> tuple[Floats, Floats, Floats]:
        """Return pressure [MPa], force [N] and number of tooth pairs in contact at positions X along the path [module].

        For helical teeth, the lines of contact and the force normal to the flanks are larger by the factor 1/cos(base
        helix angle), and the curvature across the lines is smaller by the factor cos(base helix angle).
        """
        force, counts = self.forces(X)
        curvature = self.path.at(X).kr / self.module * cos(self.base_helix)
        return self.factor * np.sqrt(force / self.width * curvature), force, counts

    def single(self) -> tuple[float, float]:
        """Return the two positions between which one tooth pair carries the whole load [module].

        Both ends of the path of contact are returned if the contact ratio is below 1, and also for helical teeth,
        because one pair of helical teeth never carries the whole load.
        """
        (approach, recess), p = self.path.arcs, self.path.pitch.p
        low, high = recess - p, p - approach
        # with a contact ratio below 1 one pair carries the load all the time
        return (low, high) if low <= high and not self.base_helix else (-approach, recess)

    @property
    def has_cusp(self) -> bool:
        """True if the relative curvature of the flanks is not finite at the pitch point, as for cycloids."""
        approach, recess = self.path.arcs
        return -approach <= 0 <= recess and not isfinite(float(self.path.at(np.zeros(1)).kr[0]))

    def single_pressure(self) -> float:
        """Return the maximum pressure while one tooth pair carries the whole load [MPa], as in ISO 6336-2."""
        low, high = self.single()
        # inside the interval, because the load jumps at its ends
        nudge = min(1e-7 * self.path.pitch.p, (high - low) / 4)
        return float(self.pressures(np.linspace(low + nudge, high - nudge, _POSITIONS))[0].max())

    def places(self) -> tuple[ContactPlace, ...]:
        """Return the pressures at the ends of contact, at the ends of single contact, at the pitch point, and at the
        position of maximum pressure.
        """
        (approach, recess), p = self.path.arcs, self.path.pitch.p
        named = {"start of contact": -approach, "end of contact": recess}
        low, high = self.single()
        if low > -approach:
            named |= {"inner single contact of gear 1": low, "inner single contact of gear 2": high}
        if -approach <= 0 <= recess:
            named["pitch point"] = 0.0
        X = np.linspace(-approach, recess, _POSITIONS)
        if self.has_cusp:
            X = X[np.abs(X) >= _CUSP * p]
        # load sharing jumps between two positions: the named positions are evaluated on the side of the higher load
        X = np.concatenate((X, [each for name, each in named.items() if name != "pitch point"]))
        pressure, force, counts = self.pressures(X)
        # infinite pressure at a cusp is reported by name, not as the worst position
        worst = int(np.argmax(np.where(np.isfinite(pressure), pressure, -1.0)))
        nudge = 1e-7 * p  # into the interval where fewer tooth pairs carry the load
        nudges = {"inner single contact of gear 1": nudge, "inner single contact of gear 2": -nudge}
        names = sorted(named, key=named.__getitem__)
        own = self.pressures(np.array([named[name] + nudges.get(name, 0.0) for name in names]))
        found = [
            ContactPlace(name, named[name] / p, tooth_pairs, each_force, each_pressure)
            for name, each_pressure, each_force, tooth_pairs in zip(
                names, *(each.tolist() for each in own), strict=True
            )
        ]
        far = "worst" if not self.has_cusp else f"worst, excluding {_CUSP:g} pitch about the pitch point"
        last = ContactPlace(far, float(X[worst] / p), counts[worst].item(), float(force[worst]), float(pressure[worst]))
        return (*found, last)


def base_helix_angle(helix: float, pressure_angle: float) -> float:
    """Return the base helix angle [rad] from that at the pitch circle and the normal pressure angle [rad]."""
    return asin(sin(helix) * cos(pressure_angle))


def minimum_tooth_pairs(contact_ratio: float, overlap: float) -> float:
    """Return the minimum number of tooth pairs in contact, averaged over the width, from equation (20) of
    docs/strength.md.

    contact_ratio   transverse contact ratio; `overlap` is the overlap ratio
    """
    # fractional parts of both ratios: whole pitches do not change the minimum
    first, second = contact_ratio - floor(contact_ratio), overlap - floor(overlap)
    if not overlap:
        return float(floor(contact_ratio))
    lost = first * second if first + second <= 1 else (1 - first) * (1 - second)
    return contact_ratio - lost / overlap


# ----------------------------------------------------------------------------------------------------------- at a point


class ContactEllipse(NamedTuple):
    """Contact ellipse of two bodies: maximum pressure [MPa], semi-major and semi-minor axes [mm]."""

    pressure: float
    longer: float
    shorter: float


def contact_ellipse(force: float, factor: float, curvatures: tuple[float, float], crossing: float) -> ContactEllipse:
    """Return Hertz's contact ellipse of two crossed cylinders, equation (25) of docs/strength.md.

    force        normal force [N]; `factor` is the elasticity factor ZE [sqrt(MPa)]
    curvatures   curvatures of both cylinders [1/mm]
    crossing     angle between their generatrices [rad], above 0

    Two rods of radius 10 mm that cross at a right angle are equivalent to a ball of radius 10 mm on a plane:

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
        k2 = np.exp(2 * log)  # squared ratio of the semi-axes
        K, E = ellipkm1(k2), ellipe(1 - k2)
        return float(np.log((E / k2 - K) / (K - E)) - np.log(wanted))

    # equal curvatures: the ellipse is a circle, where the equation of its axes is singular
    if apart <= 1e-9 * total:
        k = 1.0
    # an axis ratio below exp(-34) is close to the rounding error: practically a line
    elif ratio(-34.0) < 0:
        why = f"their generatrices cross at only {crossing:.3g} rad"
        what = "the contact ellipse of nearly parallel cylinders cannot be computed"
        raise RangeError(Problem(what, why, "use the pressure of a line contact, `hertz_pressure`"))
    else:
        # in logarithms, because long ellipses have axis ratios down to 1e-15
        k = float(np.exp(brentq(ratio, -34.0, -1e-7)))
    # contact modulus E* from ZE
    modulus = pi * factor**2
    pressure = ((total * modulus / float(ellipe(1 - k**2))) ** 2 * 3 * force * k / (2 * pi)) ** (1 / 3)
    longer = sqrt(3 * force / (2 * pi * pressure * k))
    return ContactEllipse(float(pressure), longer, k * longer)


@dataclass(frozen=True)
class CrossedWheels:
    """Two involute helical wheels on crossed axes, one of which may be a worm. Lengths are in mm."""

    radii: tuple[float, float]
    """Radii of the pitch circles [mm]."""
    helix: tuple[float, float]
    """Helix angles [rad], positive for right-hand helices; their sum is the shaft angle."""
    module: float
    """Normal module [mm]."""
    pressure_angle: float
    """Normal pressure angle [rad]."""
    addenda: tuple[float, float] = (1.0, 1.0)
    """Addenda of both wheels [module]."""
    widths: tuple[float, float] = (float("inf"), float("inf"))
    """Face widths of both wheels [mm]; infinite if they are not known."""

    @property
    def pitch(self) -> float:
        """Base pitch along the line of action [mm]."""
        return pi * self.module * cos(self.pressure_angle)

    def flank_radius(self, at: int) -> float:
        """Return the radius of curvature of a flank at the pitch point, perpendicular to its generatrices [mm]."""
        transverse = atan(tan(self.pressure_angle) / cos(self.helix[at]))
        return self.radii[at] * sin(transverse) / cos(base_helix_angle(self.helix[at], self.pressure_angle))

    def normal_count(self, at: int) -> float:
        """Return the virtual number of teeth of one wheel in the normal section, which is not an integer in general."""
        return 2 * self.radii[at] / self.module / cos(base_helix_angle(self.helix[at], self.pressure_angle)) ** 2

    def tooth_length(self, at: int) -> float:
        """Return the length of a tooth along its pitch helix [mm]."""
        return self.widths[at] / cos(self.helix[at])

    @cached_property
    def crossing(self) -> float:
        """Angle between the generatrices of both flanks at the point of contact [rad]."""
        normal = cos(self.pressure_angle), 0.0, sin(self.pressure_angle)
        axes = (sin(self.helix[0]), cos(self.helix[0]), 0.0), (-sin(self.helix[1]), cos(self.helix[1]), 0.0)
        # each generatrix lies in the plane of its axis and the normal, perpendicular to the normal
        first, second = (unit(minus(axis, scaled(normal, dot(axis, normal)))) for axis in axes)
        return asin(min(size(cross(first, second)), 1.0))

    def _bounds(self, at: int) -> dict[str, float]:
        """Return the distances from the pitch point at which the path of contact may end towards the tip of one wheel
        [mm], by cause: tip, base circle, or width.
        """
        alpha, lean = self.pressure_angle, self.helix[at]
        tip = self.radii[at] + self.addenda[at] * self.module
        # (r + s sin a)^2 + (s cos a cos b)^2 = tip^2
        square, half = sin(alpha) ** 2 + (cos(alpha) * cos(lean)) ** 2, self.radii[at] * sin(alpha)
        reach = (sqrt(half**2 + square * (tip**2 - self.radii[at] ** 2)) - half) / square
        steps = (
            cos(alpha) * abs(sin(lean)) for lean in self.helix
        )  # displacement along each axis per length of the line of action
        aside = [width / 2 / step for step, width in zip(steps, self.widths, strict=True) if step]
        return {"tip": reach, "base": self.flank_radius(1 - at), "width": min(aside, default=float("inf"))}

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Lengths of the path of contact from the pitch point towards the tip of the second wheel and towards the tip
        of the first wheel [mm].
        """
        return min(self._bounds(1).values()), min(self._bounds(0).values())

    @property
    def bounded_by(self) -> frozenset[str]:
        """Causes that limit the path of contact at its two ends: tip, base circle or width of a wheel."""
        return frozenset(min(found, key=found.__getitem__) for found in (self._bounds(0), self._bounds(1)))

    @property
    def contact_ratio(self) -> float:
        """Contact ratio: length of the path of contact divided by the base pitch."""
        return sum(self.ends) / self.pitch

    def tooth_pairs(self, place: float) -> int:
        """Return the number of tooth pairs in contact while one of them is in contact at the distance `place` from the
        pitch point [mm], positive after the pitch point.
        """
        back, front = self.ends
        # contacts exactly at an end of the path count, in spite of rounding
        slack = 1e-9 * self.pitch
        return int((place + back + slack) // self.pitch + (front - place + slack) // self.pitch + 1)

    def ellipse(self, place: float, force: float, factor: float) -> ContactEllipse:
        """Return the contact ellipse at the distance `place` past the pitch point [mm], for a normal force [N] shared
        by all tooth pairs in contact.
        """
        rho = self.flank_radius(0) + place, self.flank_radius(1) - place
        return contact_ellipse(force / self.tooth_pairs(place), factor, (1 / rho[0], 1 / rho[1]), self.crossing)

    def worst(self, force: float, factor: float) -> ContactEllipse:
        """Return the contact ellipse of maximum pressure while the fewest tooth pairs are in contact."""
        back, front = self.ends
        places = np.linspace(-back, front, _POINTS)[1:-1].tolist()
        # the ends of the path are excluded: a pair carries no load there
        counts = [self.tooth_pairs(place) for place in places]
        fewest = min(counts)
        loaded = (place for place, count in zip(places, counts, strict=True) if count == fewest)
        return max(self.ellipse(place, force, factor) for place in loaded)


# ----------------------------------------------------------------------------------------------------------------- wear


def loss_over_friction(mesh: GearMesh) -> float | None:
    """Return the power loss of a pair divided by the transmitted power and by the friction coefficient, for friction
    close to 0, equation (14) of docs/strength.md; None for teeth that lock.

    This value times the energy that the pair transmits is the integral of force over sliding distance.
    """
    # the limit at friction 0, evaluated at a small coefficient
    wheels = replace(mesh.wheels, friction=_SLIGHT, friction_law=None)
    path = mesh.path
    angle = None if path is None or not path.pitch.bevel else path.pitch.R1 + path.pitch.R2
    slight = mesh.tooth_form.mesh(wheels, lambda: angle).driven_by(mesh.who)  # type: ignore[attr-defined]
    mean = slight.efficiency(mesh.driver).mean
    return None if mean is None else (1 - float(mean)) / _SLIGHT


def deepest_passage(load: ContactLoad, gear: int) -> float:
    """Return the maximum of force per width times sliding distance in one passage [N], among all points of a flank,
    equation (15) of docs/strength.md. A point at which the contact does not move along the flank is omitted.

    The product of this value and the wear coefficient K, divided by the hardness, is the depth of wear.
    """
    approach, recess = load.path.arcs
    X = np.linspace(-approach, recess, 801)
    force, _ = load.forces(X)
    found = load.path.at(X)
    own = found.U1 if gear == 1 else found.U2
    # a point at rest relative to its flank has no sliding path
    with np.errstate(divide="ignore", invalid="ignore"):
        passed = force / load.width * np.abs(found.U1 - found.U2) / np.abs(own)
    return float(passed[np.isfinite(passed)].max(initial=0.0))
