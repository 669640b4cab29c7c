"""Assembly of equal planets on a carrier: phase conditions on tooth counts, and clearance between neighbours."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.buildability.equal_planets import (
    PhaseArithmetic,
    Planet,
    mesh_counts,
    neighbour_terms,
    passing_terms,
    phase_numbers,
)
from geartrain.search.constraints.count_conditions import (
    Condition,
    LinearSum,
    cosine,
    counts_of,
    distance_of,
    free_of,
    is_positive,
    sine,
    teeth_of,
    whole,
)

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.equal_planets import AssemblyMesh, PlanetSet, TrainAssembly
    from geartrain.numerics.arrays import Bools, Ints
    from geartrain.search.constraints.count_conditions import CandidateColumns, WholeSum


# Assembly of equal, equally spaced planets.


def can_mesh(number: int, first: Planet, columns: CandidateColumns) -> Bools:
    """Return whether n equal sets of planets, spaced at 1/n of a revolution, can mesh with the same central wheels.

    The condition, derived in `phase_numbers`, is that n divides each of the numbers that this function returns.
    """
    # b is only needed modulo n; reduced, so that products of counts fit int64
    kind = PhaseArithmetic(lambda part: counts_of(columns, part), np.gcd, bezout, lambda one: one % number)
    found = np.asarray(True)
    for each in phase_numbers(first, kind):
        found = found & (each % number == 0)
    return np.asarray(found)


def bezout(a: Ints, b: Ints) -> tuple[Ints, Ints, Ints]:
    """Return the gcd g of two arrays of numbers >= 0, and u, v with u a + v b = g, by the extended Euclidean
    algorithm.
    """
    r, s, t, r2, s2, t2 = (np.array(one, dtype=np.int64) for one in np.broadcast_arrays(a, 1, 0, b, 0, 1))
    while np.any(r2):
        done = r2 == 0
        # numpy divides in all rows; in finished ones by 1
        q = np.where(done, 0, r // np.maximum(r2, 1))
        # finished rows keep their values
        r, r2 = np.where(done, r, r2), np.where(done, r2, r - q * r2)
        s, s2 = np.where(done, s, s2), np.where(done, s2, s - q * s2)
        t, t2 = np.where(done, t, t2), np.where(done, t2, t - q * t2)
    return r, s, t


def equal_planets(found: PlanetSet, number: int, name: str) -> Condition | None:
    """Return the assembly condition of a set of equal, equally spaced planets.

    Return None if no wheel is varied or the planets mesh with fewer than two central wheels, because any number can
    then be assembled.
    """
    assert found.planets is not None
    planets = list(found.planets.walk())
    if sum(len(planet.central) for planet in planets) < 2:
        return None
    counts = [mesh_counts(planet, mesh) for planet in planets for mesh in planet.central]
    counts += [mesh_counts(planet, mesh, other) for planet in planets for mesh, other in planet.outward]
    wheels = free_of(*(part for pair in counts for part in pair))
    return Condition(name, wheels, partial(can_mesh, number, found.planets)) if wheels else None


def reason(found: PlanetSet, number: int) -> str:
    """Return a description of the assembly condition of equal planets, with its formula if there are two central
    wheels.
    """
    head = f"{number} equal planets on '{found.carrier}'"
    planet = found.planets
    if planet is None or planet.outward or len(planet.central) != 2:
        return f"{head}: teeth of {found.title} mesh"
    (own, mate), (own2, mate2) = (mesh_counts(planet, mesh) for mesh in planet.central)
    sign = "+" if planet.central[0].sense * planet.central[1].sense < 0 else "-"
    if len(planet.wheels) == 1:
        return f"{head}: {number} divides {mate} {sign} {mate2}"
    return f"{head}: {number} gcd({own}, {own2}) divides {mate} {own2} {sign} {mate2} {own}"


# Clearance between planets: neighbours on a carrier, and planets that mesh with each other.


def are_apart(number: int, reach: WholeSum, tips: WholeSum, columns: CandidateColumns) -> Bools:
    """Return whether the tip circles of neighbouring planets have more than the required clearance, exactly.

    `reach` is twice the distance of a planet's axis from the central axis, `tips` the tip diameter plus the clearance;
    see `neighbour_terms`.
    """
    chord = sine(Fraction(1, 2 * number))
    return is_positive(neighbour_terms, [reach.of(columns), tips.of(columns)], [chord], True)


def can_pass(number: int, A: WholeSum, B: WholeSum, D: WholeSum, tips: WholeSum, columns: CandidateColumns) -> Bools:
    """Return whether two meshing planets can be placed on their circles without overlap with the mates of the other
    planets.

    A and B are twice the radii of the two circles, D is twice the centre distance of the planets; see `passing_terms`.
    """
    a, b, d, tip = (one.of(columns) for one in (A, B, D, tips))
    # the triangle of the central axis and the two planets must close
    found = np.asarray((np.abs(a - b) <= d) & (d <= a + b))
    # partners of all other planets, not only of the adjacent ones
    for turn in (Fraction(step, number) for step in range(1, number)):
        found = found & is_positive(passing_terms, [a, b, d, tip], [cosine(turn), sine(turn)], True)
    return found


def is_above_zero(room: WholeSum, columns: CandidateColumns) -> Bools:
    """Return whether the clearance of a planet is positive for each candidate."""
    return np.asarray(room.of(columns) > 0)


@dataclass(frozen=True, slots=True)
class PlanetClearance:
    """Required clearance between planets with an addendum of 1 module: number of planets, and minimum clearance
    [modules].
    """

    number: int
    clearance: Fraction

    def conditions(self, found: PlanetSet, fitting: TrainAssembly) -> Iterator[Condition]:
        """Yield the clearance conditions of one set of planets: of neighbouring equal wheels, then of planets that
        mesh.

        Wheels are assumed to be concentric with the axes of their planets. In a set of two planets, if one meshes
        only with external central wheels and the other only with rings, all of these wheels are assumed to lie in
        one plane.
        """
        assert found.planets is not None
        _check(found)
        for planet in found.planets.walk():
            yield from self._neighbour_conditions(planet)
            for mesh, other in planet.outward:
                yield from self._passing_conditions(mesh, planet, other)

    def _neighbour_conditions(self, planet: Planet) -> Iterator[Condition]:
        for mesh in _wheel_meshes(planet):
            wheel, part, reach = planet.own(mesh), mesh.parts[planet.side(mesh)], _reach(planet, planet.own(mesh))
            if reach is None:
                continue
            assert mesh.module is not None
            tips = LinearSum.of([(1, part)]).plus(2 + self.clearance).times(mesh.module)
            name = f"neighbours: tip clearance of {self.number} planets '{wheel}' above {_shown(self.clearance)}"
            yield from _condition(name, are_apart, self.number, *whole(reach, tips))

    def _passing_conditions(self, mesh: AssemblyMesh, planet: Planet, other: Planet) -> Iterator[Condition]:
        A, B = _reach(planet), _reach(other)
        if A is None or B is None or mesh.ring is not None:
            return
        assert mesh.module is not None
        tips = teeth_of(mesh).plus(4 + 2 * self.clearance).times(mesh.module)
        pair = f"'{planet.own(mesh)}' and '{other.own(mesh)}'"
        name = f"neighbours: {pair} of {self.number} planets mesh, with tip clearance above {_shown(self.clearance)}"
        yield from _condition(name, can_pass, self.number, *whole(A, B, distance_of(mesh), tips))
        for inner, outer in ((planet, other), (other, planet)):
            if _is_plain(inner, True) and _is_plain(outer, False):
                yield from self._gap_conditions(inner, outer)

    def _gap_conditions(self, inner: Planet, outer: Planet) -> Iterator[Condition]:
        """Yield the conditions on the clearance of the outer planet from the central wheels of the inner planet, and of
        the inner planet from the rings of the outer planet.
        """
        for planet, other in ((outer, inner), (inner, outer)):
            for mesh in other.central:
                name = f"neighbours: '{planet.wheels[0]}' clears '{other.mate(mesh)}'"
                yield from _condition(name, is_above_zero, *whole(self._gap(planet, other, mesh)))

    def _gap(self, planet: Planet, other: Planet, mesh: AssemblyMesh) -> LinearSum:
        """Return twice the clearance of a planet from the central wheel of another planet, minus twice the required
        clearance.
        """
        reach, own = _reach(planet), planet.central[0]
        assert reach is not None
        assert mesh.module is not None
        sign = 1 if mesh.ring is None else -1
        tips = LinearSum.of([(sign, mesh.parts[1 - other.side(mesh)]), (1, own.parts[planet.side(own)])])
        tips = tips.plus(2 * (2 + self.clearance)).times(mesh.module)
        # a ring encloses the planet, so the signs of the reach and of its radius are opposite
        return reach.times(sign) - tips


def _is_plain(planet: Planet, external: bool) -> bool:
    """Return whether a planet is one wheel at the end of its set and meshes only with external central wheels (or
    rings).
    """
    alone = len(planet.wheels) == 1 and len(planet.outward) + (planet.inward is not None) == 1
    return alone and bool(planet.central) and all((mesh.ring is None) == external for mesh in planet.central)


def _reach(planet: Planet, wheel: str = "") -> LinearSum | None:
    """Return twice the distance of a planet's axis from the central axis; None if the planet meshes with no
    central wheel.

    The distance is that of a mesh of `wheel` with a central wheel, if any; external meshes are preferred to
    internal meshes.
    """
    meshes = sorted(planet.central, key=lambda mesh: (planet.own(mesh) != wheel, mesh.ring is not None))
    return distance_of(meshes[0]) if meshes else None


def _wheel_meshes(planet: Planet) -> list[AssemblyMesh]:
    inward = [planet.inward] if planet.inward else []
    meshes = [*inward, *planet.central, *(mesh for mesh, _ in planet.outward)]
    return list({planet.own(mesh): mesh for mesh in meshes}.values())


def _meshes(found: PlanetSet) -> list[AssemblyMesh]:
    assert found.planets is not None
    return [mesh for planet in found.planets.walk() for mesh in _wheel_meshes(planet)]


def _condition(name: str, test: Callable[..., Bools], *arguments: int | WholeSum) -> Iterator[Condition]:
    sums = [one for one in arguments if not isinstance(one, int)]
    wheels = tuple(dict.fromkeys(wheel for one in sums for wheel in one.wheels))
    if wheels:
        yield Condition(name, wheels, partial(test, *arguments))


def _shown(number: Fraction) -> str:
    return f"{float(number):g} modules" if number != 1 else "1 module"


def _check(found: PlanetSet) -> None:
    """Raise `QuestionError` if the clearance of a set of planets cannot be computed."""
    meshes = _meshes(found)
    if not all(mesh.spur for mesh in meshes):
        why, fix = "the tips of bevel wheels are not on circles about parallel axes", "omit the clearance"
    elif any(mesh.module is None for mesh in meshes):
        why, fix = "two meshing wheels have different modules", "declare the same module for both wheels"
    elif len({mesh.measure for mesh in meshes}) > 1:
        why, fix = "only some of the wheels have a declared module", "declare the module of all of them, or of none"
    else:
        return
    raise QuestionError(Problem(f"the clearance between planets {found.title} cannot be computed", why, fix))
