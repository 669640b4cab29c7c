"""Words beside a picture, and lines that lead from them to what they name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import isotonic_regression, linear_sum_assignment

from geartrain.drawing.arrangement import spread
from geartrain.drawing.backend import Axes, Circle
from geartrain.drawing.labels import PITCH, text_width
from geartrain.drawing.style import FINE, GREY, write

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

Spot = tuple[float, float]

_AWAY = 0.06  # inches between words and the line that leads from them
_APART = 0.08  # inches between a list and what stands above or below it
_FEW, _SHARE = 8, 0.6  # lines that may all stand on one side, and the share of more that may
_THIN: dict[str, Any] = {"color": GREY, "linewidth": 0.6, "zorder": 7}


@dataclass(frozen=True, slots=True)
class Callout:
    """A word, or a list of words below each other, for a point in a picture, in inches.

    words   each with the key that names it in a vector file
    """

    words: Sequence[tuple[str, str]]
    anchor: Spot

    @property
    def height(self) -> float:
        """Inches that it takes of its column."""
        return PITCH * len(self.words) + (_APART if len(self.words) > 1 else 0.0)

    @property
    def width(self) -> float:
        """Inches of its longest word."""
        return max(text_width(words) for _, words in self.words)


@dataclass(frozen=True, slots=True)
class CalloutMargin:
    """Where words stand beside a picture: x of their column's inner edge and y of each, on the left and the right."""

    left: Sequence[tuple[Callout, float]]
    right: Sequence[tuple[Callout, float]]
    edges: tuple[float, float]

    @property
    def widths(self) -> tuple[float, float]:
        """Inches beyond the edges on either side."""
        sides = [[each.width + 2 * _AWAY for each, _ in side] for side in (self.left, self.right)]
        return max(sides[0], default=0.0), max(sides[1], default=0.0)

    @property
    def extent(self) -> tuple[float, float]:
        """Least and greatest y of all words; (inf, -inf) of none."""
        ends = [y + way * each.height / 2 for side in (self.left, self.right) for each, y in side for way in (-1, 1)]
        return min(ends, default=inf), max(ends, default=-inf)

    @property
    def lines(self) -> list[Floats]:
        """Both ends (2, 2) of every line."""
        sides = zip((self.left, self.right), self.edges, strict=True)
        return [np.array([(edge, y), each.anchor]) for side, edge in sides for each, y in side]

    @property
    def has_lists(self) -> bool:
        """True where one line leads to several things."""
        return any(len(each.words) > 1 for side in (self.left, self.right) for each, _ in side)

    def moved(self, x: float, y: float) -> CalloutMargin:
        """All of it elsewhere on the page."""
        left, right = (
            [(Callout(c.words, (c.anchor[0] + x, c.anchor[1] + y)), at + y) for c, at in side]
            for side in (self.left, self.right)
        )
        return CalloutMargin(left, right, (self.edges[0] + x, self.edges[1] + x))

    def draw(self, axes: Axes) -> None:
        """Words, lines and a dot at each end; a bar beside a list."""
        for side, edge, ha, step in ((self.left, self.edges[0], "right", -1), (self.right, self.edges[1], "left", 1)):
            for each, y in side:
                axes.plot([edge, each.anchor[0]], [y, each.anchor[1]], **_THIN)
                axes.add_artist(Circle(each.anchor, 0.022, facecolor=GREY, edgecolor="none", zorder=7))
                top = y + PITCH * (len(each.words) - 1) / 2
                if len(each.words) > 1:
                    axes.plot([edge, edge], [top + PITCH / 2, 2 * y - top - PITCH / 2], **_THIN)
                for at, (key, words) in enumerate(each.words):
                    write(axes, edge + step * _AWAY, top - PITCH * at, words, ha=ha, fontsize=FINE, gid=key)


def find_margin(callouts: Sequence[Callout], edges: tuple[float, float], bounds: tuple[float, float]) -> CalloutMargin:
    """Words in two columns, near to what they name.

    edges    inner edges of the columns: all anchors lie between them
    bounds   of y, as far as there is room
    """
    ordered = sorted(callouts, key=lambda each: (each.anchor, each.words))
    lines = np.cumsum([0, *(len(each.words) for each in ordered)])
    most = ceil(_SHARE * lines[-1]) if lines[-1] > _FEW else lines[-1]
    middle = sum(edges) / 2
    # all of one column lie left of all of the other: lines of the two never cross
    fair = [at for at in range(len(ordered) + 1) if lines[at] <= most and lines[-1] - lines[at] <= most]
    even = min(range(len(ordered) + 1), key=lambda at: abs(2 * lines[at] - lines[-1]))
    wanted = sum(each.anchor[0] < middle for each in ordered)
    count = min(fair, key=lambda at: abs(at - wanted)) if fair else even
    sides = [_column(side, edge, bounds) for side, edge in zip((ordered[:count], ordered[count:]), edges, strict=True)]
    return CalloutMargin(sides[0], sides[1], edges)


def _column(callouts: Sequence[Callout], edge: float, bounds: tuple[float, float]) -> list[tuple[Callout, float]]:
    """Places near those of what is named, in an order in which no line crosses another, as far as one is found."""
    order = _shortest(callouts, edge, bounds)
    best, least = _stacked(order, bounds), inf
    for _ in range(len(order) + 1):
        placed = _stacked(order, bounds)
        crossed = _crossings(placed, edge)
        if len(crossed) < least:
            best, least = placed, len(crossed)
        if not len(crossed):
            break
        one, other = crossed[0]
        order[one], order[other] = order[other], order[one]
    return best


def _shortest(callouts: Sequence[Callout], edge: float, bounds: tuple[float, float]) -> list[Callout]:
    """From below, so that all lines together are shortest were all as high: then no two of them cross."""
    if not callouts:
        return []
    heights = np.array(spread([each.anchor[1] for each in callouts], [each.height for each in callouts], bounds))
    anchors = np.array([each.anchor for each in callouts])
    _, given = linear_sum_assignment(np.hypot(anchors[:, :1] - edge, anchors[:, 1:] - heights))
    return [callouts[at] for at in np.argsort(heights[given], kind="stable")]


def _stacked(order: Sequence[Callout], bounds: tuple[float, float]) -> list[tuple[Callout, float]]:
    """Each as near to what it names as the order, from below, leaves it."""
    wanted = isotonic_regression([each.anchor[1] for each in order]).x.tolist() if order else []
    return list(zip(order, spread(wanted, [each.height for each in order], bounds), strict=True))


def _crossings(placed: Sequence[tuple[Callout, float]], edge: float) -> Ints:
    """Pairs (n, 2) of which the lines cross."""
    starts = np.array([(edge, y) for _, y in placed]).reshape(-1, 1, 2)
    ends = np.array([each.anchor for each, _ in placed]).reshape(-1, 1, 2)

    def parts(points: Floats) -> Floats:
        """On which side of each line (n) each point (1, n) lies."""
        along, apart = ends - starts, points - starts
        return np.asarray(np.sign(along[..., 0] * apart[..., 1] - along[..., 1] * apart[..., 0]))

    split = parts(starts.swapaxes(0, 1)) * parts(ends.swapaxes(0, 1)) < 0
    return np.argwhere(np.triu(split & split.T, 1))
