"""How big a wheel is: pitch circle, rim and the room it needs; cones, crown wheels and worms where axes are not
parallel.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, cos, sin, tan

from geartrain.numerics.vectors import Vector, across, cross, dot, plus, size, unit
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PitchContact
from geartrain.scene.layout.wheel_modules import WheelModules
from geartrain.teeth.standard_teeth import DEDENDUM

_TIP = DEDENDUM  # modules beyond the pitch circle that are kept free: a tooth, and clearance
_RING = 3.5  # modules of a ring's rim
_WIDE = 2.5  # modules of a wheel's thickness
_SHELF = 1.4  # thicknesses from shelf to shelf
_WORM = 12.0  # modules of a worm's length


@dataclass(frozen=True, slots=True)
class WheelSize:
    """Sizes of a wheel (mm).

    inner, outer   within `inner`, all is free inside a ring; `outer` is the radius it needs
    shelf          its middle over that of the lowest wheel of its level, where that has shelves
    """

    radius: float
    module: float
    thickness: float
    inner: float
    outer: float
    shelf: float = 0.0

    def on(self, low: int, high: int) -> WheelSize:
        """The same wheel, as broad as it must be to stand on some shelves."""
        step = _SHELF * self.thickness
        broad = (high - low) * step + self.thickness
        return replace(self, thickness=broad, shelf=(low + high) / 2 * step)

    @property
    def foot(self) -> float:
        """How far the middle of a wheel on the lowest of its shelves is under its own (mm)."""
        return (self.thickness - _WIDE * self.module) / 2


def find_sizes(reading: DeclaredGeometry, scales: WheelModules) -> dict[str, WheelSize]:
    """Sizes of all wheels."""
    found = {}
    for wheel, (_, kind) in reading.wheels.items():
        module = scales.module[wheel]
        radius = float(reading.size(wheel)) * module
        thickness = (_WORM if kind.kind == "worm" else _WIDE) * module
        inner, outer = (
            (radius - _TIP * module, radius + _RING * module) if kind.internal else (0.0, radius + _TIP * module)
        )
        found[wheel] = WheelSize(radius, module, thickness, max(inner, 0.0), outer)
    return found


@dataclass(frozen=True, slots=True)
class Seat:
    """Where a wheel of a crossing pair sits.

    far     way (mm) along its axis' direction from the point where the axes meet, or pass nearest, to its centre
    cone    half angle of its pitch cone (rad); `out`, unit vector across its axis to the pitch point
    """

    far: float
    cone: float
    out: Vector


def seats(reading: DeclaredGeometry, touch: PitchContact, radii: tuple[float, float]) -> tuple[Seat, Seat]:
    """The seats of both wheels of a pair, its first and second, from the declared directions and sides.

    The pitch point lies on the side to which both wheels face. Bevel: tan d_1 = sin S / (z_2/z_1 + cos S) with the
    shaft angle S between the ways n_i = f_i u_i from the apex to the wheels. Crown: the pinion's pitch cylinder rolls
    on a cone of half angle S, a plane where S is a right angle.
    """
    if touch.kind == "screw":
        out = screw_way(reading, touch)
        return Seat(0.0, 0.0, out), Seat(0.0, 0.0, plus((0.0, 0.0, 0.0), out, -1.0))
    facing = tuple(reading.wheels[wheel][1].facing for wheel in touch.wheels)
    n, m = (plus((0.0, 0.0, 0.0), reading.lines[end].way, side) for end, side in zip(touch.axes, facing, strict=True))
    sine, cosine = size(cross(n, m)), dot(n, m)
    first, second = radii
    ways = unit(across(m, n)), unit(across(n, m))
    if touch.kind == "crown":
        reach = (first + second * cosine) / sine
        return (
            Seat(facing[0] * (second * sine + reach * cosine), atan2(sine, cosine), ways[0]),
            Seat(facing[1] * reach, 0.0, ways[1]),
        )
    cones = tuple(atan2(sine * mine, other + mine * cosine) for mine, other in (radii, radii[::-1]))
    return (
        Seat(facing[0] * first / tan(cones[0]), cones[0], ways[0]),
        Seat(facing[1] * second / tan(cones[1]), cones[1], ways[1]),
    )


def screw_way(reading: DeclaredGeometry, touch: PitchContact) -> Vector:
    """Unit vector from a worm's axis to its wheel's; where no positions say it, the side on which a right-hand worm
    reverses."""
    worm, wheel = (reading.lines[end] for end in touch.axes)
    way = unit(cross(wheel.way, worm.way))
    if worm.given is not None and wheel.given is not None:
        apart = dot(
            (wheel.given[0] - worm.given[0], wheel.given[1] - worm.given[1], wheel.given[2] - worm.given[2]), way
        )
        return way if apart >= 0 else plus((0.0, 0.0, 0.0), way, -1.0)
    return way


def rim(cone: float, radius: float, width: float) -> tuple[float, float]:
    """How far (mm) a wheel's rim reaches along its axis from its pitch circle, towards the apex and away from it."""
    if not cone:
        return width / 2, width / 2
    lip = width / 4 * sin(cone)
    return min(width * abs(cos(cone)) + lip, radius + width), lip
