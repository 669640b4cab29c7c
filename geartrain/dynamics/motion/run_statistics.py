"""Peaks and moments of an output's error and speed, accumulated over chunks of positions.

Moments of chunks are combined with the update of Chan, Golub and LeVeque (1983). Transmission errors have sharp peaks
that are missed by sampling, so extremes are searched separately (docs/motion.md, section 5).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import inf, pi, sqrt
from typing import TYPE_CHECKING, Literal, NamedTuple

from geartrain.errors import Problem, RangeError
from geartrain.numerics.exact import as_float, log10
from geartrain.numerics.results import Key, Result, group

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


def mean_speed(name: str, ratio: Fraction) -> float:
    """Return an exact mean speed as a float. Raise `RangeError` if it is beyond the range of float64."""
    found = as_float(ratio)
    if found is None:
        what = f"the mean speed of '{name}' is 10^{log10(ratio):.0f} times the speed of the input"
        why = "motion is computed in float64, which has a range of 1e-308 to 1e308"
        raise RangeError(Problem(what, why, "choose an input nearer to this output, or use `solve`"))
    return found


class SpeedSpan(NamedTuple):
    """Minimum and maximum speed of an output divided by its mean speed, and its mean speed divided by the speed of the
    input.

    If the mean speed is 0, minimum and maximum are divided by the speed of the input.
    """

    min: float
    """Minimum speed divided by the mean speed, or by the speed of the input if the mean speed is 0 [1]."""
    max: float
    """Maximum speed divided by the mean speed, or by the speed of the input if the mean speed is 0 [1]."""
    mean: float
    """Mean speed divided by the speed of the input [1]."""


@dataclass
class RunningStatistics(Result):
    """Extremes, mean and root mean square of the error of one output, and extremes of its speed, updated whenever
    positions are added (algorithms of Welford and of Chan et al.).

    See Also
    --------
    MotionRun.statistics : statistics of all outputs
    """

    KEYS = (
        group("transmission_error", "peak_to_peak", "rms"),
        Key("speed", "speed_span"),
        *("ratio", "searched", "unit"),
    )

    name: str
    """Name of the output."""
    ratio: Fraction
    """Exact mean speed of the output divided by the speed of the input [1]."""
    count: int = 0
    """Number of positions evaluated so far."""
    centre: float = 0.0
    """Mean deviation of the output from its mean motion [`unit`]."""
    square: float = 0.0
    """Sum of the squared differences between the deviation of the output and its mean deviation [`unit`^2]."""
    minimum: float = inf
    """Minimum deviation of the output from its mean motion [`unit`]."""
    most: float = -inf
    """Maximum deviation of the output from its mean motion [`unit`]."""
    slow: float = inf
    """Minimum speed of the output minus its mean speed, divided by the input speed [1]."""
    fast: float = -inf
    """Maximum speed of the output minus its mean speed, divided by the input speed [1]."""
    searched: bool = False
    """True if `minimum`, `most`, `slow` and `fast` are the extremes over the whole run; False if they are the extremes
    at the evaluated positions.
    """
    slides: bool = False
    """True for a link that slides, whose deviations are in mm."""

    def add(self, error: Floats, rate: Floats) -> None:
        """Include the errors and speeds at further positions in the extremes, mean and root mean square.

        Parameters
        ----------
        error : array of float, (n,)
            Errors at these positions [`unit`].
        rate : array of float, (n,)
            Speeds minus the mean speed, divided by the input speed [1].
        """
        new = len(error)
        centre = float(error.mean())
        # deviations from each chunk's own mean: a plain sum of squares would cancel for a small error on a large lag
        gap = centre - self.centre
        total = self.count + new
        self.square += float(((error - centre) ** 2).sum()) + gap**2 * self.count * new / total
        self.centre += gap * new / total
        self.count = total
        self.minimum, self.most = min(self.minimum, float(error.min())), max(self.most, float(error.max()))
        self.slow, self.fast = min(self.slow, float(rate.min())), max(self.fast, float(rate.max()))

    @property
    def mean(self) -> float:
        """Mean speed of the output divided by the speed of the input [1]."""
        return mean_speed(self.name, self.ratio)

    @property
    def unit(self) -> Literal["rad", "mm"]:
        """Unit of the deviations: rad, or mm for a link that slides."""
        return "mm" if self.slides else "rad"

    @property
    def degrees_or_mm(self) -> float:
        """Factor that converts deviations from `unit` to the printed unit: deg, or mm if the link slides."""
        return 1.0 if self.slides else 180 / pi

    @property
    def peak_to_peak(self) -> float:
        """Maximum minus minimum deviation of the output from its mean motion [`unit`]."""
        return self.most - self.minimum

    @property
    def rms(self) -> float:
        """Root mean square of the output's error about its mean [`unit`]."""
        return sqrt(self.square / self.count)

    @property
    def speed_span(self) -> SpeedSpan:
        """Minimum, maximum and mean speed of the output divided by the input speed [1]."""
        return SpeedSpan(*self.speeds, self.mean)

    @property
    def speeds(self) -> tuple[float, float]:
        """Minimum and maximum speed divided by the mean speed, or by the input speed if the mean speed is 0 [1]."""
        scale = self.mean or 1.0
        # a negative mean exchanges minimum and maximum
        low, high = sorted(((self.mean + self.slow) / scale, (self.mean + self.fast) / scale))
        return low, high
