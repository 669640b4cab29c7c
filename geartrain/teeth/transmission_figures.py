"""What a transmission function says of itself over a period, in figures: speed ratio, transmission error, efficiency.

Each figure has its keys here and nowhere else, whoever tells it: a train's report, a page on one pair, a pin.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import degrees
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True, slots=True)
class SpeedRatio(Result):
    """Speed ratio of a pair, driven over driver, without sign.

    mean             exact
    least, greatest  at single angles
    """

    KEYS = (Key("mean", to=float), Key("exact", "mean"), Key("min", "least"), Key("max", "greatest"))

    mean: Fraction
    least: float
    greatest: float

    @classmethod
    def of(cls, law: TransmissionFunction) -> SpeedRatio:
        """Of a transmission function."""
        return cls(law.ratio, *law.speed_range())

    @property
    def relative(self) -> tuple[float, float]:
        """Least and greatest over the mean."""
        return self.least / float(self.mean), self.greatest / float(self.mean)


@dataclass(frozen=True, slots=True)
class TransmissionError(Result):
    """Transmission error of a pair (rad of the driven side), positive where that is ahead of uniform motion.

    peak_to_peak   greatest less least
    rms            about the mean
    mean           a lag, which depends on where angles are counted from
    """

    KEYS = ("peak_to_peak", "rms", "mean")

    peak_to_peak: float
    rms: float
    mean: float

    @classmethod
    def of(cls, law: TransmissionFunction) -> TransmissionError:
        """Of a transmission function."""
        low, high = law.error_range()
        mean, rms = law.error_moments()
        return cls(high - low, rms, mean)

    @property
    def text(self) -> str:
        """Peak to peak, in degrees."""
        return f"{degrees(self.peak_to_peak):.6g}"


@dataclass(frozen=True, slots=True)
class SlidingEfficiency(Result):
    """Power out over power in of a pair with friction, read off its transmission function when asked; None if it locks.

    Two means, for over a turn the torques of both sides cannot be constant at once.
    """

    KEYS = ("friction", "mean", "at_constant_load", Key("min", "least"), Key("locks_at", "locking_friction"))

    law: TransmissionFunction

    @property
    def friction(self) -> float:
        """Coefficient of friction."""
        return self.law.friction

    @property
    def locks(self) -> bool:
        """True if friction locks the pair somewhere."""
        return self.friction >= self.law.locking_friction

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
