"""Hertz's contact of two teeth, and Archard's wear: docs/strength.md.

ContactLoad     contact along a line, the load shared among the couples that touch on the path of contact
LeaningLoad     the same of helical involutes on parallel axes: many thin spur wheels, each turned a little against the
                next, so that the load lies evenly along all lines of contact
CrossedWheels   contact at a point: Hertz's ellipse, and the involute helicoids of wheels on crossed axes
loss_over_friction, deepest_passage   wear V = (K/H) times the integral of force over the way slid
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


WEAR_RANGE = (1e-7, 1e-3)
"""Wear coefficients K from greased metal to dry bronze or brass: four powers of ten, all of which one may meet."""

YIELD_AT = 5 / 3
"""Greatest pressure of a line contact over the yield stress where yielding begins below it.

The greatest shear stress is 0.300 of that pressure, 0.79 half widths deep; by Tresca metal yields at half the yield
stress (Johnson, Contact Mechanics, 1985, sections 4.2 and 6.2).
"""

YIELD_AT_POINT = 1.6
"""Greatest pressure of a contact at a point over the yield stress where yielding begins below it.

Of spheres, by Tresca and by von Mises alike (Johnson, Contact Mechanics, 1985, section 6.2); of a long ellipse 5/3.
"""

_CUSP = 0.1  # pitches about a pitch point where a flank has no radius
_POSITIONS = 801
_POINTS = 401
_SLIGHT = 1e-5  # friction so small that what is lost goes with it


# --------------------------------------------------------------------------------------------------------- along a line


@dataclass(frozen=True, slots=True)
class Elasticity:
    """Young's modulus (MPa) and Poisson's ratio of a material."""

    youngs_modulus: float
    poisson: float


def elasticity_factor(first: Elasticity, second: Elasticity) -> float:
    """ZE of two materials [sqrt(MPa)]: docs/strength.md (1).

    ZE^2 = 1 / (pi ((1 - nu1^2)/E1 + (1 - nu2^2)/E2))

    >>> steel = Elasticity(206_000, 0.3)
    >>> round(elasticity_factor(steel, steel), 2)
    189.81
    """
    yields = sum((1 - each.poisson**2) / each.youngs_modulus for each in (first, second))
    return 1 / sqrt(pi * yields)


def hertz_pressure(factor: float, force: float, width: float, curvature: float) -> float:
    """Greatest pressure [MPa] of a line contact: docs/strength.md (2).

    factor      of elasticity [sqrt(MPa)]
    force       normal to the flanks [N]; `width` [mm] along which they touch
    curvature   1/rho1 + 1/rho2 [1/mm]
    """
    return factor * sqrt(force / width * curvature)


@dataclass(frozen=True, slots=True)
class ContactPlace(Result):
    """Pressure at one place of the path of contact."""

    KEYS = ("where", "position", "tooth_pairs", "force", Key("pressure", to=finite))

    where: str
    """What the place is called."""
    position: float
    """Past the pitch point, along the pitch line [pitch]."""
    tooth_pairs: float
    """Pairs of teeth that touch then; each carries the same force. For helical teeth, the least mean over the width."""
    force: float
    """Normal to the flanks [N]."""
    pressure: float
    """Greatest in the contact [MPa]; infinite where a flank has no radius."""


@dataclass(frozen=True, slots=True)
class ContactLoad:
    """A loaded pair with a path of contact."""

    path: PathOfContact
    """Of the pair, lengths in modules."""
    module: float
    """Mm; `width` of the teeth in contact, mm."""
    width: float
    torque: float
    """On gear 1 [N mm]."""
    factor: float
    """Of elasticity [sqrt(MPa)]."""

    @property
    def tangential(self) -> float:
        """Force along the pitch line [N]."""
        return self.torque / (self.path.pitch.R1 * self.module)

    def tooth_pairs(self, X: float) -> list[float]:
        """Displacements of all couples that touch while one touches at X."""
        p, (approach, recess) = self.path.pitch.p, self.path.arcs
        slack = 1e-9 * p
        first, last = ceil((-approach - X - slack) / p), floor((recess - X + slack) / p)
        return [X + k * p for k in range(first, last + 1)] or [X]

    def forces(self, X: Floats) -> tuple[Floats, Floats]:
        """Normal force [N] at each displacement, and how many couples share the torque: all carry the same force."""
        cosines, counts = [], []
        for each in X.tolist():
            found = self.path.at(np.clip(self.tooth_pairs(each), -self.path.arcs[0], self.path.arcs[1])).cos_psi
            cosines.append(float(found.sum()))
            counts.append(len(found))
        return self.tangential / np.array(cosines), np.array(counts)

    def pressures(self, X: Floats) -> tuple[Floats, Floats, Floats]:
        """Pressure [MPa], force [N] and couples at displacements X."""
        force, counts = self.forces(X)
        curvature = self.path.at(X).kr / self.module
        return self.factor * np.sqrt(force / self.width * curvature), force, counts

    def single(self) -> tuple[float, float]:
        """The displacements between which one couple bears all; the whole path where two never touch."""
        (approach, recess), p = self.path.arcs, self.path.pitch.p
        low, high = recess - p, p - approach
        return (low, high) if low <= high else (-approach, recess)

    @property
    def has_cusp(self) -> bool:
        """True for flanks without radius at the pitch point, as cycloids have."""
        approach, recess = self.path.arcs
        return -approach <= 0 <= recess and not isfinite(float(self.path.at(np.zeros(1)).kr[0]))

    def single_pressure(self) -> float:
        """The greatest pressure [MPa] while one couple bears all, as ISO 6336-2 has it."""
        low, high = self.single()
        nudge = min(1e-7 * self.path.pitch.p, (high - low) / 4)
        return float(self.pressures(np.linspace(low + nudge, high - nudge, _POSITIONS))[0].max())

    def places(self) -> tuple[ContactPlace, ...]:
        """Ends of contact and of single contact, the pitch point, and the worst of all places."""
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
        # a jump of the sharing lies between two positions: the named ones stand on its side of more load
        X = np.concatenate((X, [each for name, each in named.items() if name != "pitch point"]))
        pressure, force, counts = self.pressures(X)
        worst = int(np.argmax(np.where(np.isfinite(pressure), pressure, -1.0)))
        found = [self._place(name, each) for name, each in sorted(named.items(), key=lambda each: each[1])]
        far = "worst" if not self.has_cusp else f"worst, but for {_CUSP:g} pitch about the pitch point"
        last = ContactPlace(far, float(X[worst] / p), counts[worst].item(), float(force[worst]), float(pressure[worst]))
        return (*found, last)

    def _place(self, name: str, X: float) -> ContactPlace:
        nudge = 1e-7 * self.path.pitch.p  # into the stretch where fewer couples bear the load
        towards = {"inner single contact of gear 1": nudge, "inner single contact of gear 2": -nudge}.get(name, 0.0)
        pressure, force, counts = self.pressures(np.array([X + towards]))
        return ContactPlace(name, X / self.path.pitch.p, counts[0].item(), float(force[0]), float(pressure[0]))


def base_helix_angle(helix: float, pressure_angle: float) -> float:
    """Of the base cylinder (rad), from the helix angle at the pitch circle and the normal pressure angle."""
    return asin(sin(helix) * cos(pressure_angle))


def minimum_tooth_pairs(contact_ratio: float, overlap: float) -> float:
    """The least number of couples that touch, in the mean over the width: docs/strength.md (20).

    contact_ratio   in the transverse section; `overlap`, by how many pitches teeth lag over the width
    """
    first, second = contact_ratio - floor(contact_ratio), overlap - floor(overlap)
    if not overlap:
        return float(floor(contact_ratio))
    lost = first * second if first + second <= 1 else (1 - first) * (1 - second)
    return contact_ratio - lost / overlap


@dataclass(frozen=True, slots=True)
class LeaningLoad(ContactLoad):
    """A loaded helical pair; all as of `ContactLoad`, in the transverse section."""

    base_helix: float = 0.0
    """Rad."""
    overlap: float = 0.0
    """Pitches by which teeth lag over the width."""

    @property
    def lines(self) -> float:
        """Least number of couples in the mean of the width."""
        return minimum_tooth_pairs(self.path.contact_ratio, self.overlap)

    def forces(self, X: Floats) -> tuple[Floats, Floats]:
        """Force [N] on one whole tooth across the axes at each displacement, were all alike; and how many share it."""
        force = self.tangential / self.path.at(X).cos_psi / self.lines
        return force, np.full(X.shape, self.lines)

    def pressures(self, X: Floats) -> tuple[Floats, Floats, Floats]:
        """Pressure [MPa], force [N] and couples at displacements X.

        Lines of contact are longer by 1/cos of the base helix angle, so is the force along them, and flanks are the
        flatter across them.
        """
        force, counts = self.forces(X)
        curvature = self.path.at(X).kr / self.module * cos(self.base_helix)
        return self.factor * np.sqrt(force / self.width * curvature), force, counts

    def single(self) -> tuple[float, float]:
        """All of the path: the load never rests on one couple alone."""
        return -self.path.arcs[0], self.path.arcs[1]


# ----------------------------------------------------------------------------------------------------------- at a point


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
    """Two helical wheels of involute teeth on axes that cross; one of them may be a worm. Lengths in mm."""

    radii: tuple[float, float]
    """Of the pitch circles."""
    helix: tuple[float, float]
    """Helix angles (rad), of right hands above 0; they add up to the shaft angle."""
    module: float
    """Across the teeth."""
    pressure_angle: float
    """Across the teeth (rad)."""
    addenda: tuple[float, float] = (1.0, 1.0)
    """Of both, in modules."""
    widths: tuple[float, float] = (float("inf"), float("inf"))
    """Of both, infinite where they are not known."""

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

    def tooth_pairs(self, place: float) -> int:
        """How many touch while one does at a place, counted along the normal past the pitch point."""
        back, front = self.ends
        slack = 1e-9 * self.pitch
        return int((place + back + slack) // self.pitch + (front - place + slack) // self.pitch + 1)

    def ellipse(self, place: float, force: float, factor: float) -> ContactEllipse:
        """Where they touch at a place, all couples sharing a normal force [N]."""
        rho = self.flank_radius(0) + place, self.flank_radius(1) - place
        return contact_ellipse(force / self.tooth_pairs(place), factor, (1 / rho[0], 1 / rho[1]), self.crossing)

    def worst(self, force: float, factor: float) -> ContactEllipse:
        """The greatest pressure of all places where as few couples touch as anywhere."""
        back, front = self.ends
        places = np.linspace(-back, front, _POINTS)[1:-1].tolist()
        fewest = min(self.tooth_pairs(place) for place in places)
        found = [self.ellipse(place, force, factor) for place in places if self.tooth_pairs(place) == fewest]
        return max(found)


# ----------------------------------------------------------------------------------------------------------------- wear


def loss_over_friction(mesh: GearMesh) -> float | None:
    """What a pair loses of the power through it, over friction, as friction goes to 0: docs/strength.md (14).

    The energy through the pair times this is the integral of force over the way slid. None for teeth that lock.
    """
    wheels = replace(mesh.wheels, friction=_SLIGHT, friction_law=None)
    path = mesh.path
    angle = None if path is None or not path.pitch.bevel else path.pitch.R1 + path.pitch.R2
    slight = mesh.tooth_form.mesh(wheels, lambda: angle).driven_by(mesh.who)  # type: ignore[attr-defined]
    mean = slight.efficiency(mesh.driver).mean
    return None if mean is None else (1 - float(mean)) / _SLIGHT


def deepest_passage(load: ContactLoad, gear: int) -> float:
    """Greatest force per width times way slid over one point of a flank while its tooth passes once [N]: (15).

    Over the hardness, and times K, it is a depth [N/mm times mm]. A point on which contact stands still is left out.
    """
    approach, recess = load.path.arcs
    X = np.linspace(-approach, recess, 801)
    force, _ = load.forces(X)
    found = load.path.at(X)
    own = found.U1 if gear == 1 else found.U2
    with np.errstate(divide="ignore", invalid="ignore"):
        passed = force / load.width * np.abs(found.U1 - found.U2) / np.abs(own)
    return float(passed[np.isfinite(passed)].max(initial=0.0))
