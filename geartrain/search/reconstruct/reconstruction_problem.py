"""Reconstruction problem: surviving arbors with wheels and measured sizes, dials with speeds, and limits on added
parts.

Speeds are exact and signed, in turns per unit of time; `input_speed` defines the unit. Lengths are exact, in
millimetres. All axes are parallel, so the position of an arbor is a point in the plan.
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

NEW = "new"
"""Value of `SearchedDial.place` for a dial whose pointer is on an arbor that does not survive."""
UNMEASURED_SPREADS = 3
"""Maximum relative difference between the modules of a measured wheel and of an unmeasured mate, as a multiple of the
standard deviation `module`.
"""
_MOST_UNCERTAINTIES = 3  # wheels that a message names


@dataclass(frozen=True)
class MeasuredWheel:
    """Surviving wheel with a measured module or pitch radius."""

    name: str
    is_module: bool
    length: Fraction
    """Measured module or pitch radius [mm]."""


@dataclass(frozen=True)
class PlacedArbor:
    """Surviving arbor with a known position of its axis in the plan [mm]."""

    name: str
    place: Place


@dataclass(frozen=True)
class SurvivingGeometry:
    """Measured modules, radii and axis positions, with the standard deviations of their misfits."""

    wheels: tuple[MeasuredWheel, ...] = ()
    arbors: tuple[PlacedArbor, ...] = ()
    module: Fraction = Fraction(43, 1000)
    """Standard deviation of the natural logarithm of the ratio of the modules of two meshing wheels."""
    distance: Fraction = Fraction(3, 100)
    """Standard deviation of the natural logarithm of the sum of two pitch radii divided by the distance between the
    axes.
    """
    reach: Fraction | None = None
    """Maximum difference between the sum of the pitch radii of two meshing wheels and the distance of their axes [mm];
    None if it is not limited.
    """
    radius: Fraction | None = None
    """Standard deviation of every measured pitch radius [mm]; None if it is included in the standard deviation
    `module`.
    """

    @cached_property
    def places(self) -> Mapping[str | None, Place]:
        """Position of the axis of each arbor [mm], keyed by the name of the arbor."""
        return {arbor.name: arbor.place for arbor in self.arbors}

    @cached_property
    def measured(self) -> Mapping[str | None, MeasuredWheel]:
        """Measured wheels, keyed by name."""
        return {wheel.name: wheel for wheel in self.wheels}

    def module_of(self, wheel: PlacedWheel) -> Fraction | None:
        """Return the module of a wheel [mm]; None if the wheel was not measured."""
        measured = self.measured.get(wheel.name)
        if measured is None:
            return None
        return measured.length if measured.is_module else 2 * measured.length / wheel.teeth

    def square_distance(self, first: str | None, second: str | None) -> Fraction | None:
        """Return the square of the distance between the axes of two arbors [mm2]; None if one of the positions is not
        known.
        """
        if first not in self.places or second not in self.places:
            return None
        (x, y), (u, v) = self.places[first], self.places[second]
        return (x - u) ** 2 + (y - v) ** 2

    def radii_sum(self, first: PlacedWheel, second: PlacedWheel) -> Fraction | None:
        """Return the sum of the pitch radii of two meshing wheels [mm]; None if neither wheel was measured.

        An unmeasured wheel is assumed to have the module of its mate.
        """
        module, mate = self.module_of(first), self.module_of(second)
        module, mate = (mate if module is None else module), (module if mate is None else mate)
        return None if module is None or mate is None else (module * first.teeth + mate * second.teeth) / 2

    def module_bounds(self, wheel: PlacedWheel, mate: PlacedWheel) -> Bounds | None:
        """Return the minimum and the maximum module of a wheel that meshes with `mate` [mm]; None if neither wheel was
        measured.
        """
        module = self.module_of(wheel)
        if module is not None:
            return module, module
        module = self.module_of(mate)
        if module is None:
            return None
        # at most 1, so that the minimum module is not negative
        spread = min(Fraction(1), UNMEASURED_SPREADS * self.module)
        return module * (1 - spread), module * (1 + spread)

    def may_mesh(self, arbor: str | None, wheel: PlacedWheel, other_arbor: str | None, other: PlacedWheel) -> bool:
        """Return whether two wheels can mesh at the distance between their axes. Return True if the distance is not
        known.
        """
        square = self.square_distance(arbor, other_arbor)
        if square is None:
            return True
        if not square:
            return False  # on one axis
        own, mate = self.module_bounds(wheel, other), self.module_bounds(other, wheel)
        if own is None or mate is None or self.reach is None:
            return True
        minimum, maximum = ((one * wheel.teeth + two * other.teeth) / 2 for one, two in zip(own, mate, strict=True))
        # squares are exact fractions; distances may be irrational
        return max(Fraction(0), minimum - self.reach) ** 2 <= square <= (maximum + self.reach) ** 2


NO_GEOMETRY = SurvivingGeometry()


@dataclass(frozen=True)
class SurvivingWheel:
    """Surviving wheel with its possible tooth counts and the prior weight of each tooth count.

    See Also
    --------
    ReconstructionProblem : Problem of which this is a part.
    """

    name: str
    """Name of the wheel."""
    counts: tuple[tuple[int, Fraction], ...]
    """Pairs of a possible tooth count and its positive prior weight, in ascending order of the tooth counts. There is
    one pair if the tooth count is certain.
    """
    internal: bool = False
    """True for a ring, which is a wheel with internal teeth."""

    @property
    def is_sure(self) -> bool:
        """True if the wheel has a single possible tooth count."""
        return len(self.counts) == 1

    @property
    def readings(self) -> tuple[PlacedWheel, ...]:
        """The wheel with each of its possible tooth counts."""
        return tuple(PlacedWheel(self.name, count) for count, _ in self.counts)


@dataclass(frozen=True)
class SurvivingArbor(Shown):
    """Surviving arbor with its wheels, which are fixed to each other.

    See Also
    --------
    ReconstructionProblem : Problem of which this is a part.
    """

    name: str
    """Name of the arbor."""
    wheels: tuple[SurvivingWheel, ...]
    """Surviving wheels that are fixed on the arbor."""


@dataclass(frozen=True)
class SearchedDial(Shown):
    """Pointer with its required range of speeds, and with its arbor if the arbor is known.

    See Also
    --------
    ReconstructionProblem : Problem of which this is a part.
    """

    name: str
    """Name of the pointer."""
    minimum: Fraction
    """Minimum speed [turns per unit of time]; equal to `maximum` if the speed is exact."""
    maximum: Fraction
    """Maximum speed [turns per unit of time]."""
    signed: bool = True
    """True if the sense of rotation is known; False if `minimum` and `maximum` are bounds of the magnitude of the
    speed.
    """
    place: str | None = None
    """Name of the surviving arbor that carries the pointer; "new" if this arbor does not survive; None if it is not
    known which arbor carries the pointer.
    """

    @property
    def is_exact(self) -> bool:
        """True if the required range of speeds contains only one speed."""
        return self.minimum == self.maximum

    def accepts(self, speed: Fraction) -> bool:
        """Return whether a speed is in the required range.

        Parameters
        ----------
        speed : Fraction
            Speed [turns per unit of time].
        """
        return self.minimum <= (speed if self.signed else abs(speed)) <= self.maximum


@dataclass(frozen=True)
class Additions:
    """Limits on the number of added wheels, on their tooth counts, and on the number of added arbors.

    See Also
    --------
    ReconstructionProblem : Problem of which this is a part.
    """

    wheels: int
    """Maximum number of added wheels."""
    minimum: int
    """Minimum tooth count of an added wheel."""
    maximum: int
    """Maximum tooth count of an added wheel."""
    arbors: int | None = None
    """Maximum number of added arbors; None if it is not limited."""
    on: Literal["any", "new"] = "any"
    """Arbors that may carry added wheels: "new" for added arbors only, "any" for added and surviving arbors. On a
    surviving arbor, driving wheels may be added; a driven wheel may be added only if no wheel of the arbor survives.
    """


@dataclass(frozen=True)
class PriorFactors:
    """Factors by which the prior weight of a candidate reconstruction is divided for each added or unused part.

    See Also
    --------
    ReconstructionProblem : Problem of which this is a part.
    """

    wheel: Fraction = Fraction(10)
    """Number by which the prior weight is divided for each added wheel, at least 1."""
    arbor: Fraction = Fraction(10)
    """Number by which the prior weight is divided for each added arbor, at least 1."""
    unused: Fraction = Fraction(100)
    """Number by which the prior weight is divided for each surviving wheel that meshes with no other wheel, at least 1.
    """


@dataclass(frozen=True)
class ReconstructionProblem(Shown):
    """Reconstruction problem: surviving arbors, dials with speeds, and rules for added parts.

    See Also
    --------
    evidence_question : Convert declared evidence to a problem.
    find_reconstructions : Find the trains that solve a problem.
    """

    input: SurvivingArbor
    """Input arbor of the train."""
    arbors: tuple[SurvivingArbor, ...]
    """Surviving arbors other than the input arbor."""
    dials: tuple[SearchedDial, ...]
    """Pointers with their required ranges of speeds."""
    additions: Additions
    """Limits on added wheels and arbors."""
    input_speed: Fraction = Fraction(1)
    """Speed of the input arbor [turns per unit of time]. It defines the unit of all other speeds."""
    meshes: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of wheels that are known to mesh."""
    apart: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of wheels that are known not to mesh."""
    coaxial: frozenset[frozenset[str]] = field(default_factory=frozenset)
    """Pairs of names of arbors that have the same axis. Wheels on two such arbors, including added wheels, do not mesh
    with each other.
    """
    use: Literal["wheels", "arbors", "some"] = "wheels"
    """Required use of surviving parts: "wheels" if every surviving wheel must mesh, "arbors" if every surviving arbor
    must be in the train, "some" if neither is required.
    """
    idlers: bool = False
    """True if a driven wheel may also drive (an idler)."""
    factors: PriorFactors = PriorFactors()
    """Factors by which the prior weight of a candidate reconstruction is divided."""
    geometry: SurvivingGeometry = NO_GEOMETRY
    """Measurements of surviving wheels and axes. Pairs that these measurements exclude are already in `apart` and
    `coaxial`.
    """

    @cached_property
    def rings(self) -> frozenset[str]:
        """Names of the surviving rings. Added wheels are never rings."""
        return frozenset(wheel.name for arbor in (self.input, *self.arbors) for wheel in arbor.wheels if wheel.internal)


@dataclass(frozen=True)
class PlacedWheel:
    """Wheel of a candidate reconstruction, which is a surviving wheel or an added wheel, with its tooth count.

    See Also
    --------
    Candidate : Explanation of which this is a part.
    """

    name: str | None
    """Name of the surviving wheel; None for an added wheel."""
    teeth: int
    """Tooth count of the wheel in the candidate."""


@dataclass(frozen=True)
class Arbor(Shown):
    """Arbor of a candidate reconstruction with the subtree that it drives. The form is canonical, so that equal trains
    compare equal.

    See Also
    --------
    Candidate : Explanation with its input arbor.
    candidate_train : Convert a candidate to a train.
    """

    name: str | None
    """Name of the surviving arbor; None for an added arbor."""
    driven: PlacedWheel | None
    """Driven wheel of the arbor; None for the input arbor."""
    dials: tuple[str, ...]
    """Sorted names of the dials whose pointers are on the arbor."""
    drives: tuple[tuple[PlacedWheel, tuple[Arbor, ...]], ...]
    """Driving wheels on the arbor, each with the arbors that it drives, in sorted order."""
    passes: tuple[Arbor, ...] = ()
    """Arbors that the driven wheel drives as an idler, in sorted order."""

    def driven_arbors(self) -> Iterator[tuple[PlacedWheel, Arbor]]:
        """Yield each arbor that this arbor drives, preceded by the wheel that drives it."""
        for wheel, children in self.drives:
            yield from ((wheel, child) for child in children)
        for child in self.passes:
            assert self.driven is not None
            yield self.driven, child

    def arbors(self) -> Iterator[Arbor]:
        """Yield this arbor and all arbors of its subtree."""
        yield self
        for _, child in self.driven_arbors():
            yield from child.arbors()

    def wheels(self) -> Iterator[PlacedWheel]:
        """Yield each meshing wheel of the subtree once."""
        for each in self.arbors():
            if each.driven is not None:
                yield each.driven
            yield from (wheel for wheel, _ in each.drives if wheel.name is None or wheel != each.driven)

    def meshes(self) -> Iterator[tuple[Arbor, PlacedWheel, Arbor]]:
        """Yield each mesh of the subtree as (driving arbor, driving wheel, driven arbor)."""
        for wheel, child in self.driven_arbors():
            yield self, wheel, child
            yield from child.meshes()

    @property
    def added_wheels(self) -> int:
        """Number of added wheels in the subtree."""
        return sum(wheel.name is None for wheel in self.wheels())

    @property
    def added_arbors(self) -> int:
        """Number of added arbors in the subtree."""
        return sum(arbor.name is None for arbor in self.arbors())


# --------------------------------------------------------------------------------------------------- size of a problem


@dataclass(frozen=True, slots=True)
class RequestedQuestion(Result):
    """Size of a reconstruction problem as reported before the search: numbers of surviving arbors and wheels, of dials,
    and of added wheels.
    """

    arbors: int
    """Number of surviving arbors, including the input arbor."""
    wheels: int
    """Number of surviving wheels."""
    readings: int
    """Number of combinations of the possible tooth counts of surviving wheels; 1 if all tooth counts are certain."""
    dials: int
    """Number of pointers with a required speed."""
    added: int
    """Maximum number of added wheels."""
    teeth: tuple[int, int]
    """Minimum and maximum tooth count of an added wheel."""

    @classmethod
    def of(cls, problem: ReconstructionProblem) -> RequestedQuestion:
        """Return the size of a reconstruction problem."""
        arbors, limits = (problem.input, *problem.arbors), problem.additions
        counts = [len(wheel.counts) for arbor in arbors for wheel in arbor.wheels]
        teeth = (limits.minimum, limits.maximum)
        return cls(len(arbors), len(counts), prod(counts), len(problem.dials), limits.wheels, teeth)

    def __str__(self) -> str:
        read = f" and {self.readings} combinations of their counts" if self.readings > 1 else ""
        wheels = f"{plural(self.arbors, 'arbor')} with {plural(self.wheels, 'wheel')}{read}"
        minimum, maximum = self.teeth
        added = f"at most {plural(self.added, 'added wheel')} of {minimum} to {maximum} teeth"
        return f"{wheels}; {plural(self.dials, 'dial')}; {added if self.added else 'no added wheels'}"


def too_wide(problem: ReconstructionProblem, what: str) -> Problem:
    """Return the error message for a problem that is too large. It contains the size of the problem and suggestions to
    reduce it.
    """
    wheels = [wheel for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels if not wheel.is_sure]
    widest = sorted(wheels, key=lambda wheel: -len(wheel.counts))[:_MOST_UNCERTAINTIES]
    uncertainties = ", ".join(f"{wheel.name} has {len(wheel.counts)}" for wheel in widest)
    ways = [f"narrow uncertain tooth counts ({uncertainties})"] if uncertainties else []
    if problem.additions.wheels:
        ways.insert(0, f"add fewer wheels (`-k {problem.additions.wheels - 1}`)")
    ways.append("omit arbors, or dials together with the arbors that drive only these dials")
    return Problem(what, f"the problem has {RequestedQuestion.of(problem)}", "; or ".join(ways))


def magnitude_bounds(minimum: Fraction, maximum: Fraction) -> Bounds:
    """Return the minimum and the maximum magnitude of the numbers between `minimum` and `maximum`."""
    lower, upper = sorted((abs(minimum), abs(maximum)))
    return (Fraction(0) if minimum < 0 < maximum else lower), upper


def question_digest(problem: ReconstructionProblem) -> str:
    """Return the SHA-256 digest of a problem. The digest does not depend on the order of facts that have no order."""
    return hashlib.sha256(json.dumps(_plain(problem), sort_keys=True).encode("utf-8")).hexdigest()


def _plain(value: object) -> object:
    if is_dataclass(value):
        return {each.name: _plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, frozenset):
        return sorted((_plain(each) for each in value), key=json.dumps)
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    return str(value) if isinstance(value, Fraction) else value


# -------------------------------- geometry: conversion of declared modules, radii and axes to measurements of survivors


def read_geometry_evidence(evidence: Train) -> SurvivingGeometry:
    """Return the measurements in the evidence; `NO_GEOMETRY` if the evidence has no block `geometry`.
    `DeclarationError` is raised if the evidence contains both a ring and an arbor with a position.
    """
    assert evidence.reconstruct is not None, "no evidence"
    requested = evidence.reconstruct.geometry
    if requested is None:
        return NO_GEOMETRY
    modules = (
        MeasuredWheel(name, True, _millimetres(wheel.module))
        for name, (_, wheel) in evidence.wheels.items()
        if wheel.module is not None
    )
    radii = (MeasuredWheel(name, False, _millimetres(length)) for name, length in requested.radii.items())
    return SurvivingGeometry(
        (*modules, *radii),
        tuple(_placed(evidence)),
        requested.module.base,
        requested.distance.base,
        None if requested.reach is None else _millimetres(requested.reach),
        None if requested.radius is None else _millimetres(requested.radius),
    )


def unweighed_geometry(evidence: Train) -> Iterator[str]:
    """Yield a one-line description of each measurement that the search does not use."""
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
    """Raise `DeclarationError` if the axes of wheels that were seen in mesh are too close together or too far apart for
    any mesh.
    """
    for gear in evidence.gears:
        if frozenset(gear.pair) in unreachable:
            what = f"the known mesh '{gear.name}' is impossible at the distance between its axes"
            why = "the sum of the pitch radii differs from the distance by more than `reach` of `geometry`"
            place = evidence.place("gears", evidence.gears.index(gear))
            raise DeclarationError([Problem(what, why, "correct a position or a size, or widen `reach`", place)])


def _placed(evidence: Train) -> Iterator[PlacedArbor]:
    """Yield the declared position of each arbor. `DeclarationError` is raised if there is one although the evidence
    contains a ring.
    """
    ring = next((name for name, (_, wheel) in evidence.wheels.items() if wheel.internal), None)
    for joint in evidence.revolutes:
        axis = evidence.axes.get(joint.axis)
        if axis is None or axis.position is None:
            continue
        x, y, _ = map(_millimetres, axis.position)
        for link in joint.pair:
            if link == evidence.frame:
                continue
            if ring is not None:
                what = f"the position of '{link}' cannot be used as evidence, because '{ring}' is a ring gear"
                why = (
                    "`distance` compares axis distances with sums of pitch radii, but the centre distance of a ring "
                    "gear and its mate is a difference"
                )
                fix = "remove the position of its axis, or `geometry`"
                raise DeclarationError([Problem(what, why, fix, evidence.place("axes", joint.axis, "position"))])
            yield PlacedArbor(link, (x, y))


def _millimetres(length: Quantity) -> Fraction:
    """Convert a length to an exact number of millimetres. A number without a unit is assumed to be in millimetres."""
    return length.base if length.unit is None else length.base * 1000


def find_unreachable(arbors: Sequence[SurvivingArbor], geometry: SurvivingGeometry) -> Iterator[frozenset[str]]:
    """Yield each pair of wheels on different arbors that cannot mesh with any combination of their possible tooth
    counts.
    """
    wheels = [(arbor.name, wheel) for arbor in arbors if arbor.name in geometry.places for wheel in arbor.wheels]
    for at, (arbor, wheel) in enumerate(wheels):
        for other_arbor, other in wheels[:at]:
            readings = product(wheel.readings, other.readings)
            if arbor != other_arbor and not any(
                geometry.may_mesh(arbor, own, other_arbor, mate) for own, mate in readings
            ):
                yield frozenset((wheel.name, other.name))
