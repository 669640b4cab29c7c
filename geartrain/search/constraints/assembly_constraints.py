"""Constraints on the tooth counts of a declared train: assembly, equal planets, limits of wheels.

`find_constraints` derives them from a train and `ConstraintOptions`. There are two kinds: a `CountEquation` can be
solved for the count of a wheel; a `Condition` can only be tested. Both are evaluated for many candidates at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.buildability.equal_planets import AssemblyMesh, PlanetSet, TrainAssembly, corresponding
from geartrain.numerics.graphs import joined_groups
from geartrain.search.constraints.constraint_options import ConstraintOptions
from geartrain.search.constraints.count_conditions import (
    Condition,
    CountConstraint,
    CountEquation,
    LinearSum,
    are_coprime,
    are_owned,
    distance_of,
    equality,
    free_of,
    is_bounded,
    is_different,
    is_near_zero,
    plainest,
    whole,
)
from geartrain.search.constraints.planet_constraints import PlanetClearance, equal_planets, reason
from geartrain.search.tooth_count_ranges import MOST_TEETH
from geartrain.train.mechanism import OwnedWheels, Teeth

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.search.tooth_count_ranges import Counts
    from geartrain.train import Train


def find_constraints(
    train: Train, free: Mapping[str, Counts], requested: ConstraintOptions
) -> tuple[CountConstraint, ...]:
    """Return the constraints on the wheels of a train whose tooth counts are varied, in ascending order of cost.

    free   admissible counts by varied wheel; all other wheels have their declared counts

    The order is: bounds of single wheels; equations; conditions on pairs, then on sets of planets. Constraints that
    involve no varied wheel are omitted, because the search cannot change them. `QuestionError` is raised if a requested
    constraint cannot be evaluated for this train or cannot be satisfied by any counts.
    """
    from geartrain.kinematics.formulas.output_formulas import with_counts

    stand_in = with_counts(train, {wheel: counts[0] for wheel, counts in free.items()})
    return tuple(_ConstraintBuilder(train, TrainAssembly.of(stand_in, free), requested).rules()) if free else ()


@dataclass(frozen=True)
class _ConstraintBuilder:
    """Builder of the constraints of one train. In the train `fitting`, the varied wheels have placeholder counts."""

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
        """Yield a condition for each collection of owned wheels: no tooth count is used more often than it is owned."""
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
            if requested.minimum is not None:
                yield _bounds(f"'{name}' has at least {requested.minimum} teeth", name, minimum=requested.minimum)
            if requested.maximum_teeth is not None:
                what = f"'{name}' has at most {requested.maximum_teeth} teeth"
                yield _bounds(what, name, most=requested.maximum_teeth)
            if requested.largest_radius is not None:
                plain = "" if requested.largest_radius.unit else " modules"
                what = f"'{name}' has a radius of at most {requested.largest_radius}{plain}"
                yield _bounds(what, name, most=self._most(name, requested.largest_radius))

    def _most(self, wheel: str, radius: Quantity) -> int:
        """Return the maximum tooth count z for which the pitch radius m z/2 does not exceed `radius`."""
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
        """Yield the equality of the centre distances of all meshes between the same axes whose modules have the same
        unit.
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
                raise QuestionError(_unequal_distances(before, mesh))
            return
        found = plainest(total)
        if not shift:
            yield CountEquation(f"coaxial closure: {equality(found)}", dict(found.terms), found.constant)
            return
        scaled, room = whole(total, LinearSum({}, Fraction(shift)))
        words = f"coaxial closure within {self.requested.shift} half modules: {equality(found)}"
        yield Condition(words, scaled.wheels, partial(is_near_zero, scaled, room.constant))

    def _is_broken(self, total: LinearSum, shift: Fraction | int) -> bool:
        """Return whether the declared counts violate an equality of centre distances that was not requested explicitly.

        The wheels then have different modules or shifted profiles, so the constraint is not applied.
        """
        counts = {wheel: self._declared_count(wheel) for wheel in total.terms}
        known = [weight * (counts[wheel] or 0) for wheel, weight in total.terms.items()]
        return (
            self.requested.coaxial is None and None not in counts.values() and abs(sum(known) + total.constant) > shift
        )

    def _declared_count(self, wheel: str) -> int | None:
        """Return the declared tooth count; None for a count to be searched for, whose declared value is only a
        placeholder.
        """
        teeth = self.declared.wheels[wheel][1].teeth
        if isinstance(teeth, int):
            return teeth
        return None if teeth.search else teeth.value

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
        """Yield the conditions that the count of a varied wheel differs from all fixed counts, then from the count of
        each other varied wheel.
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
        """Yield each set of planets with its number of equal planets, as requested or as declared by `copies`. Sets
        without such a number are omitted.
        """
        requested = self.requested.planets
        if requested is None:
            for one in self.fitting.sets:
                copies = max(self.declared.links[link].copies for link in one.links)
                if copies > 1 and one.planets is not None:
                    yield one, copies
            return
        known = dict.fromkeys(one.carrier for one in self.fitting.sets)
        unknown = [carrier for carrier in requested if carrier not in known] if isinstance(requested, Mapping) else []
        if unknown or not known:
            raise QuestionError(_no_planets(unknown, list(known)))
        for one in self.fitting.sets:
            number = requested.get(one.carrier) if isinstance(requested, Mapping) else requested
            if number is None:
                continue
            if number < 1 or self._declared_sets(one) not in (1, number) or one.planets is None:
                raise QuestionError(_wrong_planet_number(one, number, self._declared_sets(one)))
            yield one, number

    def _declared_sets(self, one: PlanetSet) -> int:
        """Return the number of equal planet sets that are declared, by `copies` or individually."""
        return max(len(one.copies) + 1, *(self.declared.links[link].copies for link in one.links))

    def _equal(self) -> Iterator[CountConstraint]:
        """Yield the equations of the tooth counts of equal planets that are declared individually."""
        for one, _ in self._planet_sets():
            for first, other in self._copied(one):
                found = plainest(LinearSum.of([(1, self.fitting.part(first)), (-1, self.fitting.part(other))]))
                if found.terms:
                    yield CountEquation(f"equal planets: {equality(found)}", dict(found.terms), found.constant)

    def _planets(self) -> Iterator[CountConstraint]:
        numbered = list(self._planet_sets())
        for one, number in numbered:
            rule = equal_planets(one, number, reason(one, number))
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
            room = PlanetClearance(number, self.requested.clearance)
            yield from room.conditions(one, self.fitting)


def _bounds(name: str, wheel: str, minimum: int = 0, most: int = MOST_TEETH) -> Condition:
    return Condition(name, (wheel,), partial(is_bounded, wheel, minimum, most))


def _unequal_distances(before: AssemblyMesh, mesh: AssemblyMesh) -> Problem:
    return Problem(
        f"'{before.name}' and '{mesh.name}' cannot have equal centre distances",
        "they connect the same two axes, and the counts of varied wheels cancel",
        "correct a fixed count, allow a `shift`, or do not require `coaxial`",
    )


def _no_planets(unknown: list[str], known: list[str]) -> Problem:
    what = f"'{unknown[0]}' carries no planets" if unknown else "no link carries planets"
    return Problem(
        what,
        "the axes of planets must be on a link other than the frame",
        f"give a number for one of these carriers: {', '.join(known)}" if known else "omit the number of planets",
    )


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
