"""Transmission functions of a pin in a slot. The pin radius r is the distance of the pin from its own axis, and e is
the distance between the axes of pin and slot.

The driver's angle S is measured from the direction that points from the pin's axis to the slot's axis.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, nan, sqrt
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.couplings.series_transmission import SeriesTransmission
from geartrain.teeth.transmission import check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_MINIMUM = 1e-40  # in any unit: the fourth power of a distance neither underflows nor overflows


class PinTransmission(SeriesTransmission):
    """Transmission function of a coupling by pin and slot, in which either side can drive.

    If the pin drives, the function is a `SeriesTransmission` with rho = min(r, e) / max(r, e). If the slot drives, it
    is the inverse function, which has the same maximum and the same rms of the transmission error.

    `friction` is the coefficient of friction of the pin along the slot.
    """

    PAGE = "report.pair_page:describe_pin"

    driver: ClassVar[Literal["pin", "slot"]]
    """Name of the driving side, "pin" or "slot"."""

    def __init__(self, pin_radius: float, offset: float, friction: float = 0.0) -> None:
        self.r, self.e = pin_radius, offset
        if not (_MINIMUM < pin_radius < 1 / _MINIMUM and (offset == 0 or _MINIMUM < offset < 1 / _MINIMUM)):
            what = f"a pin radius of {pin_radius:g} and an offset of {offset:g} are out of range"
            why = f"both must be between {_MINIMUM:g} and {1 / _MINIMUM:g}, except that the offset may be 0"
            fix = "give an offset of 0 or more and a pin radius above 0, both within these limits"
            raise RangeError(Problem(what, why, fix))
        if pin_radius == offset:
            what = f"a pin radius of {pin_radius:g} equals the offset: the pin would pass through the slot's axis"
            ratios = "the mean ratio is 1 for a larger radius and 0 for a smaller one"
            why = f"the slot's direction is undetermined there; {ratios}"
            raise RangeError(Problem(what, why, "give a larger or a smaller pin radius"))
        self.friction = check_friction(friction)
        less, more = min(pin_radius, offset), max(pin_radius, offset)
        ratio, factor = (Fraction(1), 1.0) if pin_radius > offset else (Fraction(0), -1.0)
        super().__init__(ratio, factor, 1, less / more, (more - less) / more)

    @property
    def _maximum_tangent(self) -> float:
        """Maximum of tan d over a turn, e/sqrt(r^2 - e^2), for a pin whose circle encloses the slot's axis. Here d is
        the angle between pin radius and slot, r is the pin radius, and e is the axis offset.
        """
        return self.e / sqrt((self.r - self.e) * (self.r + self.e))


class PinToSlotTransmission(PinTransmission):
    """Transmission function of a pin that drives a slot.

    At the pin angle S, the slot angle is S + atan2(e sin S, r - e cos S) for r > e, and -atan2(r sin S, e - r cos S)
    for r < e. The mean ratio is 1 if the circle of the pin encloses the axis of the slot (r > e). Otherwise it is 0:
    the slot oscillates, and its angle is measured from the line from its axis to the axis of the pin. The efficiency is
    1/(1 + f |tan d|), where d is the angle between the pin radius and the slot; this also applies to the return stroke.

    Parameters
    ----------
    pin_radius : float
        Distance r of the pin from its own axis, above 0, in the unit of the offset.
    offset : float
        Distance e between the two axes, 0 or more and different from r.
    friction : float
        Coefficient of friction f of the pin along the slot, 0 or more.

    Raises
    ------
    RangeError
        If a distance is out of range, or if the pin passes through the slot's axis.

    See Also
    --------
    geartrain.teeth.SlotToPinTransmission : the same coupling, driven by the slot.

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

    def _reach(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return r - e cos S, and the square of the pin's distance from the slot's axis, with pin radius r and axis
        offset e.
        """
        # half angles avoid the cancellation of both differences near r = e and S = 0
        half = np.sin(np.asarray(S, dtype=float) / 2)
        along = (self.r - self.e) + 2 * self.e * half**2
        return along, (self.r - self.e) ** 2 + 4 * self.r * self.e * half**2

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad]; 0 at the dead points of an oscillating slot with friction.

        It is |cos d|/(|cos d| + f |sin d|), with friction coefficient f and the angle d between pin radius and slot.
        """
        along, _ = self._reach(S)
        across = self.friction * np.abs(self.e * np.sin(np.asarray(S, dtype=float)))
        along = np.abs(along)
        whole = along + across  # 0 only at a dead point without friction, where the efficiency is 1
        return np.asarray(np.divide(along, whole, out=np.ones_like(whole), where=whole > 0))

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency over a turn.

        It occurs at the maximum of the angle d between pin radius and slot, sin d = e/r, with axis offset e and pin
        radius r. If the slot oscillates, the minimum is 0 with friction, because of the dead points, and 1 without
        friction.
        """
        if self.r < self.e:
            return 0.0 if self.friction else 1.0
        return 1 / (1 + self.friction * self._maximum_tangent)


class SlotToPinTransmission(PinTransmission):
    """Transmission function of a slot that drives its pin: the pin angle is S - asin((e/r) sin S), with slot angle S,
    axis offset e and pin radius r.

    The pin's circle must enclose the slot's axis.

    Parameters
    ----------
    pin_radius : float
        Distance r of the pin from its own axis, larger than the offset and in the same unit.
    offset : float
        Distance e between the two axes, 0 or more.
    friction : float
        Coefficient of friction f of the pin along the slot, 0 or more. The pin locks if f is sqrt(r^2 - e^2)/e or more.

    Raises
    ------
    RangeError
        If a distance is out of range, or if the pin's circle does not enclose the slot's axis.

    See Also
    --------
    geartrain.teeth.PinToSlotTransmission : the same coupling, driven by the pin.

    Examples
    --------
    >>> transmission = SlotToPinTransmission(2, 1)
    >>> transmission.speed_range()
    (0.5, 1.5)
    """

    driver = "slot"

    def __init__(self, pin_radius: float, offset: float, friction: float = 0.0) -> None:
        super().__init__(pin_radius, offset, friction)
        if pin_radius < offset:
            what = f"an oscillating slot cannot drive a pin at radius {pin_radius:g} with an offset of {offset:g}"
            why = "its pin radius is below the offset, so the slot is at rest at its dead points while the pin moves"
            raise RangeError(Problem(what, why, "let the pin drive", "driver"))

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the pin]: pin angle minus mean motion."""
        across, along = self._sides(S)
        return np.asarray(-np.arctan2(across, along))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio 1 - e cos S/sqrt(r^2 - e^2 sin^2 S) for axis offset e, pin radius r, slot angle S."""
        _, along = self._sides(S)
        return np.asarray(1 - self.e * np.cos(np.asarray(S, dtype=float)) / along)

    def _sides(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return r sin d and r cos d at driver angles S [rad], where r is the pin radius and d the angle between pin
        radius and slot: sin d = (e/r) sin S, with axis offset e.
        """
        S = np.asarray(S, dtype=float)
        # sqrt(r^2 - e^2 sin^2 S) as a sum, which does not cancel near r = e
        along = np.sqrt((self.r - self.e) * (self.r + self.e) + (self.e * np.cos(S)) ** 2)
        return self.e * np.sin(S), along

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and maximum speed ratio, 1 - e/r and 1 + e/r, with axis offset e and pin radius r."""
        return 1 - self.e / self.r, 1 + self.e / self.r

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad], at 90 deg from the line of centres."""
        return self._maximum_tangent

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad]; 0 where friction locks the pin.

        It is 1 - f |tan d|, with friction coefficient f and the angle d between pin radius and slot.
        """
        across, along = self._sides(S)
        return np.asarray(np.maximum(1 - self.friction * np.abs(across) / along, 0.0))

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency over a turn; NaN if friction locks the pin.

        It occurs at the maximum of the angle d between pin radius and slot, sin d = e/r, with axis offset e and pin
        radius r.
        """
        return nan if self.locks else 1 - self.friction * self._maximum_tangent

    @property
    def locking_friction(self) -> float:
        """Minimum friction coefficient at which the pin locks, sqrt(r^2 - e^2)/e, with pin radius r, axis offset e."""
        return 1 / self._maximum_tangent if self.e else inf
