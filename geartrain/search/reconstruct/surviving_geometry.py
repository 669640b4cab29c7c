"""Modules, pitch radii and places of axes that were measured on what survives.

Lengths are millimetres, exact. Axes are parallel, so a place is where an axis crosses the plan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.errors import DeclarationError, Problem
from geartrain.numerics.quantity import Quantity
from geartrain.train import Train

Place = tuple[Fraction, Fraction]
Bounds = tuple[Fraction, Fraction]
Size = tuple[str | None, int]
"""A wheel by its name, None for an added one, and its count of teeth."""

UNMEASURED_SPREADS = 3
"""A wheel that was not measured has the module of its mate within so many spreads, where impossible is told from
improbable."""


@dataclass(frozen=True)
class MeasuredWheel:
    """A wheel whose module was measured, or its pitch radius.

    length   that length
    """

    name: str
    is_module: bool
    length: Fraction


@dataclass(frozen=True)
class PlacedArbor:
    """A surviving arbor whose axis has a known place."""

    name: str
    place: Place


@dataclass(frozen=True)
class SurvivingGeometry:
    """What was measured, and how it is weighed.

    module     spread of the logarithm of the quotient of two modules in mesh
    distance   spread of the logarithm of the sum of pitch radii over the distance of axes
    reach      greatest difference of those two that is possible; None if any is
    radius     error of every measured pitch radius; None if it is part of the spread of modules
    """

    wheels: tuple[MeasuredWheel, ...] = ()
    arbors: tuple[PlacedArbor, ...] = ()
    module: Fraction = Fraction(43, 1000)
    distance: Fraction = Fraction(3, 100)
    reach: Fraction | None = None
    radius: Fraction | None = None

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
        least, greatest = ((one * first[1] + other * second[1]) / 2 for one, other in zip(own, mate, strict=True))
        return max(Fraction(0), least - self.reach), greatest + self.reach

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


# From declared modules, radii and axes to the geometry of what survives.


def read_geometry_evidence(evidence: Train) -> SurvivingGeometry:
    """What was measured, nothing where the evidence does not ask that it be weighed.

    Raises `DeclarationError` for a module that is not above 0, and for an arbor with a place where there is a ring.
    """
    assert evidence.reconstruct is not None, "no evidence"
    asked = evidence.reconstruct.geometry
    if asked is None:
        return NO_GEOMETRY
    radii = (MeasuredWheel(name, False, _millimetres(length)) for name, length in asked.radii.items())
    return SurvivingGeometry(
        (*_modules(evidence), *radii),
        tuple(_placed(evidence)),
        asked.module.base,
        asked.distance.base,
        None if asked.reach is None else _millimetres(asked.reach),
        None if asked.radius is None else _millimetres(asked.radius),
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
