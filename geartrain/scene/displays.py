"""Road wheels, a pointing figure, and the kind of drive of a train.

A figure or a road wheel is part of the link of an output. Its size is chosen for the picture: two road wheels on one
axis have a track equal to their diameter, and a single road wheel extends below all gear wheels.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import cos, pi, sin
from typing import TYPE_CHECKING, Literal

from geartrain.numerics.vectors import Vector, across, beside, dot, minus, plus, scaled, size
from geartrain.scene.coupling_shapes import circle
from geartrain.scene.dial_pointers import facing, train_width
from geartrain.scene.elements import ScenePart

if TYPE_CHECKING:
    from geartrain.scene.context import SceneContext

_ABOVE = ("above", "top")
_HEIGHT = 0.75  # height of a figure divided by the width of the train
_STAND = 8.0  # mm from the wheels to the feet of a figure, more than a plate
# heights and radii of its robe, head and hat over its height
_ROBE = (
    (0, 0.15), (0.04, 0.15), (0.3, 0.11), (0.48, 0.09), (0.52, 0.1), (0.68, 0.13), (0.74, 0.11), (0.78, 0.045),
    (0.8, 0.05), (0.84, 0.07), (0.88, 0.075), (0.91, 0.07), (0.93, 0.1), (0.94, 0.1), (0.95, 0.06), (1, 0.02),
)  # fmt: skip
_ARM = ((0.0, 0.45, 0.035), (0.45, 0.5, 0.045), (0.5, 0.62, 0.015))  # from, to, radius over height
_SHOULDER = 0.58  # height of the arm over the height of a figure
_ROD = 0.02
_CLEAR = 1.12  # distance of the ground from an axle, divided by the reach of the train below it
_SPOKES, _HUB, _FELLOE, _SPOKE = 12, 0.17, 0.86, 0.1  # radii over that of a road wheel; width of a spoke over a pitch
_TYRE = 0.1  # thickness of a road wheel divided by its radius


def drive_kind(stage: SceneContext) -> Literal["hand", "motor", "spring", "weight"]:
    """Return the kind of the declared drive; by default `motor` if the input speed is in real time, `hand` if not."""
    drive = stage.case.drive
    declared = stage.train.declaration
    if drive is None:
        return "motor" if declared.unit is None and declared.input_unit else "hand"
    return next((kind for kind in ("hand", "spring", "weight") if kind == drive.kind), "motor")


def fusee_radii(stage: SceneContext) -> tuple[float, ...]:
    """Return the radii of the fusee [mm] at equally spaced angles from its start to its end; empty without a fusee."""
    spring = stage.case.drive.spring if stage.case.drive is not None else None
    chained = None if spring is None else spring.chained
    if chained is None:
        return ()
    steps = 24
    return tuple(1000 * chained.state(chained.angle * at / steps)[1] for at in range(steps + 1))


def upwards(stage: SceneContext) -> Vector:
    """Return the unit vector that points up: y, or the direction towards the observer in a view from above."""
    return stage.near if stage.train.declaration.view.from_ in _ABOVE else (0.0, 1.0, 0.0)


def find_displays(stage: SceneContext) -> Iterator[ScenePart]:
    """Yield the parts of the pointing figures and of the road wheels of all outputs."""
    frame = stage.train.declaration.frame
    for name, output in stage.outputs.items():
        if output.hand == "figure":
            yield from _figure(stage, name, output.links(name, frame)[0])
        elif output.hand == "wheel":
            yield from _road_wheel(stage, name, output.links(name, frame)[0])


def _part(stage: SceneContext, link: str, name: str, at: Vector, way: Vector, **shape: object) -> ScenePart:
    kind = name.rpartition(" ")[2]
    return ScenePart(stage.body[link], name, kind, at, way, beside(way), **shape)  # type: ignore[arg-type]


def _figure(stage: SceneContext, name: str, link: str) -> Iterator[ScenePart]:
    """Yield the parts of a figure that points to a direction: a body, an outstretched arm, and a rod as its axis."""
    up, point = facing(stage, name), _origin(stage, link)
    feet = _reach(stage, point, up)[0] + _STAND
    high = _HEIGHT * train_width(stage)
    bands = [(high * low, high * top, high * (r + s) / 2, 0.0) for (low, r), (top, s) in pairwise(_ROBE)]
    yield _part(stage, link, f"{name} figure", plus(point, up, feet), up, bands=bands)
    arm = [(high * low, high * far, high * r, 0.0) for low, far, r in _ARM]
    shoulder = plus(point, up, feet + _SHOULDER * high)
    yield _part(stage, link, f"{name} figure", shoulder, beside(stage.reference(_axis(stage, link))), bands=arm)
    yield _part(stage, link, f"{name} shaft", point, up, bands=[(0.0, feet, _ROD * high, 0.0)])


def _road_wheel(stage: SceneContext, name: str, link: str) -> Iterator[ScenePart]:
    """Yield the parts of a spoked road wheel outside the train: the wheel, its hub and its axle."""
    point, axis = _origin(stage, link), stage.reference(_axis(stage, link))
    own = [place for place in stage.layout.wheels.values() if place.axis == _axis(stage, link) and place.link == link]
    mine = sum(dot(minus(place.centre, point), axis) for place in own)
    out = axis if mine >= 0 else scaled(axis, -1.0)
    (far, below), back = _reach(stage, point, out), _reach(stage, point, scaled(out, -1.0))[0]
    radius = _CLEAR * below
    away = far + _STAND + _TYRE * radius
    outputs = [output.links(other, "")[0] for other, output in stage.outputs.items() if output.hand == "wheel"]
    if sum(_axis(stage, other) == _axis(stage, link) for other in outputs) > 1:
        # a second road wheel: the track is the diameter, about the middle of the train
        radius = max(radius, ((far + back) / 2 + _STAND) / (1 - _TYRE))
        away = (far - back) / 2 + radius
    at = plus(point, out, away)
    lines = [_flat(circle(radius)), *(_flat(_window(radius, number)) for number in range(_SPOKES))]
    yield _part(stage, link, f"{name} road", at, out, outlines=lines, height=_TYRE * radius)
    hub = 0.9 * _HUB * radius
    yield _part(stage, link, f"{name} nave", at, out, bands=[(-1.1 * _TYRE * radius, 1.1 * _TYRE * radius, hub, 0.0)])
    start = mine / len(own) if own else 0.0
    yield _part(stage, link, f"{name} shaft", point, out, bands=[(abs(start), away, 0.3 * hub, 0.0)])


def _window(radius: float, number: int) -> list[tuple[float, float]]:
    """Return the outline of the opening between two spokes of a road wheel."""
    found, pitch = [], 2 * pi / _SPOKES
    for r, ways in ((_HUB * radius, (0, 1)), (_FELLOE * radius, (1, 0.75, 0.5, 0.25, 0))):
        aside = _SPOKE * pitch * _FELLOE * radius / r / 2  # spokes have parallel sides
        angles = [number * pitch + aside + way * (pitch - 2 * aside) for way in ways]
        found += [(r * cos(angle), r * sin(angle)) for angle in angles]
    return found


def _flat(points: list[tuple[float, float]]) -> list[float]:
    return [value for point in points for value in point]


def _axis(stage: SceneContext, link: str) -> str | None:
    return stage.train.kinematics.tree.axis(link)


def _origin(stage: SceneContext, link: str) -> Vector:
    place = stage.layout.axes.get(_axis(stage, link) or "")
    return (0.0, 0.0, 0.0) if place is None else place.point


def _reach(stage: SceneContext, point: Vector, way: Vector) -> tuple[float, float]:
    """Return how far the wheels extend along `way` from a point, and across `way` from a line through it [mm]."""
    along, aside = [], []
    for place in stage.layout.wheels.values():
        slope = size(across(stage.along(place.axis), way))
        along.append(dot(minus(place.centre, point), way) + place.radius * slope + place.thickness / 2)
        aside.append(size(across(minus(place.centre, point), way)) + place.radius)
    return max(along, default=0.0), max(aside, default=10.0)
