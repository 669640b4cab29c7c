"""What a layout could not meet, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import hypot

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem
from geartrain.numerics.vectors import across, cross, dot, minus, plus, size, unit
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PitchContact
from geartrain.scene.layout.parallel_groups import Arrangement
from geartrain.scene.layout.wheel_geometry import WheelSize
from geartrain.scene.layout.wheel_modules import pitch_distance
from geartrain.scene.layout.wheel_stacks import WheelStack

_TOUCH = 1e-9  # of the pitch radii: nearer than this, pitch circles touch
_MEET = 1e-6  # of them, where axes meet, for directions are rounded as written
_SHOWN = 6


def misfits(reading: DeclaredGeometry, found: Arrangement, sizes: Mapping[str, WheelSize]) -> dict[str, float]:
    """Pairs whose pitch circles do not touch, and how far (mm) they are apart, negative into each other."""
    gaps = {touch.name: _gap(reading, found, sizes, touch) for touch in reading.touches}
    slack = {
        touch.name: (_TOUCH if touch.kind in ("side", "ring") else _MEET) * sum(sizes[w].radius for w in touch.wheels)
        for touch in reading.touches
    }
    return {name: gap for name, gap in gaps.items() if abs(gap) > slack[name]}


def _gap(reading: DeclaredGeometry, found: Arrangement, sizes: Mapping[str, WheelSize], touch: PitchContact) -> float:
    lines = [reading.lines[axis] for axis in touch.axes]
    points = [found.points[axis] for axis in touch.axes]
    radii = [sizes[wheel].radius for wheel in touch.wheels]
    if touch.kind in ("side", "ring"):
        module = {wheel: sizes[wheel].module for wheel in touch.wheels}
        far = size(across(minus(points[1], points[0]), lines[0].way)) - pitch_distance(reading, module, touch)
        return -far if touch.kind == "ring" else far
    centres = [found.centres[wheel] for wheel in touch.wheels]
    if touch.kind == "screw":
        upright = unit(cross(lines[0].way, lines[1].way))
        off = minus(centres[1], centres[0])
        aside = size(across(off, upright))
        far = abs(dot(off, upright)) - sum(radii)
        return far if aside <= _TOUCH * sum(radii) else hypot(far, aside)
    tips = [plus(centres[at], found.seats[touch.name][at].out, radii[at]) for at in (0, 1)]
    return size(minus(tips[1], tips[0]))


def notices(
    train: GearTrain,
    reading: DeclaredGeometry,
    found: Arrangement,
    apart: Mapping[str, float],
    misses: Mapping[str, float],
) -> Iterator[Problem]:
    """All that a reader of a picture must know."""
    place = {gear.name: train.declaration.place("gears", at) for at, gear in enumerate(train.declaration.gears)}
    for touch in reading.touches:
        if touch.name in apart:
            yield _not_touching(touch, apart[touch.name], place[touch.name])
    yield from _likenesses(reading, place)
    for tower in found.towers.values():
        yield from _crowding(reading, found, tower)
    for name, miss in misses.items():
        if name not in apart:
            yield Problem(
                f"the teeth of '{name}' do not meet: they are off by {abs(miss):.3g} of a pitch",
                "it closes a loop of wheels whose places leave no other choice",
                "give the axes places where teeth meet, or other tooth numbers",
                place[name],
            )


def _not_touching(touch: PitchContact, gap: float, place: str) -> Problem:
    first, second = touch.wheels
    return Problem(
        f"the pitch circles of '{first}' and '{second}' "
        + (f"are {gap:.3g} mm apart" if gap > 0 else f"overlap by {-gap:.3g} mm"),
        f"pair '{touch.name}' wants another distance of axes '{touch.axes[0]}' and '{touch.axes[1]}' than other pairs, "
        "declared positions, modules or offsets leave it",
        "change a tooth number, a position or a module; the motion does not depend on it",
        place,
    )


def _likenesses(reading: DeclaredGeometry, place: Mapping[str, str]) -> Iterator[Problem]:
    for touch in reading.touches:
        if touch.likeness:
            yield Problem(
                f"'{touch.name}' is drawn as spur wheels",
                f"it is {touch.likeness}",
                "declare directions under `axes`",
                place[touch.name],
            )
    for wheel, name, other in reading.strays:
        yield Problem(
            f"wheel '{wheel}' is drawn on axis '{reading.axis[wheel]}' only",
            f"pair '{name}' has it on axis '{other}' too",
            "give each of its meshes a wheel of its own",
            place[name],
        )


def _crowding(reading: DeclaredGeometry, found: Arrangement, tower: WheelStack) -> Iterator[Problem]:
    """Wheels that share a height and a place, and arbors that go through wheels."""
    mates = {frozenset(touch.wheels) for touch in reading.touches}
    height = {block.wheel: dot(found.centres[block.wheel], tower.up) for block in tower.upright}
    collide = [pair for pair in tower.collisions(height) if frozenset(pair) not in mates]
    if collide:
        yield Problem(
            f"wheels collide: {_listed([f'{a} and {b}' for a, b in collide])}",
            "they stand in one level, for their mates do, and their places leave no room between them",
            "give their axes positions, or their pairs another order",
        )
    pierced = [f"{link} through {wheel}" for link, wheel in tower.pierced(height)]
    if pierced:
        yield Problem(
            f"arbors go through wheels: {_listed(pierced)}",
            "no order of the levels was found that keeps all arbors clear",
            "give the axes positions that leave them room",
        )


def _listed(words: Sequence[str]) -> str:
    more = f" and {len(words) - _SHOWN} more" if len(words) > _SHOWN else ""
    return ", ".join(words[:_SHOWN]) + more
