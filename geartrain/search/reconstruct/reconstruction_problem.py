"""Typed question of a reconstruction: surviving arbors with wheels, dials with speeds, what may be added.

Speeds are turns per unit of the input arbor, exact, positive in one sense. The input arbor turns at `input_speed`.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import prod
from typing import Literal

from geartrain.errors import Problem
from geartrain.numerics.results import Result
from geartrain.search.reconstruct.surviving_geometry import NO_GEOMETRY, SurvivingGeometry

NEW = "new"
"""The place of a dial whose arbor does not survive."""


@dataclass(frozen=True)
class SurvivingWheel:
    """A wheel that survives: its name and the counts it may have, each with its prior weight.

    counts    teeth and weights, sorted by teeth, no count twice, weights positive; one pair where the count is sure
    internal  whether it is a ring: its teeth point inwards
    """

    name: str
    counts: tuple[tuple[int, Fraction], ...]
    internal: bool = False

    @property
    def is_sure(self) -> bool:
        """Whether there is one count."""
        return len(self.counts) == 1


@dataclass(frozen=True)
class SurvivingArbor:
    """Wheels that are fixed together."""

    name: str
    wheels: tuple[SurvivingWheel, ...]


@dataclass(frozen=True)
class SearchedDial:
    """A pointer and the speed that it must have.

    least, greatest   bounds of its speed, equal where it must be exact
    signed            whether the sense is known; if not, bounds are those of the magnitude
    place             the surviving arbor that carries it, `NEW`, or None where that is not known
    """

    name: str
    least: Fraction
    greatest: Fraction
    signed: bool = True
    place: str | None = None

    @property
    def is_exact(self) -> bool:
        """Whether one speed alone will do."""
        return self.least == self.greatest


@dataclass(frozen=True)
class Additions:
    """What may be added: so many wheels, so many arbors, counts of teeth from least to greatest, and where.

    on   "any": also beside surviving wheels, where they drive; "new": on new arbors alone
    """

    wheels: int
    least: int
    greatest: int
    arbors: int | None = None
    on: Literal["any", "new"] = "any"


@dataclass(frozen=True)
class PriorFactors:
    """By what factor a candidate is less probable for each added wheel, added arbor and unused surviving wheel."""

    wheel: Fraction = Fraction(10)
    arbor: Fraction = Fraction(10)
    unused: Fraction = Fraction(100)


@dataclass(frozen=True)
class ReconstructionProblem:
    """Surviving arbors, dials and the rules.

    meshes   pairs of names of wheels that were seen in mesh
    apart    pairs of names of wheels that do not mesh
    coaxial  pairs of names of arbors on one axis: no wheel of one meshes with a wheel of the other, added ones included
    use      "wheels": every surviving wheel meshes; "arbors": every surviving arbor is in the train; "some": neither
    idlers   whether a driven wheel may drive
    geometry  what was measured; pairs that it keeps apart are in `apart` and `coaxial` already
    """

    input: SurvivingArbor
    arbors: tuple[SurvivingArbor, ...]
    dials: tuple[SearchedDial, ...]
    additions: Additions
    input_speed: Fraction = Fraction(1)
    meshes: frozenset[frozenset[str]] = field(default_factory=frozenset)
    apart: frozenset[frozenset[str]] = field(default_factory=frozenset)
    coaxial: frozenset[frozenset[str]] = field(default_factory=frozenset)
    use: Literal["wheels", "arbors", "some"] = "wheels"
    idlers: bool = False
    factors: PriorFactors = PriorFactors()
    geometry: SurvivingGeometry = NO_GEOMETRY

    @cached_property
    def rings(self) -> frozenset[str]:
        """Names of surviving rings; added wheels are none."""
        return frozenset(wheel.name for arbor in (self.input, *self.arbors) for wheel in arbor.wheels if wheel.internal)


@dataclass(frozen=True)
class PlacedWheel:
    """A wheel of a candidate: a surviving one by its name, or an added one (name None), with its count."""

    name: str | None
    teeth: int


@dataclass(frozen=True)
class Arbor:
    """An arbor of a candidate and all that it drives: the canonical form, in which equal mechanisms are equal.

    name     of the surviving arbor, None for an added one
    driven   the wheel that is driven; None for the input arbor
    dials    names of the dials that it shows, sorted
    drives   driving wheels with the arbors that each drives, sorted
    passes   where idlers are allowed: arbors that the driven wheel itself drives, sorted
    """

    name: str | None
    driven: PlacedWheel | None
    dials: tuple[str, ...]
    drives: tuple[tuple[PlacedWheel, tuple[Arbor, ...]], ...]
    passes: tuple[Arbor, ...] = ()

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


# How much a reconstruction asks: what survives, in how many ways it may be read, and what may be added.


_MOST_DOUBTS = 3


@dataclass(frozen=True, slots=True)
class AskedQuestion(Result):
    """What is asked.

    Attributes
    ----------
    arbors : int
        Surviving ones, the input included.
    wheels : int
        Surviving ones.
    readings : int
        Combinations of counts in doubt; 1 where all are sure.
    dials : int
        Pointers whose speed is known.
    added : int
        The most wheels that may be added.
    teeth : tuple of int
        The least and the greatest count that an added wheel may have.
    """

    arbors: int
    wheels: int
    readings: int
    dials: int
    added: int
    teeth: tuple[int, int]

    @classmethod
    def of(cls, problem: ReconstructionProblem) -> AskedQuestion:
        """What a question asks."""
        arbors, limits = (problem.input, *problem.arbors), problem.additions
        counts = [len(wheel.counts) for arbor in arbors for wheel in arbor.wheels]
        teeth = (limits.least, limits.greatest)
        return cls(len(arbors), len(counts), prod(counts), len(problem.dials), limits.wheels, teeth)

    def __str__(self) -> str:
        read = f", their counts in {self.readings} ways" if self.readings > 1 else ""
        wheels = f"{_many(self.arbors, 'arbor')} with {_many(self.wheels, 'wheel')}{read}"
        least, greatest = self.teeth
        added = f"at most {_many(self.added, 'added wheel')} of {least} to {greatest} teeth"
        return f"{wheels}; {_many(self.dials, 'dial')}; {added if self.added else 'nothing added'}"


def too_wide(problem: ReconstructionProblem, what: str) -> Problem:
    """What to say of a question that is too wide: how much it asks, and how to ask for less."""
    wheels = [wheel for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels if not wheel.is_sure]
    widest = sorted(wheels, key=lambda wheel: -len(wheel.counts))[:_MOST_DOUBTS]
    doubts = ", ".join(f"{wheel.name} has {len(wheel.counts)}" for wheel in widest)
    ways = [f"narrow counts in doubt ({doubts})"] if doubts else []
    if problem.additions.wheels:
        ways.insert(0, f"add fewer wheels (`-k {problem.additions.wheels - 1}`)")
    ways.append("leave out arbors, or dials with the arbors that lead to them alone")
    return Problem(what, f"asked are {AskedQuestion.of(problem)}", "; or ".join(ways))


def _many(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


# A mark by which two runs know that they were asked the same.


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


# Which surviving wheels the distances of their axes keep apart, exactly.


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
