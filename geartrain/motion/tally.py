"""Peaks and moments of an output, gathered stretch by stretch."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import inf, sqrt
from typing import TYPE_CHECKING, Any

from geartrain.errors import Problem, RangeError
from geartrain.exact import as_float, log10, written

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def mean_speed(name: str, ratio: Fraction) -> float:
    """An exact mean speed as a float, or a `RangeError` where there is none."""
    found = as_float(ratio)
    if found is None:
        what = f"the mean speed of '{name}' is 10^{log10(ratio):.0f} times the input's"
        why = "motion is followed in float64, which holds 1e-308 to 1e308"
        raise RangeError(Problem(what, why, "drive the train nearer to this output, or ask `solve`"))
    return found


@dataclass
class Tally:
    """Error (rad) and speed of one output over all positions seen so far.

    ratio                exact mean speed over the input's
    centre, square       mean of the error, and the sum of its squared differences from it
    least, most          error; `slow`, `fast`, speed less its mean
    """

    name: str
    ratio: Fraction
    count: int = 0
    centre: float = 0.0
    square: float = 0.0
    least: float = inf
    most: float = -inf
    slow: float = inf
    fast: float = -inf

    def add(self, error: Floats, rate: Floats) -> None:
        """Count some more positions: errors, and speeds less their mean."""
        new = len(error)
        centre = float(error.mean())
        gap = centre - self.centre
        total = self.count + new
        self.square += float(((error - centre) ** 2).sum()) + gap**2 * self.count * new / total
        self.centre += gap * new / total
        self.count = total
        self.reach(error, rate)

    def reach(self, error: Floats, rate: Floats) -> None:
        """Let extremes count, and nothing else."""
        self.least, self.most = min(self.least, float(error.min())), max(self.most, float(error.max()))
        self.slow, self.fast = min(self.slow, float(rate.min())), max(self.fast, float(rate.max()))

    @property
    def mean(self) -> float:
        """Mean speed over the input's."""
        return mean_speed(self.name, self.ratio)

    @property
    def peak_to_peak(self) -> float:
        """Greatest less least error (rad)."""
        return self.most - self.least

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean (rad)."""
        return sqrt(self.square / self.count)

    @property
    def speeds(self) -> tuple[float, float]:
        """Least and greatest speed over the mean, or over the input's where the mean is 0."""
        scale = self.mean or 1.0
        low, high = sorted(((self.mean + self.slow) / scale, (self.mean + self.fast) / scale))
        return low, high

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        low, high = self.speeds
        return {
            "transmission_error": {"peak_to_peak": self.peak_to_peak, "rms": self.rms},
            "speed": {"min": low, "max": high, "mean": self.mean},
            "ratio": written(self.ratio),
        }
