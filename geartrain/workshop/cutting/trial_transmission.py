"""The transmission functions of many pairs of one plan at once: trial t of its wheels at angles of its own."""

from __future__ import annotations

from abc import abstractmethod
from copy import copy
from fractions import Fraction
from math import ceil, floor, inf, lcm, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.transmission import TransmissionFunction, behind
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutToothPairs, of_teeth
from geartrain.workshop.cutting.displaced_pair import DisplacedPair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Ints

_LEFT_BEHIND = 2  # pitches beyond the reach: who left so long ago lags more than who left later
_SLOPE = 1e-4  # of a pitch: over which the speed is the slope of the lag
_TRIAL_BLOCK = 8192  # angles worked on at once: their arrays stay in a cache


class TrialTransmissionFunction(TransmissionFunction):
    """Many pairs of cut wheels as one law.

    even     the mean error of wheels without errors (rad)
    rows     the trial asked at each angle
    count    couples in a full cycle of teeth; `pitches` of both wheels (rad)
    last     errors (rad of the driven wheel) as they were when each trial was last asked
    """

    def __init__(self, teeth: tuple[int, int], even: float, rows: Ints) -> None:
        self.even, self.rows = even, rows
        self.count, self.pitches = lcm(*teeth), (2 * pi / teeth[0], 2 * pi / teeth[1])
        self.ratio, self.period = Fraction(*teeth), self.pitches[0] * self.count
        self.last: Floats = np.zeros(len(rows))
        self._columns: Ints | slice = slice(None)

    @abstractmethod
    def _found(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        """Errors and speeds of some trials."""

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Transmission errors (rad of the driven wheel), -inf where nothing touches, and dq/dS; S is (n,)."""
        S = np.asarray(S, dtype=float)
        error, speed = np.empty_like(S), np.empty_like(S)
        for start in range(0, len(S), _TRIAL_BLOCK):
            part = slice(start, start + _TRIAL_BLOCK)
            error[part], speed[part] = self._found(S[part], self.rows[part])
        self.last[self._columns] = error
        return error, speed

    def picked(self, columns: Ints) -> TrialTransmissionFunction:
        """The laws of some of the trials."""
        found = copy(self)
        found.rows, found._columns = self.rows[columns], columns
        return found

    def error(self, S: ArrayLike) -> Floats:
        """Transmission errors (rad of the driven wheel)."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """dq/dS."""
        return self.error_and_speed(S)[1]

    def error_moments(self) -> tuple[float, float]:
        """The mean error of even wheels, and no ripple: what a superposition counts in its phases."""
        return self.even, 0.0

    def error_range(self) -> tuple[float, float]:
        """Not known before all trials are asked."""
        return -inf, inf

    def speed_range(self) -> tuple[float, float]:
        """Not known before all trials are asked."""
        return 0.0, inf

    def efficiency(self, S: ArrayLike) -> Floats:
        """Not asked of trials."""
        return np.full(np.shape(S), np.nan)

    def efficiency_mean(self) -> float:
        """Not asked of trials."""
        return float("nan")

    def efficiency_at_constant_load(self) -> float:
        """Not asked of trials."""
        return float("nan")

    def efficiency_minimum(self) -> float:
        """Not asked of trials."""
        return float("nan")


class CutTrialTransmission(TrialTransmissionFunction):
    """Of triangular teeth: `pair` has arrays (trials, z), or (z,) where all trials share a wheel."""

    def __init__(self, pair: CutGearPair, even: float, rows: Ints) -> None:
        super().__init__((pair.sizes.z1, pair.sizes.z2), even, rows)
        self.pair = pair
        widest, place = pair.widest, pair.first.place
        apart = float(np.ptp(place)) / pair.sizes.p1 + float(np.ptp(pair.second.place)) / pair.sizes.p2
        low = floor((-widest - float(place.max())) / pair.sizes.p1) if widest > -inf else 0
        high = ceil((widest - float(place.min())) / pair.sizes.p1) + 1 if widest > -inf else -1
        self._window = range(low - _LEFT_BEHIND - ceil(apart), high + 1)

    def _found(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        pitch = self.pair.sizes.p1
        u = np.empty_like(S)
        behind(S, pitch, u, np.empty_like(S))
        n = np.rint((S - u) / pitch).astype(np.int64)
        lag, first = np.full(len(S), inf), n
        for m in self._window:
            here = self._lag(rows, n + m, m * pitch - u)
            less = here < lag
            lag, first = np.where(less, here, lag), np.where(less, n + m, first)
        return -lag, self._speed(rows, first, (first - n) * pitch - u)

    def _lag(self, rows: Ints, k: Ints, ahead: Floats) -> Floats:
        """What couples k make the driven wheel lag (rad); inf out of reach. One that has left holds it where it did."""
        pair, sizes = self.pair, self.pair.sizes
        i, j = k % sizes.z1, k % sizes.z2
        place = of_teeth(pair.first.place, rows, i)
        x, tooth_pairs = ahead + place, self._tooth_pairs(rows, i, j)
        reach = tooth_pairs.reach
        with np.errstate(all="ignore"):
            y = np.where(x < -reach, tooth_pairs.exit_angle, tooth_pairs.contact(np.clip(x, -reach, reach)))
            lag = (y - sizes.ratio * x) + (sizes.ratio * place - of_teeth(pair.second.place, rows, j))
        return np.where((x <= reach) & (reach > -inf), lag, inf)

    def _speed(self, rows: Ints, k: Ints, ahead: Floats) -> Floats:
        """The speed couples k give the driven wheel; 0 where they have left."""
        i, j = k % self.pair.sizes.z1, k % self.pair.sizes.z2
        x, tooth_pairs = ahead + of_teeth(self.pair.first.place, rows, i), self._tooth_pairs(rows, i, j)
        reach = tooth_pairs.reach
        with np.errstate(all="ignore"):
            inside = np.clip(x, -reach, reach)
            return np.where(np.abs(x) <= reach, tooth_pairs.tau(inside, tooth_pairs.approaches(inside)), 0.0)

    def _tooth_pairs(self, rows: Ints, i: Ints, j: Ints) -> CutToothPairs:
        one, two, sizes = self.pair.first, self.pair.second, self.pair.sizes
        shift = self.pair.shift if np.ndim(self.pair.shift) == 0 else self.pair.shift[rows]
        tips = of_teeth(one.tip, rows, i), of_teeth(two.tip, rows, j)
        flanks = of_teeth(one.leading, rows, i), of_teeth(two.trailing, rows, j)
        return CutToothPairs.of(sizes, tips, flanks, shift)


class DisplacedTrialTransmission(TrialTransmissionFunction):
    """Of conjugate teeth with displaced flanks: the foremost couple drives."""

    def __init__(self, pair: DisplacedPair, even: float, rows: Ints) -> None:
        super().__init__(pair.teeth, even, rows)
        self.pair = pair

    def _found(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        rest = np.mod(S, self.period)
        lag, tooth_pair = self.pair.first_lag(rows, rest)
        step = _SLOPE * self.pitches[0]
        with np.errstate(invalid="ignore"):
            # inf - inf where nothing touches
            slope = (self.pair.lag(rows, rest + step, tooth_pair) - self.pair.lag(rows, rest - step, tooth_pair)) / (
                2 * step
            )
        return -lag, np.where(np.isfinite(slope), float(self.ratio) - slope, 0.0)
