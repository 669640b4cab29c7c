"""Words on a picture where there is room for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import floor

from geartrain.plot.parts import LETTER

Box = tuple[float, float, float, float]
"""Middle, width and height, in inches."""


_CELL = 0.5  # inches: boxes are looked for in the squares of a grid that they touch


@dataclass(slots=True)
class Room:
    """What is taken already, by square of a grid. `left` counts the words that found no place."""

    taken: dict[tuple[int, int], list[Box]] = field(default_factory=dict)
    left: int = 0

    def place(self, lines: Sequence[str], size: float, spots: Sequence[tuple[float, float]]) -> Box | None:
        """The first of the spots (inches) at which the lines hide nothing; None where there is none."""
        width = max(map(len, lines)) * size * LETTER + 0.04
        height = len(lines) * 1.25 * size / 72
        for x, y in spots:
            box = (float(x), float(y), width, height)
            squares = list(_squares(box))
            if not any(overlap(box, other) for square in squares for other in self.taken.get(square, ())):
                for square in squares:
                    self.taken.setdefault(square, []).append(box)
                return box
        self.left += 1
        return None


def _squares(box: Box) -> Iterator[tuple[int, int]]:
    """The squares that a box touches."""
    x, y, width, height = box
    for across in range(floor((x - width / 2) / _CELL), floor((x + width / 2) / _CELL) + 1):
        for along in range(floor((y - height / 2) / _CELL), floor((y + height / 2) / _CELL) + 1):
            yield across, along


def overlap(one: Box, other: Box) -> float:
    """The area two boxes share."""
    across = (one[2] + other[2]) / 2 - abs(one[0] - other[0])
    along = (one[3] + other[3]) / 2 - abs(one[1] - other[1])
    return max(across, 0.0) * max(along, 0.0)
