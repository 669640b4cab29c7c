"""First-order estimates of the transmission error, equation (6) of docs/motion.md, and their accuracy.

The estimates neglect the effect of pairs on each other. To first order an output's error is the sum over all pairs of
its sensitivity times the pair's error. The sum of the ranges of these terms is an upper bound on the range of the
output's error. For independent phases the squares of their rms values add. Superposition in phase neglects only the
change of driver angles by errors. Part of this change is corrected by the mean error of each driver relative to
position 0 (lag).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase
from geartrain.dynamics.motion.run_statistics import RunningStatistics
from geartrain.numerics.results import Key, Result, group

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.numerics.arrays import Floats


class Superposition:
    """First-order errors of the outputs of an error composition; every pair is evaluated at the mean angle of its
    driver.
    """

    def __init__(self, composition: ErrorComposition) -> None:
        self.composition, self.sources = composition, composition.used
        self.response = composition.weights[:, [at for step in composition.steps for at in step.sources]]

    @cached_property
    def ranges(self) -> Floats:
        """Range of each pair's error, maximum minus minimum angle of the driven side [rad]."""
        ends = [source.transmission.error_range() for source in self.sources]
        return np.array([high - low for low, high in ends])

    @cached_property
    def moments(self) -> Floats:
        """Mean and rms value of each pair's error, angle of the driven side [rad], shape (2, pairs)."""
        return np.array([source.transmission.error_moments() for source in self.sources]).reshape(-1, 2).T

    @property
    def bounds(self) -> list[float]:
        """Upper bound on the range (maximum minus minimum) of each output's error [rad]."""
        return [float(row) for row in np.abs(self.response) @ self.ranges]

    @property
    def independent(self) -> list[float]:
        """Rms value of each output's error for independent phases of the pairs [rad]."""
        # variances of independent terms add
        return [hypot(*row) for row in self.response * self.moments[1]]

    @cached_property
    def lags(self) -> Floats:
        """Change of each driver's forward angle due to the mean errors of all pairs [rad]."""
        spread, senses = self.composition.spread, np.array([float(source.sense) for source in self.sources])
        deltas = np.zeros((len(spread.pairs), 1))
        deltas[[source.pair for source in self.sources], 0] = senses * self.moments[0]
        error = spread.errors(deltas)[:, 0]
        return np.array([self.composition.driver_shift(source, error) for source in self.sources])

    def at(self, turns: Floats, lagged: bool = True) -> Floats:
        """Return errors of the outputs [rad], shape (outputs, n), at positions of the input [revolutions].

        `lagged=True` adds the mean errors of the drivers to their angles.
        """
        angle = InputPhase(turns)
        found = np.zeros((len(self.response), len(turns)))
        for at, source in enumerate(self.sources):
            S = angle.cycles(source.cycles) * source.transmission.period
            S += source.start + self.lags[at] if lagged else source.phase
            found += (source.sense * self.response[:, at])[:, None] * source.transmission.error(S)
        return found


@dataclass(frozen=True)
class SuperpositionEstimate(Result):
    """Estimate by superposition: statistics of the estimated error, and of its difference from the composed motion."""

    KEYS = (
        Key("peak_to_peak", "own.peak_to_peak"),
        Key("rms", "own.rms"),
        group("difference", "maximum", Key("rms", "off.rms")),
    )

    own: RunningStatistics
    """Statistics of the estimated error [rad]; `off` has those of the estimated minus the composed error [rad]."""
    off: RunningStatistics

    @property
    def maximum(self) -> float:
        """Maximum magnitude of the difference from the composed motion, relative to the mean difference [rad]."""
        return max(self.off.centre - self.off.minimum, self.off.most - self.off.centre)


@dataclass(frozen=True)
class ErrorEstimates(Result):
    """First-order estimates of one output's error, compared with the exact result: equation (6) of docs/motion.md.

    See Also
    --------
    MotionRun.find_estimates : computes them
    """

    KEYS = (
        group("bound", Key("peak_to_peak", "bound"), Key("error", "bound_error")),
        group("independent", Key("rms", "independent"), Key("error", "independent_error")),
        Key("superposed", "nominal"),
        Key("superposed_with_lag", "lagged"),
    )

    true: RunningStatistics
    """Statistics of the output's error in the exact composition, at the same positions."""
    bound: float
    """Sum over all pairs of sensitivity times error range, an upper bound on the range of the error [rad]."""
    independent: float
    """Rms error of the output if the phases of the pairs are statistically independent [rad]."""
    nominal: SuperpositionEstimate
    """First-order superposition of the pairs' errors, with each driver at its mean angle."""
    lagged: SuperpositionEstimate
    """First-order superposition of the pairs' errors, with each driver displaced by the mean errors of all pairs."""

    @property
    def bound_error(self) -> float:
        """Relative error of `bound`, compared with the exact peak-to-peak error [1]."""
        return (self.bound - self.true.peak_to_peak) / (self.true.peak_to_peak or 1.0)

    @property
    def independent_error(self) -> float:
        """Relative error of `independent`, compared with the exact rms value [1]."""
        return (self.independent - self.true.rms) / (self.true.rms or 1.0)


def find_estimates(
    motion: Motion, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
) -> dict[str, ErrorEstimates]:
    """Return first-order estimates of every output's error, compared with the composition at `samples` positions."""
    superposed = Superposition(motion._composition(turns))
    true, nominal, lagged = motion._statistics(), *((motion._statistics(), motion._statistics()) for _ in range(2))
    for passage in motion._stretches(turns, samples):
        for at, tally in enumerate(true):
            tally.add(passage.error[at], passage.rate[at])
        # statistics of the estimated error, and of its difference from the exact one
        for counted, tallies in ((False, nominal), (True, lagged)):
            error = superposed.at(passage.turns, counted)
            for at, (own, off) in enumerate(zip(*tallies, strict=True)):
                # rates are not estimated; the exact rates only complete the statistics
                own.add(error[at], passage.rate[at])
                off.add(error[at] - passage.error[at], passage.rate[at])
        on_done(len(passage.turns))
    return {
        tally.name: ErrorEstimates(
            tally,
            superposed.bounds[at],
            superposed.independent[at],
            *(SuperpositionEstimate(own[at], off[at]) for own, off in (nominal, lagged)),
        )
        for at, tally in enumerate(true)
    }
