"""Functional (stick) diagram of a train as in textbooks: axes horizontal, wheels vertical, meshes as touching ends.

Nothing is to scale. Axes that are not parallel are turned into the plane, and the ends of their wheels are slanted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain, pairwise
from math import ceil
from typing import Any

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import Box, LabelSpace, arrange, text_box, text_width
from geartrain.drawing.stick_grid import (
    COLUMN,
    StickColumns,
    StickCrank,
    StickShaft,
    axis_in,
    find_columns,
    find_levels,
    find_planes,
    ring_of,
)
from geartrain.drawing.stick_symbols import (
    BAR,
    BEARING,
    CARRIER,
    COUPLING,
    LINK,
    NAME,
    PLATE,
    STEM,
    TICK,
    TOUCH,
    WHEEL,
    draw_bearing,
    draw_belt,
    draw_drum,
    draw_element,
    draw_ground,
    draw_joint,
    draw_line,
    draw_pin,
    draw_rack,
    draw_screw,
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
    sheet,
    title_of,
    too_many,
    write,
)
from geartrain.kinematics.circuits import Circuit

_LINK_NAME = 8.5  # points of a link's name
_BESIDE = 0.12  # inches from a vertical line to the middle of the text along it
_STEP = 0.06  # inches between candidate positions
_AWAY = 0.105  # inches from a shaft to the middle of the text above it
_APART = 0.02  # inches added between two names along one line, and on either side of a link's name
_FAR = 24  # steps that a name may be moved beyond its vertical line


@dataclass(frozen=True, slots=True)
class _Label:
    """Label of a stick diagram, with its possible boxes from best to worst."""

    text: str
    color: str
    places: tuple[Box, ...]
    how: dict[str, Any]


@dataclass(slots=True)
class StickLabels:
    """All labels of a stick diagram in order of priority: names of links, of wheels and couplings, and of axes."""

    room: LabelSpace = field(default_factory=LabelSpace)
    links: list[_Label] = field(default_factory=list)
    wheels: list[_Label] = field(default_factory=list)
    axes: list[_Label] = field(default_factory=list)

    def keep_off(self, xs: tuple[float, float], ys: tuple[float, float]) -> None:
        """Mark the box between two abscissae and two ordinates [in] as occupied, so that labels avoid it."""
        (left, right), (low, high) = sorted(xs), sorted(ys)
        wide, tall = max(right - left, 0.03), max(high - low, 0.03)
        self.room.take(((left + right) / 2, (low + high) / 2, wide, tall))

    def name_link(self, link: str, left: float, right: float, y: float) -> None:
        """Add the name of a link next to its shaft, which extends from `left` to `right` at the height `y` [in]."""
        wide = text_width(link, _LINK_NAME, "bold") + 2 * _APART
        along = np.arange(left + wide / 2, max(right - wide / 2, left + wide / 2) + _STEP, _STEP)
        before = [(left - gap - wide / 2, y) for gap in (0.04, 0.1)]  # the second is next to a bearing
        spots = [*before, *((x, y + _AWAY) for x in along), (right + 0.04 + wide / 2, y + _AWAY)]
        spots += [*((x, y - _AWAY) for x in along), (left - 0.04 - wide / 2, y + _AWAY)]
        spots += [(right + 0.04 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, -_AWAY) for step in range(6)]
        spots += [
            (left - 0.04 - wide / 2 - step * _STEP, y + lift) for lift in (0.0, -_AWAY, _AWAY) for step in range(9)
        ]
        tight = [text_box([link], _LINK_NAME, float(x), float(height), "bold") for x, height in spots]
        places = (*((x, height, across + 2 * _APART, tall) for x, height, across, tall in tight), *tight)
        self.links.append(_Label(link, BLACK, places, {"fontsize": _LINK_NAME, "fontweight": "bold"}))

    def name_upright(self, text: str, x: float, ends: tuple[float, float], color: str) -> None:
        """Add a label next to the vertical line at `x` between `ends` [in], as close to its middle as possible."""
        places = tuple(_along(text, x, ends))
        self.wheels.append(_Label(text, color, places, {"fontsize": FINE, "rotation": 90}))

    def name_axis(self, axis: str, right: float, y: float) -> None:
        """Add the name of an axis at the right end of its line, or above or below the line near this end."""
        wide = text_width(axis)
        spots = [
            (right + 0.05 + wide / 2 + step * _STEP, y + lift) for lift in (0.0, 0.12, -0.12, 0.24) for step in range(9)
        ]
        spots += [(right - wide / 2 - step * _STEP, y + lift) for lift in (0.12, -0.12) for step in range(9)]
        places = tuple(text_box([axis], FINE, x, height) for x, height in spots)
        self.axes.append(_Label(axis, GREY, places, {"fontsize": FINE, "fontstyle": "italic"}))

    def name_element(self, name: str, closed: bool, x: float, y: float) -> None:
        """Add the name of a brake or clutch above or beside its plates, whose middle is (x, y) [in]."""
        weight = "bold" if closed else "normal"
        beside = 0.22 + text_width(name, NAME, weight) / 2
        spots = [(x + aside, y + 0.2 + step * _STEP) for step in range(4) for aside in (0.0, 0.1, -0.1)]
        spots += [(x + side * beside, y) for side in (1, -1)]
        places = tuple(text_box([name], NAME, *spot, weight) for spot in spots)
        how = {"fontsize": NAME, "fontweight": weight}
        self.wheels.append(_Label(name, PURPLE if closed else GREY, places, how))

    def write(self, axes: Axes) -> None:
        """Place and write all labels, those with the fewest free or candidate positions first in their group."""
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
_RISE = 0.36  # inches from the shafts of an axis to the plates of a brake or clutch above them
_TRIES = 6  # maximum number of iterations between columns and levels
_SHORTEST = 0.32  # minimum share of a wheel in the height between two axes
_ROOM = 0.24  # inches between the ends of the text along a wheel, its shaft and its mate
REACH = 0.34  # inches from a planet's axis to where its ring touches it


@dataclass(frozen=True, slots=True)
class StickMesh:
    """Gear pair or coupling of a stick diagram: a vertical line in a column, between the heights of its two shafts."""

    name: str
    kind: str
    ends: tuple[str, str]
    """Links of the mesh; the link on the lower row is first."""
    wheels: tuple[str, str]
    """Wheels of these links, or the links themselves for a coupling."""
    ring: str
    """Name of the ring wheel; empty if the mesh has none."""
    x: float
    """Abscissa of the column [in]. The vertical line of a ring wheel is one column further to the right."""
    low: float
    """Lower end of the vertical lines of the mesh [in]."""
    high: float
    """Upper end of the vertical lines of the mesh [in]."""
    meet: float
    """Height at which the wheels touch [in]."""


@dataclass(frozen=True, slots=True)
class StickSkeleton:
    """Positions of all parts of a diagram [in], measured from its lower left corner."""

    rows: dict[str, tuple[float, float]]
    """Heights of the lowest and highest shaft of each axis [in], keyed by axis."""
    shafts: dict[str, StickShaft]
    meshes: list[StickMesh]
    columns: StickColumns
    elements: dict[str, tuple[float, float]]
    """Position of the middle of the plates [in], keyed by brake or clutch."""
    height: float


def find_skeleton(train: GearTrain) -> StickSkeleton:
    """Return the positions of axes, shafts, meshes and cranks. Related parts are placed close together."""
    axis_of = {link: train.kinematics.tree.axis(link) or "" for link in train.declaration.links}
    order, planes = _row_order(train, axis_of), find_planes(train)
    row = {axis: at for at, axis in enumerate(order)}
    tries: list[tuple[int, StickSkeleton]] = []
    for _ in range(_TRIES):  # fixed-point iteration: columns follow from levels, and levels from columns
        shafts = {link: StickShaft(link, axis_of[link]) for link in axis_of if link != train.declaration.frame}
        columns = find_columns(train, planes, row, axis_of, shafts)
        for crank in columns.cranks:  # the shaft of the carrier, and one shaft on the carried axis, extend to the crank
            shafts[crank.carrier].xs.append(crank.x)
            borne = [shaft for shaft in shafts.values() if shaft.axis == crank.axis]
            min(borne, key=lambda shaft: min(shaft.xs, default=0.0)).xs.append(crank.x)
        for shaft in shafts.values():
            shaft.xs = shaft.xs or [0.3]
        spans = [
            *(
                (axis_in(train, axis_of, c.i, c.carrier), axis_in(train, axis_of, c.j, c.carrier), x)
                for c, x in columns.meshes
            ),
            *((axis_of[crank.carrier], crank.axis, crank.x) for crank in columns.cranks),
            *((one, other, x) for name, x in columns.elements for one, other in pairwise(_element_axes(train, name))),
        ]
        levels = find_levels(order, shafts, spans)
        row = {axis: level for level, axes in enumerate(levels) for axis in axes}
        rows, height = _set_heights(levels, shafts)
        meshes = [_mesh(circuit, x, train, axis_of, rows) for circuit, x in columns.meshes]
        elements = {}  # plates are above the shafts of one axis, or between two axes
        for name, x in columns.elements:
            own = [rows[axis] for axis in _element_axes(train, name)]
            low, high = min(own), max(own)
            elements[name] = (x, high[1] + _RISE if low == high else (low[1] + high[0]) / 2)
        # pairs of vertical lines that overlap in one column
        known = [(*sorted((row[one], row[other])), x) for one, other, x in spans]
        overlaps = sum(
            x == at and low < top and bottom < high
            for index, (low, high, x) in enumerate(known)
            for bottom, top, at in known[:index]
        )
        tries.append((overlaps, StickSkeleton(rows, shafts, meshes, columns, elements, height)))
        if not tries[-1][0]:
            break
    # the iteration may alternate between arrangements, so the one with the fewest overlaps is used
    return min(tries, key=lambda each: each[0])[1]


def _element_axes(train: GearTrain, name: str) -> list[str]:
    """Return the axes of the links that a brake or clutch joins, without duplicates."""
    axes = (train.kinematics.tree.axis(link) for link in train.declaration.clutches[name].links)
    return list(dict.fromkeys(axis for axis in axes if axis))


def _row_order(train: GearTrain, axis_of: dict[str, str]) -> list[str]:
    labels = list(dict.fromkeys(label for label in axis_of.values() if label))
    pairs = [(axis_in(train, axis_of, c.i, c.carrier), axis_in(train, axis_of, c.j, c.carrier)) for c in train.circuits]
    pairs += [pair for name in train.declaration.clutches for pair in pairwise(_element_axes(train, name))]
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
    """Set the heights of `shafts`; return the lowest and highest shaft height of each axis, and the total height [in].

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
    """Return True if two shafts on the same row do not overlap, including the name before each shaft."""
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
    """Return the fraction of the height between two axes that belongs to the lower wheel: proportional to its tooth
    count, but limited so that both labels fit.
    """
    rooms = [(text_width(f"{wheel} {count}") + _ROOM) / height for wheel, count in zip(wheels, counts, strict=True)]
    minimum, most = max(_SHORTEST, rooms[0]), 1 - max(_SHORTEST, rooms[1])
    return min(max(counts[0] / sum(counts), minimum), most) if minimum < most else (minimum + most) / 2


_MOST = 160  # maximum number of pairs on a page
PINS = {"pin_and_slot", "pin_follower", "pins_in_holes"}  # kinds of couplings that are drawn as a pin in a slot
_LONE = 0.55  # inches: height of a wheel that meshes with nothing
_HEAD, _FOOT = 0.7, 0.7
_KEY, _ENTRY = 0.5, 0.17  # inches: sample and height of an entry of the legend


def stick_figure(train: GearTrain, labels: bool = True, state: str | None = None) -> Figure:
    """Return a figure with axes, shafts, wheels, tooth counts, cranks of carriers, the frame, brakes and clutches.

    state   state whose brakes and clutches are drawn closed, by default the first state

    Raise `QuestionError` for more pairs than fit on a page, or if the state does not exist.
    """
    too_many(train, len(train.circuits), _MOST, "pairs")
    declared = train.declaration
    skeleton = find_skeleton(train)
    margin = 0.5 + max((len(link) for link in declared.links), default=1) * 8 * LETTER
    declared.check_state(state)
    needed = skeleton.columns.width + margin + 0.6
    width = max(needed, 5.5)
    margin += (width - needed) / 2
    figure, axes = sheet(width, skeleton.height + _HEAD + _FOOT, title_of(declared.name, declared.title))
    axes.set_xlim(-margin, width - margin)
    for text in list(axes.texts):
        text.set_position((0.15 - margin, skeleton.height + _HEAD - 0.12))
    drawing = _Drawing(axes, train, skeleton, declared.state_or_first(state))
    for axis, (low, _) in skeleton.rows.items():
        xs = [x for shaft in skeleton.shafts.values() if shaft.axis == axis for x in shaft.xs]
        ends = [min(xs) - 0.2, max(xs) + 0.25]
        draw_line(axes, ends, [low, low], PALE, 0.8, linestyle="-.", zorder=1, gid=f"axis {axis}")
        drawing.words.name_axis(axis, ends[1], low)
    for mesh in skeleton.meshes:
        drawing.draw_mesh(mesh)
    for crank in skeleton.columns.cranks:
        drawing.draw_crank(crank)
    for wheel, x in skeleton.columns.lone:
        link = declared.wheels[wheel][0]
        y = skeleton.shafts[link].y
        drawing.draw_wheel_line(x, y, y + _LONE, wheel, link)
        drawing.tick(x, y + _LONE, "spur")
    for shaft in skeleton.shafts.values():
        drawing.draw_shaft(shaft)
    for name in skeleton.elements:
        drawing.draw_element(name)
    if labels:
        drawing.words.write(axes)
    entries = list(_legend(train, any(patch.get_gid() == "ground" for patch in axes.patches)))
    widest = max(text_width(str(each.get_label()), SMALL - 1.5) for each in entries) + _KEY
    columns = min(len(entries), max(int(width / widest), 1), 5)
    foot = _FOOT + _ENTRY * max(ceil(len(entries) / columns) - 2, 0)
    axes.set_ylim(-foot, skeleton.height + _HEAD)
    figure.set_size_inches(width, skeleton.height + _HEAD + foot)
    figure.legend(handles=entries, loc="lower center", ncols=columns, fontsize=SMALL - 1.5, frameon=False)
    return figure


class _Drawing:
    """Drawing of a stick diagram in progress, with the parts that are already drawn."""

    def __init__(self, axes: Axes, train: GearTrain, skeleton: StickSkeleton, state: str | None) -> None:
        self.axes, self.train, self.skeleton, self.case = axes, train, skeleton, train.declaration.case(state)
        self.couplings = {
            row.id: each for each in train.declaration.couplings for row in each.rows(train.declaration.wheels)
        }
        self.feet: dict[str, tuple[float, float]] = {}
        self.words = StickLabels()
        for mesh in skeleton.meshes:
            ends = [mesh.meet, *(self._foot(link, mesh) for link in mesh.ends)]
            for x in (mesh.x, mesh.x + COLUMN) if mesh.ring else (mesh.x,):
                self.words.keep_off((x, x), (min(ends), max(ends)))
            for end in ends[1:] if mesh.kind in ("belt", "drum", "screw") else ():
                self.words.keep_off((mesh.x - 0.11, mesh.x + 0.11), (end - 0.12, end + 0.12))
        for crank in skeleton.columns.cranks:
            far = skeleton.rows[crank.axis][0]
            self.words.keep_off((crank.x, crank.x), (skeleton.shafts[crank.carrier].y, far))
            self.words.keep_off((crank.x - BEARING, crank.x + BEARING), (far - 0.07, far + 0.07))
        for name, (x, middle) in skeleton.elements.items():
            self.words.keep_off((x - 0.2, x + 0.2), (middle - 0.13, middle + 0.13))
            heights = [middle, *(end for end in self._ends(name) if end is not None)]
            self.words.keep_off((x - 0.1, x + 0.1), (min(heights), max(heights)))

    def draw_shaft(self, shaft: StickShaft) -> None:
        """Draw the shaft of a link with the link's name, and a bearing if the link turns in the frame."""
        left, right = min(shaft.xs) - 0.14, max(shaft.xs) + 0.14
        draw_line(self.axes, [left, right], [shaft.y, shaft.y], "white", LINK + 3.0, zorder=5)
        draw_line(self.axes, [left, right], [shaft.y, shaft.y], BLACK, LINK, zorder=6, gid=f"link {shaft.link}")
        joint, frame = left + BEARING, self.train.declaration.frame
        if self.train.kinematics.tree.top[shaft.link] == frame:
            draw_bearing(self.axes, joint, shaft.y, slides=shaft.link in self.train.declaration.sliding)
            self.words.keep_off((joint - BEARING, joint + BEARING), (shaft.y - BAR, shaft.y + BAR))
        braked = {self.train.declaration.clutches[name].fixes for name in self.case.engaged}
        fixed = shaft.link in self.case.fixed and shaft.link not in braked
        if fixed or self.case.inputs.get(shaft.link) == 0:
            draw_ground(self.axes, right + 0.045, shaft.y, upright=True)
            right += 0.09
        self.words.keep_off((left, right), (shaft.y, shaft.y))
        self.words.name_link(shaft.link, left, right, shaft.y)

    def draw_element(self, name: str) -> None:
        """Draw a brake or clutch between its members, with its name above its plates."""
        place, closed = self.skeleton.elements[name], name in self.case.engaged
        draw_element(self.axes, name, self.train.declaration.clutches[name], closed, place, self._ends(name))
        self.words.name_element(name, closed, *place)

    def _ends(self, name: str) -> list[float | None]:
        """Return the heights of the shafts that a brake or clutch joins [in]; None for the frame."""
        clutch = self.train.declaration.clutches[name]
        links = clutch.locks or (self.train.declaration.frame, *clutch.links)
        return [self.skeleton.shafts[link].y if link in self.skeleton.shafts else None for link in links]

    def draw_mesh(self, mesh: StickMesh) -> None:
        """Draw two wheels up to the point where they touch, or draw the coupling of two links."""
        low, high = (self._foot(link, mesh) for link in mesh.ends)
        if mesh.kind == "ring":
            self._draw_ring(mesh, low, high)
        elif mesh.name in self.couplings:
            self._draw_coupling(mesh, low, high)
        else:
            for wheel, link, foot, side in zip(mesh.wheels, mesh.ends, (low, high), (-1, 1), strict=True):
                end = mesh.meet + TOUCH * side
                self.draw_wheel_line(mesh.x, foot, end, wheel, link)
                self.tick(mesh.x, end, mesh.kind)

    def _foot(self, link: str, mesh: StickMesh) -> float:
        shaft = self.skeleton.shafts.get(link)
        if shaft is not None:
            return shaft.y
        carrier = next(circuit.carrier for circuit in self.train.circuits if circuit.id == mesh.name)
        return self.skeleton.rows[self.skeleton.shafts[carrier].axis][0] - 0.22

    def _draw_ring(self, mesh: StickMesh, low: float, high: float) -> None:
        """Draw the line of a planet, extended beyond its axis, and the ring wheel across and next to its end."""
        ring = mesh.wheels.index(mesh.ring)
        planet, side = 1 - ring, 1 if ring == 0 else -1
        foot = (low, high)
        end = mesh.meet - TOUCH * side
        self.draw_wheel_line(mesh.x, foot[planet], end, mesh.wheels[planet], mesh.ends[planet])
        self.tick(mesh.x, end, "spur")
        over, beside = mesh.meet + TOUCH * side, mesh.x + COLUMN
        draw_line(self.axes, [mesh.x - TICK, beside], [over, over], BLUE, WHEEL, zorder=4)
        self.draw_wheel_line(beside, foot[ring], over, mesh.ring, mesh.ends[ring])

    def _draw_coupling(self, mesh: StickMesh, low: float, high: float) -> None:
        """Draw a coupling by the symbol of its kind, with the name of the coupling and the names of its pulleys."""
        coupling, axes, x = self.couplings[mesh.name], self.axes, mesh.x
        circuit = next(circuit for circuit in self.train.circuits if circuit.id == mesh.name)
        # the driving link of a coupling is j
        turns, slides = (low, high) if mesh.ends[0] == circuit.j else (high, low)
        if coupling.kind == "belt":
            draw_belt(axes, x, (low, high), circuit.a * circuit.b > 0, mesh.name)
        elif coupling.kind == "screw":
            draw_screw(axes, x, turns, slides, mesh.name)
        elif coupling.kind == "rack":
            draw_rack(axes, x, mesh.meet, (turns, slides), mesh.name)
        elif coupling.kind == "drum":
            draw_drum(axes, x, turns, slides, mesh.name)
        elif coupling.kind in PINS or coupling.kind == "parallel":
            pins = tuple(link == getattr(coupling, "pin", None) and coupling.kind in PINS for link in mesh.ends)
            draw_pin(axes, x, mesh.meet, (low, high), pins, mesh.name)
            if any(pins):
                self.words.keep_off((x - 0.06, x + 0.06), (mesh.meet - 0.12, mesh.meet + 0.12))
        else:
            draw_joint(axes, x, mesh.meet, (low, high), coupling.kind, mesh.name)
            self.words.keep_off((x - 0.1, x + 0.1), (mesh.meet - 0.1, mesh.meet + 0.1))
        if self.train.declaration.frame in mesh.ends:
            self._ground(x, high if mesh.ends[1] == self.train.declaration.frame else low)
        for wheel, foot, end in zip(mesh.wheels, (low, high), (high, low), strict=True) if circuit.by_teeth else ():
            self._name_wheel(wheel, x, (foot, (foot + end) / 2), PURPLE)
        if not circuit.by_teeth or not coupling.by_teeth:
            self.words.name_upright(mesh.name, x, (low, high), PURPLE)

    def _name_wheel(self, wheel: str, x: float, ends: tuple[float, float], color: str) -> None:
        """Add the name and tooth count of a wheel along its vertical line, unless another line of it has this label."""
        if wheel not in self.feet:
            self.feet[wheel] = (x, ends[0])
            self.words.name_upright(f"{wheel} {self.train.declaration.wheels[wheel][1].count}", x, ends, color)

    def draw_wheel_line(self, x: float, foot: float, end: float, wheel: str, link: str) -> None:
        """Draw a wheel as a vertical line at `x` from its shaft (`foot`) to its mate (`end`) [in]."""
        draw_line(self.axes, [x, x], [foot, end], BLUE, WHEEL, zorder=3, gid=f"wheel {wheel}")
        if link == self.train.declaration.frame:
            self._ground(x, foot)
        known = self.feet.get(wheel)
        if known is not None and abs(known[0] - x) > 1e-9:  # another column, not a rounding difference
            level = foot + (0.09 if end > foot else -0.09)
            draw_line(self.axes, [known[0], x], [level, level], BLUE, WHEEL, zorder=3)
        self._name_wheel(wheel, x, (foot, end), BLUE)

    def draw_crank(self, crank: StickCrank) -> None:
        """Draw a carrier's arm, which ends in a bearing on the axis that the carrier carries."""
        y = self.skeleton.shafts[crank.carrier].y
        far = self.skeleton.rows[crank.axis][0]
        draw_line(self.axes, [crank.x, crank.x], [y, far], ORANGE, CARRIER, zorder=3, gid=f"crank {crank.carrier}")
        own = {link for link, shaft in self.skeleton.shafts.items() if shaft.axis == crank.axis}
        draw_bearing(self.axes, crank.x, far, ORANGE, not own.isdisjoint(self.train.declaration.sliding))

    def tick(self, x: float, y: float, kind: str) -> None:
        """Draw a tooth mark at (x, y) [in]: level, slanted (bevel, contrate), or long and dashed (worm)."""
        lean = {"bevel": 0.06, "contrate": 0.06}.get(kind, 0.0)
        reach = TICK * (1.6 if kind == "worm" else 1.0)
        style = (0, (1.2, 0.8)) if kind == "worm" else "-"
        self.words.keep_off((x - reach, x + reach), (y - lean, y + lean))
        draw_line(
            self.axes, [x - reach, x + reach], [y - lean, y + lean], BLUE, WHEEL, zorder=4, linestyle=style, gid="teeth"
        )

    def _ground(self, x: float, y: float) -> None:
        self.words.keep_off((x - 0.09, x + 0.09), (y - 0.045, y + 0.045))
        draw_ground(self.axes, x, y)


def _legend(train: GearTrain, held: bool) -> Iterator[Line2D | Patch]:
    yield Line2D([], [], color=BLACK, linewidth=LINK, label="links on their axes")
    if any(circuit.kind == "gear" for circuit in train.circuits):
        yield Line2D([], [], color=BLUE, linewidth=WHEEL, label="wheels")
    if held:
        yield Patch(facecolor="white", edgecolor=GREY, hatch="//////", label="held by the frame")
    if any(circuit.carrier != train.declaration.frame for circuit in train.circuits):
        yield Line2D([], [], color=ORANGE, linewidth=CARRIER, label="carriers")
    kinds = {coupling.kind for coupling in train.declaration.couplings}
    pins, others = kinds & PINS, kinds - PINS
    if pins:
        holes = "pins in holes" if pins == {"pins_in_holes"} else "pins in slots"
        yield Line2D([], [], color=PURPLE, linewidth=COUPLING, marker="o", label=holes)
    if others:
        label = "kept parallel" if others == {"parallel"} else "belts" if others == {"belt"} else "couplings"
        ends = {"marker": "|", "markersize": 8, "markeredgewidth": 2.0} if others == {"parallel"} else {}
        yield Line2D([], [], color=PURPLE, linewidth=COUPLING, label=label, **ends)  # type: ignore[arg-type]
    if train.declaration.clutches:
        ends = {"linewidth": STEM, "marker": "|", "markersize": 10, "markeredgewidth": PLATE}
        for color, words in ((PURPLE, "closed brakes and clutches"), (GREY, "open ones")):
            yield Line2D([], [], color=color, label=words, **ends)  # type: ignore[arg-type]
    if any(clutch.one_way for clutch in train.declaration.clutches.values()):
        yield Line2D([], [], color=GREY, linestyle="", marker=">", markersize=6, label="one-way clutches")
