"""Transmission functions of a pin in a slot. Only angles at the two axes count: a pin at radius r, the axes e apart.

The driver's angle S is counted from the direction that points from the pin's axis to the slot's.
"""

from __future__ import annotations

from fractions import Fraction
from math import acos, acosh, atan2, inf, log, nan, pi, sqrt
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.transmission import TransmissionFunction, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_MINIMUM = 1e-40  # of any unit: the fourth power of a distance is a float
_SAMPLES = 4096  # of a smooth periodic function: its mean by equal samples is exact to rounding unless r is close to e


def log_share(r: float, e: float) -> float:
    """ln((r + e)/(r - e))/pi, r > e: what a unit of friction adds to 1 in the mean of 1/eta over the *slot's* turn.

    There eta = 1/(1 + f |tan d|), sin d = (e/r) sin psi, d the angle between pin radius and slot.
    """
    return log((r + e) / (r - e)) / pi


def mean_over_the_pin(r: float, e: float, f: float) -> float:
    """Mean of 1/(1 + f |tan d|) over the *pin's* turn, r > e; with -f that of 1/(1 - f |tan d|), c > -1.

    With c = f e/sqrt(r^2 - e^2) and tan(S/2) = sqrt((r - e)/(r + e)) tan(u/2) it is the integral over 0 <= u <= pi of
    sqrt(r^2 - e^2)/(pi (r + e cos u)(1 + c sin u)), which partial fractions turn into logarithm and arc cosine.
    """
    width = sqrt((r - e) * (r + e))
    c = f * e / width
    # as a product: near c = 1, where the quotient is 1, the difference 1 - c^2 has lost half its digits
    apart = sqrt(abs(1 - c) * (1 + c))
    inner = 2 * (acos(c) / apart if c < 1 else 1 if c == 1 else acosh(c) / apart)
    return (1 - f * log_share(r, e) + f * f * r * inner / (pi * width)) / (1 + f * f)


class PinTransmission(TransmissionFunction):
    """What a pin in a slot and a pin in a follower share. `friction` is that of the pin along the slot."""

    PAGE = "report.pair_page:describe_pin"

    period = 2 * pi
    driver: ClassVar[Literal["pin", "slot"]]
    """Which of the two drives."""

    def __init__(self, pin_radius: float, offset: float, friction: float = 0.0) -> None:
        self.r, self.e, self.friction = pin_radius, offset, friction
        _check(pin_radius, offset, friction)

    @property
    def amplitude(self) -> float:
        """Greatest transmission error (rad), the same on both sides: asin of the lesser over the greater distance."""
        less, more = min(self.r, self.e), max(self.r, self.e)
        return atan2(less, sqrt((more - less) * (more + less)))  # not asin, which loses half the digits near r = e

    @property
    def _steepest(self) -> float:
        """Greatest tan d of a pin whose circle encloses the slot's axis: e/sqrt(r^2 - e^2)."""
        return self.e / sqrt((self.r - self.e) * (self.r + self.e))

    def error_range(self) -> tuple[float, float]:
        """Minus and plus the amplitude."""
        return -self.amplitude, self.amplitude

    def error_moments(self) -> tuple[float, float]:
        """0, and the rms of the error (rad)."""
        error = self.error(self._turn())
        return 0.0, sqrt(float(np.mean(error**2)))

    def _turn(self) -> Floats:
        return np.arange(_SAMPLES, dtype=np.float64) * (self.period / _SAMPLES)


def _check(pin_radius: float, offset: float, friction: float) -> None:
    """Raises `RangeError` for distances out of range, and where the pin passes through the slot's axis."""
    if not (_MINIMUM < pin_radius < 1 / _MINIMUM and (offset == 0 or _MINIMUM < offset < 1 / _MINIMUM)):
        raise RangeError(
            Problem(
                f"a pin radius of {pin_radius:g} and an offset of {offset:g}",
                f"distances of a pin lie between {_MINIMUM:g} and {1 / _MINIMUM:g}",
                "give a pin radius above 0 and an offset of 0 or more",
            )
        )
    if pin_radius == offset:
        raise RangeError(
            Problem(
                f"a pin radius of {pin_radius:g} equals the offset: the pin would pass through the slot's axis",
                "there the slot's direction is undetermined; the mean ratio is 1 above and 0 below",
                "make them differ",
            )
        )
    check_friction(friction)


class PinToSlotTransmission(PinTransmission):
    """A pin drives a slot: slot angle = S + atan2(e sin S, r - e cos S) for r > e, else -atan2(r sin S, e - r cos S).

    The mean ratio is 1 where the pin's circle encloses the slot's axis (r > e), else 0: then the follower's angle is
    counted from the direction that points from its axis to the pin's. Friction leaves 1/(1 + f |tan d|) of the power,
    d the angle between pin radius and slot, on a follower's way back too.

    Parameters
    ----------
    pin_radius : float
        Distance r of the pin from its own axis, above 0, in the unit of the offset.
    offset : float
        Distance e of the two axes, 0 or more, and not r.
    friction : float
        Coefficient of friction f of the pin along the slot, 0 or more.

    Raises
    ------
    RangeError
        For distances out of range, and where the pin passes through the slot's axis.

    See Also
    --------
    geartrain.teeth.SlotToPinTransmission : the slot driving.

    Examples
    --------
    The lunar pin of the Antikythera mechanism, 9.6 mm from an axis 1.1 mm away (Freeth 2006):

    >>> from math import degrees
    >>> transmission = PinToSlotTransmission(9.6, 1.1)
    >>> transmission.ratio, round(degrees(transmission.amplitude), 3)
    (Fraction(1, 1), 6.58)
    >>> [round(speed, 4) for speed in transmission.speed_range()]
    [0.8972, 1.1294]
    """

    driver = "pin"

    def __init__(self, pin_radius: float, offset: float, friction: float = 0.0) -> None:
        super().__init__(pin_radius, offset, friction)
        self.ratio = Fraction(1 if pin_radius > offset else 0)

    def error(self, S: ArrayLike) -> Floats:
        """Slot angle less its mean motion.

        Returns
        -------
        ndarray
            Of that shape [rad of the slot].
        """
        S = np.asarray(S, dtype=float)
        less, more = min(self.r, self.e), max(self.r, self.e)
        # more - less cos S, as a sum: near r = e the difference would cancel
        along = (more - less) + 2 * less * np.sin(S / 2) ** 2
        error = np.asarray(np.arctan2(less * np.sin(S), along))
        return error if self.r > self.e else -error

    def speed(self, S: ArrayLike) -> Floats:
        """Speed ratio r (r - e cos S)/(r^2 + e^2 - 2 r e cos S)."""
        along, square = self._reach(S)
        return np.asarray(self.r * along / square)

    def _reach(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """r - e cos S, and the square of the pin's distance from the slot's axis, as a sum of squares."""
        half = np.sin(np.asarray(S, dtype=float) / 2)
        along = (self.r - self.e) + 2 * self.e * half**2
        return along, (self.r - self.e) ** 2 + 4 * self.r * self.e * half**2

    def speed_range(self) -> tuple[float, float]:
        """1/(1 + e/r) where the pin is farthest from the slot's axis, 1/(1 - e/r) where it is nearest."""
        far, near = self.r / (self.r + self.e), self.r / (self.r - self.e)
        return min(far, near), max(far, near)

    def efficiency(self, S: ArrayLike) -> Floats:
        """Power out over power in: cos d/(cos d + f sin d), by magnitude.

        Returns
        -------
        ndarray
            Of that shape; 0 at a follower's dead points if there is friction.
        """
        along, _ = self._reach(S)
        across = self.friction * np.abs(self.e * np.sin(np.asarray(S, dtype=float)))
        along = np.abs(along)
        whole = along + across
        return np.asarray(np.divide(along, whole, out=np.ones_like(whole), where=whole > 0))

    def efficiency_mean(self) -> float:
        """Mean over a turn of the pin, at constant torque on it."""
        if self.r > self.e:
            return mean_over_the_pin(self.r, self.e, self.friction)
        return float(np.mean(self.efficiency(self._turn())))

    def efficiency_at_constant_load(self) -> float:
        """1/(1 + (f/pi) ln((r + e)/(r - e))) for a constant torque on the slot; NaN for a follower.

        Without friction a constant torque on a follower gives back on one half of its swing what it took on the other.
        """
        return 1 / (1 + self.friction * log_share(self.r, self.e)) if self.r > self.e else nan

    def efficiency_minimum(self) -> float:
        """Where d is greatest, sin d = e/r; 0 at a follower's dead points if there is friction."""
        if self.r < self.e:
            return 0.0 if self.friction else 1.0
        return 1 / (1 + self.friction * self._steepest)


class SlotToPinTransmission(PinTransmission):
    """A slot drives its pin: pin angle = S - asin((e/r) sin S). Only where the pin's circle encloses the slot's axis.

    Parameters
    ----------
    pin_radius : float
        Distance r of the pin from its own axis, above the offset and in its unit.
    offset : float
        Distance e of the two axes, 0 or more.
    friction : float
        Coefficient of friction f of the pin along the slot, 0 or more; it locks from sqrt(r^2 - e^2)/e on.

    Raises
    ------
    RangeError
        For distances out of range, and for a follower, which cannot drive its pin.

    See Also
    --------
    geartrain.teeth.PinToSlotTransmission : the pin driving.

    Examples
    --------
    >>> transmission = SlotToPinTransmission(2, 1)
    >>> transmission.speed_range()
    (0.5, 1.5)
    """

    driver = "slot"
    ratio = Fraction(1)

    def __init__(self, pin_radius: float, offset: float, friction: float = 0.0) -> None:
        super().__init__(pin_radius, offset, friction)
        if pin_radius < offset:
            raise RangeError(
                Problem(
                    f"a follower cannot drive a pin of radius {pin_radius:g} at an offset of {offset:g}",
                    "it swings, and stands at its dead points while the pin goes on",
                    "let the pin drive",
                    "driver",
                )
            )

    def error(self, S: ArrayLike) -> Floats:
        """Pin angle less its mean motion.

        Returns
        -------
        ndarray
            Of that shape [rad of the pin].
        """
        across, along = self._sides(S)
        return np.asarray(-np.arctan2(across, along))

    def speed(self, S: ArrayLike) -> Floats:
        """Speed ratio 1 - e cos S/sqrt(r^2 - e^2 sin^2 S)."""
        _, along = self._sides(S)
        return np.asarray(1 - self.e * np.cos(np.asarray(S, dtype=float)) / along)

    def _sides(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """r sin d and r cos d, d the angle between pin radius and slot, sin d = (e/r) sin S."""
        S = np.asarray(S, dtype=float)
        # sqrt(r^2 - e^2 sin^2 S), as a sum: near r = e the difference would cancel
        along = np.sqrt((self.r - self.e) * (self.r + self.e) + (self.e * np.cos(S)) ** 2)
        return self.e * np.sin(S), along

    def speed_range(self) -> tuple[float, float]:
        """1 - e/r and 1 + e/r."""
        return 1 - self.e / self.r, 1 + self.e / self.r

    def efficiency(self, S: ArrayLike) -> Floats:
        """Power out over power in: 1 - f |tan d|, d the angle between pin radius and slot.

        Returns
        -------
        ndarray
            Of that shape; 0 where friction locks.
        """
        across, along = self._sides(S)
        return np.asarray(np.maximum(1 - self.friction * np.abs(across) / along, 0.0))

    def efficiency_mean(self) -> float:
        """1 - (f/pi) ln((r + e)/(r - e)), over a turn of the slot at constant torque on it; NaN where it locks."""
        return nan if self._locks else 1 - self.friction * log_share(self.r, self.e)

    def efficiency_at_constant_load(self) -> float:
        """Work done on a constant torque on the pin over the work put in; NaN where friction locks."""
        return nan if self._locks else 1 / mean_over_the_pin(self.r, self.e, -self.friction)

    def efficiency_minimum(self) -> float:
        """Where d is greatest, sin d = e/r; NaN where friction locks."""
        return nan if self._locks else 1 - self.friction * self._steepest

    @property
    def _locks(self) -> bool:
        return self.friction >= self.locking_friction

    @property
    def locking_friction(self) -> float:
        """The friction at which the pin locks somewhere: sqrt(r^2 - e^2)/e."""
        return 1 / self._steepest if self.e else inf
