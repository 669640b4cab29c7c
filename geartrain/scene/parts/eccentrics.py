"""Eccentrics, circles of pins in plates, and the cups of strain waves.

An eccentric is a round disc on an arbor, off centre, on which a wheel turns that is carried round its own axis. An axis
that a link carries so near to its own that a wheel on it extends far round both cannot be a stud: the wheel has a hole
for an eccentric, and two washers keep it in place.

Circles of pins stand in a plate: those of a ring of pins, and those that work in round holes of a disc. The cup of a
strain wave is the wall that joins a thin wheel, which a wave bends, to the body that it turns.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import cos, dist, sin

import numpy as np

from geartrain.errors import Problem
from geartrain.scene.parts.arbor_columns import HEAD, SHAKE, USUAL
from geartrain.scene.parts.carried_axes import BOSS, NEAREST, WIDEST, CarriedAxis, CarrierSeat, TurningPlate, gap_beside
from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.fixed_teeth import bent_line

# ----------------------------------------------------------------------------------------------------------------- cups


KIND = "wall"
"""Of the part that it is."""


@dataclass(frozen=True, slots=True)
class FlexibleCup:
    """A thin wheel and the link of its cup."""

    name: str
    """Of the coupling that says that both turn alike."""
    link: str
    """With the bottom of the cup; `slot`, with the wheel."""
    slot: str
    wheel: str
    """Its name."""
    at: Point
    """Of the cup's axis across the stack (mm)."""
    reach: float
    """Outside radius of the wall; `wall`, how thick it is (mm)."""
    wall: float

    def part(self, plate: tuple[float, float], wheel: StackDisc) -> TurnedPart:
        """The wall, from the face of the wheel to the bottom."""
        low, high = (wheel.high, plate[0]) if plate[0] > wheel.middle else (plate[1], wheel.low)
        band = Band(low, high, self.reach, self.reach - self.wall)
        return TurnedPart(self.link, f"{self.link} wall", KIND, self.at, (band,), f"one piece with {self.wheel}")

    def told(self) -> Iterator[Problem]:
        """What no drawing can show of it."""
        what = f"'{self.wheel}' and the wall of '{self.link}' are one thin piece, which no sheet gives"
        why = f"a wave bends it: its wall is {self.wall:.3g} mm thick"
        fix = f"turn it, or print it of what bends, from wheels/{self.wheel}.stl and {self.link} wall in assembly.stl"
        yield Problem(what, why, fix)


# ----------------------------------------------------------------------------------------------------------- eccentrics


WALL = 1.5  # mm of an eccentric beside its arbor at least, and of a wheel beside a hole
USUAL_ARBOR = 6.0
"""Diameter of an arbor whose size nobody gives, in an eccentric [mm]."""
_THIN = 0.6  # mm of an eccentric beside its arbor, or it cannot be made
ROOM = SHAKE / 2 + HEAD
"""What a washer takes beside a wheel, along its axis [mm]."""
_POINTS = 1440  # of the edge of a wave
_OVER = 1.0  # mm that a washer is wider than its eccentric


@dataclass(frozen=True, slots=True)
class Wave:
    """The wave that bends a thin wheel: how far it rises (mm), how many lobes it has, and the wall of the wheel
    (mm)."""

    rise: float
    lobes: int
    wall: float
    towards: float
    """Angle of the first lobe across the stack (rad)."""
    length: float
    """Of the wall that joins the wheel to its cup (mm), for which there is room beside."""


@dataclass(frozen=True, slots=True)
class Eccentric:
    """A disc on the arbor of a link."""

    name: str
    """Its own, and whose it is."""
    link: str
    """Its own, and whose it is."""
    axis: str
    """Of the arbor, across the stack (mm)."""
    at: Point
    """Of the arbor, across the stack (mm)."""
    centre: Point
    """Of the disc (mm)."""
    radius: float
    """Of the disc (mm)."""
    wheels: tuple[str, ...]
    """That turn on it."""
    carried: str
    """Label of the axis on which these turn."""
    middle: float = 0.0
    """Radius (mm) of the hole in the middle of these, which turn on several; 0 where they turn on this alone."""
    coupling: str = ""
    """Of cranks side by side, which it is."""
    wave: Wave | None = None
    """What it bends, where it is no round disc."""

    @property
    def offset(self) -> float:
        """From the arbor's axis to that of the disc (mm)."""
        return dist(self.at, self.centre)

    @property
    def wall(self) -> float:
        """From the arbor's axis to the nearest point of its edge (mm)."""
        return self.radius - self.rise

    @property
    def rise(self) -> float:
        """How far its edge goes out and in (mm)."""
        return self.offset if self.wave is None else self.wave.rise

    @property
    def edge(self) -> Contour:
        """Across the stack."""
        if self.wave is None:
            return Contour.circle(self.radius, self.centre)
        wave, half = self.wave, self.wave.wall / 2
        turn = 2 * np.pi * np.arange(_POINTS) / _POINTS
        bore = self.radius * np.column_stack([np.cos(turn), np.sin(turn)])
        points = bent_line(bore, self.radius + half, (wave.rise, wave.lobes))
        c, s = cos(wave.towards), sin(wave.towards)
        return Contour(points @ np.array([[c, s], [-s, c]]) + np.array(self.centre), np.zeros(_POINTS))

    def turning(self, discs: Iterable[StackDisc]) -> list[StackDisc]:
        """Those of some discs that turn on it."""
        return [disc for disc in discs if disc.name in self.wheels]

    def disc(self, discs: Iterable[StackDisc], carrier: Point | None) -> StackDisc:
        """What it sweeps in the stack, with its washers."""
        own = self.turning(discs)
        low, high = min(disc.low for disc in own) - ROOM, max(disc.high for disc in own) + ROOM
        reach, high = self.rise + self.radius, high + (0.0 if self.wave is None else self.wave.length)
        root = 2 * (self.wall - WALL) / USUAL  # whose usual arbor leaves that wall
        return StackDisc(self.name, self.link, self.axis, self.at, low, high, reach, 0.0, root, True, carrier)

    def washers(self, disc: StackDisc, bore: float) -> Iterator[TurnedPart]:
        """One on either side of the wheels, on the same arbor; a thin wheel is held by its wall."""
        if self.wave is not None:
            return
        radius = max(self.radius, self.wall + _OVER)
        for number, (low, high) in enumerate(((disc.low, disc.low + HEAD), (disc.high - HEAD, disc.high)), 1):
            name, ring = f"{self.name} washer {number}", Band(low, high, radius, bore / 2)
            yield TurnedPart(self.link, name, "collar", self.at, (ring,), "on the arbor, beside its eccentric")

    def faces(self, disc: StackDisc) -> tuple[float, float]:
        """Of the eccentric itself: between its washers, or in a thin wheel below the wall of its cup."""
        if self.wave is not None:
            return disc.low + ROOM, disc.high - ROOM - self.wave.length - SHAKE
        return disc.low + HEAD, disc.high - HEAD


def eccentric_radius(offset: float, arbor: float | None, free: float) -> float:
    """Of an eccentric (mm) on an arbor, whose diameter may be given; from its middle `free` mm are free."""
    wanted = offset + (USUAL_ARBOR if arbor is None else arbor) / 2 + WALL
    return round(min(wanted, free - WALL), 2)


def too_thin(eccentric: Eccentric, arbor: float) -> Problem | None:
    """Why it cannot stand on an arbor of this diameter (mm), if so."""
    beside = eccentric.wall - arbor / 2
    if beside >= _THIN:
        return None
    what = f"'{eccentric.name}' has {beside:.3g} mm beside its arbor"
    why = f"its radius is {eccentric.radius:g} mm, its arbor {arbor:g} mm thick and {eccentric.offset:g} mm aside"
    return Problem(what, why, "give a thinner --bore, a larger module, or pins farther from the middle")


def on_eccentrics(discs: Sequence[StackDisc], eccentrics: Sequence[Eccentric]) -> Iterator[StackDisc]:
    """Wheels with the room in their middle, then the eccentrics."""
    for disc in discs:
        own = [each for each in eccentrics if disc.name in each.wheels]
        yield replace(disc, inner=own[0].middle or own[0].radius) if own else disc
    for each in eccentrics:
        carriers = {disc.carrier for disc in discs if disc.axis == each.axis}
        yield each.disc(discs, next(iter(carriers), None))


def running_hole(eccentric: Eccentric, process: Process) -> float:
    """Diameter (mm) of the hole in which it turns."""
    return 2 * eccentric.radius + process.running


# ------------------------------------------------------------------------------------------------------ circles of pins


_RIM = 2.0  # mm of plate round a pin
_HALF_THIN = 0.02  # mm: a plate in a gap before it has its thickness


@dataclass(frozen=True, slots=True)
class PinCircle:
    """Pins that work in round holes, as they are declared."""

    name: str
    """Of their coupling."""
    link: str
    """That bears them, `slot` the one with the holes."""
    slot: str
    radius: float
    """Of the circle on which they stand; `pin` and `hole`, diameters (mm)."""
    pin: float
    hole: float

    @property
    def reach(self) -> float:
        """Radius of a plate that bears them (mm)."""
        return self.radius + self.pin / 2 + _RIM

    @property
    def free(self) -> float:
        """From the axis of the disc to its holes (mm)."""
        return self.radius - self.hole / 2


@dataclass(frozen=True, slots=True)
class StandingPins:
    """Pins where they stand."""

    name: str
    """Of the pins and of what bears them."""
    link: str
    """Of the pins and of what bears them."""
    seat: str
    """The plate that turns in which they stand; nothing where that is the nearer plate of the frame."""
    wheel: str
    """Through which they reach, from the plate to its far face."""
    spots: tuple[Point, ...]
    """Their middles across the stack; `radius`, their own (mm)."""
    radius: float
    joined: bool = False
    """Whether they are fixed in the wheel too, and do not work in its holes."""

    def parts(self, plate: tuple[float, float], wheel: StackDisc, joint: str) -> Iterator[TurnedPart]:
        """All of them, from the far face of their plate to that of the wheel."""
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
    """A plate for pins beside the disc in which they work, or of a cup: above it, or towards what its link carries."""
    low, high = min(disc.low for disc in slots), max(disc.high for disc in slots)
    others = [disc.middle for each in carried for disc in each.discs]
    below = bool(others) and sum(others) / len(others) < (low + high) / 2
    height = gap_beside(slab_gaps, low, -1) + NEAREST if below else gap_beside(slab_gaps, high, 1) - NEAREST
    name = f"{circle.link} {'carrier ' if carried else ''}plate"
    reach = max([circle.reach, *(dist(at, each.at) + BOSS + WIDEST for each in carried)])
    disc = StackDisc(name, circle.link, axis, at, height - _HALF_THIN, height + _HALF_THIN, reach)
    return [CarrierSeat(circle.link, name, (TurningPlate(disc, tuple(each.label for each in carried), round=True),))]
