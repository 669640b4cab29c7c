"""Names in a stick diagram, each where it hides nothing: of links by their shafts, of wheels along them, of axes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np

from geartrain.drawing.backend import Axes
from geartrain.drawing.labels import Box, LabelSpace, text_box, text_width
from geartrain.drawing.style import BLACK, FINE, GREY, write

_NAME = 8.5  # points of a link's name
_BESIDE = 0.12  # inches from an upright to the middle of the words along it
_STEP = 0.06  # inches from one place to the next that is tried
_AWAY = 0.105  # inches from a shaft to the middle of the words over it
_APART = 0.02  # inches more between two names along one line, and on either side of a link's
_FAR = 24  # steps beyond its upright that a name may be moved


@dataclass(frozen=True, slots=True)
class _Words:
    """Words and the places they may have, the best first."""

    text: str
    color: str
    places: tuple[Box, ...]
    how: dict[str, Any]


@dataclass(slots=True)
class StickWords:
    """All words of a diagram: links first, then wheels, then axes take their places when they are written."""

    room: LabelSpace = field(default_factory=LabelSpace)
    links: list[_Words] = field(default_factory=list)
    wheels: list[_Words] = field(default_factory=list)
    axes: list[_Words] = field(default_factory=list)

    def keep_off(self, xs: tuple[float, float], ys: tuple[float, float]) -> None:
        """No words over a line or a box."""
        (left, right), (low, high) = sorted(xs), sorted(ys)
        wide, tall = max(right - left, 0.03), max(high - low, 0.03)
        self.room.take(((left + right) / 2, (low + high) / 2, wide, tall))

    def name_link(self, link: str, left: float, right: float, y: float) -> None:
        """Before its shaft, or over it, behind it or under it."""
        wide = text_width(link, _NAME, "bold") + 2 * _APART
        along = np.arange(left + wide / 2, max(right - wide / 2, left + wide / 2) + _STEP, _STEP)
        before = [(left - gap - wide / 2, y) for gap in (0.04, 0.1)]  # the second, beside a bearing
        spots = [*before, *((x, y + _AWAY) for x in along), (right + 0.04 + wide / 2, y + _AWAY)]
        spots += [*((x, y - _AWAY) for x in along), (left - 0.04 - wide / 2, y + _AWAY)]
        spots += [(right + 0.04 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, -_AWAY) for step in range(6)]
        tight = [text_box([link], _NAME, float(x), float(height), "bold") for x, height in spots]
        places = (*((x, height, across + 2 * _APART, tall) for x, height, across, tall in tight), *tight)
        self.links.append(_Words(link, BLACK, places, {"fontsize": _NAME, "fontweight": "bold"}))

    def name_upright(self, text: str, x: float, ends: tuple[float, float], color: str) -> None:
        """Along it, on its right or its left, from its middle on."""
        places = tuple(_along(text, x, ends))
        self.wheels.append(_Words(text, color, places, {"fontsize": FINE, "rotation": 90}))

    def name_axis(self, axis: str, right: float, y: float) -> None:
        """Behind its end, or before it over or under the line."""
        wide = text_width(axis)
        spots = [
            (right + 0.05 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, 0.12, -0.12, 0.24) for step in range(9)
        ]
        spots += [(right - wide / 2 - step * _STEP, y + lift) for lift in (0.12, -0.12) for step in range(9)]
        places = tuple(text_box([axis], FINE, x, height) for x, height in spots)
        self.axes.append(_Words(axis, GREY, places, {"fontsize": FINE, "fontstyle": "italic"}))

    def write(self, axes: Axes) -> None:
        """All of them, what has least choice first; where nothing is free, at the best place."""
        links = sorted(self.links, key=lambda each: sum(map(self.room.free, each.places)))
        for each in chain(links, sorted(self.wheels, key=lambda each: len(each.places)), self.axes):
            x, y, _, _ = self.room.place(each.places) or each.places[0]
            write(axes, x, y, each.text, each.color, zorder=10, **each.how)


def _along(text: str, x: float, ends: tuple[float, float]) -> Iterator[Box]:
    middle, room = (ends[0] + ends[1]) / 2, abs(ends[1] - ends[0]) / 2
    _, _, wide, high = text_box([text], FINE, 0.0, 0.0)
    steps = int(max(room - wide / 2, 0.0) / _STEP)
    inside = [(side, step) for side in (1, -1) for step in range(steps + 1)]
    beyond = [(side, step) for step in range(steps + 1, steps + _FAR) for side in (1, -1)]  # only where it must
    for side, step in inside + beyond:
        for sign in (1, -1):
            yield x + side * _BESIDE, middle + sign * step * _STEP, high, wide + _APART
