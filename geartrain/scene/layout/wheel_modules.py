"""Modules: wheels that mesh share one, pairs between the same two axes force the ratios of theirs, and what is left
free is chosen so that closed chains of axes can close.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise
from statistics import median

from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.vectors import across, cross, dot, minus, size, unit
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PinSlotTie, PitchContact, millimetres

_ROUNDS = 12
_MOST = 300  # distances on closed chains up to which modules are balanced
_TIGHT = 0.97  # of the way round: a distance that is longer leaves wheels no room
_LOOSE = 0.85  # what it is made then


@dataclass(frozen=True, slots=True)
class DistanceBar:
    """Two axes, and their distance: `reach` times the module of `root`, or `reach` mm where that is None."""

    ends: tuple[str, str]
    reach: float
    root: int | None


def balance(bars: Sequence[DistanceBar], modules: Mapping[int, Fraction], free: frozenset[int]) -> dict[int, Fraction]:
    """Modules of roots, those in `free` changed by simple factors where a chain could not close."""
    bars = _closed(bars)
    found = dict(modules)
    if not free or len(bars) > _MOST:
        return found
    for _ in range(_ROUNDS):
        changed = [_relax(bars, at, found, free) for at in range(len(bars))]
        if not any(changed):
            break
    return found


def _closed(bars: Sequence[DistanceBar]) -> list[DistanceBar]:
    """Bars of closed chains: what is left when loose ends are taken off."""
    at: dict[str, set[int]] = {}
    for number, bar in enumerate(bars):
        for end in bar.ends:
            at.setdefault(end, set()).add(number)
    loose = [end for end, own in at.items() if len(own) == 1]
    while loose:
        for number in tuple(at[loose.pop()]):
            for end in bars[number].ends:
                at[end].discard(number)
                if len(at[end]) == 1:
                    loose.append(end)
    return [bar for number, bar in enumerate(bars) if number in at[bar.ends[0]]]


def _relax(bars: Sequence[DistanceBar], at: int, modules: dict[int, Fraction], free: frozenset[int]) -> bool:
    """Shorten a bar that is longer than the way round, or lengthen the way; True if a module was changed."""
    bar = bars[at]
    way = _way_round(bars, at, modules)
    length, round_ = _length(bar, modules), sum(_length(one, modules) for one in way)
    if not way or length <= _TIGHT * round_:
        return False
    rest = [one for one in way if one.root != bar.root]
    if bar.root in free and rest:
        own = round_ - sum(_length(one, modules) for one in rest)
        # the part of the way with the same module shrinks along
        factor = _LOOSE * (round_ - own) / max(length - _LOOSE * own, 1e-9 * length)
        if 0 < factor < 1:
            modules[bar.root] *= Fraction(factor).limit_denominator(1000) or Fraction(1, 1000)
            return True
    loose = [one for one in rest if one.root in free]
    part = sum(_length(one, modules) for one in loose)
    if not part:
        return False
    factor = 1 + (length / _LOOSE - round_) / part
    for root in {one.root for one in loose if one.root is not None}:
        modules[root] *= Fraction(factor).limit_denominator(1000)
    return True


def _length(bar: DistanceBar, modules: Mapping[int, Fraction]) -> float:
    return bar.reach * (1.0 if bar.root is None else float(modules[bar.root]))


def _way_round(bars: Sequence[DistanceBar], at: int, modules: Mapping[int, Fraction]) -> list[DistanceBar]:
    """The shortest way between the ends of a bar that does not use it."""
    joined: dict[str, list[tuple[str, int]]] = {}
    for number, bar in enumerate(bars):
        if number != at:
            first, second = bar.ends
            joined.setdefault(first, []).append((second, number))
            joined.setdefault(second, []).append((first, number))
    start, goal = bars[at].ends
    waiting: list[tuple[float, str, int, str]] = [(0.0, start, -1, "")]
    came: dict[str, tuple[int, str]] = {}
    while waiting:
        length, here, by, before = heappop(waiting)
        if here in came:
            continue
        came[here] = by, before
        if here == goal:
            break
        for other, number in joined.get(here, ()):
            if other not in came:
                heappush(waiting, (length + _length(bars[number], modules), other, number, here))
    way = []
    here = goal
    while here in came and here != start:
        by, here = came[here]
        way.append(bars[by])
    return way


_MODULE = Fraction(1)  # mm, where nothing of a train has a size


@dataclass(frozen=True, slots=True)
class WheelModules:
    """Sizes of a train.

    cluster    wheel -> number of the group of wheels it meshes with, directly or through others
    module     wheel -> module (mm); `declared`, the wheels of clusters where the declaration gives it
    distances  pairs of parallel axes -> how far apart they must be (mm), the mean of what their pairs ask for
    """

    cluster: Mapping[str, int]
    module: Mapping[str, float]
    declared: frozenset[str]
    distances: Mapping[tuple[str, str], float]


def find_wheel_modules(reading: DeclaredGeometry) -> WheelModules:
    """Modules of all wheels, exact where the declaration is, and distances of axes that follow.

    A declared module wins, then declared positions, then the ratios that pairs between the same axes force; what is
    still free gets the middle one of all known modules, or 1 mm.
    """
    cluster = _clusters(reading)
    pairs = _by_axes(reading)
    given: dict[int, Fraction] = {}
    own: dict[str, Fraction] = {}
    for wheel, (_, kind) in reading.wheels.items():
        if kind.module is not None:
            own[wheel] = millimetres(kind.module)
            given.setdefault(cluster[wheel], own[wheel])
    ratios = _Ratios(len(set(cluster.values())))
    for touches in pairs.values():
        for first, second in pairwise(touches):
            ends = cluster[first.wheels[0]], cluster[second.wheels[0]]
            sums = reading.reach(first), reading.reach(second)
            if all(sums) and not (ends[0] in given and ends[1] in given):
                ratios.join(*ends, sums[0] / sums[1])
    for tie in reading.ties if len(given) < len(set(cluster.values())) else ():
        _even(reading, pairs, cluster, given, ratios, tie)
    roots = _anchored(reading, pairs, cluster, given, ratios)
    free = frozenset(root for root in (ratios.root(at)[0] for at in set(cluster.values())) if root not in roots)
    known = [float(given.get(at, roots[root] * times)) for at, (root, times) in _all(ratios) if root in roots]
    roots |= dict.fromkeys(sorted(free), Fraction(median(known)) if known else _MODULE)
    roots = balance(list(_bars(reading, pairs, cluster, ratios)), roots, free)
    modules = [given.get(at, roots[root] * times) for at, (root, times) in _all(ratios)]
    module = {wheel: float(own.get(wheel, modules[cluster[wheel]])) for wheel in reading.wheels}
    declared = frozenset(wheel for wheel in reading.wheels if cluster[wheel] in given)
    return WheelModules(cluster, module, declared, dict(_distances(reading, pairs, module)))


def _clusters(reading: DeclaredGeometry) -> dict[str, int]:
    groups = joined_groups(reading.wheels, (touch.wheels for touch in reading.touches))
    number = {wheel: at for at, group in enumerate(groups) for wheel in group}
    return {wheel: number[wheel] for wheel in reading.wheels}


def _by_axes(reading: DeclaredGeometry) -> dict[tuple[str, str], list[PitchContact]]:
    """Pairs whose axes have a distance: parallel ones, and worms."""
    found: dict[tuple[str, str], list[PitchContact]] = {}
    for touch in reading.touches:
        if touch.kind in ("side", "ring", "screw"):
            found.setdefault((min(touch.axes), max(touch.axes)), []).append(touch)
    return found


def _even(
    reading: DeclaredGeometry,
    pairs: Mapping[tuple[str, str], list[PitchContact]],
    cluster: Mapping[str, int],
    given: Mapping[int, Fraction],
    ratios: _Ratios,
    tie: PinSlotTie,
) -> None:
    """Axes of a pin inside its slot's circle stand close together, and so equally far from an axis both mesh with."""
    for other in reading.lines if tie.encloses else ():
        met = [pairs.get((min(end, other), max(end, other)), [])[:1] for end in tie.axes]
        if all(met):
            first, second = met[0][0], met[1][0]
            numbers = cluster[first.wheels[0]], cluster[second.wheels[0]]
            sums = reading.reach(first), reading.reach(second)
            if all(sums) and not (numbers[0] in given and numbers[1] in given):
                ratios.join(*numbers, sums[0] / sums[1])


class _Ratios:
    """Modules as multiples of that of a root, exact; the first word on a ratio counts."""

    def __init__(self, count: int) -> None:
        self.head = list(range(count))
        self.times = [Fraction(1)] * count

    def root(self, at: int) -> tuple[int, Fraction]:
        times = Fraction(1)
        while self.head[at] != at:
            times *= self.times[at]
            at = self.head[at]
        return at, times

    def join(self, first: int, second: int, ratio: Fraction) -> None:
        """Make the module of the second `ratio` times that of the first."""
        (one, times), (other, multiple) = self.root(first), self.root(second)
        if one != other:
            self.head[other], self.times[other] = one, ratio * times / multiple


def _anchored(
    reading: DeclaredGeometry,
    pairs: Mapping[tuple[str, str], list[PitchContact]],
    cluster: Mapping[str, int],
    given: Mapping[int, Fraction],
    ratios: _Ratios,
) -> dict[int, Fraction]:
    """Modules of roots that follow from declared modules, else in least squares from positions and offsets."""
    roots: dict[int, Fraction] = {}
    for at, module in given.items():
        root, times = ratios.root(at)
        roots.setdefault(root, module / times)
    sums: dict[int, list[Fraction]] = {}
    for axes, touches in pairs.items():
        far = _declared_distance(reading, axes)
        if not far:
            continue
        for touch in touches:
            root, times = ratios.root(cluster[touch.wheels[0]])
            total = sums.setdefault(root, [Fraction(0), Fraction(0)])
            reach = reading.reach(touch) * times
            total[0] += reach * far
            total[1] += reach * reach
    return {root: above / below for root, (above, below) in sums.items() if below} | roots


def _declared_distance(reading: DeclaredGeometry, axes: tuple[str, str]) -> Fraction | None:
    first, second = (reading.lines[name] for name in axes)
    if first.given is not None and second.given is not None:
        apart = minus(second.given, first.given)
        if first.group == second.group:
            return Fraction(size(across(apart, first.way)))
        return Fraction(abs(dot(apart, unit(cross(first.way, second.way)))))
    return next((tie.offset for tie in reading.ties if set(tie.axes) == set(axes)), None)


def _all(ratios: _Ratios) -> Iterator[tuple[int, tuple[int, Fraction]]]:
    return ((at, ratios.root(at)) for at in range(len(ratios.head)))


def _bars(
    reading: DeclaredGeometry,
    pairs: Mapping[tuple[str, str], list[PitchContact]],
    cluster: Mapping[str, int],
    ratios: _Ratios,
) -> Iterator[DistanceBar]:
    """Distances of parallel axes over the module they hang on."""
    placed = [label for label, line in reading.lines.items() if line.given is not None]
    for pair in pairwise(placed):
        if reading.lines[pair[0]].group == reading.lines[pair[1]].group:
            yield DistanceBar(pair, float(_declared_distance(reading, pair) or 0), None)
    for axes, touches in pairs.items():
        root, times = ratios.root(cluster[touches[0].wheels[0]])
        if touches[0].kind != "screw" and not set(axes) <= set(placed):
            yield DistanceBar(axes, float(reading.reach(touches[0]) * times), root)
    for tie in reading.ties:
        if tie.offset is not None:
            yield DistanceBar(tie.axes, float(tie.offset), None)


def _distances(
    reading: DeclaredGeometry, pairs: Mapping[tuple[str, str], list[PitchContact]], module: Mapping[str, float]
) -> Iterator[tuple[tuple[str, str], float]]:
    for axes, touches in pairs.items():
        far = [pitch_distance(reading, module, touch) for touch in touches]
        yield axes, sum(far) / len(far)
    for tie in reading.ties:
        if tie.offset is not None:
            yield (min(tie.axes), max(tie.axes)), float(tie.offset)


def pitch_distance(reading: DeclaredGeometry, module: Mapping[str, float], touch: PitchContact) -> float:
    """How far apart (mm) axes are whose wheels mesh: pitch circles touch, or are as far off as declared teeth want."""
    first, second = (float(reading.size(wheel)) * module[wheel] for wheel in touch.wheels)
    return float(touch.stretch) * (abs(first - second) if touch.kind == "ring" else first + second)
