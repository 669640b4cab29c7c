"""Equal planets, equally spaced: which tooth counts let all of them be put in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from geartrain.synthesis.constraints.count_conditions import Condition, counts_of, free_of

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Ints
    from geartrain.synthesis.constraints.count_conditions import CandidateColumns, CountRef
    from geartrain.synthesis.constraints.train_assembly import AssemblyMesh, Planet, PlanetSet


@dataclass(frozen=True, slots=True)
class PlanetContact:
    """A mesh of a planet: its own count, its mate's, and the sense of the pair (1 external, -1 with a ring)."""

    own: CountRef
    mate: CountRef
    sense: int


@dataclass(frozen=True, slots=True)
class PlanetArm:
    """A planet as its teeth see it: contacts with central wheels, and with planets outward of it."""

    central: tuple[PlanetContact, ...]
    outward: tuple[tuple[PlanetContact, PlanetArm], ...]

    def contacts(self) -> Iterator[PlanetContact]:
        """All of them, those of planets farther out too."""
        yield from self.central
        for contact, arm in self.outward:
            yield contact
            yield from arm.contacts()


@dataclass(frozen=True, slots=True)
class EqualPlanets:
    """n equal sets of planets, each a turn over n from the one before, can mesh with the same central wheels.

    A mesh of wheels a and b holds z_a theta_a + z_b theta_b at a constant, modulo a pitch (angles in turns, seen from
    the carrier; minus with a ring). Turning one set that meshes by 1/n gives the next one's place, and turns central
    wheels by 1/n too; they must come back to where they stand, for they are there already. So planets must have
    angles phi with

        z_p phi_p + z_c/n whole for every central wheel c (minus for a ring),
        z_p phi_p + z_q phi_q whole for planets that mesh.

    Walking from the planets farthest out to the first one, the angles of a planet that are left are those with
    D phi = b/n (mod 1), for whole D and b: a wheel c gives D = z_p, b = -z_c; two such conditions can be met together
    if n gcd(D1, D2) divides D1 b2 - D2 b1, and are one, D = gcd(D1, D2) and b = u b1 + v b2, with u D1 + v D2 = D.

    One planet with one wheel gives the textbooks' rule, n divides z_s + z_r; one with two wheels, n gcd(z_p, z_q)
    divides z_s z_q + z_r z_p; two planets one after the other, n divides z_r - z_s. The second derivation is that of
    phase closure (`geartrain.kinematics.phasing`): the loops through neighbouring planets must close.
    """

    number: int
    first: PlanetArm

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where they can, (candidates,)."""
        left, found = self._left(self.first, columns)
        # what any two conditions on one angle allow, all of them allow: they stand at whole multiples of one step
        for (D1, b1), (D2, b2) in combinations(left, 2):
            found = found & self._agree(D1, b1, D2, b2, np.gcd(D1, D2))
        return np.asarray(found)

    def _left(self, arm: PlanetArm, columns: CandidateColumns) -> tuple[list[tuple[Ints, Ints]], Bools]:
        """D and b of the conditions on the angle of a planet, and where planets farther out can meet theirs."""
        n = self.number
        found = np.asarray(True)
        left = []
        for contact in arm.central:
            own, mate = counts_of(columns, contact.own), counts_of(columns, contact.mate)
            # b matters modulo n only: reduced, so that products of counts stay within int64
            left.append((own, np.asarray(-contact.sense * mate % n)))
        for contact, other in arm.outward:
            further, fits = self._left(other, columns)
            found = found & fits
            if not further:
                continue
            (D, b), fits = self._joined(further)
            own, mate = counts_of(columns, contact.own), counts_of(columns, contact.mate)
            # z phi of the planet farther out is known up to multiples of gcd(z, D)/D
            common = np.gcd(mate, D)
            left.append((np.asarray(D // common * own), np.asarray(-contact.sense * (mate // common % n) * b % n)))
            found = found & fits
        return left, np.asarray(found)

    def _joined(self, left: list[tuple[Ints, Ints]]) -> tuple[tuple[Ints, Ints], Bools]:
        """All conditions on an angle as one, and where they agree."""
        (D, b), *others = left
        found = np.asarray(True)
        for D2, b2 in others:
            common, u, v = bezout(D, D2)
            found = found & self._agree(D, b, D2, b2, common)
            D, b = common, np.asarray((u % self.number * b + v % self.number * b2) % self.number)
        return (D, b), np.asarray(found)

    def _agree(self, D1: Ints, b1: Ints, D2: Ints, b2: Ints, common: Ints) -> Bools:
        return np.asarray((D1 * b2 - D2 * b1) % (self.number * common) == 0)


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
    first = _arm(found.planets)
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
    one, other = (_contact(planet, mesh) for mesh in planet.central)
    sign = "+" if one.sense * other.sense < 0 else "-"
    if len(planet.wheels) == 1:
        return f"{head}: {number} divides {one.mate} {sign} {other.mate}"
    return f"{head}: {number} gcd({one.own}, {other.own}) divides {one.mate} {other.own} {sign} {other.mate} {one.own}"


def _arm(planet: Planet) -> PlanetArm:
    outward = tuple((_contact(planet, mesh, other), _arm(other)) for mesh, other in planet.outward)
    return PlanetArm(tuple(_contact(planet, mesh) for mesh in planet.central), outward)


def _contact(planet: Planet, mesh: AssemblyMesh, other: Planet | None = None) -> PlanetContact:
    """A mesh of a planet. Of one with a single wheel only z phi matters, whatever its z: one tooth stands for it."""
    side = planet.side(mesh)
    own = mesh.parts[side] if len(planet.wheels) > 1 else 1
    return PlanetContact(own, 1 if other and len(other.wheels) == 1 else mesh.parts[1 - side], mesh.sense)
