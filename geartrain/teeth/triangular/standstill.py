"""The driven wheel dragged along: where it stands still, and where a tooth comes in against a tip.

The envelope of the couples falls with time, but may leap: up where a couple leaves before the next one can drive (the
driven wheel stands until one reaches it), down where a couple comes in tip against tip (a clash).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from geartrain.numerics.roots import bracketed_root
from geartrain.teeth.triangular.real_path import STANDSTILL, DriveInterval, RealPath

_ROUNDING = 1e-10  # of a pitch: a lesser leap or gap is none


@dataclass(frozen=True, slots=True)
class DraggedPath:
    """The real path with standstills, and how far the entering tips overlap in a clash (rad of the driven wheel)."""

    intervals: tuple[DriveInterval, ...]
    clash: float
    lost: float  # the driven wheel's law leaps by this at standstills, per pitch (rad)
    arrested: bool = False  # the driven wheel is left standing for good


def drag(path: RealPath) -> DraggedPath:
    """Let the driven wheel stand wherever no couple pushes it."""
    envelope = path.envelope
    if not envelope:
        return DraggedPath((), 0.0, inf)
    first = min(range(len(envelope)), key=lambda at: _least(path, envelope[at])) if len(envelope) > 1 else 0
    order = [*envelope[first:], *(_next_pitch(each) for each in envelope[:first])]
    walk = _Walk(path, order[0])
    for interval in (*order[1:], _next_pitch(order[0])):
        walk.on_to(interval)
    return walk.result()


def _next_pitch(interval: DriveInterval) -> DriveInterval:
    return DriveInterval(interval.phase, interval.start, interval.end, interval.couple + 1, interval.held)


def _least(path: RealPath, interval: DriveInterval) -> float:
    """The least of g over an interval, which the driven wheel reaches whatever came before."""
    phase, low, high = interval.phase, interval.end, interval.start
    return min(path.g(phase, low), path.g(phase, high), *path.extremes(phase, low, high))


class _Walk:
    """One pitch from the lowest point of the envelope to the same point again."""

    def __init__(self, path: RealPath, first: DriveInterval) -> None:
        self.path, self.first = path, first
        self.small, self.gap = _ROUNDING * path.sizes.p2, _ROUNDING * path.pitch
        self.done: list[DriveInterval] = [first]
        self.held: DriveInterval | None = None  # the couple that let go
        self.clash = self.lost = 0.0
        self.arrested = False

    def on_to(self, interval: DriveInterval) -> None:
        """The next interval of the envelope: join it, stand until it comes down, or meet its tip."""
        last = self.held or self.done[-1]
        y = self._standing(last, interval)
        leap = self.path.couple.angle(interval.phase, interval.start) - y
        gap = last.end - interval.start + (interval.couple - last.couple) * self.path.pitch
        if leap < -self.small:
            # a tooth that enters an empty reach ahead of its mate passes by, and nothing pushes the mate any more
            self.arrested |= gap > self.gap
            self.clash = self.clash if gap > self.gap else max(self.clash, -leap)
        if self.held is None and (leap > self.small or gap > self.gap):
            self.held = last
            self.lost += max(leap, 0.0)
        if self.held is not None and leap > self.small:
            # an interval that ends above the driven wheel never comes down to it
            if self.path.couple.angle(interval.phase, interval.end) >= y:
                return
            start = bracketed_root(
                lambda x: self.path.couple.angle(interval.phase, x) - y,
                lambda x: self.path.couple.speed(interval.phase, x),
                interval.end,
                interval.start,
            )
            interval = DriveInterval(interval.phase, start, interval.end, interval.couple)
        if self.held is not None:
            self._stand_until(interval)
        self.done.append(interval)

    def _standing(self, last: DriveInterval, interval: DriveInterval) -> float:
        """Where `last` left the driven wheel, as the angle alpha_2 of the couple of `interval`."""
        y = self.path.couple.angle(last.phase, last.end)
        return float(y + (interval.couple - last.couple) * self.path.sizes.p2)

    def _stand_until(self, interval: DriveInterval) -> None:
        last, self.held = self.held, None
        assert last is not None
        end = interval.start + (last.couple - interval.couple) * self.path.pitch
        held = self.path.couple.angle(last.phase, last.end)
        self.done.append(DriveInterval(STANDSTILL, last.end, end, last.couple, float(held)))

    def result(self) -> DraggedPath:
        """The walk closed: what is left of the first interval after the last standstill."""
        last = self.done.pop()
        first = DriveInterval(last.phase, last.start, self.first.end, last.couple - 1)
        return DraggedPath((first, *self.done[1:]), self.clash, self.lost, self.arrested)
