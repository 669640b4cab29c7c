"""The transmission function of two cut wheels over the full cycle of their teeth."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from math import inf, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.transmission import TransmissionFunction, behind
from geartrain.uncertainty.manufacturing_errors.contact_envelope import APPROACHES, LEFT, ContactEnvelope
from geartrain.uncertainty.manufacturing_errors.contact_intervals import ContactIntervals, find_contact_intervals
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair
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
    """The transmission function of two wheels cut by hand, over the whole cycle of their teeth.

    Parameters
    ----------
    sizes : TriangularSizes
        What they were meant to be; of a mesh of a train its `cut_sizes`.
    first, second : CutWheel
        The driver and the driven wheel as they are.
    shift : float
        By how much their axles stand farther apart than meant: error of the centre distance, clearance of the
        bearings [as the radii].
    friction : float
        Coefficient of friction, for efficiencies.
    direction : {1, -1}
        -1 turns backwards.

    Returns
    -------
    CutTransmissionFunction
        Errors, speeds and events at any angle of the driver.

    Raises
    ------
    RangeError
        For wheels of other tooth numbers, and teeth that lean beyond the perpendicular.

    Examples
    --------
    Driven teeth that all stand 0.001 rad late leave the driven wheel 0.001 rad ahead of where even teeth have it.

    >>> import geartrain
    >>> from geartrain.uncertainty import CutWheel
    >>> sizes = geartrain.load("moon-triangular").meshes[0].cut_sizes
    >>> driver = CutWheel.even(sizes.z1, sizes.R1, sizes.beta1)
    >>> driven = CutWheel.even(sizes.z2, sizes.R2, sizes.beta2)
    >>> even = cut_transmission_function(sizes, driver, driven)
    >>> late = cut_transmission_function(sizes, driver, driven.placed(0.001))
    >>> round(float(abs(late.error(0.2) - even.error(0.2))), 9)
    0.001
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
    """Driven angle, speed and events of two cut wheels; all repeats after lcm(z1, z2) pitches.

    The transmission error is that against uniform motion of the ratio of tooth numbers: positive where the driven
    wheel is ahead. What jams or clashes has the transmission function that its pushing flanks alone would give.

    Parameters
    ----------
    pair : CutGearPair
        The two wheels and their centre distance.
    friction : float
        Coefficient of friction, for efficiencies.
    direction : {1, -1}
        -1 turns backwards, pushed by the other flanks.

    See Also
    --------
    cut_transmission_function : makes it

    Notes
    -----
    Every couple of teeth in reach forbids the driven wheel to lag behind its contact; it follows the least of them,
    and where none pushes it stands (docs/cut-by-hand.md, 2).
    """

    def __init__(self, pair: CutGearPair, friction: float = 0.0, direction: int = 1) -> None:
        self.pair, self.friction, self.direction = pair, friction, direction
        sizes = pair.sizes
        self.ratio = Fraction(sizes.z1, sizes.z2)
        self.pitch, self.period = sizes.p1, sizes.p1 * pair.count
        self._envelope = ContactEnvelope(pair if direction > 0 else pair.mirrored)

    # ---------------------------------------------------------------------------------------------------- over samples

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error [rad of the driven wheel].

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """dq/dS; 0 where the driven wheel stands still.

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
        return self.error_and_speed(S)[1]

    def efficiency(self, S: ArrayLike) -> Floats:
        """Sliding efficiency, 0 to 1; NaN where nothing pushes.

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
        return self._map(S, self._efficiency)

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Transmission error [rad] and dq/dS together: which couple pushes is found once.

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
        both = self._map(S, lambda found: np.stack((found.lag, self._envelope.speed(found))))
        return self._signed(both[0]), both[1]

    def turned_back(self) -> CutTransmissionFunction:
        """The law of the other flanks; angles keep their sense and decrease."""
        return CutTransmissionFunction(self.pair, self.friction, -self.direction)

    def play(self, S: ArrayLike) -> Floats:
        """How far the driven wheel could be turned on [rad of it]; below 0 it jams there, infinite if nothing stops it.

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
        ahead = self._map(S, lambda found: found.lag)
        back = ContactEnvelope(self._envelope.pair.mirrored, dragged=False)
        behind = self._map(S, lambda found: found.lag, back, -1)
        play: Floats = ahead + behind + self.pair.sizes.p2
        return play

    def driving(self, S: ArrayLike) -> tuple[Ints, Ints]:
        """Numbers of the driver's tooth and the driven tooth that touch, or touched last.

        Parameters
        ----------
        S : array_like
            Driver angles [rad].
        """
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
            # a whole number of pitches but for rounding: rounded to the nearest, not down
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
