"""The transmission error of one output, position by position."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.dynamics.motion.run_statistics import RunningStatistics, mean_speed
from geartrain.numerics.plain_data import Key, Result

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class TransmissionErrorCurve(Result):
    """The transmission error of one output, position by position.

    Attributes
    ----------
    name : str
        The output.
    ratio : Fraction
        Exact mean speed over the input's.
    error : array of float, (n,)
        Angle less its mean motion [rad].
    speed : array of float, (n,)
        Speed over the input's.

    See Also
    --------
    Motion.ripples : what gives these.
    """

    KEYS = (Key("", "tally"),)

    name: str
    ratio: Fraction
    error: Floats
    speed: Floats

    @property
    def mean(self) -> float:
        """Mean speed over the input's."""
        return mean_speed(self.name, self.ratio)

    @cached_property
    def tally(self) -> RunningStatistics:
        """Peaks and moments."""
        tally = RunningStatistics(self.name, self.ratio)
        tally.add(self.error, self.speed - self.mean)
        return tally

    @property
    def peak_to_peak(self) -> float:
        """Greatest less least error (rad)."""
        return self.tally.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean (rad)."""
        return self.tally.rms
