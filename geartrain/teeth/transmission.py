"""Transmission functions of pairs: the interface of every tooth form and pin, the exact ratio, and derived functions.

Angles are forward angles: S of the driver and q of the driven side both grow as the pair turns forward, and S = 0 has a
driver's tooth on the line of centres (a pin: pointing at the other axis). The sign that an external mesh gives to the
driven speed belongs to the train, not to these functions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from math import degrees, inf
from typing import TYPE_CHECKING, NamedTuple

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats


def check_friction(friction: float) -> float:
    """A coefficient of friction. Raises `RangeError` below 0 and for infinity and NaN."""
    if not 0 <= friction < inf:
        raise RangeError(Problem(f"a friction of {friction:g}", "it would push", "give 0 or more, such as 0.1"))
    return friction


class SpeedLeap(NamedTuple):
    """A collision of teeth: the speed ratio before it, and the greater one after."""

    before: float
    after: float

    @property
    def size(self) -> float:
        """By how much it leaps."""
        return self.after - self.before


class ContactRubbing(NamedTuple):
    """How the teeth of a pair rub at some driver angles: arrays of one row for each contact; NaN where none is."""

    sliding: Floats
    """Speed of sliding over that of the pitch line, 0 or more."""
    into: Floats
    """What a unit of friction adds to the power that enters at a contact, and to that which leaves it, over both
    without friction: the efficiency of a contact is (1 + f out) / (1 + f into)."""
    out: Floats
    """What a unit of friction adds to the power that enters at a contact, and to that which leaves it, over both
    without friction: the efficiency of a contact is (1 + f out) / (1 + f into)."""


class TransmissionFunction(Shown, ABC):
    """Driven angle, speed ratio and efficiency of one pair as functions of the driver's forward angle S.

    The transmission error is q - ratio S, positive where the driven side is ahead of uniform motion. Its mean, a lag
    that depends on where angles are counted from, is left in the error and out of its rms.

    Attributes
    ----------
    ratio : Fraction
        Exact mean of the speed ratio, driven over driver, without sign.
    period : float
        Driver's angle after which the law repeats [rad].
    friction : float
        Coefficient of friction, 0 or more.

    See Also
    --------
    geartrain.teeth.GearMesh : a pair with such a law; every tooth form has a method `transmission`.

    Examples
    --------
    A pin at 2 from its axis in a slot whose axis is 1 away: its greatest error is asin(1/2).

    >>> from math import degrees, pi
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> transmission = PinToSlotTransmission(2, 1)
    >>> transmission.ratio, transmission.period == 2 * pi, round(degrees(transmission.error_range()[1]), 9)
    (Fraction(1, 1), True, 30.0)
    >>> [float(speed) for speed in transmission.speed([0, pi])]
    [2.0, 0.6666666666666666]
    """

    ratio: Fraction
    period: float
    friction: float = 0.0

    def _summary(self) -> str:
        return f"ratio {self.ratio}, period {degrees(self.period):.6g} deg, friction {self.friction:g}"

    @abstractmethod
    def error(self, S: ArrayLike) -> Floats:
        """Transmission error q - ratio S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Of that shape [rad of the driven side].
        """

    @abstractmethod
    def speed(self, S: ArrayLike) -> Floats:
        """Instantaneous speed ratio dq/dS.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Of that shape.
        """

    @abstractmethod
    def efficiency(self, S: ArrayLike) -> Floats:
        """Power out over power in.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Of that shape, 0 to 1; NaN where nothing is in contact.
        """

    @abstractmethod
    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio."""

    @abstractmethod
    def error_range(self) -> tuple[float, float]:
        """Least and greatest transmission error (rad of the driven side)."""

    @abstractmethod
    def error_moments(self) -> tuple[float, float]:
        """Mean of the transmission error, and its rms about that mean (rad of the driven side)."""

    @abstractmethod
    def efficiency_mean(self) -> float:
        """Mean efficiency over the driver's angle, at constant driver torque."""

    @abstractmethod
    def efficiency_at_constant_load(self) -> float:
        """Work done on a constant torque of the driven side over the work put in; NaN where friction locks."""

    @abstractmethod
    def efficiency_minimum(self) -> float:
        """Least efficiency at any driver angle; NaN where friction locks."""

    @property
    def locking_friction(self) -> float:
        """The least friction that locks at some driver angle; infinite where none does."""
        return inf

    @property
    def locks(self) -> bool:
        """True if friction locks the pair at some driver angle."""
        return self.friction >= self.locking_friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """How the teeth rub, whatever their friction.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ContactRubbing
            Speed of sliding and shares of power, of S's shape behind the contacts.

        Raises
        ------
        RangeError
            For laws without an account of it.
        """
        what = "the sliding of this pair is not known"
        raise RangeError(Problem(what, "it is no pair of teeth", "give a coefficient of friction as a plain number"))

    def rubbing_nodes(self) -> tuple[Floats, Floats, ContactRubbing] | None:
        """Driver angles of a period, weights, and `rubbing` there, for laws that would be slow to ask at any others."""
        return None

    def kinks(self) -> list[float]:
        """Driver angles (rad) where the law or a slope of it is not smooth; none by default."""
        return []

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """Every collision of a pitch; None for laws without an account of them."""
        return None

    def steepest_fall(self) -> float | None:
        """Greatest rate -d(speed ratio)/dS at which the speed falls between collisions (1/rad), 0 if it never does.

        As it falls the driven inertia J runs ahead of a slack drive: the law holds at a driver's speed w while the load
        torque is at least J w^2 times this. None for laws without an account of it.
        """
        return None

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Transmission error and speed ratio, for less than the two apart where a law can.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        tuple of ndarray
            As of `error` and `speed`.
        """
        return self.error(S), self.speed(S)

    def reversed_motion(self) -> TransmissionFunction:
        """The law while the driver's angle decreases: the same, but for teeth with play."""
        return self

    def picked(self, columns: NDArray[np.int64]) -> TransmissionFunction:
        """The law for some of the angles it was asked at: the same, but where each angle has a law of its own.

        Parameters
        ----------
        columns : ndarray of int
            Which of them, by number.

        Returns
        -------
        TransmissionFunction
            For these.
        """
        del columns
        return self

    def angle(self, S: ArrayLike) -> Floats:
        """Driven angle q.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Of that shape [rad].
        """
        import numpy as np

        S = np.asarray(S, dtype=float)
        angle: Floats = float(self.ratio) * S + self.error(S)
        return angle


def behind(S: Floats, period: float, out: Floats, scratch: Floats) -> None:
    """`out` = S less whole periods, in half the time of numpy.mod.

    The period is taken in two parts, so that the first product is exact up to some 10^8 periods.
    """
    import numpy as np

    coarse = float(np.float32(period))
    np.multiply(S, 1 / period, out=scratch)
    np.floor(scratch, out=scratch)
    np.multiply(scratch, coarse, out=out)
    np.subtract(S, out, out=out)
    np.multiply(scratch, period - coarse, out=scratch)
    np.subtract(out, scratch, out=out)


class ExactRatio(TransmissionFunction):
    """A law without error or loss: the ratio of tooth counts at every instant."""

    def __init__(self, ratio: Fraction, period: float) -> None:
        self.ratio, self.period = ratio, period

    def error(self, S: ArrayLike) -> Floats:
        """0 everywhere."""
        return self._constant(S, 0.0)

    def speed(self, S: ArrayLike) -> Floats:
        """The mean ratio everywhere."""
        return self._constant(S, float(self.ratio))

    def efficiency(self, S: ArrayLike) -> Floats:
        """1 everywhere."""
        return self._constant(S, 1.0)

    def speed_range(self) -> tuple[float, float]:
        """The mean ratio twice."""
        return float(self.ratio), float(self.ratio)

    def error_range(self) -> tuple[float, float]:
        """0 twice."""
        return 0.0, 0.0

    def error_moments(self) -> tuple[float, float]:
        """0 twice."""
        return 0.0, 0.0

    def efficiency_mean(self) -> float:
        """1."""
        return 1.0

    def efficiency_at_constant_load(self) -> float:
        """1."""
        return 1.0

    def efficiency_minimum(self) -> float:
        """1."""
        return 1.0

    def steepest_fall(self) -> float:
        """0."""
        return 0.0

    @staticmethod
    def _constant(S: ArrayLike, value: float) -> Floats:
        import numpy as np

        return np.full(np.shape(S), value)


class DerivedTransmission(TransmissionFunction):
    """A law that moves as `transmission` does, and differs in how it is worked out or in what it loses."""

    def __init__(self, transmission: TransmissionFunction) -> None:
        self.transmission, self.ratio, self.period = transmission, transmission.ratio, transmission.period

    def speed_range(self) -> tuple[float, float]:
        """The law's own."""
        return self.transmission.speed_range()

    def error_range(self) -> tuple[float, float]:
        """The law's own."""
        return self.transmission.error_range()

    def error_moments(self) -> tuple[float, float]:
        """The law's own."""
        return self.transmission.error_moments()

    def kinks(self) -> list[float]:
        """The law's own."""
        return self.transmission.kinks()

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """The law's own."""
        return self.transmission.speed_leaps()

    def steepest_fall(self) -> float | None:
        """The law's own."""
        return self.transmission.steepest_fall()

    @property
    def locking_friction(self) -> float:
        """The law's own."""
        return self.transmission.locking_friction


class ConstantLag(ExactRatio):
    """A law that keeps its ratio, its driven side always by `mean` (rad) ahead of uniform motion."""

    def __init__(self, ratio: Fraction, period: float, mean: float) -> None:
        super().__init__(ratio, period)
        self.mean = mean

    @classmethod
    def at(cls, transmission: TransmissionFunction, S: float) -> ConstantLag:
        """What another law does where its driver stands at S (rad), whatever S is."""
        return cls(transmission.ratio, transmission.period, float(transmission.error(S)))

    def error(self, S: ArrayLike) -> Floats:
        """The same everywhere."""
        return self._constant(S, self.mean)

    def error_range(self) -> tuple[float, float]:
        """The same twice."""
        return self.mean, self.mean

    def error_moments(self) -> tuple[float, float]:
        """The mean, and 0."""
        return self.mean, 0.0
