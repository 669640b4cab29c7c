"""The verdict on many pairs of cut wheels at once.

With every error a cycle is judged couple by couple (`MeshingCycle`). Of teeth that are right but for their places it
costs z1 + z2 steps a trial, however long it is: 1000 trials of `freeth-2021-cut` then take 13 s where couple by couple
they take 412 s.

The contact of a couple is then the same function for all, and the driven teeth only add their places. The least play
of a front couple against the back couple n before it is J_n(difference of the two driver's teeth), less what two
driven teeth stand apart: one term of the driver's teeth, one of the driven teeth. Over lcm(z1, z2) couples every tooth
meets every other whose number leaves the same rest by gcd(z1, z2): the least of the sums is, for each rest, the sum of
the two least.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from math import gcd, inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.workshop.cutting.cut_pair import ROUNDING, CutGearPair
from geartrain.workshop.cutting.least_backlash import (
    backlash_candidates,
    even_tooth_pair,
    farthest,
    least_sum,
    steepest,
)
from geartrain.workshop.cutting.meshing_cycle import (
    CHUNK,
    MeshingCycle,
    MeshingVerdicts,
    chunks,
    cycle_verdicts,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.workshop.cutting.cut_wheel import CutWheel


_NODES = 2001  # of the table of J_n over the range of places: linear between them
_UNSURE = 1e-4  # of a driven pitch: play that is nearer to 0 is looked at without tables


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


def verdicts_of_pitch_errors(pair: CutGearPair, chunk: int) -> MeshingVerdicts:
    """The verdict on each trial; those that may clash or stand still are looked at couple by couple."""
    parts = [_verdicts(part, chunk) for part in chunks(pair, chunk // (pair.sizes.z1 + pair.sizes.z2))]
    return MeshingVerdicts.joined(parts)


def _verdicts(pair: CutGearPair, chunk: int) -> MeshingVerdicts:
    teeth = _Passing(pair)
    if teeth.reach < 0:  # the tip circles do not meet
        nowhere, never = teeth.disengaged, np.zeros(pair.trials, bool)
        return MeshingVerdicts(np.full(pair.trials, inf), never, never, nowhere, never)
    play = backlash_of_pitch_errors(pair)
    for rows in _parts(np.abs(play) < _UNSURE * pair.sizes.p2, chunk // pair.count):
        play[rows] = MeshingCycle(_some(pair, rows)).play()
    clash, stands = np.zeros(len(play), bool), np.zeros(len(play), bool)
    for rows in _parts(teeth.doubtful, chunk // pair.count):
        some = _Passing(_some(pair, rows))
        clash[rows], stands[rows], entering = some.passing()
        play[rows] = np.minimum(play[rows], entering)
    return MeshingVerdicts(play, clash, stands, teeth.disengaged, np.full(len(play), teeth.couple.leaning.item()))


def _parts(chosen: Bools, size: int) -> Iterator[NDArray[np.int64]]:
    """The rows chosen, some at a time."""
    rows = np.flatnonzero(chosen)
    for start in range(0, len(rows), max(1, size)):
        yield rows[start : start + max(1, size)]


def _some(pair: CutGearPair, rows: NDArray[np.int64]) -> CutGearPair:
    return CutGearPair(pair.sizes, pair.first.taken(rows), pair.second.taken(rows), pair.shift)


def backlash_of_pitch_errors(pair: CutGearPair) -> Floats:
    """Least play over the cycle (rad of the driven wheel), (trials,), to a millionth of a pitch."""
    sizes = _shifted(pair)
    driver, driven = pair.first.place, pair.second.place
    spread = 2 * float(np.abs(driver).max())
    near = {each.n: each.play for each in reversed(backlash_candidates(sizes, farthest(pair)))}
    couple, play = even_tooth_pair(sizes), np.full(pair.trials, inf)
    both, steep = 2 * float(couple.reach), steepest(couple)
    for n in sorted(near, key=lambda n: near[n]):
        apart, stop = driver - np.roll(driver, n, -1), np.roll(driven, n - 1, -1) - driven
        if near[n] - steep * float(np.abs(apart).max()) - float(np.abs(stop).max()) > play.max():
            continue  # errors of place do not bring these below what others have
        own = _read(_table(sizes, n, _rounded(spread)), _rounded(spread), apart)
        own = np.where(np.abs(n * sizes.p1 + apart) < both, own, inf)
        play = np.minimum(play, _met(own, (1 - n) * sizes.p2 + stop, np.minimum))
    return np.asarray(play)


def _met(driver: Any, driven: Any, least: Any) -> Any:
    """The least (greatest) sum of a term of a driver's tooth and a term of a driven tooth that meet in the cycle."""
    rests = gcd(driver.shape[-1], driven.shape[-1])

    def by_rest(each: Any) -> Any:
        return least.reduce(each.reshape(*each.shape[:-1], -1, rests), axis=-2)

    return least.reduce(by_rest(driver) + by_rest(driven), axis=-1)


def _rounded(spread: float) -> float:
    """A power of 2 no less than the spread, so that few tables serve many batches."""
    # without errors of place any width serves: the table is read at its middle
    return float(2.0 ** np.ceil(np.log2(spread))) if spread > 0 else 1e-9


@lru_cache(maxsize=256)
def _table(sizes: TriangularSizes, n: int, spread: float) -> Floats:
    """J_n at places of two driver's teeth that differ by up to `spread` (rad) from even."""
    nodes = np.linspace(-spread, spread, _NODES)
    couple = even_tooth_pair(sizes)
    values = least_sum(couple, couple, n * sizes.p1 + nodes)
    # beyond the common reach, of which there none is asked for: tips meet tips
    tips = -2 * np.sign(n * sizes.p1 + nodes) * float(couple.exit_angle)
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
        self.couple = even_tooth_pair(self.sizes)
        self.reach, self.tip = float(self.couple.reach), float(-self.couple.exit_angle)
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
        y = np.where(x < -self.reach, -self.tip, self.couple.contact(np.clip(x, -self.reach, self.reach)))
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
        stands = (self._least(self._leaving) > -self.tip + self.small).any(axis=1)
        y = self._least(self._coming)
        clash = (y > self.tip + self.small).any(axis=1)
        next_on = self._between(1)[1][:, np.arange(self.pair.count) % self.sizes.z2]
        return clash, stands, np.where(stands, (y + next_on - self.tip).min(axis=1), inf)

    def _least(self, terms: Callable[[int], tuple[Any, Any]]) -> Any:
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
