"""Every train that explains the dials: exact cover by recursion over parts of trains, each found once.

A part hangs from a driving wheel of known pitch rate p (speed times teeth), holds exactly some surviving arbors S, shows
exactly some dials D and has k added wheels. What explains it depends on (p, S, D, k) alone, so it is found once,
wherever it hangs. With one dial no arbor branches, the order of arbors does not matter to the speed, and counts of
teeth are counted by their products (`count_products`) and listed only when asked for.

Complete: in a tree that keeps the rules (every leaf shows a dial, every dial is shown once) the wheels of an arbor and
the children of a wheel share out its arbors, dials and added wheels, and are told apart by the dials that they lead to;
the recursion takes every such sharing once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, permutations, product
from math import factorial, prod

from geartrain.synthesis.reconstruction.arbor_ways import ArborWay, PathWheel, Stretch, ways_through, ways_to_end
from geartrain.synthesis.reconstruction.count_products import Counts, count_choices, list_choices
from geartrain.synthesis.reconstruction.reconstruction_problem import (
    NEW,
    Arbor,
    Dial,
    PlacedWheel,
    ReconstructionProblem,
    SurvivingArbor,
)

Names = frozenset[str]


@dataclass(frozen=True)
class Part:
    """Alternatives for a part of a train, and how many trains they are."""

    alternatives: tuple[Alternative, ...]

    @cached_property
    def count(self) -> int:
        """Number of trains."""
        return sum(each.count for each in self.alternatives)

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        """The trains themselves: each the arbors that hang from one wheel."""
        for each in self.alternatives:
            yield from each.trees()


class Alternative:
    """One of the alternatives of a part."""

    @property
    def count(self) -> int:
        """Number of trains."""
        raise NotImplementedError

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        """The trains."""
        raise NotImplementedError


@dataclass(frozen=True)
class Siblings(Alternative):
    """Two parts that hang from the same wheel."""

    first: Part
    rest: Part

    @cached_property
    def count(self) -> int:
        return self.first.count * self.rest.count

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        for first, rest in product(self.first.trees(), list(self.rest.trees())):
            yield first + rest


@dataclass(frozen=True)
class Branching(Alternative):
    """An arbor with all that it drives: a part for each driving wheel, whose count may be told by the part itself."""

    name: str | None
    driven: PlacedWheel | None
    dials: tuple[str, ...]
    drives: tuple[tuple[PlacedWheel | None, Part], ...]

    @cached_property
    def count(self) -> int:
        return prod(part.count for _, part in self.drives)

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        for parts in product(*(list(part.trees()) for _, part in self.drives)):
            drives = []
            for (wheel, _), part in zip(self.drives, parts, strict=True):
                if wheel is None:  # a path from the arbor itself: its first wheel comes with it
                    (carrier,) = part
                    drives.extend(carrier.drives)
                else:
                    drives.append((wheel, _sorted_arbors(part)))
            yield (Arbor(self.name, self.driven, self.dials, tuple(sorted(drives, key=repr))),)


@dataclass(frozen=True)
class Path(Alternative):
    """Arbors on the way to one dial, in all orders and with all counts that give its speed.

    first   an added wheel that drives the first of them, if the path begins at an arbor rather than at a wheel
    ratio   what the counts that are open must give: drivers over driven wheels
    """

    stretch: Stretch
    first: PathWheel | None
    dials: tuple[str, ...]
    ratio: Fraction
    added: PathWheel

    @cached_property
    def _open(self) -> tuple[tuple[PathWheel, ...], tuple[PathWheel, ...]]:
        drivers, driven = self.stretch.open_wheels
        pair = (self.added,) * self.stretch.compounds
        head = () if self.first is None else (self.first,)
        return (*head, *drivers, *pair), (*driven, *pair)

    @cached_property
    def choices(self) -> int:
        """Number of choices of counts."""
        return count_choices(self.ratio, *map(_sorted_counts, self._open))

    @cached_property
    def count(self) -> int:
        orders = factorial(len(self.stretch.ways) + self.stretch.compounds) // factorial(self.stretch.compounds)
        return orders * self.choices

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        drivers, driven = self._open
        for counts in list_choices(self.ratio, *(tuple(each.counts for each in some) for some in self._open)):
            yield from self._ordered(list(counts[: len(drivers)]), list(counts[len(drivers) :]))

    def _ordered(self, drivers: list[int], driven: list[int]) -> Iterator[tuple[Arbor, ...]]:
        head = PlacedWheel(None, drivers.pop(0)) if self.first is not None else None
        ways = [_placed(way, drivers, driven) for way in (*self.stretch.ways, self.stretch.end)]
        end = ways.pop()
        compounds = [
            (None, PlacedWheel(None, x), PlacedWheel(None, y)) for x, y in zip(driven, drivers, strict=True)
        ]
        slots = len(ways) + len(compounds)
        for places in combinations(range(slots), len(compounds)):
            for order in permutations(ways):
                own, others = iter(order), iter(compounds)
                chain = [next(others) if at in places else next(own) for at in range(slots)]
                below = Arbor(end[0], end[1], self.dials, ())
                for name, driven_wheel, driver in reversed(chain):
                    below = Arbor(name, driven_wheel, (), ((driver, (below,)),))
                yield (below,) if head is None else (Arbor(None, None, (), ((head, (below,)),)),)


def _placed(way: ArborWay, drivers: list[int], driven: list[int]) -> tuple:
    """The wheels of a way with their counts, taken from the open ones in turn."""

    def count(wheel: PathWheel, taken: list[int]) -> PlacedWheel:
        return PlacedWheel(wheel.name, wheel.counts[0] if len(wheel.counts) == 1 else taken.pop(0))

    return way.arbor, count(way.driven, driven), None if way.driver is None else count(way.driver, drivers)


def _sorted_counts(wheels: tuple[PathWheel, ...]) -> tuple[Counts, ...]:
    return tuple(sorted(each.counts for each in wheels))


def _sorted_arbors(arbors: tuple[Arbor, ...]) -> tuple[Arbor, ...]:
    return tuple(sorted(arbors, key=repr))


_NOTHING = Part(())


@dataclass(frozen=True)
class _Unit(Alternative):
    """Nothing hangs there."""

    @property
    def count(self) -> int:
        return 1

    def trees(self) -> Iterator[tuple[Arbor, ...]]:
        yield ()


_UNIT = Part((_Unit(),))


class ExplanationSearch:
    """The recursion, with what it has found."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.problem = problem
        limits = problem.additions
        self.added = PathWheel(None, tuple(range(limits.least, limits.greatest + 1)))
        self.beside = self.added if limits.on == "any" else None
        self.arbors = {each.name: each for each in problem.arbors}
        self.dials = {each.name: each for each in problem.dials}
        self._hanging: dict[tuple, Part] = {}
        self._paths: dict[tuple, Part] = {}
        self._stretches: dict[tuple, tuple[Stretch, ...]] = {}
        self._reach: dict[tuple, bool] = {}
        self._quotients: dict[str, dict[Fraction, list[Names]]] = {}

    def explain(self, added: int) -> Part:
        """All trains with just so many added wheels."""
        root = self.problem.input
        alternatives = []
        for counts in product(*([count for count, _ in wheel.counts] for wheel in root.wheels)):
            wheels = tuple(PlacedWheel(wheel.name, count) for wheel, count in zip(root.wheels, counts, strict=True))
            every = frozenset(self.arbors), frozenset(self.dials)
            alternatives += self._arbor(root.name, None, self.problem.input_speed, wheels, *every, added)
        return Part(tuple(alternatives))

    # an arbor

    def _arbor(
        self,
        name: str | None,
        driven: PlacedWheel | None,
        speed: Fraction,
        wheels: tuple[PlacedWheel, ...],
        arbors: Names,
        dials: Names,
        added: int,
    ) -> list[Alternative]:
        """An arbor of known speed with wheels that must drive, and all that hangs from it."""
        found: list[Alternative] = []
        shown = sorted(each for each in dials if self._shows(self.dials[each], name, speed))
        for size in range(len(shown) + 1):
            for here in combinations(shown, size):
                rest = dials - set(here)
                for drives in self._shared_out(name, speed, wheels, arbors, rest, added):
                    if drives or here or driven is None:
                        found.append(Branching(name, driven, here, drives))
        return found

    def _shared_out(
        self,
        name: str | None,
        speed: Fraction,
        wheels: tuple[PlacedWheel, ...],
        arbors: Names,
        dials: Names,
        added: int,
    ) -> Iterator[tuple[tuple[PlacedWheel | None, Part], ...]]:
        """Each way to share arbors, dials and added wheels among driving wheels: surviving ones first, then added."""
        if not wheels and not dials:
            if not arbors and not added:
                yield ()
            return
        if len(wheels) > len(dials):
            return
        if wheels:
            for some, dial_part, k in self._shares(arbors, dials, added, None, last=False):
                if part := self._hang(speed * wheels[0].teeth, some, dial_part, k):
                    rest = self._shared_out(name, speed, wheels[1:], arbors - some, dials - dial_part, added - k)
                    yield from (((wheels[0], part), *others) for others in rest)
            return
        if added and (name is None or self.beside is not None):
            for some, dial_part, k in self._shares(arbors, dials, added - 1, min(dials), last=False):
                for first in self._added_driver(speed, some, dial_part, k):
                    rest = self._shared_out(name, speed, (), arbors - some, dials - dial_part, added - 1 - k)
                    yield from ((first, *others) for others in rest)

    def _added_driver(
        self, speed: Fraction, arbors: Names, dials: Names, added: int
    ) -> Iterator[tuple[PlacedWheel | None, Part]]:
        """An added driving wheel with what hangs from it."""
        if len(dials) == 1:
            if part := self._path(speed, self.added, arbors, min(dials), added):
                yield None, part
            return
        for teeth in self.added.counts:
            if part := self._hang(speed * teeth, arbors, dials, added):
                yield PlacedWheel(None, teeth), part

    @staticmethod
    def _shares(
        arbors: Names, dials: Names, added: int, must: str | None, last: bool
    ) -> Iterator[tuple[Names, Names, int]]:
        """Shares of arbors, dials (some of them, with one that must be there) and added wheels."""
        for some in _subsets(dials):
            if some and (must is None or must in some):
                if some == dials and last:
                    yield arbors, dials, added
                    continue
                for own in _subsets(arbors):
                    for k in range(added + 1):
                        yield own, some, k

    def _shows(self, dial: Dial, name: str | None, speed: Fraction) -> bool:
        if dial.place is not None and dial.place != (NEW if name is None else name):
            return False
        return dial.least <= (speed if dial.signed else abs(speed)) <= dial.greatest

    # a driving wheel

    def _hang(self, pitch: Fraction, arbors: Names, dials: Names, added: int) -> Part | None:
        """All that hangs from a wheel of known pitch rate; None if nothing can."""
        if len(dials) == 1:
            return self._path(pitch, None, arbors, min(dials), added)
        if not all(self._reaches(pitch, arbors, each, added) for each in dials):
            return None
        key = (pitch, arbors, dials, added)
        if key not in self._hanging:
            self._hanging[key] = Part(tuple(self._children(*key)))
        found = self._hanging[key]
        return found if found.count else None

    def _children(self, pitch: Fraction, arbors: Names, dials: Names, added: int) -> Iterator[Alternative]:
        yield from self._child(pitch, arbors, dials, added)
        for some, dial_part, k in self._shares(arbors, dials, added, min(dials), last=False):
            if dial_part == dials:
                continue
            rest = self._hang(pitch, arbors - some, dials - dial_part, added - k)
            if rest is None:
                continue
            one = (
                self._path(pitch, None, some, min(dial_part), k)
                if len(dial_part) == 1
                else self._one_child(pitch, some, dial_part, k)
            )
            if one is not None and one.count:
                yield Siblings(one, rest)

    def _one_child(self, pitch: Fraction, arbors: Names, dials: Names, added: int) -> Part:
        key = (pitch, arbors, dials, added, "one")
        if key not in self._hanging:
            reach = all(self._reaches(pitch, arbors, each, added) for each in dials)
            self._hanging[key] = Part(tuple(self._child(pitch, arbors, dials, added))) if reach else _NOTHING
        return self._hanging[key]

    def _child(self, pitch: Fraction, arbors: Names, dials: Names, added: int) -> Iterator[Alternative]:
        """One child of a wheel, and all that it drives, with two dials or more."""
        for name in sorted(arbors):
            arbor, rest = self.arbors[name], arbors - {name}
            for wheels in _choices(arbor):
                for driven in wheels:
                    others = tuple(each for each in wheels if each != driven)
                    yield from self._if_reached(name, driven, -pitch / driven.teeth, others, rest, dials, added)
                if added and self.beside is not None:
                    for teeth in self.added.counts:
                        driven = PlacedWheel(None, teeth)
                        yield from self._if_reached(name, driven, -pitch / teeth, wheels, rest, dials, added - 1)
        if added:
            yield from self._new_child(pitch, arbors, dials, added)

    def _if_reached(
        self,
        name: str,
        driven: PlacedWheel,
        speed: Fraction,
        wheels: tuple[PlacedWheel, ...],
        arbors: Names,
        dials: Names,
        added: int,
    ) -> list[Alternative]:
        """What hangs from a surviving arbor, looked for only where each dial may be reached from it."""
        if not (added and self.beside is not None):  # then no added wheel can stand on it
            for dial in dials:
                if not self._shows(self.dials[dial], name, speed) and not any(
                    self._reaches(speed * wheel.teeth, arbors, dial, added) for wheel in wheels
                ):
                    return []
        return self._arbor(name, driven, speed, wheels, arbors, dials, added)

    def _new_child(self, pitch: Fraction, arbors: Names, dials: Names, added: int) -> Iterator[Alternative]:
        """An added arbor that a wheel drives: one that shows a dial, one with one driving wheel, or with several."""
        told = set()
        for dial in map(self.dials.__getitem__, dials):
            for speed in (dial.least, -dial.least)[: 1 if dial.signed else 2]:
                teeth = -pitch / speed
                if teeth.denominator == 1 and self.added.counts[0] <= teeth <= self.added.counts[-1]:
                    told.add(int(teeth))
        for teeth in sorted(told):
            driven = PlacedWheel(None, teeth)
            for each in self._arbor(None, driven, -pitch / teeth, (), arbors, dials, added - 1):
                if isinstance(each, Branching) and each.dials:
                    yield each
        if added > 1:
            yield from self._compounds(pitch, arbors, dials, added - 2)
        if added > 2:
            for teeth in self.added.counts:
                driven = PlacedWheel(None, teeth)
                for drives in self._shared_out(None, -pitch / teeth, (), arbors, dials, added - 1):
                    if len(drives) > 1:
                        yield Branching(None, driven, (), drives)

    def _compounds(self, pitch: Fraction, arbors: Names, dials: Names, left: int) -> Iterator[Alternative]:
        """An added arbor of two added wheels, with so many added wheels left behind it."""
        known = self._added_quotients
        for ratio in sorted(self._wanted_quotients(pitch, arbors, dials)) if not left else known:
            part = self._hang(-pitch * ratio, arbors, dials, left) if ratio in known else None
            for driver, driven in known[ratio] if part else ():
                wheel = PlacedWheel(None, driver)
                yield Branching(None, PlacedWheel(None, driven), (), ((wheel, part),))

    @cached_property
    def _added_quotients(self) -> dict[Fraction, list[tuple[int, int]]]:
        found: dict[Fraction, list[tuple[int, int]]] = {}
        for driver, driven in product(self.added.counts, repeat=2):
            found.setdefault(Fraction(driver, driven), []).append((driver, driven))
        return found

    def _wanted_quotients(self, pitch: Fraction, arbors: Names, dials: Names) -> set[Fraction]:
        """Quotients after which one of the dials can be reached with no more added wheels."""
        if not self._sure:
            return set(self._added_quotients)
        ratio = abs(self.dials[min(dials)].least / pitch)
        known = self._quotients_to(min(dials))
        return {ratio / each for each, needs in known.items() if any(some <= arbors for some in needs)}

    # a path to one dial

    def _path(
        self, start: Fraction, first: PathWheel | None, arbors: Names, dial: str, added: int
    ) -> Part | None:
        """Paths from a wheel of known pitch rate, or by a first wheel of open count from an arbor of known speed."""
        key = (start, first, arbors, dial, added)
        if key not in self._paths:
            self._paths[key] = Part(tuple(self._found_paths(*key)))
        found = self._paths[key]
        return found if found.count else None

    def _found_paths(
        self, start: Fraction, first: PathWheel | None, arbors: Names, dial: str, added: int
    ) -> Iterator[Alternative]:
        wanted = self.dials[dial]
        if wanted.least != wanted.greatest:
            raise NotImplementedError("dials with a tolerance")
        for stretch in self._stretches_of(arbors, dial, added):
            sign = -1 if stretch.meshes % 2 else 1
            if wanted.signed and (wanted.least < 0) != (start * sign < 0):
                continue
            ratio = abs(wanted.least / start) / stretch.sure_ratio
            path = Path(stretch, first, (dial,), ratio, self.added)
            if path.choices:
                yield path

    def _stretches_of(self, arbors: Names, dial: str, added: int) -> tuple[Stretch, ...]:
        key = (arbors, dial, added)
        if key not in self._stretches:
            self._stretches[key] = tuple(self._made_stretches(*key))
        return self._stretches[key]

    def _made_stretches(self, arbors: Names, dial: str, added: int) -> Iterator[Stretch]:
        place = self.dials[dial].place
        for end, left in self._ends(arbors, place):
            rest = sorted(arbors - {end.arbor})
            for ways in product(*(tuple(ways_through(self.arbors[name], self.beside)) for name in rest)):
                free = added - sum(way.added for way in ways) - end.added
                if free >= 0 and free % 2 == 0:
                    yield Stretch(ways, free // 2, end)

    def _ends(self, arbors: Names, place: str | None) -> Iterator[tuple[ArborWay, None]]:
        if place in (None, NEW):
            yield ArborWay(None, self.added, None), None
        for name in sorted(arbors):
            if place in (None, name):
                for way in ways_to_end(self.arbors[name], self.beside):
                    yield way, None

    # what cannot be reached is not tried

    def _reaches(self, pitch: Fraction, arbors: Names, dial: str, added: int) -> bool:
        """Whether a path to a dial may be made of some of the arbors and added wheels: a bound, never wrongly False."""
        if added > 1 or not self._sure:
            return True
        key = (pitch, arbors, dial, added)
        if key not in self._reach:
            self._reach[key] = self._may_reach(*key)
        return self._reach[key]

    @cached_property
    def _sure(self) -> bool:
        return all(wheel.is_sure for arbor in self.problem.arbors for wheel in arbor.wheels)

    def _may_reach(self, pitch: Fraction, arbors: Names, dial: str, added: int) -> bool:
        ratio = abs(self.dials[dial].least / pitch)
        known = self._quotients_to(dial)
        wanted = [ratio]
        if added:
            wanted += [each for count in self.added.counts for each in (ratio * count, ratio / count)]
        return any(needed <= arbors for each in wanted for needed in known.get(each, ()))

    def _quotients_to(self, dial: str) -> dict[Fraction, list[Names]]:
        """Quotients of the sure counts along paths through some arbors, whichever wheels drive and are driven."""
        if dial not in self._quotients:
            found: dict[Fraction, list[Names]] = {}
            place = self.dials[dial].place
            for some in _subsets(frozenset(self.arbors)):
                for ends in [None, *sorted(some)]:
                    if place is not None and ends != (None if place == NEW else place):
                        continue
                    for ratio in self._some_quotients(some - {ends}, ends):
                        found.setdefault(ratio, []).append(some)
            self._quotients[dial] = found
        return self._quotients[dial]

    def _some_quotients(self, through: frozenset, end: str | None) -> Iterator[Fraction]:
        factors = []
        for name in sorted(through):
            counts = [wheel.counts[0][0] for wheel in self.arbors[name].wheels]
            pairs = {Fraction(a, b) for a, b in permutations(counts, 2)}
            pairs |= {ratio for count in counts for ratio in (Fraction(count), Fraction(1, count))}
            factors.append(sorted(pairs | {Fraction(1)}))
        if end is not None:
            counts = [wheel.counts[0][0] for wheel in self.arbors[end].wheels]
            factors.append([Fraction(1), *(Fraction(1, count) for count in counts)])
        for choice in product(*factors):
            yield prod(choice, start=Fraction(1))


def _choices(arbor: SurvivingArbor) -> Iterator[tuple[PlacedWheel, ...]]:
    """A surviving arbor with each choice of counts."""
    for counts in product(*([count for count, _ in wheel.counts] for wheel in arbor.wheels)):
        yield tuple(PlacedWheel(wheel.name, count) for wheel, count in zip(arbor.wheels, counts, strict=True))


def _subsets(names: Names) -> Iterator[Names]:
    each = sorted(names)
    for size in range(len(each) + 1):
        yield from map(frozenset, combinations(each, size))
