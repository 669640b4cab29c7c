"""The barrel from which a weight hangs: a drum on the arbor at which power enters, beside its widest wheel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.scene.parts.sleeves import free_beside
from geartrain.scene.parts.turned_parts import Band, TurnedPart

if TYPE_CHECKING:
    from geartrain.scene.parts.frame_plan import FramePlan
    from geartrain.scene.parts.stack_discs import Point

_LONGEST = 10.0  # mm


@dataclass(frozen=True, slots=True)
class Barrel:
    """A drum fixed to a wheel, whose collet it is.

    link, wheel   the link, and the wheel beside which it is
    at            of its axis across the stack (mm)
    low, high     its ends along the normal (mm)
    radius, bore  outside and inside radius (mm)
    """

    link: str
    wheel: str
    at: Point
    low: float
    high: float
    radius: float
    bore: float

    @property
    def part(self) -> TurnedPart:
        """As it is turned."""
        band = Band(self.low, self.high, self.radius, self.bore)
        return TurnedPart(self.link, f"{self.link} barrel", "barrel", self.at, (band,), f"pinned to {self.wheel}")


def find_barrel(plan: FramePlan, link: str | None) -> Barrel | None:
    """Of the link at which power enters, where a weight and a drum are declared and there is room."""
    drive = plan.stack.train.declaration.drive
    if drive is None or drive.weight is None or drive.drum is None:
        return None
    own = plan.members_of(link)
    if link is None or not own or not own[0][1].discs:
        return None
    column, member = own[0]
    widest = max(member.discs, key=lambda disc: disc.outer)
    radius = 1000 * drive.drum.si
    faces = free_beside(plan, column, member, widest.name, (radius, _LONGEST))
    if faces is None:
        return None
    return Barrel(link, widest.name, column.at, *faces, radius, member.outer / 2 + plan.process.press / 2)
