"""Speed diagrams of epicyclic sets: coaxial members at abscissae given by tooth counts, their speeds as ordinates.

All speeds of a set lie on one line. The abscissae are computed by `geartrain.kinematics.levers`.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby
from math import ceil
from typing import Any, NamedTuple

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import spread, text_width
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    PALE,
    PURPLE,
    SMALL,
    Axes,
    Figure,
    sheet,
    title_of,
    too_many,
)
from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.answer import Answer
from geartrain.kinematics.levers import Lever, find_levers
from geartrain.numerics.exact import decimal, fraction_text, is_short


class Point(NamedTuple):
    """Point of a lever: its abscissa, the links that it represents, their closed clutches, and their speed."""

    x: Fraction
    links: list[str]
    marks: list[str]
    speed: Fraction | None

    @property
    def names(self) -> list[str]:
        """Name of each link, followed by its closed brakes and clutches in brackets."""
        return [link + mark for link, mark in zip(self.links, self.marks, strict=True)]


_MOST = 120  # maximum number of panels on a page
_MINIMUM, _TALL, _PAGE = 1.7, 1.3, 11.5  # inches: minimum width and height of a panel, maximum width of a row
_NARROW, _EDGE = 5.0, 0.45  # inches: minimum width of a page, and margin at its right
_GAP, _HEAD = 0.7, 0.95  # inches between panels, and for the names above and below one
_FINE = 8.5  # points: font size
_UPRIGHT = 1.4  # height divided by width of a page beyond which states are arranged in columns
_LONG = 11  # letters of the longest fraction that is not written as a decimal


def lever_figure(train: GearTrain, state: str | None = None, labels: bool = True) -> Figure:
    """Return a figure with a panel for each epicyclic set in each state. The panels of one state form one or more rows.

    state   state to be drawn; by default all states

    Raise `QuestionError` if the train has no epicyclic set, or for more panels than fit on a page.
    """
    levers = find_levers(train.declaration, train.kinematics.tree, train.circuits)
    if not levers:
        why = "a speed diagram shows members that turn about the axis of a moving carrier, and no carrier moves"
        fix = "draw another kind of picture: plan, stick, graph or dials"
        raise QuestionError(Problem(f"'{train.name}' has no epicyclic set", why, fix))
    states: list[str | None] = [state] if state is not None else [*train.states] or [None]
    too_many(train, len(levers) * len(states), _MOST, "panels of sets and states")
    answers = [train.solve(name) for name in states]
    wide = [max(_width(_points(train, lever, answer)) for answer in answers) for lever in levers]
    # as few rows as the total width permits, with nearly equal numbers of panels
    rows = ceil((sum(wide) + _GAP * len(wide)) / _PAGE)
    bands = [band.tolist() for band in np.array_split(np.arange(len(wide)), min(rows, len(wide)))]
    # panels are widened if the widest row is narrower than the minimum page width
    most = max(bands, key=lambda band: sum(wide[at] + _GAP for at in band))
    room = _NARROW - _EDGE - _GAP * len(most)
    factor = max(room / sum(wide[at] for at in most), 1.0)
    wide = [each * factor for each in wide]
    span = max(sum(wide[at] + _GAP for at in band) for band in bands) + _EDGE
    tall = (_TALL + _HEAD) * len(bands) + 0.45
    columns = min(max(round((tall * len(answers) / (_UPRIGHT * span)) ** 0.5), 1), len(answers))
    rows = -(-len(answers) // columns)
    width, height = span * columns, tall * rows + 0.35
    figure, page = sheet(width, height, title_of(train.declaration.name, train.declaration.title))
    limits = _limits(train, levers, answers)
    for place, answer in enumerate(answers):
        corner = span * (place // rows), height - 0.35 - tall * (place % rows)
        heading = _heading(train, answer, place == 0)
        page.text(corner[0] + 0.15, corner[1] - 0.3, heading, fontsize=SMALL, parse_math=False)
        top = corner[1] - 0.45
        for band in bands:
            top -= _TALL + _HEAD
            left = corner[0]
            for at in band:
                left += _GAP
                box = (left / width, (top + 0.3) / height, wide[at] / width, _TALL / height)
                axes = figure.add_axes(box, label=f"{levers[at].carrier} {answer.state or ''}")
                axes.set_ylim(*limits)
                _panel(axes, train, levers[at], answer, labels)
                left += wide[at]
    return figure


def _limits(train: GearTrain, levers: Sequence[Lever], answers: Sequence[Answer]) -> tuple[float, float]:
    """Return common limits for the speed axes of all panels, which contain the speeds of all links with a margin."""
    points = (point for lever in levers for answer in answers for point in _points(train, lever, answer))
    speeds = [0.0, *(float(point.speed) for point in points if point.speed is not None)]
    more = 0.08 * (max(speeds) - min(speeds)) or 0.5
    return min(speeds) - more, max(speeds) + more


def _width(points: Sequence[Point]) -> float:
    """Return the width [in] at which the labels above and below a panel fit side by side."""
    above = sum(_label_width(max([*point.names, _speed_text(point.speed)], key=len)) for point in points)
    below = sum(_label_width(_speed_text(point.x)) for point in points)
    return max(above, below, _MINIMUM)


def _label_width(text: str) -> float:
    return text_width(text, _FINE, "bold") + 0.15


def _heading(train: GearTrain, answer: Answer, first: bool) -> str:
    """Return a state's heading: its name, closed elements, the unit (first state only), and its verdict if faulty."""
    said = [] if answer.state is None else [f"state {answer.state}"]
    if closed := train.kinematics.cases[answer.state].engaged:
        said[-1:] = [f"{said[-1]}: {', '.join(closed)} closed"]
    if first:
        said.append(f"speeds in {train.declaration.unit_name or 'the unit of the inputs'}")
    return "; ".join(said if answer.verdict else [*said, str(answer.verdict)])


def _panel(axes: Axes, train: GearTrain, lever: Lever, answer: Answer, labels: bool) -> None:
    """Draw one epicyclic set in one state: a vertical line for each member, and the line through their speeds."""
    points = _points(train, lever, answer)
    xs = [float(point.x) for point in points]
    known = [(float(point.x), float(point.speed)) for point in points if point.speed is not None]
    _frame(axes, xs)
    for x in xs:
        axes.axvline(x, color=PALE, linewidth=1.0, zorder=1)
    axes.axhline(0.0, color=BLACK, linewidth=0.8, zorder=1)
    axes.plot(*zip(*known, strict=True), color=BLUE, linewidth=1.8, zorder=2, gid="line") if known else None
    for x, speed in known:
        axes.plot([x, x], [0.0, speed], color=GREY, linewidth=2.2, zorder=2)
        axes.plot([x], [speed], "o", color=ORANGE if x == 0 else BLUE, markersize=6, markeredgecolor="white", zorder=4)
    held = sorted(
        {float(x) for link, x in lever.abscissae.items() if link in train.kinematics.cases[answer.state].fixed}
    )
    axes.plot(held, [0.0] * len(held), "^", color=PURPLE, markersize=8, zorder=5, gid="held") if held else None
    if labels:
        _names(axes, points, xs)


def _marks(train: GearTrain, state: str | None) -> dict[str, str]:
    """Return the names of the closed brakes and clutches of each link, as a text in brackets, by link."""
    found: dict[str, list[str]] = {}
    for name in train.kinematics.cases[state].engaged:
        clutch = train.declaration.clutches[name]
        for link in clutch.locks or (clutch.fixes or "",):
            found.setdefault(link, []).append(name)
    return {link: f" [{', '.join(names)}]" for link, names in found.items()}


def _points(train: GearTrain, lever: Lever, answer: Answer) -> list[Point]:
    """Return the points of a lever from left to right, with speeds about the direction of the carrier's axis."""
    own, marks = train.kinematics.signs.get(lever.carrier, 1), _marks(train, answer.state)
    ordered = sorted(lever.abscissae.items(), key=lambda item: item[1])
    found: list[Point] = []
    for x, members in groupby(ordered, key=lambda item: item[1]):
        links = [link for link, _ in members]
        for same in [links] if x else [[lever.carrier], [link for link in links if link != lever.carrier]]:
            if same:
                speed = answer.speeds.get(same[0])
                turned = None if speed is None else Fraction(speed) * own * train.kinematics.signs.get(same[0], 1)
                found.append(Point(x, same, [marks.get(link, "") for link in same], turned))
    return found


def _frame(axes: Axes, xs: Sequence[float]) -> None:
    for side in ("top", "right", "bottom"):
        axes.spines[side].set_visible(False)
    axes.tick_params(labelsize=_FINE - 0.5, colors=GREY)
    axes.set_xticks([])
    axes.locator_params(axis="y", nbins=4)
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")  # a hyphen for minus, as in the fractions above
    low, high = min(xs), max(xs)
    rim = 0.08 * (high - low) or 0.5
    axes.set_xlim(low - rim, high + rim)


def _names(axes: Axes, points: Sequence[Point], xs: Sequence[float]) -> None:
    """Write names and speeds above a panel and abscissae below it, moved apart where they would overlap."""
    low, high = axes.get_xlim()
    figure = axes.get_figure(root=True)
    assert figure is not None
    inches = axes.get_position().width * figure.get_size_inches()[0] / (high - low)
    heads = [_speed_text(point.speed) for point in points]
    feet = [_speed_text(point.x) for point in points]
    wide = [_label_width(max([*point.names, speed], key=len)) for point, speed in zip(points, heads, strict=True)]
    bounds = low * inches - 0.25, high * inches + 0.25
    above = spread([x * inches for x in xs], wide, bounds)
    below = spread([x * inches for x in xs], list(map(_label_width, feet)), bounds)
    across = axes.get_xaxis_transform()
    for point, speed, foot, x, up, down in zip(points, heads, feet, xs, above, below, strict=True):
        up, down = up / inches, down / inches
        axes.plot([x, up], [1.0, 1.07], color=PALE, linewidth=0.8, transform=across, clip_on=False)
        axes.plot([x, down], [0.0, -0.07], color=PALE, linewidth=0.8, transform=across, clip_on=False)
        how: dict[str, Any] = {"ha": "center", "fontsize": _FINE, "parse_math": False, "clip_on": False}
        how["transform"] = across
        links = "\n".join(point.links)
        axes.text(up, 1.08, speed, va="bottom", color=BLUE if point.x else ORANGE, gid=f"speed {links}", **how)
        axes.text(up, 1.19, "\n".join(point.names), va="bottom", color=BLACK, fontweight="bold", **how)
        axes.text(down, -0.08, foot, va="top", color=GREY, gid=f"abscissa {links}", **how)


def _speed_text(value: Fraction | None) -> str:
    """Return a speed as text: a short fraction, a decimal number, or a question mark for None."""
    if value is None:
        return "?"
    return fraction_text(value) if is_short(value, _LONG) else f"≈ {decimal(value, 6)}"
