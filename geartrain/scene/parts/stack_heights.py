"""Room for plates in a stack: heights of wheels as laid out become heights as built."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.scene.parts.arbor_columns import HEAD_ROOM, FramePlaces
from geartrain.scene.parts.carried_axes import TurningPlate

BEHIND = 1.5  # mm between a plate of the frame and what turns next to it
BETWEEN = HEAD_ROOM  # mm between a plate that turns and its neighbours


@dataclass(frozen=True, slots=True)
class StackHeights:
    """Where everything stands once plates are in.

    starts   lower face of each slab as laid out; shifts: how far it moves up (mm)
    plates   faces of the plates that turn, by name
    """

    starts: tuple[float, ...]
    shifts: tuple[float, ...]
    places: FramePlaces
    plates: dict[str, tuple[float, float]]

    def shift(self, height: float) -> float:
        """How far what stands at a height moves up."""
        return self.shifts[max(bisect_right(self.starts, height + 1e-6) - 1, 0)]


def stack_up(
    taken: Sequence[tuple[float, float]], places: FramePlaces, turning: Sequence[TurningPlate], thickness: float
) -> StackHeights:
    """Heights from the lowest slab, which stays, up; plates below it are put under it."""
    rows = [(low, high - low, BETWEEN, ("slab", str(at))) for at, (low, high) in enumerate(taken)]
    rows += [(each.disc.middle, thickness, BETWEEN, ("turning", each.disc.name)) for each in turning]
    rows += [
        (places.back[0], thickness, BEHIND, ("frame", "back")),
        (places.front[0], thickness, BEHIND, ("frame", "front")),
    ]
    rows.sort(key=lambda row: row[0])
    faces: dict[tuple[str, str], tuple[float, float]] = {}
    top, before = 0.0, None
    for row in rows:
        low, tall, room, name = row
        if before is not None:
            slabs = before[3][0] == name[0] == "slab"
            top += low - before[0] - before[1] if slabs else max(room, before[2])
        faces[name] = top, top + tall
        top, before = top + tall, row
    rise = taken[0][0] - faces["slab", "0"][0]
    moved = {name: (low + rise, high + rise) for name, (low, high) in faces.items()}
    shifts = tuple(moved["slab", str(at)][0] - low for at, (low, _) in enumerate(taken))
    turned = {name: each for (kind, name), each in moved.items() if kind == "turning"}
    starts = tuple(low for low, _ in taken)
    return StackHeights(starts, shifts, FramePlaces(moved["frame", "back"], moved["frame", "front"]), turned)
