"""Contact of helical involutes on parallel axes: the load lies evenly along all lines of contact.

A helical wheel is many thin spur wheels, each turned a little against the next, so that their couples come into contact
one after the other. How many couples touch, in the mean of the width, changes over a pitch; the least counts here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, cos, floor, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.simulation.strength.formulas.contact_pressure import ContactLoad, ContactPlace

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


def base_helix_angle(helix: float, pressure_angle: float) -> float:
    """Of the base cylinder (rad), from the helix angle at the pitch circle and the normal pressure angle."""
    return asin(sin(helix) * cos(pressure_angle))


def least_couples(contact_ratio: float, overlap: float) -> float:
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
    """A loaded helical pair; all as of `ContactLoad`, in the transverse section.

    base_helix   rad
    overlap      pitches by which teeth lag over the width
    """

    base_helix: float = 0.0
    overlap: float = 0.0

    @property
    def lines(self) -> float:
        """Least number of couples in the mean of the width."""
        return least_couples(self.path.contact_ratio, self.overlap)

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

    def places(self) -> tuple[ContactPlace, ...]:
        """Ends of the path, the pitch point, and the worst of all places."""
        (approach, recess), p = self.path.arcs, self.path.pitch.p
        named = {"start of contact": -approach, "pitch point": 0.0, "end of contact": recess}
        X = np.linspace(-approach, recess, 801)
        pressure, force, counts = self.pressures(X)
        worst = int(np.argmax(np.where(np.isfinite(pressure), pressure, -1.0)))
        found = [self._at(name, each) for name, each in named.items() if -approach <= each <= recess]
        last = ContactPlace(
            "worst", float(X[worst] / p), float(counts[worst]), float(force[worst]), float(pressure[worst])
        )
        return (*found, last)

    def _at(self, name: str, X: float) -> ContactPlace:
        pressure, force, counts = self.pressures(np.array([X]))
        return ContactPlace(name, X / self.path.pitch.p, float(counts[0]), float(force[0]), float(pressure[0]))
