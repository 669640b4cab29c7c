"""Verdicts on many pairs of cut wheels at once: which of them jam, clash, stand still, lose each other.

What can go wrong does so at few places. Two flanks jam where a front and a back couple come nearest (`closing`); the
driven wheel is left standing only where a couple leaves, and a tooth meets a tip only where one comes in. So a cycle
of lcm(z1, z2) couples costs a few contacts each, whatever the fineness of time (`MeshingCycle`).

Of teeth that are right but for their places a trial costs z1 + z2 steps, however long the cycle is: 1000 trials of
`freeth-2021-cut` then take 13 s where couple by couple they take 412 s. The contact of a couple is the same function
for all, and the driven teeth only add their places. The least play of a front couple against the back couple n before
it is J_n(difference of the two driver's teeth), less what two driven teeth stand apart: one term of the driver's teeth,
one of the driven teeth. Over lcm(z1, z2) couples every tooth meets every other whose number leaves the same rest by
gcd(z1, z2): the least of the sums is, for each rest, the sum of the two least.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import gcd, inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.workshop.cutting.cut_wheel import ROUNDING, CutGearPair, CutToothPairs
from geartrain.workshop.cutting.minimum_backlash import (
    BacklashCandidate,
    backlash_candidates,
    common,
    even_tooth_pair,
    farthest,
    minimum_sum,
    steepest,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.cut_wheel import CutWheel


CHUNK = 1 << 15  # couples worked on at once: their arrays stay in a cache, and memory is bounded
_SLACK = 0.05  # of a driven pitch: about what a rough play is above the exact one, or more
_NODES = 2001  # of the table of J_n over the range of places: linear between them
_UNSURE = 1e-4  # of a driven pitch: play that is nearer to 0 is looked at without tables


@dataclass(frozen=True, slots=True)
class MeshingVerdicts:
    """What becomes of each trial, arrays (trials,)."""

    backlash: Floats
    """Least play over the cycle of teeth (rad of the driven wheel): below 0 a front flank is against a back flank;
    inf where nothing touches."""
    clash: Bools
    """A tooth comes in against a tip or in front of it, the driven wheel dragging: the pair sticks fast, or, rarely,
    skips a tooth; led by hand within its play it may pass."""
    dwell: Bools
    """The driven wheel is left standing somewhere."""
    disengaged: Bools
    """Somewhere no tooth is in reach."""
    leans: Bools
    """A flank leans beyond the perpendicular where tips meet: which couple touches first is then not certain."""

    @property
    def jams(self) -> Bools:
        """True where flanks jam: whatever the driven wheel does within its play, the pair cannot turn on."""
        stuck: Bools = self.backlash < 0
        return stuck

    @property
    def stops(self) -> Bools:
        """True where the pair, its driven wheel dragging, cannot turn through its cycle: a jam or a clash."""
        return self.jams | self.clash

    @classmethod
    def joined(cls, parts: list[MeshingVerdicts]) -> MeshingVerdicts:
        """Several batches as one."""
        names = cls.__slots__
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def batch_verdicts(
    sizes: TriangularSizes,
    first: CutWheel,
    second: CutWheel,
    shift: Any = 0.0,
    chunk: int = CHUNK,
) -> MeshingVerdicts:
    """The verdict on each trial: wheels whose arrays are (trials, z), or (z,) where all trials share one.

    shift   by how much the centre distance is greater, as the radii: one, or (trials,)
    chunk   couples worked on at once
    """
    whole = CutGearPair(sizes, first, second, shift)
    if (first.z, second.z) != (sizes.z1, sizes.z2):
        raise RangeError(
            Problem(
                f"wheels of {first.z} and {second.z} teeth stand for a pair of {sizes.z1} and {sizes.z2}",
                "the driver comes first",
                "give one wheel for each of the pair, in this order",
            )
        )
    if len(whole.trials) != 1 or whole.trials[0] < 1:
        raise RangeError(
            Problem(
                f"trials of shape {whole.trials} are no batch",
                "a batch has one axis of trials, and at least one of them",
                "give at least one wheel as arrays (trials, z)",
            )
        )
    if first.only_placed and second.only_placed and np.ndim(shift) == 0:
        return verdicts_of_pitch_errors(whole, chunk)
    return MeshingVerdicts.joined([cycle_verdicts(part) for part in chunks(whole, chunk // whole.count)])


def _verdicts(pair: CutGearPair, chunk: int) -> MeshingVerdicts:
    teeth = _Passing(pair)
    if teeth.reach < 0:  # the tip circles do not meet
        nowhere, never = teeth.disengaged, np.zeros(pair.trials, bool)
        return MeshingVerdicts(np.full(pair.trials, inf), never, never, nowhere, never)
    backlash = backlash_of_pitch_errors(pair)
    for rows in _parts(np.abs(backlash) < _UNSURE * pair.sizes.p2, chunk // pair.count):
        backlash[rows] = MeshingCycle(_some(pair, rows)).backlash()
    clash, stands = np.zeros(len(backlash), bool), np.zeros(len(backlash), bool)
    for rows in _parts(teeth.doubtful, chunk // pair.count):
        some = _Passing(_some(pair, rows))
        clash[rows], stands[rows], entering = some.passing()
        backlash[rows] = np.minimum(backlash[rows], entering)
    return MeshingVerdicts(
        backlash, clash, stands, teeth.disengaged, np.full(len(backlash), teeth.tooth_pair.leaning.item())
    )


def taken(pair: CutGearPair, part: slice | Ints) -> CutGearPair:
    """Some trials of a batch."""
    shift = pair.shift if np.ndim(pair.shift) == 0 else pair.shift[part]
    return CutGearPair(pair.sizes, pair.first.taken(part), pair.second.taken(part), shift)


def chunks(pair: CutGearPair, trials: int) -> Iterator[CutGearPair]:
    """A batch in parts of some trials, at least one."""
    count, step = pair.trials[0], max(1, trials)
    for start in range(0, count, step):
        yield taken(pair, slice(start, min(start + step, count)))


def _parts(chosen: Bools, size: int) -> Iterator[NDArray[np.int64]]:
    """The rows chosen, some at a time."""
    rows = np.flatnonzero(chosen)
    for start in range(0, len(rows), max(1, size)):
        yield rows[start : start + max(1, size)]


def _some(pair: CutGearPair, rows: NDArray[np.int64]) -> CutGearPair:
    return CutGearPair(pair.sizes, pair.first.taken(rows), pair.second.taken(rows), pair.shift)


# ----------------------------------------------------------------------------------------------------- couple by couple


def cycle_verdicts(pair: CutGearPair) -> MeshingVerdicts:
    """The verdict on each trial of a batch, couple by couple."""
    cycle = MeshingCycle(pair)
    backlash, dwell, clash = cycle.backlash(), cycle.left_standing(), cycle.clashes()
    if dwell.any():
        backlash = np.minimum(backlash, np.where(dwell, cycle.backlash_at_entries(), inf))
    return MeshingVerdicts(backlash, clash, dwell, cycle.disengaged(), pair.leans)


class MeshingCycle:
    """All couples of a cycle, for all trials of a batch: arrays (trials, couples)."""

    def __init__(self, pair: CutGearPair) -> None:
        self.pair, self.sizes, self.trials = pair, pair.sizes, pair.trials[0]
        k = np.arange(pair.count)
        self.front = pair.tooth_pairs(k)
        self.back = pair.mirrored.tooth_pairs(-k)
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

    def backlash(self) -> Floats:
        """Least play of each trial (trials,)."""
        return self.tightest()[0]

    def tightest(self) -> tuple[Floats, Ints, Ints]:
        """Least play of each trial, its front couple, and how many couples before it the back couple is, (trials,).

        Told roughly for all couples, exactly for those that come near it.
        """
        rough: dict[int, Any] = {}
        backlash = np.full(self.trials, inf)
        where = np.zeros((2, self.trials), np.int64)
        for bound, each in self._candidates():
            if bound > backlash.max():
                break
            value = self._all(self._rough(each))
            rough[each.n] = np.minimum(rough[each.n], value) if each.n in rough else value
            backlash = np.minimum(backlash, value.min(axis=1))
        for n, value in rough.items():
            self._refine(backlash, where, n, np.array(value))
        return backlash, where[0], where[1]

    def _refine(self, backlash: Floats, where: Ints, n: int, rough: Floats) -> None:
        """The exact play of every couple that may have the least: those seen tell how far rough ones are above it."""
        slack, open_ = _SLACK * self.sizes.p2, np.isfinite(rough)
        chosen = np.zeros_like(open_)
        chosen[np.arange(self.trials), rough.argmin(axis=1)] = True
        while True:
            rows, columns = np.nonzero(open_ & (chosen | (rough <= backlash[:, None] + slack)))
            if not len(rows):
                return
            exact = self._exactly(rows, columns, n)
            less = np.flatnonzero(exact <= backlash[rows])
            # the least of each trial comes last, and stays
            less = less[np.argsort(-exact[less], kind="stable")]
            where[0, rows[less]], where[1, rows[less]] = columns[less], n
            # tips that reach round a quarter of the wheel have no angle: such teeth jam at their other couples
            np.fmin.at(backlash, rows, exact)
            open_[rows, columns] = False
            slack = max(slack, 2 * float(np.max(rough[rows, columns] - exact)))

    def _candidates(self) -> list[tuple[float, BacklashCandidate]]:
        """The ways of jamming, each after what errors as great as these leave it at least; the least first."""
        found = backlash_candidates(self.sizes, farthest(self.pair))
        nearest = {each.n: each.backlash for each in reversed(found)}
        radial = self._radial()
        bounds = {n: backlash - self._rim(n) - radial - _SLACK * self.sizes.p2 for n, backlash in nearest.items()}
        near = [each for each in found if each.backlash <= nearest[each.n] + _SLACK * self.sizes.p2]
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
        found: Floats = minimum_sum(front, back, delta) + stop
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

    def backlash_at_entries(self) -> Floats:
        """Least play where a couple comes in that stops the driven wheel, which may stand there (trials,)."""
        y = np.full((self.trials, self.pair.count), inf)
        for n in range(self._most() + 2):
            y = np.minimum(y, self._before(n, self.back.reach))
        backlash = y + np.roll(self._all(self.apart(1)), -1, -1) + self.back.exit_angle
        found: Floats = np.where(self._all(self.back.reach > -inf), backlash, inf).min(axis=1)
        return found

    def _before(self, n: int, reach: Any) -> Any:
        """alpha_2 of each driven tooth, its driver's tooth at `reach`, as the couple n before has it; inf if none."""
        before = self.front.rolled(n)
        x = self._all(reach) - self.ahead(n)
        touches = (x <= before.reach) & (before.reach > -inf) & (x > -inf)
        return np.where(touches, self._held(before, np.where(touches, x, 0.0)) + self.apart(n), inf)

    @staticmethod
    def _held(tooth_pairs: CutToothPairs, x: Any) -> Any:
        """alpha_2 of the driven tooth: in contact, or where the couple has left it."""
        with np.errstate(all="ignore"):
            y = tooth_pairs.contact(np.clip(x, -tooth_pairs.reach, tooth_pairs.reach))
            return np.where(x < -tooth_pairs.reach, tooth_pairs.exit_angle, y)

    def disengaged(self) -> Bools:
        """Whether somewhere no couple is in reach, of those that push or of those that stop (trials,)."""
        return self._gap(self.front) | self._gap(self.back)

    def _gap(self, tooth_pairs: CutToothPairs) -> Bools:
        reach = self._all(tooth_pairs.reach)
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


# ------------------------------------------------------------------------------------------------- errors of place only


def verdicts_of_pitch_errors(pair: CutGearPair, chunk: int) -> MeshingVerdicts:
    """The verdict on each trial; those that may clash or stand still are looked at couple by couple."""
    parts = [_verdicts(part, chunk) for part in chunks(pair, chunk // (pair.sizes.z1 + pair.sizes.z2))]
    return MeshingVerdicts.joined(parts)


def backlash_of_pitch_errors(pair: CutGearPair) -> Floats:
    """Least play over the cycle (rad of the driven wheel), (trials,), to a millionth of a pitch."""
    sizes = _shifted(pair)
    driver, driven = pair.first.place, pair.second.place
    spread = 2 * float(np.abs(driver).max())
    near = {each.n: each.backlash for each in reversed(backlash_candidates(sizes, farthest(pair)))}
    tooth_pair, backlash = even_tooth_pair(sizes), np.full(pair.trials, inf)
    both, steep = 2 * float(tooth_pair.reach), steepest(tooth_pair)
    for n in sorted(near, key=lambda n: near[n]):
        apart, stop = driver - np.roll(driver, n, -1), np.roll(driven, n - 1, -1) - driven
        if near[n] - steep * float(np.abs(apart).max()) - float(np.abs(stop).max()) > backlash.max():
            continue  # errors of place do not bring these below what others have
        own = _read(_table(sizes, n, _rounded(spread)), _rounded(spread), apart)
        own = np.where(np.abs(n * sizes.p1 + apart) < both, own, inf)
        backlash = np.minimum(backlash, _met(own, (1 - n) * sizes.p2 + stop, np.minimum))
    return np.asarray(backlash)


def _met(driver: Any, driven: Any, minimum: Any) -> Any:
    """The least (greatest) sum of a term of a driver's tooth and a term of a driven tooth that meet in the cycle."""
    rests = gcd(driver.shape[-1], driven.shape[-1])

    def by_rest(each: Any) -> Any:
        return minimum.reduce(each.reshape(*each.shape[:-1], -1, rests), axis=-2)

    return minimum.reduce(by_rest(driver) + by_rest(driven), axis=-1)


def _rounded(spread: float) -> float:
    """A power of 2 no less than the spread, so that few tables serve many batches."""
    # without errors of place any width serves: the table is read at its middle
    return float(2.0 ** np.ceil(np.log2(spread))) if spread > 0 else 1e-9


@lru_cache(maxsize=256)
def _table(sizes: TriangularSizes, n: int, spread: float) -> Floats:
    """J_n at places of two driver's teeth that differ by up to `spread` (rad) from even."""
    nodes = np.linspace(-spread, spread, _NODES)
    tooth_pair = even_tooth_pair(sizes)
    values = minimum_sum(tooth_pair, tooth_pair, n * sizes.p1 + nodes)
    # beyond the common reach, of which there none is asked for: tips meet tips
    tips = -2 * np.sign(n * sizes.p1 + nodes) * float(tooth_pair.exit_angle)
    found: Floats = np.where(np.isfinite(values), values, tips)
    return found


def _read(table: Floats, spread: float, apart: Any) -> Any:
    """A table over -spread..spread, linear between its even nodes."""
    at = (apart + spread) * ((_NODES - 1) / (2 * spread))
    low = np.clip(at.astype(np.int64), 0, _NODES - 2)
    first = table[low]
    return first + (table[low + 1] - first) * (at - low)


class _Passing:
    """Teeth that come in and leave, all of one contact: the driver's teeth say where, the driven teeth only add."""

    def __init__(self, pair: CutGearPair) -> None:
        self.pair, self.sizes = pair, _shifted(pair)
        self.tooth_pair = even_tooth_pair(self.sizes)
        self.reach, self.tip = float(self.tooth_pair.reach), float(-self.tooth_pair.exit_angle)
        self.small = ROUNDING * self.sizes.p2
        self.driver, self.driven = (np.atleast_2d(wheel.place) for wheel in (pair.first, pair.second))

    def _between(self, n: int) -> tuple[Any, Any]:
        """How far the tooth n on is behind each, of the driver and of the driven wheel (rad)."""
        driver = n * self.sizes.p1 + np.roll(self.driver, -n, -1) - self.driver
        return driver, n * self.sizes.p2 + np.roll(self.driven, -n, -1) - self.driven

    def _coming(self, n: int) -> tuple[Any, Any]:
        """Where a tooth comes in, alpha_2 of its driven tooth as the couple n before holds it: the sum of two terms.

        Each by the tooth n before.
        """
        driver, driven = self._between(n)
        return self._held(self.reach - driver), driven

    def _leaving(self, n: int) -> tuple[Any, Any]:
        """Where a tooth leaves, alpha_2 of its driven tooth as the couple n on would have it: the sum of two terms."""
        driver, driven = self._between(n)
        return self._held(driver - self.reach), -driven

    def _held(self, x: Any) -> Any:
        y = np.where(x < -self.reach, -self.tip, self.tooth_pair.contact(np.clip(x, -self.reach, self.reach)))
        return np.where(x > self.reach, inf, y)

    @property
    def disengaged(self) -> Bools:
        """Whether somewhere no tooth is in reach (trials,)."""
        gap = self._between(1)[0].max(axis=1) > 2 * self.reach + ROUNDING * self.sizes.p1
        found: Bools = np.broadcast_to(gap, self.pair.trials).copy()
        return found

    @property
    def doubtful(self) -> Bools:
        """Trials in which the next couple alone is not in time for all (trials,)."""
        # far above rounding: what comes as near is looked at couple by couple
        near = 1e-9 * self.sizes.p2
        clash = _met(*self._coming(1), np.maximum) > self.tip - near
        stands = _met(*self._leaving(1), np.maximum) > -self.tip - near
        found: Bools = np.broadcast_to(clash | stands, self.pair.trials).copy()
        return found

    def passing(self) -> tuple[Bools, Bools, Floats]:
        """Whether a tooth comes in against a tip, whether the driven wheel is left standing, and its play then.

        That where a tooth comes in that stops it, of trials in which it stands; else inf. All (trials,).
        """
        stands = (self._minimum(self._leaving) > -self.tip + self.small).any(axis=1)
        y = self._minimum(self._coming)
        clash = (y > self.tip + self.small).any(axis=1)
        next_on = self._between(1)[1][:, np.arange(self.pair.count) % self.sizes.z2]
        return clash, stands, np.where(stands, (y + next_on - self.tip).min(axis=1), inf)

    def _minimum(self, terms: Callable[[int], tuple[Any, Any]]) -> Any:
        """The least over all couples near, for every couple of the cycle (trials, couples)."""
        k = np.arange(self.pair.count)
        coming = terms == self._coming
        spread = float(np.ptp(self.driver))
        found: Any = inf
        for n in range(1, max(1, int(np.ceil((2 * self.reach + spread) / self.sizes.p1))) + 1 + coming):
            own, other = terms(n)
            at = k - n if coming else k
            found = np.minimum(found, own[:, at % self.sizes.z1] + other[:, at % self.sizes.z2])
        return found


def _shifted(pair: CutGearPair) -> TriangularSizes:
    """The sizes at the centre distance the axles really have."""
    if not pair.shift:
        return pair.sizes
    return pair.sizes.at(pair.sizes.side * ((pair.sizes.D + pair.shift) / pair.sizes.deepest_distance - 1))
