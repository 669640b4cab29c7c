"""Modules and sizes of wheels, which are determined by the train, declared, or chosen.

Wheels that mesh share a module, so each cluster of meshing wheels has one module. Two pairs between the same two axes
force the ratio of the modules of their clusters. These ratios are stored in a weighted union-find structure as exact
fractions. The scale of a group of clusters is given by a declared module. If there is none, it is a least squares fit
of declared distances, or the median of all known modules.

Free modules are changed until every closed chain of axes can close (polygon inequality). The method is relaxation: each
distance that is longer than the shortest path between its ends is shortened, or that path is lengthened, repeatedly.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise, product
from math import atan2, tan
from statistics import median

from geartrain.numerics.graphs import RatioSets, joined_groups
from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import Vector, across, cross, dot, minus, size, unit
from geartrain.scene.layout.declared_geometry import ContactSide, DeclaredGeometry, PitchContact
from geartrain.teeth.standard_teeth import DEDENDUM

# -------------------------------------------------------------------------------------------------------- closed chains


_ROUNDS = 12  # passes over all distances, because changes affect each other
_MOST = 300  # maximum number of distances for which chains are closed: time grows with its square
_TIGHT = 0.97  # maximum of a distance over the path round it: more leaves no space for wheels
_LOOSE = 0.85  # target of that ratio
_MINIMUM = Fraction(1, 1000)  # minimum factor of a module in one step


@dataclass(frozen=True, slots=True)
class AxisDistance:
    """Distance between two axes: `times` modules of the cluster `root`, or `times` mm if `root` is None."""

    axes: tuple[str, str]
    times: float
    root: int | None

    def length(self, modules: Mapping[int, Fraction]) -> float:
        """Return the distance between the axes [mm] for given modules of the clusters [mm]."""
        return self.times * (1.0 if self.root is None else float(modules[self.root]))


def close_chains(
    distances: Sequence[AxisDistance], modules: Mapping[int, Fraction], free: frozenset[int]
) -> dict[int, Fraction]:
    """Return the modules of clusters of wheels [mm], changed so that the distances around all loops of axes can close.

    free   clusters whose modules may be changed
    """
    found = dict(modules)
    if not free or len(distances) > _MOST:
        return found
    for _ in range(_ROUNDS):
        changed = [_relax(distances, at, found, free) for at in range(len(distances))]
        if not any(changed):
            break
    return found


def _relax(distances: Sequence[AxisDistance], at: int, modules: dict[int, Fraction], free: frozenset[int]) -> bool:
    """Shorten the distance `at` or lengthen the path between its ends, by a module; return True if changed."""
    one = distances[at]
    way = _way_round(distances, at, modules)
    length, way_length = one.length(modules), sum(other.length(modules) for other in way)
    if not way or length <= _TIGHT * way_length:
        return False
    rest = [other for other in way if other.root != one.root]
    if one.root in free and rest:
        same = way_length - sum(other.length(modules) for other in rest)
        # distances of the path with the same module shrink too; the floor keeps the factor positive if both are equal
        factor = _LOOSE * (way_length - same) / max(length - _LOOSE * same, 1e-9 * length)
        if 0 < factor < 1:
            modules[one.root] *= _simple(factor) or _MINIMUM
            return True
    loose = [other for other in rest if other.root in free]
    part = sum(other.length(modules) for other in loose)
    if not part:
        return False
    # only the free part of the path grows: way_length + (factor - 1) part = length / _LOOSE
    factor = 1 + (length / _LOOSE - way_length) / part
    for root in {other.root for other in loose if other.root is not None}:
        modules[root] *= _simple(factor)
    return True


def _simple(factor: float) -> Fraction:
    """Return the nearest fraction with a denominator of at most 1000, which may be 0, so that modules are simple."""
    return Fraction(factor).limit_denominator(1000)


def _way_round(distances: Sequence[AxisDistance], at: int, modules: Mapping[int, Fraction]) -> list[AxisDistance]:
    """Return the shortest path between the axes of the distance `at` that avoids it (Dijkstra); empty if none."""
    import networkx as nx

    graph: nx.Graph[str] = nx.Graph()
    # the longest first, so that the shortest of several distances between two axes replaces the others
    for one in sorted((*distances[:at], *distances[at + 1 :]), key=lambda one: -one.length(modules)):
        graph.add_edge(*one.axes, distance=one, weight=one.length(modules))
    try:
        way = nx.dijkstra_path(graph, *distances[at].axes)
    except (nx.NodeNotFound, nx.NetworkXNoPath):
        return []
    return [graph.edges[step]["distance"] for step in pairwise(way)]


# -------------------------------------------------------------------------------------------------------- wheel modules


_MODULE = Fraction(1)  # mm: default module


@dataclass(frozen=True, slots=True)
class WheelModules:
    """Modules of the wheels of a train, and the distances between axes that result from them."""

    cluster: Mapping[str, int]
    """Index of the cluster of each wheel, by wheel. A cluster is a set of wheels that meshes connect."""
    module: Mapping[str, float]
    """Module of each wheel [mm], by wheel."""
    declared: frozenset[str]
    distances: Mapping[tuple[str, str], float]
    """Required distance [mm] by pair of axes: the declared offset of a pin, or the mean distance of the gear pairs."""


def pitch_distance(geometry: DeclaredGeometry, module: Mapping[str, float], contact: PitchContact) -> float:
    """Return the distance between the axes of a gear pair [mm] at which pitch circles touch or declared teeth mesh."""
    first, second = (float(geometry.radius(wheel)) * module[wheel] for wheel in contact.wheels)
    return float(contact.stretch) * (abs(first - second) if contact.kind == "ring" else first + second)


class _ModuleSearch:
    """Search for the modules of the clusters of one train, exact if the declaration is exact.

    A declared module takes precedence, then declared positions, then the ratios that pairs between the same axes force.
    A free module is the median of all known modules, or 1 mm, and is changed if closed chains of axes require it.

    cluster   number of the cluster of each wheel
    between   gear pairs with parallel axes and worm gear pairs, by their axes
    own       declared modules by wheel
    given     declared module by cluster: the module of its first wheel with a declared module
    """

    def __init__(self, geometry: DeclaredGeometry) -> None:
        self.geometry = geometry
        groups = joined_groups(geometry.wheels, (contact.wheels for contact in geometry.contacts))
        number = {wheel: at for at, group in enumerate(groups) for wheel in group}
        self.cluster = {wheel: number[wheel] for wheel in geometry.wheels}
        self.clusters = range(len(groups))
        self.between: dict[tuple[str, str], list[PitchContact]] = {}
        for contact in geometry.contacts:
            if contact.parallel or contact.kind == "screw":
                self.between.setdefault(contact.axis_pair, []).append(contact)
        self.own: dict[str, Fraction] = {}
        self.given: dict[int, Fraction] = {}
        for wheel, (_, declared) in geometry.wheels.items():
            if declared.module is not None:
                self.own[wheel] = millimetres(declared.module)
                self.given.setdefault(self.cluster[wheel], self.own[wheel])

    def found(self) -> WheelModules:
        cluster, given = self.cluster, self.given
        roots = self._anchored()
        free = frozenset(root for root, _ in self._multiples if root not in roots)
        known = [
            float(given.get(at, roots[root] * times))
            for at, (root, times) in enumerate(self._multiples)
            if root in roots
        ]
        roots |= dict.fromkeys(sorted(free), Fraction(median(known)) if known else _MODULE)
        roots = close_chains(list(self._chained()), roots, free)
        modules = [given.get(at, roots[root] * times) for at, (root, times) in enumerate(self._multiples)]
        module = {wheel: float(self.own.get(wheel, modules[at])) for wheel, at in cluster.items()}
        declared = frozenset(wheel for wheel, at in cluster.items() if at in given)
        return WheelModules(cluster, module, declared, dict(self._distances(module)))

    @cached_property
    def _multiples(self) -> list[tuple[int, Fraction]]:
        """Cluster on whose module each cluster's module depends, and the factor between the two modules."""
        ratios: RatioSets[int] = RatioSets()
        for contacts in self.between.values():
            for first, second in pairwise(contacts):
                self._join(ratios, first, second)
        # after all constraints, a choice: the axes of a pin and its slot, which are close together, have the same
        # distance from each axis with which both mesh
        nearby = [tie for tie in self.geometry.ties if tie.encloses and len(self.given) < len(self.clusters)]
        for tie, other in product(nearby, self.geometry.lines):
            met = [self.between.get((min(end, other), max(end, other)), [])[:1] for end in tie.axes]
            if all(met):
                self._join(ratios, met[0][0], met[1][0])
        return [ratios.root(at) for at in self.clusters]

    def _join(self, ratios: RatioSets[int], first: PitchContact, second: PitchContact) -> None:
        """Record the ratio of the modules of two pairs on the same axes, which must have equal centre distances."""
        ends = self.cluster[first.wheels[0]], self.cluster[second.wheels[0]]
        far, other = self.geometry.distance(first), self.geometry.distance(second)
        if far and other and not (ends[0] in self.given and ends[1] in self.given):
            ratios.join(*ends, far / other)

    def _anchored(self) -> dict[int, Fraction]:
        """Return known modules [mm] by cluster: declared, or from declared axis positions by least squares."""
        # for distances d_i = m a_i with one unknown module m, the solution is m = sum a_i d_i / sum a_i^2
        roots: dict[int, Fraction] = {}
        for at, module in self.given.items():
            root, times = self._multiples[at]
            roots.setdefault(root, module / times)
        products: dict[int, Fraction] = {}
        squares: dict[int, Fraction] = {}
        for axes, contacts in self.between.items():
            far = self._declared_distance(axes)
            if not far:
                continue
            for contact in contacts:
                root, times = self._multiples[self.cluster[contact.wheels[0]]]
                distance = self.geometry.distance(contact) * times
                products[root] = products.get(root, Fraction(0)) + distance * far
                squares[root] = squares.get(root, Fraction(0)) + distance * distance
        return {root: products[root] / square for root, square in squares.items() if square} | roots

    def _declared_distance(self, axes: tuple[str, str]) -> Fraction | None:
        """Return the distance of two axes [mm] from their declared points or a pin's offset; None if undeclared."""
        first, second = (self.geometry.lines[name] for name in axes)
        if first.given is not None and second.given is not None:
            apart = minus(second.given, first.given)
            if first.group == second.group:
                return Fraction(size(across(apart, first.direction)))
            return Fraction(abs(dot(apart, unit(cross(first.direction, second.direction)))))
        return next((tie.offset for tie in self.geometry.ties if set(tie.axes) == set(axes)), None)

    def _chained(self) -> Iterator[AxisDistance]:
        """Yield the distances of parallel axes, each as a multiple of the module on which it depends, or in mm."""
        lines = self.geometry.lines
        placed = [label for label, line in lines.items() if line.given is not None]
        # a chain of the fixed axes is sufficient to find the paths between all of them
        for pair in pairwise(placed):
            if lines[pair[0]].group == lines[pair[1]].group:
                yield AxisDistance(pair, float(self._declared_distance(pair) or 0), None)
        for axes, contacts in self.between.items():
            if contacts[0].kind != "screw" and not set(axes) <= set(placed):
                root, times = self._multiples[self.cluster[contacts[0].wheels[0]]]
                yield AxisDistance(axes, float(self.geometry.distance(contacts[0]) * times), root)
        for tie in self.geometry.ties:
            if tie.offset is not None:
                yield AxisDistance(tie.axes, float(tie.offset), None)

    def _distances(self, module: Mapping[str, float]) -> Iterator[tuple[tuple[str, str], float]]:
        for axes, contacts in self.between.items():
            far = [pitch_distance(self.geometry, module, contact) for contact in contacts]
            yield axes, sum(far) / len(far)
        for tie in self.geometry.ties:
            if tie.offset is not None:
                # after the gear pairs, so that a declared offset replaces their distance
                yield tie.axis_pair, float(tie.offset)


# ---------------------------------------------------------------------------------------------------------- wheel sizes


_TIP = DEDENDUM  # modules of free space beyond the pitch circle: addendum and clearance
_RING = 3.5  # modules from the pitch circle of a ring to the outside of its rim
WIDE = 2.5  # default thickness in modules
_SLOT = 1.4  # spacing of slots in thicknesses
_WORM = 12.0  # length of a worm in modules


@dataclass(frozen=True, slots=True)
class Seat:
    """Position of a wheel in a pair on non-parallel axes, relative to the nearest points of both axes."""

    far: float
    """Distance of the wheel's centre along its axis from the point nearest to the other axis [mm]."""
    cone: float
    """Half angle of the wheel's pitch cone [rad]; 0 for a cylinder."""
    out: Vector
    """Unit vector perpendicular to the wheel's axis, towards the pitch point."""


def seats(geometry: DeclaredGeometry, contact: PitchContact, radii: tuple[float, float]) -> tuple[Seat, Seat]:
    """Return the seats of both wheels of a pair with non-parallel axes.

    With the shaft angle S and the tooth counts z, the first wheel of a bevel pair has the cone half angle d_1 with
    tan d_1 = sin S / (z_2/z_1 + cos S). The pitch cylinder of a crown wheel's pinion rolls on a cone of half angle S.
    """
    if contact.kind == "screw":
        worm, wheel = (geometry.lines[axis] for axis in contact.axes)
        out = unit(cross(wheel.direction, worm.direction))
        if worm.given is not None and wheel.given is not None and dot(minus(wheel.given, worm.given), out) < 0:
            out = opposite(out)
        return Seat(0.0, 0.0, out), Seat(0.0, 0.0, opposite(out))
    facing, other_facing = (geometry.wheel(wheel).facing for wheel in contact.wheels)
    first_way, second_way = (geometry.lines[axis].direction for axis in contact.axes)
    n = first_way if facing > 0 else opposite(first_way)
    m = second_way if other_facing > 0 else opposite(second_way)
    sine, cosine = size(cross(n, m)), dot(n, m)
    first, second = radii
    out, other_out = unit(across(m, n)), unit(across(n, m))
    if contact.kind == "crown":
        reach = (first + second * cosine) / sine
        return (
            Seat(facing * (second * sine + reach * cosine), atan2(sine, cosine), out),
            Seat(other_facing * reach, 0.0, other_out),
        )
    cone = atan2(sine * first, second + first * cosine)  # not atan: for obtuse shaft angles the cosine is negative
    other_cone = atan2(sine * second, first + second * cosine)
    return (
        Seat(facing * first / tan(cone), cone, out),
        Seat(other_facing * second / tan(other_cone), other_cone, other_out),
    )


def opposite(v: Vector) -> Vector:
    """Return the opposite of a vector, with 0.0 instead of -0.0, which would be printed in pictures."""
    return minus((0.0, 0.0, 0.0), v)


@dataclass(frozen=True, slots=True)
class WheelSize:
    """Sizes of a wheel in a layout [mm]."""

    radius: float
    module: float
    """Transverse module, which is the pitch diameter divided by the tooth count; for a worm, the axial module [mm]."""
    thickness: float
    """Thickness of the wheel's rim along the axis [mm]."""
    inner: float
    """Radius of the free space inside a ring [mm]; 0 for other wheels."""
    outer: float
    """Outer radius of the wheel, including clearance [mm]."""
    slot: float = 0.0
    """Height of the middle of the wheel above the lowest slot of its level [mm]; 0 for a level without slots."""
    plain: float = 0.0
    """Thickness of the wheel before it was widened to mesh with several wheels [mm]."""

    def across_slots(self, low: int, high: int) -> WheelSize:
        """Return the wheel widened to extend over the axial positions (slots) `low` to `high`, numbered from 0."""
        step = _SLOT * self.thickness
        broad = (high - low) * step + self.thickness
        return replace(self, thickness=broad, slot=(low + high) / 2 * step)

    @property
    def foot(self) -> float:
        """Height of the middle of the wheel above the middle of the lowest slot that it occupies [mm]."""
        return (self.thickness - self.plain) / 2


@dataclass(frozen=True, slots=True)
class CrossingSide:
    """Gear pair with non-parallel axes from the view of one wheel, with the places (`Seat`) of both wheels."""

    contact: PitchContact
    side: ContactSide
    seat: Seat
    mate_seat: Seat


@dataclass(frozen=True)
class SizedGeometry:
    """Declared geometry of a train, with the sizes of its wheels."""

    declared: DeclaredGeometry
    modules: WheelModules
    sizes: Mapping[str, WheelSize]
    crossing: tuple[CrossingSide, ...]
    """Gear pairs whose axes are not parallel. Each pair is listed twice, as seen from each of its wheels."""

    @cached_property
    def seats(self) -> Mapping[tuple[str, str], Seat]:
        """Seats of wheels, by name of the pair and name of the wheel."""
        return {(each.contact.name, each.side.wheel): each.seat for each in self.crossing}


def size_geometry(declared: DeclaredGeometry) -> SizedGeometry:
    """Return the declared geometry extended by the modules, sizes and seats of all wheels."""
    modules = _ModuleSearch(declared).found()
    sizes = {
        wheel: _size(declared, wheel, modules.module[wheel], wheel in modules.declared) for wheel in declared.wheels
    }
    crossing: list[CrossingSide] = []
    for contact in declared.contacts:
        if not contact.parallel:
            radii = sizes[contact.wheels[0]].radius, sizes[contact.wheels[1]].radius
            first, second = seats(declared, contact, radii)
            crossing.append(CrossingSide(contact, contact.sides[0], first, second))
            crossing.append(CrossingSide(contact, contact.sides[1], second, first))
    return SizedGeometry(declared, modules, sizes, tuple(crossing))


def _size(geometry: DeclaredGeometry, wheel: str, module: float, is_given: bool) -> WheelSize:
    declared = geometry.wheel(wheel)
    radius = float(geometry.radius(wheel)) * module
    usual = (_WORM if declared.kind == "worm" else WIDE) * module
    # a declared thickness is not used for a wheel of undetermined size
    thickness = geometry.thickness.get(wheel, usual) if is_given else usual
    across_axis = module * declared.slant
    if declared.internal:
        inner, outer = max(radius - _TIP * module, 0.0), radius + _RING * module
    else:
        inner, outer = 0.0, radius + max(_TIP, geometry.discs.get(wheel, 0.0)) * module
    return WheelSize(radius, across_axis, thickness, inner, outer, plain=thickness)
