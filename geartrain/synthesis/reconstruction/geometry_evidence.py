"""From declared modules, radii and axes to the geometry of what survives."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from geartrain.errors import DeclarationError, Problem
from geartrain.numerics.quantity import Quantity
from geartrain.synthesis.reconstruction.surviving_geometry import (
    NO_GEOMETRY,
    MeasuredWheel,
    PlacedArbor,
    SurvivingGeometry,
)
from geartrain.train import Train


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
