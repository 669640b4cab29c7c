"""Words on a picture: how much room they take, and where they find it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import floor

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

from geartrain.drawing.style import FINE
from geartrain.errors import printable

Box = tuple[float, float, float, float]
"""Middle, width and height, in inches."""

_PATHS = TextToPath()
_LINE = 1.25  # heights of a line, of its letters' size
_CELL = 0.5  # inches: boxes are looked for in the squares of a grid that they touch
PITCH = _LINE * FINE / 72 + 0.02
"""Inches from one word beside a picture to the next."""


@cache
def text_width(text: str, size: float = FINE, weight: str = "normal") -> float:
    """Inches that a line of words takes in the font that is drawn with."""
    font = FontProperties(size=size, weight=weight)
    shown = printable(text)  # as it is drawn
    return float(_PATHS.get_text_width_height_descent(shown, font, ismath=False)[0]) / 72 if text else 0.0


def text_box(lines: Sequence[str], size: float, x: float, y: float, weight: str = "normal") -> Box:
    """The box of some lines about a point, with a rim."""
    wide = max(text_width(line, size, weight) for line in lines)
    return x, y, wide + 0.04, len(lines) * _LINE * size / 72


@dataclass(slots=True)
class LabelSpace:
    """What is taken already, by square of a grid."""

    taken: dict[tuple[int, int], list[Box]] = field(default_factory=dict)

    def free(self, box: Box) -> bool:
        """True if the box shares no area with what is taken."""
        return not any(overlap(box, other) for square in _squares(box) for other in self.taken.get(square, ()))

    def take(self, box: Box) -> None:
        """Keep others away from a box."""
        for square in _squares(box):
            self.taken.setdefault(square, []).append(box)

    def place(self, boxes: Iterable[Box]) -> Box | None:
        """The first of some boxes that is free, which is taken; None where none is."""
        for box in boxes:
            if self.free(box):
                self.take(box)
                return box
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
