"""What goes wrong in a cycle of cut teeth: jams, clashes, standstills, gaps; where, and between which teeth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import degrees, inf, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.numerics.plain_data import Key, Result, finite
from geartrain.numerics.simultaneous_roots import roots_by_chandrupatla
from geartrain.uncertainty.manufacturing_errors.contact_envelope import LEFT, ContactEnvelope
from geartrain.uncertainty.manufacturing_errors.contact_intervals import (
    ContactIntervals,
    cells_of,
    find_contact_intervals,
    marks_of,
    split,
)
from geartrain.uncertainty.manufacturing_errors.cut_pair import ROUNDING

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


MeshingEventKind = Literal["jam", "clash", "standstill", "disengaged"]


@dataclass(frozen=True, slots=True)
class MeshingEvent(Result):
    """Something a pair does beside turning.

    jam         a front flank against a back flank: the driven wheel can neither lag nor run ahead
    clash       a tooth comes in against a tip: a jam
    standstill  the driven wheel stands, since the couple that pushed it has left and none has reached it
    disengaged  no tooth is in reach on the one side or the other

    start, end         driver's angle (rad) from the start of the cycle
    amount             overlap of jam and clash, angle lost in a standstill, inf where nothing is in reach (rad, driven)
    pushing, stopping  driver's and driven tooth of the couple that pushes (has let go; comes in), and of the couple
                       whose back flanks stop it; None where there is none
    turn               of the driver, from 0
    """

    KEYS = (
        "kind",
        Key("start_deg", "start", degrees),
        Key("end_deg", "end", degrees),
        Key("amount_deg", "reach", degrees),
        "pushing",
        "stopping",
        "turn",
    )

    kind: MeshingEventKind
    start: float
    end: float
    amount: float
    pushing: tuple[int, int] | None
    stopping: tuple[int, int] | None

    @property
    def reach(self) -> float | None:
        """The amount; None where nothing is in reach."""
        return finite(self.amount)

    @property
    def turn(self) -> int:
        """Turn of the driver, from 0, in which it begins."""
        return int(abs(self.start) // (2 * pi))

    @property
    def text(self) -> str:
        """In words."""
        where = f"at {degrees(self.start):.6g} deg of the driver"
        teeth = [f"driver tooth {each[0]} against driven tooth {each[1]}" for each in self._couples()]
        size = f" by {degrees(self.amount):.4g} deg of the driven wheel" if self.amount < inf else ""
        return f"{self.kind} {where}{size}: {' and '.join(teeth) or 'no teeth'}"

    def _couples(self) -> Iterator[tuple[int, int]]:
        yield from (each for each in (self.pushing, self.stopping) if each is not None)


@dataclass(frozen=True, slots=True)
class MeshingEvents:
    """All events of a cycle in order, and the least play in it (rad of the driven wheel; below 0 where it jams)."""

    all: tuple[MeshingEvent, ...]
    play: float

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
        return self.play < 0


def find_meshing_events(envelope: ContactEnvelope) -> MeshingEvents:
    """Every event of the cycle of the pair of an envelope, dragged."""
    finder = _Finder(envelope)
    least, jams = finder.jams()
    found = [*jams, *finder.clashes(), *finder.standstills(), *finder.gaps()]
    return MeshingEvents(tuple(sorted(found, key=lambda event: (event.start, event.kind))), least)


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

    def play(self, n: Ints, u: Floats) -> Floats:
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
        ends = np.stack([self.play(n, low + edge), self.play(n, high - edge)])
        least = ends.min(axis=0)
        if not np.isfinite(least).any():
            return n[:0], low[:0], high[:0]
        speeds = [
            side.speed(side.first(*at))
            for side, turn in ((self.front, lambda *at: at), (self.back, self._behind))
            for at in (turn(n, low + edge), turn(n, high - edge))
        ]
        # half as much again: within a cell speeds may pass those at its ends
        steepest = 1.5 * float(np.ptp(np.concatenate(speeds)))
        near = least - steepest * (high - low) / 2 < max(float(least.min()), 0.0)
        return n[near], low[near], high[near]

    def jams(self) -> tuple[float, list[MeshingEvent]]:
        """The least play, and the stretches in which it is below 0."""
        n, low, high = self._smooth()
        if not len(n):
            return inf, []
        edge = np.minimum(1e-12 * self.pitch, (high - low) / 4)
        at_low, at_high = self.play(n, low + edge), self.play(n, high - edge)
        least = np.minimum(at_low, at_high)
        bad = np.flatnonzero(least < -self.small)
        n, low, high, at_low, at_high = n[bad], low[bad], high[bad], at_low[bad], at_high[bad]
        worst = np.where(at_low < at_high, low + edge[bad], high - edge[bad])
        for outer, touched in ((low, at_low), (high, at_high)):
            crosses = np.flatnonzero(touched >= -self.small)
            here = n[crosses]
            outer[crosses] = roots_by_chandrupatla(
                lambda i, u, here=here: self.play(here[i], u),  # type: ignore[misc]
                low[crosses],
                high[crosses],
            )
        front, back = self.front.first(n, worst), self.back.first(*self._behind(n, worst))
        # play that is used up at once was taken by a tooth that came in
        before = self.play(n, low - 1e-9 * self.pitch)
        events = [
            MeshingEvent(
                "clash" if at_low[at] < -self.small <= before[at] else "jam",
                float(n[at] * self.pitch + low[at]),
                float(n[at] * self.pitch + high[at]),
                -float(least[bad[at]]),
                self.teeth(front.couple[at]),
                self.teeth(back.couple[at], True),
            )
            for at in range(len(n))
        ]
        return float(least_of(least)), self._merged(events)

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
        own = self.front.lag_of(k, reach, self.pair.couples(k).contact(reach))
        over = self.front.first(n, u, besides=k).lag - own
        return [self._at(n[at], u[at], "clash", float(over[at]), k[at]) for at in np.flatnonzero(over > self.small)]

    def _at(self, n: int, u: float, kind: MeshingEventKind, amount: float, couple: int) -> MeshingEvent:
        start = float(n % self.pair.count * self.pitch + u)
        return MeshingEvent(kind, start, start, amount, self.teeth(couple), None)

    def standstills(self) -> list[MeshingEvent]:
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
                "standstill", float(starts[at]), float(ends[at]), float(gap), self.teeth(first.couple[at]), None
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
        return self.teeth(self.front.first(n, (middle - n) * self.pitch).couple[0])

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


def least_of(values: Floats) -> float:
    """The least; inf of none."""
    return float(values.min()) if len(values) else inf
