"""From a train to its layout."""

from __future__ import annotations

from collections.abc import Mapping

from geartrain.analysis.gear_train import GearTrain
from geartrain.numerics.vectors import Vector, across, dot, minus, plus, size, unit
from geartrain.scene.layout.axis_places import AxisPlace, How, Layout, WheelPlace
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PitchContact, read_geometry
from geartrain.scene.layout.layout_diagnostics import misfits, notices
from geartrain.scene.layout.mesh_alignment import PitchPoint, align_meshes, pitch_point, reference
from geartrain.scene.layout.parallel_groups import Arrangement, Arranger
from geartrain.scene.layout.wheel_geometry import Seat, WheelSize, find_sizes
from geartrain.scene.layout.wheel_modules import WheelModules, find_wheel_modules

_FRONT = {"front": 0, "back": 1}


def lay_out(train: GearTrain) -> Layout:
    """Places of all axes and wheels of a train: the same for the same declaration, and for every train that loads.

    Declared positions, modules and offsets of pins always hold. What is left open is found so that pitch circles
    touch, wheels of one level keep apart and the plan is compact; `notices` tell what could not be met. The time grows
    with the square of the number of axes: a quarter of a second for 70 wheels, a second for 1000 axes.
    """
    reading = read_geometry(train)
    scales = find_wheel_modules(reading)
    sizes = find_sizes(reading, scales)
    front = -1 if train.declaration.view.positive == "clockwise" else 1
    found = Arranger(reading, scales, sizes, _ends(train, front), _first(train)).arrange()
    turns, misses = align_meshes(_contact(train, reading, found, touch) for touch in reading.touches)
    layers, coned = _layers(reading, sizes, found), _seats(reading, found)
    wheels = {
        wheel: _wheel(
            reading, scales, sizes[wheel], found, wheel, turns.get(wheel, 0.0), coned.get(wheel), layers.get(wheel)
        )
        for wheel in reading.wheels
    }
    tied = {label for pair in (*scales.distances, *(touch.axes for touch in reading.touches)) for label in pair}
    axes = {label: _axis(reading, found, label, label in tied) for label in reading.lines}
    apart = misfits(reading, found, sizes)
    told = tuple(notices(train, reading, found, apart, misses))
    return Layout(axes, wheels, told, front, apart)


def _first(train: GearTrain) -> str | None:
    """The axis of the first input, which gets the origin where no position is declared."""
    return next((train.tree.axis(link) for case in train.declaration.cases for link in case.inputs), None)


def _ends(train: GearTrain, front: int) -> dict[str, tuple[bool, bool]]:
    """Links that run out of the stack to a dial: whether at its low end, and at its high one."""
    found: dict[str, tuple[bool, bool]] = {}
    for case in train.declaration.cases:
        for name, output in case.outputs.items():
            dial = train.declaration.dials.get(output.dial or "")
            if dial is None or dial.face not in _FRONT:
                continue
            link = output.of or name
            high = (front > 0) == (dial.face == "front")
            low_too, high_too = found.get(link, (False, False))
            found[link] = (low_too or not high, high_too or high)
    return found


def _contact(train: GearTrain, reading: DeclaredGeometry, found: Arrangement, touch: PitchContact) -> PitchPoint:
    ways = reading.lines[touch.axes[0]].way, reading.lines[touch.axes[1]].way
    counts = tuple(reading.wheels[wheel][1].count or 1 for wheel in touch.wheels)
    turned = 0
    if touch.kind in ("side", "ring"):
        outs = _side_by_side(reading, found, touch)
    else:
        outs = found.seats[touch.name][0].out, found.seats[touch.name][1].out
    if touch.kind == "screw":
        turned = _worm_sense(train, touch)
    return pitch_point(touch.name, touch.wheels, counts, ways, outs, turned)  # type: ignore[arg-type]


def _side_by_side(reading: DeclaredGeometry, found: Arrangement, touch: PitchContact) -> tuple[Vector, Vector]:
    """Towards each other, but away from the axis of a wheel that runs in a ring."""
    way = reading.lines[touch.axes[0]].way
    apart = across(minus(found.points[touch.axes[1]], found.points[touch.axes[0]]), way)
    out = unit(apart) if size(apart) else reference(way)
    back = plus((0.0, 0.0, 0.0), out, -1.0)
    rings = [reading.wheels[wheel][1].internal for wheel in touch.wheels]
    return back if rings[1] else out, out if rings[0] else back


def _worm_sense(train: GearTrain, touch: PitchContact) -> int:
    """A worm turns no pitch point sideways: how its thread moves follows from the pair's equation."""
    circuit = next(each for each in train.circuits if each.id == touch.name)
    flip = 1
    for link, axis in zip((circuit.i, circuit.j), _ordered(circuit.wheels, touch), strict=True):
        flip *= train.signs.get(link, 1) if train.tree.axis(link) == axis else 1
    return (-1 if circuit.a * circuit.b > 0 else 1) * flip


def _ordered(wheels: tuple[str, str], touch: PitchContact) -> tuple[str, str]:
    return touch.axes if wheels == touch.wheels else (touch.axes[1], touch.axes[0])


def _axis(reading: DeclaredGeometry, found: Arrangement, label: str, tied: bool) -> AxisPlace:
    line = reading.lines[label]
    how: How = "given" if line.given else "found" if tied else "free"
    return AxisPlace(label, found.points[label], line.way, how, line.bearers[0])


def _wheel(
    reading: DeclaredGeometry,
    scales: WheelModules,
    sized: WheelSize,
    found: Arrangement,
    wheel: str,
    turn: float,
    seat: Seat | None,
    layer: int | None,
) -> WheelPlace:
    link, kind = reading.wheels[wheel]
    axis = reading.axis[wheel]
    way = reading.lines[axis].way if axis else (0.0, 0.0, 1.0)
    cone = seat.cone if seat else 0.0
    return WheelPlace(
        wheel,
        link,
        axis,
        found.centres[wheel],
        sized.radius,
        sized.module,
        sized.thickness,
        wheel in scales.declared,
        cone,
        kind.facing if cone else 0,
        layer,
        turn,
        reference(way),
    )


def _seats(reading: DeclaredGeometry, found: Arrangement) -> dict[str, Seat]:
    """The seat of each wheel that has a cone; a wheel that also meshes about a parallel axis has none."""
    straight = {wheel for touch in reading.touches if touch.kind in ("side", "ring") for wheel in touch.wheels}
    return {
        wheel: seat
        for touch in reading.touches
        if touch.name in found.seats
        for wheel, seat in zip(touch.wheels, found.seats[touch.name], strict=True)
        if wheel not in straight
    }


def _layers(reading: DeclaredGeometry, sizes: Mapping[str, WheelSize], found: Arrangement) -> dict[str, int]:
    """Numbers of levels of the wheels on the main axes, from below; a broad wheel counts where it begins."""
    heights = {
        wheel: dot(found.centres[wheel], found.up) - sizes[wheel].foot
        for wheel, axis in reading.axis.items()
        if axis and reading.lines[axis].group == found.main
    }
    levels: list[float] = []
    layers = {}
    for wheel, height in sorted(heights.items(), key=lambda each: each[1]):
        if not levels or height - levels[-1] > 1e-6 * sizes[wheel].thickness:
            levels.append(height)
        layers[wheel] = len(levels) - 1
    return layers
