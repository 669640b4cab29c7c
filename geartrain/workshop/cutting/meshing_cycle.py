"""Events of many pairs of cut wheels, computed together: jam, clash, dwell and loss of contact.

Flanks jam where the distance of a front and a back tooth pair is a minimum (`tightest`). The driven wheel dwells only
where a tooth pair leaves contact, and tips meet only where a tooth pair enters. Each of the lcm(z1, z2) tooth pairs in
a cycle therefore needs only a few contact computations, without time steps (`MeshingCycle`).

With pitch deviations only, a trial costs z1 + z2 operations for a cycle of any length: 1000 trials of `freeth-2021-cut`
take 13 s, compared with 412 s if every tooth pair is computed. The minimum backlash of a front tooth pair against the
back tooth pair n before it is J_n(difference of the two driving teeth) minus the distance between the two driven teeth.
Over lcm(z1, z2) tooth pairs, two teeth meet if their numbers are congruent modulo gcd(z1, z2). So the minimum of the
sums is, in each residue class, the sum of the two minima.

With the driver's front tooth at x and its back tooth `delta` before it, the backlash is f(x) + f'(delta - x) plus terms
of the driven teeth. Here f belongs to the leading flank and f' to the mirrored tooth pair. Both are the minimum of two
smooth functions, which are convex for ordinary teeth. The minimum backlash is therefore the minimum of four sums of
smooth functions, or is at an end of the common reach.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import erfc, floor, gcd, inf, sqrt
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS
from geartrain.workshop.cutting.cut_wheel import ROUNDING, CutGearPair, CutToothPairs

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.cut_wheel import CutWheel


PHASES = ((RECESS, RECESS), (RECESS, APPROACH), (APPROACH, RECESS), (APPROACH, APPROACH))
_MOST_STEPS = 30  # pure bisection would reach 1e-9 of the common reach
SLACK = 0.05  # driven pitches: initial bound of estimated minus exact backlash, enlarged if it proves too small
_NEAR = 1e-6  # of the common reach: after such a step the error of the value, quadratic in the step, is rounding
CHUNK = 1 << 15  # tooth pairs processed at once: their arrays stay in the cache, and memory is bounded
_NODES = 2001  # of the table of J_n, with linear interpolation: the error is below 1e-6 of a pitch
_UNSURE = 1e-4  # driven pitches: a smaller backlash is recomputed without tables, so that their error cannot matter


@dataclass(frozen=True, slots=True)
class MeshingVerdicts:
    """Events of each trial over the meshing cycle, as arrays of shape (trials,)."""

    backlash: Floats
    """Minimum backlash over the cycle [rad of the driven wheel]: negative in a jam, and inf if no teeth touch."""
    clash: Bools
    """Mask of clashes: while the driven wheel lags, a tooth enters with its tip against or ahead of the tip of its
    mate.

    The pair then locks or, rarely, skips a tooth; turning the driven wheel by hand within its backlash may free it.
    """
    dwell: Bools
    """Mask of dwells: the driven wheel stops until the next driving tooth reaches it."""
    disengaged: Bools
    """Mask of losses of contact: at some position, no drive (front) flanks or no coast (back) flanks can touch."""

    @property
    def jams(self) -> Bools:
        """Mask of jams: at some position, the pair cannot turn, wherever the driven wheel is within its backlash."""
        stuck: Bools = self.backlash < 0
        return stuck

    @property
    def stops(self) -> Bools:
        """Mask of trials with a jam or a clash. The driver then cannot turn the pair through its meshing cycle."""
        return self.jams | self.clash

    @classmethod
    def joined(cls, parts: list[MeshingVerdicts]) -> MeshingVerdicts:
        """Return the verdicts of several batches, concatenated into one object."""
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in cls.__slots__))


class TightPlace(NamedTuple):
    """Position of minimum backlash of each pair, and the flank to be filed there."""

    backlash: Floats
    """Minimum backlash over the meshing cycle [rad of the driven wheel]; negative if the pair jams."""
    wheel: Ints
    """Wheel to be filed: 0 for the driver, 1 for the driven wheel."""
    tooth: Ints
    """Index of the tooth to be filed."""
    side: Ints
    """Flank to be filed: 0 for the leading flank, 1 for the trailing flank."""
    gain: Floats
    """Maximum increase of the backlash per unit depth of filing [rad of the driven wheel per unit of length]."""


def batch_verdicts(
    sizes: TriangularSizes, first: CutWheel, second: CutWheel, shift: Any = 0.0, chunk: int = CHUNK
) -> MeshingVerdicts:
    """Return the events of each trial. Arrays of the wheels have shape (trials, z), or (z,) if common to all trials.

    shift   increase of the centre distance [unit of the radii], one value or shape (trials,)
    chunk   number of tooth pairs processed at once
    """
    whole = CutGearPair(sizes, first, second, shift)
    # with a common contact function the cost does not depend on the length of the cycle
    if first.only_pitch_deviations and second.only_pitch_deviations and not np.any(shift):
        parts = chunks(whole, chunk // (sizes.z1 + sizes.z2))
        return MeshingVerdicts.joined([verdicts_of_pitch_errors(part, chunk) for part in parts])
    return MeshingVerdicts.joined([cycle_verdicts(part) for part in chunks(whole, chunk // whole.count)])


def chunks(pair: CutGearPair, trials: int) -> Iterator[CutGearPair]:
    """Yield batches of pairs, each with at most `trials` trials."""
    count, step = pair.trials[0], max(1, trials)
    for start in range(0, count, step):
        yield pair.taken(slice(start, min(start + step, count)))


# -------------------------------------------------------------------- minimum backlash of a front and a back tooth pair


@dataclass(frozen=True, slots=True)
class BacklashCandidate:
    """Position of minimum backlash between a tooth pair on drive flanks (front) and one on coast flanks (back)."""

    n: int
    """Number of tooth pairs from the back pair to the front pair."""
    phases: tuple[str, str]
    """Phases of the front and of the back tooth pair, approach or recess."""
    offset: float
    """Angle of the front driving tooth from the line of centres at the minimum backlash, minus n/2 pitches [rad]."""
    backlash: float
    """Minimum backlash of perfect wheels for this combination of tooth pairs [rad of the driven wheel]."""


def common(front: CutToothPairs, back: CutToothPairs, delta: Any) -> tuple[Any, Any]:
    """Return the limits of the angle of the front driving tooth between which both tooth pairs can touch [rad].

    The range is empty if the lower limit exceeds the upper limit. `delta` is the angle from the front to the back
    driving tooth [rad].
    """
    return np.maximum(-front.reach, delta - back.reach), np.minimum(front.reach, delta + back.reach)


def minimum_backlash_sum(
    front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str]
) -> tuple[Any, Any]:
    """Return the minimum backlash of a front and a back tooth pair, each in one phase, and its driver angle [rad].

    The backlash is the sum of the angles of both driven teeth; it is inf if the pairs never touch at the same time.
    `delta` is the angle from the front to the back driving tooth [rad].
    """
    # Newton's method safeguarded by bisection; the last step improves only the value, by parabolic interpolation
    low, high = common(front, back, delta)
    minimum, most = low, high
    near = _NEAR * (most - minimum)
    with np.errstate(all="ignore"):
        # NaN and inf of tooth pairs that are never in reach together are discarded at the end
        x = np.clip(delta / 2, low, high)
        for _ in range(_MOST_STEPS):
            slope, bend = _slopes(front, back, delta, phases, x)
            low, high = np.where(slope < 0, x, low), np.where(slope > 0, x, high)
            step = x - slope / bend
            # a step that leaves the bracket or is NaN is replaced by a bisection, so every element converges
            step = np.where((step >= low) & (step <= high), step, low + (high - low) / 2)
            done = not (np.abs(step - x) > np.where(minimum < most, near, inf)).any()
            x = step
            if done:
                break
        slope, bend = _slopes(front, back, delta, phases, x)
        value = front.angle(phases[0], x, np) + back.angle(phases[1], delta - x, np)
        step = np.where(bend > 0, slope / bend, inf)
        # an end of the reach is not a stationary point: there the step is long, and no correction applies
        value = value - np.where(np.abs(step) < near, slope * step / 2, 0.0)
        return np.where(minimum < most, value, inf), x


def _slopes(front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str], x: Any) -> tuple[Any, Any]:
    slope = front.speed(phases[0], x, np) - back.speed(phases[1], delta - x, np)
    return slope, front.slope(phases[0], x, np) + back.slope(phases[1], delta - x, np)


def minimum_sum(front: CutToothPairs, back: CutToothPairs, delta: Any) -> Any:
    """Return the minimum backlash of a front and a back tooth pair over all phases [rad]; inf if they never touch.

    delta   angle from the front to the back driving tooth (rad)
    """
    low, high = common(front, back, delta)
    with np.errstate(all="ignore"):
        values = [minimum_backlash_sum(front, back, delta, phases)[0] for phases in PHASES]
        ends = [np.where(low < high, front.contact(x) + back.contact(delta - x), inf) for x in (low, high)]
        return np.fmin.reduce(np.broadcast_arrays(*values, *ends))


def even_tooth_pair(sizes: TriangularSizes) -> CutToothPairs:
    """Return the contact data of a tooth pair of wheels without errors."""
    return CutToothPairs.of(sizes, (0.0, 0.0), (0.0, 0.0), 0.0)


@lru_cache(maxsize=1024)
def backlash_candidates(sizes: TriangularSizes, most: int) -> tuple[BacklashCandidate, ...]:
    """Return the backlash minima of perfect wheels, for coast-flank pairs up to `most` pairs before a drive-flank pair.

    For each distance n in pairs, the result contains those combinations of phases whose minimum is within 0.05 pitches
    of the smallest minimum.
    """
    tooth_pair = even_tooth_pair(sizes)
    candidates = []
    for n in range(-most, most + 1):
        delta, found = n * sizes.p1, []
        if abs(delta) < 2 * float(tooth_pair.reach):
            for phases in PHASES:
                value, x = minimum_backlash_sum(tooth_pair, tooth_pair, np.array(delta), phases)
                found.append(BacklashCandidate(n, phases, float(x) - delta / 2, float(value) + (1 - n) * sizes.p2))
        else:
            # in reach together only with errors: then tips meet tips
            tips = -2 * float(np.sign(n) * tooth_pair.exit_angle)
            found.append(BacklashCandidate(n, PHASES[-1 if n > 0 else 0], 0.0, tips + (1 - n) * sizes.p2))
        limit = min(each.backlash for each in found) + SLACK * sizes.p2
        candidates += sorted((each for each in found if each.backlash <= limit), key=lambda each: each.backlash)
    return tuple(candidates)


def farthest(pair: CutGearPair) -> int:
    """Return the maximum number of pitches between two tooth pairs in contact at the same time; -1 without contact."""
    if pair.widest <= 0:
        return -1
    return floor((2 * pair.widest + 2 * float(np.abs(pair.first.place).max())) / pair.sizes.p1)


def steepest(tooth_pair: CutToothPairs) -> float:
    """Return the maximum speed ratio of a tooth pair: 0 if the teeth never touch, inf if it is undefined."""
    if not tooth_pair.reach > 0:
        return 0.0
    with np.errstate(all="ignore"):
        tau = float(tooth_pair.speed(APPROACH, tooth_pair.reach, np))  # it occurs where the tips meet at entry
    return tau if 0 < tau < inf else inf


def nominal_backlash(sizes: TriangularSizes) -> float:
    """Return the minimum backlash of wheels without errors [pitch of the driven wheel]; negative if they jam."""
    from geartrain.teeth.triangular.clearance_window import TriangularContact

    return TriangularContact(sizes).backlash / sizes.p2


def jamming_bound(sizes: TriangularSizes, sigma: float) -> float:
    """Return an upper bound of the probability of a jam in a meshing cycle: 2 lcm(z1, z2) Q(j / (2 sigma)), at most 1.

    The teeth of both wheels have independent normal pitch deviations of `sigma` pitches. Q is the normal tail
    probability and j the minimum backlash in pitches. Four teeth take part in a jam, and each moves the driven wheel by
    about its own deviation, so the standard deviation of the backlash is 2 sigma. Every tooth pair is counted twice,
    once for each adjacent tooth space.
    """
    backlash = nominal_backlash(sizes)
    if backlash < 0:
        return 1.0
    if sigma == 0:
        return 0.0
    tooth_pairs = sizes.z1 * sizes.z2 // gcd(sizes.z1, sizes.z2)
    # Q(x) = erfc(x / sqrt 2) / 2 keeps its digits in the tail, where 1 - Phi(x) has none
    return min(1.0, 2 * tooth_pairs * erfc(backlash / (2 * sigma) / sqrt(2)) / 2)


# --------------------------------------------------------------------------------------------- tooth pair by tooth pair


def cycle_verdicts(pair: CutGearPair) -> MeshingVerdicts:
    """Return the events of each trial of a batch, computed for one tooth pair after another."""
    cycle = MeshingCycle(pair)
    backlash, dwell, clash = cycle.tightest()[0], cycle.dwells(), cycle.clashes()
    if dwell.any():
        backlash = np.minimum(backlash, np.where(dwell, cycle.backlash_at_entries(), inf))
    return MeshingVerdicts(backlash, clash, dwell, cycle.disengaged())


class MeshingCycle:
    """Tooth pairs of a full meshing cycle for all trials of a batch. Arrays have shape (trials, tooth pairs)."""

    def __init__(self, pair: CutGearPair) -> None:
        self.pair, self.sizes, self.trials = pair, pair.sizes, pair.trials[0]
        k = np.arange(pair.count)
        self.front = pair.tooth_pairs(k)
        # the back flanks are the front flanks of the mirrored pair
        self.back = pair.mirrored.tooth_pairs(-k)
        self.driver, self.driven = pair.places(k)

    # ------------------------------------------------------------------------------------------------------- positions

    def ahead(self, n: int) -> Any:
        """Return the angle from each driving tooth to the driving tooth n tooth pairs before it [rad]."""
        return n * self.sizes.p1 + (self.driver - np.roll(self.driver, n, -1))

    def apart(self, n: int) -> Any:
        """Return the angle from each driven tooth to the driven tooth n tooth pairs before it [rad]."""
        return n * self.sizes.p2 + (self.driven - np.roll(self.driven, n, -1))

    def _all(self, found: Any) -> Any:
        return np.broadcast_to(found, (self.trials, self.pair.count))

    # ------------------------------------------------------------------------------------------------------------ jams

    def tightest(self) -> tuple[Floats, Ints, Ints]:
        """Return three values for each trial: the minimum backlash [rad], the number k of the tooth pair whose drive
        flanks touch there, and the number n for which the coast flanks of tooth pair k - n touch there.
        """
        # the backlash is estimated for all tooth pairs, and computed exactly for those near the minimum
        rough: dict[int, Any] = {}
        backlash = np.full(self.trials, inf)
        where = np.zeros((2, self.trials), np.int64)
        for each in backlash_candidates(self.sizes, farthest(self.pair)):
            value = self._all(self._rough(each))
            rough[each.n] = np.minimum(rough[each.n], value) if each.n in rough else value
            backlash = np.minimum(backlash, value.min(axis=1))
        for n, value in rough.items():
            self._refine(backlash, where, n, value)
        return backlash, where[0], where[1]

    def _refine(self, backlash: Floats, where: Ints, n: int, rough: Floats) -> None:
        """Replace the estimated minimum `backlash`, and its tooth pairs `where`, by exact values.

        rough   estimated backlash of all front pairs and the back pairs n before them (rad), (trials, tooth pairs)
        """
        slack, open_ = SLACK * self.sizes.p2, np.isfinite(rough)
        chosen = np.zeros_like(open_)
        chosen[np.arange(self.trials), rough.argmin(axis=1)] = True
        while True:
            rows, columns = np.nonzero(open_ & (chosen | (rough <= backlash[:, None] + slack)))
            if not len(rows):
                return
            exact = self._exactly(rows, columns, n)
            less = np.flatnonzero(exact <= backlash[rows])
            # with repeated rows the last assignment wins, so each trial keeps its minimum
            less = less[np.argsort(-exact[less], kind="stable")]
            where[0, rows[less]], where[1, rows[less]] = columns[less], n
            # fmin ignores NaN of tips with a reach above a quarter turn: such teeth jam at other tooth pairs anyway
            np.fmin.at(backlash, rows, exact)
            open_[rows, columns] = False
            # the largest observed excess of an estimate over the exact backlash, with a margin of 2
            slack = max(slack, 2 * float(np.max(rough[rows, columns] - exact)))

    def _rough(self, pinch: BacklashCandidate) -> Any:
        """Return the backlash of every tooth pair at the position of the candidate `pinch`: an upper bound [rad]."""
        delta, back = self.ahead(pinch.n), self.back.rolled(pinch.n)
        low, high = common(self.front, back, delta)
        with np.errstate(all="ignore"):
            x = np.clip(delta / 2 + pinch.offset, low, high)
            y = self.front.angle(pinch.phases[0], x, np) + back.angle(pinch.phases[1], delta - x, np)
            return np.where(low < high, y, inf) + self._driven_term(pinch.n)

    def _driven_term(self, n: int) -> Any:
        """Return the term of the driven teeth in the backlash of front pairs and the back pairs n before them [rad]."""
        return (1 - n) * self.sizes.p2 + (np.roll(self.driven, n - 1, -1) - self.driven)

    def _exactly(self, rows: Any, columns: Any, n: int) -> Floats:
        """Return the exact backlash of the front pairs `columns` and back pairs n before, in trials `rows` [rad]."""

        def at(columns: Any) -> Any:
            return lambda each: self._all(each)[rows, columns] if np.ndim(each) else each

        front, back = self.front.picked(at(columns)), self.back.picked(at((columns - n) % self.pair.count))
        delta, stop = self._all(self.ahead(n))[rows, columns], self._all(self._driven_term(n))[rows, columns]
        found: Floats = minimum_sum(front, back, delta) + stop
        return found

    # ------------------------------------------------------------------------------------------------ entries and exits

    def _pairs_in_reach(self) -> int:
        """Return an upper bound of the number of tooth pairs that can be in contact at once."""
        place = self.pair.first.place
        if self.pair.widest == -inf or not np.all(np.asarray(self.front.reach) > -inf):
            return self.pair.count - 2  # a tooth may be missing, so the next pushing pair may be far behind
        return max(1, int(np.ceil((2 * self.pair.widest + float(place.max() - place.min())) / self.sizes.p1)))

    def dwells(self) -> Bools:
        """Return a mask of the trials in which a tooth pair leaves contact before a later pair touches (dwell)."""
        front = self.front
        dwelling: Any = np.array(self._all(self.front.reach > -inf))
        limit = self._all(front.exit_angle) + ROUNDING * self.sizes.p2
        for n in (*range(1, self._pairs_in_reach() + 1), -1):
            # indexed by the pair that takes over; the one n before it leaves
            x = self.ahead(n) - np.roll(self._all(front.reach), n, -1)
            y = np.where(x <= front.reach, self._held(front, x) - self.apart(n), inf)
            dwelling &= np.roll(self._all(y), -n, -1) > limit
            if not dwelling.any():
                break
        found: Bools = dwelling.any(axis=1)
        return found

    def clashes(self) -> Bools:
        """Return a mask of the trials in which a driven tooth is behind the tip of its entering mate (clash)."""
        tip = self._all(-self.front.exit_angle) + ROUNDING * self.sizes.p2
        y = np.where(self._all(self.front.reach > -inf), inf, -inf)
        for n in range(1, self._pairs_in_reach() + 2):
            y = np.minimum(y, self._before(n, self.front.reach))
            if not (y > tip).any():  # y only decreases, so later pairs cannot cause a clash
                break
        found: Bools = ((y > tip) & np.isfinite(y)).any(axis=1)
        return found

    def backlash_at_entries(self) -> Floats:
        """Return the minimum backlash of each trial over the positions where coast flanks enter contact [rad]."""
        y = np.full((self.trials, self.pair.count), inf)
        for n in range(self._pairs_in_reach() + 2):
            y = np.minimum(y, self._before(n, self.back.reach))
        backlash = y + np.roll(self._all(self.apart(1)), -1, -1) + self.back.exit_angle
        found: Floats = np.where(self._all(self.back.reach > -inf), backlash, inf).min(axis=1)
        return found

    def _before(self, n: int, reach: Any) -> Any:
        """Return the angle of each driven tooth from the line of centres [rad] when its mate is at the angle `reach`.

        The tooth pair n pairs earlier determines the angle; it is inf if that pair does not touch.
        """
        before = self.front.rolled(n)
        x = self._all(reach) - self.ahead(n)
        touches = (x <= before.reach) & (before.reach > -inf) & (x > -inf)
        return np.where(touches, self._held(before, np.where(touches, x, 0.0)) + self.apart(n), inf)

    @staticmethod
    def _held(tooth_pairs: CutToothPairs, x: Any) -> Any:
        """Return the angle of the driven tooth at the driver angle x [rad]; after contact, its angle at the exit."""
        with np.errstate(all="ignore"):
            y = tooth_pairs.contact(np.clip(x, -tooth_pairs.reach, tooth_pairs.reach))
            return np.where(x < -tooth_pairs.reach, tooth_pairs.exit_angle, y)

    def disengaged(self) -> Bools:
        """Return a mask of the trials in which no drive flanks or no coast flanks can touch at some position."""
        return self._gap(self.front) | self._gap(self.back)

    def _gap(self, tooth_pairs: CutToothPairs) -> Bools:
        reach = self._all(tooth_pairs.reach)
        touches = reach > -inf
        cycle = self.pair.count * self.sizes.p1
        at = np.arange(self.pair.count) * self.sizes.p1 + self.driver
        enters = np.where(touches, at - reach, inf)
        leaves = np.where(touches, at + reach, -inf)
        before = leaves - cycle  # the sequence of contacts is periodic
        until = np.maximum.accumulate(np.concatenate((before, leaves), axis=1), axis=1)[:, self.pair.count - 1 : -1]
        # a pair that enters before its predecessor does not open a gap
        following = np.minimum.accumulate(enters[:, ::-1], axis=1)[:, ::-1]
        gap = (following > until + ROUNDING * self.sizes.p1) & np.isfinite(following)
        found: Bools = gap.any(axis=1) | ~touches.any(axis=1)
        return found


# ------------------------------------------------------------------------------------------------ pitch deviations only


def verdicts_of_pitch_errors(pair: CutGearPair, chunk: int) -> MeshingVerdicts:
    """Return the events of trials with pitch deviations only; uncertain trials are recomputed pair by pair."""
    teeth, never = _EntriesAndExits(pair), np.zeros(pair.trials, bool)
    found = MeshingVerdicts(backlash_of_pitch_errors(pair), never, never.copy(), teeth.disengaged)
    backlash, size = found.backlash, max(1, chunk // pair.count)
    for rows in _parts(np.abs(backlash) < _UNSURE * pair.sizes.p2, size):
        backlash[rows] = MeshingCycle(pair.taken(rows)).tightest()[0]
    for rows in _parts(teeth.doubtful, size):
        found.clash[rows], found.dwell[rows], entering = _EntriesAndExits(pair.taken(rows)).events()
        backlash[rows] = np.minimum(backlash[rows], entering)
    return found


def _parts(chosen: Bools, size: int) -> Iterator[Ints]:
    """Yield the indices of the true entries of a mask, in arrays of at most `size` indices."""
    rows = np.flatnonzero(chosen)
    return (rows[at : at + size] for at in range(0, len(rows), size))


def backlash_of_pitch_errors(pair: CutGearPair) -> Floats:
    """Return the minimum backlash over the meshing cycle with an accuracy of 1e-6 pitch [rad], shape (trials,)."""
    sizes = pair.sizes
    driver, driven = pair.first.place, pair.second.place
    # two driving teeth may deviate in opposite directions; a power of 2, so that few tables serve many batches
    spread = 2 * float(np.abs(driver).max())
    # without pitch deviations the table is read at its middle, so any width will do
    wide = float(2.0 ** np.ceil(np.log2(spread))) if spread else 1e-9
    near = {each.n: each.backlash for each in reversed(backlash_candidates(sizes, farthest(pair)))}
    tooth_pair, backlash = even_tooth_pair(sizes), np.full(pair.trials, inf)
    both, steep = 2 * float(tooth_pair.reach), steepest(tooth_pair)
    for n in sorted(near, key=lambda n: near[n]):
        apart, stop = driver - np.roll(driver, n, -1), np.roll(driven, n - 1, -1) - driven
        if near[n] - steep * float(np.abs(apart).max()) - float(np.abs(stop).max()) > backlash.max():
            continue  # pitch deviations cannot bring these below the current minimum
        own = _read(_table(sizes, n, wide), wide, apart)
        # teeth farther apart than the common reach never hold the driven wheel together
        own = np.where(np.abs(n * sizes.p1 + apart) < both, own, inf)
        backlash = np.minimum(backlash, extreme_sum(own, (1 - n) * sizes.p2 + stop, np.minimum))
    return np.asarray(backlash)


def by_residue(driver: Any, driven: Any) -> list[Any]:
    """Return two arrays of values of the teeth, (..., z), grouped by the tooth number modulo gcd(z1, z2).

    Teeth with equal residues meet in the meshing cycle. The last axis of the results is the residue.
    """
    rests = gcd(driver.shape[-1], driven.shape[-1])
    return [each.reshape(*each.shape[:-1], -1, rests) for each in (driver, driven)]


def extreme_sum(driver: Any, driven: Any, extreme: Any) -> Any:
    """Return the minimum or maximum (`extreme`) sum of two terms over all teeth that meet in the meshing cycle."""
    one, two = by_residue(driver, driven)
    return extreme.reduce(extreme.reduce(one, axis=-2) + extreme.reduce(two, axis=-2), axis=-1)


@lru_cache(maxsize=256)
def _table(sizes: TriangularSizes, n: int, spread: float) -> Floats:
    """Return a table of the minimum backlash of a drive-flank pair and the coast-flank pair n before it [rad].

    Its entries are for equally spaced deviations of the angle between the two driving teeth, from -`spread` to
    `spread` [rad].
    """
    nodes = np.linspace(-spread, spread, _NODES)
    tooth_pair = even_tooth_pair(sizes)
    values = minimum_sum(tooth_pair, tooth_pair, n * sizes.p1 + nodes)
    # beyond the common reach, where no contact is needed, tips meet tips
    tips = -2 * np.sign(n * sizes.p1 + nodes) * float(tooth_pair.exit_angle)
    found: Floats = np.where(np.isfinite(values), values, tips)
    return found


def _read(table: Floats, spread: float, apart: Floats) -> Floats:
    """Return linearly interpolated values of a `_table` at the deviations `apart`."""
    # np.interp would search for the interval of each value
    at = (apart + spread) * ((_NODES - 1) / (2 * spread))
    low = np.clip(at.astype(np.int64), 0, _NODES - 2)
    found: Floats = table[low] + (table[low + 1] - table[low]) * (at - low)
    return found


class _EntriesAndExits:
    """Entries and exits of teeth that have only pitch deviations, so that all tooth pairs have the same contact."""

    def __init__(self, pair: CutGearPair) -> None:
        self.pair, self.sizes = pair, pair.sizes
        self.tooth_pair = even_tooth_pair(self.sizes)
        self.reach, self.tip = float(self.tooth_pair.reach), float(-self.tooth_pair.exit_angle)
        self.small = ROUNDING * self.sizes.p2
        self.driver, self.driven = (np.atleast_2d(wheel.place) for wheel in (pair.first, pair.second))

    def _between(self, n: int) -> tuple[Any, Any]:
        """Return the angles from each tooth to the tooth n teeth later [rad], for driver and driven wheel."""
        driver = n * self.sizes.p1 + np.roll(self.driver, -n, -1) - self.driver
        return driver, n * self.sizes.p2 + np.roll(self.driven, -n, -1) - self.driven

    def _entering(self, n: int) -> tuple[Any, Any]:
        """Return two arrays, (trials, z) for each wheel, whose sum is the angle of a driven tooth [rad].

        The angle is measured from the line of centres when the driving mate of the tooth is at its entry. The tooth
        pair n pairs earlier determines the angle, and its teeth index the arrays.
        """
        driver, driven = self._between(n)
        return self._held(self.reach - driver), driven

    def _leaving(self, n: int) -> tuple[Any, Any]:
        """Return two arrays as `_entering`, for a driven tooth whose driving mate is at its exit.

        The tooth pair n pairs later determines the angle.
        """
        driver, driven = self._between(n)
        return self._held(driver - self.reach), -driven

    def _held(self, x: Any) -> Any:
        y = np.where(x < -self.reach, -self.tip, self.tooth_pair.contact(np.clip(x, -self.reach, self.reach)))
        return np.where(x > self.reach, inf, y)

    @property
    def disengaged(self) -> Bools:
        """Mask of the trials in which no tooth pair can touch at some position."""
        gap = self._between(1)[0].max(axis=1) > 2 * self.reach + ROUNDING * self.sizes.p1
        found: Bools = np.broadcast_to(gap, self.pair.trials).copy()
        return found

    @property
    def doubtful(self) -> Bools:
        """Mask of the trials in which a clash or a dwell is possible, so that all tooth pairs must be compared."""
        if self.reach < 0:  # the tip circles do not intersect
            return np.zeros(self.pair.trials, bool)
        # far above rounding errors; closer cases are computed pair by pair
        near = 1e-9 * self.sizes.p2
        clash = extreme_sum(*self._entering(1), np.maximum) > self.tip - near
        dwelling = extreme_sum(*self._leaving(1), np.maximum) > -self.tip - near
        found: Bools = np.broadcast_to(clash | dwelling, self.pair.trials).copy()
        return found

    def events(self) -> tuple[Bools, Bools, Floats]:
        """Return masks of clashes and of dwells, and the minimum backlash at entries [rad] (inf without a dwell)."""
        dwelling = (self._minimum(entering=False) > -self.tip + self.small).any(axis=1)
        y = self._minimum(entering=True)
        clash = (y > self.tip + self.small).any(axis=1)
        next_on = self._between(1)[1][:, np.arange(self.pair.count) % self.sizes.z2]
        return clash, dwelling, np.where(dwelling, (y + next_on - self.tip).min(axis=1), inf)

    def _minimum(self, entering: bool) -> Any:
        """Return the minimum angle of each driven tooth at its entry (`entering`) or exit [rad], over all tooth pairs
        that can determine it, shape (trials, tooth pairs).
        """
        k = np.arange(self.pair.count)
        spread = float(np.ptp(self.driver))
        found: Any = inf
        for n in range(1, max(1, int(np.ceil((2 * self.reach + spread) / self.sizes.p1))) + 1 + entering):
            own, other = self._entering(n) if entering else self._leaving(n)
            at = k - n if entering else k
            found = np.minimum(found, own[:, at % self.sizes.z1] + other[:, at % self.sizes.z2])
        return found
