"""The law of two cut wheels over the full cycle of their teeth.

The laws of many pairs of one plan at once, each asked at angles of its own: trial t of its wheels at angle S[t].
"""

from __future__ import annotations

from copy import copy
from fractions import Fraction
from functools import cached_property
from math import ceil, floor, inf, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.transmission import TransmissionFunction, behind
from geartrain.uncertainty.manufacturing_errors.contact_envelope import APPROACHES, LEFT, ContactEnvelope
from geartrain.uncertainty.manufacturing_errors.contact_intervals import ContactIntervals, find_contact_intervals
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair, CutToothPairs
from geartrain.uncertainty.manufacturing_errors.meshing_events import MeshingEvents, find_meshing_events

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.uncertainty.manufacturing_errors.contact_envelope import FirstContact
    from geartrain.uncertainty.manufacturing_errors.cut_wheel import CutWheel

_BLOCK = 8192  # samples worked on at once: their intermediate arrays stay in a cache


def cut_transmission_function(
    sizes: TriangularSizes,
    first: CutWheel,
    second: CutWheel,
    shift: float = 0.0,
    friction: float = 0.0,
    direction: int = 1,
) -> CutTransmissionFunction:
    """The law of two wheels cut by hand.

    sizes           what they were meant to be; of a mesh of a train its `cut_sizes`
    first, second   the driver and the driven wheel as they are
    shift           by how much their axles stand farther apart than meant, as the radii: error of the centre distance
                    and play of the bearings
    Raises `RangeError` for wheels of other tooth numbers, and teeth that lean.
    """
    if (first.z, second.z) != (sizes.z1, sizes.z2):
        raise RangeError(
            Problem(
                f"wheels of {first.z} and {second.z} teeth stand for a pair of {sizes.z1} and {sizes.z2}",
                "the driver comes first",
                "give one wheel for each of the pair, in this order",
            )
        )
    return CutTransmissionFunction(CutGearPair(sizes, first, second, shift).checked(), friction, direction)


class CutTransmissionFunction(TransmissionFunction):
    """Driven angle, speed and events of two cut wheels; the law repeats after lcm(z1, z2) pitches.

    The transmission error is that against uniform motion of the ratio of tooth numbers: positive where the driven
    wheel is ahead. `direction` -1 turns backwards, pushed by the other flanks. What jams or clashes has the law its
    pushing flanks alone would give.
    """

    def __init__(self, pair: CutGearPair, friction: float = 0.0, direction: int = 1) -> None:
        self.pair, self.friction, self.direction = pair, friction, direction
        sizes = pair.sizes
        self.ratio = Fraction(sizes.z1, sizes.z2)
        self.pitch, self.period = sizes.p1, sizes.p1 * pair.count
        self._envelope = ContactEnvelope(pair if direction > 0 else pair.mirrored)

    # ---------------------------------------------------------------------------------------------------- over samples

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error (rad of the driven wheel) at driver angles S (rad)."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """dq/dS at driver angles S (rad); 0 where the driven wheel stands still."""
        return self.error_and_speed(S)[1]

    def efficiency(self, S: ArrayLike) -> Floats:
        """Sliding efficiency at driver angles S (rad); NaN where nothing pushes."""
        return self._map(S, self._efficiency)

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Both at driver angles S (rad): who pushes is found once."""
        both = self._map(S, lambda found: np.stack((found.lag, self._envelope.speed(found))))
        return self._signed(both[0]), both[1]

    def turned_back(self) -> CutTransmissionFunction:
        """The law of the other flanks; angles keep their sense and decrease."""
        return CutTransmissionFunction(self.pair, self.friction, -self.direction)

    def play(self, S: ArrayLike) -> Floats:
        """How far the driven wheel could be turned on at driver angles S (rad of it); below 0 it jams there.

        Infinite where nothing would stop it.
        """
        ahead = self._map(S, lambda found: found.lag)
        back = ContactEnvelope(self._envelope.pair.mirrored, dragged=False)
        behind = self._map(S, lambda found: found.lag, back, -1)
        play: Floats = ahead + behind + self.pair.sizes.p2
        return play

    def driving(self, S: ArrayLike) -> tuple[Ints, Ints]:
        """Driver's tooth and driven tooth that touch, or touched last, at driver angles S (rad)."""
        couple = self._map(S, lambda found: found.couple).astype(np.int64)
        k, back = (couple, 0) if self.direction > 0 else (-couple, 1)
        return k % self.pair.sizes.z1, (k + back) % self.pair.sizes.z2

    def _map(self, S: ArrayLike, what: Any, envelope: ContactEnvelope | None = None, sense: int = 1) -> Floats:
        S = np.asarray(S, dtype=float)
        flat = S.ravel() * (self.direction * sense)
        parts = []
        for start in range(0, max(len(flat), 1), _BLOCK):
            part = flat[start : start + _BLOCK]
            u = np.empty_like(part)
            behind(part, self.pitch, u, np.empty_like(part))
            n = np.rint((part - u) / self.pitch).astype(np.int64)
            parts.append(what((envelope or self._envelope).first(n, u)))
        found: Floats = np.concatenate(parts, axis=-1)
        return found.reshape((*found.shape[:-1], *S.shape))

    def _signed(self, lag: Floats) -> Floats:
        return -lag if self.direction > 0 else self.pair.sizes.p2 + lag

    def _efficiency(self, found: FirstContact) -> Floats:
        couples = self._envelope.pair.couples(found.couple)
        x = self._envelope.inside(found)
        eta = np.where(
            found.state == APPROACHES,
            couples.efficiency("approach", x, self.friction, np),
            couples.efficiency("recess", x, self.friction, np),
        )
        return np.where((found.state == LEFT) | ~np.isfinite(found.lag), np.nan, eta)

    # -------------------------------------------------------------------------------------------------- over the cycle

    @cached_property
    def stretches(self) -> ContactIntervals:
        """The cycle cut into stretches in each of which one couple pushes in one phase, or none does."""
        return find_contact_intervals(self._envelope)

    @cached_property
    def events(self) -> MeshingEvents:
        """Jams, clashes, standstills and gaps of the cycle, with the teeth concerned."""
        return find_meshing_events(self._envelope)

    def corners(self) -> list[float]:
        """Driver angles (rad) where the law or a slope of it is not smooth."""
        angles = self.direction * (self.stretches.n * self.pitch + self.stretches.start)
        return sorted(float(angle) for angle in angles)

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

    def efficiency_mean(self) -> float:
        """Mean efficiency over the driver's angle in contact, at constant driver torque."""
        eta, weights = self.stretches.over(self._efficiency)
        held = np.isfinite(eta)
        return float(weights[held] @ eta[held] / weights[held].sum())

    def efficiency_at_constant_load(self) -> float:
        """Work done on a constant load torque over the work put in, over the cycle in contact."""
        eta, weights = self.stretches.over(self._efficiency)
        tau, _ = self.stretches.over(self._envelope.speed)
        held = np.isfinite(eta)
        turned = weights[held] * tau[held]
        return float(turned.sum() / (turned / eta[held]).sum())

    def efficiency_least(self) -> float:
        """Least sliding efficiency, among the nodes of all stretches of the cycle."""
        return float(np.nanmin(self.stretches.over(self._efficiency)[0]))

    @property
    def runs(self) -> bool:
        """True if the pair turns without jam, clash, standstill or gap."""
        return not self.events and self.pair.widest > -inf


_LEFT_BEHIND = 2  # pitches beyond the reach: who left so long ago lags more than who left later
_TRIAL_BLOCK = 8192  # angles worked on at once: their arrays stay in a cache


class TrialTransmissionFunction(TransmissionFunction):
    """Many pairs of cut wheels as one law.

    pair   arrays (trials, z), or (z,) where all trials share a wheel
    even   the mean error of wheels without errors (rad)
    rows   the trial asked at each angle
    last   errors (rad of the driven wheel) as they were when each trial was last asked
    """

    def __init__(self, pair: CutGearPair, even: float, rows: Ints) -> None:
        self.pair, self.even, self.rows = pair, even, rows
        self.ratio, self.period = Fraction(pair.sizes.z1, pair.sizes.z2), pair.sizes.p1 * pair.count
        self.last: Floats = np.zeros(len(rows))
        self._columns: Ints | slice = slice(None)
        widest, place = pair.widest, pair.first.place
        apart = float(np.ptp(place)) / pair.sizes.p1 + float(np.ptp(pair.second.place)) / pair.sizes.p2
        low = floor((-widest - float(place.max())) / pair.sizes.p1) if widest > -inf else 0
        high = ceil((widest - float(place.min())) / pair.sizes.p1) + 1 if widest > -inf else -1
        self._window = range(low - _LEFT_BEHIND - ceil(apart), high + 1)

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Transmission errors (rad of the driven wheel), -inf where nothing touches, and dq/dS; S is (n,)."""
        S = np.asarray(S, dtype=float)
        error, speed = np.empty_like(S), np.empty_like(S)
        for start in range(0, len(S), _TRIAL_BLOCK):
            part = slice(start, start + _TRIAL_BLOCK)
            error[part], speed[part] = self._found(S[part], self.rows[part])
        self.last[self._columns] = error
        return error, speed

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
        place = _of(pair.first.place, rows, i)
        x, couples = ahead + place, self._couples(rows, i, j)
        reach = couples.reach
        with np.errstate(all="ignore"):
            y = np.where(x < -reach, couples.exit_angle, couples.contact(np.clip(x, -reach, reach)))
            lag = (y - sizes.ratio * x) + (sizes.ratio * place - _of(pair.second.place, rows, j))
        return np.where((x <= reach) & (reach > -inf), lag, inf)

    def _speed(self, rows: Ints, k: Ints, ahead: Floats) -> Floats:
        """The speed couples k give the driven wheel; 0 where they have left."""
        i, j = k % self.pair.sizes.z1, k % self.pair.sizes.z2
        x, couples = ahead + _of(self.pair.first.place, rows, i), self._couples(rows, i, j)
        reach = couples.reach
        with np.errstate(all="ignore"):
            inside = np.clip(x, -reach, reach)
            return np.where(np.abs(x) <= reach, couples.tau(inside, couples.approaches(inside)), 0.0)

    def _couples(self, rows: Ints, i: Ints, j: Ints) -> CutToothPairs:
        one, two, sizes = self.pair.first, self.pair.second, self.pair.sizes
        shift = self.pair.shift if np.ndim(self.pair.shift) == 0 else self.pair.shift[rows]
        tip1, tip2 = _of(one.tip, rows, i), _of(two.tip, rows, j)
        return CutToothPairs(
            sizes.R1 + tip1,
            sizes.R2 + tip2,
            sizes.beta1 + _of(one.leading, rows, i),
            sizes.beta2 + _of(two.trailing, rows, j),
            sizes.D + shift,
            sizes.delta + tip1 + tip2 - shift,
        )

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

    def efficiency_least(self) -> float:
        """Not asked of trials."""
        return float("nan")


def _of(each: Floats, rows: Ints, teeth: Ints) -> Any:
    """The value of one tooth of each trial; a plain 0 where all are."""
    if each.ndim == 1:
        return each[teeth] if each.any() else 0.0
    return each[rows, teeth]
