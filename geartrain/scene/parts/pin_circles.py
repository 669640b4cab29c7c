"""Circles of pins that stand in a plate: those of a ring of pins, and those that work in round holes of a disc."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import dist

from geartrain.scene.parts.carried_axes import BOSS, NEAREST, WIDEST, CarriedAxis, CarrierSeat, TurningPlate, gap_beside
from geartrain.scene.parts.flexible_cups import FlexibleCup
from geartrain.scene.parts.stack_discs import Point, StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart

_RIM = 2.0  # mm of plate round a pin
_THIN = 0.02  # mm: a plate in a gap before it has its thickness


@dataclass(frozen=True, slots=True)
class PinCircle:
    """Pins that work in round holes, as they are declared.

    name       of their coupling
    link       that bears them, `slot` the one with the holes
    radius     of the circle on which they stand; `pin` and `hole`, diameters (mm)
    """

    name: str
    link: str
    slot: str
    radius: float
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
    """Pins where they stand.

    name, link   of the pins and of what bears them
    seat         the plate that turns in which they stand; nothing where that is the nearer plate of the frame
    wheel        through which they reach, from the plate to its far face
    spots        their middles across the stack; `radius`, their own (mm)
    joined       whether they are fixed in the wheel too, and do not work in its holes
    """

    name: str
    link: str
    seat: str
    wheel: str
    spots: tuple[Point, ...]
    radius: float
    joined: bool = False

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
    disc = StackDisc(name, circle.link, axis, at, height - _THIN, height + _THIN, reach)
    return [CarrierSeat(circle.link, name, (TurningPlate(disc, tuple(each.label for each in carried), round=True),))]
