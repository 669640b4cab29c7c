"""First contact: the lower envelope of all couples of teeth, and the driven wheel dragged along under it.

Couple k forbids the driven wheel to lag behind f(t + theta_k) - phi_k, so that it follows U(t) = min over k. Pushed and
dragged it stands at y(t), the least U so far. As every f rises with t, y is the least over all couples that have come
in, each at its own t or, where it has left, at its exit: no history need be kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, floor, inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


RECEDES, APPROACHES, LEFT = 0, 1, 2
"""What the couple that decides does: contact in recess, in approach, or none since it has left."""


class FirstContact(NamedTuple):
    """The first contact at some positions, all arrays of one shape.

    lag      of the driven wheel behind uniform motion (rad of it); inf where nothing touches
    couple   that decides, counted on through all turns
    x        alpha_1 of its driver's tooth (rad)
    state    RECEDES, APPROACHES or LEFT
    """

    lag: Floats
    couple: Ints
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
        return np.broadcast_to(self.pair.couples(self.every).reach, self.every.shape)

    @cached_property
    def exits(self) -> Floats:
        """alpha_2 at which every couple of a cycle leaves (rad)."""
        return np.broadcast_to(self.pair.couples(self.every).exit_angle, self.every.shape)

    def first(self, n: Ints, u: Floats, besides: Ints | None = None) -> FirstContact:
        """The first contact at positions (n, u), each (m,); couples `besides` are left out."""
        best = np.full(len(u), inf)
        couple, x_best, state = np.zeros(len(u), np.int64), np.zeros(len(u)), np.zeros(len(u), np.int64)
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
            best[at], couple[at], x_best[at], state[at] = lag[less], k[at], x[at], kind[less]
        return FirstContact(best, couple, x_best, state)

    def _lag(self, k: Ints, x: Floats, reach: Floats) -> tuple[Floats, Ints]:
        """What couples k make the driven wheel lag with the driver's tooth at x, and how."""
        couples = self.pair.couples(k)
        held = x < -reach
        inside = np.where(held, -reach, x)
        approach, recess = couples.approach_angle(inside, np), couples.recess_angle(inside, np)
        y = np.where(held, couples.exit_angle, np.minimum(approach, recess))
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
        """tau of the couples that decide; 0 where they have left."""
        couples = self.pair.couples(first.couple)
        x = self.inside(first)
        found: Floats = np.where(first.state == LEFT, 0.0, couples.tau(x, first.state == APPROACHES))
        return found

    def inside(self, first: FirstContact) -> Floats:
        """alpha_1 of the couples that decide, kept within their reach; 0 where nothing touches."""
        reach = np.maximum(self.reaches[first.couple % self.pair.count], 0.0)
        return np.clip(first.x, -reach, reach)

    def position(self, k: Ints, x: Floats) -> tuple[Ints, Floats]:
        """The position (n, u) at which the driver's tooth of couples k is at x; u may leave the pitch by rounding."""
        pitch = self.pair.sizes.p1
        ahead = self.pair.first.place[k % self.pair.sizes.z1] - x
        whole = np.floor(ahead / pitch)
        return k + whole.astype(np.int64), ahead - whole * pitch
