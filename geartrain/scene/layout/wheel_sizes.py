"""How big a wheel is: pitch circle, rim and the room it needs; and where wheels sit whose axes are not parallel.

`SizedGeometry` is what all placements work on: the declared geometry, its modules, sizes, and seats of crossing pairs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import atan2, tan

from geartrain.numerics.vectors import Vector, across, cross, dot, minus, size, unit
from geartrain.scene.layout.declared_geometry import ContactSide, DeclaredGeometry, PitchContact
from geartrain.scene.layout.wheel_modules import WheelModules, find_wheel_modules
from geartrain.teeth.standard_teeth import DEDENDUM

_TIP = DEDENDUM  # modules beyond the pitch circle that are kept free: a tooth, and clearance
_RING = 3.5  # modules of a ring's rim
WIDE = 2.5  # modules of a wheel's thickness
_SLOT = 1.4  # thicknesses from slot to slot
_WORM = 12.0  # modules of a worm's length


@dataclass(frozen=True, slots=True)
class Seat:
    """Where a wheel of a crossing pair sits.

    far    way (mm) along its axis' direction from the point where the axes meet, or pass nearest, to its centre
    cone   half angle of its pitch cone (rad)
    out    unit vector across its axis to the pitch point
    """

    far: float
    cone: float
    out: Vector


def seats(geometry: DeclaredGeometry, contact: PitchContact, radii: tuple[float, float]) -> tuple[Seat, Seat]:
    """The seats of both wheels of a pair, its first and second, from the declared directions and sides.

    The pitch point lies on the side to which both wheels face. Bevel: tan d_1 = sin S / (z_2/z_1 + cos S) with the
    shaft angle S between the ways n_i = f_i u_i from the apex to the wheels. Crown: the pinion's pitch cylinder rolls
    on a cone of half angle S, a plane where S is a right angle.
    """
    if contact.kind == "screw":
        out = _from_worm(geometry, contact)
        return Seat(0.0, 0.0, out), Seat(0.0, 0.0, opposite(out))
    facing, other_facing = (geometry.wheel(wheel).facing for wheel in contact.wheels)
    first_way, second_way = (geometry.lines[axis].direction for axis in contact.axes)
    n = first_way if facing > 0 else opposite(first_way)
    m = second_way if other_facing > 0 else opposite(second_way)
    sine, cosine = size(cross(n, m)), dot(n, m)
    first, second = radii
    out, other_out = unit(across(m, n)), unit(across(n, m))
    if contact.kind == "crown":
        reach = (first + second * cosine) / sine
        return (
            Seat(facing * (second * sine + reach * cosine), atan2(sine, cosine), out),
            Seat(other_facing * reach, 0.0, other_out),
        )
    cone = atan2(sine * first, second + first * cosine)  # not atan: beyond a right angle the cosine is negative
    other_cone = atan2(sine * second, first + second * cosine)
    return (
        Seat(facing * first / tan(cone), cone, out),
        Seat(other_facing * second / tan(other_cone), other_cone, other_out),
    )


def opposite(v: Vector) -> Vector:
    """A vector turned round; from zero, so that no part becomes -0.0, which pictures would write."""
    return minus((0.0, 0.0, 0.0), v)


def _from_worm(geometry: DeclaredGeometry, contact: PitchContact) -> Vector:
    """Unit vector from a worm's axis to its wheel's; where no positions say it, the side on which a right-hand worm
    reverses."""
    worm, wheel = (geometry.lines[axis] for axis in contact.axes)
    way = unit(cross(wheel.direction, worm.direction))
    if worm.given is not None and wheel.given is not None and dot(minus(wheel.given, worm.given), way) < 0:
        return opposite(way)
    return way


@dataclass(frozen=True, slots=True)
class WheelSize:
    """Sizes of a wheel (mm).

    radius      of its pitch circle
    module      transverse: its diameter over tooth count
    thickness   of its rim along the axis
    inner       within it all is free inside a ring; 0 of other wheels
    outer       the radius it needs
    slot        its middle over that of the lowest wheel of its level, where that is divided into slots
    plain       its thickness were it not broad enough to meet several mates
    """

    radius: float
    module: float
    thickness: float
    inner: float
    outer: float
    slot: float = 0.0
    plain: float = 0.0

    def across_slots(self, low: int, high: int) -> WheelSize:
        """The same wheel, as broad as it must be to stand in some slots, counted from below."""
        step = _SLOT * self.thickness
        broad = (high - low) * step + self.thickness
        return replace(self, thickness=broad, slot=(low + high) / 2 * step)

    @property
    def foot(self) -> float:
        """How far the middle of a wheel in the lowest of its slots is under its own (mm)."""
        return (self.thickness - self.plain) / 2


@dataclass(frozen=True, slots=True)
class CrossingSide:
    """A pair whose axes are not parallel, as one of its wheels sees it, with the seats of both."""

    contact: PitchContact
    side: ContactSide
    seat: Seat
    mate_seat: Seat


@dataclass(frozen=True)
class SizedGeometry:
    """The declared geometry with sizes.

    crossing   each pair whose axes are not parallel, twice: as its first wheel sees it, and as its second
    """

    declared: DeclaredGeometry
    modules: WheelModules
    sizes: Mapping[str, WheelSize]
    crossing: tuple[CrossingSide, ...]

    @cached_property
    def seats(self) -> Mapping[tuple[str, str], Seat]:
        """Seats by pair and wheel."""
        return {(each.contact.name, each.side.wheel): each.seat for each in self.crossing}


def size_geometry(declared: DeclaredGeometry) -> SizedGeometry:
    """Modules, sizes and seats of all wheels."""
    modules = find_wheel_modules(declared)
    sizes = {
        wheel: _size(declared, wheel, modules.module[wheel], wheel in modules.declared) for wheel in declared.wheels
    }
    crossing: list[CrossingSide] = []
    for contact in declared.contacts:
        if not contact.parallel:
            radii = sizes[contact.wheels[0]].radius, sizes[contact.wheels[1]].radius
            first, second = seats(declared, contact, radii)
            crossing.append(CrossingSide(contact, contact.sides[0], first, second))
            crossing.append(CrossingSide(contact, contact.sides[1], second, first))
    return SizedGeometry(declared, modules, sizes, tuple(crossing))


def _size(geometry: DeclaredGeometry, wheel: str, module: float, is_given: bool) -> WheelSize:
    declared = geometry.wheel(wheel)
    radius = float(geometry.radius(wheel)) * module
    usual = (_WORM if declared.kind == "worm" else WIDE) * module
    # of a wheel that may have any size a thickness says nothing
    thickness = geometry.thickness.get(wheel, usual) if is_given else usual
    across_axis = module * declared.slant
    if declared.internal:
        inner, outer = max(radius - _TIP * module, 0.0), radius + _RING * module
    else:
        inner, outer = 0.0, radius + max(_TIP, geometry.discs.get(wheel, 0.0)) * module
    return WheelSize(radius, across_axis, thickness, inner, outer, plain=thickness)
