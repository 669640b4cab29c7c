"""What a transmission function says of itself over a period, in figures: speed ratio, transmission error, efficiency.

Each figure has its keys here and nowhere else, whoever tells it: a train's report, a page on one pair, a pin.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING

from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True, slots=True)
class SpeedRatio(Result):
    """Speed ratio of a pair over a period: driven over driver, without sign.

    Attributes
    ----------
    mean : Fraction
        The ratio of tooth numbers, or the winding number of a pin.
    least, greatest : float
        At single angles.

    See Also
    --------
    geartrain.teeth.TransmissionFunction.speed : the ratio at each angle.

    Examples
    --------
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> SpeedRatio.of(PinToSlotTransmission(2, 1)).to_dict()
    {'mean': 1.0, 'exact': '1', 'min': 0.6666666666666666, 'max': 2.0}
    """

    KEYS = (Key("mean", to=float), Key("exact", "mean"), Key("min", "least"), Key("max", "greatest"))

    mean: Fraction
    least: float
    greatest: float

    @classmethod
    def of(cls, law: TransmissionFunction) -> SpeedRatio:
        """Of a transmission function.

        Parameters
        ----------
        law : TransmissionFunction
            Any.

        Returns
        -------
        SpeedRatio
            Over its period.
        """
        return cls(law.ratio, *law.speed_range())

    @property
    def relative(self) -> tuple[float, float]:
        """Least and greatest over the mean."""
        return self.least / float(self.mean), self.greatest / float(self.mean)


@dataclass(frozen=True, slots=True)
class TransmissionError(Result):
    """Transmission error of a pair over a period, positive where the driven side is ahead of uniform motion.

    Attributes
    ----------
    peak_to_peak : float
        Greatest less least [rad of the driven side].
    rms : float
        About the mean [rad].
    mean : float
        A lag that depends on where angles are counted from [rad].

    See Also
    --------
    geartrain.teeth.TransmissionFunction.error : the error at each angle.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.teeth import PinToSlotTransmission
    >>> error = TransmissionError.of(PinToSlotTransmission(2, 1))  # amplitude asin(1/2)
    >>> round(error.peak_to_peak / pi, 12), error.mean
    (0.333333333333, 0.0)
    """

    KEYS = ("peak_to_peak", "rms", "mean")

    peak_to_peak: float
    rms: float
    mean: float

    @classmethod
    def of(cls, law: TransmissionFunction) -> TransmissionError:
        """Of a transmission function.

        Parameters
        ----------
        law : TransmissionFunction
            Any.

        Returns
        -------
        TransmissionError
            Over its period.
        """
        low, high = law.error_range()
        mean, rms = law.error_moments()
        return cls(high - low, rms, mean)

    @property
    def text(self) -> str:
        """Peak to peak, in degrees."""
        return f"{degrees(self.peak_to_peak):.6g}"


@dataclass(frozen=True, slots=True)
class SlidingEfficiency(Result):
    """Power out over power in of a pair with friction, read off its transmission function when asked.

    Over a turn the torques of both sides cannot be constant at once: `mean` is at constant torque of the driver,
    `at_constant_load` at constant torque of the driven side. All are None where friction locks the pair.

    Attributes
    ----------
    law : TransmissionFunction
        Of the pair.

    See Also
    --------
    geartrain.teeth.GearMesh.efficiency : that of a pair of a train, either wheel driving.

    Examples
    --------
    A slot that drives its pin locks from sqrt(r^2 - e^2)/e on.

    >>> from geartrain.teeth import SlotToPinTransmission
    >>> efficiency = SlidingEfficiency(SlotToPinTransmission(5, 3, 0.1))
    >>> round(efficiency.locking_friction, 6), efficiency.locks, round(efficiency.least, 6)
    (1.333333, False, 0.925)
    """

    KEYS = ("friction", "mean", "at_constant_load", Key("min", "least"), Key("locks_at", "locking_friction"))

    law: TransmissionFunction

    @property
    def friction(self) -> float:
        """Coefficient of friction; its mean over the driver's angle where it depends on speed."""
        return self.law.friction

    @property
    def locks(self) -> bool:
        """True if friction locks the pair somewhere."""
        return self.law.locks

    @property
    def mean(self) -> float | None:
        """Mean efficiency over the driver's angle, at constant driver torque."""
        return None if self.locks else finite(self.law.efficiency_mean())

    @property
    def at_constant_load(self) -> float | None:
        """Work done on a constant torque of the driven side over the work put in; None where none is done."""
        return None if self.locks else finite(self.law.efficiency_at_constant_load())

    @property
    def least(self) -> float | None:
        """Least efficiency at any angle."""
        return None if self.locks else finite(self.law.efficiency_least())

    @property
    def locking_friction(self) -> float | None:
        """The least friction that locks; None where none does."""
        return finite(self.law.locking_friction)

    @property
    def text(self) -> str:
        """The mean, or that friction locks."""
        return "locks" if self.mean is None else f"{self.mean:.6f}"
