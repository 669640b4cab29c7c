"""Eccentrics, circles of pins in plates, and the cups of strain waves.

An eccentric is a round disc, off centre on an arbor, on which a carried wheel turns. It replaces a stud if the carried
axis is so close to the axis of its carrier that a wheel on the carried axis surrounds both axes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import cos, dist, sin

import numpy as np

from geartrain.errors import Problem
from geartrain.scene.parts.arbor_columns import HEAD, SHAKE, USUAL
from geartrain.scene.parts.carried_axes import BOSS, NEAREST, WIDEST, CarriedAxis, CarrierSeat, gap_beside, plate_seat
from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.fixed_teeth import bent_line

# ----------------------------------------------------------------------------------------------------------------- cups


KIND = "wall"
"""Kind of the wall of a cup, as named in the parts list."""


@dataclass(frozen=True, slots=True)
class FlexibleCup:
    """Wall that connects a flexible wheel to another link, which forms the bottom of the cup."""

    name: str
    """Name of the coupling that makes the wheel and the bottom of the cup turn at equal speeds."""
    link: str
    """Link that forms the bottom of the cup; `slot` is the link of the wheel."""
    slot: str
    wheel: str
    at: Point
    """Position of the cup's axis in the stack [mm]."""
    reach: float
    """Outer radius of the wall [mm]; `wall` is the thickness of the wall [mm]."""
    wall: float

    def part(self, plate: tuple[float, float], wheel: StackDisc) -> TurnedPart:
        """Return the wall of the cup as a turned part, from the face of the wheel to the bottom."""
        low, high = (wheel.high, plate[0]) if plate[0] > wheel.middle else (plate[1], wheel.low)
        band = Band(low, high, self.reach, self.reach - self.wall)
        return TurnedPart(self.link, f"{self.link} wall", KIND, self.at, (band,), f"one piece with {self.wheel}")

    def notices(self) -> Iterator[Problem]:
        """Yield a notice that the wheel and its wall cannot be cut from sheet."""
        what = f"'{self.wheel}' and the wall of '{self.link}' are one thin part, which cannot be cut from sheet"
        why = f"a wave generator deforms it, and its wall is {self.wall:.3g} mm thick"
        solids = f"wheels/{self.wheel}.stl and {self.link} wall in assembly.stl"
        fix = f"make it on a lathe, or print it in a flexible material, from {solids}"
        yield Problem(what, why, fix)


# ----------------------------------------------------------------------------------------------------------- eccentrics


WALL = 1.5  # mm: normal wall of an eccentric beside its arbor, and of a wheel beside a hole
USUAL_ARBOR = 6.0
"""Default diameter of an arbor with an eccentric [mm]."""
_THIN = 0.6  # mm: minimum wall of an eccentric beside its arbor
ROOM = SHAKE / 2 + HEAD
"""Axial space that is reserved for a washer next to a wheel [mm]."""
_POINTS = 1440  # points of the outline of a wave generator
_OVER = 1.0  # mm by which a washer extends beyond its eccentric


@dataclass(frozen=True, slots=True)
class Wave:
    """Strain wave of a flexible wheel: amplitude [mm], number of lobes, and wall thickness of the wheel [mm]."""

    rise: float
    lobes: int
    wall: float
    towards: float
    """Angle of the first lobe, in the plane of the stack [rad]."""
    length: float
    """Length of the cup wall that is attached to the wheel [mm]."""


@dataclass(frozen=True, slots=True)
class Eccentric:
    """Round disc off centre on an arbor, on which wheels turn, or the wave generator of a strain wave gear."""

    name: str
    link: str
    axis: str
    at: Point
    """Position of the arbor in the stack [mm]."""
    centre: Point
    """Centre of the disc [mm]."""
    radius: float
    """Radius of the disc [mm]."""
    wheels: tuple[str, ...]
    carried: str
    """Label of the axis about which the wheels in `wheels` turn."""
    middle: float = 0.0
    """Radius of the central hole in wheels that turn on several eccentrics [mm]; 0 if they turn only on this one."""
    coupling: str = ""
    """Name of the coupling by parallel cranks of which the eccentric is a part; empty for other eccentrics."""
    wave: Wave | None = None
    """Strain wave, if the eccentric is a wave generator; None for a round disc."""

    @property
    def offset(self) -> float:
        """Distance between the axis of the arbor and the axis of the disc [mm]."""
        return dist(self.at, self.centre)

    @property
    def wall(self) -> float:
        """Distance from the arbor's axis to the nearest point of the eccentric's edge [mm]."""
        return self.radius - self.rise

    @property
    def rise(self) -> float:
        """Amplitude of the radius of the eccentric's edge about the arbor's axis [mm]."""
        return self.offset if self.wave is None else self.wave.rise

    @property
    def edge(self) -> Contour:
        """Outline of the eccentric in the plane of the stack [mm]."""
        if self.wave is None:
            return Contour.circle(self.radius, self.centre)
        wave, half = self.wave, self.wave.wall / 2
        turn = 2 * np.pi * np.arange(_POINTS) / _POINTS
        bore = self.radius * np.column_stack([np.cos(turn), np.sin(turn)])
        points = bent_line(bore, self.radius + half, (wave.rise, wave.lobes))
        c, s = cos(wave.towards), sin(wave.towards)
        return Contour(points @ np.array([[c, s], [-s, c]]) + np.array(self.centre), np.zeros(_POINTS))

    def turning(self, discs: Iterable[StackDisc]) -> list[StackDisc]:
        """Return the discs that turn on the eccentric."""
        return [disc for disc in discs if disc.name in self.wheels]

    def disc(self, discs: Iterable[StackDisc], carrier: Point | None) -> StackDisc:
        """Return a cylinder that contains the eccentric and its washers in all positions.

        discs     discs of all wheels
        carrier   position of the axis about which the arbor is carried, or None
        """
        own = self.turning(discs)
        low, high = min(disc.low for disc in own) - ROOM, max(disc.high for disc in own) + ROOM
        reach, high = self.rise + self.radius, high + (0.0 if self.wave is None else self.wave.length)
        root = 2 * (self.wall - WALL) / USUAL  # chosen so that the default arbor leaves that wall
        return StackDisc(self.name, self.link, self.axis, self.at, low, high, reach, 0.0, root, True, carrier)

    def washers(self, disc: StackDisc, bore: float) -> Iterator[TurnedPart]:
        """Yield a washer on the arbor at each side of the wheels, except for a flexible wheel, which has a cup wall."""
        if self.wave is not None:
            return
        radius = max(self.radius, self.wall + _OVER)
        for number, (low, high) in enumerate(((disc.low, disc.low + HEAD), (disc.high - HEAD, disc.high)), 1):
            name, ring = f"{self.name} washer {number}", Band(low, high, radius, bore / 2)
            yield TurnedPart(self.link, name, "collar", self.at, (ring,), "on the arbor, beside its eccentric")

    def faces(self, disc: StackDisc) -> tuple[float, float]:
        """Return the heights of the faces of the eccentric [mm]: between its washers, or below the wall of a cup."""
        if self.wave is not None:
            return disc.low + ROOM, disc.high - ROOM - self.wave.length - SHAKE
        return disc.low + HEAD, disc.high - HEAD


def eccentric_radius(offset: float, arbor: float | None, free: float) -> float:
    """Return the radius of an eccentric [mm] on an arbor.

    offset   distance from the arbor's axis to the centre of the eccentric [mm]
    arbor    given diameter of the arbor [mm], or None
    free     radius of the free space around the centre of the eccentric [mm]
    """
    wanted = offset + (USUAL_ARBOR if arbor is None else arbor) / 2 + WALL
    return round(min(wanted, free - WALL), 2)


def too_thin(eccentric: Eccentric, arbor: float) -> Problem | None:
    """Return a problem if an eccentric is too thin for an arbor of the diameter `arbor` [mm]; None if it is not."""
    beside = eccentric.wall - arbor / 2
    if beside >= _THIN:
        return None
    what = f"'{eccentric.name}' leaves a wall of only {beside:.3g} mm around its arbor"
    radius, offset = eccentric.radius, eccentric.offset
    why = f"its radius is {radius:g} mm, and its arbor has a diameter of {arbor:g} mm and is {offset:g} mm off centre"
    return Problem(what, why, "use a smaller --bore, a larger module, or pins farther from the centre")


def on_eccentrics(discs: Sequence[StackDisc], eccentrics: Sequence[Eccentric]) -> Iterator[StackDisc]:
    """Yield the discs of wheels, with holes in those that turn on eccentrics, then a disc for each eccentric."""
    for disc in discs:
        own = [each for each in eccentrics if disc.name in each.wheels]
        yield replace(disc, inner=own[0].middle or own[0].radius) if own else disc
    for each in eccentrics:
        carriers = {disc.carrier for disc in discs if disc.axis == each.axis}
        yield each.disc(discs, next(iter(carriers), None))


def running_hole(eccentric: Eccentric, process: Process) -> float:
    """Return the diameter of the hole in which an eccentric turns [mm]."""
    return 2 * eccentric.radius + process.running


# ------------------------------------------------------------------------------------------------------ circles of pins


_RIM = 2.0  # mm: width of plate round a pin


@dataclass(frozen=True, slots=True)
class PinCircle:
    """Declared circle of pins that move in round holes."""

    name: str
    """Name of the coupling to which the pins belong."""
    link: str
    """Link that carries the pins; `slot` is the link with the holes."""
    slot: str
    radius: float
    """Radius of the circle of pins [mm]; `pin` and `hole` are diameters [mm]."""
    pin: float
    hole: float

    @property
    def reach(self) -> float:
        """Radius of a plate that carries the pins [mm]."""
        return self.radius + self.pin / 2 + _RIM

    @property
    def free(self) -> float:
        """Distance from the axis of the disc with the holes to the nearest point of a hole [mm]."""
        return self.radius - self.hole / 2


@dataclass(frozen=True, slots=True)
class StandingPins:
    """Pins of one link that are fixed in a plate and extend into a wheel, such as the pins of a ring."""

    name: str
    link: str
    seat: str
    """Turning plate in which the pins are fixed; empty if they are fixed in the nearer plate of the frame."""
    wheel: str
    """Wheel into which the pins extend, as far as its far face."""
    spots: tuple[Point, ...]
    """Centres of the pins in the plane of the stack [mm]; `radius` is the radius of a pin [mm]."""
    radius: float
    joined: bool = False
    """True if the pins are also fixed in the wheel, instead of moving in its holes."""

    def parts(self, plate: tuple[float, float], wheel: StackDisc, joint: str) -> Iterator[TurnedPart]:
        """Yield all pins, from the far face of their plate to the far face of the wheel."""
        band = Band(min(plate[0], wheel.low), max(plate[1], wheel.high), self.radius)
        through = (self.seat, wheel.name) if self.joined else (self.seat,)
        for number, at in enumerate(self.spots, 1):
            yield TurnedPart(self.link, f"{self.name} {number}", "pin", at, (band,), joint, through)


def pin_seats(
    circle: PinCircle | FlexibleCup,
    axis: str,
    at: Point,
    slots: Sequence[StackDisc],
    slab_gaps: Sequence[float],
    carried: Sequence[CarriedAxis] = (),
) -> list[CarrierSeat]:
    """Return the possible seats of a circle of pins on a plate next to the discs in `slots`, or of a cup on its bottom.

    The plate is above the discs, or on the side of the discs at which the plate carries axes.
    """
    low, high = min(disc.low for disc in slots), max(disc.high for disc in slots)
    others = [disc.middle for each in carried for disc in each.discs]
    below = bool(others) and sum(others) / len(others) < (low + high) / 2
    height = gap_beside(slab_gaps, low, -1) + NEAREST if below else gap_beside(slab_gaps, high, 1) - NEAREST
    name = f"{circle.link} {'carrier ' if carried else ''}plate"
    reach = max([circle.reach, *(dist(at, each.at) + BOSS + WIDEST for each in carried)])
    disc = StackDisc(name, circle.link, axis, at, 0.0, 0.0, reach)
    return [plate_seat(disc, height, tuple(each.label for each in carried), round_=True)]
