"""Closed chains of axes: modules that are free are changed until every chain of distances can close.

Distances of a chain close if none is longer than all others together (the polygon inequality). Relaxation: each
distance that is longer than the shortest way round it is shortened, or the way is lengthened, in rounds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush

_ROUNDS = 12  # over all distances; each changes what the others need
_MOST = 300  # distances on closed chains up to which modules are balanced: time grows with their square
_TIGHT = 0.97  # of the way round: a distance that is longer leaves wheels no room
_LOOSE = 0.85  # what it is made then
_LEAST = Fraction(1, 1000)  # factor by which a module may shrink in one step


@dataclass(frozen=True, slots=True)
class AxisDistance:
    """Two axes, and their distance: `times` the module of `root`, or `times` mm where that is None."""

    axes: tuple[str, str]
    times: float
    root: int | None

    def length(self, modules: Mapping[int, Fraction]) -> float:
        """The distance (mm) with these modules."""
        return self.times * (1.0 if self.root is None else float(modules[self.root]))


def close_chains(
    distances: Sequence[AxisDistance], modules: Mapping[int, Fraction], free: frozenset[int]
) -> dict[int, Fraction]:
    """Modules of roots, those in `free` changed by simple factors where a chain could not close."""
    distances = _on_cycles(distances)
    found = dict(modules)
    if not free or len(distances) > _MOST:
        return found
    for _ in range(_ROUNDS):
        changed = [_relax(distances, at, found, free) for at in range(len(distances))]
        if not any(changed):
            break
    return found


def _on_cycles(distances: Sequence[AxisDistance]) -> list[AxisDistance]:
    """The 2-core of the graph of distances: what is left when loose ends are taken off again and again."""
    at: dict[str, set[int]] = {}
    for number, one in enumerate(distances):
        for axis in one.axes:
            at.setdefault(axis, set()).add(number)
    loose = [axis for axis, own in at.items() if len(own) == 1]
    while loose:
        for number in tuple(at[loose.pop()]):
            for axis in distances[number].axes:
                at[axis].discard(number)
                if len(at[axis]) == 1:
                    loose.append(axis)
    return [one for number, one in enumerate(distances) if number in at[one.axes[0]]]


def _relax(distances: Sequence[AxisDistance], at: int, modules: dict[int, Fraction], free: frozenset[int]) -> bool:
    """Shorten a distance that is longer than the way round, or lengthen the way; True if a module was changed."""
    one = distances[at]
    way = _way_round(distances, at, modules)
    length, way_length = one.length(modules), sum(other.length(modules) for other in way)
    if not way or length <= _TIGHT * way_length:
        return False
    rest = [other for other in way if other.root != one.root]
    if one.root in free and rest:
        same = way_length - sum(other.length(modules) for other in rest)
        # the part of the way with the same module shrinks along; the floor keeps the factor's sign where both are even
        factor = _LOOSE * (way_length - same) / max(length - _LOOSE * same, 1e-9 * length)
        if 0 < factor < 1:
            modules[one.root] *= _simple(factor) or _LEAST
            return True
    loose = [other for other in rest if other.root in free]
    part = sum(other.length(modules) for other in loose)
    if not part:
        return False
    factor = 1 + (length / _LOOSE - way_length) / part
    for root in {other.root for other in loose if other.root is not None}:
        modules[root] *= _simple(factor)
    return True


def _simple(factor: float) -> Fraction:
    """A fraction near a factor, so that modules stay short fractions; it may be 0."""
    return Fraction(factor).limit_denominator(1000)


def _way_round(distances: Sequence[AxisDistance], at: int, modules: Mapping[int, Fraction]) -> list[AxisDistance]:
    """Dijkstra's shortest way between the axes of a distance that does not use it; empty where there is none."""
    joined: dict[str, list[tuple[str, int]]] = {}
    for number, one in enumerate(distances):
        if number != at:
            first, second = one.axes
            joined.setdefault(first, []).append((second, number))
            joined.setdefault(second, []).append((first, number))
    start, goal = distances[at].axes
    waiting: list[tuple[float, str, int, str]] = [(0.0, start, -1, "")]
    came: dict[str, tuple[int, str]] = {}  # axis -> the distance by which it was reached first, and from where
    while waiting:
        length, here, by, before = heappop(waiting)
        if here in came:
            continue
        came[here] = by, before
        if here == goal:
            break
        for other, number in joined.get(here, ()):
            if other not in came:
                heappush(waiting, (length + distances[number].length(modules), other, number, here))
    way = []
    here = goal
    while here in came and here != start:
        by, here = came[here]
        way.append(distances[by])
    return way
