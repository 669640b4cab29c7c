"""Equal planets, equally spaced: which tooth counts let all of them be put in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.kinematics.buildability.planet_assembly import (
    PhaseArithmetic,
    PlanetArm,
    phase_numbers,
    planet_arm,
    planet_contact,
)
from geartrain.synthesis.constraints.count_conditions import Condition, counts_of, free_of

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.planet_sets import PlanetSet
    from geartrain.numerics.arrays import Bools, Ints
    from geartrain.synthesis.constraints.count_conditions import CandidateColumns


@dataclass(frozen=True, slots=True)
class EqualPlanets:
    """n equal sets of planets, each a turn over n from the one before, can mesh with the same central wheels.

    They can if n divides every number of `phase_numbers`, which has the derivation.
    """

    number: int
    first: PlanetArm

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where they can, (candidates,)."""
        n = self.number
        # b matters modulo n only: reduced, so that products of counts stay within int64
        kind = PhaseArithmetic(lambda part: counts_of(columns, part), np.gcd, bezout, lambda number: number % n)
        found = np.asarray(True)
        for number in phase_numbers(self.first, kind):
            found = found & (number % n == 0)
        return np.asarray(found)


def bezout(a: Ints, b: Ints) -> tuple[Ints, Ints, Ints]:
    """Greatest common divisors g of arrays of numbers from 0, and u, v with u a + v b = g (Euclid's algorithm)."""
    r, s, t, r2, s2, t2 = (np.array(one, dtype=np.int64) for one in np.broadcast_arrays(a, 1, 0, b, 0, 1))
    while np.any(r2):
        done = r2 == 0
        # numpy divides in all rows: by 1 in those that have ended
        q = np.where(done, 0, r // np.maximum(r2, 1))
        # rows that have ended keep their values while others go on
        r, r2 = np.where(done, r, r2), np.where(done, r2, r - q * r2)
        s, s2 = np.where(done, s, s2), np.where(done, s2, s - q * s2)
        t, t2 = np.where(done, t, t2), np.where(done, t2, t - q * t2)
    return r, s, t


def equal_planets(found: PlanetSet, number: int, name: str) -> Condition | None:
    """The condition on a set of planets; None where no count in it is free, or it constrains nothing."""
    assert found.planets is not None
    first = planet_arm(found.planets)
    if sum(len(planet.central) for planet in found.planets.walk()) < 2:
        return None
    wheels = free_of(*(part for contact in first.contacts() for part in (contact.own, contact.mate)))
    return Condition(name, wheels, EqualPlanets(number, first)) if wheels else None


def reason(found: PlanetSet, number: int) -> str:
    """The rule in words, with the formula where it is a short one."""
    head = f"{number} equal planets on '{found.carrier}'"
    planet = found.planets
    if planet is None or planet.outward or len(planet.central) != 2:
        return f"{head}: teeth of {found.title} meet"
    one, other = (planet_contact(planet, mesh) for mesh in planet.central)
    sign = "+" if one.sense * other.sense < 0 else "-"
    if len(planet.wheels) == 1:
        return f"{head}: {number} divides {one.mate} {sign} {other.mate}"
    return f"{head}: {number} gcd({one.own}, {other.own}) divides {one.mate} {other.own} {sign} {other.mate} {one.own}"
