"""The skeleton of a train on a page: axes as rows, meshes in columns, shafts in lanes of their axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import arrange
from geartrain.drawing.labels import text_width
from geartrain.drawing.stick_grid import (
    StickCrank,
    StickShaft,
    axis_in,
    find_columns,
    find_levels,
    find_planes,
    ring_of,
)
from geartrain.kinematics.circuits import Circuit

LANE, GAP = 0.17, 1.7  # inches from shaft to shaft of one axis, and between the shafts of neighbouring axes
_TRIES = 6  # arrangements of columns and levels
_SHORTEST = 0.32  # of the height between two axes, the smaller of two wheels
_ROOM = 0.24  # inches between the ends of words along a wheel, its shaft and its mate
REACH = 0.34  # inches of a planet beyond its axis, where its ring meets it


@dataclass(frozen=True, slots=True)
class StickMesh:
    """A gear pair or coupling in its column, between two rows; `ring` is the wheel that is one, or empty.

    ends   links, the one on the lower row first; wheels, theirs (of a coupling the links again)
    x      column; of a ring's own upright, `x` + one column
    low, high   ends of what it takes of its column (inches)
    meet   height at which its wheels touch
    """

    name: str
    kind: str
    ends: tuple[str, str]
    wheels: tuple[str, str]
    ring: str
    x: float
    low: float
    high: float
    meet: float


_Try = tuple[
    dict[str, StickShaft],
    list[tuple[Circuit, float]],
    list[StickCrank],
    list[tuple[str, float]],
    float,
    list[list[str]],
]


@dataclass(frozen=True, slots=True)
class StickSkeleton:
    """All of it, in inches from the lower left corner.

    rows    axis -> height of its lowest and highest shaft, from below
    lone    wheels that mesh with nothing, with their column
    """

    rows: dict[str, tuple[float, float]]
    shafts: dict[str, StickShaft]
    meshes: list[StickMesh]
    cranks: list[StickCrank]
    lone: list[tuple[str, float]]
    width: float
    height: float


def find_skeleton(train: GearTrain) -> StickSkeleton:
    """Places for axes, shafts, meshes and cranks; what belongs together stands together."""
    axis_of = _axes(train)
    order, planes = _row_order(train, axis_of), find_planes(train)
    row = {axis: at for at, axis in enumerate(order)}
    tries: list[tuple[int, int, _Try]] = []
    for at in range(_TRIES):  # columns follow from levels, and levels from columns
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
        tries.append((_hidden(spans, row), at, (shafts, columns, cranks, lone, width, levels)))
        if not tries[-1][0]:
            break
    shafts, columns, cranks, lone, width, levels = min(tries)[2]
    rows, height = _lanes(levels, shafts)
    meshes = [_mesh(circuit, x, train, axis_of, rows) for circuit, x in columns]
    return StickSkeleton(rows, shafts, meshes, cranks, lone, width, height)


def _hidden(spans: Sequence[tuple[str, str, float]], row: dict[str, int]) -> int:
    """How many uprights lie on another one."""
    known = [(*sorted((row[one], row[other])), x) for one, other, x in spans]
    return sum(
        x == at and low < top and bottom < high
        for index, (low, high, x) in enumerate(known)
        for bottom, top, at in known[:index]
    )


def _reach_cranks(shafts: dict[str, StickShaft], cranks: Sequence[StickCrank]) -> None:
    """Carriers reach their cranks, and so does what turns on an axis they bear."""
    for crank in cranks:
        shafts[crank.carrier].xs.append(crank.x)
        borne = [shaft for shaft in shafts.values() if shaft.axis == crank.axis]
        min(borne, key=lambda shaft: min(shaft.xs, default=0.0)).xs.append(crank.x)
    for shaft in shafts.values():
        shaft.xs = shaft.xs or [0.3]


def _axes(train: GearTrain) -> dict[str, str]:
    """Link -> label of the axis it is drawn on."""
    tree = train.kinematics.tree
    return {link: tree.axis(link) or "" for link in train.declaration.links}


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


def _lanes(
    levels: Sequence[Sequence[str]], shafts: dict[str, StickShaft]
) -> tuple[dict[str, tuple[float, float]], float]:
    """Heights: on one axis, shafts that overlap lie above each other, the longest lowest."""
    rows: dict[str, tuple[float, float]] = {}
    y = 0.45
    for level in levels:
        top = y
        for axis in level:
            own = sorted((each for each in shafts.values() if each.axis == axis), key=lambda s: min(s.xs) - max(s.xs))
            lanes: list[list[StickShaft]] = []
            for shaft in own:
                at = next(
                    (at for at, lane in enumerate(lanes) if all(_apart(shaft, each) for each in lane)), len(lanes)
                )
                if at == len(lanes):
                    lanes.append([])
                lanes[at].append(shaft)
                shaft.y = y + at * LANE
            rows[axis] = (y, y + (len(lanes) - 1) * LANE)
            top = max(top, rows[axis][1])
        y = top + GAP
    return rows, y - GAP + 0.6


def _apart(one: StickShaft, other: StickShaft) -> bool:
    """True if two shafts, with a name before each, leave each other room."""
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
    if top - bottom > GAP * 1.01:  # other axes lie between: the wheels touch beside the smaller one's
        bottom, top = (bottom, bottom + GAP) if first < second else (top - GAP, top)
    meet = bottom + _share(wheels, (first, second), top - bottom) * (top - bottom)
    return StickMesh(circuit.id, kind, (low, high), wheels, "", x, bottom, top, meet)


def _share(wheels: tuple[str, str], counts: tuple[int, int], height: float) -> float:
    """What the lower wheel takes of the height: by its teeth, as long as the words beside both find room."""
    rooms = [(text_width(f"{wheel} {count}") + _ROOM) / height for wheel, count in zip(wheels, counts, strict=True)]
    least, most = max(_SHORTEST, rooms[0]), 1 - max(_SHORTEST, rooms[1])
    return min(max(counts[0] / sum(counts), least), most) if least < most else (least + most) / 2
