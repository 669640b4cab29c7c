"""Placement of texts on the drawings of an export so that they do not overlap."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin

WIDE = 0.64
"""Mean width of a letter in a sans-serif font, divided by the font size."""
_TALL = 1.15  # height of a line over the font size
_WAYS, _RINGS = 16, 40  # directions and distances that are tried

Box = tuple[float, float, float, float]
"""Left, upper, right and lower edges of a box. Ordinates increase downwards."""


@dataclass(slots=True)
class LabelBoxes:
    """Occupied boxes of texts and of marks on a page, in the length unit of the page."""

    page: Box
    size: float
    """Font size of the texts, in the length unit of the page."""
    taken: list[Box] = field(default_factory=list)

    def box(self, text: str, x: float, y: float) -> Box:
        """Return the box of a line of text that is centred at the point (x, y)."""
        half, tall = WIDE * self.size * len(text) / 2, _TALL * self.size / 2
        return x - half, y - tall, x + half, y + tall

    def place(self, text: str, x: float, y: float) -> tuple[float, float]:
        """Return the centre of a line of text that overlaps no occupied box, near the point (x, y), and occupy it.

        The point itself and points on circles around it are tried. If all overlap, the last point is returned.
        """
        for ring in range(_RINGS):
            for way in range(_WAYS if ring else 1):
                turn, away = 2 * pi * way / _WAYS, ring * self.size / 2
                at = (x + away * sin(turn), y - away * cos(turn))
                if self._is_free(box := self.box(text, *at)):
                    self.taken.append(box)
                    return at
        return at

    def _is_free(self, box: Box) -> bool:
        left, top, right, low = box
        if left < self.page[0] or top < self.page[1] or right > self.page[2] or low > self.page[3]:
            return False
        return all(right <= a or c <= left or low <= b or d <= top for a, b, c, d in self.taken)
