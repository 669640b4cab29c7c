"""Transmission functions of pairs: the interface of all tooth forms and pins, and functions derived from others.

Angles are forward angles: S of the driver and q of the driven side both increase as the pair turns forwards. At S = 0 a
tooth of the driver is on the line of centres, or a pin is on the line from its axis to the other axis. The negative
sign of the speed ratio of an external mesh is taken into account by the train, not by these functions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from functools import cache, cached_property
from itertools import pairwise
from math import degrees, inf, nan, sqrt
from typing import TYPE_CHECKING, NamedTuple

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats


_NARROW = 1e-13  # periods: shorter intervals are rounding error of equal kinks
_NODES = 16  # Gauss-Legendre nodes of an interval
_ROUNDING = 1e-14  # fraction of an integral: smaller differences between an interval and its halves are rounding error
_DEEPEST, _DEEPEST_SLOW = 40, 2  # maximum number of bisections of an interval
_MOST_INTERVALS = 1024  # at once: a steep end needs few at each level, more are due to rounding error everywhere
_END = 1e-9  # of an interval: at its ends the next tooth pair, or the other side of the pitch point, counts too
_SAMPLES = 1001  # samples of an interval in the search for the minimum efficiency


@cache
def _gauss_nodes() -> tuple[Floats, Floats]:
    """Return the nodes on [-1, 1] and the weights of the Gauss-Legendre quadrature used between successive kinks."""
    import numpy as np

    x, w = np.polynomial.legendre.leggauss(_NODES)
    return x, w


def check_friction(friction: float) -> float:
    """Check a coefficient of friction, and return it unchanged.

    Raise `RangeError` if the coefficient is negative, infinite or NaN.
    """
    if not 0 <= friction < inf:
        what = f"a coefficient of friction of {friction:g} is out of range"
        raise RangeError(Problem(what, "it must be finite and not negative", "give 0 or more, such as 0.1"))
    return friction


class SpeedLeap(NamedTuple):
    """Step of the speed ratio at an impact of teeth: the ratio before, and the larger ratio after the impact."""

    before: float
    after: float

    @property
    def size(self) -> float:
        """Increase of the speed ratio at the impact."""
        return self.after - self.before


class ContactRubbing(NamedTuple):
    """Sliding speed and relative changes of power per unit friction coefficient, one row for each contact."""

    sliding: Floats
    """Sliding speed divided by pitch-line speed, 0 or more."""
    into: Floats
    """Relative change of the input power of a contact per unit friction coefficient."""
    out: Floats
    """Relative change of the output power of a contact per unit friction coefficient."""

    def efficiency(self, friction: float | Floats) -> Floats:
        """Return the efficiency at each driver angle; NaN if the teeth do not touch or if friction locks one of the
        contacts.

        Simultaneous contacts share the driver's torque equally. A contact with the friction coefficient f transmits the
        fraction (1 + f out) / (1 + f into) of its input power.

        friction   coefficient of friction: one value, or one value for each contact
        """
        import numpy as np

        touching = ~np.isnan(self.out)
        with np.errstate(divide="ignore", invalid="ignore"):
            into, out = 1 + friction * self.into, 1 + friction * self.out
            # a factor of 0 or less means that friction absorbs all power of the contact
            each = np.where(touching, np.where((out > 0) & (into > 0), out / into, nan), 0.0)
            found: Floats = each.sum(axis=0) / touching.sum(axis=0)
        return found


class TransmissionFunction(Shown, ABC):
    """Transmission function of a pair. It gives the driven angle q, the speed ratio and the efficiency as functions of
    the driver's forward angle S.

    The transmission error is q - ratio S, positive if the driven side is ahead of uniform motion. The mean of the
    transmission error is a constant lag that depends on the zero of the angles. This lag is included in the
    transmission error but not in its rms value.

    Attributes
    ----------
    ratio : Fraction
        Exact mean of the speed ratio, driven speed divided by driver speed, without sign.
    period : float
        Period of the transmission function [rad of the driver].
    friction : float
        Coefficient of friction, 0 or more.

    See Also
    --------
    geartrain.teeth.GearMesh : a pair with a transmission function; every tooth form has a method `transmission`.

    Examples
    --------
    A pin at a distance of 2 from its axis drives a slot. The axes are 1 apart, so that the maximum error is asin(1/2).

    >>> from math import degrees, pi
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> transmission = PinToSlotTransmission(2, 1)
    >>> transmission.ratio, transmission.period == 2 * pi, round(degrees(transmission.error_range()[1]), 9)
    (Fraction(1, 1), True, 30.0)
    >>> [round(float(speed), 9) for speed in transmission.speed([0, pi])]
    [2.0, 0.666666667]
    """

    ratio: Fraction
    period: float
    friction: float = 0.0
    pitch_count: int = 1
    """Number of pitches of the driver in one period of the transmission function of a gear pair."""
    waves: int = 1
    """Number of oscillations per period of the fastest component of the transmission error between kinks."""
    slow: bool = False
    """True if each evaluation is slow, so that losses are computed at few angles only."""
    dwell: Fraction = Fraction(0)
    """Fraction of the period during which the driven side is at rest; 1 if it moves in instantaneous steps."""
    at_once: bool = False
    """True if the driven side moves in instantaneous steps, so that the transmission error is discontinuous."""
    measured: bool = False
    """True if the wheels have measured teeth."""

    @property
    def pitch(self) -> float:
        """Angular pitch of the driver of a gear pair [rad]."""
        return self.period / self.pitch_count

    def _summary(self) -> str:
        return f"ratio {self.ratio}, period {degrees(self.period):.6g} deg, friction {self.friction:g}"

    @abstractmethod
    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error q - ratio S at driver angles S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Transmission error [rad of the driven side], of the shape of S.
        """

    @abstractmethod
    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio dq/dS at driver angles S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Speed ratio, of the shape of S.
        """

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency (output power divided by input power) at driver angles S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Efficiency, 0 to 1, of the shape of S; NaN where teeth are not in contact or friction locks them.
        """
        return self.rubbing(S).efficiency(self.friction)

    @abstractmethod
    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio over a period."""

    @abstractmethod
    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error over a period [rad of the driven side]."""

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error and its rms deviation from the mean [rad of the driven side]."""
        S, weights = self.graded_nodes(self.speed)
        error = self.error(S)
        mean = float(weights @ error)
        # two passes: the mean of squares minus the square of the mean would cancel
        return mean, sqrt(float(weights @ (error - mean) ** 2))

    def efficiency_mean(self) -> float:
        """Return the mean efficiency over driver angles at constant driver torque; NaN if friction locks the pair."""
        if self.locks:
            return nan
        weights, efficiency, _ = self._efficiencies
        return float((weights * efficiency).sum() / weights.sum())

    def efficiency_at_constant_load(self) -> float:
        """Return work output over work input at constant load torque; NaN if the pair locks or its mean ratio is 0."""
        if self.locks or not self.ratio:
            return nan
        weights, efficiency, speed = self._efficiencies
        # at constant load torque, the output power is proportional to the speed, the input power to speed / efficiency
        return float((weights * speed).sum() / (weights * (speed / efficiency)).sum())

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency, computed from 1001 samples of each smooth interval, or from the quadrature
        nodes if `slow` is True; NaN if friction locks the pair.
        """
        if self.locks:
            return nan
        if self.slow:
            # the efficiency at the nodes is known already
            return float(self._efficiencies[1].min())
        import numpy as np

        share = np.linspace(_END, 1 - _END, _SAMPLES)
        S = np.concatenate([low + (high - low) * share for low, high in self.smooth_intervals()])
        return float(np.nanmin(self.efficiency(S)))

    @cached_property
    def _efficiencies(self) -> tuple[Floats, Floats, Floats]:
        """Weights, efficiencies and speed ratios at those quadrature nodes over one period at which teeth touch."""
        import numpy as np

        S, weights = self.graded_nodes(lambda S: self.speed(S) / self.efficiency(S))
        efficiency = self.efficiency(S)
        touching = ~np.isnan(efficiency)
        return weights[touching], efficiency[touching], self.speed(S[touching])

    def graded_nodes(self, integrand: Callable[[Floats], Floats]) -> tuple[Floats, Floats]:
        """Return the nodes of a Gauss-Legendre quadrature over one period [rad of the driver], and their weights.

        Smooth intervals are bisected until the integral is accurate to rounding error, or at most twice if `slow` is
        True. Intervals in which the integrand is NaN are not divided.

        Parameters
        ----------
        integrand : callable
            Function of driver angles [rad], which returns an array of their shape.

        Returns
        -------
        tuple of ndarray
            Nodes and weights; the sum of the weights is 1.
        """
        import numpy as np

        x, w = _gauss_nodes()

        def nodes(low: Floats, high: Floats) -> Floats:
            found: Floats = ((low + high) / 2)[:, None] + ((high - low) / 2)[:, None] * x
            return found

        def integral(low: Floats, high: Floats) -> Floats:
            found: Floats = integrand(nodes(low, high)) @ w * (high - low) / 2
            return found

        low, high = np.array(self.smooth_intervals()).T
        done = []
        with np.errstate(divide="ignore", invalid="ignore"):
            whole = integral(low, high)
            scale = np.nansum(np.abs(whole))
            for _ in range(_DEEPEST_SLOW if self.slow else _DEEPEST):
                middle = (low + high) / 2
                low, high = np.append(low, middle), np.append(middle, high)
                halves = integral(low, high)
                # NaN, as without contact, is not above the tolerance, so that such an interval is not divided
                off = np.abs(halves.reshape(2, -1).sum(axis=0) - whole)
                rough = np.tile(off > _ROUNDING * np.maximum(scale, np.abs(whole)), 2)
                done.append((low[~rough], high[~rough]))
                low, high, whole = low[rough], high[rough], halves[rough]
                if not len(low) or len(low) > _MOST_INTERVALS:
                    break
        low, high = (np.concatenate(ends) for ends in zip(*done, (low, high), strict=True))
        return nodes(low, high).ravel(), (((high - low) / 2)[:, None] * w).ravel() / (high - low).sum()

    @property
    def locking_friction(self) -> float:
        """Minimum coefficient of friction at which the pair locks at some angle; infinite if it never locks."""
        return inf

    @property
    def locks(self) -> bool:
        """True if friction locks the pair at some driver angle."""
        return self.friction >= self.locking_friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speeds of the contacts, and the relative changes of their input and output power per unit
        friction coefficient. These values do not depend on the coefficient itself.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ContactRubbing
            Sliding speed and friction terms of input and output power, of shape (contacts, *shape of S).

        Raises
        ------
        RangeError
            If the sliding speed of the transmission function is not known.
        """
        what = "the sliding speed of this pair is not known"
        why = "sliding speeds are computed for pairs of teeth only"
        raise RangeError(Problem(what, why, "give the coefficient of friction as a number"))

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] at which the function or a derivative is discontinuous; by default none."""
        return []

    def smooth_intervals(self) -> list[tuple[float, float]]:
        """Return the intervals of the driver angle [rad] between successive kinks within a period. Intervals that are
        as short as rounding errors are omitted.
        """
        # a function without kinks is smooth over a whole period, from 0
        cuts = sorted({kink % self.period for kink in self.kinks()} or {0.0})
        edges = pairwise([*cuts, cuts[0] + self.period])
        return [(low, high) for low, high in edges if high - low > _NARROW * self.period]

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """Return all upward steps of the speed ratio (impacts) within one period; None if they are not computed."""
        return None

    def steepest_fall(self) -> float | None:
        """Return the maximum of -d(speed ratio)/dS between impacts [1/rad]; 0 if the speed ratio never decreases.

        While the speed ratio falls, a driven inertia J tends to run ahead of the driver. The teeth stay in contact at a
        driver speed w if the load torque is at least J w^2 times the returned value. None is returned if the value is
        not known or infinite.
        """
        return None

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return the transmission error and the speed ratio, computed together if this is faster.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        tuple of ndarray
            Results of `error` and `speed`.
        """
        return self.error(S), self.speed(S)

    def reversed_motion(self) -> TransmissionFunction:
        """Return the transmission function while the driver turns backwards; by default this function itself."""
        return self

    def mirrored(self) -> TransmissionFunction:
        """Return the transmission function for a driver whose mean motion is opposite to the positive sense of its
        angle; the default is this function itself.

        Its error at S is minus the error of this function at -S. Override it in functions whose error is not odd.
        """
        return self

    def picked(self, columns: NDArray[np.int64]) -> TransmissionFunction:
        """Return the transmission function for some columns of an array of driver angles, for example for some trials.

        The result differs from this function only if each column of angles has its own transmission function.

        Parameters
        ----------
        columns : ndarray of int
            Indices of the columns.

        Returns
        -------
        TransmissionFunction
            Transmission function for these columns.
        """
        del columns
        return self

    def angle(self, S: ArrayLike) -> Floats:
        """Return the driven angle q at driver angles S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Driven angle [rad], of the shape of S.
        """
        import numpy as np

        S = np.asarray(S, dtype=float)
        angle: Floats = float(self.ratio) * S + self.error(S)
        return angle


class ExactRatio(TransmissionFunction):
    """Transmission function with a constant speed ratio and without losses.

    Its transmission error is the constant `lag` [rad of the driven side], by default 0.
    """

    def __init__(self, ratio: Fraction, period: float, lag: float = 0.0) -> None:
        self.ratio, self.period, self.lag = ratio, period, lag

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error at driver angles S [rad of the driven side]. The error is constant."""
        return self._constant(S, self.lag)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S. The ratio is constant."""
        return self._constant(S, float(self.ratio))

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speed and the changes of power of a single contact, all 0, as it has no losses."""
        return ContactRubbing(*(self._constant(S, 0.0)[None] for _ in range(3)))

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio, which are equal because the ratio is constant."""
        return float(self.ratio), float(self.ratio)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad of the driven side]; both are equal."""
        return self.lag, self.lag

    def error_moments(self) -> tuple[float, float]:
        """Return the transmission error [rad of the driven side], and 0 as its rms deviation from the mean."""
        return self.lag, 0.0

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad]: 0, because it is constant."""
        return 0.0

    @staticmethod
    def _constant(S: ArrayLike, value: float) -> Floats:
        import numpy as np

        return np.full(np.shape(S), value)


class LosslessTransmission(TransmissionFunction):
    """Transmission function without a friction model. Losses follow only from a declared efficiency."""

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S. It is 1 at all angles."""
        import numpy as np

        return np.ones(np.shape(S))

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency. It is 1, because losses are not modelled."""
        return 1.0
