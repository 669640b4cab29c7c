"""What a layout could not meet, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import hypot

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem
from geartrain.numerics.vectors import across, cross, dot, minus, plus, size, unit
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PitchContact
from geartrain.scene.layout.parallel_groups import Arrangement
from geartrain.scene.layout.wheel_modules import pitch_distance
from geartrain.scene.layout.wheel_stacks import WheelStack

_TOUCH = 1e-9  # of the pitch radii: nearer than this, pitch circles touch
_MEET = 1e-6  # of them, where axes meet, for directions are rounded as written
_SHOWN = 6


def pitch_gaps(found: Arrangement) -> dict[str, float]:
    """Pairs whose pitch circles do not touch, and how far (mm) they are apart, negative into each other."""
    sizes = found.geometry.sizes
    gaps = {}
    for contact in found.geometry.declared.contacts:
        gap = _gap(found, contact)
        slack = _TOUCH if contact.parallel else _MEET
        if abs(gap) > slack * sum(sizes[wheel].radius for wheel in contact.wheels):
            gaps[contact.name] = gap
    return gaps


def _gap(found: Arrangement, contact: PitchContact) -> float:
    declared, sizes = found.geometry.declared, found.geometry.sizes
    lines = [declared.lines[axis] for axis in contact.axes]
    radii = [sizes[wheel].radius for wheel in contact.wheels]
    if contact.parallel:
        first, second = (found.points[axis] for axis in contact.axes)
        apart = pitch_distance(declared, found.geometry.modules.module, contact)
        far = size(across(minus(second, first), lines[0].direction)) - apart
        return -far if contact.kind == "ring" else far
    centres = [found.centres[wheel] for wheel in contact.wheels]
    if contact.kind == "screw":
        upright = unit(cross(lines[0].direction, lines[1].direction))
        off = minus(centres[1], centres[0])
        aside = size(across(off, upright))
        far = abs(dot(off, upright)) - sum(radii)
        return far if aside <= _TOUCH * sum(radii) else hypot(far, aside)
    tip, other = (
        plus(centre, found.geometry.seats[contact.name, wheel].out, radius)
        for centre, wheel, radius in zip(centres, contact.wheels, radii, strict=True)
    )
    return size(minus(other, tip))


def notices(
    train: GearTrain, found: Arrangement, gaps: Mapping[str, float], misses: Mapping[str, float]
) -> Iterator[Problem]:
    """All that a reader of a picture must know: what cannot be built first.

    gaps     of pairs whose pitch circles do not touch (mm)
    misses   of pairs whose teeth do not meet (pitches)
    """
    yield from (each.problem for each in train.build_findings)
    declared = found.geometry.declared
    place = {gear.name: train.declaration.place("gears", at) for at, gear in enumerate(train.declaration.gears)}
    for contact in declared.contacts:
        if contact.name in gaps:
            yield _not_touching(contact, gaps[contact.name], place[contact.name])
    yield from _simplified(declared, place)
    for stack in found.stacks:
        yield from _crowding(found, stack)
    for name, miss in misses.items():
        if name not in gaps:
            yield Problem(
                f"the teeth of '{name}' do not meet: they are off by {abs(miss):.3g} of a pitch",
                "it closes a loop of wheels whose places leave no other choice",
                "give the axes places where teeth meet, or other tooth numbers",
                place[name],
            )


def _not_touching(contact: PitchContact, gap: float, place: str) -> Problem:
    (first, second), (axis, other) = contact.wheels, contact.axes
    return Problem(
        f"the pitch circles of '{first}' and '{second}' "
        + (f"are {gap:.3g} mm apart" if gap > 0 else f"overlap by {-gap:.3g} mm"),
        f"pair '{contact.name}' wants another distance of axes '{axis}' and '{other}' than other pairs, declared "
        "positions, modules or offsets leave it",
        "change a tooth number, a position or a module; the motion does not depend on it",
        place,
    )


def _simplified(declared: DeclaredGeometry, place: Mapping[str, str]) -> Iterator[Problem]:
    """Wheels that are not drawn as they are declared."""
    for stray in declared.strays:
        yield Problem(
            f"wheel '{stray.wheel}' is drawn on axis '{declared.axis[stray.wheel]}' only",
            f"pair '{stray.pair}' has it on axis '{stray.axis}' too",
            "give each of its meshes a wheel of its own",
            place[stray.pair],
        )


def _crowding(found: Arrangement, stack: WheelStack) -> Iterator[Problem]:
    """Wheels that share a height and a place, and arbors that go through wheels."""
    mates = {frozenset(contact.wheels) for contact in found.geometry.declared.contacts}
    height = {block.wheel: dot(found.centres[block.wheel], stack.up) for block in stack.upright}
    collide = [pair for pair in stack.collisions(height) if frozenset(pair) not in mates]
    if collide:
        yield Problem(
            f"wheels collide: {_listed([f'{a} and {b}' for a, b in collide])}",
            "they lie in one level, as their mates do, and their places leave no room between them",
            "give their axes positions, or their pairs another order",
        )
    pierced = [f"{arbor} through {wheel}" for arbor, wheel in stack.pierced(height)]
    if pierced:
        yield Problem(
            f"arbors go through wheels: {_listed(pierced)}",
            "no order of the levels was found that keeps all arbors clear",
            "give the axes positions that leave them room",
        )


def _listed(words: Sequence[str]) -> str:
    more = f" and {len(words) - _SHOWN} more" if len(words) > _SHOWN else ""
    return ", ".join(words[:_SHOWN]) + more
