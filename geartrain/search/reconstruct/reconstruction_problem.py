"""Typed question of a reconstruction: surviving arbors with wheels and sizes, dials with speeds, what may be added.

Speeds are turns per unit of the input arbor, exact, positive in one sense. The input arbor turns at `input_speed`.
Lengths are millimetres, exact. Axes are parallel, so a place is where an axis crosses the plan.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import prod
from typing import Literal

from geartrain.errors import DeclarationError, Problem
from geartrain.numerics.exact import plural
from geartrain.numerics.quantity import Quantity
from geartrain.numerics.results import Result, Shown
from geartrain.train import Train

Place = tuple[Fraction, Fraction]
Bounds = tuple[Fraction, Fraction]
Size = tuple[str | None, int]
"""A wheel by its name, None for an added one, and its count of teeth."""

NEW = "new"
"""The place of a dial whose arbor does not survive."""
UNMEASURED_SPREADS = 3
"""A wheel that was not measured has the module of its mate within so many spreads, where impossible is told from
improbable."""
_MOST_DOUBTS = 3


@dataclass(frozen=True)
class MeasuredWheel:
    """A wheel whose module was measured, or its pitch radius."""

    name: str
    is_module: bool
    length: Fraction
    """That length."""


@dataclass(frozen=True)
class PlacedArbor:
    """A surviving arbor whose axis has a known place."""

    name: str
    place: Place


@dataclass(frozen=True)
class SurvivingGeometry:
    """What was measured, and how it is weighed."""

    wheels: tuple[MeasuredWheel, ...] = ()
    arbors: tuple[PlacedArbor, ...] = ()
    module: Fraction = Fraction(43, 1000)
    """Spread of the logarithm of the quotient of two modules in mesh."""
    distance: Fraction = Fraction(3, 100)
    """Spread of the logarithm of the sum of pitch radii over the distance of axes."""
    reach: Fraction | None = None
    """Greatest difference of those two that is possible; None if any is."""
    radius: Fraction | None = None
    """Error of every measured pitch radius; None if it is part of the spread of modules."""

    @cached_property
    def places(self) -> Mapping[str | None, Place]:
        """Places by arbor."""
        return {arbor.name: arbor.place for arbor in self.arbors}

    @cached_property
    def measured(self) -> Mapping[str | None, MeasuredWheel]:
        """What was measured, by wheel."""
        return {wheel.name: wheel for wheel in self.wheels}

    def module_of(self, size: Size) -> Fraction | None:
        """The module of a wheel; None where it was not measured."""
        wheel = self.measured.get(size[0])
        if wheel is None:
            return None
        return wheel.length if wheel.is_module else 2 * wheel.length / size[1]

    def square_distance(self, first: str | None, second: str | None) -> Fraction | None:
        """Of two axes; None where a place is not known."""
        if first not in self.places or second not in self.places:
            return None
        (x, y), (u, v) = self.places[first], self.places[second]
        return (x - u) ** 2 + (y - v) ** 2

    def radii_sum(self, first: Size, second: Size) -> Fraction | None:
        """Sum of the pitch radii of wheels in mesh, which share a module; None where neither was measured."""
        module, other = self.module_of(first), self.module_of(second)
        if module is None and other is None:
            return None
        module, other = (other if module is None else module), (module if other is None else other)
        assert module is not None
        assert other is not None
        return (module * first[1] + other * second[1]) / 2

    def distance_bounds(self, first: Size, second: Size) -> Bounds | None:
        """How far apart axes may be whose wheels mesh; None where that is not bounded."""
        own, mate = self.module_bounds(first, second), self.module_bounds(second, first)
        if own is None or mate is None or self.reach is None:
            return None
        minimum, maximum = ((one * first[1] + other * second[1]) / 2 for one, other in zip(own, mate, strict=True))
        return max(Fraction(0), minimum - self.reach), maximum + self.reach

    def module_bounds(self, size: Size, mate: Size) -> Bounds | None:
        """What the module of a wheel may be beside a mate; None where neither was measured."""
        module = self.module_of(size)
        if module is not None:
            return module, module
        module = self.module_of(mate)
        if module is None:
            return None
        spread = min(Fraction(1), UNMEASURED_SPREADS * self.module)
        return module * (1 - spread), module * (1 + spread)

    def may_mesh(self, arbor: str | None, wheel: Size, other_arbor: str | None, other: Size) -> bool:
        """Whether the distance of two axes allows that their wheels mesh, as far as both are known."""
        square, bounds = self.square_distance(arbor, other_arbor), self.distance_bounds(wheel, other)
        if square is None:
            return True
        if not square:
            return False  # on one axis
        return bounds is None or bounds[0] ** 2 <= square <= bounds[1] ** 2


NO_GEOMETRY = SurvivingGeometry()


@dataclass(frozen=True)
class SurvivingWheel:
    """A surviving wheel: its name and the counts that it may have, each with its prior weight.

    See Also
    --------
    ReconstructionProblem : is made of them.
    """

    name: str
    """Of the wheel."""
    counts: tuple[tuple[int, Fraction], ...]
    """Teeth and weights, ascending, no count twice, weights positive; one pair where the count is sure."""
    internal: bool = False
    """Whether it is a ring: its teeth point inwards."""

    @property
    def is_sure(self) -> bool:
        """Whether there is one count."""
        return len(self.counts) == 1


@dataclass(frozen=True)
class SurvivingArbor(Shown):
    """A surviving arbor: wheels that are fixed together.

    See Also
    --------
    ReconstructionProblem : is made of them.
    """

    name: str
    """Of the arbor."""
    wheels: tuple[SurvivingWheel, ...]
    """Those that are fixed on it."""


@dataclass(frozen=True)
class SearchedDial(Shown):
    """A pointer and the speed that it must have.

    See Also
    --------
    ReconstructionProblem : is made of them.
    """

    name: str
    """Of the pointer."""
    minimum: Fraction
    """Least speed [turns per unit of the input]; equal to `maximum` where it must be exact."""
    maximum: Fraction
    """Greatest speed [turns per unit of the input]."""
    signed: bool = True
    """Whether the sense is known; if not, bounds are those of the magnitude."""
    place: str | None = None
    """The surviving arbor that carries it, "new" where that does not survive, or None where it is not known."""

    @property
    def is_exact(self) -> bool:
        """Whether one speed alone will do."""
        return self.minimum == self.maximum


@dataclass(frozen=True)
class Additions:
    """What may be added.

    See Also
    --------
    ReconstructionProblem : holds them.
    """

    wheels: int
    """The maximum number of added wheels."""
    minimum: int
    """Least tooth count, inclusive."""
    maximum: int
    """Greatest tooth count, inclusive."""
    arbors: int | None = None
    """The maximum number of added arbors; default any number."""
    on: Literal["any", "new"] = "any"
    """"any": also beside surviving wheels, where they drive; "new": only on new arbors."""


@dataclass(frozen=True)
class PriorFactors:
    """By what factor a candidate is less probable for each added wheel, added arbor and unused surviving wheel.

    See Also
    --------
    ReconstructionProblem : holds them.
    """

    wheel: Fraction = Fraction(10)
    """Factor for each added wheel, 1 or more."""
    arbor: Fraction = Fraction(10)
    """Factor for each added arbor, 1 or more."""
    unused: Fraction = Fraction(100)
    """Factor for each surviving wheel that is not used, 1 or more."""


@dataclass(frozen=True)
class ReconstructionProblem(Shown):
    """The typed question of a reconstruction: surviving arbors, dials and the rules.

    See Also
    --------
    evidence_question : makes it from declared evidence.
    find_reconstructions : answers it.
    """

    input: SurvivingArbor
    """The arbor where a train begins."""
    arbors: tuple[SurvivingArbor, ...]
    """The other ones."""
    dials: tuple[SearchedDial, ...]
    """The pointers, each with its speed."""
    additions: Additions
    """What may be added."""
    input_speed: Fraction = Fraction(1)
    """Speed of the input arbor [turns per unit]."""
    meshes: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of wheels that were seen in mesh."""
    apart: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of wheels that do not mesh."""
    coaxial: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of arbors on one axis: no wheel of one meshes with a wheel of the other, added ones included."""
    use: Literal["wheels", "arbors", "some"] = "wheels"
    """"wheels": every surviving wheel meshes; "arbors": every surviving arbor is in the train; "some": neither."""
    idlers: bool = False
    """Whether a driven wheel may drive."""
    factors: PriorFactors = PriorFactors()
    """What the prior is made of."""
    geometry: SurvivingGeometry = NO_GEOMETRY
    """What was measured; pairs that it keeps apart are in `apart` and `coaxial` already."""

    @cached_property
    def rings(self) -> frozenset[str]:
        """Names of surviving rings; added wheels are none."""
        return frozenset(wheel.name for arbor in (self.input, *self.arbors) for wheel in arbor.wheels if wheel.internal)


@dataclass(frozen=True)
class PlacedWheel:
    """A wheel of a candidate.

    See Also
    --------
    Candidate : is made of them.
    """

    name: str | None
    """Of the surviving wheel; None for an added one."""
    teeth: int
    """Its count."""


@dataclass(frozen=True)
class Arbor(Shown):
    """An arbor of a candidate and all that it drives: the canonical form, in which equal mechanisms are equal.

    See Also
    --------
    Candidate : holds the input arbor.
    candidate_train : makes a train of it.
    """

    name: str | None
    """Of the surviving arbor; None for an added one."""
    driven: PlacedWheel | None
    """The wheel that is driven; None for the input arbor."""
    dials: tuple[str, ...]
    """Names of the dials that it shows, sorted."""
    drives: tuple[tuple[PlacedWheel, tuple[Arbor, ...]], ...]
    """Driving wheels with the arbors that each drives, sorted."""
    passes: tuple[Arbor, ...] = ()
    """Where idlers are allowed: arbors that the driven wheel itself drives, sorted."""

    def driven_arbors(self) -> Iterator[tuple[PlacedWheel, Arbor]]:
        """Every arbor that it drives, with the wheel that drives it."""
        for wheel, children in self.drives:
            yield from ((wheel, child) for child in children)
        for child in self.passes:
            assert self.driven is not None
            yield self.driven, child

    def arbors(self) -> Iterator[Arbor]:
        """This one and all below it."""
        yield self
        for _, child in self.driven_arbors():
            yield from child.arbors()

    def wheels(self) -> Iterator[PlacedWheel]:
        """Every wheel of the arbors from here on that meshes, once."""
        for each in self.arbors():
            if each.driven is not None:
                yield each.driven
            yield from (wheel for wheel, _ in each.drives if wheel.name is None or wheel != each.driven)

    def meshes(self) -> Iterator[tuple[Arbor, PlacedWheel, Arbor]]:
        """Every mesh from here on: the arbor that drives, its wheel, and the arbor that is driven."""
        for wheel, child in self.driven_arbors():
            yield self, wheel, child
            yield from child.meshes()

    @property
    def added_wheels(self) -> int:
        """Wheels from here on that are added."""
        return sum(wheel.name is None for wheel in self.wheels())

    @property
    def added_arbors(self) -> int:
        """Arbors from here on that are added."""
        return sum(arbor.name is None for arbor in self.arbors())


# --------------------------------------------------------------------------------------------------- how much is asked


@dataclass(frozen=True, slots=True)
class RequestedQuestion(Result):
    """What is asked."""

    arbors: int
    """Surviving ones, the input included."""
    wheels: int
    """Surviving ones."""
    readings: int
    """Combinations of counts in doubt; 1 where all are sure."""
    dials: int
    """Pointers whose speed is known."""
    added: int
    """The most wheels that may be added."""
    teeth: tuple[int, int]
    """The least and the greatest count that an added wheel may have."""

    @classmethod
    def of(cls, problem: ReconstructionProblem) -> RequestedQuestion:
        """What a question asks."""
        arbors, limits = (problem.input, *problem.arbors), problem.additions
        counts = [len(wheel.counts) for arbor in arbors for wheel in arbor.wheels]
        teeth = (limits.minimum, limits.maximum)
        return cls(len(arbors), len(counts), prod(counts), len(problem.dials), limits.wheels, teeth)

    def __str__(self) -> str:
        read = f", their counts in {self.readings} ways" if self.readings > 1 else ""
        wheels = f"{plural(self.arbors, 'arbor')} with {plural(self.wheels, 'wheel')}{read}"
        minimum, maximum = self.teeth
        added = f"at most {plural(self.added, 'added wheel')} of {minimum} to {maximum} teeth"
        return f"{wheels}; {plural(self.dials, 'dial')}; {added if self.added else 'nothing added'}"


def too_wide(problem: ReconstructionProblem, what: str) -> Problem:
    """What to say of a question that is too wide: how much it asks, and how to ask for less."""
    wheels = [wheel for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels if not wheel.is_sure]
    widest = sorted(wheels, key=lambda wheel: -len(wheel.counts))[:_MOST_DOUBTS]
    doubts = ", ".join(f"{wheel.name} has {len(wheel.counts)}" for wheel in widest)
    ways = [f"narrow counts in doubt ({doubts})"] if doubts else []
    if problem.additions.wheels:
        ways.insert(0, f"add fewer wheels (`-k {problem.additions.wheels - 1}`)")
    ways.append("leave out arbors, or dials with the arbors that lead to them alone")
    return Problem(what, f"asked are {RequestedQuestion.of(problem)}", "; or ".join(ways))


def question_digest(problem: ReconstructionProblem) -> str:
    """SHA-256 of a question: its evidence, bounds and rules, the same whatever the order of facts without one."""
    return hashlib.sha256(json.dumps(_plain(problem), sort_keys=True).encode("utf-8")).hexdigest()


def _plain(value: object) -> object:
    if is_dataclass(value):
        return {each.name: _plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, frozenset):
        return sorted((_plain(each) for each in value), key=json.dumps)
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    return str(value) if isinstance(value, Fraction) else value


# ---------------------------------------------------- geometry: from declared modules, radii and axes to what survives


def read_geometry_evidence(evidence: Train) -> SurvivingGeometry:
    """What was measured, nothing where the evidence does not ask that it be weighed.

    Raises `DeclarationError` for a module that is not above 0, and for an arbor with a place where there is a ring.
    """
    assert evidence.reconstruct is not None, "no evidence"
    requested = evidence.reconstruct.geometry
    if requested is None:
        return NO_GEOMETRY
    radii = (MeasuredWheel(name, False, _millimetres(length)) for name, length in requested.radii.items())
    return SurvivingGeometry(
        (*_modules(evidence), *radii),
        tuple(_placed(evidence)),
        requested.module.base,
        requested.distance.base,
        None if requested.reach is None else _millimetres(requested.reach),
        None if requested.radius is None else _millimetres(requested.radius),
    )


def unweighed_geometry(evidence: Train) -> Iterator[str]:
    """What was measured and plays no part, a line each."""
    assert evidence.reconstruct is not None, "no evidence"
    if evidence.reconstruct.geometry is None:
        for name, (_, wheel) in evidence.wheels.items():
            if wheel.module is not None:
                yield f"the module of '{name}', {wheel.module}: `reconstruct` has no `geometry`"
    placed = {joint.axis for joint in evidence.revolutes} if evidence.reconstruct.geometry is not None else set()
    why = "no arbor is on it" if evidence.reconstruct.geometry is not None else "`reconstruct` has no `geometry`"
    for label, axis in evidence.axes.items():
        if axis.position is not None and label not in placed:
            yield f"the position of axis '{label}': {why}"


def refuse_unreachable(evidence: Train, unreachable: frozenset[frozenset[str]]) -> None:
    """`DeclarationError` if wheels were seen in mesh that their axes keep apart."""
    for gear in evidence.gears:
        if frozenset(gear.pair) in unreachable:
            what = f"'{gear.name}' was seen in mesh, and the distance of its axes does not allow it"
            why = "pitch radii miss it by more than `reach` of `geometry`"
            place = evidence.place("gears", evidence.gears.index(gear))
            raise DeclarationError([Problem(what, why, "correct a position or a size, or widen `reach`", place)])


def _modules(evidence: Train) -> Iterator[MeasuredWheel]:
    for name, (link, wheel) in evidence.wheels.items():
        if wheel.module is None:
            continue
        if wheel.module.base <= 0:
            place = evidence.place("links", link, "wheels", name, "module")
            raise DeclarationError([Problem(f"the module of '{name}' is not above 0", "", "correct it", place)])
        yield MeasuredWheel(name, True, _millimetres(wheel.module))


def _placed(evidence: Train) -> Iterator[PlacedArbor]:
    for joint in evidence.revolutes:
        axis = evidence.axes.get(joint.axis)
        if axis is None or axis.position is None:
            continue
        x, y, _ = map(_millimetres, axis.position)
        for link in joint.pair:
            if link != evidence.frame:
                _refuse_ring(evidence, link, joint.axis)
                yield PlacedArbor(link, (x, y))


def _refuse_ring(evidence: Train, link: str, axis: str) -> None:
    ring = next((name for name, (_, wheel) in evidence.wheels.items() if wheel.internal), None)
    if ring is not None:
        what = f"where '{link}' stands is not weighed beside the ring '{ring}' yet"
        why = "a ring and its mate are as far apart as their radii differ, of which the spread of a sum says little"
        fix = "leave out the position of its axis, or `geometry`"
        raise DeclarationError([Problem(what, why, fix, evidence.place("axes", axis, "position"))])


def _millimetres(length: Quantity) -> Fraction:
    """Exact; a plain number counts as mm."""
    return length.base if length.unit is None else length.base * 1000


def find_unreachable(arbors: Sequence[SurvivingArbor], geometry: SurvivingGeometry) -> Iterator[frozenset[str]]:
    """Pairs of wheels of different arbors that cannot mesh, whichever of their counts they have."""
    wheels = [(arbor.name, wheel) for arbor in arbors if arbor.name in geometry.places for wheel in arbor.wheels]
    for at, (arbor, wheel) in enumerate(wheels):
        for other_arbor, other in wheels[:at]:
            counts = product((count for count, _ in wheel.counts), (count for count, _ in other.counts))
            if arbor != other_arbor and not any(
                geometry.may_mesh(arbor, (wheel.name, own), other_arbor, (other.name, mate)) for own, mate in counts
            ):
                yield frozenset((wheel.name, other.name))
