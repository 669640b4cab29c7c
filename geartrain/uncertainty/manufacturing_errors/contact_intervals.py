"""The cycle cut where another couple takes over, or the same one goes from flank to flank; and sums over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.simultaneous_roots import roots_by_chandrupatla
from geartrain.uncertainty.manufacturing_errors.contact_envelope import ContactEnvelope, FirstContact

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

    Cells = tuple[Ints, Floats, Floats]

_PARTS = 4  # of a cell, looked at for couples that take over within it
_WITHIN = 1e-13  # of a pitch: ends are looked at from this far inside, lest rounding pick the neighbour's couple
_GAUSS = np.polynomial.legendre.leggauss(20)  # within a stretch all is smooth: 20 nodes reach rounding


def label(first: FirstContact) -> Ints:
    """One number for each couple in each state."""
    return first.couple * 4 + np.where(np.isfinite(first.lag), first.state, 3)


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


def marks_of(envelope: ContactEnvelope) -> tuple[Ints, Floats]:
    """Positions where a couple of the cycle comes in, leaves, or has flank on flank."""
    k = envelope.every
    touches = np.isfinite(envelope.reaches)
    k, reach = k[touches], envelope.reaches[touches]
    matches = envelope.pair.couples(k).matches
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
        u = _takes_over(envelope, n, low + small, high - small, first.couple[~same], last.couple[~same])
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
