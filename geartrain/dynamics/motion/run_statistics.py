"""Peaks and moments of an output, gathered stretch by stretch; its extremes, wherever they are.

Moments of stretches are joined by the update of Chan, Golub and LeVeque (1983). Errors of teeth have sharp peaks, which
a sample misses: extremes are sought by themselves (docs/motion.md, section 5).
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
    """An exact mean speed as a float, or a `RangeError` where there is none."""
    found = as_float(ratio)
    if found is None:
        what = f"the mean speed of '{name}' is 10^{log10(ratio):.0f} times the input's"
        why = "motion is followed in float64, which holds 1e-308 to 1e308"
        raise RangeError(Problem(what, why, "drive the train nearer to this output, or ask `solve`"))
    return found


class SpeedSpan(NamedTuple):
    """Least and greatest speed over the mean (over the input's where that is 0), and the mean over the input's."""

    min: float
    """Least speed over the mean; over the speed of the input where the mean is 0."""
    max: float
    """Greatest speed over the mean; over the speed of the input where the mean is 0."""
    mean: float
    """Mean speed over that of the input."""


@dataclass
class RunningStatistics(Result):
    """Peaks and moments of the error and speed of one output over all positions seen so far (Welford, Chan et al.).

    See Also
    --------
    MotionRun.statistics : where these stand.
    """

    KEYS = (
        group("transmission_error", "peak_to_peak", "rms"),
        Key("speed", "speed_span"),
        "ratio",
        group("extremes_within", Key("error", "error_within"), Key("speed", "speed_within")),
    )

    name: str
    """The output."""
    ratio: Fraction
    """Exact mean speed over the input's."""
    count: int = 0
    """Positions seen."""
    centre: float = 0.0
    """Mean of the error [rad]."""
    square: float = 0.0
    """Sum of the squared differences of the error from its mean [rad^2]."""
    minimum: float = inf
    """Least error [rad]."""
    most: float = -inf
    """Greatest error [rad]."""
    slow: float = inf
    """Least speed less its mean, over the speed of the input."""
    fast: float = -inf
    """Greatest speed less its mean, over the speed of the input."""
    error_within: float | None = 0.0
    """No error of the run [rad] lies farther than this beyond the extremes of the error; 0 where the run was searched
    to the end, which leaves a thousand millionth of the range, and None where no bound is known."""
    speed_within: float | None = 0.0
    """The same for the speed over that of the input."""

    def add(self, error: Floats, rate: Floats) -> None:
        """Count some more positions.

        Parameters
        ----------
        error : array of float, (n,)
            Errors [rad].
        rate : array of float, (n,)
            Speeds less their mean, over the input's.
        """
        new = len(error)
        centre = float(error.mean())
        # differences from each stretch's own mean: a sum of squares would lose a small error beside a large lag
        gap = centre - self.centre
        total = self.count + new
        self.square += float(((error - centre) ** 2).sum()) + gap**2 * self.count * new / total
        self.centre += gap * new / total
        self.count = total
        self.reach(error, rate)

    def reach(self, error: Floats, rate: Floats) -> None:
        """Let extremes count, and nothing else.

        Parameters
        ----------
        error, rate : array of float, (n,)
            As for `add`.
        """
        self.minimum, self.most = min(self.minimum, float(error.min())), max(self.most, float(error.max()))
        self.slow, self.fast = min(self.slow, float(rate.min())), max(self.fast, float(rate.max()))

    @property
    def mean(self) -> float:
        """Mean speed over the input's."""
        return mean_speed(self.name, self.ratio)

    @property
    def peak_to_peak(self) -> float:
        """Greatest less least error (rad)."""
        return self.most - self.minimum

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean (rad)."""
        return sqrt(self.square / self.count)

    @property
    def speed_span(self) -> SpeedSpan:
        """Least, greatest and mean speed."""
        return SpeedSpan(*self.speeds, self.mean)

    @property
    def speeds(self) -> tuple[float, float]:
        """Least and greatest speed over the mean, or over the input's where the mean is 0."""
        scale = self.mean or 1.0
        low, high = sorted(((self.mean + self.slow) / scale, (self.mean + self.fast) / scale))
        return low, high


_BIN = 1024  # positions of which the greatest is kept
_KEPT = 10  # of them, for each output and each extreme


class ErrorSampler(Protocol):
    """What errors of outputs can be asked of, at most a chunk of positions at once."""

    @property
    def chunk(self) -> int:
        """Positions worked on at once."""

    def at(self, turns: Floats) -> ErrorSamples:
        """Errors and rates where the input has made some turns."""


class SampledPeaks:
    """The greatest and least errors and speeds of each output among sampled positions, and the turns where they are.

    values, turns    (outputs, 4, n): of `signed` errors and rates, the greatest first
    """

    def __init__(self, outputs: int) -> None:
        self.values = np.full((outputs, 4, 0), -np.inf)
        self.turns = np.zeros((outputs, 4, 0))

    def add(self, passage: ErrorSamples) -> None:
        """Keep the best of some more positions."""
        bins = [_peaks(passage, slice(start, start + _BIN)) for start in range(0, len(passage.turns), _BIN)]
        values = np.concatenate([self.values, np.stack([value for value, _ in bins], axis=2)], axis=2)
        turns = np.concatenate([self.turns, np.stack([turns for _, turns in bins], axis=2)], axis=2)
        best = np.argsort(-values, axis=2)[:, :, :_KEPT]
        self.values = np.take_along_axis(values, best, axis=2)
        self.turns = np.take_along_axis(turns, best, axis=2)


def _peaks(passage: ErrorSamples, part: slice) -> tuple[Floats, Floats]:
    """The greatest of `signed` errors and rates in a part of a stretch, and the turns there, (outputs, 4)."""
    found, turns = [], []
    for each in (passage.error[:, part], passage.rate[:, part]):
        for sign, at in ((1, np.argmax(each, axis=1)), (-1, np.argmin(each, axis=1))):
            found.append(sign * each[np.arange(len(each)), at])
            turns.append(passage.turns[part][at])
    return np.stack(found, axis=1), np.stack(turns, axis=1)


def count_extremes(
    search: ExtremeSearch, turns: float, step: float, peaks: SampledPeaks, tallies: Sequence[RunningStatistics]
) -> None:
    """Let the extremes of a run count, wherever they are, and say what is left open.

    step, peaks    turns between the positions at which the run was sampled, and the extremes there: around them is
                   searched where the run is too long to be searched whole
    """
    low, high = sorted((0.0, turns))
    search.over(low, high)
    if search.doubt.any():
        search.around(peaks.turns.reshape(len(tallies), -1), abs(step), low, high)
    for tally, (most, minimum, fast, slow), doubt in zip(tallies, search.values.tolist(), search.doubt, strict=True):
        tally.reach(np.array([most, -minimum]), np.array([fast, -slow]))
        within = float(doubt[:2].max()), float(doubt[2:].max())
        tally.error_within, tally.speed_within = (each if isfinite(each) else None for each in within)
