"""Words on a picture: how much room they take, where they find it, and lines that lead to what they name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import ceil, floor, inf

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from scipy.optimize import linear_sum_assignment

from geartrain.drawing.arrangement import spread
from geartrain.drawing.backend import Axes, Circle
from geartrain.drawing.style import BLACK, FINE, GREY, write
from geartrain.errors import printable

Box = tuple[float, float, float, float]
"""Middle, width and height, in inches."""
Spot = tuple[float, float]

_PATHS = TextToPath()
_LINE = 1.25  # heights of a line, of its letters' size
_CELL = 0.5  # inches: boxes are looked for in the squares of a grid that they touch
_AWAY = 0.06  # inches between words and the line that leads from them
_FEW, _SHARE = 8, 0.6  # words that may all stand on one side, and the share of more that may
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


@dataclass(frozen=True, slots=True)
class Callout:
    """Words beside a picture for a point in it, both in inches; `key` names them in a vector file."""

    key: str
    words: str
    anchor: Spot
    color: str = BLACK


@dataclass(frozen=True, slots=True)
class CalloutMargin:
    """Where words stand beside a picture: x of their column's inner edge and y of each, on the left and the right."""

    left: Sequence[tuple[Callout, float]]
    right: Sequence[tuple[Callout, float]]
    edges: tuple[float, float]

    @property
    def widths(self) -> tuple[float, float]:
        """Inches beyond the edges on either side."""
        sides = [[text_width(each.words) + 2 * _AWAY for each, _ in side] for side in (self.left, self.right)]
        return max(sides[0], default=0.0), max(sides[1], default=0.0)

    @property
    def extent(self) -> tuple[float, float]:
        """Least and greatest y of all words; (inf, -inf) of none."""
        ys = [y for side in (self.left, self.right) for _, y in side]
        return min(ys, default=inf) - PITCH / 2, max(ys, default=-inf) + PITCH / 2

    def moved(self, x: float, y: float) -> CalloutMargin:
        """All of it elsewhere on the page."""
        left, right = (
            [(Callout(c.key, c.words, (c.anchor[0] + x, c.anchor[1] + y), c.color), at + y) for c, at in side]
            for side in (self.left, self.right)
        )
        return CalloutMargin(left, right, (self.edges[0] + x, self.edges[1] + x))

    def draw(self, axes: Axes) -> None:
        """Words, lines and a dot at each end."""
        for side, edge, ha, step in ((self.left, self.edges[0], "right", -1), (self.right, self.edges[1], "left", 1)):
            for each, y in side:
                axes.plot([edge, each.anchor[0]], [y, each.anchor[1]], color=GREY, linewidth=0.6, zorder=7)
                axes.add_artist(Circle(each.anchor, 0.022, facecolor=GREY, edgecolor="none", zorder=7))
                write(axes, edge + step * _AWAY, y, each.words, each.color, ha=ha, fontsize=FINE, gid=each.key)


def find_margin(callouts: Sequence[Callout], edges: tuple[float, float], bounds: tuple[float, float]) -> CalloutMargin:
    """Words in two columns, near to what they name, so that no line crosses another.

    edges    inner edges of the columns: all anchors lie between them
    bounds   of y, as far as there is room
    """
    ordered = sorted(callouts, key=lambda each: (each.anchor, each.key))
    middle = sum(edges) / 2
    capacity = ceil(_SHARE * len(ordered)) if len(ordered) > _FEW else len(ordered)
    count = sum(each.anchor[0] < middle for each in ordered)
    count = min(max(count, len(ordered) - capacity), capacity)
    # all of one column lie left of all of the other: lines of the two never cross
    sides = [_column(side, edge, bounds) for side, edge in zip((ordered[:count], ordered[count:]), edges, strict=True)]
    return CalloutMargin(sides[0], sides[1], edges)


def _column(callouts: Sequence[Callout], edge: float, bounds: tuple[float, float]) -> list[tuple[Callout, float]]:
    """Heights near those of what is named, given out so that all lines together are shortest: no two of them cross."""
    heights = np.array(spread([each.anchor[1] for each in callouts], [PITCH] * len(callouts), bounds))
    anchors = np.array([each.anchor for each in callouts]).reshape(-1, 2)
    lengths = np.hypot(anchors[:, :1] - edge, anchors[:, 1:] - heights)
    _, given = linear_sum_assignment(lengths)
    return list(zip(callouts, heights[given].tolist(), strict=True))
