"""The transmission function of one pair of cut wheels over the full cycle of its teeth, and what goes wrong in it.

An oracle: trials of many pairs at once, as the package judges them, are compared with it. It looks everywhere in the
cycle, where the package looks only at the places where something can go wrong.

Couple k forbids the driven wheel to lag behind f(t + theta_k) - phi_k, so that it follows U(t) = min over k. Pushed and
dragged it is at y(t), the least U so far. As every f rises with t, y is the least over all couples that have come in,
each at its own t or, where it has left, at its exit: no history need be kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import ceil, floor, inf, sqrt
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from geartrain.errors import Problem, RangeError
from geartrain.numerics.arrays import Floats, Ints
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.workshop.cutting.cut_wheel import ROUNDING, CutGearPair, CutToothPairs, CutWheel

Cells = tuple[Ints, Floats, Floats]
Value = Callable[[Ints, Floats], Floats]

MOST_STEPS = 100  # of a search for roots: halving alone needs some 55 where the root is not near 0

RECEDES, APPROACHES, LEFT = 0, 1, 2
"""What the couple that decides does: contact in recess, in approach, or none since it has left."""


class FirstContact(NamedTuple):
    """The first contact at some positions, all arrays of one shape.

    lag      of the driven wheel behind uniform motion (rad of it); inf where nothing touches
    tooth_pair   that decides, counted on through all turns
    x        alpha_1 of its driver's tooth (rad)
    state    RECEDES, APPROACHES or LEFT
    """

    lag: Floats
    tooth_pair: Ints
    x: Floats
    state: Ints


@dataclass(frozen=True)
class ContactEnvelope:
    """All couples of a pair. Positions are a whole number of pitches n and the driver's angle u beyond it (rad).

    `dragged` lets couples that have left hold the driven wheel where they left it.
    """

    pair: CutGearPair
    dragged: bool = True

    @cached_property
    def _window(self) -> range:
        """Couples, counted from n, that can touch, or be the last that did."""
        pair, pitch = self.pair, self.pair.sizes.p1
        place = self.pair.first.place
        touches = self.reaches > -inf
        if not touches.any():
            return range(0)
        low = floor((-self.pair.widest - float(place.max())) / pitch)
        high = ceil((self.pair.widest - float(place.min())) / pitch) + 1
        if not self.dragged:
            return range(low, high + 1)
        steps = np.flatnonzero(np.concatenate((touches, touches)))
        longest = max((int(b - a) for a, b in pairwise(steps)), default=1)
        ends = self.exits[touches]
        spread = float(np.ptp(ends) + np.ptp(pair.second.place)) / pair.sizes.p2
        early = float(np.ptp(self.reaches[touches]) + np.ptp(place)) / pitch
        return range(low - longest - ceil(spread + early), high + 1)

    @cached_property
    def every(self) -> Ints:
        """All couples of a cycle."""
        return np.arange(self.pair.count)

    @cached_property
    def reaches(self) -> Floats:
        """The reach of every couple of a cycle (rad of the driver)."""
        return np.broadcast_to(self.pair.tooth_pairs(self.every).reach, self.every.shape)

    @cached_property
    def exits(self) -> Floats:
        """alpha_2 at which every couple of a cycle leaves (rad)."""
        return np.broadcast_to(self.pair.tooth_pairs(self.every).exit_angle, self.every.shape)

    def first(self, n: Ints, u: Floats, besides: Ints | None = None) -> FirstContact:
        """The first contact at positions (n, u), each (m,); couples `besides` are left out."""
        best = np.full(len(u), inf)
        tooth_pair, x_best, state = np.zeros(len(u), np.int64), np.zeros(len(u)), np.zeros(len(u), np.int64)
        for m in self._window:
            k = n + m
            # from n on, not from the start of the cycle: numbers stay small and keep their digits
            x = m * self.pair.sizes.p1 - u + self.pair.first.place[k % self.pair.sizes.z1]
            reach = self.reaches[k % self.pair.count]
            near = (x <= reach) & ((x >= -reach) | self.dragged)
            if besides is not None:
                near &= k != besides
            at = np.flatnonzero(near)
            if not len(at):
                continue
            lag, kind = self._lag(k[at], x[at], reach[at])
            less = lag < best[at]
            at = at[less]
            best[at], tooth_pair[at], x_best[at], state[at] = lag[less], k[at], x[at], kind[less]
        return FirstContact(best, tooth_pair, x_best, state)

    def _lag(self, k: Ints, x: Floats, reach: Floats) -> tuple[Floats, Ints]:
        """What couples k make the driven wheel lag with the driver's tooth at x, and how."""
        tooth_pairs = self.pair.tooth_pairs(k)
        held = x < -reach
        inside = np.where(held, -reach, x)
        approach, recess = tooth_pairs.angle("approach", inside, np), tooth_pairs.angle("recess", inside, np)
        y = np.where(held, tooth_pairs.exit_angle, np.minimum(approach, recess))
        kind = np.where(held, LEFT, (approach < recess).astype(np.int64))
        return self.lag_of(k, x, y), kind

    def lag_at(self, k: Ints, n: Ints, u: Floats) -> Floats:
        """How couples k alone would make the driven wheel lag at positions (n, u), one each; inf out of reach."""
        reach = self.reaches[k % self.pair.count]
        x = (k - n) * self.pair.sizes.p1 - u + self.pair.first.place[k % self.pair.sizes.z1]
        lag, _ = self._lag(k, np.minimum(x, reach), reach)
        near = (x <= reach) & ((x >= -reach) | self.dragged)
        return np.where(near, lag, inf)

    def lag_of(self, k: Ints, x: Floats, y: Floats) -> Floats:
        """The lag of the driven wheel whose tooth of couple k is at y while the driver's is at x."""
        driver, driven = self.pair.places(k)
        ratio = self.pair.sizes.ratio
        # two small differences, each taken first: large terms cancel within them
        found: Floats = (y - ratio * x) + (ratio * driver - driven)
        return found

    def speed(self, first: FirstContact) -> Floats:
        """tau of the couples that decide; 0 where they have left, infinite where jammed teeth overlap past a flank."""
        tooth_pairs = self.pair.tooth_pairs(first.tooth_pair)
        x = self.inside(first)
        with np.errstate(divide="ignore"):
            found: Floats = np.where(first.state == LEFT, 0.0, tooth_pairs.tau(x, first.state == APPROACHES))
        return found

    def inside(self, first: FirstContact) -> Floats:
        """alpha_1 of the couples that decide, kept within their reach; 0 where nothing touches."""
        reach = np.maximum(self.reaches[first.tooth_pair % self.pair.count], 0.0)
        return np.clip(first.x, -reach, reach)

    def position(self, k: Ints, x: Floats) -> tuple[Ints, Floats]:
        """The position (n, u) at which the driver's tooth of couples k is at x; u may leave the pitch by rounding."""
        pitch = self.pair.sizes.p1
        ahead = self.pair.first.place[k % self.pair.sizes.z1] - x
        whole = np.floor(ahead / pitch)
        return k + whole.astype(np.int64), ahead - whole * pitch


_PARTS = 4  # of a cell, looked at for couples that take over within it
_WITHIN = 1e-13  # of a pitch: ends are looked at from this far inside, lest rounding pick the neighbour's couple
_GAUSS = np.polynomial.legendre.leggauss(20)  # within a stretch all is smooth: 20 nodes reach rounding


def label(first: FirstContact) -> Ints:
    """One number for each couple in each state."""
    return first.tooth_pair * 4 + np.where(np.isfinite(first.lag), first.state, 3)


@dataclass(frozen=True)
class ContactIntervals:
    """Stretches (n, start to end) of the driver's angle u within pitch n, in order; what pushes is one in each."""

    envelope: ContactEnvelope
    n: Ints
    start: Floats
    end: Floats

    @property
    def _inner(self) -> tuple[Floats, Floats]:
        small = np.minimum(_WITHIN * self.envelope.pair.sizes.p1, (self.end - self.start) / 4)
        return self.start + small, self.end - small

    def _ends(self) -> tuple[FirstContact, FirstContact]:
        first, last = self._inner
        return self.envelope.first(self.n, first), self.envelope.first(self.n, last)

    def end_speeds(self) -> Floats:
        """tau at both ends of every stretch."""
        return np.concatenate([self.envelope.speed(each)[np.isfinite(each.lag)] for each in self._ends()])

    def turning_lags(self) -> Floats:
        """The lag at both ends of every stretch, and wherever within it tau passes through its mean."""
        ratio = self.envelope.pair.sizes.ratio
        low, high = self._inner
        ends = self._ends()
        before, after = (self.envelope.speed(each) < ratio for each in ends)
        turns = np.flatnonzero((before != after) & np.isfinite(ends[0].lag))
        n = self.n[turns]
        u = roots_by_chandrupatla(
            lambda at, u: self.envelope.speed(self.envelope.first(n[at], u)) - ratio, low[turns], high[turns]
        )
        lags = np.concatenate([ends[0].lag, ends[1].lag, self.envelope.first(n, u).lag])
        found: Floats = lags[np.isfinite(lags)]
        return found

    def over(self, what: Callable[[FirstContact], Floats]) -> tuple[Floats, Floats]:
        """Something at nodes of every stretch, and weights whose sum over the cycle is 1."""
        points, weights = _GAUSS
        half = ((self.end - self.start) / 2)[:, None]
        u = (self.start[:, None] + half * (1 + points)).ravel()
        n = np.repeat(self.n, len(points))
        found = what(self.envelope.first(n, u))
        share = (half * weights).ravel()
        return found, share / share.sum()

    def lags(self) -> tuple[Floats, Floats]:
        """The lag at nodes of every stretch, and weights."""
        return self.over(lambda first: first.lag)


def _matches(tooth_pairs: CutToothPairs) -> Floats:
    """alpha_1 where flank lies on flank, D sin(x + beta1) = R1 sin(beta1) + R2 sin(beta2); NaN where nowhere."""
    line = (tooth_pairs.R1 * tooth_pairs.sin1 + tooth_pairs.R2 * tooth_pairs.sin2) / tooth_pairs.D
    with np.errstate(invalid="ignore"):
        found: Floats = np.arcsin(line) - np.arctan2(tooth_pairs.sin1, tooth_pairs.cos1)
    return found


def marks_of(envelope: ContactEnvelope) -> tuple[Ints, Floats]:
    """Positions where a couple of the cycle comes in, leaves, or has flank on flank."""
    k = envelope.every
    touches = np.isfinite(envelope.reaches)
    k, reach = k[touches], envelope.reaches[touches]
    matches = _matches(envelope.pair.tooth_pairs(k))
    found = [envelope.position(k, reach), envelope.position(k, -reach)]
    flat = np.abs(matches) < reach
    found.append(envelope.position(k[flat], matches[flat]))
    return np.concatenate([n for n, _ in found]), np.concatenate([u for _, u in found])


def cells_of(envelope: ContactEnvelope, *marks: tuple[Ints, Floats]) -> Cells:
    """All positions of a cycle cut at marks and where pitches begin: n, and from where to where within it."""
    count, pitch = envelope.pair.count, envelope.pair.sizes.p1
    n = np.concatenate([np.arange(count), *(at % count for at, _ in marks)])
    u = np.concatenate([np.zeros(count), *(each for _, each in marks)])
    # a position may leave its pitch by rounding
    u = np.clip(u, 0.0, pitch)
    order = np.lexsort((u, n))
    n, u = n[order], u[order]
    last = np.append(n[1:] != n[:-1], True)
    end = np.where(last, pitch, np.append(u[1:], pitch))
    # marks that fall together leave cells of rounding between them, with no room inside to look from
    wide = end - u > 4 * _WITHIN * pitch
    return n[wide], u[wide], end[wide]


def split(envelope: ContactEnvelope, cells: Cells) -> Cells:
    """Cells cut wherever another couple takes over within them, looked for at four steps."""
    n, start, end = cells
    small = _WITHIN * envelope.pair.sizes.p1
    done: list[Cells] = []
    share = np.arange(_PARTS) / _PARTS
    width = (end - start)[:, None]
    low = (start[:, None] + share * width).ravel()
    high = (start[:, None] + (share + 1 / _PARTS) * width).ravel()
    n = np.repeat(n, _PARTS)
    while len(n):
        first, last = envelope.first(n, low + small), envelope.first(n, high - small)
        same = (label(first) == label(last)) | (high - low < 4 * small)
        done.append((n[same], low[same], high[same]))
        n, low, high = n[~same], low[~same], high[~same]
        u = _takes_over(envelope, n, low + small, high - small, first.tooth_pair[~same], last.tooth_pair[~same])
        # a third couple may push between: both sides are looked at again
        n, low, high = np.tile(n, 2), np.concatenate((low, u)), np.concatenate((u, high))
    n, low, high = (np.concatenate(each) for each in zip(*done, strict=True))
    order = np.lexsort((low, n))
    return n[order], low[order], high[order]


def _takes_over(envelope: ContactEnvelope, n: Ints, low: Floats, high: Floats, one: Ints, other: Ints) -> Floats:
    """Where couple `one`, lower at `low`, ceases to be lower than `other`; half way where it does not."""

    def lead(at: Ints, u: Floats) -> Floats:
        with np.errstate(invalid="ignore"):
            # inf - inf where neither is in reach: nan, which no comparison below takes for a crossing
            return envelope.lag_at(one[at], n[at], u) - envelope.lag_at(other[at], n[at], u)

    every = np.arange(len(n))
    with np.errstate(invalid="ignore"):
        crosses = (lead(every, low) < 0) & (lead(every, high) > 0)
    u = (low + high) / 2
    i = np.flatnonzero(crosses)
    u[i] = roots_by_chandrupatla(lambda at, u: lead(i[at], u), low[i], high[i])
    return u


def joined(parts: Cells, names: Ints) -> Cells:
    """Neighbours in one pitch of one name as one."""
    n, low, high = parts
    new = np.ones(len(n), bool)
    new[1:] = (n[1:] != n[:-1]) | (names[1:] != names[:-1])
    starts = np.flatnonzero(new)
    return n[starts], low[starts], high[np.append(starts[1:] - 1, len(n) - 1)]


def find_contact_intervals(envelope: ContactEnvelope) -> ContactIntervals:
    """The cycle of one pair cut into stretches."""
    parts = split(envelope, cells_of(envelope, marks_of(envelope)))
    return ContactIntervals(envelope, *joined(parts, label(envelope.first(parts[0], (parts[1] + parts[2]) / 2))))


MeshingEventKind = Literal["jam", "clash", "dwell", "disengaged"]


@dataclass(frozen=True, slots=True)
class MeshingEvent:
    """Something a pair does beside turning.

    jam         a front flank against a back flank: the driven wheel can neither lag nor run ahead
    clash       a tooth comes in against a tip: a jam
    dwell  the driven wheel stands, since the couple that pushed it has left and none has reached it
    disengaged  no tooth is in reach on the one side or the other

    start, end         driver's angle (rad) from the start of the cycle
    amount             overlap of jam and clash, angle lost in a standstill, inf where nothing is in reach (rad, driven)
    pushing, stopping  driver's and driven tooth of the couple that pushes (has let go; comes in), and of the couple
                       whose back flanks stop it; None where there is none
    """

    kind: MeshingEventKind
    start: float
    end: float
    amount: float
    pushing: tuple[int, int] | None
    stopping: tuple[int, int] | None


@dataclass(frozen=True, slots=True)
class MeshingEvents:
    """All events of a cycle in order, and the least play in it (rad of the driven wheel; below 0 where it jams)."""

    all: tuple[MeshingEvent, ...]
    backlash: float

    def __bool__(self) -> bool:
        return bool(self.all)

    def of(self, *kinds: MeshingEventKind) -> tuple[MeshingEvent, ...]:
        """Those of some kinds."""
        return tuple(event for event in self.all if event.kind in kinds)

    @property
    def stop(self) -> MeshingEvent | None:
        """The first thing that stops the pair: a jam or a clash."""
        return next(iter(self.of("jam", "clash")), None)

    @property
    def jams(self) -> bool:
        """True if flanks jam: whatever the driven wheel does within its play, the pair cannot turn on."""
        return self.backlash < 0


def find_meshing_events(envelope: ContactEnvelope) -> MeshingEvents:
    """Every event of the cycle of the pair of an envelope, dragged."""
    finder = _Finder(envelope)
    minimum, jams = finder.jams()
    found = [*jams, *finder.clashes(), *finder.dwells(), *finder.gaps()]
    return MeshingEvents(tuple(sorted(found, key=lambda event: (event.start, event.kind))), minimum)


class _Finder:
    """The cycle of one pair, seen from the couples that push and from those that stop."""

    def __init__(self, envelope: ContactEnvelope) -> None:
        self.front, self.pair = envelope, envelope.pair
        self.back = ContactEnvelope(envelope.pair.mirrored, dragged=False)
        self.pitch, self.small = self.pair.sizes.p1, ROUNDING * self.pair.sizes.p2

    # -------------------------------------------------------------------------------------------------- front and back

    def _behind(self, n: Ints, u: Floats) -> tuple[Ints, Floats]:
        """A position as the mirrored pair sees it, and back: it is its own inverse."""
        return -1 - n, self.pitch - u

    def backlash(self, n: Ints, u: Floats) -> Floats:
        """How far the driven wheel could be turned on (rad of it)."""
        ahead, behind = self.front.first(n, u).lag, self.back.first(*self._behind(n, u)).lag
        found: Floats = ahead + behind + self.pair.sizes.p2
        return found

    def falls(self, n: Ints, u: Floats) -> Floats:
        """How fast the play falls as the driver turns."""
        ahead, behind = self.front.first(n, u), self.back.first(*self._behind(n, u))
        return self.front.speed(ahead) - self.back.speed(behind)

    def teeth(self, front: Ints | int, back: bool = False) -> tuple[int, int]:
        """The driver's and the driven tooth of a couple that pushes, or of the mirrored pair's."""
        k = -int(front) if back else int(front)
        return k % self.pair.sizes.z1, (k + back) % self.pair.sizes.z2

    # ---------------------------------------------------------------------------------------------------------- events

    def _smooth(self) -> tuple[Ints, Floats, Floats]:
        """Parts of the cycle in which the play is smooth and only falls or only rises; those that may matter."""
        behind = self._behind(*marks_of(self.back))
        cells = self._near(*cells_of(self.front, marks_of(self.front), behind))
        n, low, high = split(self.front, cells)
        m, late, early = split(self.back, (*self._behind(n, high), self.pitch - low))
        (n, low), high = self._behind(m, early), self.pitch - late
        # looked at from a little inside, lest rounding pick the neighbour's couple
        edge = np.minimum(1e-12 * self.pitch, (high - low) / 4)
        turns = (self.falls(n, low + edge) > 0) & (self.falls(n, high - edge) < 0)
        at = n[turns]
        lowest = roots_by_chandrupatla(lambda i, u: self.falls(at[i], u), (low + edge)[turns], (high - edge)[turns])
        pieces = [(n[~turns], low[~turns], high[~turns]), (at, low[turns], lowest), (at, lowest, high[turns])]
        n, low, high = (np.concatenate(each) for each in zip(*pieces, strict=True))
        order = np.lexsort((low, n))
        return n[order], low[order], high[order]

    def _near(self, n: Ints, low: Floats, high: Floats) -> tuple[Ints, Floats, Floats]:
        """The cells in which the play may be least, or below 0: it changes no faster than the speeds allow."""
        edge = np.minimum(1e-12 * self.pitch, (high - low) / 4)
        ends = np.stack([self.backlash(n, low + edge), self.backlash(n, high - edge)])
        minimum = ends.min(axis=0)
        if not np.isfinite(minimum).any():
            return n[:0], low[:0], high[:0]
        speeds = [
            side.speed(side.first(*at))
            for side, turn in ((self.front, lambda *at: at), (self.back, self._behind))
            for at in (turn(n, low + edge), turn(n, high - edge))
        ]
        # half as much again: within a cell speeds may pass those at its ends
        steepest = 1.5 * float(np.ptp(np.concatenate(speeds)))
        near = minimum - steepest * (high - low) / 2 < max(float(minimum.min()), 0.0)
        return n[near], low[near], high[near]

    def jams(self) -> tuple[float, list[MeshingEvent]]:
        """The least play, and the stretches in which it is below 0."""
        n, low, high = self._smooth()
        if not len(n):
            return inf, []
        edge = np.minimum(1e-12 * self.pitch, (high - low) / 4)
        at_low, at_high = self.backlash(n, low + edge), self.backlash(n, high - edge)
        minimum = np.minimum(at_low, at_high)
        bad = np.flatnonzero(minimum < -self.small)
        n, low, high, at_low, at_high = n[bad], low[bad], high[bad], at_low[bad], at_high[bad]
        worst = np.where(at_low < at_high, low + edge[bad], high - edge[bad])
        for outer, touched in ((low, at_low), (high, at_high)):
            crosses = np.flatnonzero(touched >= -self.small)
            here = n[crosses]
            outer[crosses] = roots_by_chandrupatla(
                lambda i, u, here=here: self.backlash(here[i], u),  # type: ignore[misc]
                low[crosses],
                high[crosses],
            )
        front, back = self.front.first(n, worst), self.back.first(*self._behind(n, worst))
        # play that is used up at once was taken by a tooth that came in
        before = self.backlash(n, low - 1e-9 * self.pitch)
        events = [
            MeshingEvent(
                "clash" if at_low[at] < -self.small <= before[at] else "jam",
                float(n[at] * self.pitch + low[at]),
                float(n[at] * self.pitch + high[at]),
                -float(minimum[bad[at]]),
                self.teeth(front.tooth_pair[at]),
                self.teeth(back.tooth_pair[at], True),
            )
            for at in range(len(n))
        ]
        return float(minimum_of(minimum)), self._merged(events)

    def _merged(self, events: list[MeshingEvent]) -> list[MeshingEvent]:
        """Events that follow each other without a gap as one, that of the greatest amount; round the cycle too."""
        found: list[MeshingEvent] = []
        # pieces of one event may be parted by rounding
        close = 1e-9 * self.pitch
        for event in events:
            if found and event.start - found[-1].end <= close:
                last = found[-1]
                worse = event if event.amount > last.amount else last
                found[-1] = replace(worse, kind=last.kind, start=last.start, end=event.end)
            else:
                found.append(event)
        cycle = self.pair.count * self.pitch
        if len(found) > 1 and found[0].start <= close and found[-1].end >= cycle - close:
            first, last = found.pop(0), found.pop()
            worse = first if first.amount > last.amount else last
            found.append(replace(worse, kind=last.kind, start=last.start, end=cycle + first.end))
        return found

    def clashes(self) -> list[MeshingEvent]:
        """Couples that come in below the driven wheel: the tip meets, or passes, the tip it should push."""
        k = self.front.every[np.isfinite(self.front.reaches)]
        reach = self.front.reaches[k]
        n, u = self.front.position(k, reach)
        own = self.front.lag_of(k, reach, self.pair.tooth_pairs(k).contact(reach))
        over = self.front.first(n, u, besides=k).lag - own
        return [self._at(n[at], u[at], "clash", float(over[at]), k[at]) for at in np.flatnonzero(over > self.small)]

    def _at(self, n: int, u: float, kind: MeshingEventKind, amount: float, tooth_pair: int) -> MeshingEvent:
        start = float(n % self.pair.count * self.pitch + u)
        return MeshingEvent(kind, start, start, amount, self.teeth(tooth_pair), None)

    def dwells(self) -> list[MeshingEvent]:
        """Stretches in which the couple that pushed has left."""
        cycle: ContactIntervals = find_contact_intervals(self.front)
        middle = (cycle.start + cycle.end) / 2
        first = self.front.first(cycle.n, middle)
        still = np.flatnonzero((first.state == LEFT) & np.isfinite(first.lag))
        loose = ContactEnvelope(self.pair, dragged=False)
        begins = cycle.start[still] + np.minimum(1e-12 * self.pitch, (cycle.end - cycle.start)[still] / 4)
        lost = loose.first(cycle.n[still], begins).lag - self.front.first(cycle.n[still], begins).lag
        starts, ends = (cycle.n * self.pitch + each for each in (cycle.start, cycle.end))
        events = [
            MeshingEvent(
                "dwell", float(starts[at]), float(ends[at]), float(gap), self.teeth(first.tooth_pair[at]), None
            )
            for at, gap in zip(still, lost, strict=True)
            if ends[at] - starts[at] > ROUNDING * self.pitch
        ]
        return self._merged(events)

    def gaps(self) -> list[MeshingEvent]:
        """Where no couple is in reach, of those that push or of those that stop."""
        return [
            MeshingEvent("disengaged", start, end, inf, None if side is self.front else self._pushing(start, end), None)
            for side in (self.front, self.back)
            for start, end in self._gaps(side, side is self.back)
        ]

    def _pushing(self, start: float, end: float) -> tuple[int, int]:
        middle = np.array([(start + end) / 2 / self.pitch])
        n = np.floor(middle).astype(np.int64)
        return self.teeth(self.front.first(n, (middle - n) * self.pitch).tooth_pair[0])

    def _gaps(self, side: ContactEnvelope, turned: bool) -> Iterator[tuple[float, float]]:
        cycle = self.pair.count * self.pitch
        k = side.every[np.isfinite(side.reaches)]
        if not len(k):
            yield 0.0, cycle
            return
        enters, leaves = (
            n * self.pitch + u for n, u in (side.position(k, sign * side.reaches[k]) for sign in (1.0, -1.0))
        )
        # twice round, so that what is in reach at the start of the cycle counts
        enters, leaves = (np.concatenate((each - cycle, each, each + cycle)) for each in (enters, leaves))
        order = np.argsort(enters)
        enters, until = enters[order], np.maximum.accumulate(leaves[order])
        for at in np.flatnonzero(enters[1:] - until[:-1] > ROUNDING * self.pitch):
            start, end = float(until[at]), float(enters[at + 1])
            if 0 <= start < cycle:
                yield (start, end) if not turned else ((-end) % cycle, (-end) % cycle + end - start)


def minimum_of(values: Floats) -> float:
    """The least; inf of none."""
    return float(values.min()) if len(values) else inf


_BLOCK = 8192  # samples worked on at once: their intermediate arrays stay in a cache


def leans(pair: CutGearPair) -> bool:
    """Return True if a flank leans beyond the perpendicular when the tips of its tooth pair meet, in any trial."""
    k = np.arange(pair.count)
    for each in (pair.tooth_pairs(k), pair.mirrored.tooth_pairs(k)):
        # rounding errors may exceed 1
        flank = np.arcsin(np.clip(np.maximum(abs(each.sin1), abs(each.sin2)), -1.0, 1.0))
        if (flank + np.maximum(each.reach, 0.0) - each.side * each.exit_angle >= np.pi / 2).any():
            return True
    return False


class CutPairLaw:
    """Driven angle, speed and events of two cut wheels; all repeats after lcm(z1, z2) pitches.

    The transmission error is that against uniform motion of the ratio of tooth numbers: positive where the driven
    wheel is ahead. What jams or clashes has the transmission function that its pushing flanks alone would give.

    direction   -1 turns backwards, pushed by the other flanks
    """

    def __init__(self, pair: CutGearPair, direction: int = 1) -> None:
        self.pair, self.direction = pair, direction
        sizes = pair.sizes
        self.ratio = Fraction(sizes.z1, sizes.z2)
        self.pitch, self.period = sizes.p1, sizes.p1 * pair.count
        self._envelope = ContactEnvelope(pair if direction > 0 else pair.mirrored)

    @classmethod
    def of(
        cls, sizes: TriangularSizes, first: CutWheel, second: CutWheel, shift: float = 0.0, direction: int = 1
    ) -> CutPairLaw:
        """Of two wheels, their axles so much farther apart.

        Raises `RangeError` where a flank leans beyond the perpendicular where tips meet: which couple of such teeth
        touches first is not known tooth by tooth.
        """
        pair = CutGearPair(sizes, first, second, shift)
        if leans(pair):
            raise RangeError(Problem("a flank leans beyond the perpendicular where tips meet", "", "use more teeth"))
        return cls(pair, direction)

    # ---------------------------------------------------------------------------------------------------- over samples

    def angle(self, S: ArrayLike) -> Floats:
        """Driven angle q (rad) at driver angles S (rad)."""
        found: Floats = float(self.ratio) * np.asarray(S, dtype=float) + self.error(S)
        return found

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error (rad of the driven wheel)."""
        return self._signed(self._map(S, lambda found: found.lag))

    def speed(self, S: ArrayLike) -> Floats:
        """dq/dS; 0 where the driven wheel stands still."""
        return self._map(S, self._envelope.speed)

    def backlash(self, S: ArrayLike) -> Floats:
        """How far the driven wheel could be turned on (rad of it); below 0 it jams there, inf if nothing stops it."""
        ahead = self._map(S, lambda found: found.lag)
        back = ContactEnvelope(self._envelope.pair.mirrored, dragged=False)
        behind = self._map(S, lambda found: found.lag, back, -1)
        backlash: Floats = ahead + behind + self.pair.sizes.p2
        return backlash

    def driving(self, S: ArrayLike) -> tuple[Ints, Ints]:
        """Numbers of the driver's tooth and the driven tooth that touch, or touched last."""
        tooth_pair = self._map(S, lambda found: found.tooth_pair).astype(np.int64)
        k, back = (tooth_pair, 0) if self.direction > 0 else (-tooth_pair, 1)
        return k % self.pair.sizes.z1, (k + back) % self.pair.sizes.z2

    def _map(self, S: ArrayLike, what: Any, envelope: ContactEnvelope | None = None, sense: int = 1) -> Floats:
        S = np.asarray(S, dtype=float)
        flat = S.ravel() * (self.direction * sense)
        parts = []
        for start in range(0, max(len(flat), 1), _BLOCK):
            part = flat[start : start + _BLOCK]
            u = np.empty_like(part)
            np.mod(part, self.pitch, out=u)
            # a whole number of pitches but for rounding: rounded to the nearest, not down
            n = np.rint((part - u) / self.pitch).astype(np.int64)
            parts.append(what((envelope or self._envelope).first(n, u)))
        found: Floats = np.concatenate(parts, axis=-1)
        return found.reshape((*found.shape[:-1], *S.shape))

    def _signed(self, lag: Floats) -> Floats:
        return -lag if self.direction > 0 else self.pair.sizes.p2 + lag

    # -------------------------------------------------------------------------------------------------- over the cycle

    @cached_property
    def stretches(self) -> ContactIntervals:
        """The cycle cut into stretches in each of which one couple pushes in one phase, or none does."""
        return find_contact_intervals(self._envelope)

    @cached_property
    def events(self) -> MeshingEvents:
        """Jams, clashes, standstills and gaps of the cycle, with the teeth concerned."""
        return find_meshing_events(self._envelope)

    def error_range(self) -> tuple[float, float]:
        """Least and greatest transmission error of the cycle (rad of the driven wheel)."""
        lags = self.stretches.turning_lags()
        low, high = (-float(lags.max()), -float(lags.min())) if self.direction > 0 else (lags.min(), lags.max())
        return (
            (low, high) if self.direction > 0 else (self.pair.sizes.p2 + float(low), self.pair.sizes.p2 + float(high))
        )

    def error_moments(self) -> tuple[float, float]:
        """Mean of the transmission error of the cycle, and its rms about that mean (rad of the driven wheel)."""
        lag, weights = self.stretches.lags()
        mean = float(weights @ lag)
        return float(self._signed(np.array(mean))), sqrt(float(weights @ np.square(lag - mean)))

    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio of the cycle; it is monotone on each stretch of ordinary teeth."""
        speeds = self.stretches.end_speeds()
        return float(speeds.min()), float(speeds.max())


def roots_by_chandrupatla(value: Value, low: Floats, high: Floats) -> Floats:
    """Chandrupatla's method: where each of m functions changes its sign between `low` and `high`, (m,) each.

    value   of functions (indices) at arguments: value(which, x), of one shape

    T. R. Chandrupatla, Advances in Engineering Software 28 (1997) 145-149. Ends to rounding.
    """
    a, b = high.copy(), low.copy()
    every = np.arange(len(low))
    at_a, at_b = value(every, a), value(every, b)
    c, at_c = a.copy(), at_a.copy()
    part, found, open_ = np.full(len(low), 0.5), low.copy(), np.ones(len(low), bool)
    for _ in range(MOST_STEPS):
        i = np.flatnonzero(open_)
        if not len(i):
            break
        x = a[i] + part[i] * (b[i] - a[i])
        here = value(i, x)
        same = np.sign(here) == np.sign(at_a[i])
        c[i], at_c[i] = np.where(same, a[i], b[i]), np.where(same, at_a[i], at_b[i])
        b[i], at_b[i] = np.where(same, b[i], a[i]), np.where(same, at_b[i], at_a[i])
        a[i], at_a[i] = x, here
        best = np.where(np.abs(at_a[i]) < np.abs(at_b[i]), a[i], b[i])
        found[i] = best
        width = np.abs(b[i] - a[i])
        minimum = 2 * np.spacing(np.abs(best)) + 1e-300  # at a root of 0, too, the width must come below something
        part[i] = _next(a[i], b[i], c[i], at_a[i], at_b[i], at_c[i], minimum / np.maximum(width, minimum))
        open_[i] = (width > 2 * minimum) & (here != 0)
    return found


def _next(a: Floats, b: Floats, c: Floats, at_a: Floats, at_b: Floats, at_c: Floats, minimum: Floats) -> Floats:
    """The share of the bracket to go next: by inverse quadratic interpolation where it is safe, else half."""
    with np.errstate(all="ignore"):
        xi, phi = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
        # Chandrupatla's condition: the inverse quadratic is monotonic between the three points
        safe = (phi * phi < xi) & ((1 - phi) ** 2 < 1 - xi)
        share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
        share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
    share = np.where(safe & np.isfinite(share), share, 0.5)
    # a step that no longer moves a float would be lost; nor may the two limits cross
    return np.clip(share, np.minimum(minimum, 0.5), np.maximum(1 - minimum, 0.5))
