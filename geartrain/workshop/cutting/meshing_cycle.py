"""Many pairs of cut wheels at once: which of them jam, clash, stand still, lose each other.

What can go wrong does so at few places. Two flanks jam where a front and a back couple come nearest (`closing`); the
driven wheel is left standing only where a couple leaves, and a tooth meets a tip only where one comes in. So a cycle
of lcm(z1, z2) couples costs a few contacts each, whatever the fineness of time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.workshop.cutting.cut_pair import ROUNDING, CutGearPair, CutToothPairs
from geartrain.workshop.cutting.least_backlash import (
    BacklashCandidate,
    backlash_candidates,
    common,
    even_tooth_pair,
    farthest,
    least_sum,
    steepest,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints


CHUNK = 1 << 15  # couples worked on at once: their arrays stay in a cache, and memory is bounded
_SLACK = 0.05  # of a driven pitch: about what a rough play is above the exact one, or more


@dataclass(frozen=True, slots=True)
class MeshingVerdicts:
    """What becomes of each trial, arrays (trials,).

    play         least play over the cycle of teeth (rad of the driven wheel): below 0 a front flank is against a back
                 flank; inf where nothing touches
    clash        a tooth comes in against a tip, the driven wheel dragging; led by hand within its play it may pass
    standstill   the driven wheel is left standing somewhere
    disengaged   somewhere no tooth is in reach
    leans        a flank leans beyond the perpendicular where tips meet: which couple touches first is then not certain
    """

    play: Floats
    clash: Bools
    standstill: Bools
    disengaged: Bools
    leans: Bools

    @property
    def jams(self) -> Bools:
        """True where flanks jam: whatever the driven wheel does within its play, the pair cannot turn on."""
        stuck: Bools = self.play < 0
        return stuck

    @property
    def stops(self) -> Bools:
        """True where the pair, its driven wheel dragging, cannot turn through its cycle: jammed, or tip against tip."""
        return self.jams | self.clash

    @classmethod
    def joined(cls, parts: list[MeshingVerdicts]) -> MeshingVerdicts:
        """Several batches as one."""
        names = cls.__slots__
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def taken(pair: CutGearPair, part: slice | Ints) -> CutGearPair:
    """Some trials of a batch."""
    shift = pair.shift if np.ndim(pair.shift) == 0 else pair.shift[part]
    return CutGearPair(pair.sizes, pair.first.taken(part), pair.second.taken(part), shift)


def chunks(pair: CutGearPair, trials: int) -> Iterator[CutGearPair]:
    """A batch in parts of some trials, at least one."""
    count, step = pair.trials[0], max(1, trials)
    for start in range(0, count, step):
        yield taken(pair, slice(start, min(start + step, count)))


class MeshingCycle:
    """All couples of a cycle, for all trials of a batch: arrays (trials, couples)."""

    def __init__(self, pair: CutGearPair) -> None:
        self.pair, self.sizes, self.trials = pair, pair.sizes, pair.trials[0]
        k = np.arange(pair.count)
        self.front = pair.couples(k)
        self.back = pair.mirrored.couples(-k)
        self.driver, self.driven = pair.places(k)

    # ---------------------------------------------------------------------------------------------------------- places

    def ahead(self, n: int) -> Any:
        """How far the driver's tooth of each couple is behind that n couples before (rad)."""
        return n * self.sizes.p1 + (self.driver - np.roll(self.driver, n, -1))

    def apart(self, n: int) -> Any:
        """How far the driven tooth of each couple is behind that n couples before (rad)."""
        return n * self.sizes.p2 + (self.driven - np.roll(self.driven, n, -1))

    def _all(self, found: Any) -> Any:
        return np.broadcast_to(found, (self.trials, self.pair.count))

    # ------------------------------------------------------------------------------------------------------------ jams

    def play(self) -> Floats:
        """Least play of each trial (trials,)."""
        return self.tightest()[0]

    def tightest(self) -> tuple[Floats, Ints, Ints]:
        """Least play of each trial, its front couple, and how many couples before it the back couple is, (trials,).

        Told roughly for all couples, exactly for those that come near it.
        """
        rough: dict[int, Any] = {}
        play = np.full(self.trials, inf)
        where = np.zeros((2, self.trials), np.int64)
        for bound, each in self._candidates():
            if bound > play.max():
                break
            value = self._all(self._rough(each))
            rough[each.n] = np.minimum(rough[each.n], value) if each.n in rough else value
            play = np.minimum(play, value.min(axis=1))
        for n, value in rough.items():
            self._refine(play, where, n, np.array(value))
        return play, where[0], where[1]

    def _refine(self, play: Floats, where: Ints, n: int, rough: Floats) -> None:
        """The exact play of every couple that may have the least: those seen tell how far rough ones are above it."""
        slack, open_ = _SLACK * self.sizes.p2, np.isfinite(rough)
        chosen = np.zeros_like(open_)
        chosen[np.arange(self.trials), rough.argmin(axis=1)] = True
        while True:
            rows, columns = np.nonzero(open_ & (chosen | (rough <= play[:, None] + slack)))
            if not len(rows):
                return
            exact = self._exactly(rows, columns, n)
            less = np.flatnonzero(exact <= play[rows])
            # the least of each trial comes last, and stays
            less = less[np.argsort(-exact[less], kind="stable")]
            where[0, rows[less]], where[1, rows[less]] = columns[less], n
            # tips that reach round a quarter of the wheel have no angle: such teeth jam at their other couples
            np.fmin.at(play, rows, exact)
            open_[rows, columns] = False
            slack = max(slack, 2 * float(np.max(rough[rows, columns] - exact)))

    def _candidates(self) -> list[tuple[float, BacklashCandidate]]:
        """The ways of jamming, each after what errors as great as these leave it at least; the least first."""
        found = backlash_candidates(self.sizes, farthest(self.pair))
        nearest = {each.n: each.play for each in reversed(found)}
        radial = self._radial()
        bounds = {n: play - self._rim(n) - radial - _SLACK * self.sizes.p2 for n, play in nearest.items()}
        near = [each for each in found if each.play <= nearest[each.n] + _SLACK * self.sizes.p2]
        return sorted(((bounds[each.n], each) for each in near), key=lambda pair: pair[0])

    def _rim(self, n: int) -> float:
        """More than the places of teeth can take from the play of a couple and the one n before it (rad)."""
        driver = float(np.abs(self.ahead(n) - n * self.sizes.p1).max())
        driven = float(np.abs(self._stop(n) - (1 - n) * self.sizes.p2).max())
        # 1.2 here and 3 below give room: too wide a bound costs time only, too narrow a one a jam
        return 1.2 * max(steepest(even_tooth_pair(self.sizes)), self.sizes.ratio) * driver + driven

    def _radial(self) -> float:
        """More than heights, half angles and distance can change any play (rad)."""
        one, two, sizes = self.pair.first, self.pair.second, self.sizes
        tips = float(np.abs(one.tip).max() + np.abs(two.tip).max() + np.abs(self.pair.shift).max()) / sizes.R2
        flanks = max(float(np.abs(each).max()) for wheel in (one, two) for each in (wheel.leading, wheel.trailing))
        steep = min(max(sizes.beta1, sizes.beta2) + sizes.reach1 + sizes.reach2, 1.4)
        length = (sizes.delta / sizes.R2 + tips) / np.cos(steep)
        return float(3 * np.tan(steep) * tips + 3 * length * flanks)

    def _rough(self, pinch: BacklashCandidate) -> Any:
        """The play of every couple where even wheels have their least: no less than it is at its own least."""
        delta, back = self.ahead(pinch.n), self.back.rolled(pinch.n)
        low, high = common(self.front, back, delta)
        with np.errstate(all="ignore"):
            x = np.clip(delta / 2 + pinch.offset, low, high)
            y = self.front.angle(pinch.phases[0], x, np) + back.angle(pinch.phases[1], delta - x, np)
            return np.where(low < high, y, inf) + self._stop(pinch.n)

    def _stop(self, n: int) -> Any:
        """What the driven teeth add to the play: that of the back couple, one on, behind that of the front couple."""
        return (1 - n) * self.sizes.p2 + (np.roll(self.driven, n - 1, -1) - self.driven)

    def _exactly(self, rows: Any, columns: Any, n: int) -> Floats:
        """The play of one front couple in each of some trials against the back couple n before."""

        def at(columns: Any) -> Any:
            return lambda each: self._all(each)[rows, columns] if np.ndim(each) else each

        front, back = self.front.picked(at(columns)), self.back.picked(at((columns - n) % self.pair.count))
        delta, stop = self._all(self.ahead(n))[rows, columns], self._all(self._stop(n))[rows, columns]
        found: Floats = least_sum(front, back, delta) + stop
        return found

    # ------------------------------------------------------------------------------------------------ entries and exits

    def _most(self) -> int:
        """Couples that can be in reach at once, and one."""
        place = self.pair.first.place
        if self.pair.widest == -inf or not np.all(np.asarray(self.front.reach) > -inf):
            return self.pair.count - 2  # a tooth may be missing: the couple that pushes next may be far behind
        return max(1, int(np.ceil((2 * self.pair.widest + float(place.max() - place.min())) / self.sizes.p1)))

    def left_standing(self) -> Bools:
        """Whether, where a couple leaves, every one behind it is still clear of its driven tooth (trials,)."""
        front = self.front
        stands: Any = np.array(self._all(self.front.reach > -inf))
        limit = self._all(front.exit_angle) + ROUNDING * self.sizes.p2
        for n in (*range(1, self._most() + 1), -1):
            # seen from the couple that catches: the one n before it leaves
            x = self.ahead(n) - np.roll(self._all(front.reach), n, -1)
            y = np.where(x <= front.reach, self._held(front, x) - self.apart(n), inf)
            stands &= np.roll(self._all(y), -n, -1) > limit
            if not stands.any():
                break
        found: Bools = stands.any(axis=1)
        return found

    def clashes(self) -> Bools:
        """Whether, where a couple comes in, the driven wheel holds its driven tooth behind the tip (trials,)."""
        tip = self._all(-self.front.exit_angle) + ROUNDING * self.sizes.p2
        y = np.where(self._all(self.front.reach > -inf), inf, -inf)
        for n in range(1, self._most() + 2):
            y = np.minimum(y, self._before(n, self.front.reach))
            if not (y > tip).any():
                break
        found: Bools = ((y > tip) & np.isfinite(y)).any(axis=1)
        return found

    def play_at_entries(self) -> Floats:
        """Least play where a couple comes in that stops the driven wheel, which may stand there (trials,)."""
        y = np.full((self.trials, self.pair.count), inf)
        for n in range(self._most() + 2):
            y = np.minimum(y, self._before(n, self.back.reach))
        play = y + np.roll(self._all(self.apart(1)), -1, -1) + self.back.exit_angle
        found: Floats = np.where(self._all(self.back.reach > -inf), play, inf).min(axis=1)
        return found

    def _before(self, n: int, reach: Any) -> Any:
        """alpha_2 of each driven tooth, its driver's tooth at `reach`, as the couple n before has it; inf if none."""
        before = self.front.rolled(n)
        x = self._all(reach) - self.ahead(n)
        touches = (x <= before.reach) & (before.reach > -inf) & (x > -inf)
        return np.where(touches, self._held(before, np.where(touches, x, 0.0)) + self.apart(n), inf)

    @staticmethod
    def _held(couples: CutToothPairs, x: Any) -> Any:
        """alpha_2 of the driven tooth: in contact, or where the couple has left it."""
        with np.errstate(all="ignore"):
            y = couples.contact(np.clip(x, -couples.reach, couples.reach))
            return np.where(x < -couples.reach, couples.exit_angle, y)

    def disengaged(self) -> Bools:
        """Whether somewhere no couple is in reach, of those that push or of those that stop (trials,)."""
        return self._gap(self.front) | self._gap(self.back)

    def _gap(self, couples: CutToothPairs) -> Bools:
        reach = self._all(couples.reach)
        touches = reach > -inf
        cycle = self.pair.count * self.sizes.p1
        at = np.arange(self.pair.count) * self.sizes.p1 + self.driver
        enters = np.where(touches, at - reach, inf)
        leaves = np.where(touches, at + reach, -inf)
        before = leaves - cycle
        until = np.maximum.accumulate(np.concatenate((before, leaves), axis=1), axis=1)[:, self.pair.count - 1 : -1]
        # what comes in before its forerunner opens no gap
        following = np.minimum.accumulate(enters[:, ::-1], axis=1)[:, ::-1]
        gap = (following > until + ROUNDING * self.sizes.p1) & np.isfinite(following)
        found: Bools = gap.any(axis=1) | ~touches.any(axis=1)
        return found


def cycle_verdicts(pair: CutGearPair) -> MeshingVerdicts:
    """The verdict on each trial of a batch, couple by couple."""
    cycle = MeshingCycle(pair)
    play, standstill, clash = cycle.play(), cycle.left_standing(), cycle.clashes()
    if standstill.any():
        play = np.minimum(play, np.where(standstill, cycle.play_at_entries(), inf))
    return MeshingVerdicts(play, clash, standstill, cycle.disengaged(), pair.leans)
