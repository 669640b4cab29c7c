"""How far pointers stray: at random positions of the input, and along a turn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.confidence_intervals import (
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    in_degrees,
    mean_of,
    percentiles_of,
)
from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

FEWEST = 30
"""Trials that must run for a pointer to be judged by them alone."""


class FirstOrderError(NamedTuple):
    """Root mean square (rad) of what superposition to first order is off, and of the errors there."""

    off: float
    rms: float


@dataclass(frozen=True, slots=True)
class PointerErrorStatistics(Result):
    """How far one output is from where even teeth would have it on average, at random positions of the input.

    Attributes
    ----------
    name : str
        Of the output.
    errors : ndarray
        Of the trials in which no pair that moves it jams or is lost, in their order [rad].
    all : ndarray
        Of all trials, as the pushing flanks alone would have it; none where nothing touches [rad].
    stopped : int
        Trials left out of `errors`.
    first : FirstOrderError
        Rms of what superposition to first order is off, and of the errors there [rad].
    shares : mapping of str to float
        Pair -> its share of the variance, from superposition; they sum to 1.

    See Also
    --------
    TrialResults : holds them
    """

    KEYS = (
        Key("output", "name"),
        Key("trials", "runs"),
        "stopped",
        "of_all",
        Key("mean_deg", "mean", in_degrees),
        Key("deviation_deg", "deviation", in_degrees),
        Key("percentiles_deg", "percentiles", in_degrees),
        Key("greatest_deg", "greatest", degrees),
        Key("deviation_of_all_deg", "deviation_of_all", in_degrees),
        Key("first_order", "first", keys=(Key("off_deg", "off", degrees), Key("rms_deg", "rms", degrees))),
        Key("variance_shares", "shares"),
    )

    name: str
    errors: Floats
    all: Floats
    stopped: int
    first: FirstOrderError
    shares: Mapping[str, float]

    @property
    def runs(self) -> int:
        """Trials that run."""
        return len(self.errors)

    @property
    def kept(self) -> Floats:
        """The trials to look at: those that run, or all where too few do."""
        return self.all if self.of_all else self.errors

    @property
    def of_all(self) -> bool:
        """True if so few trials run that all are looked at, as the pushing flanks alone would have them."""
        return len(self.errors) < FEWEST

    @property
    def mean(self) -> IntervalEstimate:
        """Mean (rad)."""
        return mean_of(self.kept)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation (rad)."""
        return deviation_of(self.kept)

    @property
    def deviation_of_all(self) -> IntervalEstimate:
        """Standard deviation in all trials, as the pushing flanks alone would have it (rad)."""
        return deviation_of(self.all)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Percentiles (rad)."""
        return percentiles_of(self.kept)

    @property
    def greatest(self) -> float:
        """Greatest error either way that was seen (rad)."""
        return float(np.abs(self.kept).max(initial=0.0))

    def beyond(self, angle: float) -> ProbabilityEstimate:
        """How often the error exceeds an angle, either way.

        Parameters
        ----------
        angle : float
            0 or more [rad].
        """
        return ProbabilityEstimate(int(np.count_nonzero(np.abs(self.kept) > angle)), len(self.kept))


@dataclass(frozen=True, slots=True)
class PointerErrorCourse(Result):
    """Errors of one output along one turn of it, trial by trial.

    Attributes
    ----------
    name : str
        Of the output.
    turns : ndarray
        Where the input stands, (n,) [turn].
    errors : ndarray
        By trial, (trials, n) [rad].

    See Also
    --------
    run_course : gives it
    """

    KEYS = (
        Key("output", "name"),
        Key("trials", "count"),
        "turns",
        "bands_deg",
        Key("greatest_deg", "percentiles", in_degrees),
    )

    name: str
    turns: Floats
    errors: Floats

    @property
    def greatest(self) -> Floats:
        """Greatest error of each trial along the turn, either way (rad)."""
        found: Floats = np.abs(self.errors).max(axis=1)
        return found

    @property
    def count(self) -> int:
        """Number of trials."""
        return len(self.errors)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Percentiles of the greatest errors (rad)."""
        return percentiles_of(self.greatest)

    @property
    def bands_deg(self) -> Floats:
        """The bands in degrees, (7, n)."""
        found: Floats = np.degrees(self.bands())
        return found

    def bands(self) -> Floats:
        """Least, 2.5, 25, 50, 75, 97.5 % and greatest at each position (rad), (7, n)."""
        found: Floats = np.quantile(self.errors, (0, 0.025, 0.25, 0.5, 0.75, 0.975, 1), axis=0)
        return found
