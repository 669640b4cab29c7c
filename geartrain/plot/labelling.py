"""Words on a picture where there is room for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from geartrain.plot.parts import LETTER

Box = tuple[float, float, float, float]
"""Middle, width and height, in inches."""


@dataclass(slots=True)
class Room:
    """What is taken already. `left` counts the words that found no place."""

    taken: list[Box] = field(default_factory=list)
    left: int = 0

    def place(self, lines: Sequence[str], size: float, spots: Sequence[tuple[float, float]]) -> Box | None:
        """The first of the spots (inches) at which the lines hide nothing; None where there is none."""
        width = max(map(len, lines)) * size * LETTER + 0.04
        height = len(lines) * 1.25 * size / 72
        for x, y in spots:
            box = (x, y, width, height)
            if not any(overlap(box, other) for other in self.taken):
                self.taken.append(box)
                return box
        self.left += 1
        return None


def overlap(one: Box, other: Box) -> float:
    """The area two boxes share."""
    across = (one[2] + other[2]) / 2 - abs(one[0] - other[0])
    along = (one[3] + other[3]) / 2 - abs(one[1] - other[1])
    return max(across, 0.0) * max(along, 0.0)
