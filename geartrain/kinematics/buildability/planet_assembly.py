"""Equal planets on a carrier: at which angles they can be put in, and how much room they leave each other."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations
from math import gcd
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.planet_sets import AssemblyMesh, CountRef, Planet


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


def planet_arm(planet: Planet) -> PlanetArm:
    """A planet of a set, with those outward of it."""
    outward = tuple((planet_contact(planet, mesh, other), planet_arm(other)) for mesh, other in planet.outward)
    return PlanetArm(tuple(planet_contact(planet, mesh) for mesh in planet.central), outward)


def planet_contact(planet: Planet, mesh: AssemblyMesh, other: Planet | None = None) -> PlanetContact:
    """A mesh of a planet. Of one with a single wheel only z phi matters, whatever its z: one tooth stands for it."""
    side = planet.side(mesh)
    own = mesh.parts[side] if len(planet.wheels) > 1 else 1
    return PlanetContact(own, 1 if other and len(other.wheels) == 1 else mesh.parts[1 - side], mesh.sense)


@dataclass(frozen=True, slots=True)
class PhaseArithmetic:
    """Whole numbers, or arrays of them, one a candidate.

    count    the number or array that a count of a contact stands for
    gcd      greatest common divisor
    bezout   the same g of a and b, and u, v with u a + v b = g
    reduced  what is kept of a number that matters modulo the number of planets only
    """

    count: Callable[[CountRef], Any]
    gcd: Callable[[Any, Any], Any]
    bezout: Callable[[Any, Any], tuple[Any, Any, Any]]
    reduced: Callable[[Any], Any]


def phase_numbers(arm: PlanetArm, kind: PhaseArithmetic) -> list[Any]:
    """Whole numbers E: a set turned by t about the carrier's axis meshes too if E t is whole for each (t in turns).

    A mesh of wheels a and b holds z_a theta_a + z_b theta_b at a constant, modulo a pitch (angles in turns, seen from
    the carrier; minus with a ring). Turning a set that meshes by t gives another one's place, and turns central wheels
    by t too; they must come back to where they stand, for they are there already. So planets must have angles phi with

        z_p phi_p + z_c t whole for every central wheel c (minus for a ring),
        z_p phi_p + z_q phi_q whole for planets that mesh.

    Walking from the planets farthest out to the first one, the angles of a planet that are left are those with
    D phi = b t (mod 1), for whole D and b: a wheel c gives D = z_p, b = -z_c; two such conditions can be met together
    if gcd(D1, D2) divides (D1 b2 - D2 b1) t, and are one, D = gcd(D1, D2) and b = u b1 + v b2, with u D1 + v D2 = D.

    One planet with one wheel gives the textbooks' rule: z_s + z_r, and n planets stand evenly (t = 1/n) if n divides
    that; one with two wheels (z_s z_q + z_r z_p)/gcd(z_p, z_q); two planets one after the other, z_r - z_s. The second
    derivation is that of phase closure (`geartrain.kinematics.phasing`): loops through neighbouring planets must close.
    """
    found: list[Any] = []
    left = _left(arm, kind, found)
    # what any two conditions on one angle allow, all of them allow: they stand at whole multiples of one step
    found += (_number(one, other, kind.gcd(one[0], other[0])) for one, other in combinations(left, 2))
    return found


def _left(arm: PlanetArm, kind: PhaseArithmetic, found: list[Any]) -> list[tuple[Any, Any]]:
    """D and b of the conditions on the angle of a planet; numbers of those farther out are added to `found`."""
    left = []
    for contact in arm.central:
        own, mate = kind.count(contact.own), kind.count(contact.mate)
        left.append((own, kind.reduced(-contact.sense * mate)))
    for contact, other in arm.outward:
        further = _left(other, kind, found)
        if not further:
            continue
        D, b = _joined(further, kind, found)
        own, mate = kind.count(contact.own), kind.count(contact.mate)
        # z phi of the planet farther out is known up to multiples of gcd(z, D)/D
        common = kind.gcd(mate, D)
        left.append((D // common * own, kind.reduced(-contact.sense * kind.reduced(mate // common) * b)))
    return left


def _joined(left: list[tuple[Any, Any]], kind: PhaseArithmetic, found: list[Any]) -> tuple[Any, Any]:
    """All conditions on an angle as one; numbers of their agreement are added to `found`."""
    (D, b), *others = left
    for D2, b2 in others:
        common, u, v = kind.bezout(D, D2)
        found.append(_number((D, b), (D2, b2), common))
        D, b = common, kind.reduced(kind.reduced(u) * b + kind.reduced(v) * b2)
    return D, b


def _number(one: tuple[Any, Any], other: tuple[Any, Any], common: Any) -> Any:
    return (one[0] * other[1] - other[0] * one[1]) // common


def bezout(a: int, b: int) -> tuple[int, int, int]:
    """Greatest common divisor g of two numbers from 0, and u, v with u a + v b = g (Euclid's algorithm).

    >>> bezout(24, 18)
    (6, 1, -1)
    """
    r, s, t, r2, s2, t2 = a, 1, 0, b, 0, 1
    while r2:
        q = r // r2
        r, r2, s, s2, t, t2 = r2, r - q * r2, s2, s - q * s2, t2, t - q * t2
    return r, s, t


def assembly_number(planet: Planet) -> int:
    """G: equal sets of planets mesh with the same central wheels at angles that are whole multiples of 1/G turn.

    0 where they do at any angle.
    """
    exact = PhaseArithmetic(int, gcd, bezout, lambda number: number)
    return gcd(*phase_numbers(planet_arm(planet), exact))


def neighbour_terms(root: Any, reach: Any, tips: Any, chord: Any) -> tuple[Any, ...]:
    """Terms of the room between neighbouring equal planets: 2 a sin(pi/n) less their tips and what is to be left.

    reach   2 a, with a from the central axis to a planet's: m (z_s + z_p), or m (z_r - z_p)
    tips    m (z_p + 2 h) + clearance
    chord   sin(pi/n)
    """
    return reach * chord, -tips


def passing_terms(root: Any, A: Any, B: Any, D: Any, tips: Any, c: Any, s: Any) -> tuple[Any, ...]:
    """Terms of the room between a planet and the one that meshes with its neighbour: (2 distance)^2 less (2 reach)^2.

    A, B   twice the distances of the two planets' axes from the central axis
    D      twice their centre distance where they mesh, D^2 = A^2 + B^2 - 2 A B cos(delta)
    tips   tip diameters, summed, and twice what is to be left
    c, s   cosine and sine of the turn psi to the neighbour: the distance is that at the angle psi - delta,
           (2 distance)^2 = A^2 + B^2 - 2 A B (c cos(delta) + s sin(delta))
    """
    Q = A * A + B * B - D * D
    sines = root(4 * A * A * B * B - Q * Q)
    return A * A, B * B, -c * Q, -s * sines, -tips * tips
