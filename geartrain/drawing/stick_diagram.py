"""Functional (stick) diagram of a train as in textbooks: axes horizontal, wheels vertical, meshes as touching ends.

Nothing is to scale. Axes that are not parallel are turned into the plane, and the ends of their wheels are slanted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import Box, LabelSpace, arrange, text_box, text_width
from geartrain.drawing.stick_grid import (
    StickCrank,
    StickShaft,
    axis_in,
    find_columns,
    find_levels,
    find_planes,
    ring_of,
)
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    FINE,
    GREY,
    LETTER,
    ORANGE,
    PALE,
    PURPLE,
    SMALL,
    Axes,
    Figure,
    Line2D,
    Patch,
    Rectangle,
    sheet,
    title_of,
    too_many,
    write,
)
from geartrain.kinematics.circuits import Circuit

STEP = 0.62  # inches: minimum distance between two elements
PLATE, STEM = 2.6, 1.6
"""Line widths of a plate and of its stem [pt]."""
_HALF, _PLATE = 0.42, 0.11  # inches: half the height of an element, half a plate
_CLOSED, _OPEN = 0.012, 0.045  # inches: half the gap between the plates of an element
_ELEMENT_NAME = 8.0  # points: font size of an element's name


def width_of(train: GearTrain) -> float:
    """Return the total width of the symbols of all brakes and clutches of a train [in]; 0 if it has none."""
    count = len(train.declaration.clutches)
    return count * _element_width(train) + 0.2 if count else 0.0


def _element_width(train: GearTrain) -> float:
    """Return the width of the column of a brake or clutch [in], in which names of links and elements fit."""
    every = train.declaration.clutches.items()
    names = [link for _, clutch in every for link in (*(clutch.locks or ()), clutch.fixes or "")]
    # the name of an element is next to its plates, on one side
    letters = max([len(link) for link in names] + [2 * len(name) + 3 for name, _ in every], default=0)
    return max(STEP, letters * _ELEMENT_NAME * LETTER + 0.1)


def draw_elements(axes: Axes, train: GearTrain, state: str | None, left: float, middle: float) -> None:
    """Draw each brake or clutch as a pair of plates between a link and the frame, or between two links.

    The plates of brakes and clutches that are closed in the state are drawn in contact. A triangle marks a one-way
    clutch; it points to the right if the clutch overruns forward.

    left     left end of the first element [in]
    middle   height of all plates [in]
    """
    declared = train.declaration
    closed = train.kinematics.cases[state].engaged
    step = _element_width(train)
    for at, (name, clutch) in enumerate(declared.clutches.items()):
        x, gap = left + step * (at + 0.5), _CLOSED if name in closed else _OPEN
        color = PURPLE if name in closed else GREY
        below, above = clutch.locks or (clutch.fixes or "", declared.frame)
        for side in (-1, 1):
            plate = middle + side * gap
            axes.plot([x - _PLATE, x + _PLATE], [plate, plate], color=color, linewidth=PLATE, gid=f"element {name}")
            axes.plot([x, x], [plate, middle + side * _HALF], color=color, linewidth=STEM)
        if clutch.one_way is not None:
            sense = ">" if clutch.one_way == "forward" else "<"
            axes.plot([x - _PLATE - 0.1], [middle], sense, color=color, markersize=5, gid=f"one-way {name}")
        if clutch.fixes is not None:
            box = Rectangle((x - 0.11, middle + _HALF), 0.22, 0.1, hatch="//////", zorder=4)
            box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
            axes.add_artist(box)
        else:
            write(axes, x, middle + _HALF + 0.1, above, ha="center", fontsize=_ELEMENT_NAME, fontweight="bold")
        write(axes, x, middle - _HALF - 0.1, below, ha="center", fontsize=_ELEMENT_NAME, fontweight="bold")
        weight = "bold" if name in closed else "normal"
        write(axes, x + _PLATE + 0.06, middle, name, color, ha="left", fontsize=_ELEMENT_NAME, fontweight=weight)


_LINK_NAME = 8.5  # points of a link's name
_BESIDE = 0.12  # inches from a vertical line to the middle of the text along it
_STEP = 0.06  # inches between candidate positions
_AWAY = 0.105  # inches from a shaft to the middle of the text above it
_APART = 0.02  # inches added between two names along one line, and on either side of a link's name
_FAR = 24  # steps that a name may be moved beyond its vertical line


@dataclass(frozen=True, slots=True)
class _Label:
    """Text to be written, with its candidate positions from the best to the worst."""

    text: str
    color: str
    places: tuple[Box, ...]
    how: dict[str, Any]


@dataclass(slots=True)
class StickLabels:
    """All labels of a diagram, which are placed in the order of links, wheels and axes."""

    room: LabelSpace = field(default_factory=LabelSpace)
    links: list[_Label] = field(default_factory=list)
    wheels: list[_Label] = field(default_factory=list)
    axes: list[_Label] = field(default_factory=list)

    def keep_off(self, xs: tuple[float, float], ys: tuple[float, float]) -> None:
        """Mark the box between two abscissae and two heights [in] as occupied, so that labels avoid it."""
        (left, right), (low, high) = sorted(xs), sorted(ys)
        wide, tall = max(right - left, 0.03), max(high - low, 0.03)
        self.room.take(((left + right) / 2, (low + high) / 2, wide, tall))

    def name_link(self, link: str, left: float, right: float, y: float) -> None:
        """Add a link's name before its shaft, which extends from `left` to `right` at height y [in], or above, behind
        or below it.
        """
        wide = text_width(link, _LINK_NAME, "bold") + 2 * _APART
        along = np.arange(left + wide / 2, max(right - wide / 2, left + wide / 2) + _STEP, _STEP)
        before = [(left - gap - wide / 2, y) for gap in (0.04, 0.1)]  # the second is next to a bearing
        spots = [*before, *((x, y + _AWAY) for x in along), (right + 0.04 + wide / 2, y + _AWAY)]
        spots += [*((x, y - _AWAY) for x in along), (left - 0.04 - wide / 2, y + _AWAY)]
        spots += [(right + 0.04 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, -_AWAY) for step in range(6)]
        tight = [text_box([link], _LINK_NAME, float(x), float(height), "bold") for x, height in spots]
        places = (*((x, height, across + 2 * _APART, tall) for x, height, across, tall in tight), *tight)
        self.links.append(_Label(link, BLACK, places, {"fontsize": _LINK_NAME, "fontweight": "bold"}))

    def name_upright(self, text: str, x: float, ends: tuple[float, float], color: str) -> None:
        """Add a label along a vertical line, on the right or left of the line, from the middle outwards."""
        places = tuple(_along(text, x, ends))
        self.wheels.append(_Label(text, color, places, {"fontsize": FINE, "rotation": 90}))

    def name_axis(self, axis: str, right: float, y: float) -> None:
        """Add the name of an axis: behind its right end, or before the end above or below its line."""
        wide = text_width(axis)
        spots = [
            (right + 0.05 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, 0.12, -0.12, 0.24) for step in range(9)
        ]
        spots += [(right - wide / 2 - step * _STEP, y + lift) for lift in (0.12, -0.12) for step in range(9)]
        places = tuple(text_box([axis], FINE, x, height) for x, height in spots)
        self.axes.append(_Label(axis, GREY, places, {"fontsize": FINE, "fontstyle": "italic"}))

    def write(self, axes: Axes) -> None:
        """Place and write all labels, those with the fewest positions first.

        A label without a free position is written at its best position.
        """
        links = sorted(self.links, key=lambda each: sum(map(self.room.free, each.places)))
        for each in chain(links, sorted(self.wheels, key=lambda each: len(each.places)), self.axes):
            x, y, _, _ = self.room.place(each.places) or each.places[0]
            write(axes, x, y, each.text, each.color, zorder=10, **each.how)


def _along(text: str, x: float, ends: tuple[float, float]) -> Iterator[Box]:
    middle, room = (ends[0] + ends[1]) / 2, abs(ends[1] - ends[0]) / 2
    _, _, wide, high = text_box([text], FINE, 0.0, 0.0)
    steps = int(max(room - wide / 2, 0.0) / _STEP)
    inside = [(side, step) for side in (1, -1) for step in range(steps + 1)]
    beyond = [(side, step) for step in range(steps + 1, steps + _FAR) for side in (1, -1)]  # tried last
    for side, step in inside + beyond:
        for sign in (1, -1):
            yield x + side * _BESIDE, middle + sign * step * _STEP, high, wide + _APART


LANE, GAP = 0.17, 1.7  # inches from shaft to shaft of one axis, and between the shafts of neighbouring axes
_TRIES = 6  # maximum number of iterations between columns and levels
_SHORTEST = 0.32  # minimum share of a wheel in the height between two axes
_ROOM = 0.24  # inches between the ends of the text along a wheel, its shaft and its mate
REACH = 0.34  # inches from a planet's axis to where its ring touches it


@dataclass(frozen=True, slots=True)
class StickMesh:
    """Gear pair or coupling in its column, between two rows; `ring` is the name of its ring wheel, or empty."""

    name: str
    kind: str
    ends: tuple[str, str]
    """Links, with the link on the lower row first; `wheels` are their wheels, or for a coupling the links again."""
    wheels: tuple[str, str]
    ring: str
    x: float
    """Abscissa of the column [in]. The vertical line of a ring is one column further to the right."""
    low: float
    """Lower end of the lines of the mesh in its column [in]."""
    high: float
    """Upper end of the lines of the mesh in its column [in]."""
    meet: float
    """Height at which the wheels touch [in]."""


@dataclass(frozen=True, slots=True)
class StickSkeleton:
    """Positions of all parts of a diagram [in], from the lower left corner."""

    rows: dict[str, tuple[float, float]]
    """Axis -> heights of its lowest and highest shaft [in]."""
    shafts: dict[str, StickShaft]
    meshes: list[StickMesh]
    cranks: list[StickCrank]
    lone: list[tuple[str, float]]
    """Wheels that have no mate, each with the abscissa of its column [in]."""
    width: float
    height: float


def find_skeleton(train: GearTrain) -> StickSkeleton:
    """Return the positions of axes, shafts, meshes and cranks, with related parts close together."""
    axis_of = {link: train.kinematics.tree.axis(link) or "" for link in train.declaration.links}
    order, planes = _row_order(train, axis_of), find_planes(train)
    row = {axis: at for at, axis in enumerate(order)}
    tries: list[tuple[int, StickSkeleton]] = []
    for _ in range(_TRIES):  # fixed-point iteration: columns follow from levels, and levels from columns
        shafts = {link: StickShaft(link, axis_of[link]) for link in axis_of if link != train.declaration.frame}
        columns, cranks, lone, width = find_columns(train, planes, row, axis_of, shafts)
        _reach_cranks(shafts, cranks)
        spans = [
            *(
                (axis_in(train, axis_of, c.i, c.carrier), axis_in(train, axis_of, c.j, c.carrier), x)
                for c, x in columns
            ),
            *((axis_of[crank.carrier], crank.axis, crank.x) for crank in cranks),
        ]
        levels = find_levels(order, shafts, spans)
        row = {axis: level for level, axes in enumerate(levels) for axis in axes}
        rows, height = _set_heights(levels, shafts)
        meshes = [_mesh(circuit, x, train, axis_of, rows) for circuit, x in columns]
        tries.append((_overlaps(spans, row), StickSkeleton(rows, shafts, meshes, cranks, lone, width, height)))
        if not tries[-1][0]:
            break
    # the iteration may alternate between arrangements, so the one with the fewest overlaps is used
    return min(tries, key=lambda each: each[0])[1]


def _overlaps(spans: Sequence[tuple[str, str, float]], row: dict[str, int]) -> int:
    """Return the number of pairs of vertical lines that overlap in one column."""
    known = [(*sorted((row[one], row[other])), x) for one, other, x in spans]
    return sum(
        x == at and low < top and bottom < high
        for index, (low, high, x) in enumerate(known)
        for bottom, top, at in known[:index]
    )


def _reach_cranks(shafts: dict[str, StickShaft], cranks: Sequence[StickCrank]) -> None:
    """Extend the shaft of each carrier to its cranks, and one shaft on each carried axis to its crank, in place."""
    for crank in cranks:
        shafts[crank.carrier].xs.append(crank.x)
        borne = [shaft for shaft in shafts.values() if shaft.axis == crank.axis]
        min(borne, key=lambda shaft: min(shaft.xs, default=0.0)).xs.append(crank.x)
    for shaft in shafts.values():
        shaft.xs = shaft.xs or [0.3]


def _row_order(train: GearTrain, axis_of: dict[str, str]) -> list[str]:
    labels = list(dict.fromkeys(label for label in axis_of.values() if label))
    pairs = [(axis_in(train, axis_of, c.i, c.carrier), axis_in(train, axis_of, c.j, c.carrier)) for c in train.circuits]
    pairs += [
        (axis_of[train.kinematics.tree.top[link]], label)
        for link, label in axis_of.items()
        if link in train.kinematics.tree.top
    ]
    order = arrange(labels, pairs)
    inputs = [axis_of[link] for link in train.declaration.inputs if axis_of.get(link)]
    if inputs and order.index(inputs[0]) > len(order) / 2:
        order.reverse()
    return order


def _set_heights(
    levels: Sequence[Sequence[str]], shafts: dict[str, StickShaft]
) -> tuple[dict[str, tuple[float, float]], float]:
    """Set the height of every shaft in `shafts`, and return the lowest and highest row of each axis and the total
    height [in].

    Shafts of one axis that overlap are drawn above each other, with the longest shaft lowest.
    """
    rows: dict[str, tuple[float, float]] = {}
    y = 0.45
    for level in levels:
        top = y
        for axis in level:
            own = sorted((each for each in shafts.values() if each.axis == axis), key=lambda s: min(s.xs) - max(s.xs))
            lanes: list[list[StickShaft]] = []
            for shaft in own:
                at = next(
                    (at for at, lane in enumerate(lanes) if all(_fit_side_by_side(shaft, each) for each in lane)),
                    len(lanes),
                )
                if at == len(lanes):
                    lanes.append([])
                lanes[at].append(shaft)
                shaft.y = y + at * LANE
            rows[axis] = (y, y + (len(lanes) - 1) * LANE)
            top = max(top, rows[axis][1])
        y = top + GAP
    return rows, y - GAP + 0.6


def _fit_side_by_side(one: StickShaft, other: StickShaft) -> bool:
    """Return True if two shafts, each with a name before it, do not overlap."""
    room = 0.35 + 0.07 * max(len(one.link), len(other.link))
    return max(one.xs) + room < min(other.xs) or max(other.xs) + room < min(one.xs)


def _mesh(
    circuit: Circuit, x: float, train: GearTrain, axis_of: dict[str, str], rows: dict[str, tuple[float, float]]
) -> StickMesh:
    ends = [(link, axis_in(train, axis_of, link, circuit.carrier)) for link in (circuit.i, circuit.j)]
    parts = sorted(zip(ends, circuit.wheels, strict=True), key=lambda part: rows[part[0][1]][0])
    (low, low_axis), (high, high_axis) = parts[0][0], parts[1][0]
    wheels = (parts[0][1], parts[1][1])
    bottom, top = rows[low_axis][1], rows[high_axis][0]
    ring = ring_of(train, circuit)
    if ring:
        meet = rows[high_axis][1] + REACH if ring == wheels[0] else rows[low_axis][0] - REACH
        return StickMesh(circuit.id, "ring", (low, high), wheels, ring, x, bottom, top, meet)
    if circuit.kind != "gear":
        return StickMesh(
            circuit.id, circuit.kind, (low, high), wheels, "", x, bottom, top, (max(top - GAP, bottom) + top) / 2
        )
    kinds = {train.declaration.wheels[wheel][1].kind for wheel in wheels}
    kind = next((kind for kind in ("worm", "contrate", "bevel") if kind in kinds), "spur")
    first, second = (train.declaration.wheels[wheel][1].count or 1 for wheel in wheels)
    if top - bottom > GAP * 1.01:  # other axes lie between: the wheels touch next to the axis of the smaller one
        bottom, top = (bottom, bottom + GAP) if first < second else (top - GAP, top)
    meet = bottom + _share(wheels, (first, second), top - bottom) * (top - bottom)
    return StickMesh(circuit.id, kind, (low, high), wheels, "", x, bottom, top, meet)


def _share(wheels: tuple[str, str], counts: tuple[int, int], height: float) -> float:
    """Return the lower wheel's share of the height between two axes, by tooth count, so that both labels fit."""
    rooms = [(text_width(f"{wheel} {count}") + _ROOM) / height for wheel, count in zip(wheels, counts, strict=True)]
    minimum, most = max(_SHORTEST, rooms[0]), 1 - max(_SHORTEST, rooms[1])
    return min(max(counts[0] / sum(counts), minimum), most) if minimum < most else (minimum + most) / 2


_MOST = 160  # maximum number of pairs on a page
_TICK, _COLUMN = 0.085, 0.3  # inches: half a tooth mark, a column
_NAME = 8.5  # points: font size
_LINK, _WHEEL, _CARRIER, _COUPLING = 1.1, 2.8, 4.0, 1.8  # points: line widths distinguish parts without colour
_TOUCH = 0.032  # inches from where two wheels meet to the middle of either's mark
_PINS = {"pin_and_slot", "pin_follower", "pins_in_holes"}  # kinds of couplings that are drawn as a pin in a slot
_BEARING = 0.08  # inches: half of the mark of a carrier's bearing
_LONE = 0.55  # inches: height of a wheel that meshes with nothing
_HEAD, _FOOT = 0.7, 0.7


def stick_figure(train: GearTrain, labels: bool = True, state: str | None = None) -> Figure:
    """Return a figure with axes, shafts, wheels and tooth counts, cranks of carriers, the hatched frame, brakes and
    clutches.

    state   state whose brakes and clutches are drawn closed, by default the first

    Raise `QuestionError` for more pairs than fit on a page, or if the state does not exist.
    """
    too_many(train, len(train.circuits), _MOST, "pairs")
    declared = train.declaration
    skeleton = find_skeleton(train)
    margin = 0.5 + max((len(link) for link in declared.links), default=1) * 8 * LETTER
    declared.check_state(state)
    elements = width_of(train)
    needed = skeleton.width + margin + 0.6 + elements
    width = max(needed, 5.5)
    margin += (width - needed) / 2
    figure, axes = sheet(width, skeleton.height + _HEAD + _FOOT, title_of(declared.name, declared.title))
    axes.set_xlim(-margin, width - margin)
    axes.set_ylim(-_FOOT, skeleton.height + _HEAD)
    for text in list(axes.texts):
        text.set_position((0.15 - margin, skeleton.height + _HEAD - 0.12))
    drawing = _Drawing(axes, train, skeleton)
    drawing.draw_axes()
    for mesh in skeleton.meshes:
        drawing.draw_mesh(mesh)
    for crank in skeleton.cranks:
        drawing.draw_crank(crank)
    for wheel, x in skeleton.lone:
        drawing.draw_lone(wheel, x)
    for shaft in skeleton.shafts.values():
        drawing.draw_shaft(shaft)
    if labels:
        drawing.words.write(axes)
    if elements:
        right = max(max(shaft.xs) for shaft in skeleton.shafts.values()) + 0.9
        draw_elements(axes, train, train.declaration.state_or_first(state), right, skeleton.height / 2)
    entries = list(_legend(train))
    columns = min(len(entries), int(width / 1.35), 5)
    figure.legend(handles=entries, loc="lower center", ncols=columns, fontsize=SMALL - 1.5, frameon=False)
    return figure


class _Drawing:
    """Drawing of a diagram in progress; wheels that appear in several columns are named once."""

    def __init__(self, axes: Axes, train: GearTrain, skeleton: StickSkeleton) -> None:
        self.axes, self.train, self.skeleton = axes, train, skeleton
        self.couplings = {
            row.id: each for each in train.declaration.couplings for row in each.rows(train.declaration.wheels)
        }
        self.feet: dict[str, tuple[float, float]] = {}
        self.words = StickLabels()
        for mesh in skeleton.meshes:
            ends = [mesh.meet, *(self._foot(link, mesh) for link in mesh.ends)]
            for x in (mesh.x, mesh.x + _COLUMN) if mesh.ring else (mesh.x,):
                self.words.keep_off((x, x), (min(ends), max(ends)))
        for crank in skeleton.cranks:
            far = skeleton.rows[crank.axis][0]
            self.words.keep_off((crank.x, crank.x), (skeleton.shafts[crank.carrier].y, far))
            self.words.keep_off((crank.x - _BEARING, crank.x + _BEARING), (far - 0.07, far + 0.07))

    def draw_axes(self) -> None:
        """Draw the centre lines of all axes."""
        for axis, (low, _) in self.skeleton.rows.items():
            xs = [x for shaft in self.skeleton.shafts.values() if shaft.axis == axis for x in shaft.xs]
            ends = [min(xs) - 0.2, max(xs) + 0.25]
            self._line(ends, [low, low], PALE, 0.8, linestyle="-.", zorder=1, gid=f"axis {axis}")
            self.words.name_axis(axis, ends[1], low)

    def draw_shaft(self, shaft: StickShaft) -> None:
        """Draw a link's shaft with its name, in a bearing if it turns in the frame."""
        left, right = min(shaft.xs) - 0.14, max(shaft.xs) + 0.14
        self._line([left, right], [shaft.y, shaft.y], "white", _LINK + 3.0, zorder=5)
        self._line([left, right], [shaft.y, shaft.y], BLACK, _LINK, zorder=6, gid=f"link {shaft.link}")
        if self.train.kinematics.tree.top[shaft.link] == self.train.declaration.frame:
            self._ground(left + 0.04, shaft.y - 0.075)
        self.words.keep_off((left, right), (shaft.y, shaft.y))
        self.words.name_link(shaft.link, left, right, shaft.y)

    def draw_mesh(self, mesh: StickMesh) -> None:
        """Draw two wheels up to the point where they touch, or the coupling of two links."""
        low, high = (self._foot(link, mesh) for link in mesh.ends)
        if mesh.kind == "ring":
            self._draw_ring(mesh, low, high)
        elif mesh.name in self.couplings:
            self._draw_coupling(mesh, low, high)
        else:
            for wheel, link, foot, side in zip(mesh.wheels, mesh.ends, (low, high), (-1, 1), strict=True):
                end = mesh.meet + _TOUCH * side
                self._draw_wheel_line(mesh.x, foot, end, wheel, link)
                self._tick(mesh.x, end, mesh.kind)

    def _foot(self, link: str, mesh: StickMesh) -> float:
        shaft = self.skeleton.shafts.get(link)
        if shaft is not None:
            return shaft.y
        carrier = next(circuit.carrier for circuit in self.train.circuits if circuit.id == mesh.name)
        return self.skeleton.rows[self.skeleton.shafts[carrier].axis][0] - 0.22

    def _draw_ring(self, mesh: StickMesh, low: float, high: float) -> None:
        """Draw the planet beyond its axis, and the ring across the planet's end and next to the planet."""
        ring = mesh.wheels.index(mesh.ring)
        planet, side = 1 - ring, 1 if ring == 0 else -1
        foot = (low, high)
        end = mesh.meet - _TOUCH * side
        self._draw_wheel_line(mesh.x, foot[planet], end, mesh.wheels[planet], mesh.ends[planet])
        self._tick(mesh.x, end, "spur")
        over, beside = mesh.meet + _TOUCH * side, mesh.x + _COLUMN
        self._line([mesh.x - _TICK, beside], [over, over], BLUE, _WHEEL, zorder=4)
        self._draw_wheel_line(beside, foot[ring], over, mesh.ring, mesh.ends[ring])

    def _draw_coupling(self, mesh: StickMesh, low: float, high: float) -> None:
        """Draw a pin in its slot; for links that a coupling keeps parallel, two bars side by side."""
        coupling = self.couplings[mesh.name]
        pin = getattr(coupling, "pin", None)
        parallel = coupling.kind == "parallel" or pin is None
        for link, foot, side in zip(mesh.ends, (low, high), (-1, 1), strict=True):
            end = mesh.meet + 0.03 * side * parallel
            self._line([mesh.x, mesh.x], [foot, end], PURPLE, _COUPLING, zorder=3, gid=f"coupling {mesh.name}")
            if parallel:
                self._line([mesh.x - _TICK, mesh.x + _TICK], [end, end], PURPLE, _COUPLING, zorder=5)
            elif link == pin:
                self.axes.plot([mesh.x], [mesh.meet], "o", color=PURPLE, markersize=5, zorder=5)
            else:
                box = Rectangle((mesh.x - 0.05, mesh.meet - 0.1), 0.1, 0.2, zorder=4)
                box.set(facecolor="white", edgecolor=PURPLE, linewidth=1.4)
                self.axes.add_artist(box)
                self.words.keep_off((mesh.x - 0.06, mesh.x + 0.06), (mesh.meet - 0.12, mesh.meet + 0.12))
        self.words.name_upright(mesh.name, mesh.x, (low, high), PURPLE)

    def _draw_wheel_line(self, x: float, foot: float, end: float, wheel: str, link: str) -> None:
        """Draw a wheel from its shaft to its mate, connected to an earlier line of the same wheel if there is one."""
        self._line([x, x], [foot, end], BLUE, _WHEEL, zorder=3, gid=f"wheel {wheel}")
        if link == self.train.declaration.frame:
            self._ground(x, foot)
        known = self.feet.get(wheel)
        if known is not None and abs(known[0] - x) > 1e-9:  # another column, not a rounding difference
            level = foot + (0.09 if end > foot else -0.09)
            self._line([known[0], x], [level, level], BLUE, _WHEEL, zorder=3)
        if known is None:
            count = self.train.declaration.wheels[wheel][1].count
            self.words.name_upright(f"{wheel} {count}", x, (foot, end), BLUE)
        self.feet.setdefault(wheel, (x, foot))

    def draw_lone(self, wheel: str, x: float) -> None:
        """Draw a wheel that has no mate."""
        link = self.train.declaration.wheels[wheel][0]
        y = self.skeleton.shafts[link].y
        self._draw_wheel_line(x, y, y + _LONE, wheel, link)
        self._tick(x, y + _LONE, "spur")

    def draw_crank(self, crank: StickCrank) -> None:
        """Draw a carrier's arm, which ends in a bearing on the axis that the carrier carries."""
        y = self.skeleton.shafts[crank.carrier].y
        far = self.skeleton.rows[crank.axis][0]
        self._line([crank.x, crank.x], [y, far], ORANGE, _CARRIER, zorder=3, gid=f"crank {crank.carrier}")
        for side in (-1, 1):
            level = far + 0.05 * side
            self._line(
                [crank.x - _BEARING, crank.x + _BEARING], [level, level], ORANGE, _WHEEL, zorder=7, gid="bearing"
            )

    def _tick(self, x: float, y: float, kind: str) -> None:
        """Draw the mark of teeth at a wheel's end: level, slanted for bevel or contrate, long and dashed for a worm."""
        lean = {"bevel": 0.06, "contrate": 0.06}.get(kind, 0.0)
        reach = _TICK * (1.6 if kind == "worm" else 1.0)
        style = (0, (1.2, 0.8)) if kind == "worm" else "-"
        self.words.keep_off((x - reach, x + reach), (y - lean, y + lean))
        self._line([x - reach, x + reach], [y - lean, y + lean], BLUE, _WHEEL, zorder=4, linestyle=style, gid="teeth")

    def _ground(self, x: float, y: float) -> None:
        self.words.keep_off((x - 0.09, x + 0.09), (y - 0.045, y + 0.045))
        box = Rectangle((x - 0.09, y - 0.045), 0.18, 0.09, hatch="//////", zorder=4)
        box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
        self.axes.add_artist(box)

    def _line(self, xs: list[float], ys: list[float], color: str, width: float, **how: object) -> None:
        self.axes.plot(xs, ys, color=color, linewidth=width, solid_capstyle="butt", **how)  # type: ignore[arg-type]


def _legend(train: GearTrain) -> Iterator[Line2D | Patch]:
    yield Line2D([], [], color=BLACK, linewidth=_LINK, label="links on their axes")
    yield Line2D([], [], color=BLUE, linewidth=_WHEEL, label="wheels")
    yield Patch(facecolor="white", edgecolor=GREY, hatch="//////", label="frame")
    if any(circuit.carrier != train.declaration.frame for circuit in train.circuits):
        yield Line2D([], [], color=ORANGE, linewidth=_CARRIER, label="carriers")
    kinds = {coupling.kind for coupling in train.declaration.couplings}
    pins, others = kinds & _PINS, kinds - _PINS
    if pins:
        holes = "pins in holes" if pins == {"pins_in_holes"} else "pins in slots"
        yield Line2D([], [], color=PURPLE, linewidth=_COUPLING, marker="o", label=holes)
    if others:
        ends = {"marker": "|", "markersize": 8, "markeredgewidth": 2.0}
        label = "kept parallel" if others == {"parallel"} else "couplings"
        yield Line2D([], [], color=PURPLE, linewidth=_COUPLING, label=label, **ends)  # type: ignore[arg-type]
    if train.declaration.clutches:
        ends = {"linewidth": PLATE, "marker": "|", "markersize": 10, "markeredgewidth": STEM}
        for color, words in ((PURPLE, "closed brakes and clutches"), (GREY, "open ones")):
            yield Line2D([], [], color=color, label=words, **ends)  # type: ignore[arg-type]
