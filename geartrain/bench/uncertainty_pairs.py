"""Pairs of hand-cut wheels for the benchmark, judged many at once and one by one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import lcm, radians

import numpy as np

from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.uncertainty.manufacturing_errors import (
    CuttingErrorModel,
    CutWheel,
    ErrorDistribution,
    MeshingVerdicts,
    batch_verdicts,
    cut_transmission_function,
)
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair

PLACES, EVERY = "places", "every error"
ERRORS = {
    PLACES: CuttingErrorModel(ErrorDistribution(0.0413)),
    EVERY: CuttingErrorModel(
        ErrorDistribution(0.02), ErrorDistribution(0.04), ErrorDistribution(0.03), ErrorDistribution(0.07)
    ),
}
"""Standard deviations: places in pitches; heights and eccentricity in depths, half angles in half angles."""


def sized(z1: int, z2: int, excess: float) -> TriangularSizes:
    """Teeth of half angle 30 degrees and one depth on both wheels."""
    beta = radians(30)
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


Single = tuple[float, tuple[bool, bool, bool]]
"""Least play (rad of the driven wheel); whether it stops, stands still somewhere, loses contact."""


@dataclass(frozen=True)
class Batch:
    """Wheels of one pair, drawn once and judged in several ways."""

    z1: int
    z2: int
    excess: float
    errors: str
    trials: int
    seed: int = 1

    @property
    def name(self) -> str:
        """`64/38 at 1.02`."""
        return f"{self.z1}/{self.z2} at {1 + self.excess:g}"

    @property
    def pitches(self) -> int:
        """Tooth pitches of a full cycle: one trial."""
        return lcm(self.z1, self.z2)

    @cached_property
    def pair(self) -> CutGearPair:
        """The wheels, (trials, z) each."""
        sizes, rng = sized(self.z1, self.z2, self.excess), np.random.default_rng(self.seed)
        cutting = ERRORS[self.errors]
        driver = cutting.draw(CutWheel.driver_of(sizes), rng, self.trials)
        return CutGearPair(sizes, driver, cutting.draw(CutWheel.driven_of(sizes), rng, self.trials))

    def together(self) -> MeshingVerdicts:
        """All trials at once."""
        return batch_verdicts(self.pair.sizes, self.pair.first, self.pair.second)

    def singly(self, trials: int) -> list[Single]:
        """The first trials by a plain loop."""
        return [self._single(at) for at in range(trials)]

    def _single(self, at: int) -> Single:
        law = cut_transmission_function(self.pair.sizes, self.pair.first.trial(at), self.pair.second.trial(at))
        events = law.events
        return events.play, (events.stop is not None, bool(events.of("standstill")), events.disengages)

    def compared(self, found: MeshingVerdicts, singly: list[Single]) -> tuple[float, int]:
        """Greatest difference of a play (pitches of the driven wheel), and trials of other verdicts."""
        marks = np.stack((found.stops, found.standstill, found.disengaged), axis=1)[: len(singly)]
        play = np.array([each for each, _ in singly])
        off = np.abs(play - found.play[: len(singly)]).max() / self.pair.sizes.p2
        return float(off), int((marks != np.array([each for _, each in singly])).any(axis=1).sum())
