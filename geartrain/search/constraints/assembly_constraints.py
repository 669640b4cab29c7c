"""Constraints on the tooth counts of a declared train: assembly, equal planets, limits of wheels.

`find_constraints` derives the constraints from a train and `ConstraintOptions`. A `CountEquation` can be solved for the
tooth count of a wheel; a `Condition` can only be tested. Both are evaluated for many candidates at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.buildability.equal_planets import (
    AssemblyMesh,
    PhaseArithmetic,
    Planet,
    PlanetSet,
    TrainAssembly,
    corresponding,
    mesh_counts,
    neighbour_terms,
    passing_terms,
    phase_numbers,
)
from geartrain.numerics.graphs import joined_groups
from geartrain.search.constraints.constraint_options import ConstraintOptions
from geartrain.search.constraints.count_conditions import (
    Condition,
    CountConstraint,
    CountEquation,
    LinearSum,
    WholeSum,
    are_coprime,
    are_owned,
    cosine,
    counts_of,
    distance_of,
    equality,
    free_of,
    is_between,
    is_different,
    is_positive,
    primitive_sum,
    sine,
    whole,
)
from geartrain.train.mechanism import OwnedWheels, Teeth

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Ints
    from geartrain.numerics.quantity import Quantity
    from geartrain.search.constraints.count_conditions import CandidateColumns
    from geartrain.search.tooth_count_ranges import Counts
    from geartrain.train import Train


def find_constraints(
    train: Train, free: Mapping[str, Counts], requested: ConstraintOptions
) -> tuple[CountConstraint, ...]:
    """Return the constraints on the wheels of a train whose tooth counts are varied, in ascending order of cost.

    free   admissible tooth counts of each varied wheel; all other wheels have their declared tooth counts

    Conditions on single wheels come first, then equations, conditions on pairs, and conditions on sets of planets.
    Constraints that involve no varied wheel are omitted, because the search cannot change them. `QuestionError` is
    raised if a requested constraint cannot be evaluated for this train or cannot be satisfied by any tooth counts.
    """
    from geartrain.kinematics.formulas.output_formulas import with_counts

    stand_in = with_counts(train, {wheel: counts[0] for wheel, counts in free.items()})
    return tuple(_ConstraintBuilder(train, TrainAssembly.of(stand_in, free), requested).rules()) if free else ()


@dataclass(frozen=True)
class _ConstraintBuilder:
    """Builder of all constraints of one train.

    declared    train as declared
    fitting     the same train, in which every varied wheel has the first of its admissible tooth counts
    requested   options that select the constraints
    """

    declared: Train
    fitting: TrainAssembly
    requested: ConstraintOptions

    def rules(self) -> Iterator[CountConstraint]:
        yield from self._limits()
        linear = [*self._coaxial(), *self._equal()]
        yield from sorted(linear, key=lambda rule: not isinstance(rule, CountEquation))
        yield from self._pairs()
        yield from self._planets()
        yield from self._owned()

    def _owned(self) -> Iterator[CountConstraint]:
        """Yield, for each collection of wheels that the user owns, the condition that no tooth count is used for more
        wheels than the collection contains.
        """
        wheels: dict[tuple[tuple[int, int], ...], dict[str, int]] = {}
        for name, (link, wheel) in self.declared.wheels.items():
            search = wheel.teeth.search if isinstance(wheel.teeth, Teeth) else None
            if name in self.fitting.free and isinstance(search, OwnedWheels) and search.numbers:
                # every copy of a planet has its own wheel
                wheels.setdefault(search.numbers, {})[name] = self.declared.links[link].copies or 1
        for numbers, used in wheels.items():
            words = "the number of owned wheels: " + ", ".join(f"{number} of {count}" for count, number in numbers)
            yield Condition(words, tuple(used), partial(are_owned, numbers, used))

    # ------------------------------------------------------------------------------------------------------- one wheel

    def _limits(self) -> Iterator[CountConstraint]:
        requested = self.requested
        for name, (_, wheel) in self.fitting.train.wheels.items():
            # the count of a worm is its number of starts, which does not determine its size
            if name not in self.fitting.free or wheel.kind == "worm":
                continue
            bounds: list[tuple[str, float, float]] = []
            if requested.minimum is not None:
                bounds.append((f"at least {requested.minimum} teeth", requested.minimum, inf))
            if requested.maximum_teeth is not None:
                bounds.append((f"at most {requested.maximum_teeth} teeth", 0, requested.maximum_teeth))
            if requested.largest_radius is not None:
                radius = f"{requested.largest_radius}{'' if requested.largest_radius.unit else ' modules'}"
                bounds.append((f"a radius of at most {radius}", 0, self._most(name, requested.largest_radius)))
            for words, minimum, most in bounds:
                count = WholeSum(((name, 1),), 0)
                yield from _condition(f"'{name}' has {words}", is_between, count, minimum, most)

    def _most(self, wheel: str, radius: Quantity) -> int:
        """Return the maximum tooth count of a wheel for which its pitch radius does not exceed `radius`."""
        # measure: m for lengths, plain for numbers, empty if not declared
        measure, module = self.fitting.module(wheel)
        if (measure == "m") != (radius.unit is not None) or module is None:
            declared = "a length" if measure == "m" else "a number without a unit" if measure else "not declared"
            raise QuestionError(
                Problem(
                    f"the pitch radius of '{wheel}' cannot be compared with {radius}",
                    f"the module of the wheel is {declared}"
                    if module
                    else "several modules are declared for the wheel",
                    "give the maximum radius and all modules with units, or declare no modules and give the radius as "
                    "a number of modules",
                )
            )
        # pitch radius r = m z / 2
        return int(2 * radius.base / module)

    # --------------------------------------------------------------------------------------------------------- coaxial

    def _coaxial(self) -> Iterator[CountConstraint]:
        """Yield the constraints that all gear pairs between the same two parallel axes have equal centre distances.
        Gear pairs are compared only if their modules are all lengths or all numbers without a unit.
        """
        if self.requested.coaxial is False:
            return
        first: dict[object, AssemblyMesh] = {}
        for mesh in self.fitting.meshes:
            if mesh.spur and mesh.module is not None:
                # all meshes of a group are compared with its first one
                before = first.setdefault((mesh.carrier, frozenset(mesh.axes), mesh.measure), mesh)
                yield from self._one_distance(before, mesh)

    def _one_distance(self, before: AssemblyMesh, mesh: AssemblyMesh) -> Iterator[CountConstraint]:
        total = distance_of(before) - distance_of(mesh)
        # half modules in the unit of the distances
        shift = self.requested.shift * min(before.module or 1, mesh.module or 1)
        if not (before.is_free or mesh.is_free) or self._is_broken(total, shift):
            return
        # the varied counts cancel, so the constraint depends on fixed counts only
        if not total.terms:
            if abs(total.constant) > shift:
                raise QuestionError(
                    Problem(
                        f"'{before.name}' and '{mesh.name}' cannot have equal centre distances",
                        "they connect the same two axes, and the varied tooth counts do not affect the difference of "
                        "their centre distances",
                        "correct a fixed count, allow a `shift`, or do not require `coaxial`",
                    )
                )
            return
        found = primitive_sum(total)
        if not shift:
            yield CountEquation(f"coaxial closure: {equality(found)}", dict(found.terms), found.constant)
            return
        scaled, room = whole(total, LinearSum({}, Fraction(shift)))
        words = f"coaxial closure within {self.requested.shift} half modules: {equality(found)}"
        yield from _condition(words, is_between, scaled, -room.constant, room.constant)

    def _is_broken(self, total: LinearSum, shift: Fraction | int) -> bool:
        """Return True if equal centre distances are required only by default, and the declared tooth counts violate
        this requirement: the magnitude of `total`, the difference of two centre distances, exceeds `shift`.
        """
        if self.requested.coaxial is not None:
            return False
        for wheel, weight in total.terms.items():
            teeth = self.declared.wheels[wheel][1].teeth
            # a value besides a `search` is only a placeholder
            count = teeth if isinstance(teeth, int) else None if teeth.search else teeth.value
            if count is None:
                return False
            total = total.plus(weight * count)
        return abs(total.constant) > shift

    # ----------------------------------------------------------------------------------------------------------- pairs

    def _pairs(self) -> Iterator[CountConstraint]:
        requested = self.requested
        if requested.hunting:
            for mesh in self.fitting.meshes:
                if mesh.is_free:
                    words = f"hunting tooth: '{mesh.wheels[0]}' and '{mesh.wheels[1]}' have no common divisor"
                    yield Condition(words, free_of(*mesh.parts), partial(are_coprime, *mesh.parts))
        if requested.different:
            yield from self._different()

    def _different(self) -> Iterator[CountConstraint]:
        """Yield the conditions that no varied wheel has the same tooth count as a fixed wheel, and that no two varied
        wheels have the same tooth count. Copies of one planet are exempt.
        """
        words = "different counts: two wheels have equal counts"
        copied = (pair for one in self.fitting.sets for pair in self._copied(one))
        groups = joined_groups(self.fitting.train.wheels, copied)
        alike = {wheel: at for at, wheels in enumerate(groups) for wheel in wheels}
        free = [wheel for wheel in self.fitting.train.wheels if wheel in self.fitting.free]
        fixed = [wheel for wheel in self.fitting.train.wheels if wheel not in self.fitting.free]
        for wheel in free:
            others = [self.fitting.part(other) for other in fixed if alike[wheel] != alike[other]]
            if others:
                yield Condition(words, (wheel,), partial(is_different, wheel, tuple(dict.fromkeys(others))))
        for first, second in combinations(free, 2):
            # copies of one planet have equal counts by construction
            if alike[first] != alike[second]:
                yield Condition(words, (first, second), partial(is_different, first, (second,)))

    @staticmethod
    def _copied(one: PlanetSet) -> Iterator[tuple[str, str]]:
        for copy in one.copies:
            yield from corresponding(one, copy).items()

    # --------------------------------------------------------------------------------------------------------- planets

    def _planet_sets(self) -> Iterator[tuple[PlanetSet, int]]:
        """Yield pairs (set of planets, number of copies of this set around the central axis). The number is the
        requested number or, by default, the number declared by `copies`. Sets without a requested or declared number
        are omitted.
        """
        requested = self.requested.planets
        if requested is None:
            for one in self.fitting.sets:
                copies = max(self.declared.links[link].copies for link in one.links)
                if copies > 1 and one.planets is not None:
                    yield one, copies
            return
        carriers = list(dict.fromkeys(one.carrier for one in self.fitting.sets))
        numbers = requested if isinstance(requested, Mapping) else dict.fromkeys(carriers, requested)
        unknown = [carrier for carrier in numbers if carrier not in carriers]
        if unknown or not carriers:
            raise QuestionError(
                Problem(
                    f"'{unknown[0]}' carries no planets" if unknown else "no link carries planets",
                    "the axes of planets must be on a link other than the frame",
                    f"give a number for one of these carriers: {', '.join(carriers)}"
                    if carriers
                    else "omit the number of planets",
                )
            )
        for one in self.fitting.sets:
            if one.carrier not in numbers:
                continue
            number = numbers[one.carrier]
            # equal sets are declared by `copies` or individually
            declared = max(len(one.copies) + 1, *(self.declared.links[link].copies for link in one.links))
            if number < 1 or declared not in (1, number) or one.planets is None:
                raise QuestionError(_wrong_planet_number(one, number, declared))
            yield one, number

    def _equal(self) -> Iterator[CountConstraint]:
        """Yield equations that require equal tooth counts of the wheels at the same position in two copies of a planet,
        for copies that are declared as separate planets.
        """
        for one, _ in self._planet_sets():
            for first, other in self._copied(one):
                found = primitive_sum(LinearSum.of([(1, self.fitting.part(first)), (-1, self.fitting.part(other))]))
                if found.terms:
                    yield CountEquation(f"equal planets: {equality(found)}", dict(found.terms), found.constant)

    def _planets(self) -> Iterator[CountConstraint]:
        numbered = list(self._planet_sets())
        for one, number in numbered:
            rule = equal_planets(one, number)
            if rule is not None:
                yield rule
        if self.requested.clearance is None:
            return
        if not numbered:
            raise QuestionError(
                Problem(
                    "the clearance between planets cannot be computed",
                    "the clearance depends on the number of planets on a carrier",
                    "give the number of equal planets, such as planets=3",
                )
            )
        for one, number in numbered:
            yield from clearance_conditions(one, number, self.requested.clearance)


def _wrong_planet_number(one: PlanetSet, number: int, declared: int) -> Problem:
    if one.planets is None:
        why = "planets that mesh with each other in a loop are not supported"
        fix = "give a number for each of the other carriers, such as planets={'arm': 3}"
    elif number < 1:
        why, fix = "a carrier has at least one planet", "give a number of 1 or more"
    else:
        why = f"{declared} equal sets are declared"
        fix = (
            "require the declared number, declare one planet set that represents all, or give a number for each "
            "carrier, such as planets={'arm': 3}"
        )
    what = f"cannot require {number} equal copies of the planet set {one.title} on '{one.carrier}'"
    return Problem(what, why, fix)


# ------------------------------------------------------------------------------ assembly of equal, spaced planets


def can_mesh(number: int, first: Planet, columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether `number` identical planets, equally spaced around the central axis, can mesh
    with the same central wheels. A planet may consist of several links that mesh with each other; `first` is the first
    of them.

    The condition is that `number` divides every integer returned by `phase_numbers`.
    """
    # b is only needed modulo n; reduced, so that products of counts fit int64
    kind = PhaseArithmetic(lambda part: counts_of(columns, part), np.gcd, bezout, lambda one: one % number)
    found = np.asarray(True)
    for each in phase_numbers(first, kind):
        found = found & (each % number == 0)
    return found


def bezout(a: Ints, b: Ints) -> tuple[Ints, Ints, Ints]:
    """Return three arrays g, u and v of the shape to which a and b broadcast, with u a + v b = g = gcd(a, b), by the
    extended Euclidean algorithm. All elements of a and b must be non-negative.
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


def equal_planets(found: PlanetSet, number: int) -> Condition | None:
    """Return the condition on the tooth counts of a set of planets and its central wheels under which `number` copies
    of the set can be assembled with equal spacing around the central axis.

    Return None if none of these wheels is varied, or if the planets mesh with fewer than two central wheels. In the
    latter case any number of copies can be assembled.
    """
    assert found.planets is not None
    planets = list(found.planets.walk())
    central = [mesh_counts(planet, mesh) for planet in planets for mesh in planet.central]
    outward = [mesh_counts(planet, mesh, other) for planet in planets for mesh, other in planet.outward]
    wheels = free_of(*(part for pair in (*central, *outward) for part in pair))
    if len(central) < 2 or not wheels:
        return None
    formula = f"teeth of {found.title} mesh"
    first = found.planets
    if len(first.central) == 2 and not first.outward:
        (own, mate), (own2, mate2) = central
        sign = "+" if first.central[0].sense * first.central[1].sense < 0 else "-"
        formula = f"{number} gcd({own}, {own2}) divides {mate} {own2} {sign} {mate2} {own}"
        if len(first.wheels) == 1:
            formula = f"{number} divides {mate} {sign} {mate2}"
    name = f"{number} equal planets on '{found.carrier}': {formula}"
    return Condition(name, wheels, partial(can_mesh, number, first))


# ------------------------------------- clearance between planets: neighbours, and planets that mesh with each other


def are_apart(number: int, reach: WholeSum, tips: WholeSum, columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether the clearance between the tip circles of neighbouring planets exceeds the
    required clearance, by exact comparison.

    number   number of equally spaced planets
    reach    twice the distance of the axis of a planet from the central axis
    tips     tip diameter of a planet plus the required clearance, in the same unit as `reach`
    """
    chord = sine(Fraction(1, 2 * number))
    return is_positive(neighbour_terms, [reach.of(columns), tips.of(columns)], [chord], True)


def can_pass(number: int, A: WholeSum, B: WholeSum, D: WholeSum, tips: WholeSum, columns: CandidateColumns) -> Bools:
    """Return, for each candidate, whether a planet can mesh with its partner, a planet of a second kind, and has the
    required clearance from the partners of the other `number` - 1 planets of its kind.

    A, B   twice the distances of the axes of a planet and of its partner from the central axis
    D      twice the centre distance of a planet and its partner
    tips   sum of the tip diameters of a planet and its partner plus twice the required clearance

    All lengths have the same unit.
    """
    a, b, d, tip = (one.of(columns) for one in (A, B, D, tips))
    # the triangle of the central axis and the two planets must close
    found = np.asarray((np.abs(a - b) <= d) & (d <= a + b))
    # partners of all other planets, not only of the adjacent ones
    for turn in (Fraction(step, number) for step in range(1, number)):
        found = found & is_positive(passing_terms, [a, b, d, tip], [cosine(turn), sine(turn)], True)
    return found


def clearance_conditions(found: PlanetSet, number: int, clearance: Fraction) -> Iterator[Condition]:
    """Yield the clearance conditions of one set of planets of which `number` copies are required: first of equal wheels
    of neighbouring copies, then of planets that mesh with each other.

    clearance   required minimum clearance between tip circles [modules]; the addendum is assumed to be 1 module

    The clearance from central wheels is tested only in sets of two planets of which one meshes only with suns and the
    other only with rings. Their wheels are assumed to lie in one plane.
    """
    assert found.planets is not None
    _check_clearance(found)
    shown = "1 module" if clearance == 1 else f"{float(clearance):g} modules"
    for planet in found.planets.walk():
        for mesh in _wheel_meshes(planet):
            wheel = planet.own(mesh)
            reach = _reach(planet, wheel)
            if reach is not None:
                assert mesh.module is not None
                tips = LinearSum.of([(1, mesh.parts[planet.side(mesh)])]).plus(2 + clearance).times(mesh.module)
                name = f"neighbours: tip clearance of {number} planets '{wheel}' above {shown}"
                yield from _condition(name, are_apart, number, *whole(reach, tips))
        for mesh, other in planet.outward:
            A, B = _reach(planet), _reach(other)
            if A is None or B is None or mesh.ring is not None:
                continue
            assert mesh.module is not None
            tips = LinearSum.of(mesh.terms).plus(4 + 2 * clearance).times(mesh.module)
            pair = f"'{planet.own(mesh)}' and '{other.own(mesh)}'"
            name = f"neighbours: {pair} of {number} planets mesh, with tip clearance above {shown}"
            yield from _condition(name, can_pass, number, *whole(A, B, distance_of(mesh), tips))
            for inner, outer in ((planet, other), (other, planet)):
                if _is_simple(inner, True) and _is_simple(outer, False):
                    yield from _gap_conditions(outer, inner, clearance)
                    yield from _gap_conditions(inner, outer, clearance)


def _gap_conditions(planet: Planet, other: Planet, clearance: Fraction) -> Iterator[Condition]:
    """Yield, for each central wheel with which the planet `other` meshes, the condition that the planet `planet` of the
    same set has more than the required clearance [modules] from this central wheel.
    """
    reach, own = _reach(planet), planet.central[0]
    assert reach is not None
    for mesh in other.central:
        assert mesh.module is not None
        # a ring encloses the planet, so the signs of the reach and of its radius are opposite
        sign = 1 if mesh.ring is None else -1
        tips = LinearSum.of([(sign, mesh.parts[1 - other.side(mesh)]), (1, own.parts[planet.side(own)])])
        gap = reach.times(sign) - tips.plus(2 * (2 + clearance)).times(mesh.module)
        name = f"neighbours: '{planet.wheels[0]}' clears '{other.mate(mesh)}'"
        yield from _condition(name, is_between, *whole(gap), 1, inf)


def _is_simple(planet: Planet, external: bool) -> bool:
    """Return whether a planet consists of one wheel, meshes with exactly one other planet, and meshes with one or more
    suns but no ring (if `external` is True) or with one or more rings but no sun (if it is False).
    """
    alone = len(planet.wheels) == 1 and len(planet.outward) + (planet.inward is not None) == 1
    return alone and bool(planet.central) and all((mesh.ring is None) == external for mesh in planet.central)


def _reach(planet: Planet, wheel: str = "") -> LinearSum | None:
    """Return twice the distance of the axis of a planet from the central axis, in the unit of its module; None if the
    planet meshes with no central wheel. The distance is computed from a central wheel that meshes with the wheel named
    `wheel`, if there is one, and preferably from a sun.
    """
    meshes = sorted(planet.central, key=lambda mesh: (planet.own(mesh) != wheel, mesh.ring is not None))
    return distance_of(meshes[0]) if meshes else None


def _wheel_meshes(planet: Planet) -> list[AssemblyMesh]:
    inward = [planet.inward] if planet.inward else []
    meshes = [*inward, *planet.central, *(mesh for mesh, _ in planet.outward)]
    return list({planet.own(mesh): mesh for mesh in meshes}.values())


def _condition(name: str, test: Callable[..., Bools], *arguments: float | WholeSum) -> Iterator[Condition]:
    """Yield a condition with the given name. Its test calls the function `test` with `arguments` and, as last argument,
    the tooth counts of the candidates. Nothing is yielded if no sum in `arguments` contains a varied wheel.
    """
    sums = [one for one in arguments if isinstance(one, WholeSum)]
    wheels = tuple(dict.fromkeys(wheel for one in sums for wheel in one.wheels))
    if wheels:
        yield Condition(name, wheels, partial(test, *arguments))


def _check_clearance(found: PlanetSet) -> None:
    """Raise `QuestionError` if the clearance of a set of planets cannot be computed."""
    assert found.planets is not None
    meshes = [mesh for planet in found.planets.walk() for mesh in _wheel_meshes(planet)]
    if not all(mesh.spur for mesh in meshes):
        why, fix = "the tips of bevel wheels are not on circles about parallel axes", "omit the clearance"
    elif any(mesh.module is None for mesh in meshes):
        why, fix = "two meshing wheels have different modules", "declare the same module for both wheels"
    elif len({mesh.measure for mesh in meshes}) > 1:
        why, fix = "only some of the wheels have a declared module", "declare the module of all of them, or of none"
    else:
        return
    raise QuestionError(Problem(f"the clearance between planets {found.title} cannot be computed", why, fix))
