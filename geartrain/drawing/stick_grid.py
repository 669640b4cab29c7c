"""Grid of a stick diagram: levels for axes, and columns in which meshes that share a wheel are close together.

The grid is chosen so that few lines cross and no part hides another.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import arrange, breadth_first, neighbours
from geartrain.drawing.stick_symbols import element_width
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.graphs import joined_groups

_NEAREST = 9  # levels tried for an axis


@dataclass(slots=True)
class StickShaft:
    """Shaft of a link other than the frame on its axis, with its height and the abscissae of its parts [in]."""

    link: str
    axis: str
    y: float = 0.0
    xs: list[float] = field(default_factory=list)


def find_levels(
    order: Sequence[str], shafts: dict[str, StickShaft], spans: Sequence[tuple[str, str, float]]
) -> list[list[str]]:
    """Return the axes on each level, starting with the lowest level, by greedy search.

    Axes that do not overlap may share a level. Each axis is placed near the axes with which it is paired.

    spans   vertical lines between two axes, with the abscissa of their column
    """
    ends = {axis: _ends(axis, shafts) for axis in order}
    level: dict[str, int] = {}
    pairs = [(one, other) for one, other, _ in spans]
    mates = neighbours(order, pairs)
    # from the axis with the most neighbours
    for axis in breadth_first(sorted(order, key=lambda axis: -len(set(mates[axis]))), pairs):
        near = [level[mate] for mate in mates[axis] if mate in level]
        middle = round(sum(near) / len(near)) if near else 0
        trials = [
            middle + step for step in sorted(range(-len(order), len(order) + 1), key=lambda step: (abs(step), step))
        ]
        free = [each for each in trials if each not in near and _fits(axis, each, level, ends)]
        level[axis] = min(free[:_NEAREST], key=lambda each: _cost(axis, each, level, ends, spans))
    levels = sorted(set(level.values()))
    return [[axis for axis in order if level[axis] == each] for each in levels]


def _ends(axis: str, shafts: dict[str, StickShaft]) -> tuple[float, float]:
    """Return the interval [in] that an axis, the names of its links and its own name occupy on its level."""
    own = [shaft for shaft in shafts.values() if shaft.axis == axis]
    left = min(min(shaft.xs) - 0.25 - 0.085 * len(shaft.link) for shaft in own)
    return left, max(max(shaft.xs) for shaft in own) + 0.35 + 0.065 * len(axis)


def _fits(axis: str, here: int, level: dict[str, int], ends: dict[str, tuple[float, float]]) -> bool:
    left, right = ends[axis]
    return all(right < ends[other][0] or ends[other][1] < left for other, each in level.items() if each == here)


def _cost(
    axis: str,
    here: int,
    level: dict[str, int],
    ends: dict[str, tuple[float, float]],
    spans: Sequence[tuple[str, str, float]],
) -> float:
    """Return the cost of placing an axis on a level: lengths [levels], crossings and overlaps of its vertical lines.

    here    number of the level
    spans   vertical lines: the two axes and the abscissa of each line
    """
    cost = 0.3 * abs(here)
    placed = {**level, axis: here}
    known = [(*sorted((placed[one], placed[other])), x, axis in (one, other)) for one, other, x in spans
             if one in placed and other in placed]  # fmt: skip
    for low, high, x, own in known:
        if own:
            cost += high - low
            cost += 2 * sum(low < each < high and ends[other][0] < x < ends[other][1] for other, each in level.items())
            cost += 20 * sum(x == at and low < top and bottom < high for bottom, top, at, mine in known if not mine)
        else:
            cost += 2 * (low < here < high and ends[axis][0] < x < ends[axis][1])
    return cost


COLUMN, _PLANE = 0.3, 0.34  # inches between meshes of a group that shares wheels, and between groups
_CRANK = 0.3  # inches for a carrier's crank before a group
_SIDE = 0.1  # inches between the columns of a group and of a brake or clutch


@dataclass(frozen=True, slots=True)
class StickCrank:
    """Arm of a carrier at the abscissa `x` [in], from the carrier's shaft to the axis that the carrier carries."""

    carrier: str
    axis: str
    x: float


@dataclass(slots=True)
class StickColumns:
    """Columns of a diagram, each with its abscissa [in], and the total width of the diagram [in]."""

    meshes: list[tuple[Circuit, float]] = field(default_factory=list)
    cranks: list[StickCrank] = field(default_factory=list)
    lone: list[tuple[str, float]] = field(default_factory=list)
    """Wheels that have no mate, each with its abscissa [in]."""
    elements: list[tuple[str, float]] = field(default_factory=list)
    """Brakes and clutches, each with its abscissa [in]."""
    width: float = 0.0


def axis_in(train: GearTrain, axis_of: dict[str, str], link: str, carrier: str) -> str:
    """Return the axis on which a link is drawn in a mesh; the frame is drawn on the axis of the mesh's carrier."""
    return axis_of[link] or axis_of[carrier]


def find_planes(train: GearTrain) -> list[list[Circuit] | str]:
    """Return groups of meshes that share wheels, and names of brakes and clutches, with items of a link adjacent."""
    circuits = {circuit.id: circuit for circuit in train.circuits}
    by_wheel: dict[str, list[str]] = {}
    for circuit in train.circuits:
        for wheel in circuit.wheels if circuit.kind == "gear" else ():
            by_wheel.setdefault(wheel, []).append(circuit.id)
    pairs = [pair for names in by_wheel.values() for pair in pairwise(names)]
    ordered = breadth_first(list(circuits), pairs)  # one group after the other
    planes = {names[0]: names for names in joined_groups(ordered, pairs)}
    home = {name: plane for plane, names in planes.items() for name in names}
    by_link: dict[str, list[str]] = {}
    for circuit in train.circuits:
        for link in (circuit.i, circuit.j):
            if link != train.declaration.frame:
                by_link.setdefault(link, []).append(home[circuit.id])
    elements = {f" {name}": name for name in train.declaration.clutches}  # no name of a mesh begins with a blank
    for element, name in elements.items():
        for link in train.declaration.clutches[name].links:
            by_link.setdefault(link, []).append(element)
    order = arrange([*planes, *elements], [pair for names in by_link.values() for pair in pairwise(names)])
    return [elements.get(each) or [circuits[name] for name in planes[each]] for each in order]


def find_columns(
    train: GearTrain,
    planes: Sequence[Sequence[Circuit] | str],
    row: dict[str, int],
    axis_of: dict[str, str],
    shafts: dict[str, StickShaft],
) -> StickColumns:
    """Return the columns of all meshes, brakes, clutches and cranks, and of all wheels without a mesh.

    A crank is placed before the first group in which its carried axis meshes. Abscissae are appended to `shafts` in
    place.
    """
    found, tree = StickColumns(), train.kinematics.tree
    borne: set[str] = set()
    x = 0.0
    for plane in planes:
        if isinstance(plane, str):
            half = element_width(plane) / 2
            x += half + _SIDE
            found.elements.append((plane, x))
            for link in train.declaration.clutches[plane].links:
                if link in shafts:
                    shafts[link].xs.append(x)
            x += half - _SIDE
            continue
        taken: list[list[tuple[float, float]]] = []
        for circuit in plane:
            for axis in (axis_of[circuit.i], axis_of[circuit.j]):
                links = (link for link, own in axis_of.items() if own == axis and link in tree.top)
                # the moving link that carries the axis
                bearer = next((tree.top[each] for each in links if tree.top[each] != train.declaration.frame), None)
                if axis and axis not in borne and bearer is not None:
                    borne.add(axis)
                    x += _CRANK
                    found.cranks.append(StickCrank(bearer, axis, x))
        x += _PLANE
        for circuit in plane:
            column = _free_column(taken, circuit, train, axis_of, row)
            here = x + column * COLUMN
            found.meshes.append((circuit, here))
            for link in (circuit.i, circuit.j):
                if link in shafts:
                    ring = ring_of(train, circuit)
                    own = ring and train.declaration.wheels[ring][0] == link
                    shafts[link].xs.append(here + (COLUMN if own else 0.0))
        x += len(taken) * COLUMN
    meshing = {wheel for circuit in train.circuits for wheel in circuit.wheels if circuit.by_teeth}
    for name, (link, _) in train.declaration.wheels.items():
        if name not in meshing and link in shafts:
            x += _PLANE + COLUMN
            found.lone.append((name, x))
            shafts[link].xs.append(x)
    found.width = x + _PLANE
    return found


def ring_of(train: GearTrain, circuit: Circuit) -> str:
    """Return the name of the ring wheel of a gear pair; empty for a pair without a ring and for a coupling."""
    if circuit.kind != "gear":
        return ""
    return next((wheel for wheel in circuit.wheels if train.declaration.wheels[wheel][1].internal), "")


def _free_column(
    taken: list[list[tuple[float, float]]],
    circuit: Circuit,
    train: GearTrain,
    axis_of: dict[str, str],
    row: dict[str, int],
) -> int:
    """Return the first column with space for a mesh (two columns for a ring), and mark the space as `taken`."""
    one, other = (row[axis_in(train, axis_of, link, circuit.carrier)] for link in (circuit.i, circuit.j))
    low, high = float(min(one, other)), float(max(one, other))
    ring = ring_of(train, circuit)
    spans = [(low, high)]
    if ring:
        planet = other if train.declaration.wheels[ring][0] == circuit.i else one
        beyond = (planet, planet + 0.4) if planet == high else (planet - 0.4, planet)
        spans = [beyond, (min(low, beyond[0]), max(high, beyond[1]))]
    at = 0
    while not all(_clear(taken, at + step, span) for step, span in enumerate(spans)):
        at += 1
    for step, span in enumerate(spans):
        while len(taken) <= at + step:
            taken.append([])
        taken[at + step].append(span)
    return at


def _clear(taken: list[list[tuple[float, float]]], column: int, span: tuple[float, float]) -> bool:
    return column >= len(taken) or all(span[1] <= low or high <= span[0] for low, high in taken[column])
