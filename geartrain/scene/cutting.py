"""One tooth of a wheel with conjugate teeth, taken out of its outline."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING

from geartrain.scene.likeness import Points, polar
from geartrain.scene.result import Profile

if TYPE_CHECKING:
    from geartrain.meshes import ConjugateMesh
    from geartrain.outlines import Contour, Pins
    from geartrain.outlines import Wheel as Cut
    from geartrain.teeth.conjugate import Pair
    from geartrain.train import Train

_CHORD = 1e-3  # modules: how far a chord may leave a flank
_MOST = 60  # points of a tooth
_PIN = 48  # points round a pin


def cut(mesh: ConjugateMesh, train: Train, distance: float, radii: Mapping[str, float]) -> dict[str, Profile]:
    """One tooth of each wheel of a pair.

    distance   of the axes as placed (mm); radii, of pitch circles as placed, by wheel
    Raises `GearTrainError` where no such wheel can be cut.
    """
    law = mesh.law
    pins = _pins(mesh, train)
    found = {}
    for gear, wheel in enumerate(mesh.wheels, 1):
        tooth, design = _tooth(law.pair, gear, pins)
        scale = distance / float(getattr(law, "distance", design)) / radii[wheel]
        points = tuple((r * scale, angle) for r, angle in tooth)
        found[wheel] = Profile(mesh.form, points, pins is not None and pins.gear == gear)
    return found


@lru_cache(maxsize=256)
def _tooth(pair: Pair, gear: int, pins: Pins | None) -> tuple[Points, float]:
    """A tooth in modules, and the centre distance it is made for."""
    from geartrain.outlines import Cut as Sizes
    from geartrain.outlines import outline

    if pins is not None and pins.gear == gear:
        return _pin(pins), abs(pair.path.pitch.R1 + pair.path.pitch.R2)
    wheel = outline(pair, gear, Sizes(tolerance=_CHORD), pins)
    return _first(wheel, wheel.contours[1 if wheel.kind == "ring" else 0]), wheel.centre_distance


def _first(wheel: Cut, contour: Contour) -> Points:
    """The first tooth of a wheel, from the middle of a space to the middle of the next."""
    half = pi / wheel.z
    points: list[tuple[float, float]] = contour.flattened(_CHORD).tolist()
    # an outline runs round from the root of its first tooth, which stands about the x axis
    tooth = points[: len(points) // wheel.z + 1]
    chord = _CHORD
    while len(thin := _thinned(tooth, chord)) > _MOST - 2:
        chord *= 2
    inside = [(r, angle) for r, angle in (polar(x, y) for x, y in thin) if abs(angle) < half * (1 - 1e-9)]
    return ((wheel.root_radius, -half), *inside, (wheel.root_radius, half))


def _thinned(points: list[tuple[float, float]], chord: float) -> list[tuple[float, float]]:
    """The fewest of the points, both ends kept, whose chords leave none of the others farther away than `chord`."""
    if len(points) < 3:
        return points
    (x, y), (X, Y) = points[0], points[-1]
    along = hypot(X - x, Y - y) or 1.0
    off = [abs((X - x) * (v - y) - (Y - y) * (u - x)) / along for u, v in points]
    far = max(range(len(points)), key=off.__getitem__)
    if off[far] <= chord:
        return [points[0], points[-1]]
    return _thinned(points[: far + 1], chord)[:-1] + _thinned(points[far:], chord)


def _pin(pins: Pins) -> Points:
    """Round a pin on the x axis."""
    turns = [2 * pi * at / _PIN for at in range(_PIN)]
    return tuple(polar(pins.circle + pins.radius * cos(turn), pins.radius * sin(turn)) for turn in turns)


def _pins(mesh: ConjugateMesh, train: Train) -> Pins | None:
    """Which wheel is the lantern, and its pins in modules."""
    from geartrain.outlines import Pins
    from geartrain.teeth.lantern import Lantern
    from geartrain.teeth.shape import Wheels

    form = mesh.gear.tooth_form or train.tooth_form
    if not isinstance(form, Lantern):
        return None
    pitch = mesh.law.path.pitch
    wheels = Wheels(pitch.z1, pitch.z2, module=_module(mesh, train))
    radius = abs(pitch.R1 if form.pins == 1 else pitch.R2)
    if form.pin_radius is not None:
        radius = wheels.modules(form.pin_radius, "pin_radius")
    return Pins(form.pins, radius, wheels.modules(form.pin_diameter, "pin_diameter") / 2)


def _module(mesh: ConjugateMesh, train: Train) -> float | None:
    """Mean module (m) of the wheels of a pair; None unless both declare one with a unit."""
    wheels = [train.wheels[name][1] for name in mesh.gear.pair]
    sizes = [wheel.module.si * (wheel.count or 0) for wheel in wheels if wheel.module and wheel.module.unit]
    return sum(sizes) / sum(wheel.count or 0 for wheel in wheels) if len(sizes) == 2 else None
