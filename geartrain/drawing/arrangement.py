"""Arrangement of nodes, text and callouts on a page."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import ceil, cos, inf, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from scipy.optimize import isotonic_regression, linear_sum_assignment
from scipy.sparse.csgraph import floyd_warshall

from geartrain.drawing.style import FINE, GREY, Axes, Circle, write
from geartrain.errors import printable

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

Pairs = Sequence[tuple[str, str]]
_PASSES = 12
_STEPS = 300


def arrange(items: Sequence[str], pairs: Pairs) -> list[str]:
    """Return the items in an order that keeps the two items of each pair close together.

    The sum of the distances within pairs is reduced by a local search that moves one item at a time. The result is
    deterministic.
    """
    order = breadth_first(items, pairs)
    at = {item: position for position, item in enumerate(order)}
    ends = [(at[one], at[other]) for one, other in pairs if one != other and one in at and other in at]
    sequence = list(range(len(order)))
    for _ in range(_PASSES):
        before = sequence
        for item in range(len(sequence)):
            rest = [other for other in sequence if other != item]
            trials = ([*rest[:position], item, *rest[position:]] for position in range(len(sequence)))
            sequence = min((sequence, *trials), key=lambda trial: _length(trial, ends))  # unchanged if none is shorter
        if sequence == before:
            break
    return [order[item] for item in sequence]


def breadth_first(items: Sequence[str], pairs: Pairs) -> list[str]:
    """Return the items in breadth-first order. The search starts at the first item of each connected component."""
    mates = neighbours(items, pairs)
    seen: dict[str, None] = {}
    for item in items:
        queue = deque([item])
        while queue:
            here = queue.popleft()
            if here not in seen:
                seen[here] = None
                queue.extend(other for other in mates[here] if other not in seen)
    return list(seen)


def neighbours(items: Sequence[str], pairs: Pairs) -> dict[str, list[str]]:
    """Return a dictionary that maps each item to the items with which it is paired, in the order of the pairs."""
    mates: dict[str, list[str]] = {item: [] for item in items}
    for one, other in pairs:
        if one in mates and other in mates and one != other:
            mates[one].append(other)
            mates[other].append(one)
    return mates


def _length(sequence: Sequence[int], ends: Sequence[tuple[int, int]]) -> int:
    place = [0] * len(sequence)
    for position, item in enumerate(sequence):
        place[item] = position
    return sum(abs(place[one] - place[other]) for one, other in ends)


def spread(wanted: Sequence[float], needs: Sequence[float], bounds: tuple[float, float] = (-inf, inf)) -> list[float]:
    """Return the centres of boxes in a row without overlap, in the order of the wanted centres (least squares).

    needs    width of each box
    bounds   interval that contains the boxes if there is enough space
    """
    if not len(wanted):
        return []
    # stable, so that boxes with equal centres keep the given order
    order = np.argsort(wanted, kind="stable")
    wide = np.asarray(needs)[order]
    steps = np.concatenate([[0.0], np.cumsum(wide[1:] + wide[:-1]) / 2])  # distances from the first box, without gaps
    first = isotonic_regression(np.asarray(wanted)[order] - steps).x
    # a row that is too long begins at the lower bound
    first = np.maximum(np.minimum(first, bounds[1] - wide[-1] / 2 - steps[-1]), bounds[0] + wide[0] / 2)
    places = np.zeros(len(order))
    places[order] = first + steps
    return list(map(float, places))


def settle(items: Sequence[str], pairs: Pairs, lengths: Mapping[tuple[str, str], float]) -> Floats:
    """Return the positions (n, 2) of items, computed by stress majorization from a circle of items in the order of
    `arrange`.

    The target distance between two items is the length of the shortest path between them (Gansner, Koren and North
    2004, Graph drawing by stress majorization, equation 3).

    lengths   length of each pair, whose items may be in either order
    """
    count = len(items)
    order = {item: at for at, item in enumerate(arrange(items, pairs))}
    angle = [2 * pi * order[item] / count for item in items]
    places = np.array([(cos(each), sin(each)) for each in angle]) * count**0.5
    far = np.full((count, count), np.inf)
    np.fill_diagonal(far, 0.0)
    at = {item: position for position, item in enumerate(items)}
    for one, other in pairs:
        i, j = at[one], at[other]
        length = lengths[one, other] if (one, other) in lengths else lengths[other, one]
        far[i, j] = far[j, i] = min(far[i, j], length) if i != j else 0.0
    wanted = floyd_warshall(np.where(np.isfinite(far), far, 0.0))
    wanted = np.where(np.isfinite(wanted), wanted, 0.0)  # unconnected items do not attract each other
    weights = np.where(wanted > 0, 1 / np.where(wanted > 0, wanted, 1.0) ** 2, 0.0)
    # the Laplacian is singular, as a common translation costs nothing; the pseudoinverse keeps the mean
    inverse = np.linalg.pinv(np.diag(weights.sum(1)) - weights)
    for _ in range(_STEPS):
        apart: Any = places[:, None, :] - places[None, :, :]
        distance = np.sqrt((apart**2).sum(2))
        # two items at one point have no direction to be pushed in: they do not pull, and the others separate them
        pull = -weights * wanted / np.where(distance > 1e-9, distance, 1.0)
        pull[distance <= 1e-9] = 0.0
        np.fill_diagonal(pull, 0.0)
        np.fill_diagonal(pull, -pull.sum(1))
        places = inverse @ (pull @ places)
    return np.asarray(np.round(places, 4))  # coarser than rounding errors, so that all machines agree


# --------------------------------------------------------------------------------------------------- words on a picture


Box = tuple[float, float, float, float]
"""Box on a page: centre x, centre y, width and height [in]."""

_PATHS = TextToPath()
_LINE = 1.25  # height of a line over its font size
PITCH = _LINE * FINE / 72 + 0.02
"""Distance between the lines of a callout [in]."""


@cache
def text_width(text: str, size: float = FINE, weight: str = "normal") -> float:
    """Return the width of a line of text in the font of the figures [in]; 0 for an empty string."""
    font = FontProperties(size=size, weight=weight)
    shown = printable(text)  # the text as drawn, with control characters written out
    return float(_PATHS.get_text_width_height_descent(shown, font, ismath=False)[0]) / 72 if text else 0.0


def text_box(lines: Sequence[str], size: float, x: float, y: float, weight: str = "normal") -> Box:
    """Return the box of lines of text in the font `size`, centred at (x, y) [in], with a margin."""
    wide = max(text_width(line, size, weight) for line in lines)
    return x, y, wide + 0.04, len(lines) * _LINE * size / 72


@dataclass(slots=True)
class LabelSpace:
    """Boxes on a page that are already occupied by labels, and the choice of free boxes for further labels."""

    taken: Floats = field(default_factory=lambda: np.zeros((0, 4)))
    """Centres, widths and heights of the occupied boxes [in]. Shape (n, 4)."""

    def free(self, box: Box) -> bool:
        """Return True if a box does not overlap any occupied box."""
        near = np.abs(self.taken[:, :2] - box[:2]) < (self.taken[:, 2:] + box[2:]) / 2
        return not near.all(axis=1).any()

    def take(self, box: Box) -> None:
        """Mark a box as occupied."""
        self.taken = np.vstack([self.taken, box])

    def place(self, boxes: Iterable[Box]) -> Box | None:
        """Return the first free box and mark it as occupied; None if no box is free."""
        for box in boxes:
            if self.free(box):
                self.take(box)
                return box
        return None


# ------------------------------------------------------------------------------------------------------------- callouts


Spot = tuple[float, float]

_AWAY = 0.06  # inches between words and the line that leads from them
_APART = 0.08  # inches between a list and its neighbours above and below
_FEW, _SHARE = 8, 0.6  # lines that may all be on one side; of more lines, the maximum share on one side
_THIN: dict[str, Any] = {"color": GREY, "linewidth": 0.6, "zorder": 7}


@dataclass(frozen=True, slots=True)
class Callout:
    """One or more lines of text next to a picture, and the point of the picture [in] that the text names."""

    words: Sequence[tuple[str, str]]
    """Lines of text. Each line is a pair: identifier of the text in a vector file, and the text itself."""
    anchor: Spot

    @property
    def height(self) -> float:
        """Height of the callout in its column [in]."""
        return PITCH * len(self.words) + (_APART if len(self.words) > 1 else 0.0)

    @property
    def width(self) -> float:
        """Width of the longest line of text [in]."""
        return max(text_width(words) for _, words in self.words)


@dataclass(frozen=True, slots=True)
class CalloutMargin:
    """Callouts next to a picture: each callout with its ordinate [in], and the inner edges of the two columns."""

    left: Sequence[tuple[Callout, float]]
    right: Sequence[tuple[Callout, float]]
    edges: tuple[float, float]

    @property
    def widths(self) -> tuple[float, float]:
        """Widths [in] of the left and right columns, measured outwards from their inner edges."""
        sides = [[each.width + 2 * _AWAY for each, _ in side] for side in (self.left, self.right)]
        return max(sides[0], default=0.0), max(sides[1], default=0.0)

    @property
    def extent(self) -> tuple[float, float]:
        """Minimum and maximum ordinate of all callouts [in]; (inf, -inf) if the columns are empty."""
        ends = [y + way * each.height / 2 for side in (self.left, self.right) for each, y in side for way in (-1, 1)]
        return min(ends, default=inf), max(ends, default=-inf)

    @property
    def lines(self) -> list[Floats]:
        """End points (2, 2) of the leader line of every callout [in]."""
        sides = zip((self.left, self.right), self.edges, strict=True)
        return [np.array([(edge, y), each.anchor]) for side, edge in sides for each, y in side]

    @property
    def has_lists(self) -> bool:
        """True if any callout has several lines of text."""
        return any(len(each.words) > 1 for side in (self.left, self.right) for each, _ in side)

    def moved(self, x: float, y: float) -> CalloutMargin:
        """Return the same callouts, with their anchors and columns translated on the page by (x, y) [in]."""
        left, right = (
            [(Callout(c.words, (c.anchor[0] + x, c.anchor[1] + y)), at + y) for c, at in side]
            for side in (self.left, self.right)
        )
        return CalloutMargin(left, right, (self.edges[0] + x, self.edges[1] + x))

    def draw(self, axes: Axes) -> None:
        """Draw the text of the callouts, leader lines with a dot at the named point, and a bar next to each list."""
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
    """Return the callouts in two columns, close to the points that they name.

    edges    inner edges of the columns; all anchors lie between them
    bounds   interval of y that contains the callouts if there is enough space
    """
    ordered = sorted(callouts, key=lambda each: (each.anchor, each.words))
    lines = np.cumsum([0, *(len(each.words) for each in ordered)])
    most = ceil(_SHARE * lines[-1]) if lines[-1] > _FEW else lines[-1]
    middle = sum(edges) / 2
    # all anchors of one column lie left of those of the other, so that lines of different columns never cross
    fair = [at for at in range(len(ordered) + 1) if lines[at] <= most and lines[-1] - lines[at] <= most]
    even = min(range(len(ordered) + 1), key=lambda at: abs(2 * lines[at] - lines[-1]))
    wanted = sum(each.anchor[0] < middle for each in ordered)
    count = min(fair, key=lambda at: abs(at - wanted)) if fair else even
    sides = [_column(side, edge, bounds) for side, edge in zip((ordered[:count], ordered[count:]), edges, strict=True)]
    return CalloutMargin(sides[0], sides[1], edges)


def _column(callouts: Sequence[Callout], edge: float, bounds: tuple[float, float]) -> list[tuple[Callout, float]]:
    """Return the callouts of a column, each with an ordinate [in] close to its anchor; few leader lines cross."""
    order: list[Callout] = []
    if callouts:  # the order that minimises the total length of leader lines (linear assignment)
        heights = np.array(spread([each.anchor[1] for each in callouts], [each.height for each in callouts], bounds))
        anchors = np.array([each.anchor for each in callouts])
        _, given = linear_sum_assignment(np.hypot(anchors[:, :1] - edge, anchors[:, 1:] - heights))
        order = [callouts[at] for at in np.argsort(heights[given], kind="stable")]
    best, minimum = _level_positions(order, bounds), inf
    for _ in range(len(order) + 1):
        placed = _level_positions(order, bounds)
        crossed = _crossings(placed, edge)
        if len(crossed) < minimum:
            best, minimum = placed, len(crossed)
        if not len(crossed):
            break
        one, other = crossed[0]
        order[one], order[other] = order[other], order[one]
    return best


def _level_positions(order: Sequence[Callout], bounds: tuple[float, float]) -> list[tuple[Callout, float]]:
    """Return the callouts with ordinates [in] as close to their anchors as the order permits (isotonic regression)."""
    wanted = isotonic_regression([each.anchor[1] for each in order]).x.tolist() if order else []
    return list(zip(order, spread(wanted, [each.height for each in order], bounds), strict=True))


def _crossings(placed: Sequence[tuple[Callout, float]], edge: float) -> Ints:
    """Return the index pairs (n, 2) of callouts whose leader lines to the `edge` of their column cross."""
    starts = np.array([(edge, y) for _, y in placed]).reshape(-1, 1, 2)
    ends = np.array([each.anchor for each, _ in placed]).reshape(-1, 1, 2)

    def parts(points: Floats) -> Floats:
        """Return the signs (n, n), -1, 0 or 1, of the side of each leader line on which each point lies."""
        along, apart = ends - starts, points - starts
        return np.asarray(np.sign(along[..., 0] * apart[..., 1] - along[..., 1] * apart[..., 0]))

    split = parts(starts.swapaxes(0, 1)) * parts(ends.swapaxes(0, 1)) < 0
    return np.argwhere(np.triu(split & split.T, 1))
