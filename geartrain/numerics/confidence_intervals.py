"""Confidence intervals (95 %) of probabilities, means, standard deviations and percentiles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import ceil, degrees, exp, floor, inf, nan, sqrt
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


CONFIDENCE = 0.95
DEVIATIONS = NormalDist().inv_cdf((1 + CONFIDENCE) / 2)
"""Number of standard deviations within which a normal variable is with probability 95 %."""
PERCENTILES = (2.5, 25.0, 50.0, 75.0, 97.5)  # 95 % range, quartiles and median


@dataclass(frozen=True, slots=True)
class ProbabilityEstimate(Result):
    """Probability estimated from independent trials, with its 95 % Wilson score interval.

    Examples
    --------
    For 0 successes in 256 trials, the upper end of the interval is z^2 / (256 + z^2) with z = 1.96:

    >>> never = ProbabilityEstimate(0, 256)
    >>> never.value, [round(end, 5) for end in never.interval]
    (0.0, [0.0, 0.01478])
    """

    KEYS = ("count", "of", Key("share", "value", finite), "interval")

    count: int
    """Number of trials in which the event occurred."""
    of: int
    """Total number of trials."""

    @property
    def value(self) -> float:
        """Relative frequency of the event; NaN without trials."""
        return self.count / self.of if self.of else nan

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson score interval, which is also valid for frequencies of 0 and 1."""
        return wilson(self.count, self.of)


def wilson(count: float, of: float) -> tuple[float, float]:
    """Return the 95 % Wilson score interval of a probability for `count` successes in `of` trials; (0, 1) for 0 trials.

    For weighted trials, `count` and `of` are effective numbers, which need not be integers.
    """
    if not of:
        return 0.0, 1.0
    z = DEVIATIONS
    # E. B. Wilson, J. Am. Stat. Assoc. 22 (1927): the p with |p' - p| <= z sqrt(p (1 - p) / n)
    p, square = count / of, z * z / of
    middle, half = p + square / 2, z * sqrt(max(p * (1 - p), 0.0) / of + square / (4 * of))
    low, high = (middle - half) / (1 + square), (middle + half) / (1 + square)
    # for 0 or all successes the ends are exactly 0 and 1, without rounding
    return (max(0.0, low) if count else 0.0), (min(1.0, high) if count < of else 1.0)


@dataclass(frozen=True, slots=True)
class IntervalEstimate:
    """Estimate of a quantity, with a 95 % confidence interval.

    Examples
    --------
    >>> IntervalEstimate(1.0, 0.5, float("inf")).to_dict()
    [1.0, 0.5, None]
    """

    value: float
    """Estimated value, in the unit of the quantity."""
    low: float
    """Lower end of the confidence interval, in the same unit; -inf if there are too few trials."""
    high: float
    """Upper end of the confidence interval, in the same unit; inf if there are too few trials."""

    def to_dict(self) -> list[float | None]:
        """Return [value, low, high] for JSON, with null for infinite or undetermined numbers."""
        return [finite(each) for each in (self.value, self.low, self.high)]


def in_degrees(figure: IntervalEstimate) -> list[float | None]:
    """Return [value, low, high] in degrees for an estimated angle [rad], with null for numbers that are not finite."""
    return [finite(degrees(each)) for each in (figure.value, figure.low, figure.high)]


def mean_of(values: Floats) -> IntervalEstimate:
    """Return the mean of some values with its 95 % confidence interval, by the normal approximation."""
    n = len(values)
    if n < 2:
        return IntervalEstimate(float(values[0]) if n else nan, -inf, inf)
    mean, half = float(values.mean()), DEVIATIONS * float(values.std(ddof=1)) / sqrt(n)
    return IntervalEstimate(mean, mean - half, mean + half)


def deviation_of(values: Floats) -> IntervalEstimate:
    """Return the standard deviation of n values with Bonett's 95 % interval, which is also valid for non-normal
    distributions.

    D. G. Bonett, Approximate confidence interval for standard deviation of nonnormal distributions, Comput. Stat. Data
    Anal. 50 (2006) 775-782: ln(c s^2) +- z c sqrt((g - (n - 3)/n) / (n - 1)), where s is the standard deviation, g the
    kurtosis about a trimmed mean, z = 1.96 and c = n / (n - z).
    """
    n, z = len(values), DEVIATIONS
    if n < 5:
        return IntervalEstimate(float(values.std(ddof=1)) if n > 1 else nan, 0.0, inf)
    off = values - values.mean()
    squares = float(off @ off)
    if not squares or not np.ptp(values):  # the mean of equal values may be off due to rounding
        return IntervalEstimate(0.0, 0.0, 0.0)
    # Bonett trims the fraction 1 / (2 sqrt(n - 4)) at each end
    trimmed = int(n / (2 * sqrt(n - 4)))
    about = values - np.sort(values)[trimmed : n - trimmed].mean()
    kurtosis, c = n * float(np.sum(about**4)) / squares**2, n / (n - z)
    # half-width for the logarithm of the standard deviation; rounding of nearly equal values may make the root negative
    half = z * c * sqrt(max(0.0, kurtosis - (n - 3) / n) / (n - 1)) / 2
    value = sqrt(squares / (n - 1))
    return IntervalEstimate(value, value * sqrt(c) * exp(-half), value * sqrt(c) * exp(half))


def percentile_of(ordered: Floats, percent: float) -> IntervalEstimate:
    """Return a percentile of sorted values, with a distribution-free 95 % interval between order statistics."""
    n, p = len(ordered), percent / 100
    if not n:
        return IntervalEstimate(nan, -inf, inf)
    low, high = _counts_below(n, p)
    ends = (float(ordered[low - 1]) if low else -inf, float(ordered[high]) if high < n else inf)
    return IntervalEstimate(float(np.quantile(ordered, p)), *ends)


@cache
def _counts_below(n: int, p: float) -> tuple[int, int]:
    """Return the shortest range that contains a binomial number with a probability of 95 % (n trials, probability p).

    The number of n values below their quantile is binomial (David and Nagaraja, Order Statistics, 3rd ed., 2003, 7.1).
    """
    from scipy.special import bdtr

    reach = ceil(7 * sqrt(n * p * (1 - p))) + 12  # the probability beyond is below 1e-9
    counts = np.arange(max(floor(n * p) - reach, 0), min(ceil(n * p) + reach, n) + 1)
    up_to = bdtr(counts, n, p)
    less = np.concatenate([[bdtr(counts[0] - 1, n, p) if counts[0] else 0.0], up_to[:-1]])
    high = np.searchsorted(up_to, less + CONFIDENCE)
    found = np.flatnonzero(high < len(counts))
    low, high = counts[found], counts[high[found]]
    probability = up_to[high - counts[0]] - less[found]
    # the last key has priority: closed intervals (0 and n leave an end open), then short ones, then the most probable
    best = np.lexsort((-probability, high - low, (low == 0) | (high == n)))[0]
    return int(low[best]), int(high[best])


def percentiles_of(values: Floats) -> dict[float, IntervalEstimate]:
    """Return the percentiles in `PERCENTILES` of some values, with confidence intervals, keyed by percentage."""
    ordered = np.sort(values)
    return {percent: percentile_of(ordered, percent) for percent in PERCENTILES}
