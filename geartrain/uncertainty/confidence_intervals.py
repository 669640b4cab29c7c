"""How sure an estimate is: shares, means, deviations and percentiles with their 95 % intervals."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, degrees, floor, inf, nan, sqrt
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.plain_data import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


CONFIDENCE = 0.95
PERCENTILES = (2.5, 25.0, 50.0, 75.0, 97.5)


def deviations(confidence: float = CONFIDENCE) -> float:
    """Standard deviations of a normal variable within which it lies with this probability, both ways."""
    return NormalDist().inv_cdf((1 + confidence) / 2)


@dataclass(frozen=True, slots=True)
class ProbabilityEstimate(Result):
    """A probability estimated from independent trials, with Wilson's 95 % interval.

    Attributes
    ----------
    count, of : int
        In so many of so many trials it happened.

    Examples
    --------
    Of none in 256 trials the upper end is z^2 / (256 + z^2), z = 1.96.

    >>> never = ProbabilityEstimate(0, 256)
    >>> never.value, [round(end, 5) for end in never.interval]
    (0.0, [0.0, 0.01478])
    """

    KEYS = ("count", "of", Key("share", "value", finite), "interval")

    count: int
    of: int

    @property
    def value(self) -> float:
        """The share itself; NaN of none."""
        return self.count / self.of if self.of else nan

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval: it holds at shares of 0 and 1 too."""
        return wilson(self.count, self.of)


def wilson(count: float, of: float, z: float | None = None) -> tuple[float, float]:
    """Wilson's score interval of `count` of `of`, `z` standard deviations wide (E. B. Wilson 1927); 0 to 1 of none.

    Of weighted trials both are effective numbers, not whole ones.
    """
    if not of:
        return 0.0, 1.0
    z = deviations() if z is None else z
    # E. B. Wilson, J. Am. Stat. Assoc. 22 (1927): the p with |p' - p| <= z sqrt(p (1 - p) / n)
    p, square = count / of, z * z / of
    middle, half = p + square / 2, z * sqrt(max(p * (1 - p), 0.0) / of + square / (4 * of))
    low, high = (middle - half) / (1 + square), (middle + half) / (1 + square)
    # the ends of none and of all are 0 and 1 exactly, not to rounding
    return (max(0.0, low) if count else 0.0), (min(1.0, high) if count < of else 1.0)


@dataclass(frozen=True, slots=True)
class IntervalEstimate:
    """An estimate and its 95 % interval.

    Attributes
    ----------
    value, low, high : float
        In the unit of what is estimated; the ends are infinite where there are too few trials to say.

    Examples
    --------
    >>> IntervalEstimate(1.0, 0.5, float("inf")).to_dict()
    [1.0, 0.5, None]
    """

    value: float
    low: float
    high: float

    def to_dict(self) -> list[float | None]:
        """Plain data for JSON: value, low, high; null where there is none."""
        return [finite(each) for each in (self.value, self.low, self.high)]


def in_degrees(figure: IntervalEstimate) -> list[float | None]:
    """An angle (rad) as JSON has it, in degrees: value, low, high."""
    return [finite(degrees(each)) for each in (figure.value, figure.low, figure.high)]


def mean_of(values: Floats) -> IntervalEstimate:
    """Mean with its normal interval."""
    n = len(values)
    if n < 2:
        return IntervalEstimate(float(values[0]) if n else nan, -inf, inf)
    mean, half = float(values.mean()), deviations() * float(values.std(ddof=1)) / sqrt(n)
    return IntervalEstimate(mean, mean - half, mean + half)


def deviation_of(values: Floats) -> IntervalEstimate:
    """Standard deviation, its interval from the fourth moment: right for distributions that are not normal.

    Var(s^2) = (mu_4 - sigma^4) / n to first order; the chi-square interval would hold for normal values only.
    """
    n = len(values)
    if n < 3:
        return IntervalEstimate(nan, 0.0, inf)
    off = values - values.mean()
    variance = float(off @ off) / (n - 1)
    if not variance:
        return IntervalEstimate(0.0, 0.0, 0.0)
    # the variance has n - 1 below: in small samples the difference may fall below 0
    spread = sqrt(max(float(np.mean(off**4)) - variance**2, 0.0) / n)
    low, high = (max(variance + sign * deviations() * spread, 0.0) for sign in (-1, 1))
    return IntervalEstimate(sqrt(variance), sqrt(low), sqrt(high))


def percentile_of(ordered: Floats, percent: float) -> IntervalEstimate:
    """Percentile of values in order; its interval is between two order statistics, whatever their distribution.

    How many of n values lie below the percentile is binomial, here by its normal limit.
    """
    n, p = len(ordered), percent / 100
    if not n:
        return IntervalEstimate(nan, -inf, inf)
    half = deviations() * sqrt(n * p * (1 - p))
    # places from 0, rounded outwards: whole places must not make the interval narrower
    low, high = floor(n * p - half) - 1, ceil(n * p + half)
    ends = (float(ordered[low]) if low >= 0 else -inf, float(ordered[high]) if high < n else inf)
    return IntervalEstimate(float(np.quantile(ordered, p)), *ends)


def percentiles_of(values: Floats) -> dict[float, IntervalEstimate]:
    """The percentiles that are told."""
    ordered = np.sort(values)
    return {percent: percentile_of(ordered, percent) for percent in PERCENTILES}
