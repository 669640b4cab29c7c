"""First-order estimates of the transmission error, equation (6) of docs/motion.md, which neglect the effect of pairs
on each other: an output's error is the sum over all pairs of its sensitivity times the pair's error.
"""

from __future__ import annotations

from functools import cached_property
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.numerics.arrays import Floats


class Superposition:
    """First-order errors of the outputs, with each pair evaluated at the mean angle of its driver."""

    def __init__(self, composition: ErrorComposition) -> None:
        self.composition, self.sources = composition, composition.used
        self.response = composition.weights[:, [at for step in composition.steps for at in step.sources]]

    @cached_property
    def ranges(self) -> Floats:
        """Range of the error of each pair's driven link, which is the maximum minus the minimum [rad]."""
        ends = [source.transmission.error_range() for source in self.sources]
        return np.array([high - low for low, high in ends])

    @cached_property
    def moments(self) -> Floats:
        """Mean value and rms value of the error of each pair's driven link [rad], shape (2, pairs)."""
        return np.array([source.transmission.error_moments() for source in self.sources]).reshape(-1, 2).T

    @property
    def bounds(self) -> list[float]:
        """Upper bound on the range (maximum minus minimum) of each output's error [rad]."""
        return [float(row) for row in np.abs(self.response) @ self.ranges]

    @property
    def independent(self) -> list[float]:
        """Rms value of each output's error if the phases of the pairs are independent [rad]."""
        # variances of independent terms add
        return [hypot(*row) for row in self.response * self.moments[1]]

    @cached_property
    def lags(self) -> Floats:
        """Change of each driver's angle, in its mean sense of rotation, due to the mean errors of all pairs [rad]."""
        spread, senses = self.composition.spread, np.array([float(source.sense) for source in self.sources])
        deltas = np.zeros((len(spread.pairs), 1))
        deltas[[source.pair for source in self.sources], 0] = senses * self.moments[0]
        error = spread.errors(deltas)[:, 0]
        return np.array([self.composition.driver_shift(source, error) for source in self.sources])

    def at(self, turns: Floats, lagged: bool = True) -> Floats:
        """Return the errors of the outputs [rad], shape (outputs, n), at positions of the input [revolutions].

        If `lagged` is True, the mean errors of the drivers are added to their angles.
        """
        angle = InputPhase(turns)
        found = np.zeros((len(self.response), len(turns)))
        for at, source in enumerate(self.sources):
            S = angle.cycles(source.cycles) * source.transmission.period
            S += source.start + self.lags[at] if lagged else source.phase
            found += (source.sense * self.response[:, at])[:, None] * source.transmission.error(S)
        return found
