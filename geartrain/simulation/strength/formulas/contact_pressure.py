"""Hertz pressure between two flanks along their path of contact, the load shared among the couples that touch."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, isfinite, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

YIELD_AT = 5 / 3
"""Greatest pressure of a line contact over the yield stress where yielding begins below it.

The greatest shear stress is 0.300 of that pressure, 0.79 half widths deep; by Tresca metal yields at half the yield
stress (Johnson, Contact Mechanics, 1985, sections 4.2 and 6.2).
"""

_CUSP = 0.1  # pitches about a pitch point where a flank has no radius
_POSITIONS = 801


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
    """Pressure at one place of the path of contact.

    Attributes
    ----------
    where : str
        What the place is called.
    position : float
        Past the pitch point, along the pitch line [pitch].
    couples : float
        Pairs of teeth that touch then; each carries the same force. For helical teeth, the least mean over the width.
    force : float
        Normal to the flanks [N].
    pressure : float
        Greatest in the contact [MPa]; infinite where a flank has no radius.
    """

    KEYS = ("where", "position", "couples", "force", Key("pressure", to=finite))

    where: str
    position: float
    couples: float
    force: float
    pressure: float


@dataclass(frozen=True, slots=True)
class ContactLoad:
    """A loaded pair with a path of contact.

    path     of the pair, lengths in modules
    module   mm; `width` of the teeth in contact, mm
    torque   on gear 1 [N mm]
    factor   of elasticity [sqrt(MPa)]
    """

    path: PathOfContact
    module: float
    width: float
    torque: float
    factor: float

    @property
    def tangential(self) -> float:
        """Force along the pitch line [N]."""
        return self.torque / (self.path.pitch.R1 * self.module)

    def couples(self, X: float) -> list[float]:
        """Displacements of all couples that touch while one touches at X."""
        p, (approach, recess) = self.path.pitch.p, self.path.arcs
        slack = 1e-9 * p
        first, last = ceil((-approach - X - slack) / p), floor((recess - X + slack) / p)
        return [X + k * p for k in range(first, last + 1)] or [X]

    def forces(self, X: Floats) -> tuple[Floats, Floats]:
        """Normal force [N] at each displacement, and how many couples share the torque: all carry the same force."""
        cosines, counts = [], []
        for each in X.tolist():
            found = self.path.at(np.clip(self.couples(each), -self.path.arcs[0], self.path.arcs[1])).cos_psi
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
        """Ends of single contact, the pitch point, and the worst of all places."""
        (approach, recess), p = self.path.arcs, self.path.pitch.p
        named = {"start of contact": -approach, "end of contact": recess}
        if approach + recess > p and recess - p < p - approach:
            low, high = self.single()
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
        last = ContactPlace(far, float(X[worst] / p), int(counts[worst]), float(force[worst]), float(pressure[worst]))
        return (*found, last)

    def _place(self, name: str, X: float) -> ContactPlace:
        nudge = 1e-7 * self.path.pitch.p  # into the stretch where fewer couples bear the load
        towards = {"inner single contact of gear 1": nudge, "inner single contact of gear 2": -nudge}.get(name, 0.0)
        pressure, force, counts = self.pressures(np.array([X + towards]))
        return ContactPlace(name, X / self.path.pitch.p, int(counts[0]), float(force[0]), float(pressure[0]))
