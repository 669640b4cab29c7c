"""Transmission functions of many pairs of cut wheels, computed together. Each driver angle applies to one trial."""

from __future__ import annotations

from abc import abstractmethod
from copy import copy
from fractions import Fraction
from functools import cached_property
from math import ceil, floor, inf, lcm, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutToothPairs, of_teeth
from geartrain.workshop.cutting.displaced_pair import DisplacedPair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Ints

_LAG_WINDOW = 2  # pitches beyond the reach: a pair that left earlier always lags more than one that left later
_SLOPE = 1e-4  # pitches: step of the central difference for the speed, well above rounding
_SAMPLES = 64  # positions per pitch of a single trial, for its mean and its range
_TRIAL_BLOCK = 8192  # angles processed at once: their arrays stay in the cache


class TrialTransmissionFunction(TransmissionFunction):
    """Transmission function of a pair of cut wheels in many trials.

    even      mean transmission error of wheels without errors (rad)
    rows      index of the trial to which each driver angle belongs; a single index if all angles belong to one trial
    count     number of tooth pairs in a full meshing cycle
    pitches   angular pitches of both wheels (rad)
    last      transmission error of each trial when it was last evaluated (rad of the driven wheel)
    """

    def __init__(self, teeth: tuple[int, int], even: float, rows: Ints) -> None:
        self.even, self.rows = even, rows
        self.count, self.pitches = lcm(*teeth), (2 * pi / teeth[0], 2 * pi / teeth[1])
        self.ratio, self.period, self.pitch_count = Fraction(*teeth), self.pitches[0] * self.count, self.count
        self.last: Floats = np.zeros(np.shape(rows))
        self._columns: Ints | slice = slice(None)

    @abstractmethod
    def _evaluate(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        """Return transmission errors [rad of the driven wheel] and speed ratios of trials `rows` at angles S [rad]."""

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return transmission errors (-inf if no teeth touch) and speed ratios at driver angles S [rad]."""
        angles = np.asarray(S, dtype=float)
        S = angles.ravel()
        rows = np.broadcast_to(self.rows, S.shape) if self.measured else self.rows
        error, speed = np.empty_like(S), np.empty_like(S)
        for start in range(0, len(S), _TRIAL_BLOCK):
            part = slice(start, start + _TRIAL_BLOCK)
            error[part], speed[part] = self._evaluate(S[part], rows[part])
        if not self.measured:
            self.last[self._columns] = error
        return error.reshape(angles.shape), speed.reshape(angles.shape)

    @property
    def measured(self) -> bool:  # type: ignore[override]
        """True if all driver angles belong to a single trial, as in a train with measured wheels."""
        return not np.ndim(self.rows)

    def reversed_motion(self) -> TrialTransmissionFunction:
        """Raise `QuestionError`, because cut teeth are evaluated only in the declared sense of rotation."""
        what, why = "the train turns backwards", "cut teeth are evaluated in the declared sense of rotation only"
        raise QuestionError(Problem(what, why, "give positive turns, or omit the measured teeth"))

    def picked(self, columns: Ints) -> TrialTransmissionFunction:
        """Return the transmission functions for the driver angles with the given indices; they share `last`."""
        if self.measured:
            return self
        found = copy(self)
        found.rows, found._columns = self.rows[columns], columns
        return found

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission errors [rad of the driven wheel] at driver angles S [rad]."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratios dq/dS of the driven angle q at driver angles S [rad]."""
        return self.error_and_speed(S)[1]

    def error_moments(self) -> tuple[float, float]:
        """Return mean transmission error and its rms deviation [rad]: of one trial, or `even` and 0 for many trials."""
        return (float(self._samples.mean()), float(self._samples.std())) if self.measured else (self.even, 0.0)

    def error_range(self) -> tuple[float, float]:
        """Return the limits of the transmission error of a single trial [rad]; infinite limits for many trials."""
        return (float(self._samples.min()), float(self._samples.max())) if self.measured else (-inf, inf)

    @cached_property
    def _samples(self) -> Floats:
        """Transmission errors of a single trial at 64 positions per pitch [rad]."""
        return self.error(np.linspace(0, self.period, _SAMPLES * self.count, endpoint=False))

    def speed_range(self) -> tuple[float, float]:
        """Return the limits 0 and infinity, because the range of the speed ratio of cut teeth is not known."""
        return 0.0, inf


class CutTrialTransmission(TrialTransmissionFunction):
    """Transmission function of cut triangular wheels, with arrays (trials, z), or (z,) if equal in all trials."""

    def __init__(self, pair: CutGearPair, even: float, rows: Ints) -> None:
        super().__init__((pair.sizes.z1, pair.sizes.z2), even, rows)
        self.pair = pair
        widest, place = pair.widest, pair.first.place
        apart = float(np.ptp(place)) / pair.sizes.p1 + float(np.ptp(pair.second.place)) / pair.sizes.p2
        low = floor((-widest - float(place.max())) / pair.sizes.p1) if widest > -inf else 0
        high = ceil((widest - float(place.min())) / pair.sizes.p1) + 1 if widest > -inf else -1
        # numbers of tooth pairs, relative to the nearest one, that can touch or can be the last to have left
        self._window = range(low - _LAG_WINDOW - ceil(apart), high + 1)

    def _evaluate(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        pitch = self.pair.sizes.p1
        u: Floats = np.mod(S, pitch)
        # whole pitches and the rest, because k p - S would lose the digits of a long run
        n = np.rint((S - u) / pitch).astype(np.int64)
        lag, first = np.full(len(S), inf), n
        for m in self._window:
            here = self._lag(rows, n + m, m * pitch - u)
            less = here < lag
            lag, first = np.where(less, here, lag), np.where(less, n + m, first)
        return -lag, self._speed(rows, first, (first - n) * pitch - u)

    def _lag(self, rows: Ints, k: Ints, ahead: Floats) -> Floats:
        """Return the lag of the driven wheel due to one tooth pair in each trial [rad].

        It is inf before the teeth touch; after their contact, the driven tooth remains where it was left.

        rows    indices of the trials; `k` are the numbers of the tooth pairs
        ahead   angle from the line of centres to the nominal position of each driving tooth (rad)
        """
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
        """Return the speed ratio of one tooth pair in each trial, 0 without contact. The arguments are as in `_lag`."""
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
    """Transmission function of teeth with displaced flanks. The tooth pair drives that permits the smallest lag."""

    def __init__(self, pair: DisplacedPair, even: float, rows: Ints) -> None:
        super().__init__(pair.teeth, even, rows)
        self.pair = pair

    def _evaluate(self, S: Floats, rows: Ints) -> tuple[Floats, Floats]:
        # reduced to one meshing cycle, so that the central difference keeps its digits in long runs
        rest = np.mod(S, self.period)
        lag, tooth_pair = self.pair.minimum_lag(rows, rest)
        step = _SLOPE * self.pitches[0]
        with np.errstate(invalid="ignore"):
            # inf - inf where no teeth touch
            before, after = (self.pair.lag(rows, rest + sign * step, tooth_pair) for sign in (-1, 1))
            slope = (after - before) / (2 * step)
        return -lag, np.where(np.isfinite(slope), float(self.ratio) - slope, 0.0)
