"""Conditions on the plan of parallel axes: distances, rows, preferred sides, and clearance between wheels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import hypot

from geartrain.numerics.graphs import DisjointSets
from geartrain.numerics.vectors import Vector
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, Parallels, Point
from geartrain.scene.layout.wheel_modules import CrossingSide, SizedGeometry, WheelSize

# Default distances divided by radii of the wheels, chosen for legible pictures
_ENCLOSED = 0.12  # from the axis of a slot to that of a pin whose circle encloses it
_TIED = 1.6  # for other pins and slots
_CARRIED = 1.2  # from an axis to that of its carrier


@dataclass(frozen=True)
class PlanProblem:
    """Conditions on the positions of parallel axes in the plan: fixed points, distances, rows, and wheels."""

    labels: Sequence[str]
    """Labels of the parallel axes, in the order of their indices."""
    bearers: Mapping[str, str]
    """Link that carries each axis, by axis."""
    pivots: Mapping[str, str]
    """Axis of the carrier that carries each axis, by carried axis. The axis of the carrier is placed first."""
    fixed: Mapping[str, Point]
    """Points in the plan of the axes that cannot move [mm], by axis."""
    distances: Mapping[tuple[str, str], float]
    """Required distances between pairs of axes [mm]."""
    discs: Mapping[str, Mapping[str, WheelSize]]
    cluster: Mapping[str, int]
    """Index of the cluster of each wheel. The wheels of one cluster share a level."""
    mates: frozenset[frozenset[str]]
    rows: Mapping[tuple[str, str], Point] = field(default_factory=dict)
    """Pairs of axes, and the unit vector of the direction of the line on which both axes of a pair must lie."""
    sides: Mapping[str, Point] = field(default_factory=dict)
    """Direction in the plan from an axis to its crossing mate, which is preferably outside the other axes, by axis."""
    places: Mapping[str, int] = field(default_factory=dict)
    """Number of positions around its pivot at which a planet meshes with both sun and ring, by axis of the planet."""
    belts: Sequence[Mapping[str, float]] = ()
    """Radii of the pulleys of each belt [mm], by axis."""

    def radius(self, label: str) -> float:
        """Return the radius of the widest wheel on an axis [mm]."""
        return max((disc.outer for disc in self.discs[label].values()), default=0.0)


def plan_problem(
    geometry: SizedGeometry, parallels: Parallels, fixed: Mapping[str, Point], standing: Mapping[str, Vector]
) -> PlanProblem:
    """Return the conditions on the positions of parallel axes.

    fixed      points in the plan of the axes that cannot move [mm]
    standing   axes that are already placed; wheels that mesh with their wheels need no preferred side
    """
    declared, labels = geometry.declared, list(parallels.index)
    discs: dict[str, dict[str, WheelSize]] = {label: {} for label in labels}
    for wheel, axis in declared.axis.items():
        if axis in discs:
            discs[axis][wheel] = geometry.sizes[wheel]
    pivots = {line.label: line.pivots[0] for line in parallels.lines if line.pivots}
    forced = {pair: far for pair, far in geometry.modules.distances.items() if parallels.index.keys() >= set(pair)}
    # 1 mm for an axis without wheels, because chosen distances are relative to radii
    radius = {label: max((disc.outer for disc in discs[label].values()), default=1.0) for label in labels}
    chosen = _chosen_distances(declared, forced, pivots, radius)
    crossing = [each for each in geometry.crossing if each.side.axis in parallels.index]
    return PlanProblem(
        labels,
        {line.label: line.bearers[0] for line in parallels.lines},
        pivots,
        fixed,
        {**forced, **chosen},
        discs,
        geometry.modules.cluster,
        frozenset(frozenset(contact.wheels) for contact in declared.contacts),
        dict(_rows(declared, parallels, crossing)),
        dict(_sides(declared, parallels, [each for each in crossing if each.side.mate_axis not in standing])),
        dict(_assembly_places(declared, parallels)),
        declared.belts,
    )


def _chosen_distances(
    declared: DeclaredGeometry,
    forced: Mapping[tuple[str, str], float],
    pivots: Mapping[str, str],
    radius: Mapping[str, float],
) -> dict[tuple[str, str], float]:
    """Return distances [mm] for pairs of axes without a declared or required distance, by pair: pins and carried axes.

    forced   required distances
    pivots   axis of the carrier of each carried axis
    radius   radius of the widest wheel on each axis [mm]
    """
    found: dict[tuple[str, str], float] = {}
    joined: DisjointSets[str] = DisjointSets()
    for pair in forced:
        joined.join(*pair)
    for tie in declared.ties:
        pair = tie.axis_pair
        if tie.offset is None and radius.keys() >= set(pair) and pair not in forced and pair not in found:
            if tie.encloses:
                found[pair] = _ENCLOSED * min(radius[end] for end in pair)
            elif joined.are_apart(*pair):
                clear = 1.1 * sum(radius[end] for end in pair)
                found[pair] = _TIED * radius[tie.axes[0]] if tie.wish is None else max(tie.wish, clear)
            joined.join(*pair)
    for label, pivot in pivots.items():
        if pivot in radius and joined.are_apart(label, pivot):
            pair = min(label, pivot), max(label, pivot)
            found[pair] = _CARRIED * (radius[label] + min(radius[pivot], radius[label]))
            joined.join(label, pivot)
    return found


def _rows(
    declared: DeclaredGeometry, parallels: Parallels, crossing: Sequence[CrossingSide]
) -> Iterator[tuple[tuple[str, str], Point]]:
    """Yield pairs of parallel axes whose wheels mesh with wheels on one crossing axis, and its direction."""
    met: dict[str, list[str]] = {}
    for each in crossing:
        if each.contact.kind != "screw":
            met.setdefault(each.side.mate_axis, []).append(each.side.axis)
    for across, ends in met.items():
        u, v = parallels.flat(declared.lines[across].direction)
        length = hypot(u, v)
        for first, second in pairwise(dict.fromkeys(ends)):
            yield (first, second), (u / length, v / length)


def _sides(
    declared: DeclaredGeometry, parallels: Parallels, crossing: Sequence[CrossingSide]
) -> Iterator[tuple[str, Point]]:
    for each in crossing:
        u, v = parallels.flat(declared.lines[each.side.mate_axis].direction)
        sense = 1.0 if each.mate_seat.far > 0 else -1.0
        yield each.side.axis, (sense * u, sense * v)


def _assembly_places(declared: DeclaredGeometry, parallels: Parallels) -> Iterator[tuple[str, int]]:
    """Yield each axis of planets between a sun and a ring with its number of assembly positions, z_sun + z_ring."""
    counts: dict[tuple[str, str], list[tuple[str, int]]] = {}  # axis and wheel of a planet -> kind and teeth of mates
    for contact in declared.contacts:
        for side in contact.sides:
            pivots = declared.lines[side.axis].pivots
            if side.axis in parallels.index and pivots and pivots[0] == side.mate_axis and contact.parallel:
                mate = contact.kind, declared.count(side.mate)
                counts.setdefault((side.axis, side.wheel), []).append(mate)
    for (axis, _), mates in counts.items():
        last = dict(mates)  # the last of each kind
        if len(last) == 2:
            yield axis, last["side"] + last["ring"]
