"""Rings on arbors and pipes: spacers between two wheels, collets that fix wheels, and the barrel of a weight.

The barrel is a drum next to the widest wheel of the arbor at which power enters.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from geartrain.scene.parts.arbor_columns import APART, COLLAR, SHAKE, AxisColumn, ColumnMember
from geartrain.scene.parts.carried_axes import seen_from_carrier
from geartrain.scene.parts.stack_discs import StackDisc
from geartrain.scene.parts.turned_parts import Band, TurnedPart, crosses

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plan import FramePlan

_WALLS = (1.5, 1.0, 0.6)  # mm: walls, of which the thickest that fits is used
_SHORTEST = 0.5  # mm: minimum length
_LONGEST = 1.2  # maximum length of a collet in diameters of its arbor
_SAME = 1e-6  # mm: touching faces must not overlap due to rounding errors
_FREE = 0.3  # mm between a collet and the next turning part


def sleeves(plan: FramePlan, held: str = "") -> Iterator[TurnedPart]:
    """Yield the spacers and collets of all arbors and pipes of a plan, if there is space for them.

    held   name of a wheel that needs no collet because a barrel is fixed to it
    """
    # links with pins or slots have none, because the pins move next to the wheels
    coupled = {link for each in plan.stack.train.declaration.pin_couplings for link in each.ends}
    for column in plan.all_columns:
        around = _Obstacles(plan, column)
        for member in column.members:
            if member.link not in coupled:
                yield from _MemberSleeves(around, member).all(held)


def _beside(
    disc: StackDisc, longest: float, shortest: float
) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    """Yield the ends of possible spacers or collets at a wheel, each with the ends of the space it needs [mm]."""
    for part in (1.0, 0.75, 0.5, 0.25):
        length = max(part * longest, shortest)
        yield (disc.high, disc.high + length), (disc.high, disc.high + length + _FREE)
        yield (disc.low - length, disc.low), (disc.low - length - _FREE, disc.low)


@dataclass(frozen=True)
class _Obstacles:
    """Parts that limit the size of rings on one axis."""

    plan: FramePlan
    column: AxisColumn

    @cached_property
    def discs(self) -> tuple[StackDisc, ...]:
        """Discs of the train, and arbors of other axes as discs, relative to the axis of the column."""
        discs = list(self.plan.discs)
        for other in self.plan.all_columns:
            for each in other.members if other is not self.column else ():
                link, about = each.link, next((disc.carrier for disc in each.discs), None)
                rod = StackDisc(link, link, other.axis, other.at, each.low, each.high, each.outer / 2, carrier=about)
                discs.append(rod)
        if self.column.axis in self.plan.carried:
            carrier = self.plan.stack.carried[self.column.axis].carrier
            seat = next(disc for disc in discs if disc.name == self.plan.seat_of(carrier))
            discs = [seen_from_carrier(carrier, seat.at, disc) for disc in discs]
        return tuple(discs)

    @cached_property
    def walls(self) -> tuple[tuple[float, float], ...]:
        """Heights occupied by the plates of the frame, including shoulders and collars [mm]."""
        places = [self.plan.places.back, self.plan.places.front, *([self.plan.bridge] if self.plan.bridge else [])]
        goes_on = any(crosses(each, faces) for each in self.column.members for faces in places)
        room = SHAKE + COLLAR if goes_on else SHAKE
        return tuple((low - room, high + room) for low, high in places)

    @cached_property
    def span(self) -> tuple[float, float]:
        """Heights of the lowest and the highest face of all discs [mm]; dials are beyond this interval."""
        faces = [face for disc in self.plan.discs for face in (disc.low, disc.high)]
        return min(faces), max(faces)

    def is_free(self, member: ColumnMember, low: float, high: float, radius: float) -> bool:
        """Return True if a ring of a given radius on a member, between two heights, is clear of all other parts."""
        if low < self.span[0] or high > self.span[1] or low < member.low or member.high < high:
            return False
        # a wider member at these heights would be a pipe around the ring
        inner = [each for each in self.column.members if each is not member and each.low < high and low < each.high]
        if any(each.outer > member.outer for each in inner) or any(a < high and low < b for a, b in self.walls):
            return False
        near = (disc for disc in self.discs if disc.low < high - _SAME and low + _SAME < disc.high)
        return all(disc.clearance_to(self.column.at, radius) >= APART for disc in near) and not any(
            wheel.is_between(low, high) for wheel in self.plan.wheels_across
        )


@dataclass(frozen=True)
class _MemberSleeves:
    """Search for the spacers and collets of one arbor or pipe."""

    around: _Obstacles
    member: ColumnMember

    @cached_property
    def discs(self) -> Sequence[StackDisc]:
        """Discs on the arbor or pipe, from the lowest to the highest."""
        return sorted(self.member.discs, key=lambda disc: disc.low)

    def all(self, fixed: str) -> Iterator[TurnedPart]:
        """Yield the spacers, then the collets of the wheels that no spacer touches."""
        held = {*self.around.plan.cut, fixed}
        for below, above in pairwise(self.discs):
            band = self._ring(below.high, above.low)
            if above.low - below.high >= _SHORTEST and band is not None:
                held |= {below.name, above.name}
                name = f"spacer {below.name} to {above.name}"
                yield self._part(name, "spacer", band, "slides on, between wheels")
        joint = self.around.plan.process.joint
        for disc in self.discs:
            if disc.name in held:
                continue
            for faces, room in _beside(disc, _LONGEST * self.member.outer, _SHORTEST):
                if (band := self._ring(*room)) is not None:
                    ring = Band(*faces, band.radius, band.bore)
                    yield self._part(f"collet of {disc.name}", "collet", ring, f"{joint}, its wheel against it")
                    break

    def _ring(self, low: float, high: float) -> Band | None:
        """Return the thickest spacer or collet that fits between two heights; None if none is clear of other parts."""
        bore = self.member.outer / 2
        walls = (wall for wall in _WALLS if self.around.is_free(self.member, low, high, bore + wall))
        wall = next(walls, None)
        return None if wall is None else Band(low, high, bore + wall, bore + self.around.plan.process.press / 2)

    def _part(self, name: str, kind: str, band: Band, joint: str) -> TurnedPart:
        return TurnedPart(self.member.link, name, kind, self.around.column.at, (band,), joint)


# --------------------------------------------------------------------------------------------------------------- barrel


_LONGEST_BARREL = 10.0  # mm: maximum length of a barrel


@dataclass(frozen=True, slots=True)
class Barrel:
    """Drum for the line of a weight, fixed to the side of a wheel. Like a collet, it fixes the wheel to the arbor."""

    wheel: str
    part: TurnedPart


def find_barrel(plan: FramePlan, link: str | None) -> Barrel | None:
    """Return the barrel of the link at which power enters; None if no weight or drum is declared or it does not fit."""
    drive = plan.stack.train.declaration.drive
    if drive is None or drive.weight is None or drive.drum is None:
        return None
    own = plan.members_of(link)
    if link is None or not own or not own[0][1].discs:
        return None
    column, member = own[0]
    widest = max(member.discs, key=lambda disc: disc.outer)
    radius = 1000 * drive.drum.si
    around, places = _Obstacles(plan, column), _beside(widest, _LONGEST_BARREL, 0.0)
    faces = next((faces for faces, room in places if around.is_free(member, *room, radius)), None)
    if faces is None:
        return None
    band = Band(*faces, radius, member.outer / 2 + plan.process.press / 2)
    joint = f"pinned to {widest.name}"
    return Barrel(widest.name, TurnedPart(link, f"{link} barrel", "barrel", column.at, (band,), joint))
