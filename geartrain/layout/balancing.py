"""Free modules chosen so that closed chains of axes can close: no distance longer than the way round."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush

_ROUNDS = 12
_MOST = 300  # distances on closed chains up to which modules are balanced
_TIGHT = 0.97  # of the way round: a distance that is longer leaves wheels no room
_LOOSE = 0.85  # what it is made then


@dataclass(frozen=True, slots=True)
class Bar:
    """Two axes, and their distance: `reach` times the module of `root`, or `reach` mm where that is None."""

    ends: tuple[str, str]
    reach: float
    root: int | None


def balance(bars: Sequence[Bar], modules: Mapping[int, Fraction], free: frozenset[int]) -> dict[int, Fraction]:
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


def _closed(bars: Sequence[Bar]) -> list[Bar]:
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


def _relax(bars: Sequence[Bar], at: int, modules: dict[int, Fraction], free: frozenset[int]) -> bool:
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


def _length(bar: Bar, modules: Mapping[int, Fraction]) -> float:
    return bar.reach * (1.0 if bar.root is None else float(modules[bar.root]))


def _way_round(bars: Sequence[Bar], at: int, modules: Mapping[int, Fraction]) -> list[Bar]:
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
