"""Peaks and moments of an output, accumulated over chunks of positions, and its extremes between positions.

Moments of chunks are combined with the update of Chan, Golub and LeVeque (1983). Transmission errors have sharp
peaks that samples miss, so extremes are searched separately (docs/motion.md, section 5).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, isfinite, sqrt
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.exact import as_float, log10
from geartrain.numerics.results import Key, Result, group

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.dynamics.motion.extreme_search import ExtremeSearch
    from geartrain.numerics.arrays import Floats


def mean_speed(name: str, ratio: Fraction) -> float:
    """Return an exact mean speed as a float. Raise `RangeError` beyond the range of float64."""
    found = as_float(ratio)
    if found is None:
        what = f"the mean speed of '{name}' is 10^{log10(ratio):.0f} times the speed of the input"
        why = "motion is computed in float64, which has a range of 1e-308 to 1e308"
        raise RangeError(Problem(what, why, "choose an input nearer to this output, or use `solve`"))
    return found


class SpeedSpan(NamedTuple):
    """Minimum and maximum speed divided by the mean speed, and the mean speed divided by the speed of the input.

    If the mean is 0, minimum and maximum are relative to the speed of the input.
    """

    min: float
    """Minimum speed divided by the mean speed, or by the speed of the input if the mean is 0."""
    max: float
    """Maximum speed divided by the mean speed, or by the speed of the input if the mean is 0."""
    mean: float
    """Mean speed divided by the speed of the input."""


@dataclass
class RunningStatistics(Result):
    """Running peak values and moments of error and speed of one output (algorithm of Welford, Chan et al.).

    See Also
    --------
    MotionRun.statistics : statistics of all outputs
    """

    KEYS = (
        group("transmission_error", "peak_to_peak", "rms"),
        Key("speed", "speed_span"),
        "ratio",
        group("extremes_within", Key("error", "error_within"), Key("speed", "speed_within")),
    )

    name: str
    """Name of the output."""
    ratio: Fraction
    """Exact mean speed of the output divided by the speed of the input [1]."""
    count: int = 0
    """Number of positions evaluated so far."""
    centre: float = 0.0
    """Mean error of the output [rad]."""
    square: float = 0.0
    """Sum of squared deviations of the error from its mean [rad^2]."""
    minimum: float = inf
    """Minimum error of the output [rad]."""
    most: float = -inf
    """Maximum error of the output [rad]."""
    slow: float = inf
    """Minimum speed of the output minus its mean speed, divided by the input speed [1]."""
    fast: float = -inf
    """Maximum speed of the output minus its mean speed, divided by the input speed [1]."""
    error_within: float | None = 0.0
    """Upper bound on the difference between the true extremes of the error and `minimum`, `most` [rad].

    It is 0 if the run was searched completely, with a tolerance of 1e-9 of the range; None if no bound is known.
    """
    speed_within: float | None = 0.0
    """Upper bound on the difference between the true extremes of the speed and `slow`, `fast`, divided by the
    input speed [1]. It is 0 or None in the same cases as `error_within`.
    """

    def add(self, error: Floats, rate: Floats) -> None:
        """Add positions to the peak values and moments.

        Parameters
        ----------
        error : array of float, (n,)
            Errors at these positions [rad].
        rate : array of float, (n,)
            Speeds minus the mean speed, divided by the input speed.
        """
        new = len(error)
        centre = float(error.mean())
        # deviations from each stretch's own mean: a plain sum of squares would cancel for a small error on a large lag
        gap = centre - self.centre
        total = self.count + new
        self.square += float(((error - centre) ** 2).sum()) + gap**2 * self.count * new / total
        self.centre += gap * new / total
        self.count = total
        self.reach(error, rate)

    def reach(self, error: Floats, rate: Floats) -> None:
        """Include further values in the extremes without changing the moments.

        Parameters
        ----------
        error, rate : array of float, (n,)
            Errors [rad] and rates, as for `add`.
        """
        self.minimum, self.most = min(self.minimum, float(error.min())), max(self.most, float(error.max()))
        self.slow, self.fast = min(self.slow, float(rate.min())), max(self.fast, float(rate.max()))

    @property
    def mean(self) -> float:
        """Mean speed of the output divided by the speed of the input [1]."""
        return mean_speed(self.name, self.ratio)

    @property
    def peak_to_peak(self) -> float:
        """Maximum minus minimum error of the output [rad]."""
        return self.most - self.minimum

    @property
    def rms(self) -> float:
        """Root mean square of the output's error about its mean [rad]."""
        return sqrt(self.square / self.count)

    @property
    def speed_span(self) -> SpeedSpan:
        """Minimum and maximum speed as in `speeds`, together with the mean speed divided by the input speed."""
        return SpeedSpan(*self.speeds, self.mean)

    @property
    def speeds(self) -> tuple[float, float]:
        """Minimum and maximum speed divided by the mean speed, or by the input speed if the mean is 0."""
        scale = self.mean or 1.0
        # a negative mean exchanges minimum and maximum
        low, high = sorted(((self.mean + self.slow) / scale, (self.mean + self.fast) / scale))
        return low, high


_BIN = 1024  # positions per bin, each of which keeps its maximum
_KEPT = 10  # bins kept for each output and each extreme


class ErrorSampler(Protocol):
    """Protocol of objects that compute errors of outputs, for at most `chunk` positions at once."""

    @property
    def chunk(self) -> int:
        """Maximum number of positions evaluated at once."""

    def at(self, turns: Floats) -> ErrorSamples:
        """Return errors [rad] and rates [1] of the outputs at positions of the input [revolutions]."""


class SampledPeaks:
    """Extreme errors and speeds of each output among the sampled positions, and the positions where they occur.

    values, turns    maxima of `signed` errors and rates, in falling order, and their positions, shape (outputs, 4, n)
    """

    def __init__(self, outputs: int) -> None:
        self.values = np.full((outputs, 4, 0), -np.inf)
        self.turns = np.zeros((outputs, 4, 0))

    def add(self, passage: ErrorSamples) -> None:
        """Update the peaks with the errors at further positions."""
        # one peak per bin, so that the kept positions are not all at one broad peak
        bins = [_peaks(passage, slice(start, start + _BIN)) for start in range(0, len(passage.turns), _BIN)]
        values = np.concatenate([self.values, np.stack([value for value, _ in bins], axis=2)], axis=2)
        turns = np.concatenate([self.turns, np.stack([turns for _, turns in bins], axis=2)], axis=2)
        best = np.argsort(-values, axis=2)[:, :, :_KEPT]
        self.values = np.take_along_axis(values, best, axis=2)
        self.turns = np.take_along_axis(turns, best, axis=2)


def _peaks(passage: ErrorSamples, part: slice) -> tuple[Floats, Floats]:
    """Return the maxima of `signed` errors and rates in a slice of positions, and their positions, shape (outputs,
    4).
    """
    found, turns = [], []
    for each in (passage.error[:, part], passage.rate[:, part]):
        for sign, at in ((1, np.argmax(each, axis=1)), (-1, np.argmin(each, axis=1))):
            found.append(sign * each[np.arange(len(each)), at])
            turns.append(passage.turns[part][at])
    return np.stack(found, axis=1), np.stack(turns, axis=1)


def count_extremes(
    search: ExtremeSearch, turns: float, step: float, peaks: SampledPeaks, tallies: Sequence[RunningStatistics]
) -> None:
    """Include the extremes between sampled positions in the statistics, with bounds on their uncertainty.

    step, peaks    distance between the sampled positions [revolutions], and the sampled extremes; the search is limited
                   to their neighbourhood if the run is too long to be searched completely
    """
    low, high = sorted((0.0, turns))
    search.over(low, high)
    # the run is too long for a complete search: the neighbourhood of sampled peaks is searched
    if search.uncertainty.any():
        search.around(peaks.turns.reshape(len(tallies), -1), abs(step), low, high)
    for tally, (most, minimum, fast, slow), uncertainty in zip(
        tallies, search.values.tolist(), search.uncertainty, strict=True
    ):
        tally.reach(np.array([most, -minimum]), np.array([fast, -slow]))
        within = float(uncertainty[:2].max()), float(uncertainty[2:].max())
        tally.error_within, tally.speed_within = (each if isfinite(each) else None for each in within)
